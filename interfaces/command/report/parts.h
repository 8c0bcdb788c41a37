/* parts.h - private to interfaces/command/report/: what the files of the page have from each other. */
#pragma once

#include <jansson.h>
#include <math.h>
#include <stddef.h>

#include "interfaces/command/report/report.h"

/* null for what is no number */
static inline json_t *json_finite(double value) { return isfinite(value) ? json_real(value) : json_null(); }

/* ---- assets.c: the parts of the page that are built into the program, as bytes (embed.cmake makes the source) ---- */

typedef struct asset {
  const unsigned char *bytes;
  size_t length;
} asset;

extern const unsigned char asset_page_bytes[], asset_style_bytes[], asset_script_bytes[], asset_chart_bytes[];
/* page.html, page.css */
extern const asset asset_page, asset_style;
/* plots.js to start.js, in the order of CMakeLists.txt: one script */
extern const asset asset_script;
/* Chart.js with its licence notice; length 0: it was not installed */
extern const asset asset_chart;

/* ---- words.c: the verdict and its reasons in words a person can act on, as HTML ---- */

void words_verdict(const report_data *d, FILE *to);    /* does it agree, in a sentence; how many of each verdict */
void words_what_to_do(const report_data *d, FILE *to); /* worst point; harmonics and samples that suffice */
void words_gate(const report_data *d, FILE *to);       /* table: allowed, worst found, where */

/* Where the amplitudes of one motion differ most [rad/time]; NaN: nothing was compared. */
double words_worst_omega(const report_data *d);

/* As the comparison's curve was solved: with numbers where the scene says auto. */
static inline hbm_settings report_settings(const scene *sc, const comparison *c)
{
  hbm_settings how = sc->hbm;
  if (how.harmonics == HBM_AUTO) how.harmonics = c->harmonics;
  if (how.samples == HBM_AUTO && c->samples > 0) how.samples = c->samples;
  return how;
}

/* ---- structure.c: what the page shows of a structure alone: how all of it moves, and what each contact does ---- */

/* JSON null for one degree of freedom, else, read by structure.js,
 *     {names: of the responses; responses: `others` of report.c; dofs, contacts: names;
 *      solutions: [{omega, branch, stable (1, 0, -1), amplitude, cosine, sine: [n] of harmonic 1;
 *                   loops: [{of: "T over u", "N over v" or "T_2 over T_1", x, y, work}] of the contacts}]}
 * of the HBM solutions at the comparison's frequencies, some of them where there are many. Loops are of the exact law
 * along the solution. HC_INTERRUPTED, HC_NO_MEMORY, or why there is no model. */
hc_status structure_json(const scene *sc, const comparison *c, json_t *others, const hc_monitor *monitor, json_t **out);

/* ---- aliasing.c: the answers that the page's section on aliasing chooses among: for each normal stiffness, H and
 * omega
 *
 *     the HBM solution X with exact forces and largest amplitude, its force over the period, the true harmonics F;
 *     for each N the harmonics that N samples of X's force give (aft.c), sampled minus true; the first true ones that
 *     fold onto them, F_h sampled = F_h + sum_m conj(F_{mN-h}) + F_{mN+h}; the sampled equations' own solution ---- */

enum { ALIASING_MOST_OMEGAS = 4 };

/* The answers at omega[n_omega], n_omega <= ALIASING_MOST_OMEGAS, as JSON into *out, read by aliasing.js; with another
 * stiffness than the case's at omega[first] alone, which is shown first. By so many threads, with the same answers
 * whatever their number; only the calling one ticks *monitor. HC_INTERRUPTED, HC_NO_MEMORY: *out is NULL. */
hc_status aliasing_answers(const scene *sc, int n_omega, const double *omega, int first, int jobs,
                           const hc_monitor *monitor, json_t **out);
