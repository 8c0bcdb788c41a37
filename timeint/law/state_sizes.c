/* state_sizes.c - see state_sizes.h. Proof: tests/timeint/test_sizes.c. */
#include "timeint/law/state_sizes.h"

#include <math.h>
#include <string.h>

#include "numerics/norm.h"

static const double not_moved = 1e-10; /* [largest vibration] a row that moves less moves by rounding only */
static const double grown = 2;         /* [1] factor by which a vibration must grow to be updated */

hc_status state_sizes_make(state_sizes *s, const modal_base *base, workspace *memory)
{
  *s = (state_sizes){.n = base->n, .n_contacts = base->n_contacts};
  s->n_rows = 2 * base->n_contacts + base->n_responses;
  s->vibration = workspace_doubles(memory, (size_t)s->n_rows);
  s->own = workspace_doubles(memory, (size_t)s->n_rows);
  s->of = workspace_doubles(memory, 2 * (size_t)base->n + (size_t)base->n_contacts);
  return memory->failed ? HC_NO_MEMORY : HC_OK;
}

/* b[n] of row r. */
static const double *row_of(const state_sizes *s, const modal_base *base, int r)
{
  const size_t n = (size_t)s->n;
  if (r < s->n_contacts) return base->tangent + (size_t)r * n;
  if (r < 2 * s->n_contacts) return base->normal + (size_t)(r - s->n_contacts) * n;
  return base->response + (size_t)(r - 2 * s->n_contacts) * n;
}

/* Quasi-static response of row b to the alternating loads (state_sizes.h). */
static double driven(const modal_base *base, const double *b, double omega)
{
  const size_t n = (size_t)base->n;
  double moves = 0;
  for (int l = 0; l < base->n_loads; ++l) {
    const double *cosine = base->cosine + (size_t)l * n, *sine = base->sine + (size_t)l * n;
    const double at = base->harmonic[l] * omega, factor = model_load_factor(base->inertial[l], omega);
    for (size_t i = 0; i < n && base->harmonic[l] > 0; ++i)
      moves += fabs(b[i]) * factor * hypot(cosine[i], sine[i]) /
               (fabs(base->K[base->diagonal_K ? i : i * (n + 1)]) + at * at);
  }
  return moves;
}

void state_sizes_begin(state_sizes *s, const modal_base *base, const model *m, double omega)
{
  for (int r = 0; r < s->n_rows; ++r) {
    const double *b = row_of(s, base, r);
    const int j = r < s->n_contacts ? r : r - s->n_contacts;
    s->vibration[r] = driven(base, b, omega);
    s->own[r] = r < 2 * s->n_contacts && !is_zero(s->n, b) ? contact_length(&m->contacts[j].law) : 0;
  }
}

/* [L] Size of row r, for the largest vibration `most`; 1 for rows that are ignored. */
static double unit_of(const state_sizes *s, int r, double most)
{
  const double size = fmax(s->vibration[r], s->own[r]) / most;
  return size > not_moved && size < STATE_SIZES_ALIKE ? size / STATE_SIZES_ALIKE : 1;
}

double state_sizes_unit(const state_sizes *s, int r) { return unit_of(s, r, norm_max(s->n_rows, s->vibration)); }

double state_sizes_slider(const state_sizes *s, int j) { return fmax(s->vibration[j], s->own[j]); }

bool state_sizes_see(state_sizes *s, const modal_base *base, double length, const double *y)
{
  bool any = false;
  for (int r = 0; r < s->n_rows; ++r) {
    const double *b = row_of(s, base, r);
    const double now = length * hypot(dot_product(s->n, b, y), dot_product(s->n, b, y + s->n));
    if (!(now > grown * s->vibration[r])) continue;
    s->vibration[r] = now;
    any = true;
  }
  return any;
}

void state_sizes_find(state_sizes *s, const modal_base *base, double rounding, const double *y)
{
  const int n = s->n, contacts = s->n_contacts;
  const double most = norm_max(s->n_rows, s->vibration);
  for (int i = 0; i < 2 * n + contacts; ++i) s->of[i] = 1;
  for (int r = 0; r < s->n_rows; ++r) {
    const double *b = row_of(s, base, r), size = unit_of(s, r, most);
    for (int i = 0; i < n && size < 1; ++i)
      if (fabs(b[i]) * s->of[i] > size) s->of[i] = size / fabs(b[i]);
    if (r < contacts) s->of[2 * n + r] = size;
  }
  for (int i = 0; i < n; ++i) s->of[i] = s->of[n + i] = fmin(fmax(s->of[i], rounding * hypot(y[i], y[n + i])), 1);
}

double state_sizes_norm(int n, const double *size, const double *z)
{
  double sum = 0;
  for (int i = 0; i < n; ++i) sum += z[i] / size[i] * (z[i] / size[i]);
  return sqrt(sum);
}

double state_sizes_distance(int n, const double *size, const double *a, const double *b)
{
  double sum = 0;
  for (int i = 0; i < n; ++i) sum += (a[i] - b[i]) / size[i] * ((a[i] - b[i]) / size[i]);
  return sqrt(sum);
}
