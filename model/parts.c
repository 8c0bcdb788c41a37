/* parts.c - see parts.h. */
#include "model/parts.h"

#include <stdlib.h>

void model_join_parts(int n, int *part, int a, int b)
{
  for (int i = 0; i < n && a != b; ++i)
    if (part[i] == b) part[i] = a;
}

/* The first degree of freedom from `from` on that the contact moves; n: none. */
static int next_moved(const model *m, const model_contact *c, int from)
{
  while (from < m->n && c->tangent[from] == 0 && c->normal[from] == 0) ++from;
  return from;
}

void model_find_parts(const model *m, int *part)
{
  const int n = m->n;
  for (int i = 0; i < n; ++i) part[i] = i;
  for (int i = 0; i < n; ++i)
    for (int k = 0; k < n; ++k) {
      const size_t at = (size_t)i * (size_t)n + (size_t)k;
      if (m->mass[at] != 0 || m->damping[at] != 0 || m->stiffness[at] != 0) model_join_parts(n, part, part[i], part[k]);
    }
  for (int j = 0; j < m->n_contacts; ++j) {
    const model_contact *c = &m->contacts[j];
    const int first = next_moved(m, c, 0);
    for (int i = first; i < n; i = next_moved(m, c, i + 1)) model_join_parts(n, part, part[first], part[i]);
  }
}

hc_status model_parts_of_contacts(const model *m, int *part)
{
  int *of_dof = malloc((size_t)m->n * sizeof *of_dof);
  if (!of_dof) return HC_NO_MEMORY;
  model_find_parts(m, of_dof);
  for (int j = 0; j < m->n_contacts; ++j) {
    const int first = next_moved(m, &m->contacts[j], 0);
    part[j] = first < m->n ? of_dof[first] : -1;
  }
  free(of_dof);
  return HC_OK;
}
