/* solve.c - see study.h. A failure is put into words here, with the frequency, and is a result like any other. */
#include "compare/study/study.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "compare/response.h"
#include "compare/study/scene_solvers.h"
#include "model/casefile/structure.h"
#include "numerics/base/thread_clock.h"

rows_kind study_rows(const study *s)
{
  switch (s->kind) {
  case STUDY_FRF: return ROWS_FRF;
  case STUDY_TRANSIENT: return ROWS_TRANSIENT;
  default: return ROWS_COMPARE;
  }
}

unsigned study_extra_columns(const study *s)
{
  return (study_in_cycles(s) ? ROWS_IN_CYCLES : 0u) | (!scene_is_oscillator(&s->base) ? ROWS_RESPONSES : 0u);
}

/* The first failure is the one that is reported. omega <= 0: it is of no single frequency. */
static void fail_with(study_result *r, const char *what, hc_status st, double omega)
{
  if (r->failed) return;
  r->failed = true;
  if (omega > 0) snprintf(r->reason, sizeof r->reason, "%s at omega = %.10g: %s", what, omega, hc_status_text(st));
  else snprintf(r->reason, sizeof r->reason, "%s: %s", what, hc_status_text(st));
}

static hc_status make_rows(study_result *r, rows_kind kind, int n)
{
  table_column columns[ROWS_MOST];
  r->n_columns = rows_columns(kind, r->extra, columns);
  r->rows = calloc((size_t)n * (size_t)r->n_columns + 1, sizeof *r->rows);
  return r->rows ? HC_OK : HC_NO_MEMORY;
}

static row_cell *next_row(study_result *r) { return r->rows + (size_t)r->n_rows++ * (size_t)r->n_columns; }

static void put_curve(study_result *r, const response_summary *summary)
{
  r->has_curve = true;
  rows_cells(ROWS_CURVE, summary, r->extra, r->curve);
}

/* Name of response i into text[RESPONSE_NAME], as the column `response` has it; an oscillator's has none. */
static void name_response(const scene *sc, int i, char *text)
{
  if (!scene_is_oscillator(sc)) structure_response_name(sc->structure, i, text, RESPONSE_NAME);
}

static hc_status put_solutions(hbm_solver *s, const scene *sc, const hbm_curve *curve, study_result *r)
{
  hbm_curve found = {0};
  double failed_at = 0;
  hc_status at = response_at(s, curve, &sc->compare.omega, &found, &failed_at);
  hc_status st = make_rows(r, ROWS_FRF, found.n * structure_response_count(sc->structure));
  if (at == HC_NO_MEMORY) st = at; /* says nothing about the scene: it is not kept */
  else if (at != HC_OK) fail_with(r, "no solution", at, failed_at);
  for (int k = 0; k < found.n && st == HC_OK; ++k) {
    /* A row for each response of solution k. */
    const int n = structure_response_count(sc->structure);
    response_row row;
    hc_status one = response_row_of(s, &found, k, &row);
    for (int i = 0; i < n && one == HC_OK; ++i) {
      if (i > 0) one = response_row_turn(s, &found, k, i, &row);
      name_response(sc, i, row.response);
      if (one == HC_OK) rows_cells(ROWS_FRF, &row, r->extra, next_row(r));
    }
    if (one == HC_NO_MEMORY) st = one;
    else if (one != HC_OK) fail_with(r, "harmonic balance", one, found.points[k].omega);
  }
  hbm_curve_free(&found);
  return st;
}

static hc_status solve_frf(const scene *sc, const hc_monitor *monitor, study_result *r)
{
  hbm_solver *s = NULL;
  hbm_curve curve = {0};
  response_summary summary;
  double from, to;
  comparison_sweep(sc->omega_from, sc->omega_to, &sc->compare.omega, &from, &to);
  hc_status st = scene_hbm_solver(sc, &s);
  if (st == HC_OK) {
    st = hbm_trace(s, from, to, monitor, &curve);
    if (st != HC_INTERRUPTED && st != HC_NO_MEMORY) {
      if (st != HC_OK) fail_with(r, "the response curve stopped", st, curve.n ? curve.points[curve.n - 1].omega : from);
      st = response_summarise(s, &curve, &summary);
      put_curve(r, &summary);
      if (st == HC_OK) st = put_solutions(s, sc, &curve, r);
    }
  } else if (st != HC_NO_MEMORY) {
    fail_with(r, "harmonic balance", st, 0);
    st = HC_OK;
  }
  hbm_curve_free(&curve);
  hbm_solver_free(s);
  return st;
}

static hc_status solve_transient(const scene *sc, const hc_monitor *monitor, study_result *r)
{
  static const char *const stages[] = {[STEADY_TRANSIENT] = "time integration",
                                       [STEADY_SWEEP] = "the frequency sweep",
                                       [STEADY_HBM] = "harmonic balance"};
  steady_states found = {0};
  compare_setup setup;
  hc_status st = scene_setup(sc, &setup);
  if (st == HC_OK) st = steady_states_run(&setup, monitor, &found);
  scene_setup_clear(&setup);
  if (st == HC_BAD_INPUT && sc->compare.omega.n == 0) {
    r->failed = true;
    snprintf(r->reason, sizeof r->reason, "no frequencies: compare.omega is empty");
    st = HC_OK;
  } else if (st != HC_OK && st != HC_INTERRUPTED && st != HC_NO_MEMORY) {
    fail_with(r, "time integration", st, 0);
    st = HC_OK;
  }
  if (st == HC_OK) st = make_rows(r, ROWS_TRANSIENT, found.n);
  for (int i = 0; i < found.n && st == HC_OK; ++i) {
    steady_row *row = &found.rows[i];
    name_response(sc, row->response, row->response_name);
    if (row->stage == STEADY_TRANSIENT) rows_cells(ROWS_TRANSIENT, row, r->extra, next_row(r));
    if (row->status == HC_NO_MEMORY) st = row->status;
    else if (row->status != HC_OK) fail_with(r, stages[row->stage], row->status, row->result.omega);
  }
  steady_states_clear(&found);
  return st;
}

static hc_status solve_compare(const scene *sc, const hc_monitor *monitor, study_result *r)
{
  comparison c = {0};
  compare_setup setup;
  hc_status st = scene_setup(sc, &setup);
  if (st == HC_OK) st = comparison_run(&setup, monitor, &c);
  scene_setup_clear(&setup);
  if (st == HC_OK || (st != HC_INTERRUPTED && st != HC_NO_MEMORY)) {
    if (st != HC_OK) fail_with(r, "the comparison", st, 0);
    else put_curve(r, &c.summary);
    st = make_rows(r, ROWS_COMPARE, c.n_rows);
    for (int i = 0; i < c.n_rows && st == HC_OK; ++i) {
      name_response(sc, c.rows[i].response, c.rows[i].response_name);
      rows_cells(ROWS_COMPARE, &c.rows[i], r->extra, next_row(r));
    }
    for (int i = 0; i < c.n_rows; ++i) {
      const comparison_row *row = &c.rows[i];
      if (row->hbm_status != HC_OK) fail_with(r, "harmonic balance", row->hbm_status, row->omega);
      else if (row->transient_status != HC_OK) fail_with(r, "time integration", row->transient_status, row->omega);
    }
    if (c.curve.end != HC_OK) fail_with(r, "the response curve stopped", c.curve.end, c.curve.ends_at);
  }
  comparison_clear(&c);
  return st;
}

hc_status study_solve(const study *s, long id, const hc_monitor *monitor, study_result *out)
{
  scene sc;
  case_error err = {{0}};
  double start = thread_seconds();
  *out = (study_result){.id = id, .extra = study_extra_columns(s)};
  table_column columns[ROWS_MOST];
  out->n_columns = rows_columns(study_rows(s), out->extra, columns);
  hc_status st = study_scene(s, id, &sc, &err);
  if (st != HC_OK) {
    out->failed = true;
    snprintf(out->reason, sizeof out->reason, "%.*s", (int)sizeof out->reason - 1, err.message);
    return HC_OK;
  }
  if (s->kind == STUDY_FRF) st = solve_frf(&sc, monitor, out);
  else if (s->kind == STUDY_TRANSIENT) st = solve_transient(&sc, monitor, out);
  else st = solve_compare(&sc, monitor, out);
  out->seconds = thread_seconds() - start;
  case_clear(&sc);
  return st;
}

void study_result_clear(study_result *r)
{
  free(r->rows);
  r->rows = NULL;
  r->n_rows = 0;
}

hc_status study_result_pack(const study_result *r, char **packed, size_t *size)
{
  size_t rows = (size_t)r->n_rows * (size_t)r->n_columns * sizeof *r->rows;
  *size = sizeof *r + rows;
  if (!(*packed = malloc(*size))) return HC_NO_MEMORY;
  memcpy(*packed, r, sizeof *r);
  if (rows) memcpy(*packed + sizeof *r, r->rows, rows);
  return HC_OK;
}

hc_status study_result_unpack(const char *packed, size_t size, study_result *out)
{
  *out = (study_result){0};
  if (size < sizeof *out) return HC_BAD_INPUT;
  memcpy(out, packed, sizeof *out);
  out->rows = NULL;
  size_t rows = (size_t)out->n_rows * (size_t)out->n_columns * sizeof *out->rows;
  if (size != sizeof *out + rows) return HC_BAD_INPUT;
  if (!(out->rows = malloc(rows + 1))) return HC_NO_MEMORY;
  memcpy(out->rows, packed + sizeof *out, rows);
  return HC_OK;
}
