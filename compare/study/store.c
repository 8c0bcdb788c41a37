/* store.c - see store.h.
 *
 * What is checked, in this order, before the first byte is written: the lock; SQLite's own first bytes and our
 * application id in them, read as a plain file, so that no other file is ever opened as a database; its
 * integrity; schema, program version and fingerprint. */
#include "compare/study/store.h"

#include <errno.h>
#include <fcntl.h>
#include <inttypes.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

enum { APPLICATION_ID = 0x68626d63 /* "hbmc" */, HEADER = 100, ID_AT = 68, BUSY_MS = 10000 };
static const char schema_version[] = "1";

struct study_store { /* from study_store_open, to study_store_close */
  const study *s;    /* the caller's */
  sqlite3 *db;
  int lock; /* file descriptor that holds the flock; -1 for :memory: */
  sqlite3_stmt *put_scene, *put_row;
};

/* ---- columns ---- */

static const char *type_of_field(const field *f)
{
  if (f->kind == FIELD_REAL) return "REAL";
  return f->kind == FIELD_INTEGER || f->kind == FIELD_FLAG ? "INTEGER" : "TEXT";
}

static void write_columns(rows_kind kind, unsigned extra, FILE *to)
{
  table_column columns[ROWS_MOST];
  const int n = rows_columns(kind, extra, columns);
  for (int i = 0; i < n; ++i)
    fprintf(to, ", \"%s\" %s", columns[i].name,
            (columns[i].kind == TABLE_REAL      ? "REAL"
             : columns[i].kind == TABLE_INTEGER ? "INTEGER"
                                                : "TEXT"));
}

/* CREATE TABLE ... for the study, to free; NULL when out of memory. */
static char *store_schema(const study *s, int application_id)
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

/* ---- putting a scene ---- */

/* A statement that inserts n columns; NULL when out of memory. */
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

static bool prepare_inserts(study_store *st)
{
  table_column columns[ROWS_MOST];
  const int n_curve = rows_columns(ROWS_CURVE, study_extra_columns(st->s), columns);
  const int n_row = rows_columns(study_rows(st->s), study_extra_columns(st->s), columns);
  int n_varied = 0;
  for (int a = 0; a < st->s->n_axes; ++a) n_varied += st->s->axes[a].n_fields;
  st->put_scene = prepare_insert(st->db, "scene", 1 + n_varied + 3 + n_curve);
  st->put_row = prepare_insert(st->db, "row", 2 + n_row);
  return st->put_scene && st->put_row;
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

/* Store the row whose columns are bound, if they are. */
static bool insert(sqlite3_stmt *q, bool bound)
{
  const bool good = bound && sqlite3_step(q) == SQLITE_DONE;
  sqlite3_reset(q);
  return good;
}

static bool insert_scene(study_store *st, const study_result *r)
{
  const study *s = st->s;
  sqlite3_stmt *q = st->put_scene;
  table_column columns[ROWS_MOST];
  const int n_curve = rows_columns(ROWS_CURVE, study_extra_columns(s), columns);
  int i = 0;
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
  return insert(q, good);
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
    good = insert(q, good);
  }
  return good;
}

/* ---- saying what is wrong ---- */

#if defined(__GNUC__)
__attribute__((format(printf, 4, 5)))
#endif
static hc_status
refuse(case_error *err, const char *path, hc_status st, const char *format, ...)
{
  message m;
  va_list args;
  message_start(&m, err->message, sizeof err->message);
  message_add_input(&m, path, strlen(path), 240);
  message_add(&m, ": ");
  va_start(args, format);
  message_add_list(&m, format, args);
  va_end(args);
  return st;
}

static hc_status refuse_errno(case_error *err, const char *path, const char *what, int error)
{
  message m;
  message_start(&m, err->message, sizeof err->message);
  message_add_input(&m, path, strlen(path), 240);
  message_add(&m, ": %s: ", what);
  message_add_errno(&m, error);
  return HC_IO;
}

static const char damaged[] = "damaged; delete it, or give another name with --results";

static hc_status refuse_sql(case_error *err, const char *path, sqlite3 *db)
{
  const int code = sqlite3_errcode(db);
  if (study_sql_status(db) == HC_NO_MEMORY) return refuse(err, path, HC_NO_MEMORY, "out of memory");
  return refuse(err, path, HC_IO, "%s (SQLite: %.150s)",
                code == SQLITE_CORRUPT || code == SQLITE_NOTADB ? damaged : "cannot be used", sqlite3_errmsg(db));
}

/* ---- the file, before SQLite sees it ---- */

/* The descriptor is kept until the database is closed: closing it earlier would drop SQLite's own locks. */
static hc_status lock_file(const char *path, int *fd, bool *is_new, case_error *err)
{
  if (!*path) return refuse(err, "--results", HC_IO, "an empty file name");
  *fd = open(path, O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (*fd < 0) return refuse_errno(err, path, "cannot be opened for writing", errno);
  struct stat info;
  if (fstat(*fd, &info) != 0 || !S_ISREG(info.st_mode))
    return refuse(err, path, HC_IO, "not a regular file, expected one for the results");
  if (flock(*fd, LOCK_EX | LOCK_NB) != 0) {
    if (errno != EWOULDBLOCK) return refuse_errno(err, path, "cannot be locked", errno);
    return refuse(err, path, HC_IO,
                  "another hbmcheck is writing these results; let it finish, or give another name with --results");
  }
  static const char magic[16] = "SQLite format 3";
  unsigned char head[HEADER];
  ssize_t n = pread((*fd), head, sizeof head, 0);
  if (n < 0) return refuse_errno(err, path, "cannot be read", errno);
  *is_new = n == 0;
  if (*is_new) return HC_OK;
  if (n < HEADER || memcmp(head, magic, sizeof magic))
    return refuse(err, path, HC_IO, "not an SQLite file, expected the results of a study, or a new name (--results)");
  uint32_t id = 0;
  for (int i = 0; i < 4; ++i) id = id << 8 | head[ID_AT + i];
  if (id == APPLICATION_ID) return HC_OK;
  return refuse(err, path, HC_IO,
                "an SQLite file of another program, expected the results of a study, or a new name (--results)");
}

/* ---- the database ---- */

/* Run SQL, printf-style as sqlite3_mprintf has it; true if all of it was done. */
static bool run_sql(sqlite3 *db, const char *format, ...)
{
  va_list args;
  va_start(args, format);
  char *sql = sqlite3_vmprintf(format, args);
  va_end(args);
  const bool good = sql && sqlite3_exec(db, sql, NULL, NULL, NULL) == SQLITE_OK;
  sqlite3_free(sql);
  return good;
}

/* The first value that a query gives, to free; NULL if there is none. */
static char *first_value(sqlite3 *db, const char *sql)
{
  sqlite3_stmt *q = NULL;
  char *text = NULL;
  if (sqlite3_prepare_v2(db, sql, -1, &q, NULL) == SQLITE_OK && sqlite3_step(q) == SQLITE_ROW &&
      sqlite3_column_text(q, 0))
    text = strdup((const char *)sqlite3_column_text(q, 0));
  sqlite3_finalize(q);
  return text;
}

static bool gives(sqlite3 *db, const char *sql, const char *expected)
{
  char *text = first_value(db, sql);
  const bool same = text && !strcmp(text, expected);
  free(text);
  return same;
}

enum { FINGERPRINT = 24 };
static const char *fingerprint_of(const study *s, char text[FINGERPRINT])
{
  snprintf(text, FINGERPRINT, "%016" PRIx64, s->fingerprint);
  return text;
}

/* HC_OK: go on with it. HC_BAD_INPUT: the results of another study, which `fresh` may throw away. */
static hc_status check_contents(const study *s, sqlite3 *db, const char *path, const char *version, case_error *err)
{
  char fingerprint[FINGERPRINT];
  char *made_by = first_value(db, "SELECT value FROM study WHERE key = 'hbmcheck'");
  hc_status st = HC_OK;
  if (!made_by || !gives(db, "SELECT value FROM study WHERE key = 'schema'", schema_version) ||
      strcmp(made_by, version) != 0)
    st = refuse(err, path, HC_BAD_INPUT,
                "made by hbmcheck %.30s, this is %s; --fresh throws these results away, --results FILE keeps them",
                made_by ? made_by : "?", version);
  else if (!gives(db, "SELECT value FROM study WHERE key = 'fingerprint'", fingerprint_of(s, fingerprint)))
    st = refuse(
        err, path, HC_BAD_INPUT,
        "results of another study, or of this one before it was changed; --fresh throws them away, --results FILE "
        "keeps them");
  free(made_by);
  return st;
}

/* All tables anew, in one transaction. */
static bool make_tables(const study *s, sqlite3 *db, const char *version)
{
  char fingerprint[FINGERPRINT], *schema = store_schema(s, APPLICATION_ID);
  const bool good =
      schema &&
      run_sql(db,
              "BEGIN IMMEDIATE; DROP TABLE IF EXISTS \"row\"; DROP TABLE IF EXISTS scene; DROP TABLE IF EXISTS study;"
              "%s; INSERT INTO study VALUES('schema', %Q), ('hbmcheck', %Q), ('title', %Q), ('run', %Q),"
              "('fingerprint', %Q), ('scenes', '%ld'); COMMIT",
              schema, schema_version, version, s->title, study_kind_name(s->kind), fingerprint_of(s, fingerprint),
              s->n_scenes);
  free(schema);
  return good;
}

static hc_status open_database(study_store *st, const char *path, const char *version, bool is_new, bool fresh,
                               case_error *err)
{
  const study *s = st->s;
  if (sqlite3_open_v2(path, &st->db, SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE, NULL) != SQLITE_OK)
    return refuse_sql(err, path, st->db);
  sqlite3_busy_timeout(st->db, BUSY_MS);
  if (!is_new) {
    /* until it is known to be ours, closing writes nothing */
    sqlite3_db_config(st->db, SQLITE_DBCONFIG_NO_CKPT_ON_CLOSE, 1, NULL);
    if (!gives(st->db, "PRAGMA quick_check(1)", "ok")) return refuse(err, path, HC_IO, "%s", damaged);
    sqlite3_stmt *q = NULL; /* a crash before the first commit leaves a file of ours without tables */
    bool empty = sqlite3_prepare_v2(st->db, "SELECT 1 FROM study", -1, &q, NULL) != SQLITE_OK;
    sqlite3_finalize(q);
    hc_status known = empty ? HC_OK : check_contents(s, st->db, path, version, err);
    if (known != HC_OK && !fresh) return known;
    is_new = empty || fresh;
    err->message[0] = 0;
    sqlite3_db_config(st->db, SQLITE_DBCONFIG_NO_CKPT_ON_CLOSE, 0, NULL);
  }
  const bool good = (!is_new || make_tables(s, st->db, version)) &&
                    run_sql(st->db, "PRAGMA journal_mode = WAL; PRAGMA synchronous = NORMAL") && prepare_inserts(st);
  return good ? HC_OK : refuse_sql(err, path, st->db);
}

hc_status study_store_open(const study *s, const char *path, const char *version, bool fresh, study_store **out,
                           case_error *err)
{
  *out = NULL;
  study_store *st = calloc(1, sizeof *st);
  if (!st) return refuse(err, path, HC_NO_MEMORY, "out of memory");
  bool is_new = true;
  st->s = s;
  st->lock = -1;
  hc_status code = strcmp(path, ":memory:") ? lock_file(path, &st->lock, &is_new, err) : HC_OK;
  if (code == HC_OK) code = open_database(st, path, version, is_new, fresh, err);
  if (code == HC_OK) *out = st;
  else study_store_close(st);
  return code;
}

void study_store_close(study_store *st)
{
  if (!st) return;
  sqlite3_finalize(st->put_scene);
  sqlite3_finalize(st->put_row);
  sqlite3_close(st->db);
  if (st->lock >= 0) close(st->lock);
  free(st);
}

const char *study_store_error(const study_store *st) { return sqlite3_errmsg(st->db); }

hc_status study_sql_status(sqlite3 *db)
{
  const int code = sqlite3_errcode(db);
  return code == SQLITE_NOMEM || code == SQLITE_OK /* our own text had no room */ ? HC_NO_MEMORY : HC_IO;
}

/* ---- scenes ---- */

hc_status study_store_put(study_store *st, const study_result *r)
{
  if (run_sql(st->db, "BEGIN IMMEDIATE") && insert_scene(st, r) && insert_rows(st, r) && run_sql(st->db, "COMMIT"))
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

/* ---- reading only ---- */

static int may_read(void *self, int action, const char *a, const char *function, const char *c, const char *d)
{
  (void)self, (void)a, (void)c, (void)d;
  if (action == SQLITE_SELECT || action == SQLITE_READ || action == SQLITE_RECURSIVE) return SQLITE_OK;
  return action == SQLITE_FUNCTION && strcmp(function, "load_extension") != 0 ? SQLITE_OK : SQLITE_DENY;
}

sqlite3 *study_store_readonly(study_store *st)
{
  sqlite3_set_authorizer(st->db, may_read, NULL);
  return st->db;
}

hc_status study_store_view(study_store *st, const char *name, const char *select)
{
  sqlite3_set_authorizer(st->db, NULL, NULL);
  const bool good = run_sql(st->db, "CREATE TEMP VIEW \"%w\" AS %s", name, select);
  const hc_status status = good ? HC_OK : study_sql_status(st->db);
  study_store_readonly(st);
  return status;
}
