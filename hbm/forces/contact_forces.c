/* contact_forces.c - see contact_forces.h. */
#include "hbm/forces/contact_forces.h"

#include <string.h>

#include "numerics/base/workspace.h"
#include "numerics/dense.h"

/* One coordinate of a contact: x = sum of weight[i] q[coordinate[i]]. */
typedef struct combination {
  int n, *coordinate; /* [n] */
  double *weight;     /* [n] */
} combination;

/* A contact, or the two halves of one with two tangents under one limit. */
typedef struct member {
  int first, contacts; /* index of its first contact in the model; number of contacts, 1 or 2 */
  int n_dof;
  combination of[EVALUATOR_MOST_DOF]; /* [n_dof] */
  double cu[SERIES_MAX_DIM], cv[SERIES_MAX_DIM];
  contact_evaluator by;
  void *evaluator;
  double *jac; /* [n_dof (2H+1)]^2 */
  bool differentiated;
  contact_regime regime; /* of the last evaluation */
} member;

struct contact_forces {
  int dim, length /* 2H+1 */, n_members;
  member *members;    /* [n_members] */
  bool itself;        /* one contact with one coordinate, which is q: X, F and the Jacobian are used directly */
  int *member_of;     /* [contacts] */
  double *x, *f;      /* [EVALUATOR_MOST_DOF (2H+1)] motion and forces of one member */
  double *jac;        /* [dim (2H+1)]^2 */
  int n_rows;         /* number of coordinates of all members */
  double *directions; /* [n_rows][dim] directions of these in q; NULL where scattering is faster */
  double *product;    /* [dim][2H+1][n_rows] work for the Jacobian; with `directions` only */
  bool assembled;
  workspace memory; /* of all of these */
};

/* ---- made and freed ---------------------------------------------------------------------------- */

static hc_status forces_combine(workspace *memory, int dim, const double *direction, double divisor, combination *out)
{
  out->coordinate = workspace_array(memory, (size_t)dim, sizeof *out->coordinate);
  out->weight = workspace_doubles(memory, (size_t)dim);
  if (memory->failed) return HC_NO_MEMORY;
  for (int d = 0; d < dim; ++d) {
    if (direction[d] == 0) continue;
    out->coordinate[out->n] = d;
    out->weight[out->n++] = direction[d] / divisor;
  }
  return HC_OK;
}

static hc_status make_member(const placed_contact *c, int dim, hbm_force force, const evaluator_settings *how,
                             workspace *memory, member *m)
{
  const contact_kind *kind = contact_kind_of(c);
  contact_coordinates x;
  kind->coordinates(c, dim, &x);
  m->by = force == HBM_FORCE_SAMPLED ? *kind->sampled : *kind->exact;
  m->contacts = kind->contacts;
  const hc_status made = how->plug_in ? how->plug_in->make(how->plug_in, m->first, &x, c, how, &m->by, &m->evaluator)
                                      : m->by.make(&x, how, &m->evaluator);
  if (made != HC_OK) return made;
  m->n_dof = x.n_dof;
  memcpy(m->cu, x.moved.cu, sizeof m->cu);
  memcpy(m->cv, x.moved.cv, sizeof m->cv);
  for (int d = 0; d < x.n_dof; ++d) {
    const hc_status st = forces_combine(memory, dim, x.direction[d], x.divisor[d], &m->of[d]);
    if (st != HC_OK) return st;
  }
  const size_t length = (size_t)m->n_dof * (size_t)series_length(how->n_harm);
  m->jac = workspace_doubles(memory, length * length);
  return m->jac ? HC_OK : HC_NO_MEMORY;
}

/* True if the Jacobian is faster as a matrix product than scattered member by member, which takes some ten times as
 * long per operation. */
static bool product_pays(const contact_forces *f)
{
  double scattered = 0;
  for (int j = 0; j < f->n_members; ++j) {
    double entries = 0;
    for (int d = 0; d < f->members[j].n_dof; ++d) entries += f->members[j].of[d].n;
    scattered += entries * entries;
  }
  return 10 * scattered > (double)f->dim * f->dim * f->n_rows;
}

static hc_status make_product(contact_forces *f)
{
  enum { FEW = 8 }; /* coordinates q below which scattering is fast enough */
  for (int j = 0; j < f->n_members; ++j) f->n_rows += f->members[j].n_dof;
  if (f->dim < FEW || f->n_rows == 0 || !product_pays(f)) return HC_OK;
  const size_t dim = (size_t)f->dim, rows = (size_t)f->n_rows;
  f->directions = workspace_array(&f->memory, dim * rows, sizeof *f->directions);
  f->product = workspace_array(&f->memory, dim * rows * (size_t)f->length, sizeof *f->product);
  if (f->memory.failed) return HC_NO_MEMORY;
  double *row = f->directions;
  for (int j = 0; j < f->n_members; ++j)
    for (int d = 0; d < f->members[j].n_dof; ++d, row += dim) {
      const combination *of = &f->members[j].of[d];
      for (int k = 0; k < of->n; ++k) row[of->coordinate[k]] = of->weight[k];
    }
  return HC_OK;
}

hc_status contact_forces_new_of(int dim, int n, const placed_contact *contacts, hbm_force force,
                                const evaluator_settings *how, contact_forces **out)
{
  contact_forces *f = calloc(1, sizeof *f);
  *out = NULL;
  if (!f) return HC_NO_MEMORY;
  f->dim = dim;
  f->length = series_length(how->n_harm);
  const size_t unknowns = (size_t)dim * (size_t)f->length, most = EVALUATOR_MOST_DOF * (size_t)f->length;
  f->members = workspace_array(&f->memory, (size_t)n + 1, sizeof *f->members);
  f->member_of = workspace_array(&f->memory, (size_t)n + 1, sizeof *f->member_of);
  f->x = workspace_array(&f->memory, most, sizeof *f->x);
  f->f = workspace_array(&f->memory, most, sizeof *f->f);
  f->jac = workspace_array(&f->memory, unknowns * unknowns, sizeof *f->jac);
  hc_status st = f->memory.failed ? HC_NO_MEMORY : HC_OK;
  for (int j = 0; j < n && st == HC_OK; ++f->n_members) {
    member *m = &f->members[f->n_members];
    m->first = j;
    st = make_member(&contacts[j], dim, force, how, &f->memory, m);
    for (int k = 0; k < m->contacts; ++k) f->member_of[j++] = f->n_members;
  }
  if (st == HC_OK) st = make_product(f);
  f->itself = st == HC_OK && dim == 1 && n == 1 && f->members->n_dof == 1 &&
              f->members->of[0].n == 1; /* its weight is then 1 */
  if (st == HC_OK) *out = f;
  else contact_forces_free(f);
  return st;
}

hc_status contact_forces_new(const model *m, const condensation *c, hbm_force force, const evaluator_settings *how,
                             contact_forces **out)
{
  placed_contact *placed = calloc((size_t)m->n_contacts + 1, sizeof *placed);
  *out = NULL;
  if (!placed) return HC_NO_MEMORY;
  for (int j = 0; j < m->n_contacts; ++j) {
    placed[j] = placed_contact_of(m, j);
    placed[j].tangent = c ? condensation_tangent(c, j) : m->contacts[j].tangent;
    placed[j].normal = c ? condensation_normal(c, j) : m->contacts[j].normal;
    if (placed[j].planar) placed[j].tangent_2 = c ? condensation_tangent(c, j + 1) : m->contacts[j + 1].tangent;
  }
  const int dim = c ? condensation_dim(c) : m->n;
  const hc_status st = contact_forces_new_of(dim, m->n_contacts, placed, force, how, out);
  free(placed);
  double w[2];
  for (int i = 0; st == HC_OK && i < (*out)->n_members; ++i) {
    const member *at = &(*out)->members[i];
    for (int d = 0; d < at->contacts; ++d) w[d] = m->contacts[at->first + d].rest;
    if (at->by.start) at->by.start(at->evaluator, w);
  }
  return st;
}

void contact_forces_free(contact_forces *f)
{
  if (!f) return;
  for (int j = 0; j < f->n_members; ++j) f->members[j].by.free(f->members[j].evaluator);
  workspace_free(&f->memory);
  free(f);
}

/* ---- force ------------------------------------------------------------------------------------ */

/* x[c] = sum of the coordinates' coefficients c. */
static void forces_gather(const contact_forces *f, const combination *of, const double *X, double *x)
{
  memset(x, 0, (size_t)f->length * sizeof *x);
  for (int i = 0; i < of->n; ++i) {
    const double weight = of->weight[i], *from = X + of->coordinate[i];
    for (int c = 0; c < f->length; ++c) x[c] += weight * from[(size_t)c * (size_t)f->dim];
  }
}

static void scatter(const contact_forces *f, const combination *of, const double *x, double *F)
{
  for (int i = 0; i < of->n; ++i) {
    const double weight = of->weight[i];
    double *to = F + of->coordinate[i];
    for (int c = 0; c < f->length; ++c) to[(size_t)c * (size_t)f->dim] += weight * x[c];
  }
}

hc_status contact_forces_eval(contact_forces *f, const double *X, double *F, bool derive, contact_report *report)
{
  hc_status st = HC_OK;
  f->assembled = false;
  *report = (contact_report){.regime = CONTACT_LINEAR};
  if (!f->itself) memset(F, 0, (size_t)f->dim * (size_t)f->length * sizeof *F);
  for (int j = 0; j < f->n_members && st == HC_OK; ++j) {
    member *m = &f->members[j];
    contact_report own;
    for (int d = 0; d < m->n_dof && !f->itself; ++d) forces_gather(f, &m->of[d], X, f->x + d * f->length);
    st = m->by.evaluate(m->evaluator, f->itself ? X : f->x, f->itself ? F : f->f, derive ? m->jac : NULL, &own);
    m->differentiated = derive && !m->by.jacobian;
    for (int d = 0; d < m->n_dof && st == HC_OK && !f->itself; ++d) scatter(f, &m->of[d], f->f + d * f->length, F);
    if (st != HC_OK) continue;
    m->regime = own.regime;
    report->regime = contact_regime_larger(report->regime, own.regime);
    report->transitions += own.transitions;
    report->free_sliders += own.free_sliders;
  }
  return st;
}

/* ---- Jacobian ---------------------------------------------------------------------------------- */

/* One block of a member's Jacobian, from coordinate e of it to coordinate d. */
static void scatter_block(contact_forces *f, const member *m, int d, int e)
{
  const size_t length = (size_t)f->length, dim = (size_t)f->dim, rows = (size_t)m->n_dof * length, ld = dim * length;
  const combination *to = &m->of[d], *from = &m->of[e];
  for (int k = 0; k < from->n; ++k)
    for (int i = 0; i < to->n; ++i) {
      const double weight = to->weight[i] * from->weight[k];
      for (size_t q = 0; q < length; ++q) {
        const double *column = m->jac + ((size_t)e * length + q) * rows + (size_t)d * length;
        double *out = f->jac + (q * dim + (size_t)from->coordinate[k]) * ld + (size_t)to->coordinate[i];
        for (size_t p = 0; p < length; ++p) out[p * dim] += weight * column[p];
      }
    }
}

static void scatter_members(contact_forces *f)
{
  const size_t n = (size_t)f->dim * (size_t)f->length;
  memset(f->jac, 0, n * n * sizeof *f->jac);
  for (int j = 0; j < f->n_members; ++j)
    for (int d = 0; d < f->members[j].n_dof; ++d)
      for (int e = 0; e < f->members[j].n_dof; ++e) scatter_block(f, &f->members[j], d, e);
}

/* product[dim][length][n_rows] = d(forces of all members)/dX, for one coefficient q of the motion. */
static void differentiate_forces(contact_forces *f, size_t q)
{
  const size_t length = (size_t)f->length, rows = (size_t)f->n_rows;
  memset(f->product, 0, (size_t)f->dim * length * rows * sizeof *f->product);
  size_t first = 0;
  for (int j = 0; j < f->n_members; ++j) {
    const member *m = &f->members[j];
    const size_t n_dof = (size_t)m->n_dof;
    for (size_t e = 0; e < n_dof; ++e)
      for (int k = 0; k < m->of[e].n; ++k) {
        const double weight = m->of[e].weight[k], *column = m->jac + (e * length + q) * n_dof * length;
        double *out = f->product + (size_t)m->of[e].coordinate[k] * length * rows + first;
        for (size_t p = 0; p < length; ++p)
          for (size_t d = 0; d < n_dof; ++d) out[p * rows + d] += weight * column[d * length + p];
      }
    first += n_dof;
  }
}

/* The Jacobian as B^T (J B), block by block, for directions with few zeros. */
static void multiply_members(contact_forces *f)
{
  const size_t n = (size_t)f->dim * (size_t)f->length;
  for (int q = 0; q < f->length; ++q) {
    differentiate_forces(f, (size_t)q);
    dense_multiply(f->dim, f->length * f->dim, f->n_rows, f->directions, f->product,
                   f->jac + (size_t)q * (size_t)f->dim * n);
  }
}

const double *contact_forces_jacobian(contact_forces *f)
{
  if (f->assembled) return f->jac;
  for (int j = 0; j < f->n_members; ++j) {
    member *m = &f->members[j];
    if (!m->differentiated) m->by.jacobian(m->evaluator, m->jac);
    m->differentiated = true;
  }
  if (f->itself) return f->members->jac;
  if (f->product) multiply_members(f);
  else scatter_members(f);
  f->assembled = true;
  return f->jac;
}

/* ---- what was found ------------------------------------------------------------------------------ */

void contact_forces_sliders(const contact_forces *f, double *w)
{
  for (int j = 0; j < f->n_members; ++j) f->members[j].by.sliders(f->members[j].evaluator, w + f->members[j].first);
}

void contact_forces_start(contact_forces *f, const double *w)
{
  for (member *m = f->members; m < f->members + f->n_members; ++m)
    if (m->by.start) m->by.start(m->evaluator, w + m->first);
}

static const member *member_of(const contact_forces *f, int j) { return &f->members[f->member_of[j]]; }

const contact_interval *contact_forces_intervals(const contact_forces *f, int j, int *n)
{
  const member *m = member_of(f, j);
  *n = 0;
  return m->first == j ? m->by.intervals(m->evaluator, n) : NULL;
}

const planar_cycle *contact_forces_planar(const contact_forces *f, int j)
{
  const member *m = member_of(f, j);
  return m->first == j && m->by.in_plane ? m->by.in_plane(m->evaluator) : NULL;
}

bool contact_forces_bends(const contact_forces *f, int j) { return member_of(f, j)->by.slopes != NULL; }

contact_slopes contact_forces_slopes(const contact_forces *f, int j, double th, double omega)
{
  const member *m = member_of(f, j);
  return m->by.slopes(m->evaluator, th, omega);
}

contact_regime contact_forces_regime(const contact_forces *f, int j) { return member_of(f, j)->regime; }

bool contact_forces_at(contact_forces *f, double omega)
{
  bool any = false;
  for (int j = 0; j < f->n_members; ++j) {
    member *m = &f->members[j];
    if (!m->by.at_omega) continue;
    m->by.at_omega(m->evaluator, omega);
    any = true;
  }
  return any;
}

void contact_forces_add_by_omega(const contact_forces *f, double *dF)
{
  for (int j = 0; j < f->n_members; ++j) {
    const member *m = &f->members[j];
    const double *by = m->by.by_omega ? m->by.by_omega(m->evaluator) : NULL;
    for (int d = 0; d < m->n_dof && by; ++d) scatter(f, &m->of[d], by + d * f->length, dF);
  }
}

/* If u and v are multiples of one coordinate x, all of d held/dx is attributed to u: by[0] = (d held/dx)/(du/dx). */
void contact_forces_held_by(const contact_forces *f, int j, const contact_interval *p, double by[2])
{
  const member *m = member_of(f, j);
  by[0] = by[1] = 0;
  for (int d = 0; d < m->n_dof && d < SERIES_MAX_DIM; ++d) {
    if (m->cu[d] != 0) by[0] += p->held_by_x[d] / m->cu[d];
    else if (m->cv[d] != 0) by[1] += p->held_by_x[d] / m->cv[d];
  }
}
