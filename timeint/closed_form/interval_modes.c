/* interval_modes.c - see interval_modes.h. Proof: tests/timeint/test_stiff.c. */
#include "timeint/closed_form/interval_modes.h"

#include <string.h>

#include "numerics/eigensystem.h"
#include "numerics/norm.h"

static const double short_span = 20;        /* [rad of the fastest mode] about ten steps of a series, which are then
                                               less work */
static const size_t most_bytes = 32u << 20; /* most memory of the cache */
enum { MOST_MODES = 64, MOST_SETS = 256, NO_CONTACT = 255 };

struct interval_modes { /* from interval_modes_new, to interval_modes_free */
  const modal_base *base;
  double fastest; /* [rad/time] approximate bound of eigenvalues */
  double stiff;   /* fastest/omega above which modes pay */
  long asked;     /* number of requests so far */
  int n_sets, used;
  complex_modes *set;    /* [n_sets] the cache, of which `used` are filled */
  unsigned char *wanted; /* [n_contacts] states requested */
  long double *matrix;   /* [2 n][2 n] */
  double *scale;         /* [n] scale of x in it */
  int *order;            /* [2 n] */
  eigensystem eigen;
  workspace memory; /* memory of these arrays and those of the sets */
};

/* Complex numbers of one set. */
static size_t room_of(const modal_base *b)
{
  const size_t n = (size_t)b->n, rows = 4 * (size_t)b->n_contacts + (size_t)b->n_responses + 2 * (size_t)b->n_loads;
  return 2 * n * (1 + 3 * n + rows);
}

static void make_set(workspace *w, const modal_base *b, complex_modes *s)
{
  const size_t n = (size_t)b->n, most = 2 * n, contacts = (size_t)b->n_contacts;
  s->states = workspace_array(w, contacts, 1);
  s->weight = workspace_doubles(w, most);
  s->largest = workspace_doubles(w, most);
  s->lambda = complex_array(w, most);
  s->V = complex_array(w, most * n);
  s->by_x = complex_array(w, most * n);
  s->by_v = complex_array(w, most * n);
  s->u = complex_array(w, most * contacts);
  s->v = complex_array(w, most * contacts);
  s->along = complex_array(w, most * contacts);
  s->across = complex_array(w, most * contacts);
  s->response = complex_array(w, most * (size_t)b->n_responses);
  s->load = complex_array(w, most * (size_t)b->n_loads);
  s->load_back = complex_array(w, most * (size_t)b->n_loads);
}

static hc_status make(interval_modes *p)
{
  const modal_base *b = p->base;
  const size_t n = (size_t)b->n, fit = most_bytes / (room_of(b) * sizeof(double complex));
  workspace *w = &p->memory;
  p->n_sets = fit < MOST_SETS ? fit > 4 ? (int)fit : 4 : MOST_SETS;
  p->fastest = fmax(b->highest, b->decay);
  p->set = workspace_array(w, (size_t)p->n_sets, sizeof *p->set);
  for (int i = 0; i < p->n_sets && !w->failed; ++i) make_set(w, b, &p->set[i]);
  p->wanted = workspace_array(w, (size_t)b->n_contacts, 1);
  p->matrix = workspace_array(w, 4 * n * n, sizeof *p->matrix);
  p->scale = workspace_doubles(w, n);
  p->order = workspace_array(w, 2 * n, sizeof *p->order);
  return w->failed ? HC_NO_MEMORY : eigensystem_make(&p->eigen, 2 * b->n, w);
}

hc_status interval_modes_new(const modal_base *base, double stiff, interval_modes **out)
{
  *out = NULL;
  if (base->n > MOST_MODES || isinf(stiff)) return HC_OK;
  interval_modes *p = calloc(1, sizeof *p); /* zeroed, so free works half-built */
  if (!p) return HC_NO_MEMORY;
  p->base = base;
  p->stiff = stiff * fmax(1, pow(base->n / 16.0, 2));
  if (make(p) == HC_OK) {
    *out = p;
    return HC_OK;
  }
  interval_modes_free(p);
  return HC_NO_MEMORY;
}

void interval_modes_free(interval_modes *p)
{
  if (!p) return;
  workspace_free(&p->memory);
  free(p);
}

bool interval_modes_pay(const interval_modes *p, double omega, double span)
{
  return p && p->fastest > p->stiff * omega && p->fastest * span > short_span * omega;
}

/* -(K + K_contacts) [1/time^2] in the lower left of the first-order matrix, whose upper half is (0 1). */
static void fill_stiffness(const interval_modes *p, const scaled_model *m, const contact_track *track, long double *A)
{
  const modal_base *b = p->base;
  const size_t n = (size_t)b->n, ld = 2 * n;
  for (size_t col = 0; col < n; ++col)
    for (size_t row = 0; row < n; ++row)
      A[col * ld + n + row] = b->diagonal_K ? (row == col ? -(long double)b->K[col] : 0) : -b->K[col * n + row];
  for (int j = 0; j < b->n_contacts; ++j) {
    const contact_forces_linear f = contact_track_forces(&track[j], &m->contact[j]);
    const double *t = b->tangent + (size_t)j * n, *v = b->normal + (size_t)j * n;
    const long double t_u = f.t_u / m->by_K, t_v = f.t_v / m->by_K, n_v = f.n_v / m->by_K;
    for (size_t col = 0; col < n; ++col) {
      const long double along = t_u * t[col] + t_v * v[col], across = n_v * v[col];
      for (size_t row = 0; row < n; ++row) A[col * ld + n + row] -= t[row] * along + v[row] * across;
    }
  }
}

static double complex dot_complex(int n, const double *a, const double complex *z)
{
  double complex sum = 0;
  for (int i = 0; i < n; ++i) sum += a[i] * z[i];
  return sum;
}

/* Mode k of the set from eigenvector `from`. */
static void take_mode(const interval_modes *p, complex_modes *s, int k, int from)
{
  const modal_base *b = p->base;
  const size_t n = (size_t)b->n, at = (size_t)k, contacts = (size_t)b->n_contacts, loads = (size_t)b->n_loads;
  const double complex *right = p->eigen.V + (size_t)from * 2 * n, *left = p->eigen.W + (size_t)from * 2 * n;
  double complex *V = s->V + at * n, *by_x = s->by_x + at * n, *by_v = s->by_v + at * n;
  s->lambda[k] = p->eigen.lambda[from];
  s->weight[k] = cimag(s->lambda[k]) > 0 ? 2 : 1;
  s->largest[k] = 0;
  for (size_t i = 0; i < n; ++i) {
    V[i] = right[i] / p->scale[i];
    s->largest[k] = fmax(s->largest[k], cabs(V[i]));
    by_x[i] = left[i] * p->scale[i];
    by_v[i] = left[n + i];
  }
  for (size_t j = 0; j < contacts; ++j) {
    const double *t = b->tangent + j * n, *v = b->normal + j * n;
    s->u[at * contacts + j] = dot_complex(b->n, t, V);
    s->v[at * contacts + j] = dot_complex(b->n, v, V);
    s->along[at * contacts + j] = dot_complex(b->n, t, by_v);
    s->across[at * contacts + j] = dot_complex(b->n, v, by_v);
  }
  for (int r = 0; r < b->n_responses; ++r)
    s->response[at * (size_t)b->n_responses + (size_t)r] = dot_complex(b->n, b->response + (size_t)r * n, V);
  for (size_t l = 0; l < loads; ++l) {
    const double complex cosine = dot_complex(b->n, b->cosine + l * n, by_v),
                         sine = dot_complex(b->n, b->sine + l * n, by_v);
    s->load[at * loads + l] = cosine - I * sine;
    s->load_back[at * loads + l] = cosine + I * sine;
  }
}

/* The set for p->wanted, or, if not found, the one to be overwritten. */
static complex_modes *look_up(interval_modes *p, bool *found)
{
  complex_modes *oldest = &p->set[0];
  const size_t contacts = (size_t)p->base->n_contacts;
  *found = true;
  for (int i = 0; i < p->used; ++i) {
    complex_modes *s = &p->set[i];
    if (memcmp(s->states, p->wanted, contacts) == 0) return s;
    if (s->asked < oldest->asked) oldest = s;
  }
  *found = false;
  return p->used < p->n_sets ? &p->set[p->used++] : oldest;
}

hc_status interval_modes_of(interval_modes *p, const scaled_model *m, const contact_track *track,
                            const complex_modes **out)
{
  bool found;
  *out = NULL;
  for (int j = 0; j < p->base->n_contacts; ++j) {
    const contact_forces_linear f = contact_track_forces(&track[j], &m->contact[j]);
    /* The state of contact j, or NO_CONTACT if it adds nothing to the matrix. */
    const bool nothing = f.t_u == 0 && f.t_v == 0 && f.n_v == 0;
    p->wanted[j] = nothing ? NO_CONTACT : (unsigned char)track[j].state;
  }
  complex_modes *s = look_up(p, &found);
  s->asked = ++p->asked;
  if (!found) {
    s->count = 0;
    memcpy(s->states, p->wanted, (size_t)p->base->n_contacts);
    /* The first-order matrix of (scale q, q'), scale_i the frequency of q_i alone, so that eigenvectors are orthogonal
     * where nothing damps and couples. */
    const modal_base *b = p->base;
    const size_t n = (size_t)b->n, ld = 2 * n;
    long double *A = p->matrix;
    memset(A, 0, ld * ld * sizeof *A);
    fill_stiffness(p, m, track, A);
    const double least = p->fastest > 0 ? 1e-6 * p->fastest : 1; /* for rigid-body motions */
    for (size_t i = 0; i < n; ++i) p->scale[i] = fmax(sqrt(fabs((double)A[i * ld + n + i])), least);
    for (size_t col = 0; col < n; ++col) {
      A[(n + col) * ld + col] = p->scale[col];
      for (size_t row = 0; row < n; ++row) {
        A[col * ld + n + row] /= p->scale[col];
        A[(n + col) * ld + n + row] = b->diagonal_C ? (row == col ? -(long double)b->C[col] : 0) : -b->C[col * n + row];
      }
    }
    hc_status st = eigensystem_find(&p->eigen, p->matrix);
    if (st == HC_NO_MEMORY || st == HC_NOT_FINITE) return st;
    /* All modes but the second of each pair, slowest first. */
    if (st == HC_OK) {
      const double complex *lambda = p->eigen.lambda;
      s->count = 0;
      for (int k = 0; k < 2 * p->base->n; ++k) {
        if (cimag(lambda[k]) < 0) continue;
        int at = s->count++;
        for (; at > 0 && cabs(lambda[p->order[at - 1]]) > cabs(lambda[k]); --at) p->order[at] = p->order[at - 1];
        p->order[at] = k;
      }
      for (int k = 0; k < s->count; ++k) take_mode(p, s, k, p->order[k]);
    }
  }
  if (s->count > 0) *out = s;
  return HC_OK;
}
