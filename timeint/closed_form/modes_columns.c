/* modes_columns.c - see modes_columns.h. Proof: tests/timeint/test_stiff.c. */
#include "timeint/closed_form/modes_columns.h"

#include <stdlib.h>
#include <string.h>

hc_status modes_columns_make(modes_columns *s, const modal_base *base)
{
  const size_t n = (size_t)base->n, columns = 2 * n + (size_t)base->n_contacts;
  *s = (modes_columns){.n = base->n, .n_columns = (int)columns};
  s->change = calloc(2 * 4 * n * columns, sizeof *s->change);
  s->rate = s->change ? s->change + 4 * n * columns : NULL;
  return s->change ? HC_OK : HC_NO_MEMORY;
}

void modes_columns_free(modes_columns *s) { free(s->change); }

/* to[count] += by from[count] */
static void add(int count, double by, const double *restrict from, double *restrict to)
{
  for (int q = 0; q < count; ++q) to[q] += by * from[q];
}

/* The same, to complex numbers whose parts are `apart` from each other. */
static void add_complex(int count, double complex by, const double *from, double *to, size_t apart)
{
  add(count, creal(by), from, to);
  if (cimag(by) != 0) add(count, cimag(by), from, to + apart);
}

/* eta_k of all columns. */
static void find_eta(const modes_columns *s, const scaled_model *m, const complex_modes *modes,
                     const contact_track *track, size_t k, int count, int ld, const double *matrix, double *eta)
{
  const size_t n = (size_t)s->n, row = (size_t)ld, contacts = (size_t)m->n_contacts, apart = (size_t)s->n_columns;
  memset(eta, 0, 2 * apart * sizeof *eta);
  for (size_t i = 0; i < n; ++i) {
    add_complex(count, modes->by_x[k * n + i], matrix + i * row, eta, apart);
    add_complex(count, modes->by_v[k * n + i] / m->by_C, matrix + (n + i) * row, eta, apart);
  }
  for (size_t j = 0; j < contacts; ++j) {
    const double pull = contact_track_forces(&track[j], &m->contact[j]).t_w;
    if (pull == 0) continue;
    const double complex held = pull * modes->along[k * contacts + j] / (m->by_K * modes->lambda[k]);
    add_complex(count, -held, matrix + (2 * n + j) * row, eta, apart);
  }
}

/* to := by z of all columns; to and z may be the same. */
static void multiply(const modes_columns *s, int count, double complex by, const double *z, double *to)
{
  const size_t apart = (size_t)s->n_columns;
  for (int q = 0; q < count; ++q) {
    const double re = z[q], im = z[apart + (size_t)q];
    to[q] = creal(by) * re - cimag(by) * im;
    to[apart + (size_t)q] = creal(by) * im + cimag(by) * re;
  }
}

void modes_columns_advance(modes_columns *s, const scaled_model *m, const complex_modes *modes,
                           const contact_track *track, double span, int count, int ld, double *matrix)
{
  const size_t n = (size_t)s->n, row = (size_t)ld, apart = (size_t)s->n_columns;
  for (size_t k = 0; k < (size_t)modes->count; ++k) {
    const double complex mu = modes->lambda[k] * m->by_C, grown = cexp(mu * span);
    double *change = s->change + k * 2 * apart, *rate = s->rate + k * 2 * apart;
    find_eta(s, m, modes, track, k, count, ld, matrix, change);
    multiply(s, count, modes->weight[k] * grown * mu, change, rate);
    multiply(s, count, modes->weight[k] * (grown - 1), change, change);
  }
  for (size_t i = 0; i < n; ++i) {
    double *x = matrix + i * row, *p = matrix + (n + i) * row;
    memset(p, 0, (size_t)count * sizeof *p);
    for (size_t k = 0; k < (size_t)modes->count; ++k) {
      const double complex V = modes->V[k * n + i];
      const double *change = s->change + k * 2 * apart, *rate = s->rate + k * 2 * apart;
      add(count, creal(V), change, x);
      add(count, creal(V), rate, p);
      if (cimag(V) == 0) continue;
      add(count, -cimag(V), change + apart, x);
      add(count, -cimag(V), rate + apart, p);
    }
  }
}
