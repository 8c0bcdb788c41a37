/* test_structure_reference.c - every solution that an independent program found of the cases in cases/structures, all
 * numbers of harmonics, against the solutions of the traced curve (tests/reference/structures_hbm.csv, and its README:
 * transitions located by bisection, forces integrated by Gauss and Legendre's rule, no samples). */
#include "tests/hbm/structure_cases.h"
#include "tests/reference_table.h"

enum { MOST_ROWS = 400, MOST_RESPONSES = 3, N_MEASURES = 7 };
static const char *const MEASURES[] = {"amplitude", "max", "min", "rms", "mean", "a1", "b1"};

typedef struct reference {
  char name[24];
  int n_harm, solution, dof; /* dof: counted from 1 */
  double omega, is[N_MEASURES];
} reference;

/* The response of the case that is this degree of freedom. */
static int response_of(const model *m, int dof)
{
  for (int r = 0; r < m->n_responses; ++r)
    if (m->responses[r * m->n + dof - 1] != 0) return r;
  fail_msg("DOF %d is no response", dof);
  return -1;
}

static void measure(hbm_solver *s, const hbm_curve *at, int k, int r, double *is)
{
  double x[64];
  CHECK_FILLED(hbm_measures, m, hbm_measure_response(s, at->points[k].omega, hbm_curve_X(at, k), r, &m));
  assert_int_equal(hbm_response(s, at->points[k].omega, hbm_curve_X(at, k), r, x), HC_OK);
  const double all[N_MEASURES] = {m.amplitude, m.max, m.min, m.rms, m.mean, x[1], x[2]};
  memcpy(is, all, sizeof all);
}

/* The largest difference of the rows of one solution from solution k, relative to each row's largest number. */
static double distance(hbm_solver *s, const model *m, const hbm_curve *at, int k, int n, const reference *row,
                       char *what)
{
  double worst = 0;
  for (int i = 0; i < n; ++i) {
    double is[N_MEASURES], size = 0;
    measure(s, at, k, response_of(m, row[i].dof), is);
    for (int q = 0; q < N_MEASURES; ++q) size = fmax(size, fabs(row[i].is[q]));
    for (int q = 0; q < N_MEASURES; ++q) {
      const double off = fabs(is[q] - row[i].is[q]) / size;
      if (isnan(worst) || off <= worst) continue;
      worst = off;
      sprintf(what, "DOF %d, %s", row[i].dof, MEASURES[q]);
    }
  }
  return worst;
}

/* Rows of the same case, harmonics and, if asked, frequency and solution. */
static int count_alike(const reference *row, int n, bool one_omega, bool one_solution)
{
  int k = 1;
  for (; k < n; ++k) {
    bool same = strcmp(row[k].name, row->name) == 0 && row[k].n_harm == row->n_harm;
    same &= !one_omega || row[k].omega == row->omega;
    if (!same || (one_solution && row[k].solution != row->solution)) break;
  }
  return k;
}

/* All solutions at one frequency: each is one of the curve's, and no two are the same one. The reference is good to
 * 2e-13 of the load, and less next to a fold or where a slider just reaches its limit: 1e-9, of which 2.5e-12 is seen.
 * The means, which free sliders leave open, agree too: both sides start them from w = 0. */
static void check_frequency(hbm_solver *s, const model *m, const hbm_curve *curve, int n, const reference *row)
{
  hbm_curve at = {0};
  bool taken[16] = {false};
  assert_int_equal(hbm_curve_at(s, curve, row->omega, &at), HC_OK);
  assert_true(at.n <= 16);
  for (int i = 0, rows; i < n; i += rows) {
    double nearest = INFINITY;
    int which = -1;
    char what[64] = "", is_off[64] = "";
    rows = count_alike(row + i, n - i, true, true);
    for (int k = 0; k < at.n; ++k) {
      const double d = distance(s, m, &at, k, rows, row + i, what);
      if (!(d < nearest)) continue;
      nearest = d;
      which = k;
      memcpy(is_off, what, sizeof what);
    }
    CHECK_LE(nearest, 1e-9, "%s, H = %d, omega = %g, solution %d of %d here: %s", row->name, row->n_harm, row->omega,
             row[i].solution, at.n, is_off);
    if (which >= 0 && taken[which]) fail_msg("%s at %g: two solutions are one here", row->name, row->omega);
    if (which >= 0) taken[which] = true;
  }
  hbm_curve_free(&at);
}

static bool parse(const char *line, void *row)
{
  reference *r = row;
  double *v = r->is;
  return sscanf(line, "%23[^,],%d,%lf,%d,%d,%lf,%lf,%lf,%lf,%lf,%lf,%lf", r->name, &r->n_harm, &r->omega, &r->solution,
                &r->dof, v, v + 1, v + 2, v + 3, v + 4, v + 5, v + 6) == 12;
}

static void every_solution_is_found(CHECK_STATE)
{
  static reference row[MOST_ROWS];
  const int n =
      read_reference("structures_hbm.csv", "case,harmonics,omega,solution,response,amplitude,max,min,rms,mean,a1,b1",
                     parse, MOST_ROWS, sizeof *row, row);
  assert_int_equal(n, 353);
  for (int i = 0, rows; i < n; i += rows) {
    rows = count_alike(row + i, n - i, false, false);
    structure_case c = structure_case_named(row[i].name, row[i].n_harm);
    hbm_solver *s = structure_solver(&c);
    hbm_curve curve = {0};
    assert_int_equal(hbm_trace(s, c.from, c.to, NULL, &curve), HC_OK);
    for (int k = 0, here; k < rows; k += here) {
      here = count_alike(row + i + k, rows - k, true, false);
      check_frequency(s, c.model, &curve, here, row + i + k);
    }
    hbm_curve_free(&curve);
    hbm_solver_free(s);
    model_free(c.model);
  }
}

CHECK_TESTS("hbm.structure_reference", 120, every_solution_is_found)
