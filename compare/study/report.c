/* report.c - see store.h. The export is written row by row: a study may be larger than memory. */
#include "compare/study/store.h"

#include <jansson.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "compare/output/table_private.h"

/* Which scenes have exact forces, in SQL. */
static const char *exact_scenes(const study *s)
{
  for (int a = 0; a < s->n_axes; ++a)
    for (int k = 0; k < s->axes[a].n_fields; ++k)
      if (!strcmp(s->axes[a].fields[k].path, "hbm.force")) return "\"hbm.force\" = 'exact'";
  return s->base.hbm.force == HBM_FORCE_EXACT ? "1" : "0";
}

hc_status study_summarise(const study *s, study_store *store, study_summary *out)
{
  char sql[400];
  snprintf(sql, sizeof sql,
           "SELECT sum(status = 'done'), sum(status = 'failed'), total(seconds),"
           " (SELECT id FROM scene WHERE status = 'failed' ORDER BY id LIMIT 1),"
           " (SELECT reason FROM scene WHERE status = 'failed' ORDER BY id LIMIT 1), total(seconds * (%s)) FROM scene",
           exact_scenes(s));
  sqlite3_stmt *q = NULL;
  *out = (study_summary){.first_failed = -1};
  bool good =
      sqlite3_prepare_v2(study_store_readonly(store), sql, -1, &q, NULL) == SQLITE_OK && sqlite3_step(q) == SQLITE_ROW;
  if (good) {
    out->done = (long)sqlite3_column_int64(q, 0);
    out->failed = (long)sqlite3_column_int64(q, 1);
    out->seconds = sqlite3_column_double(q, 2);
    out->exact_seconds = sqlite3_column_double(q, 5);
    if (out->failed) out->first_failed = (long)sqlite3_column_int64(q, 3);
    const char *reason = (const char *)sqlite3_column_text(q, 4);
    snprintf(out->reason, sizeof out->reason, "%s", reason ? reason : "");
  }
  hc_status st = good ? HC_OK : study_sql_status(study_store_readonly(store));
  sqlite3_finalize(q);
  return st;
}

const table_column *study_verdict_columns(int *n)
{
  static const table_column columns[] = {{"verdict", TABLE_TEXT}, {"rows", TABLE_INTEGER}, {"study", TABLE_TEXT}};
  *n = sizeof columns / sizeof *columns;
  return columns;
}

hc_status study_verdicts(const study *s, study_store *store, table *t)
{
  sqlite3_stmt *q = NULL;
  if (s->kind == STUDY_FRF) return HC_OK; /* has no verdicts */
  int code =
      sqlite3_prepare_v2(study_store_readonly(store),
                         "SELECT verdict, count(*) FROM \"row\" GROUP BY verdict ORDER BY 2 DESC, 1", -1, &q, NULL);
  if (code == SQLITE_OK)
    while ((code = sqlite3_step(q)) == SQLITE_ROW) {
      table_put_text(t, (const char *)sqlite3_column_text(q, 0));
      table_put_integer(t, (long)sqlite3_column_int64(q, 1));
      table_put_text(t, s->title);
    }
  sqlite3_finalize(q);
  return code == SQLITE_DONE ? HC_OK : code == SQLITE_NOMEM ? HC_NO_MEMORY : HC_IO;
}

/* ---- export ---- */

static bool is_scene_column(const char *name, unsigned extra)
{
  static const char *const own[] = {"scene", "status", "reason", "seconds"};
  table_column curve[ROWS_MOST];
  const int n = rows_columns(ROWS_CURVE, extra, curve);
  for (size_t i = 0; i < sizeof own / sizeof *own; ++i)
    if (!strcmp(own[i], name)) return true;
  for (int i = 0; i < n; ++i)
    if (!strcmp(curve[i].name, name)) return true;
  return false;
}

static void select_columns(rows_kind kind, unsigned extra, char table_letter, FILE *to)
{
  table_column columns[ROWS_MOST];
  const int n = rows_columns(kind, extra, columns);
  for (int i = 0; i < n; ++i)
    fprintf(to, ", %c.\"%s\" AS \"%s%s\"", table_letter, columns[i].name,
            table_letter == 'r' && is_scene_column(columns[i].name, extra) ? "row_" : "", columns[i].name);
}

/* To free; NULL when out of memory. */
static char *export_query(const study *s, bool timings, bool one_response)
{
  char *sql = NULL;
  size_t size;
  FILE *to = open_memstream(&sql, &size);
  if (!to) return NULL;
  fputs("SELECT s.id AS scene", to);
  for (int a = 0; a < s->n_axes; ++a)
    for (int k = 0; k < s->axes[a].n_fields; ++k)
      fprintf(to, ", s.\"%s\" AS \"%s\"", s->axes[a].fields[k].path, s->axes[a].fields[k].path);
  fprintf(to, ", s.status AS status, s.reason AS reason%s", timings ? ", s.seconds AS seconds" : "");
  if (s->kind != STUDY_TRANSIENT) select_columns(ROWS_CURVE, study_extra_columns(s), 's', to);
  select_columns(study_rows(s), study_extra_columns(s), 'r', to);
  fprintf(to, " FROM scene AS s LEFT JOIN \"row\" AS r ON r.scene = s.id %s ORDER BY s.id, r.number",
          one_response ? "AND r.response = ?1" : "");
  bool whole = !ferror(to);
  if (fclose(to) == 0 && whole) return sql;
  free(sql);
  return NULL;
}

/* The values of the current row, or the names of the columns. */
static void write_csv_row(sqlite3_stmt *q, bool names, FILE *to)
{
  for (int j = 0; j < sqlite3_column_count(q); ++j) {
    if (j) putc(',', to);
    switch (names ? SQLITE_TEXT : sqlite3_column_type(q, j)) {
    case SQLITE_INTEGER: fprintf(to, "%lld", (long long)sqlite3_column_int64(q, j)); break;
    case SQLITE_FLOAT: fprintf(to, "%.17g", sqlite3_column_double(q, j)); break;
    case SQLITE_NULL: break;
    default: table_write_csv_text(names ? sqlite3_column_name(q, j) : (const char *)sqlite3_column_text(q, j), to);
    }
  }
  putc('\n', to);
}

static json_t *json_cell(sqlite3_stmt *q, int j)
{
  switch (sqlite3_column_type(q, j)) {
  case SQLITE_INTEGER: return json_integer(sqlite3_column_int64(q, j));
  case SQLITE_FLOAT:
    return isfinite(sqlite3_column_double(q, j)) ? json_real(sqlite3_column_double(q, j)) : json_null();
  case SQLITE_NULL: return json_null();
  default: return json_string((const char *)sqlite3_column_text(q, j));
  }
}

hc_status study_export(const study *s, study_store *store, table_format format, bool timings, const char *response,
                       FILE *to)
{
  sqlite3_stmt *q = NULL;
  bool json = format == FORMAT_JSON, good = true;
  char *sql = export_query(s, timings, response != NULL);
  if (!sql) return HC_NO_MEMORY;
  int code = sqlite3_prepare_v2(study_store_readonly(store), sql, -1, &q, NULL);
  free(sql);
  if (code == SQLITE_OK && response) code = sqlite3_bind_text(q, 1, response, -1, SQLITE_STATIC);
  if (code != SQLITE_OK) {
    sqlite3_finalize(q);
    return study_sql_status(study_store_readonly(store));
  }
  if (json) fputs("{\n  \"rows\": [", to);
  else write_csv_row(q, true, to);
  for (long n = 0; good && (code = sqlite3_step(q)) == SQLITE_ROW; ++n) {
    if (json) fputs(n ? ",\n    " : "\n    ", to);
    if (json) {
      json_t *object = json_object();
      good = object != NULL;
      for (int j = 0; good && j < sqlite3_column_count(q); ++j)
        good = json_object_set_new(object, sqlite3_column_name(q, j), json_cell(q, j)) == 0;
      good = good && (json_dumpf(object, to, JSON_REAL_PRECISION(17)) == 0 || ferror(to));
      json_decref(object);
    } else write_csv_row(q, false, to);
  }
  if (json) fputs("\n  ],\n  \"notes\": []\n}\n", to);
  sqlite3_finalize(q);
  if (!good || code == SQLITE_NOMEM) return HC_NO_MEMORY;
  return code == SQLITE_DONE && !ferror(to) ? HC_OK : HC_IO;
}
