/* scene_runs.h - the runs of compare/ on a scene, for tests that have one in hand: set up, run, cleared. */
#pragma once

#include "compare/accuracy/accuracy.h"
#include "compare/gate/gate.h"
#include "compare/study/scene_solvers.h"
#include "compare/verify/verify.h"
#include "tests/case_scene.h"

#define SCENE_RUN(call)                                                                                                \
  compare_setup setup;                                                                                                 \
  hc_status st = scene_setup(sc, &setup);                                                                              \
  if (st == HC_OK) st = (call);                                                                                        \
  scene_setup_clear(&setup);                                                                                           \
  return st

static inline hc_status scene_comparison_run(const scene *sc, const hc_monitor *monitor, comparison *out)
{
  SCENE_RUN(comparison_run(&setup, monitor, out));
}

static inline hc_status scene_accuracy_run(const scene *sc, const comparison *c, const hc_monitor *monitor, accuracy *a)
{
  SCENE_RUN(accuracy_run(&setup, c, monitor, a));
}

static inline hc_status scene_order_of_regularisation(const scene *sc, const comparison *c, const hc_monitor *monitor,
                                                      order_row *out)
{
  SCENE_RUN(order_of_regularisation(&setup, c, monitor, out));
}

static inline hc_status scene_verify_run(const scene *sc, const verify_data *data, const hc_monitor *monitor,
                                         verify_report *out)
{
  SCENE_RUN(verify_run(&setup, 1, data, NULL, monitor, out));
}

static inline hc_status scene_gate_judge(const char *name, const scene *sc, const comparison *c, gate_case *out)
{
  SCENE_RUN(gate_judge(name, &setup, c, out));
}
