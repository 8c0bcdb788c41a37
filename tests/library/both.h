/* both.h - a structure's case as the public reads it and as the library has it inside, at one frequency of its own. */
#pragma once

#include "compare/comparison.h"
#include "compare/first_guess.h"
#include "compare/steady_states.h"
#include "interfaces/library/hbmcheck.h"
#include "model/casefile/case_file.h"
#include "tests/check.h"

#define FOLDER SOURCE_DIR "/cases/structures/"

typedef struct both {
  hbmcheck_case *c;
  scene sc;
  compare_setup setup;
} both;

/* In place: the settings point to the scene's limits. */
static void read_both(const char *path, double omega, both *b)
{
  char message[512];
  case_error err;
  if (hbmcheck_case_read(path, 0, NULL, message, sizeof message, &b->c) != HBMCHECK_OK) fail_msg("%s", message);
  assert_int_equal(case_read(path, 0, NULL, &b->sc, &err), HC_OK);
  b->sc.compare.omega = (number_list){1, {omega}};
  assert_int_equal(scene_setup(&b->sc, &b->setup), HC_OK);
}

static void free_both(both *b)
{
  hbmcheck_case_free(b->c);
  scene_setup_clear(&b->setup);
  case_clear(&b->sc);
}
