/* budget.c - see budget.h. The solutions between the HBM solution and the transient are found first; then the distances
 * between neighbours are taken, for each measure of discrepancy.h. */
#include "compare/budget.h"

#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "compare/first_guess.h"
#include "compare/motion.h"
#include "compare/work_limit.h"
#include "numerics/base/workspace.h"

static const double negligible = 1e-2; /* of the discrepancy: a part that no remark would name */
static const double finest = 1e-10;    /* transient.tolerance below which rounding keeps shooting from converging */

struct budgeter {           /* from budgeter_new, to budgeter_free */
  compare_setup setup;      /* a copy */
  int n_harm;               /* of alias_free */
  hbm_solver *alias_free;   /* exact forces; NULL until needed */
  timeint *finer, *coarser; /* the transient's law, stepped finer and coarser; NULL until needed */
  workspace memory;         /* of the arrays below */
  double *state;            /* [n_states] where these start */
  int n_states;             /* in a state of time integration */
  double *X;                /* [n_coefficients of the alias-free solution, and more] */
  struct link *link;        /* [responses] of the chain under way */
};

/* The solutions h, hx, O, T', T of budget.h, in one response; found: hx as tried last. */
typedef struct link {
  periodic_motion h, hx, orbit, finer, transient, found;
  double settling; /* [1] */
} link;

/* Which of them are there. */
typedef struct chain {
  int n, most; /* responses; the one that moves most */
  link *of;    /* [n] */
  bool has_hx, has_orbit, has_finer, has_transient;
  bool finer_is_coarser; /* T' was not found: `finer` is the transient stepped coarser instead, from which only the
                            integration error is estimated */
} chain;

hc_status budgeter_new(const compare_setup *setup, budgeter **out)
{
  budgeter *b = calloc(1, sizeof *b);
  *out = NULL;
  if (!b) return HC_NO_MEMORY;
  b->setup = *setup;
  b->n_states = 2 * setup->model->n + setup->model->n_contacts;
  b->state = workspace_doubles(&b->memory, (size_t)b->n_states);
  b->X = workspace_doubles(&b->memory, (size_t)(2 * HBM_MAX_HARMONICS + 1) * (size_t)setup->model->n);
  b->link = workspace_array(&b->memory, (size_t)setup->model->n_responses, sizeof *b->link);
  if (b->memory.failed) budgeter_free(b);
  else *out = b;
  return *out ? HC_OK : HC_NO_MEMORY;
}

void budgeter_free(budgeter *b)
{
  if (!b) return;
  hbm_solver_free(b->alias_free);
  timeint_free(b->finer);
  timeint_free(b->coarser);
  workspace_free(&b->memory);
  free(b);
}

void budgeter_count(const budgeter *b, long *solves, long *periods, long *closed_form)
{
  if (b->alias_free) *solves += hbm_solves(b->alias_free);
  timeint_count(b->finer, periods, closed_form);
  timeint_count(b->coarser, periods, closed_form);
}

error_budget budget_nothing(void)
{
  const budget_parts none = {NAN, NAN, NAN, NAN, NAN, NAN, NAN};
  return (error_budget){.amplitude = none, .harmonic_1 = none, .mean = none, .waveform = none, .reduction = NAN};
}

bool budget_same_orbit(const timeint_result *a, const timeint_result *b)
{
  periodic_motion ma = motion_of_transient(a), mb = motion_of_transient(b);
  if (a->period_multiple != b->period_multiple || timeint_stability(a) * timeint_stability(b) < 0) return false;
  return discrepancy_relative(motion_between(&ma, &mb).waveform, b->amplitude) <= BUDGET_SAME_ORBIT;
}

double budget_regularisation(const timeint_result *tr, const timeint_result *orbit)
{
  return budget_same_orbit(tr, orbit) ? discrepancy_relative(tr->amplitude - orbit->amplitude, orbit->amplitude) : NAN;
}

/* ---- hx: the same truncation without aliasing ------------------------------------------------ */

static hc_status need_alias_free(budgeter *b, int n_harm)
{
  if (b->alias_free && b->n_harm == n_harm) return HC_OK;
  compare_setup setup = b->setup;
  hbm_solver_free(b->alias_free);
  setup.hbm.force = HBM_FORCE_EXACT;
  setup.hbm.harmonics = b->n_harm = n_harm;
  return guided_hbm_solver_new(setup.model, &setup.hbm, &b->alias_free);
}

/* How long the way from h by `hx` to the orbit is. */
static double way_by(const link *l, const periodic_motion *hx)
{
  return motion_between(&l->h, hx).waveform + motion_between(hx, &l->orbit).waveform;
}

/* Newton's exact solution becomes c's hx if it is the first, or nearer to both h and the orbit. */
static void try_alias_free(budgeter *b, const budget_case *from, chain *c)
{
  hbm_point point;
  const link *lead = &c->of[c->most];
  if (hbm_solve(b->alias_free, from->omega, b->X, &point) != HC_OK) return;
  for (int i = 0; i < c->n; ++i)
    if (motion_of_response(b->alias_free, from->omega, b->X, i, NULL, &c->of[i].found) != HC_OK) return;
  if (c->has_hx && !(way_by(lead, &lead->found) < way_by(lead, &lead->hx))) return;
  for (int i = 0; i < c->n; ++i) c->of[i].hx = c->of[i].found;
  c->has_hx = true;
}

/* From h. If that ends at another solution (h - hx - O three times as long as h - O), from the orbit's harmonics. */
static hc_status find_alias_free(budgeter *b, const budget_case *from, chain *c)
{
  for (int i = 0; i < c->n; ++i) c->of[i].hx = c->of[i].h;
  if ((c->has_hx = b->setup.hbm.force == HBM_FORCE_EXACT)) return HC_OK;
  hc_status st = need_alias_free(b, from->n_harm);
  if (st != HC_OK) return st == HC_NO_MEMORY ? st : HC_OK;
  const link *lead = &c->of[c->most];
  memcpy(b->X, from->X, (size_t)hbm_n_coefficients(b->alias_free) * sizeof *b->X);
  try_alias_free(b, from, c);
  if (!c->has_orbit) return HC_OK;
  double direct = motion_between(&lead->h, &lead->orbit).waveform;
  if (c->has_hx && way_by(lead, &lead->hx) <= 3 * direct) return HC_OK;
  if (hbm_n_dof(b->alias_free) > 1) return HC_OK; /* one response's harmonics are no start */
  motion_harmonics(&lead->orbit, from->n_harm, b->X);
  if (!b->setup.hbm.keep_mean) b->X[0] = 0;
  try_alias_free(b, from, c);
  return HC_OK;
}

/* ---- T': the transient without its integration error ----------------------------------------- */

/* The transient's orbit with transient.tolerance = tolerance. HC_OK also if there was none: then !*found. */
static hc_status integrate_again(budgeter *b, timeint **ti, double tolerance, const budget_case *from,
                                 const hc_monitor *monitor, chain *c, bool *found)
{
  compare_setup setup = b->setup;
  timeint_result r;
  memcpy(b->state, from->state, (size_t)b->n_states * sizeof *b->state);
  work_limit p = {.outer = monitor, .most = PERIOD_LIMIT};
  hc_monitor bounded = {work_limit_tick, &p};
  *found = false;
  setup.transient.tolerance = tolerance;
  hc_status st = HC_OK;
  if (!*ti && from->by) st = timeint_new_beside(from->by, &setup.transient, ti);
  else if (!*ti) st = timeint_new(setup.model, &setup.transient, ti);
  if (st == HC_OK) st = timeint_again(*ti, from->omega, from->transient->period_multiple, b->state, &bounded, &r);
  if (st == HC_NO_MEMORY) return st;
  if (p.stopped) return HC_INTERRUPTED;
  if (st != HC_OK || !budget_same_orbit(&r, from->transient)) return HC_OK;
  for (int i = 0; i < c->n && st == HC_OK; ++i) {
    if (i > 0) st = timeint_response(*ti, i, &r);
    if (st == HC_OK) c->of[i].finer = motion_of_transient(&r);
  }
  *found = st == HC_OK;
  return st == HC_NO_MEMORY ? st : HC_OK;
}

static hc_status find_finer(budgeter *b, const budget_case *from, const hc_monitor *monitor, chain *c)
{
  const double tolerance = b->setup.transient.tolerance;
  for (int i = 0; i < c->n; ++i) {
    c->of[i].settling = from->transient[i].closure;
    c->of[i].finer = c->of[i].transient;
  }
  if ((c->has_finer = from->transient->method == TIMEINT_BY_CLOSED_FORM)) return HC_OK;
  /* Could the integration's error, as large as it says itself, be seen beside the other parts, or is it asked for? */
  const timeint_result *tr = &from->transient[c->most];
  const link *lead = &c->of[c->most];
  const double whole = motion_between(&lead->h, &lead->transient).waveform, expected = tr->closure + tr->attainable;
  if (b->setup.spare && expected * tr->amplitude <= negligible * whole) return HC_OK;
  const double fine = fmin(finest, 0.1 * tolerance);
  hc_status st = integrate_again(b, &b->finer, fine, from, monitor, c, &c->has_finer);
  if (st != HC_OK || c->has_finer) return st;
  return integrate_again(b, &b->coarser, 10 * tolerance, from, monitor, c, &c->finer_is_coarser);
}

/* ---- the parts ------------------------------------------------------------------------------- */

static double known(double part) { return part >= 0 ? part : 0; }

/* Distances between the solutions of a chain in one response. */
typedef struct distances {
  motion_distance observed, aliasing, truncation, regularisation, integration;
} distances;

/* One measure of a distance, at its offset in motion_distance, relative to the amplitude `unit`. */
static double relative(const motion_distance *d, size_t measure, double unit)
{
  return discrepancy_relative(*(const double *)(const void *)((const char *)d + measure), unit);
}

/* The parts in one measure. */
static budget_parts split(const chain *c, bool one_law, double settling, double unit, const distances *d,
                          size_t measure)
{
  budget_parts p = budget_nothing().amplitude;
  p.observed = relative(&d->observed, measure, unit);
  if (c->has_hx) {
    p.aliasing = relative(&d->aliasing, measure, unit);
    p.truncation = relative(&d->truncation, measure, unit);
  }
  if (c->has_transient) {
    p.regularisation = one_law ? 0 : c->has_orbit ? relative(&d->regularisation, measure, unit) : NAN;
    p.settling = settling;
    if (c->has_finer || c->finer_is_coarser)
      p.integration = fmax(relative(&d->integration, measure, unit) - known(settling), 0);
  }
  p.sum = 0;
#define ADD(name) p.sum += known(p.name);
  BUDGET_PARTS(ADD)
#undef ADD
  return p;
}

/* one_law: O and T' are the same orbit but for errors of integration. */
static void fill_budget(const chain *c, const link *of, bool one_law, error_budget *out)
{
  /* Where a solution of the chain is missing, its neighbours are taken for each other: T for T', T' for O. */
  const periodic_motion *last = c->has_finer ? &of->finer : &of->transient;
  const periodic_motion *orbit = c->has_transient && (one_law || !c->has_orbit) ? last : &of->orbit;
  const periodic_motion *end = c->has_transient ? &of->transient : orbit;
  const distances d = {.observed = motion_between(&of->h, end),
                       .aliasing = motion_between(&of->h, &of->hx),
                       .truncation = motion_between(&of->hx, orbit),
                       .regularisation = c->has_transient ? motion_between(orbit, last) : (motion_distance){0},
                       .integration =
                           c->has_transient ? motion_between(&of->finer, &of->transient) : (motion_distance){0}};
  const double unit = c->has_transient ? of->transient.amplitude : of->orbit.amplitude;
  out->amplitude = split(c, one_law, of->settling, unit, &d, offsetof(motion_distance, amplitude));
  out->harmonic_1 = split(c, one_law, of->settling, unit, &d, offsetof(motion_distance, harmonic_1));
  out->mean = split(c, one_law, of->settling, unit, &d, offsetof(motion_distance, mean));
  if (of->h.mean_free || (c->has_transient ? of->transient : of->orbit).mean_free) out->mean.observed = NAN;
  out->waveform = split(c, one_law, of->settling, unit, &d, offsetof(motion_distance, waveform));
  out->known = true;
  out->against_transient = c->has_transient;
}

/* Is the transient on the orbit next to h? */
static bool on_orbit(const budget_case *from)
{
  const timeint_result *tr = from->transient;
  if (from->transient_status != HC_OK || tr->period_multiple != 1 || tr->left_orbit) return false;
  return from->orbit_status != HC_OK || budget_same_orbit(tr, from->orbit);
}

hc_status budgeter_run(budgeter *b, const budget_case *from, const hc_monitor *monitor, error_budget *out)
{
  chain c = {.n = b->setup.model->n_responses, .of = b->link};
  hc_status st = HC_OK;
  for (int i = 0; i < c.n; ++i) out[i] = budget_nothing();
  c.has_orbit = from->orbit_status == HC_OK;
  c.has_transient = on_orbit(from);
  for (int i = 0; i < c.n; ++i) {
    link *l = &c.of[i];
    *l = (link){.h = from->motion[i]};
    if (l->h.amplitude > c.of[c.most].h.amplitude) c.most = i;
    if (c.has_orbit) l->orbit = motion_of_transient(&from->orbit[i]);
    if (c.has_transient) l->transient = motion_of_transient(&from->transient[i]);
  }
  const bool any = c.has_orbit || c.has_transient;
  if (any) st = find_alias_free(b, from, &c);
  if (st == HC_OK && c.has_transient) st = find_finer(b, from, monitor, &c);
  const bool one_law = b->setup.transient.law == TRANSIENT_LAW_EXACT && !from->family;
  for (int i = 0; i < c.n && st == HC_OK && any; ++i) {
    fill_budget(&c, &c.of[i], one_law, &out[i]);
    out[i].family = from->family;
  }
  return st;
}

/* ---- in words ---- */

enum { REGULARISATION = 2 };          /* among the parts */
static const double rounding = 1e-14; /* [1] no smaller part is named */

/* NULL: none, or what HBM's part of the error is made of is not known. */
static const char *largest_of(const budget_parts *p, bool family, double *share)
{
  static const char *const names[BUDGET_N_PARTS] = {
#define NAME(part) #part,
      BUDGET_PARTS(NAME)
#undef NAME
  };
  const double parts[BUDGET_N_PARTS] = {
#define VALUE(part) p->part,
      BUDGET_PARTS(VALUE)
#undef VALUE
  };
  int top = -1;
  for (int i = 0; i < BUDGET_N_PARTS; ++i)
    if (parts[i] > (top < 0 ? rounding : parts[top])) top = i;
  if (isnan(p->aliasing)) top = -1;
  *share = top < 0 ? NAN : isinf(parts[top]) ? 1 : parts[top] / p->sum;
  return top < 0 ? NULL : top == REGULARISATION && family ? "family" : names[top];
}

const char *budget_largest(const error_budget *b, double *share)
{
  *share = NAN;
  return b->known ? largest_of(&b->amplitude, b->family, share) : NULL;
}

budget_worst budget_find_worst(const error_budget *b, const discrepancy *limits)
{
  const budget_worst of[] = {{"amplitude", &b->amplitude, limits->amplitude},
                             {"harmonic_1", &b->harmonic_1, limits->harmonic_1},
                             {"mean", &b->mean, limits->mean},
                             {"waveform", &b->waveform, limits->waveform}};
  budget_worst top = {.ratio = -1};
  for (size_t i = 0; i < sizeof of / sizeof *of && b->known; ++i) {
    const double ratio = of[i].parts->observed / of[i].ratio;
    if (ratio > top.ratio) top = of[i], top.ratio = ratio;
  }
  return top;
}

const char *budget_text(const error_budget *b, const discrepancy *limits, char text[BUDGET_TEXT])
{
  const budget_worst worst = budget_find_worst(b, limits);
  double share;
  const char *name = worst.quantity ? largest_of(worst.parts, b->family, &share) : NULL;
  if (!worst.quantity) snprintf(text, BUDGET_TEXT, "no orbit to account for");
  else if (!name)
    snprintf(text, BUDGET_TEXT, "%s %.2g %%%s", worst.quantity,
             worst.parts->observed > rounding ? 100 * worst.parts->observed : 0,
             isnan(worst.parts->aliasing) ? ", of parts that are not known" : "");
  else
    snprintf(text, BUDGET_TEXT, "%s %.2g %%: %s (%.0f %%)%s", worst.quantity, 100 * worst.parts->observed, name,
             100 * share, worst.ratio <= 1 ? "; within the gate" : "");
  return text;
}
