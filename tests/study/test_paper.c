/* test_paper.c - the shipped studies: every file reads, every query runs, every verdict on the paper is the expected
 * one; the quick ones give it here (those that tests/hbm/test_paper.c settles), all in study.paper_verdicts, slow. */
#include <dirent.h>
#include <sys/wait.h>

#include "compare/study/store.h"
#include "tests/check.h"

static int check_file(const char *folder, const char *name)
{
  char path[512];
  const char *dot = strrchr(name, '.');
  if (!dot || strcmp(dot, ".yaml")) return 0;
  snprintf(path, sizeof path, "%s/%s", folder, name);
  study *s = NULL;
  case_error err = {{0}};
  hc_status st = study_read(path, 0, NULL, &s, &err);
  if (st == HC_OK) st = study_claims_check(s, &err);
  if (st != HC_OK) fail_msg("%s", err.message);
  assert_true(s->n_claims > 0);
  /* A claim may tell only; one on the paper must say what it expects, so that no verdict changes unseen. */
  for (int i = 0; i < s->n_claims; ++i) {
    assert_non_null(s->claims[i].source.text);
    for (int k = STUDY_PAPER; k < STUDY_ANSWERS; ++k)
      if (s->claims[i].answers[k].holds.text && s->claims[i].answers[k].expect == STUDY_EXPECT_NOTHING)
        fail_msg("%s:%zu: %s: nothing is expected", path, s->claims[i].answers[k].holds.line, s->claims[i].says.text);
  }
  for (long id = 0; id < s->n_scenes; ++id) {
    scene sc;
    if (study_scene(s, id, &sc, &err) != HC_OK) fail_msg("%s, scene %ld: %s", path, id, err.message);
    case_clear(&sc);
  }
  study_free(s);
  return 1;
}

static int check_folder(const char *folder)
{
  int n = 0;
  DIR *d = opendir(folder);
  assert_non_null(d);
  for (struct dirent *e; (e = readdir(d)) != NULL;) n += check_file(folder, e->d_name);
  closedir(d);
  return n;
}

static void every_shipped_study_can_be_run(CHECK_STATE)
{
  assert_int_equal(check_folder(SOURCE_DIR "/cases/paper/studies"),
                   20); /* figures 7 to 18 and 20, sections 2 and 5, five guidelines */
  assert_true(check_folder(SOURCE_DIR "/cases/studies") >= 1);
}

/* Exit 1 would say that a claim is not as the file expects it. */
static void the_quick_ones_are_as_expected(CHECK_STATE)
{
  static const char *const quick[] = {"fig07",         "fig08",         "fig11_table04", "fig13_table06",
                                      "fig14_table07", "fig15_table08", "section2",      "guideline1"};
  char line[4096];
  int used = snprintf(line, sizeof line, "cd %s/cases/paper/studies && %s study -q --results :memory:", SOURCE_DIR,
                      HBMCHECK_COMMAND);
  for (size_t i = 0; i < sizeof quick / sizeof *quick; ++i)
    used += snprintf(line + used, sizeof line - (size_t)used, " %s.yaml", quick[i]);
  assert_true(used < (int)sizeof line);
  int status = system(line);
  assert_true(WIFEXITED(status));
  assert_int_equal(WEXITSTATUS(status), 0);
}

CHECK_TESTS("study.paper", 300, every_shipped_study_can_be_run, the_quick_ones_are_as_expected)
