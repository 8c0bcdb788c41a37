/* test_store.c - what the results file refuses, and that what it refuses stays as it was, byte for byte. */
#include "compare/study/store.h"
#include "tests/study/study_text.h"

static char file[64]; /* r.sqlite in the folder */

#define LINEAR "study: t\n" CASE "run: frf\nvary: [{oscillator.mass: [1, 2, 3]}]\n"

static void refuse_unchanged(const study *s, bool fresh, const char *words)
{
  size_t before, after;
  char *a = folder_read("r.sqlite", &before);
  case_error err = {{0}};
  study_store *st = NULL;
  assert_int_not_equal(study_store_open(s, file, "1", fresh, &st, &err), HC_OK);
  assert_null(st);
  if (strncmp(err.message, file, strlen(file)) || !strstr(err.message, words))
    fail_msg("expected '%s' in: %s", words, err.message);
  char *b = folder_read("r.sqlite", &after);
  assert_int_equal(before, after);
  assert_memory_equal(a, b, before);
  free(a);
  free(b);
}

static study_store *open_good(const study *s, const char *version, bool fresh)
{
  case_error err = {{0}};
  study_store *st = NULL;
  if (study_store_open(s, file, version, fresh, &st, &err) != HC_OK) fail_msg("%s", err.message);
  return st;
}

static void keep_scene(const study *s, study_store *st, long id)
{
  CHECK_FILLED(study_result, r, study_solve(s, id, NULL, &r));
  assert_false(r.failed);
  assert_int_equal(study_store_put(st, &r), HC_OK);
  study_result_clear(&r);
}

static long count_done(const study *s, study_store *st)
{
  unsigned char done[16];
  long n;
  assert_true(s->n_scenes <= 16);
  assert_int_equal(study_store_done(st, done, &n), HC_OK);
  return n;
}

static void scenes_are_kept_once(CHECK_STATE)
{
  study *s = good_study(LINEAR);
  study_store *st = open_good(s, "1", false);
  keep_scene(s, st, 0);
  keep_scene(s, st, 2);
  study_store_close(st);
  st = open_good(s, "1", false);
  assert_int_equal(count_done(s, st), 2);
  CHECK_FILLED(study_result, r, study_solve(s, 0, NULL, &r));
  assert_int_equal(study_store_put(st, &r), HC_IO); /* twice */
  study_result_clear(&r);
  study_store_close(st);
  st = open_good(s, "1", true); /* fresh */
  assert_int_equal(count_done(s, st), 0);
  study_store_close(st);
  study_free(s);
  unlink(file);
}

static void others_are_refused(CHECK_STATE)
{
  study *s = good_study(LINEAR),
        *other = good_study("study: t\n" CASE "run: frf\nvary: [{oscillator.mass: [1, 2, 4]}]\n");
  study_store *st = open_good(s, "1", false);
  keep_scene(s, st, 0);
  /* flock is per open file: also within a process */
  refuse_unchanged(s, false, "another hbmcheck is writing these results");
  refuse_unchanged(s, true, "another hbmcheck is writing these results");
  study_store_close(st);
  refuse_unchanged(
      other, false,
      "results of another study, or of this one before it was changed; --fresh throws them away, --results FILE keeps "
      "them");
  st = open_good(other, "2", true);
  study_store_close(st);
  refuse_unchanged(other, false, "made by hbmcheck 2, this is 1; --fresh");
  study_free(other);
  study_free(s);
  unlink(file);
}

static void foreign_files_are_refused(CHECK_STATE)
{
  study *s = good_study(LINEAR);
  for (int fresh = 0; fresh < 2; ++fresh) {
    folder_put(
        "r.sqlite",
        "study: not a database, but longer than the hundred bytes of SQLite's header, which is what is looked at "
        "first\n");
    refuse_unchanged(s, fresh, "not an SQLite file, expected the results of a study");
    folder_put("r.sqlite", "short");
    refuse_unchanged(s, fresh, "not an SQLite file");
    unlink(file);
    sqlite3 *db;
    assert_int_equal(sqlite3_open(file, &db), SQLITE_OK);
    assert_int_equal(
        sqlite3_exec(db, "CREATE TABLE study(key, value); INSERT INTO study VALUES('schema', '1')", NULL, NULL, NULL),
        SQLITE_OK);
    sqlite3_close(db);
    refuse_unchanged(s, fresh, "an SQLite file of another program");
    unlink(file);
  }
  study_free(s);
}

/* Pages of noise in the middle of our own file. */
static void damaged_files_are_refused(CHECK_STATE)
{
  study *s = good_study(LINEAR);
  study_store *st = open_good(s, "1", false);
  for (long id = 0; id < 3; ++id) keep_scene(s, st, id);
  study_store_close(st);
  FILE *to = folder_open("r.sqlite", "r+b");
  for (long at = 4096; at < 4 * 4096; ++at) {
    fseek(to, at, SEEK_SET);
    putc((int)(at * 7919 % 251), to);
  }
  fclose(to);
  refuse_unchanged(s, false, "damaged; delete it");
  refuse_unchanged(s, true, "damaged; delete it");
  study_free(s);
  unlink(file);
}

static void places_that_cannot_be(CHECK_STATE)
{
  study *s = good_study(LINEAR);
  study_store *st = NULL;
  case_error err = {{0}};
  assert_int_equal(study_store_open(s, "/nonexistent/a.sqlite", "1", false, &st, &err), HC_IO);
  assert_non_null(strstr(err.message, "/nonexistent/a.sqlite: cannot be opened for writing: No such file"));
  assert_int_equal(study_store_open(s, "", "1", false, &st, &err), HC_IO);
  assert_int_equal(study_store_open(s, "/dev/null", "1", false, &st, &err), HC_IO);
  assert_non_null(strstr(err.message, "not a regular file"));
  study_free(s);
}

static void refuse_claim(const char *query, const char *words)
{
  char text[1024];
  case_error err;
  snprintf(text, sizeof text, LINEAR "claims:\n  - {says: a, holds: \"%s\"}\n", query);
  study *s = study_from_text(text, 0, NULL, &err);
  assert_non_null(s);
  if (study_claims_check(s, &err) != HC_BAD_INPUT || !strstr(err.message, ":6:22: `holds`: ") ||
      !strstr(err.message, words))
    fail_msg("%s: expected '%s' in: %s", query, words, err.message);
  study_free(s);
}

static void claims_only_read(CHECK_STATE)
{
  refuse_claim("SELECT nosuch FROM scene", "no such column: nosuch");
  refuse_claim("SELEC 1", "syntax error");
  refuse_claim("SELECT 1, 2", "gives 2 columns, expected one value");
  refuse_claim("SELECT 1; SELECT 2", "more than one query");
  refuse_claim("  ", "no query");
  refuse_claim("DELETE FROM scene", "may only read");
  refuse_claim("DELETE FROM scene RETURNING 1", "may only read");
  refuse_claim("ATTACH 'x' AS y", "may only read");
  refuse_claim("PRAGMA user_version = 3", "may only read");
  refuse_claim("SELECT load_extension('x')", "not authorized to use function");
  study *s = good_study(
      LINEAR "claims:\n  - {says: a, holds: 'SELECT count(*) = 3 FROM scene JOIN row ON row.scene = scene.id WHERE "
             "\"oscillator.mass\" > 0;'}\n");
  case_error err = {{0}};
  assert_int_equal(study_claims_check(s, &err), HC_OK);
  study_free(s);
}

/* A result survives packing. */
static void results_travel(CHECK_STATE)
{
  study *s =
      good_study("study: t\n" CASE "run: frf\nset: {compare.omega: [4, 5]}\nvary: [{oscillator.mass: [1, 2, 3]}]\n");
  size_t size;
  CHECK_FILLED(study_result, r, study_solve(s, 1, NULL, &r));
  assert_int_equal(r.n_rows, 2);
  CHECK_MADE(char, packed, study_result_pack(&r, &packed, &size));
  CHECK_FILLED(study_result, back, study_result_unpack(packed, size, &back));
  assert_int_equal(back.id, 1);
  assert_memory_equal(back.rows, r.rows, 2 * (size_t)r.n_columns * sizeof *r.rows);
  assert_memory_equal(back.curve, r.curve, sizeof r.curve);
  study_result_clear(&back);
  assert_int_equal(study_result_unpack(packed, size - 1, &back), HC_BAD_INPUT);
  study_result_clear(&r);
  free(packed);
  study_free(s);
}

static int make_folder(void **state)
{
  const int failed = folder_make(state);
  snprintf(file, sizeof file, "%s/r.sqlite", folder);
  return failed;
}

CHECK_TESTS_WITH("study.store", 60, make_folder, folder_remove, scenes_are_kept_once, others_are_refused,
                 foreign_files_are_refused, damaged_files_are_refused, places_that_cannot_be, claims_only_read,
                 results_travel)
