/* test_memory.c - what a run takes is told beforehand within a factor of two, and said where it is much. */
#include <sys/resource.h>

#include "compare/memory.h"
#include "tests/scene_runs.h"
#include "tests/shell.h"

#if defined __SANITIZE_ADDRESS__ || defined __SANITIZE_THREAD__
enum { SANITIZED = 1 };
#else
enum { SANITIZED = 0 };
#endif

/* Runs in the order of what they take: a process knows of its children only the most that any of them took. */
static const struct run {
  const char *command, *name, *set[2];
  int code;
  bool said;
} runs[] = {{"frf", "bladed_disk", {"sweep.omega=[984,986]", NULL}, 0, false},
            {"frf", "blade_damper", {"sweep.frequency=[255,256]", "hbm.harmonics=3"}, 0, false},
            {"compare", "bladed_disk", {"sweep.omega=[984,986]", "compare.omega=[985]"}, 1, false},
            {"frf", "blade_damper_120", {"sweep.frequency=[255,255.5]", NULL}, 0, true}};

static double told(const struct run *r)
{
  char name[64];
  snprintf(name, sizeof name, "structures/%s", r->name);
  scene sc = case_scene(name, r->set[1] ? 2 : 1, r->set);
  CHECK_FILLED(compare_setup, setup, scene_setup(&sc, &setup));
  const double bytes =
      strcmp(r->command, "frf") ? memory_of_comparison(&setup) : memory_of_curve(setup.model, &setup.hbm);
  scene_setup_clear(&setup);
  case_clear(&sc);
  return bytes;
}

static void memory_is_foretold(CHECK_STATE)
{
  static char out[1 << 16];
  for (size_t i = 0; i < sizeof runs / sizeof *runs; ++i) {
    const struct run *r = &runs[i];
    char line[512];
    snprintf(line, sizeof line, "%s %s cases/structures/%s.yaml --set '%s' %s%s%s 2>&1", HBMCHECK_COMMAND, r->command,
             r->name, r->set[0], r->set[1] ? "--set '" : "", r->set[1] ? r->set[1] : "", r->set[1] ? "'" : "");
    shell_check(line, shell_read(line, out, sizeof out), out, r->code, r->said ? "takes about 0.2" : "");
    if (!r->said && strstr(out, "GB of memory")) fail_msg("%s: %.200s", line, out);
    CHECK_FILLED(struct rusage, used, getrusage(RUSAGE_CHILDREN, &used));
    const double taken = 1024.0 * (double)used.ru_maxrss, expected = told(r);
    if (SANITIZED) continue; /* which takes memory of its own */
    if (!(taken <= 2 * expected && expected <= 2 * taken))
      fail_msg("%s: %.0f MB expected, %.0f MB taken", line, 1e-6 * expected, 1e-6 * taken);
  }
}

CHECK_TESTS("command.memory", 300, memory_is_foretold)
