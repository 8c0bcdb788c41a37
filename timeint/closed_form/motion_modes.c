/* motion_modes.c - see motion_modes.h. Proof: tests/timeint/test_stiff.c. */
#include "timeint/closed_form/motion_modes.h"

#include <float.h>
#include <string.h>

#include "numerics/norm.h"

static const double most_cancelled = 100;        /* largest ratio of the sum of the parts' sizes to the motion */
static const double rounding = 64 * DBL_EPSILON; /* rounding of a response's rate, a sum of some tens of terms */

static exponential_sum *make_sums(workspace *w, size_t count, size_t terms)
{
  exponential_sum *sums = workspace_array(w, count, sizeof *sums);
  for (size_t i = 0; i < count && !w->failed; ++i)
    sums[i] = (exponential_sum){.by = complex_array(w, terms), .size = workspace_doubles(w, terms)};
  return sums;
}

hc_status motion_modes_make(motion_modes *mm, const modal_base *base, workspace *w)
{
  const size_t n = (size_t)base->n, loads = (size_t)base->n_loads, contacts = (size_t)base->n_contacts,
               terms = loads + 2 * n, guards = TRACK_GUARDS * contacts + 1;
  *mm = (motion_modes){.base = base};
  mm->rate = complex_array(w, terms);
  mm->e.now = complex_array(w, terms);
  mm->c = complex_array(w, 2 * n);
  mm->fixed = complex_array(w, 2 * n);
  mm->eta = complex_array(w, 2 * n);
  mm->deta = complex_array(w, 2 * n);
  mm->forward = complex_array(w, 2 * n * loads);
  mm->back = complex_array(w, 2 * n * loads);
  mm->e.rate = mm->rate;
  mm->e.size = workspace_doubles(w, terms);
  mm->u = make_sums(w, contacts, terms);
  mm->v = make_sums(w, contacts, terms);
  mm->response = make_sums(w, (size_t)base->n_responses, terms);
  mm->guard = make_sums(w, guards, terms);
  mm->of = workspace_array(w, guards, sizeof *mm->of);
  mm->event = workspace_array(w, guards, sizeof *mm->event);
  return w->failed ? HC_NO_MEMORY : HC_OK;
}

static double complex on_circle(double angle) { return cos(angle) + I * sin(angle); }

/* Response of mode k to loads and constant contact forces: fixed, forward, back. */
static void force(motion_modes *mm, const scaled_model *m, const contact_track *track, double omega, size_t k)
{
  const complex_modes *modes = mm->modes;
  const size_t loads = (size_t)mm->base->n_loads, contacts = (size_t)mm->base->n_contacts;
  const double complex lambda = modes->lambda[k];
  double complex constant = 0;
  for (size_t j = 0; j < contacts; ++j) {
    const contact_forces_linear f = contact_track_forces(&track[j], &m->contact[j]);
    constant += f.t_0 * modes->along[k * contacts + j] + f.n_0 * modes->across[k * contacts + j];
  }
  mm->fixed[k] = constant == 0 ? 0 : constant / (m->by_K * lambda);
  for (size_t l = 0; l < loads; ++l) {
    const double h = mm->base->harmonic[l], size = scaled_by_load(m, (int)l) / m->by_K;
    const double complex turn = on_circle(h * mm->theta), turns = I * (h * omega);
    mm->forward[k * loads + l] = 0.5 * size * modes->load[k * loads + l] * turn / (turns - lambda);
    mm->back[k * loads + l] = -0.5 * size * modes->load_back[k * loads + l] * conj(turn) / (turns + lambda);
  }
}

/* c_k: mode k at the start less its response to loads and constant forces. */
static double complex free_part(const motion_modes *mm, double omega, const double *y, size_t k)
{
  const size_t n = (size_t)mm->base->n, loads = (size_t)mm->base->n_loads;
  const double complex *by_x = mm->modes->by_x + k * n, *by_v = mm->modes->by_v + k * n;
  double complex c = -mm->fixed[k];
  for (size_t l = 0; l < loads; ++l) c -= mm->forward[k * loads + l] + mm->back[k * loads + l];
  for (size_t i = 0; i < n; ++i) c += by_x[i] * y[i] + by_v[i] * (omega * y[n + i]);
  return c;
}

/* True if the parts of the motion do not cancel. Motions are about 1. */
static bool adds_up(const motion_modes *mm, const double *y)
{
  const complex_modes *modes = mm->modes;
  const size_t n = (size_t)mm->base->n, loads = (size_t)mm->base->n_loads;
  double x = 0, p = 0, largest_x = 1, largest_p = 1;
  for (size_t k = 0; k < (size_t)modes->count; ++k) {
    const double by = modes->weight[k] * modes->largest[k], free_size = cabs(mm->c[k]);
    x += by * (free_size + cabs(mm->fixed[k]));
    p += by * free_size * cabs(mm->rate[loads + k]);
    for (size_t l = 0; l < loads; ++l) {
      const double driven = by * (cabs(mm->forward[k * loads + l]) + cabs(mm->back[k * loads + l]));
      x += driven;
      p += driven * mm->base->harmonic[l];
    }
  }
  for (size_t i = 0; i < n; ++i) {
    largest_x = fmax(largest_x, fabs(y[i]));
    largest_p = fmax(largest_p, fabs(y[n + i]));
  }
  return x <= most_cancelled * largest_x && p <= most_cancelled * largest_p;
}

/* The sum of exponentials of a row with entry of[k stride] for mode k. */
static void expand(const motion_modes *mm, const double complex *of, size_t stride, exponential_sum *s)
{
  const size_t loads = (size_t)mm->base->n_loads;
  s->constant = 0;
  for (size_t l = 0; l < loads; ++l) s->by[l] = 0;
  for (size_t k = 0; k < (size_t)mm->modes->count; ++k) {
    const double complex share = mm->modes->weight[k] * of[k * stride];
    s->constant += creal(share * mm->fixed[k]);
    s->by[loads + k] = share * mm->c[k];
    for (size_t l = 0; l < loads; ++l)
      s->by[l] += share * mm->forward[k * loads + l] + conj(share * mm->back[k * loads + l]);
  }
}

bool motion_modes_begin(motion_modes *mm, const complex_modes *modes, const scaled_model *m, const contact_track *track,
                        double theta, const double *y)
{
  const modal_base *b = mm->base;
  const double omega = 1 / m->by_C;
  const size_t loads = (size_t)b->n_loads;
  mm->modes = modes;
  mm->theta = theta;
  mm->e.n = b->n_loads + modes->count;
  for (size_t l = 0; l < loads; ++l) mm->rate[l] = I * (double)b->harmonic[l];
  for (size_t k = 0; k < (size_t)modes->count; ++k) {
    mm->rate[loads + k] = modes->lambda[k] * m->by_C;
    force(mm, m, track, omega, k);
    mm->c[k] = free_part(mm, omega, y, k);
  }
  if (!adds_up(mm, y)) return false;
  for (int j = 0; j < b->n_contacts; ++j) {
    expand(mm, modes->u + j, (size_t)b->n_contacts, &mm->u[j]);
    expand(mm, modes->v + j, (size_t)b->n_contacts, &mm->v[j]);
  }
  for (int r = 0; r < b->n_responses; ++r) expand(mm, modes->response + r, (size_t)b->n_responses, &mm->response[r]);
  return true;
}

void motion_modes_at(motion_modes *mm, double tau, int order, double *out)
{
  const size_t n = (size_t)mm->base->n;
  /* eta and deta: the derivative of that order, and the next. */
  const size_t loads = (size_t)mm->base->n_loads, count = (size_t)mm->modes->count;
  for (size_t k = 0; k < count; ++k) {
    const double complex mu = mm->rate[loads + k], z = mm->c[k] * cexp(mu * tau);
    mm->eta[k] = order == 0 ? z + mm->fixed[k] : mu * z;
    mm->deta[k] = order == 0 ? mu * z : mu * mu * z;
  }
  for (size_t l = 0; l < loads; ++l) {
    const double complex turn = on_circle(mm->base->harmonic[l] * tau), turns = mm->rate[l];
    for (size_t k = 0; k < count; ++k) {
      const double complex forward = mm->forward[k * loads + l] * turn, back = mm->back[k * loads + l] * conj(turn);
      mm->eta[k] += order == 0 ? forward + back : turns * (forward - back);
      mm->deta[k] += order == 0 ? turns * (forward - back) : turns * turns * (forward + back);
    }
  }
  memset(out, 0, 2 * n * sizeof *out);
  for (size_t k = 0; k < (size_t)mm->modes->count; ++k) {
    const double complex *V = mm->modes->V + k * n, eta = mm->modes->weight[k] * mm->eta[k],
                         deta = mm->modes->weight[k] * mm->deta[k];
    for (size_t i = 0; i < n; ++i) {
      out[i] += creal(V[i] * eta);
      out[n + i] += creal(V[i] * deta);
    }
  }
}

contact_motion motion_modes_contact(const motion_modes *mm, int j, int directions, double tau)
{
  contact_motion at;
  for (int a = 0; a < directions; ++a) at.u[a] = exponential_sum_at(&mm->e, &mm->u[j + a], tau, &at.du[a]);
  at.v = exponential_sum_at(&mm->e, &mm->v[j], tau, &at.dv);
  return at;
}

int motion_modes_first_event(motion_modes *mm, const scaled_model *m, const contact_track *track, double *tau,
                             track_event *event)
{
  int n = 0;
  for (int j = 0; j < mm->base->n_contacts; j += scaled_directions(m, j)) {
    track_condition conditions[TRACK_GUARDS];
    const contact_motion at = motion_modes_contact(mm, j, scaled_directions(m, j), 0);
    const int more = contact_track_conditions(&track[j], &m->contact[j], conditions);
    for (int i = 0; i < more; ++i, ++n) {
      mm->guard[n].noise = contact_track_noise(&conditions[i], &m->contact[j], &at);
      /* The condition on the motion (u, v) as a sum. */
      mm->guard[n].constant = conditions[i].of_rates
                                  ? 0
                                  : conditions[i].by_v * (mm->v[j].constant + conditions[i].gap) +
                                        conditions[i].constant +
                                        conditions[i].by_u * (mm->u[j].constant - conditions[i].from_u);
      for (int k = 0; k < mm->e.n; ++k) {
        const double complex by = conditions[i].by_u * mm->u[j].by[k] + conditions[i].by_v * mm->v[j].by[k];
        mm->guard[n].by[k] = conditions[i].of_rates ? mm->rate[k] * by : by;
      }
      exponential_sum_measure(&mm->e, &mm->guard[n]);
      mm->of[n] = j;
      mm->event[n] = conditions[i].event;
    }
  }
  const int first = exponentials_first_fall(&mm->e, n, mm->guard, 0, *tau, tau);
  if (first < 0) return -1;
  *event = mm->event[first];
  return mm->of[first];
}

double motion_modes_response(const motion_modes *mm, int i, double tau)
{
  return exponential_sum_at(&mm->e, &mm->response[i], tau, NULL);
}

/* int e^{z tau}, times e^{i theta} where `turns`, from tau0 over h. */
static double complex integral(const motion_modes *mm, double complex z, bool turns, double tau0, double h)
{
  const double complex by = turns ? z + I : z;
  const double complex start = cexp(z * tau0) * (turns ? on_circle(mm->theta + tau0) : 1);
  return start * h * exponential_quotient(by * h);
}

void motion_modes_fourier(const motion_modes *mm, int i, double tau0, double tau1, double out[3])
{
  const exponential_sum *r = &mm->response[i];
  const double h = tau1 - tau0;
  double complex turned = r->constant * integral(mm, 0, true, tau0, h); /* int r e^{i theta} */
  out[0] = r->constant * h;
  for (int k = 0; k < mm->e.n; ++k) {
    const double complex rate = mm->rate[k];
    out[0] += creal(r->by[k] * integral(mm, rate, false, tau0, h));
    turned +=
        0.5 * (r->by[k] * integral(mm, rate, true, tau0, h) + conj(r->by[k]) * integral(mm, conj(rate), true, tau0, h));
  }
  out[1] = creal(turned);
  out[2] = cimag(turned);
}

void motion_modes_extremes(motion_modes *mm, int i, double tau0, double tau1, double *max, double *min)
{
  const exponential_sum *r = &mm->response[i];
  double rate, x = exponential_sum_at(&mm->e, r, tau0, &rate), sign = rate < 0 ? -1 : 1;
  *max = *min = x;
  for (double tau = tau0; tau < tau1; sign = -sign) {
    /* +-r' as a guard. */
    mm->guard->constant = 0;
    for (int k = 0; k < mm->e.n; ++k) mm->guard->by[k] = sign * mm->rate[k] * r->by[k];
    mm->guard->noise = rounding;
    exponential_sum_measure(&mm->e, mm->guard);
    double next = tau1;
    exponentials_first_fall(&mm->e, 1, mm->guard, tau, tau1, &next);
    x = exponential_sum_at(&mm->e, r, next, NULL);
    *max = fmax(*max, x);
    *min = fmin(*min, x);
    tau = next > tau ? next : nextafter(next + rounding, INFINITY);
  }
}
