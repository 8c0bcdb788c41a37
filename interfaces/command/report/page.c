/* page.c - the page: page.html with its {{names}} filled in. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "compare/motion.h"
#include "interfaces/command/report/html.h"
#include "interfaces/command/report/parts.h"
#include "model/modes.h"

typedef struct page {
  const report_data *d;
  const report_origin *origin;
  FILE *to;
  hc_status status;
} page;

/* ---- plain pieces ---------------------------------------------------------------------------- */

static void write_title(page *p) { html_text(p->to, p->d->sc->title[0] ? p->d->sc->title : "untitled case"); }

/* "3.9.1" from the notice that Chart.js begins with. */
static void write_chart_version(page *p)
{
  static const char before[] = "Chart.js v";
  char notice[256] = {0};
  memcpy(notice, asset_chart.bytes, asset_chart.length < sizeof notice - 1 ? asset_chart.length : sizeof notice - 1);
  const char *at = strstr(notice, before);
  if (at) fprintf(p->to, "%.*s", (int)strspn(at + strlen(before), "0123456789."), at + strlen(before));
}

static void pass_case(page *p, void (*write)(FILE *to, const char *text))
{
  const hc_status st = html_case(p->to, p->d->sc, write);
  if (st != HC_OK && p->status == HC_OK) p->status = st;
}

static void write_case(page *p) { pass_case(p, html_text); }

/* The case as a file in the address of a lab.html that lies beside the page, which takes it from there
 * (interfaces/lab/page/state.js). It opens where both sides differ most. The lab has no structures. */
static void write_lab_address(page *p)
{
  if (!scene_is_oscillator(p->d->sc)) return;
  const double omega = words_worst_omega(p->d);
  fputs("lab.html#case=", p->to);
  pass_case(p, html_percent);
  if (isfinite(omega)) fprintf(p->to, "&amp;omega=%.10g", omega);
}

/* ---- tables ---------------------------------------------------------------------------------- */

static void write_budget(page *p)
{
#define HEAD(part) "from_" #part,
  const char *const heads[] = {"omega",
                               p->d->sc->in_cycles ? "frequency" : NULL,
                               "branch",
                               !scene_is_oscillator(p->d->sc) ? "response" : NULL,
                               "verdict",
                               "hbm_amplitude",
                               "transient_amplitude",
                               "amplitude_error",
                               BUDGET_PARTS(HEAD) "sum",
                               "from_history"};
#undef HEAD
  html_table(p->to,
             "Verdict and error budget of the amplitude, relative; bars: 1e-12 to 1, logarithmic; red: beyond the gate",
             sizeof heads / sizeof *heads, heads);
  for (int i = 0; i < p->d->comparison.n_rows; ++i) {
    const comparison_row *r = &p->d->comparison.rows[i];
    char text[24];
    const budget_parts *b = &r->budget.amplitude;
    html_row(p->to);
    html_cell_number(p->to, r->omega);
    if (p->d->sc->in_cycles) html_cell_number(p->to, scene_frequency(p->d->sc, r->omega));
    html_cell_number(p->to, r->branch >= 0 ? r->branch : NAN);
    if (!scene_is_oscillator(p->d->sc)) html_cell_text(p->to, r->response_name);
    html_cell_text(p->to, comparison_verdict_text(r, text));
    html_cell_number(p->to, r->branch >= 0 && r->hbm_status == HC_OK ? r->hbm.amplitude : NAN);
    html_cell_number(p->to, motion_is_measured(r->transient_status) ? r->transient.amplitude : NAN);
    html_cell_bar(p->to, r->errors.amplitude, comparison_one_orbit(r) ? p->d->sc->gate.most.amplitude : INFINITY);
#define BAR(part) html_cell_bar(p->to, b->part, p->d->sc->gate.most.amplitude);
    BUDGET_PARTS(BAR)
#undef BAR
    html_cell_bar(p->to, r->budget.known ? b->sum : NAN, p->d->sc->gate.most.amplitude);
    html_cell_bar(p->to, band_from_history(&r->band, r->hbm.amplitude), p->d->sc->gate.most.amplitude);
    html_row_end(p->to);
  }
  html_table_end(p->to);
}

/* A long table is closed until it is asked for. */
static void write_specials(page *p)
{
  enum { MOST_OPEN = 12 };
  size_t i;
  const json_t *special;
  const json_t *list = json_object_get(p->d->response, "specials");
  const size_t n = json_array_size(list);
  if (n == 0) {
    fputs("<p>Nothing special happens on the curve.</p>\n", p->to);
    return;
  }
  fprintf(p->to, "<details%s><summary>What happens on the curve, %zu</summary>\n", n <= MOST_OPEN ? " open" : "", n);
  html_table(p->to, "What happens on the curve, in its order", 5,
             (const char *const[]){"what", "omega", p->d->sc->in_cycles ? "frequency" : NULL, "amplitude", "branch"});
  json_array_foreach(list, i, special)
  {
    html_row(p->to);
    html_cell_text(p->to, json_string_value(json_object_get(special, "what")));
    double omega = json_number_value(json_object_get(special, "omega"));
    fprintf(p->to, "<td>%.10f</td>", omega);
    if (p->d->sc->in_cycles) fprintf(p->to, "<td>%.10f</td>", scene_frequency(p->d->sc, omega));
    html_cell_number(p->to, json_number_value(json_object_get(special, "amplitude")));
    html_cell_number(p->to, (double)json_integer_value(json_object_get(special, "branch")));
    html_row_end(p->to);
  }
  html_table_end(p->to);
  fputs("</details>\n", p->to);
}

/* ---- the structure --------------------------------------------------------------------------- */

/* For page.css: what is of one degree of freedom alone, or of several, is shown for that alone. */
static void write_kind(page *p) { fputs(!scene_is_oscillator(p->d->sc) ? "structure" : "oscillator", p->to); }

/* omega or frequency as the case has it, and damping of one limit. */
static void write_mode(page *p, const model_mode *mode)
{
  html_cell_number(p->to, p->d->sc->in_cycles ? scene_frequency(p->d->sc, mode->omega) : mode->omega);
  html_cell_number(p->to, mode->damping);
}

static void write_modes(page *p)
{
  const model *m = p->d->setup.model;
  const bool cycles = p->d->sc->in_cycles;
  const char *const heads[] = {"mode", cycles ? "frequency_open" : "omega_open", "damping_open",
                               cycles ? "frequency_stuck" : "omega_stuck", "damping_stuck"};
  if (scene_is_oscillator(p->d->sc)) return;
  model_mode *open = calloc(2 * (size_t)m->n, sizeof *open);
  hc_status st = open ? model_mode_list(m, false, open) : HC_NO_MEMORY;
  if (st == HC_OK) st = model_mode_list(m, true, open + m->n);
  html_table(p->to, "Modes, contacts open and contacts stuck; damping of critical", 5, heads);
  for (int i = 0; i < m->n && st == HC_OK; ++i) {
    html_row(p->to);
    html_cell_number(p->to, i + 1);
    write_mode(p, &open[i]);
    write_mode(p, &open[m->n + i]);
    html_row_end(p->to);
  }
  html_table_end(p->to);
  free(open);
  if (st == HC_NO_MEMORY) p->status = st;
  else if (st != HC_OK) html_printf(p->to, "The modes were not found: %s.", hc_status_text(st));
}

/* ---- data for the plots ---------------------------------------------------------------------- */

static json_t *budget_json(const comparison *c)
{
  json_t *list = json_array();
  for (int i = 0; i < c->n_rows; ++i) {
    const comparison_row *r = &c->rows[i];
    if (!r->budget.known) continue;
    json_t *row = json_pack("{s:f, s:i, s:o}", "omega", r->omega, "branch", r->branch, "sum",
                            json_finite(r->budget.amplitude.sum));
    if (r->response > 0) json_object_set_new(row, "response", json_integer(r->response));
#define PUT(part) json_object_set_new(row, #part, json_finite(r->budget.amplitude.part));
    BUDGET_PARTS(PUT)
#undef PUT
    json_array_append_new(list, row);
  }
  return list;
}

static json_t *accuracy_json(const accuracy *a)
{
  json_t *list = json_array();
  for (int i = 0; i < a->n_rows; ++i) {
    const accuracy_row *r = &a->rows[i];
    json_array_append_new(list, json_pack("{s:i, s:i, s:o, s:o, s:o, s:i}", "harmonics", r->harmonics, "samples",
                                          r->samples, "amplitude_error", json_finite(r->worst), "aliasing",
                                          json_finite(r->aliasing), "peak_error", json_finite(r->peak_error),
                                          "false_turning_points", r->false_turning_points));
  }
  return list;
}

static void write_data(page *p)
{
  const scene *sc = p->d->sc;
  json_t *data =
      json_pack("{s:{s:s, s:s, s:s}, s:b, s:f, s:O, s:O, s:O, s:o, s:o}", "units", "length", sc->unit_length, "force",
                sc->unit_force, "time", sc->unit_time, "cycles", (int)sc->in_cycles, "gate", sc->gate.most.amplitude,
                "response", p->d->response, "structure", p->d->structure, "aliasing", p->d->aliasing, "budget",
                budget_json(&p->d->comparison), "accuracy", accuracy_json(&p->d->accuracy));
  if (!data || html_json(p->to, data) != HC_OK) p->status = HC_NO_MEMORY;
  json_decref(data);
}

/* ---- the page ------------------------------------------------------------------------------- */

/* A piece is written by a function, or it is words, an asset, a text of where the page is from, or a table of rows. */
static const struct piece {
  const char *name;
  void (*write)(page *p);
  void (*words)(const report_data *d, FILE *to);
  const asset *asset;
  size_t origin; /* 1 + its place in report_origin */
} pieces[] = {
    {"title", write_title},
    {"style", .asset = &asset_style},
    {"script", .asset = &asset_script},
    {"chart", .asset = &asset_chart},
    {"settings", .origin = 1 + offsetof(report_origin, settings)},
    {"command", .origin = 1 + offsetof(report_origin, command)},
    {"versions", .origin = 1 + offsetof(report_origin, versions)},
    {"verdict", .words = words_verdict},
    {"advice", .words = words_what_to_do},
    {"gate", .words = words_gate},
    {"case", write_case},
    {"budget", write_budget},
    {"specials", write_specials},
    {"data", write_data},
    {"chart_version", write_chart_version},
    {"kind", write_kind},
    {"modes", write_modes},
    {"lab_command", .origin = 1 + offsetof(report_origin, lab)},
    {"lab_address", write_lab_address},
};

static void write_piece(page *p, const char *name, size_t length)
{
  static const char *const without[] = {"seconds", NULL}; /* the same input is to give the same page */
  const report_data *d = p->d;
  const struct row_table {
    const char *name, *caption;
    rows_kind kind;
    int n;
    const void *rows;
  } tables[] = {
      {"compare", "Every column, as hbmcheck compare prints it", ROWS_COMPARE, d->comparison.n_rows,
       d->comparison.rows},
      {"accuracy", "Samples and truncation order: errors relative to the exact transient's orbits", ROWS_ACCURACY,
       d->accuracy.n_rows, d->accuracy.rows},
      {"orders", "Observed orders: error ~ quantity^-order (regularisation^order)", ROWS_ORDER, d->accuracy.n_orders,
       d->accuracy.orders},
      {"contacts", "Contacts over one period, on both sides; work: what friction dissipates", ROWS_COMPARE_CONTACT,
       d->comparison.n_contacts, d->comparison.contacts},
      {"proofs", "Proven orbits next to the solutions, and bounds of HBM's error (hbmcheck prove)", ROWS_PROVE,
       d->proofs.n, d->proofs.rows},
  };
  for (size_t i = 0; i < sizeof tables / sizeof *tables; ++i) {
    const struct row_table *t = &tables[i];
    if (strlen(t->name) != length || memcmp(t->name, name, length) != 0) continue;
    const bool shown =
        t->kind == ROWS_PROVE ? t->n > 0 : t->kind != ROWS_COMPARE_CONTACT || !scene_is_oscillator(d->sc);
    if (shown)
      html_rows(p->to, t->caption, t->kind,
                (d->sc->in_cycles ? ROWS_IN_CYCLES : 0u) | (!scene_is_oscillator(d->sc) ? ROWS_RESPONSES : 0u), t->n,
                t->rows, without);
    return;
  }
  for (size_t i = 0; i < sizeof pieces / sizeof *pieces; ++i) {
    const struct piece *q = &pieces[i];
    if (strlen(q->name) != length || memcmp(q->name, name, length) != 0) continue;
    if (q->write) q->write(p);
    if (q->words) q->words(d, p->to);
    if (q->asset) fwrite(q->asset->bytes, 1, q->asset->length, p->to);
    if (q->origin) html_text(p->to, *(const char *const *)((const char *)p->origin + q->origin - 1));
    return;
  }
  p->status = HC_BUG; /* page.html names a piece that is not there */
}

hc_status report_write(const report_data *d, const report_origin *origin, FILE *to)
{
  page p = {d, origin, to, HC_OK};
  const char *at = (const char *)asset_page.bytes, *open, *close; /* an asset ends in a zero beyond its length */
  while ((open = strstr(at, "{{")) && (close = strstr(open, "}}"))) {
    fwrite(at, 1, (size_t)(open - at), to);
    write_piece(&p, open + 2, (size_t)(close - open - 2));
    at = close + 2;
  }
  fputs(at, to);
  return ferror(to) ? HC_IO : p.status;
}
