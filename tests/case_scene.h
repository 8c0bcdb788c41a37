/* case_scene.h - a case of cases/ as a scene, for tests. */
#pragma once

#include "model/casefile/case_file.h"
#include "tests/check.h"
#include "tests/oscillator.h"

/* The case of that name below cases/, with assignments; case_clear it, or keep it to the end of the program. */
static inline scene case_scene(const char *name, int n_set, const char *const *set)
{
  char path[256];
  scene sc;
  case_error err;
  snprintf(path, sizeof path, SOURCE_DIR "/cases/%s.yaml", name);
  if (case_read(path, n_set, set, &sc, &err) != HC_OK) fail_msg("%s", err.message);
  return scene_kept(sc);
}
