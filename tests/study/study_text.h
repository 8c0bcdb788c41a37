/* study_text.h - a study from text, by way of a file in a folder of the test's own. */
#pragma once

#include "compare/study/study.h"
#include "tests/folder.h"
#include "tests/oscillator.h"

/* A linear scene: cheap, and enough wherever the scene is beside the point. */
#define CASE                                                                                                           \
  "case: {oscillator: {mass: 1, damping: 0.4, stiffness: 40}, forcing: {amplitude: 1}, sweep: {omega: [3, 9]}}\n"
#define CONTACT_CASE                                                                                                   \
  "case: {oscillator: {mass: 1, damping: 0.4, stiffness: 40}, forcing: {amplitude: 1}, sweep: {omega: [3, 9]}, "       \
  "contacts: ["                                                                                                        \
  "{tangential_stiffness: 10, normal_stiffness: 20, friction: 0.3, angle_deg: 45}]}\n"

/* Read `text` with the assignments; NULL with the message in err. */
static inline study *study_from_text(const char *text, int n_set, const char *const *set, case_error *err)
{
  char path[64];
  study *s = NULL;
  folder_put("s.yaml", text);
  snprintf(path, sizeof path, "%s/s.yaml", folder);
  memset(err, 0, sizeof *err);
  hc_status st = study_read(path, n_set, set, &s, err);
  unlink(path);
  assert_true((st == HC_OK) == (s != NULL));
  assert_true((st == HC_OK) == (err->message[0] == 0));
  return s;
}

static inline study *good_study(const char *text)
{
  case_error err;
  study *s = study_from_text(text, 0, NULL, &err);
  if (!s) fail_msg("refused: %s\n%s", text, err.message);
  return s;
}
