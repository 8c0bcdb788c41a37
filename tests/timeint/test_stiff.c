/* test_stiff.c - motions of structures by complex modes: against power series, which decompose nothing. */

#include "tests/timeint/drawn.h"
#include "timeint/closed_form/motion_modes.h"

enum { PERIODS = 3 };

enum kind { PLAIN, STIFF, DAMPED_STIFF, FREE, CRITICAL, UNDAMPED, RESONANT, N_KINDS };

/* What makes a structure hard to decompose, or to follow by series. */
static void harden(enum kind kind, model *m)
{
  const int n = m->n;
  switch (kind) {
  case STIFF: m->stiffness[0] *= 1e4; break;
  case DAMPED_STIFF:
    m->stiffness[0] *= 1e4;
    for (int i = 0; i < n * n; ++i) m->damping[i] = 2e-3 * m->stiffness[i];
    break;
  case UNDAMPED:
  case RESONANT: memset(m->damping, 0, (size_t)(n * n) * sizeof *m->damping); break;
  case FREE: /* no spring, no damper: a double eigenvalue 0 while its contacts are open */
    for (int i = 0; i < n; ++i) m->stiffness[i] = m->stiffness[i * n] = m->damping[i] = m->damping[i * n] = 0;
    break;
  case CRITICAL: /* two equal eigenvalues, one eigenvector, but for rounding */
    for (int i = 1; i < n; ++i)
      for (double *A = m->mass; A; A = A == m->mass ? m->stiffness : A == m->stiffness ? m->damping : NULL)
        A[i] = A[i * n] = 0;
    m->damping[0] = 2 * sqrt(m->stiffness[0] * m->mass[0]);
    break;
  default: break;
  }
}

static void draw(uint64_t *seed, enum kind kind, drawn *d)
{
  const int n = random_int(seed, 1, 6), contacts = random_int(seed, 1, 5);
  d->m = random_structure(seed, n, contacts);
  harden(kind, d->m);
  scale_drawn(d, TRANSIENT_LAW_EXACT, 3 + 10 * random_unit(seed));
  if (kind != RESONANT) return;
  const double omega = sqrt(d->base->K[0]); /* the load and a mode, contacts open, cancel each other */
  modal_base_free(d->base);
  scale_drawn(d, TRANSIENT_LAW_EXACT, omega);
}

/* Periods by modes, wherever there are any, and by series: states, transitions, monodromy matrices. A period magnifies
 * what it is given by no more than the monodromy matrix, and cancellation takes up to four digits of rounding. */
static void modes_and_series_agree(CHECK_STATE)
{
  static double phi[2][MOST * MOST];
  uint64_t seed = 31;
  long by_modes = 0, by_series = 0;
  for (int trial = 0; trial < 40 * N_KINDS; ++trial) {
    drawn d;
    double y[MOST] = {0}, z[MOST];
    draw(&seed, (enum kind)(trial % N_KINDS), &d);
    const int n = d.scaled.n_states;
    CHECK_MADE(integrator, modes, integrate_new_closed_form(d.base, 0, &modes));
    CHECK_MADE(integrator, series, integrate_new_closed_form(d.base, INFINITY, &series));
    for (int period = 0; period < PERIODS; ++period) {
      memcpy(z, y, sizeof y);
      assert_int_equal(integrate_monodromy(modes, &d.scaled, y, phi[0]), HC_OK);
      assert_int_equal(integrate_monodromy(series, &d.scaled, z, phi[1]), HC_OK);
      const double grown = fmax(1, norm_max(n * n, phi[1])), size = fmax(1, norm_max(n, z));
      for (int i = 0; i < n; ++i) CHECK_NEAR(y[i], z[i], 1e-11 * grown * size, "trial %d, state %d", trial, i);
      for (int i = 0; i < n * n; ++i)
        CHECK_NEAR(phi[0][i], phi[1][i], 1e-9 * grown * grown * size, "trial %d, monodromy %d", trial, i);
      const long apart = labs(integrate_transitions(modes) - integrate_transitions(series));
      CHECK_LE((double)apart, 2.0 * (period + 1), "trial %d: transitions of no length at ties", trial);
    }
    if (trial % N_KINDS == STIFF || trial % N_KINDS == DAMPED_STIFF) {
      by_modes += integrate_steps(modes);
      by_series += integrate_steps(series);
    }
    integrate_free(modes);
    integrate_free(series);
    undraw(&d);
  }
  CHECK_LE(10.0 * (double)by_modes, (double)by_series, "%s", "steps of stiff structures");
}

/* More sets of contact states than are kept, asked for in any order: each as one that was just made has it. */
static void sets_give_way(CHECK_STATE)
{
  uint64_t seed = 8;
  model *m = random_structure(&seed, 2, 6);
  drawn d = {.m = m};
  for (int j = 0; j < 6; ++j) { /* each state another matrix */
    m->contacts[j].law = (contact){.kt = 10 + j, .kn = 20 + j, .mu = 0.3, .gap = 0.1};
    random_direction(&seed, 2, m->contacts[j].tangent);
    random_direction(&seed, 2, m->contacts[j].normal);
  }
  scale_drawn(&d, TRANSIENT_LAW_EXACT, 5);
  CHECK_MADE(interval_modes, kept, interval_modes_new(d.base, 0, &kept));
  for (int trial = 0; trial < 3000; ++trial) {
    contact_track track[6] = {{0}};
    const complex_modes *modes, *made;
    const contact_state states[] = {CONTACT_SEPARATED, CONTACT_STICK, CONTACT_SLIP_PLUS, CONTACT_SLIP_MINUS};
    for (int j = 0; j < 6; ++j) {
      track[j].state = states[random_int(&seed, 0, 3)];
      track[j].along = track[j].state == CONTACT_SLIP_MINUS ? -1 : 1;
    }
    assert_int_equal(interval_modes_of(kept, &d.scaled, track, &modes), HC_OK);
    if (trial % 50) continue;
    CHECK_MADE(interval_modes, fresh, interval_modes_new(d.base, 0, &fresh));
    assert_int_equal(interval_modes_of(fresh, &d.scaled, track, &made), HC_OK);
    assert_int_equal(modes != NULL, made != NULL);
    for (int k = 0; made && k < made->count; ++k)
      CHECK_LE(cabs(modes->lambda[k] - made->lambda[k]), 1e-13 * cabs(made->lambda[k]), "trial %d, %d", trial, k);
    interval_modes_free(fresh);
  }
  interval_modes_free(kept);
  undraw(&d);
}

/* What a watch is told of a response: integrals, largest and least value, instants. */
typedef struct told {
  double integral[3], max, min, wave[64];
  int next;
} told;

static hc_status listen(void *self, const integrator *in, double theta0, double theta1)
{
  told *t = self;
  double part[3], max, min;
  assert_true(theta1 > theta0);
  if (!integrate_fourier(in, 0, part)) return HC_BUG;
  for (int k = 0; k < 3; ++k) t->integral[k] += part[k];
  for (; t->next < 64 && 2 * PI * t->next / 64 <= theta1; ++t->next)
    integrate_samples(in, 0, 2 * PI * t->next / 64, 0, 1, &t->wave[t->next]);
  if (!integrate_extremes(in, 0, &max, &min)) return HC_OK;
  t->max = larger(t->max, max);
  t->min = -larger(-t->min, -min);
  return HC_OK;
}

/* The largest of 20 000 instants is no larger, and misses the extreme by bend h^2/8 at most: h = 3e-4, bend about 1e2
 * of the motion's size in these structures. */
static void a_watch_is_told_the_same(CHECK_STATE)
{
  uint64_t seed = 5;
  for (int trial = 0; trial < 40; ++trial) {
    drawn d;
    double y[MOST] = {0}, z[MOST];
    told by_modes = {.max = -INFINITY, .min = INFINITY}, by_series = by_modes;
    draw(&seed, trial % 2 ? STIFF : PLAIN, &d);
    CHECK_MADE(integrator, modes, integrate_new_closed_form(d.base, 0, &modes));
    CHECK_MADE(integrator, series, integrate_new_closed_form(d.base, INFINITY, &series));
    for (int k = 0; k < PERIODS; ++k) assert_int_equal(integrate_period(series, &d.scaled, y, NULL, NULL), HC_OK);
    memcpy(z, y, sizeof y);
    assert_int_equal(integrate_period(modes, &d.scaled, y, listen, &by_modes), HC_OK);
    assert_int_equal(integrate_period(series, &d.scaled, z, listen, &by_series), HC_OK);
    for (int k = 0; k < 3; ++k)
      CHECK_NEAR(by_modes.integral[k], by_series.integral[k], 1e-10, "trial %d, integral %d", trial, k);
    for (int k = 0; k < 64; ++k) CHECK_NEAR(by_modes.wave[k], by_series.wave[k], 1e-10, "trial %d, %d", trial, k);
    CHECK_LE(by_series.next, by_modes.next, "trial %d", trial);
    for (int k = 0; k < 64; ++k) {
      CHECK_LE(by_modes.wave[k], by_modes.max + 1e-12, "trial %d, %d", trial, k);
      CHECK_LE(by_modes.min, by_modes.wave[k] + 1e-12, "trial %d, %d", trial, k);
    }
    integrate_free(modes);
    integrate_free(series);
    undraw(&d);
  }
}

/* A mass on next to no spring slips under a constant T: it begins at 0, 500 of its units from where that T and the
 * spring balance, and as far back by its free motion. Modes of such an interval lose three digits, which is said; at
 * the place of balance nothing cancels. */
static void a_constant_force_that_cancels_is_told(CHECK_STATE)
{
  const contact_track slips = {.state = CONTACT_SLIP_PLUS, .along = 1};
  drawn d;
  workspace memory = {0};
  assert_int_equal(model_new(1, 1, 1, 1, &d.m), HC_OK);
  d.m->mass[0] = d.m->responses[0] = d.m->contacts[0].tangent[0] = 1;
  d.m->stiffness[0] = d.m->damping[0] = 1e-3;
  d.m->loads[0].harmonic = 1;
  d.m->contacts[0].law = (contact){.kt = 1, .mu = 0.5, .load = 1};
  scale_drawn(&d, TRANSIENT_LAW_EXACT, 1);
  CHECK_MADE(interval_modes, kept, interval_modes_new(d.base, 0, &kept));
  CHECK_MADE(const complex_modes, modes, interval_modes_of(kept, &d.scaled, &slips, &modes));
  CHECK_FILLED(motion_modes, motion, motion_modes_make(&motion, d.base, &memory));
  assert_false(motion_modes_begin(&motion, modes, &d.scaled, &slips, 0, (double[]){0, 1, 0}));
  assert_true(motion_modes_begin(&motion, modes, &d.scaled, &slips, 0, (double[]){-500, 1, 0}));
  workspace_free(&memory);
  interval_modes_free(kept);
  undraw(&d);
}

/* A chain of n masses of very different stiffness, with the steady state's load on the last and a slider on the first;
 * damped in proportion to its stiffness, so that fast modes die away in no time. */
static model *graded_chain(int n)
{
  CHECK_MADE(model, m, model_new(n, 1, 1, 1, &m));
  for (int i = 0; i < n; ++i) {
    const double k = pow(10, 6.0 * i / (n - 1)); /* between mass i - 1 and i */
    m->mass[i * (n + 1)] = 1 + 0.1 * i;
    m->stiffness[i * (n + 1)] += k;
    if (i == 0) continue;
    m->stiffness[(i - 1) * (n + 1)] += k;
    m->stiffness[i * n + i - 1] = m->stiffness[(i - 1) * n + i] = -k;
  }
  for (int i = 0; i < n * n; ++i) m->damping[i] = 0.02 * m->stiffness[i];
  m->loads[0].harmonic = 1;
  m->loads[0].cosine[n - 1] = m->responses[0] = 1;
  m->contacts[0].tangent[0] = 1;
  m->contacts[0].law = (contact){.kt = 1, .mu = 0.5, .load = 1};
  return m;
}

/* The modes of the chain are off by rounding of the stiffest; damping is not found to couple them for that. A dashpot
 * between two masses that is a millionth of what is there does. */
static void proportional_damping_is_told(CHECK_STATE)
{
  const double dashpots[] = {0, 1e-6, 0.1};
  for (size_t i = 0; i < 3; ++i) {
    model *m = graded_chain(10);
    m->damping[0] += dashpots[i] * m->damping[0];
    CHECK_MADE(modal_base, base, modal_base_new(m, &base));
    assert_int_equal(base->diagonal_C, i == 0);
    modal_base_free(base);
    model_free(m);
  }
}

/* Periods of the chain, in which CVODE takes BDF: as by modes, to the sum of the local errors. CVODE keeps the root
 * mean square over the states of each step's below 1e-12 of about 1, so that no state's exceeds sqrt(n) of that; the
 * chain is damped, and what a step left does not grow. Which errors add up depends on the last digits, and so on the
 * BLAS. Its steps are not as short as the fastest mode is fast: 2e4 a radian. */
static void events_of_stiff_structures(CHECK_STATE)
{
  drawn d = {.m = graded_chain(6)};
  double y[MOST] = {0}, z[MOST];
  scale_drawn(&d, TRANSIENT_LAW_EXACT, 0.7);
  CHECK_MADE(integrator, modes, integrate_new_closed_form(d.base, INTERVAL_MODES_STIFF, &modes));
  CHECK_MADE(integrator, events, integrate_new_events(d.base, 1e-12, &events));
  for (int period = 0; period < PERIODS; ++period) {
    memcpy(z, y, sizeof y);
    assert_int_equal(integrate_period(modes, &d.scaled, y, NULL, NULL), HC_OK);
    assert_int_equal(integrate_period(events, &d.scaled, z, NULL, NULL), HC_OK);
    const double bound = (double)integrate_steps(events) * sqrt(d.scaled.n_states) * 1e-12;
    for (int i = 0; i < d.scaled.n_states; ++i) CHECK_NEAR(z[i], y[i], bound, "period %d, state %d", period, i);
  }
  assert_true(integrate_transitions(modes) > 0);
  CHECK_LE((double)integrate_steps(events), 5000.0 * PERIODS, "%s", "steps");
  CHECK_LE((double)integrate_steps(modes), 10.0 * PERIODS, "%s", "phases");
  integrate_free(modes);
  integrate_free(events);
  undraw(&d);
}

CHECK_TESTS("timeint.stiff", 600, modes_and_series_agree, sets_give_way, a_watch_is_told_the_same,
            proportional_damping_is_told, events_of_stiff_structures, a_constant_force_that_cancels_is_told)
