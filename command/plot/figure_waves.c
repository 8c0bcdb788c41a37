/* figure_waves.c - the motion over a period at one frequency; a figure of transient. */
#include <math.h>

#include "base/constants.h"
#include "casefile/scene.h"
#include "command/plot/curve.h"
#include "command/plot/panels.h"

enum { MOST_WAVES = 12 };

static bool has_wave(const steady_row *r)
{
  return r->response == 0 && r->stage == STEADY_TRANSIENT &&
         (r->status == HC_OK || r->status == HC_NOT_SETTLED || r->status == HC_APERIODIC);
}

static void write_wave(figure *g, int n, const timeint_result *r)
{
  char name[24];
  snprintf(name, sizeof name, "wave%d", n);
  figure_block(g, name);
  for (int i = 0; i <= TIMEINT_WAVE; ++i) figure_point(g, (double)i / TIMEINT_WAVE, r->wave[i % TIMEINT_WAVE]);
  figure_block_end(g);
}

/* Where contact j closes, if the motions pass there: x sin(alpha) + gap = 0. */
static bool closes_at(const scene *sc, int j, double low, double high, double *x)
{
  const moving_contact c = scene_moving_contact(&sc->contacts[j]);
  *x = c.cv[0] > 0 ? -c.law.gap / c.cv[0] : NAN;
  return *x >= low && *x <= high;
}

static void closing_items(figure *g, const scene *sc, double low, double high)
{
  char what[64], look[FIGURE_LOOK];
  double x;
  for (int j = 0; j < sc->n_contacts; ++j) {
    if (!closes_at(sc, j, low, high, &x)) continue;
    snprintf(what, sizeof what, "%.10g with lines", x);
    figure_item(g, what, figure_look(g, "lw 1 dt 3 lc rgb '#777777'", 7, look), "contact %d closes above", j);
  }
}

hc_status panels_waves(plot_order *p, const scene *sc, const steady_states *found)
{
  figure g = {0};
  char name[64], of[RESPONSE_NAME], about[160], look[FIGURE_LOOK], word[24];
  double omega = found->rows[0].result.omega, low = INFINITY, high = -INFINITY;
  int n = 0;
  hc_status st = figure_open(&g, p, 800, 500);
  if (st != HC_OK) return figure_close(&g, st);
  for (int i = 0; i < found->n && n < MOST_WAVES; ++i) {
    const steady_row *r = &found->rows[i];
    if (!has_wave(r)) continue;
    write_wave(&g, n++, &r->result);
    low = fmin(low, r->result.min);
    high = fmax(high, r->result.max);
  }
  snprintf(about, sizeof about, "steady state at %s%.8g %s/%s, period T = %.6g %s",
           sc->in_cycles ? "" : "ω = ", scene_frequency(sc, omega), sc->in_cycles ? "cycles" : "rad", sc->unit_time,
           TWO_PI / omega, sc->unit_time);
  figure_title(&g, "set title", sc->title, about);
  curve_response_name(sc, 0, of);
  figure_set(&g, "ylabel", "%s [%s]", of, sc->unit_length);
  figure_below(&g, "t / T");
  figure_script(&g, "set xrange [0:1]\n");
  n = 0;
  for (int i = 0; i < found->n && n < MOST_WAVES; ++i) {
    const steady_row *r = &found->rows[i];
    if (!has_wave(r)) continue;
    snprintf(name, sizeof name, "$wave%d using 1:2 with lines", n);
    figure_item(&g, name, figure_line(&g, n, 2, look), "start: %s; %s", r->start, steady_verdict_text(r, word));
    ++n;
  }
  closing_items(&g, sc, low, high);
  figure_draw(&g);
  return figure_close(&g, HC_OK);
}
