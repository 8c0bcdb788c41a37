/* words.c - see parts.h. */
#include "interfaces/command/report/parts.h"

#include <math.h>

#include "interfaces/command/report/html.h"

/* "omega = 7", or with the frequency where the sweep is in cycles. */
static void write_where(const report_data *d, double omega, FILE *to)
{
  char text[SCENE_WHERE];
  html_text(to, scene_where(d->sc, omega, text));
}

static void open_item(FILE *to, const char *class) { fprintf(to, "<li class=\"%s\">", class); }

/* What was not compared though it might seem so. */
static void list_remarks(const report_data *d, FILE *to)
{
  const comparison *c = &d->comparison;
  int n = 0;
  for (int i = 0; i < c->n_rows; ++i) n += comparison_mean_free(&c->rows[i]);
  if (n)
    fprintf(to,
            "<p>%d row%s without a mean to compare (<code>mean_free</code>): a slider that never slips rests where the "
            "history left it, and the mean, max, min and rms with it.</p>\n",
            n, n == 1 ? "" : "s");
  if (c->n_rows == 0 || comparison_nonlinear(c)) return;
  fputs("<p class=\"verdict open\"><strong>Linear.</strong> ", to);
  html_printf(to, COMPARISON_LINEAR, c->n_rows);
  fputs("</p>\n", to);
}

void words_verdict(const report_data *d, FILE *to)
{
  const comparison *c = &d->comparison;
  int code = comparison_exit_code(c), missing = 0;
  static const char *const classes[] = {"good", "bad"};
  static const char *const heads[] = {"They agree.", "They do not agree.", "Not everything could be compared."};
  static const char *const tails[] = {
      " At every frequency the transient is within the gate of a harmonic-balance solution.",
      " At least one transient is not a harmonic-balance solution within the gate.",
      " What is said below holds for what was compared."};
  int which = code == 0 ? 0 : code == 1 ? 1 : 2;
  for (int i = 0; i < c->n_rows; ++i) missing += comparison_unaccounted(&c->rows[i]);
  fprintf(to, "<p class=\"verdict %s\"><strong>%s</strong>%s</p>\n", which == 2 ? "open" : classes[which], heads[which],
          tails[which]);
  if (missing)
    fprintf(to, "<p>%d transient%s no solution of this response curve within the gate.</p>\n", missing,
            missing == 1 ? " matches" : "s match");
  if (c->curve.end != HC_OK && c->curve.n) {
    fputs("<p class=\"verdict open\">The response curve <strong>stopped</strong> at ", to);
    write_where(d, c->curve.ends_at, to);
    fputs(": ", to);
    html_text(to, hc_status_text(c->curve.end));
    fputs(".</p>\n", to);
  }
  list_remarks(d, to);
  fputs("<ul class=\"verdicts\">\n", to);
  for (int v = 0; v < VERDICT_COUNT; ++v) {
    if (!c->count[v]) continue;
    fprintf(to, "<li><b>%d</b> <code>%s</code>: ", c->count[v], verdict_name((verdict)v));
    html_text(to, verdict_meaning((verdict)v));
    fputs("</li>\n", to);
  }
  fputs("</ul>\n", to);
}

/* ---- what to do ------------------------------------------------------------------------------ */

static void advise_on_harmonics(const report_data *d, FILE *to)
{
  const accuracy *a = &d->accuracy;
  const double limit = d->sc->gate.most.amplitude;
  const int kept = d->comparison.harmonics;
  const accuracy_row *last = NULL, *row = NULL;
  /* the row of the fewest harmonics of the table from which on the truncation is within the limit */
  for (int i = a->n_rows - 1; i >= 0; --i) {
    if (a->rows[i].samples) continue;
    if (!(a->rows[i].worst <= limit) || a->rows[i].missing) break;
    row = &a->rows[i];
  }
  if (!d->sc->hbm.keep_mean)
    fputs(
        "<li class=\"bad\">Harmonic 0 is left out (hbm.static: false): that solves another equation, and no number of "
        "harmonics mends it.</li>\n",
        to);
  for (int i = 0; i < a->n_rows; ++i)
    if (a->rows[i].samples == 0) last = &a->rows[i];
  if (!last) return;
  open_item(to, row && kept >= row->harmonics ? "good" : kept > last->harmonics ? "open" : "bad");
  html_printf(to, "Harmonics: %d kept. ", kept);
  if (row)
    html_printf(
        to, "Of those tried, H >= %d keeps the amplitude within %.3g %% of the exact transient's (H = %d: %.2g %%).",
        row->harmonics, 100 * limit, row->harmonics, 100 * row->worst);
  else
    html_printf(
        to,
        "None of those in the tables keeps the amplitude within %.3g %% of the exact transient's (H = %d: %.2g %%).",
        100 * limit, last->harmonics, 100 * last->worst);
  if (!row && last->missing)
    html_printf(to, " %d of %d orbits have no solution next to them.", last->missing, a->orbits);
  fputs("</li>\n", to);
}

/* For the H next to the one kept: the fewest samples from which on aliasing stays below the limit. */
static void advise_on_samples(const report_data *d, FILE *to)
{
  const accuracy *a = &d->accuracy;
  const accuracy_row *plain = NULL, *enough = NULL, *most = NULL;
  for (int i = 0; i < a->n_rows; ++i)
    if (a->rows[i].samples == 0 && (!plain || a->rows[i].harmonics <= d->comparison.harmonics)) plain = &a->rows[i];
  if (!plain) return;
  for (int i = a->n_rows - 1; i >= 0; --i) {
    const accuracy_row *r = &a->rows[i];
    if (r->harmonics != plain->harmonics || r->samples == 0) continue;
    if (!most) most = r;
    if (!r->possible || !(r->aliasing <= d->sc->gate.most.amplitude) || r->missing > plain->missing) break;
    enough = r;
  }
  if (!most) return;
  const bool sampled = d->sc->hbm.force == HBM_FORCE_SAMPLED;
  open_item(to, !sampled || (enough && d->comparison.samples >= enough->samples) ? "good" : "bad");
  if (!enough)
    html_printf(to, "Sampling: not even %d samples a period are enough at H = %d (aliasing %.2g %%): %s.",
                most->samples, plain->harmonics, 100 * most->aliasing,
                sampled ? "use exact forces" : "the exact forces in use need none");
  else
    html_printf(to, "Sampling: %d samples a period are enough at H = %d (aliasing %.2g %%); exact forces need none.",
                enough->samples, plain->harmonics, 100 * enough->aliasing);
  if (enough && enough->false_turning_points)
    html_printf(to, " But the curve sampled so has %d turning points that are not the oscillator's%s.",
                enough->false_turning_points, sampled ? ": follow curves with exact forces" : "");
  if (sampled) html_printf(to, " In use: %d samples.", d->comparison.samples);
  fputs("</li>\n", to);
}

void words_what_to_do(const report_data *d, FILE *to)
{
  fputs("<ul class=\"advice\">\n", to);
  const comparison *c = &d->comparison;
  const comparison_row *top = comparison_worst(c, d->setup.limits);
  int unknown = 0;
  char text[COMPARISON_WORST_TEXT];
  for (int i = 0; i < c->n_rows; ++i) unknown += !c->rows[i].budget.known;
  if (top) {
    open_item(to, comparison_row_is_beyond(top, d->setup.limits) ? "bad" : "good");
    fputs("Largest error at ", to);
    write_where(d, top->omega, to);
    html_printf(to, ", branch %d: %s.", top->branch, comparison_worst_text(c, top, d->setup.limits, text));
    fputs("</li>\n", to);
  }
  if (unknown)
    fprintf(
        to,
        "<li class=\"open\">%d row%s without a budget: no periodic orbit was found next to the HBM solution.</li>\n",
        unknown, unknown == 1 ? "" : "s");
  advise_on_harmonics(d, to);
  advise_on_samples(d, to);
  if (d->tabled != HC_OK) {
    open_item(to, "open");
    html_printf(to, "The tables over H and N ended early: %s.", hc_status_text(d->tabled));
    fputs("</li>\n", to);
  }
  fputs("</ul>\n", to);
}

/* ---- the gate -------------------------------------------------------------------------------- */

enum { MEASURES = 4, MEAN = 2 };

typedef struct worst_errors {
  double error[MEASURES], omega[MEASURES]; /* NaN: not compared */
  bool mean_free;                          /* the mean of a row compared is a matter of history */
} worst_errors;

static worst_errors find_worst(const comparison *c)
{
  worst_errors w = {.error = {NAN, NAN, NAN, NAN}, .omega = {NAN, NAN, NAN, NAN}};
  for (int i = 0; i < c->n_rows; ++i) {
    const comparison_row *r = &c->rows[i];
    const double errors[] = {r->errors.amplitude, r->errors.harmonic_1, r->errors.mean, r->errors.waveform};
    /* elsewhere the two are not the same motion */
    if (!comparison_one_orbit(r)) continue;
    w.mean_free |= comparison_mean_free(r);
    for (int k = 0; k < MEASURES; ++k)
      if (errors[k] > w.error[k] || isnan(w.error[k])) w.error[k] = errors[k], w.omega[k] = r->omega;
  }
  return w;
}

double words_worst_omega(const report_data *d) { return find_worst(&d->comparison).omega[0]; }

static const char *within(const worst_errors *w, int k, double limit)
{
  if (isnan(w->error[k])) return k == MEAN && w->mean_free ? "not compared: a matter of history" : "not compared";
  return w->error[k] <= limit ? "yes" : "no";
}

void words_gate(const report_data *d, FILE *to)
{
  static const char *const names[] = {"amplitude", "harmonic_1", "mean", "waveform"};
  const discrepancy *most = &d->sc->gate.most;
  const double limits[] = {most->amplitude, most->harmonic_1, most->mean, most->waveform};
  const char *const heads[] = {"measure", "allowed", "largest found", d->sc->in_cycles ? "at frequency" : "at omega",
                               "within"};
  const worst_errors w = find_worst(&d->comparison);
  html_table(to, "The gate: largest relative error allowed and found, where both sides are on the same orbit", 5,
             heads);
  for (int k = 0; k < MEASURES; ++k) {
    html_row(to);
    html_cell_text(to, names[k]);
    html_cell_number(to, limits[k]);
    html_cell_bar(to, w.error[k], limits[k]);
    html_cell_number(to, d->sc->in_cycles ? scene_frequency(d->sc, w.omega[k]) : w.omega[k]);
    html_cell_text(to, within(&w, k, limits[k]));
    html_row_end(to);
  }
  html_table_end(to);
}
