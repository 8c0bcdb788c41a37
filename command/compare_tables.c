/* compare_tables.c - see compare_tables.h. */
#include "command/compare_tables.h"

#include <math.h>

#include "casefile/structure.h"

int compare_lists(const cli_common *common, const table_lists *lists, scene *sc)
{
  static const double most_samples = 1 << 24;
  for (int i = 0; i < lists->harmonics.n; ++i)
    if (lists->harmonics.v[i] != floor(lists->harmonics.v[i]) || lists->harmonics.v[i] > HBM_MAX_HARMONICS) {
      cli_message(common, "--harmonics: %g is not a whole number 1..%d", lists->harmonics.v[i], HBM_MAX_HARMONICS);
      return EXIT_USAGE;
    }
  for (int i = 0; i < lists->samples.n; ++i)
    if (lists->samples.v[i] != floor(lists->samples.v[i]) || lists->samples.v[i] < 3 ||
        lists->samples.v[i] > most_samples) {
      cli_message(common, "--samples: %g is not a whole number 3..%.0f", lists->samples.v[i], most_samples);
      return EXIT_USAGE;
    }
  if (lists->harmonics.n) sc->compare.harmonics = lists->harmonics;
  if (lists->samples.n) sc->compare.samples = lists->samples;
  return 0;
}

static void note_accuracy(table *t, const scene *sc, const accuracy *a)
{
  char of[RESPONSE_NAME];
  if (sc->structure) table_note(t, "by the response %s", structure_response_name(sc->structure, 0, of, sizeof of));
  table_note(
      t,
      "amplitude_error: largest over %d orbits of the exact transient at %d frequencies; missing: orbits no solution "
      "is next to",
      a->orbits, a->frequencies);
  if (isfinite(a->peak_amplitude))
    table_note(t, "peak: %.10g at %s, %s", a->peak_amplitude, scene_where(sc, a->peak_omega, (char[SCENE_WHERE]){0}),
               a->peak_by_orbit ? "of the exact transient's orbits"
                                : "of the curve with exact forces and most harmonics");
  table_note(
      t,
      "aliasing: against exact forces and the same H; false turning points: more than with exact forces and the same "
      "H");
}

hc_status compare_tables(const cli_common *common, const compare_setup *setup, const comparison *c,
                         const hc_monitor *monitor, table *out[2], accuracy *a)
{
  hc_status st = accuracy_run(setup, c, monitor, a);
  out[0] = cli_table(common, "Samples and truncation order", ROWS_ACCURACY);
  for (int i = 0; i < a->n_rows; ++i) cli_put_row(common, out[0], ROWS_ACCURACY, &a->rows[i]);
  note_accuracy(out[0], common->scene, a);
  out[1] = cli_table(common, "Observed orders", ROWS_ORDER);
  for (int i = 0; i < a->n_orders; ++i) cli_put_row(common, out[1], ROWS_ORDER, &a->orders[i]);
  table_note(out[1],
             "error ~ quantity^-order (regularisation^order), least squares over the asymptotic part of its envelope; "
             "spread: standard error");
  for (int i = 0; i < 2 && st != HC_OK; ++i) table_note(out[i], "INCOMPLETE: %s", hc_status_text(st));
  return st;
}
