/* contact_rows.c - see contact_rows.h. */
#include "timeint/law/contact_rows.h"

#include <string.h>

#include "numerics/dense.h"
#include "numerics/norm.h"

static int keep_row(contact_rows *c, const double *row)
{
  const size_t n = (size_t)c->n;
  if (is_zero(c->n, row)) return -1;
  for (int r = 0; r < c->count; ++r)
    if (!memcmp(c->row + (size_t)r * n, row, n * sizeof *row)) return r;
  memcpy(c->row + (size_t)c->count * n, row, n * sizeof *row);
  return c->count++;
}

hc_status contact_rows_make(contact_rows *c, const modal_base *base, workspace *w)
{
  const size_t n = (size_t)base->n, contacts = (size_t)base->n_contacts;
  *c = (contact_rows){.n = base->n};
  c->row = workspace_doubles(w, 2 * n * contacts);
  c->along = workspace_array(w, contacts, sizeof *c->along);
  c->across = workspace_array(w, contacts, sizeof *c->across);
  if (w->failed) return HC_NO_MEMORY;
  for (size_t j = 0; j < contacts; ++j) {
    c->along[j] = keep_row(c, base->tangent + j * n);
    c->across[j] = keep_row(c, base->normal + j * n);
  }
  return HC_OK;
}

void contact_rows_motion(const contact_rows *c, const double *x, double *q)
{
  dense_rows_times_vector(c->n, c->count, c->row, x, q);
}

void contact_rows_pull(const contact_rows *c, double by, const double *force, double *out)
{
  dense_times_vector(c->n, c->count, -by, c->row, force, 1, out);
}
