/* scaled.c - see scaled.h; the equations stand there. */
#include "timeint/law/scaled.h"

#include <string.h>

#include "numerics/norm.h"

/* Kinked laws with one tangent, with two that share a limit; smooth laws. */
static const law_kind *const kinds[] = {&law_line, &law_planar};
#define ROW(code, name) [code] = &law_##name,
static const law_kind *const smooth_kinds[] = {CONTACT_SMOOTH_LIST(ROW)};
#undef ROW

/* [vibration times regularisation] width of the corner; at 1e-4 it changes case 2 by less than the slider's lag does,
 * 2e-5. */
static const double of_vibration = 0.25;

/* Width [length] of the corner in N of contact j, proportional to its own vibration (without its mean and its gap). */
static double corner_width(const scaled_model *m, const transient_settings *how, int j, double length)
{
  if (how->law == TRANSIENT_LAW_EXACT) return 0;
  return of_vibration * how->regularisation * (m->vibration ? m->vibration[j] : length);
}

/* unit [force/length]: unit of force over unit of length. */
static void make_contact(scaled_contact *sc, const model_contact *from, double unit, double omega, double length,
                         double width, const transient_settings *how, bool moves_along)
{
  contact law = contact_in_units(&from->law, unit, length, omega * length);
  if (!moves_along) law.kt = 0; /* u = 0 always: no tangential force */
  sc->law = law_regularised_make(&law, width / length, how->regularisation);
  sc->preload = contact_preload(&law);
  sc->kind = law.smooth != CONTACT_KINKED ? smooth_kinds[law.smooth] : kinds[from->circle && sc->law.has_friction];
  sc->direction = sc->kind->directions > 1 && from->pair == CONTACT_SECOND;
}

double scaled_force_unit(const scaled_model *m, double omega, double length)
{
  const double mass = 1 / (m->base->s * m->base->s);
  return mass * omega * omega * length;
}

void scaled_make(scaled_model *m, const model *from, const transient_settings *how, double omega, double length)
{
  const double unit = scaled_force_unit(m, omega, 1);
  m->n = from->n;
  m->n_contacts = from->n_contacts;
  m->n_states = 2 * from->n + from->n_contacts;
  m->by_K = 1 / (omega * omega);
  m->by_C = 1 / omega;
  m->by_rates = false;
  m->by_load = 1 / (omega * omega * length);
  for (int j = 0; j < from->n_contacts; ++j) {
    const model_contact *c = &from->contacts[j];
    make_contact(&m->contact[j], c, unit, omega, length, corner_width(m, how, j, length), how, scaled_pull(m, j) > 0);
    m->by_rates |= m->contact[j].kind->by_rates;
  }
}

void scaled_contact_motion(const scaled_model *m, int j, const double *x, double u[2], double *v)
{
  const size_t n = (size_t)m->n, at = (size_t)j * n;
  u[0] = dot_product(m->n, m->base->tangent + at, x);
  if (m->contact[j].direction + 1 < scaled_directions(m, j)) u[1] = dot_product(m->n, m->base->tangent + at + n, x);
  *v = dot_product(m->n, m->base->normal + at, x);
}

contact_motion scaled_motion_at(const scaled_model *m, int j, const double *y)
{
  contact_motion at;
  scaled_contact_motion(m, j, y, at.u, &at.v);
  scaled_contact_motion(m, j, y + m->n, at.du, &at.dv);
  return at;
}

/* U and V of contact j, and their rates where a law depends on them, at y. */
static contact_motion law_motion(const scaled_model *m, int j, const double *y)
{
  contact_motion at = {0};
  if (m->by_rates) return scaled_motion_at(m, j, y);
  scaled_contact_motion(m, j, y, at.u, &at.v);
  return at;
}

double scaled_response(const scaled_model *m, int r, const double *x)
{
  return dot_product(m->n, m->base->response + (size_t)r * (size_t)m->n, x);
}

int scaled_n_responses(const scaled_model *m) { return m->base->n_responses; }

contact_state scaled_state_of(const scaled_model *m, int j, double v, const planar_value *at)
{
  const law_regularised *law = &m->contact[j].law;
  if (!(law->kn > 0 ? v + law->gap > 0 : law->load > 0)) return CONTACT_SEPARATED;
  if (at->rate[0] < 0 && scaled_directions(m, j) == 1) return CONTACT_SLIP_MINUS;
  return at->rate[0] != 0 || at->rate[1] != 0 ? CONTACT_SLIP_PLUS : CONTACT_STICK;
}

contact_state scaled_contact_state(const scaled_model *m, int j, const double *y)
{
  const int first = scaled_first(m, j);
  const contact_motion moves = law_motion(m, first, y);
  const planar_value at = m->contact[first].kind->evaluate(&m->contact[first].law, &moves, y + 2 * m->n + first);
  return scaled_state_of(m, first, moves.v, &at);
}

double scaled_pull(const scaled_model *m, int j)
{
  const double *t = m->base->tangent + (size_t)j * (size_t)m->n;
  return sqrt(dot_product(m->n, t, t));
}

void scaled_linear_force(const scaled_model *m, double theta, const double *y, double *out)
{
  const modal_base *b = m->base;
  const int n = m->n;
  memset(out, 0, (size_t)n * sizeof *out);
  for (int l = 0; l < b->n_loads; ++l) {
    const double by = scaled_by_load(m, l), c = by * cos(b->harmonic[l] * theta), s = by * sin(b->harmonic[l] * theta);
    const double *cosine = b->cosine + (size_t)l * (size_t)n, *sine = b->sine + (size_t)l * (size_t)n;
    for (int i = 0; i < n; ++i) out[i] += c * cosine[i] + s * sine[i];
  }
  modal_base_subtract_K(b, m->by_K, y, out);
  modal_base_subtract_C(b, m->by_C, y + n, out);
}

bool scaled_rhs(const scaled_model *m, double theta, const double *y, double *dy)
{
  const int n = m->n;
  double *force = dy + n, sum = 0;
  scaled_linear_force(m, theta, y, force);
  for (int j = 0; j < m->n_contacts; j += scaled_directions(m, j)) {
    /* The regularised law of the contact whose first direction is j, at y. */
    const scaled_contact *c = &m->contact[j];
    const contact_motion moves = law_motion(m, j, y);
    const planar_value l = c->kind->evaluate(&c->law, &moves, y + 2 * m->n + j);
    for (int a = 0; a < scaled_directions(m, j); ++a) {
      const size_t at = (size_t)(j + a) * (size_t)n;
      const double *t = m->base->tangent + at, *normal = m->base->normal + at;
      for (int i = 0; i < n; ++i) force[i] -= l.t[a] * t[i] + l.change * normal[i];
      dy[2 * n + j + a] = l.rate[a];
      sum += l.rate[a];
    }
  }
  for (int i = 0; i < n; ++i) {
    dy[i] = y[n + i];
    sum += y[n + i] + force[i];
  }
  return isfinite(sum);
}
