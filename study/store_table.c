/* store_table.c - the tables scene and row: their columns, and putting a scene into them. See store.h. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/number.h"
#include "study/store_private.h"

/* ---- columns ---- */

static const char *type_of(table_kind kind)
{
  return kind == TABLE_REAL ? "REAL" : kind == TABLE_INTEGER ? "INTEGER" : "TEXT";
}

static const char *type_of_field(const field *f)
{
  if (f->kind == FIELD_REAL) return "REAL";
  return f->kind == FIELD_INTEGER || f->kind == FIELD_FLAG ? "INTEGER" : "TEXT";
}

static void write_columns(rows_kind kind, unsigned extra, FILE *to)
{
  int n;
  const table_column *columns = rows_columns(kind, extra, &n);
  for (int i = 0; i < n; ++i) fprintf(to, ", \"%s\" %s", columns[i].name, type_of(columns[i].kind));
}

char *store_schema(const study *s, int application_id)
{
  char *sql = NULL;
  size_t size;
  FILE *to = open_memstream(&sql, &size);
  if (!to) return NULL;
  fprintf(to,
          "PRAGMA application_id = %d; CREATE TABLE study(key TEXT PRIMARY KEY, value TEXT) WITHOUT ROWID;"
          "CREATE TABLE scene(id INTEGER PRIMARY KEY",
          application_id);
  for (int a = 0; a < s->n_axes; ++a)
    for (int k = 0; k < s->axes[a].n_fields; ++k)
      fprintf(to, ", \"%s\" %s", s->axes[a].fields[k].path, type_of_field(s->axes[a].fields[k].f));
  fputs(", status TEXT, reason TEXT, seconds REAL", to);
  write_columns(ROWS_CURVE, study_extra_columns(s), to);
  fputs("); CREATE TABLE \"row\"(scene INTEGER, number INTEGER", to);
  write_columns(study_rows(s), study_extra_columns(s), to);
  fputs(", PRIMARY KEY(scene, number)) WITHOUT ROWID", to);
  bool whole = !ferror(to);
  if (fclose(to) == 0 && whole) return sql;
  free(sql);
  return NULL;
}

/* ---- putting ---- */

static int n_varied(const study *s)
{
  int n = 0;
  for (int a = 0; a < s->n_axes; ++a) n += s->axes[a].n_fields;
  return n;
}

static sqlite3_stmt *prepare_insert(sqlite3 *db, const char *name, int n)
{
  char sql[4096];
  int used = snprintf(sql, sizeof sql, "INSERT INTO \"%s\" VALUES(?", name);
  for (int i = 1; i < n; ++i) used += snprintf(sql + used, sizeof sql - (size_t)used, ",?");
  snprintf(sql + used, sizeof sql - (size_t)used, ")");
  sqlite3_stmt *q = NULL;
  return sqlite3_prepare_v3(db, sql, -1, SQLITE_PREPARE_PERSISTENT, &q, NULL) == SQLITE_OK ? q : NULL;
}
_Static_assert(2 * (STUDY_MOST_FIELDS + ROWS_MOST) + 64 < 4096, "prepare_insert's text holds a mark a column");

bool store_prepare(study_store *st)
{
  int n_curve, n_row;
  rows_columns(ROWS_CURVE, study_extra_columns(st->s), &n_curve);
  rows_columns(study_rows(st->s), study_extra_columns(st->s), &n_row);
  st->put_scene = prepare_insert(st->db, "scene", 1 + n_varied(st->s) + 3 + n_curve);
  st->put_row = prepare_insert(st->db, "row", 2 + n_row);
  return st->put_scene && st->put_row;
}

void store_unprepare(study_store *st)
{
  sqlite3_finalize(st->put_scene);
  sqlite3_finalize(st->put_row);
}

/* False: no memory for the text. Unchecked, the column would be stored as NULL. */
static bool bind_cell(sqlite3_stmt *q, int i, const row_cell *c)
{
  if (!c->there) return sqlite3_bind_null(q, i) == SQLITE_OK;
  if (c->kind == TABLE_REAL) return sqlite3_bind_double(q, i, c->as.real) == SQLITE_OK;
  if (c->kind == TABLE_INTEGER) return sqlite3_bind_int64(q, i, c->as.integer) == SQLITE_OK;
  return sqlite3_bind_text(q, i, c->as.text, -1, SQLITE_TRANSIENT) == SQLITE_OK;
}

/* A number where the field is one, 0 or 1 for flags, else as it is written. */
static void bind_value(sqlite3_stmt *q, int i, const study_field *sf, const char *text)
{
  double x = 0;
  bool number = number_read(text, strlen(text), &x) == NUMBER_FINE;
  if (sf->f->kind == FIELD_REAL && number) sqlite3_bind_double(q, i, x);
  else if (sf->f->kind == FIELD_INTEGER && number) sqlite3_bind_int64(q, i, (sqlite3_int64)x);
  else if (sf->f->kind == FIELD_FLAG) sqlite3_bind_int(q, i, !strcmp(text, "true"));
  else sqlite3_bind_text(q, i, text, -1, SQLITE_STATIC);
}

static bool insert_scene(study_store *st, const study_result *r)
{
  const study *s = st->s;
  sqlite3_stmt *q = st->put_scene;
  int i = 0, n_curve;
  rows_columns(ROWS_CURVE, study_extra_columns(s), &n_curve);
  sqlite3_bind_int64(q, ++i, r->id);
  for (int a = 0; a < s->n_axes; ++a)
    for (int k = 0; k < s->axes[a].n_fields; ++k) {
      const study_field *sf = &s->axes[a].fields[k];
      bind_value(q, ++i, sf, sf->values[study_index(s, r->id, a)].text);
    }
  sqlite3_bind_text(q, ++i, r->failed ? "failed" : "done", -1, SQLITE_STATIC);
  bool good =
      (r->failed ? sqlite3_bind_text(q, ++i, r->reason, -1, SQLITE_TRANSIENT) : sqlite3_bind_null(q, ++i)) == SQLITE_OK;
  sqlite3_bind_double(q, ++i, r->seconds);
  for (int c = 0; c < n_curve; ++c)
    good &= bind_cell(q, ++i, r->has_curve ? &r->curve[c] : &(row_cell){.there = false});
  good = good && sqlite3_step(q) == SQLITE_DONE;
  sqlite3_reset(q);
  return good;
}

static bool insert_rows(study_store *st, const study_result *r)
{
  sqlite3_stmt *q = st->put_row;
  bool good = true;
  for (int n = 0; n < r->n_rows && good; ++n) {
    sqlite3_bind_int64(q, 1, r->id);
    sqlite3_bind_int(q, 2, n);
    for (int c = 0; c < r->n_columns; ++c)
      good &= bind_cell(q, 3 + c, &r->rows[(size_t)n * (size_t)r->n_columns + (size_t)c]);
    good = good && sqlite3_step(q) == SQLITE_DONE;
    sqlite3_reset(q);
  }
  return good;
}

hc_status study_store_put(study_store *st, const study_result *r)
{
  if (sqlite3_exec(st->db, "BEGIN IMMEDIATE", NULL, NULL, NULL) == SQLITE_OK && insert_scene(st, r) &&
      insert_rows(st, r) && sqlite3_exec(st->db, "COMMIT", NULL, NULL, NULL) == SQLITE_OK)
    return HC_OK;
  return study_sql_status(st->db); /* closing rolls back; study_store_error still has the words */
}

hc_status study_store_done(study_store *st, unsigned char *done, long *n)
{
  sqlite3_stmt *q = NULL;
  *n = 0;
  memset(done, 0, (size_t)st->s->n_scenes);
  int code = sqlite3_prepare_v2(st->db, "SELECT id FROM scene", -1, &q, NULL);
  while (code == SQLITE_OK || code == SQLITE_ROW) {
    code = sqlite3_step(q);
    sqlite3_int64 id = code == SQLITE_ROW ? sqlite3_column_int64(q, 0) : -1;
    if (id >= 0 && id < st->s->n_scenes) done[id] = 1, ++*n;
  }
  sqlite3_finalize(q);
  return code == SQLITE_DONE ? HC_OK : code == SQLITE_NOMEM ? HC_NO_MEMORY : HC_IO;
}
