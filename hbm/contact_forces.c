/* contact_forces.c - see contact_forces.h. */
#include "hbm/contact_forces.h"

#include <stdlib.h>
#include <string.h>

#include "hbm/circle_aft.h"
#include "hbm/circle_force.h"
#include "numerics/dense.h"
#include "numerics/series.h"

/* A motion u or v as a combination of few coordinates. */
typedef struct combination {
  int n, *coordinate; /* [n] */
  double *weight;     /* [n] */
} combination;

enum { GROUP_MAX_DOF = 3 };

/* Contacts that one evaluator takes together: one, in its u and v or in the one of them that it has; the two of a
 * circle, in u_1, u_2 and v if it has one; or all of an oscillator's. */
typedef struct group {
  int first;                     /* the model's contact, or the first of them */
  int n_dof;                     /* 1..GROUP_MAX_DOF */
  combination of[GROUP_MAX_DOF]; /* [n_dof] of an oscillator empty: its coordinate is q */
  bool across_only;              /* the one coordinate is v */
  exact_force *located;
  aft *sampled;
  circle_force *circle_located;
  circle_aft *circle_sampled; /* one of the four */
  double *jac;                /* [n_dof (2H+1)]^2 */
  bool differentiated;
} group;

struct contact_forces {
  int dim, length /* 2H+1 */, n_contacts, n_groups;
  bool oscillator;    /* group 0 has all contacts, in q itself */
  group *groups;      /* [n_groups] */
  int *group_of;      /* [n_contacts] */
  double *x, *f;      /* [GROUP_MAX_DOF (2H+1)] of one group */
  double *jac;        /* [dim (2H+1)]^2 once it has been asked for; NULL of an oscillator, whose group's it is */
  int n_rows;         /* coordinates of all groups */
  double *directions; /* [n_rows][dim] these in q, by columns; NULL where scattering is the faster way */
  double *product;    /* [dim][2H+1][n_rows] of the Jacobian, with `directions` */
  bool assembled;
};

/* ---- made and freed ---------------------------------------------------------------------------- */

static hc_status combine(int dim, const double *direction, combination *out)
{
  out->coordinate = calloc((size_t)dim, sizeof *out->coordinate);
  out->weight = calloc((size_t)dim, sizeof *out->weight);
  if (!out->coordinate || !out->weight) return HC_NO_MEMORY;
  for (int d = 0; d < dim; ++d) {
    if (direction[d] == 0) continue;
    out->coordinate[out->n] = d;
    out->weight[out->n++] = direction[d];
  }
  return HC_OK;
}

typedef struct evaluator_kind {
  hbm_force force;
  hbm_restart restart;
  int n_harm, n_time;
} evaluator_kind;

static hc_status make_jacobian(const evaluator_kind *kind, group *g)
{
  const size_t length = (size_t)g->n_dof * (size_t)series_length(kind->n_harm);
  g->jac = calloc(length * length, sizeof *g->jac);
  return g->jac ? HC_OK : HC_NO_MEMORY;
}

static hc_status make_evaluator(const evaluator_kind *kind, int n_contacts, const moving_contact *contacts, group *g)
{
  const hc_status st = make_jacobian(kind, g);
  if (st != HC_OK) return st;
  if (kind->force == HBM_FORCE_SAMPLED)
    return aft_new(kind->n_harm, kind->n_time, kind->restart, g->n_dof, n_contacts, contacts, &g->sampled);
  return exact_force_new(kind->n_harm, g->n_dof, n_contacts, contacts, &g->located);
}

static hc_status make_oscillator(const model *m, const evaluator_kind *kind, group *g)
{
  moving_contact *contacts;
  g->n_dof = 1;
  hc_status st = moving_contacts_of_model(m, &contacts);
  if (st == HC_OK) st = make_evaluator(kind, m->n_contacts, contacts, g);
  free(contacts);
  return st;
}

static bool is_zero(int n, const double *direction)
{
  for (int d = 0; d < n; ++d)
    if (direction[d] != 0) return false;
  return true;
}

static hc_status make_group(const contact *law, int dim, const double *tangent, const double *normal,
                            const evaluator_kind *kind, group *g)
{
  const bool along = contact_has_friction(law) && !is_zero(dim, tangent), across = !is_zero(dim, normal);
  moving_contact c = {.law = *law};
  hc_status st = HC_OK;
  if (along) c.cu[g->n_dof] = 1, st = combine(dim, tangent, &g->of[g->n_dof++]);
  if (across && st == HC_OK) c.cv[g->n_dof] = 1, st = combine(dim, normal, &g->of[g->n_dof++]);
  g->across_only = !along;
  if (g->n_dof == 0) g->n_dof = 1; /* nothing moves it: it does nothing */
  return st == HC_OK ? make_evaluator(kind, 1, &c, g) : st;
}

/* Of the contacts g->first and the next one. */
static hc_status make_circle(const contact *law, const condensation *c, const evaluator_kind *kind, group *g)
{
  const int dim = condensation_dim(c);
  const double *direction[GROUP_MAX_DOF] = {condensation_tangent(c, g->first), condensation_tangent(c, g->first + 1),
                                            condensation_normal(c, g->first)};
  hc_status st = HC_OK;
  const int n_dof = g->n_dof = is_zero(dim, direction[2]) ? 2 : 3;
  for (int d = 0; d < n_dof && st == HC_OK; ++d) st = combine(dim, direction[d], &g->of[d]);
  if (st == HC_OK) st = make_jacobian(kind, g);
  if (st != HC_OK) return st;
  if (kind->force != HBM_FORCE_SAMPLED) return circle_force_new(kind->n_harm, g->n_dof, law, &g->circle_located);
  return circle_aft_new(kind->n_harm, kind->n_time, kind->restart, g->n_dof, law, &g->circle_sampled);
}

/* Do contact j and the next one share a limit? Without friction they have none, and each is a spring. */
static bool is_circle(const model_contact *c)
{
  return c->circle && c->pair == CONTACT_FIRST && contact_has_friction(&c->law);
}

static hc_status make_groups(const model *m, const condensation *c, const evaluator_kind *kind, contact_forces *f)
{
  hc_status st = HC_OK;
  f->n_groups = f->oscillator ? 1 : 0;
  if (f->oscillator) return make_oscillator(m, kind, &f->groups[0]);
  for (int j = 0; j < m->n_contacts && st == HC_OK; ++j) {
    const contact *law = &m->contacts[j].law;
    group *g = &f->groups[f->n_groups];
    g->first = j;
    f->group_of[j] = f->n_groups++;
    if (is_circle(&m->contacts[j])) {
      st = make_circle(law, c, kind, g);
      f->group_of[++j] = f->n_groups - 1;
    } else st = make_group(law, f->dim, condensation_tangent(c, j), condensation_normal(c, j), kind, g);
  }
  return st;
}

/* Does the Jacobian cost less as a product of matrices than scattered group by group? That takes some ten times as long
 * an operation. */
static bool product_pays(const contact_forces *f)
{
  double scattered = 0;
  for (int j = 0; j < f->n_groups; ++j) {
    double entries = 0;
    for (int d = 0; d < f->groups[j].n_dof; ++d) entries += f->groups[j].of[d].n;
    scattered += entries * entries;
  }
  return 10 * scattered > (double)f->dim * f->dim * f->n_rows;
}

static hc_status make_product(contact_forces *f)
{
  enum { FEW = 8 }; /* coordinates: everything is small */
  for (int j = 0; j < f->n_groups; ++j) f->n_rows += f->groups[j].n_dof;
  if (f->oscillator || f->dim < FEW || f->n_rows == 0 || !product_pays(f)) return HC_OK;
  const size_t dim = (size_t)f->dim, rows = (size_t)f->n_rows;
  f->directions = calloc(dim * rows, sizeof *f->directions);
  f->product = calloc(dim * rows * (size_t)f->length, sizeof *f->product);
  if (!f->directions || !f->product) return HC_NO_MEMORY;
  double *row = f->directions;
  for (int j = 0; j < f->n_groups; ++j)
    for (int d = 0; d < f->groups[j].n_dof; ++d, row += dim) {
      const combination *of = &f->groups[j].of[d];
      for (int k = 0; k < of->n; ++k) row[of->coordinate[k]] = of->weight[k];
    }
  return HC_OK;
}

hc_status contact_forces_new(const model *m, const condensation *c, hbm_force force, hbm_restart restart, int n_harm,
                             int n_time, contact_forces **out)
{
  const evaluator_kind kind = {force, restart, n_harm, n_time};
  contact_forces *f = calloc(1, sizeof *f);
  *out = NULL;
  if (!f) return HC_NO_MEMORY;
  f->dim = condensation_dim(c);
  f->length = series_length(n_harm);
  f->n_contacts = m->n_contacts;
  f->oscillator = m->n == 1;
  f->groups = calloc((size_t)m->n_contacts + 1, sizeof *f->groups);
  f->group_of = calloc((size_t)m->n_contacts + 1, sizeof *f->group_of);
  f->x = calloc(GROUP_MAX_DOF * (size_t)f->length, sizeof *f->x);
  f->f = calloc(GROUP_MAX_DOF * (size_t)f->length, sizeof *f->f);
  const size_t n = (size_t)f->dim * (size_t)f->length;
  if (!f->oscillator) f->jac = calloc(n * n, sizeof *f->jac);
  const bool room = f->groups && f->group_of && f->x && f->f && (f->jac || f->oscillator);
  hc_status st = room ? make_groups(m, c, &kind, f) : HC_NO_MEMORY;
  if (st == HC_OK) st = make_product(f);
  if (st == HC_OK) *out = f;
  else contact_forces_free(f);
  return st;
}

void contact_forces_free(contact_forces *f)
{
  if (!f) return;
  for (int j = 0; j < f->n_groups && f->groups; ++j) {
    group *g = &f->groups[j];
    exact_force_free(g->located);
    aft_free(g->sampled);
    circle_force_free(g->circle_located);
    circle_aft_free(g->circle_sampled);
    free(g->jac);
    for (int d = 0; d < GROUP_MAX_DOF; ++d) {
      free(g->of[d].coordinate);
      free(g->of[d].weight);
    }
  }
  free(f->groups);
  free(f->group_of);
  free(f->x);
  free(f->f);
  free(f->jac);
  free(f->directions);
  free(f->product);
  free(f);
}

/* ---- force ------------------------------------------------------------------------------------ */

static hc_status evaluate(group *g, const double *x, double *F, contact_report *report)
{
  g->differentiated = g->located || g->circle_located; /* of sampled forces it is made when it is asked for first */
  if (g->located) return exact_force_eval(g->located, x, F, g->jac, report);
  if (g->circle_located) return circle_force_eval(g->circle_located, x, F, g->jac, report);
  return g->sampled ? aft_eval(g->sampled, x, F, NULL, report) : circle_aft_eval(g->circle_sampled, x, F, report);
}

/* x[c] = sum of the coordinates' coefficients c. */
static void gather(const contact_forces *f, const combination *of, const double *X, double *x)
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

static void add_report(contact_report *sum, const contact_report *one)
{
  if (one->regime > sum->regime) sum->regime = one->regime;
  sum->transitions += one->transitions;
  sum->free_sliders += one->free_sliders;
}

hc_status contact_forces_eval(contact_forces *f, const double *X, double *F, contact_report *report)
{
  if (f->oscillator) return evaluate(&f->groups[0], X, F, report);
  hc_status st = HC_OK;
  f->assembled = false;
  *report = (contact_report){.regime = CONTACT_LINEAR};
  memset(F, 0, (size_t)f->dim * (size_t)f->length * sizeof *F);
  for (int j = 0; j < f->n_groups && st == HC_OK; ++j) {
    group *g = &f->groups[j];
    contact_report own;
    for (int d = 0; d < g->n_dof; ++d) gather(f, &g->of[d], X, f->x + d * f->length);
    st = evaluate(g, f->x, f->f, &own);
    for (int d = 0; d < g->n_dof && st == HC_OK; ++d) scatter(f, &g->of[d], f->f + d * f->length, F);
    if (st == HC_OK) add_report(report, &own);
  }
  return st;
}

/* ---- Jacobian ---------------------------------------------------------------------------------- */

static void differentiate(group *g)
{
  if (g->differentiated) return;
  if (g->sampled) aft_jacobian(g->sampled, g->jac);
  else circle_aft_jacobian(g->circle_sampled, g->jac);
  g->differentiated = true;
}

/* One block of a group's Jacobian, from coordinate e of it to coordinate d. */
static void scatter_block(contact_forces *f, const group *g, int d, int e)
{
  const size_t length = (size_t)f->length, dim = (size_t)f->dim, rows = (size_t)g->n_dof * length, ld = dim * length;
  const combination *to = &g->of[d], *from = &g->of[e];
  for (int k = 0; k < from->n; ++k)
    for (int i = 0; i < to->n; ++i) {
      const double weight = to->weight[i] * from->weight[k];
      for (size_t q = 0; q < length; ++q) {
        const double *column = g->jac + ((size_t)e * length + q) * rows + (size_t)d * length;
        double *out = f->jac + (q * dim + (size_t)from->coordinate[k]) * ld + (size_t)to->coordinate[i];
        for (size_t p = 0; p < length; ++p) out[p * dim] += weight * column[p];
      }
    }
}

static void scatter_groups(contact_forces *f)
{
  const size_t n = (size_t)f->dim * (size_t)f->length;
  memset(f->jac, 0, n * n * sizeof *f->jac);
  for (int j = 0; j < f->n_groups; ++j)
    for (int d = 0; d < f->groups[j].n_dof; ++d)
      for (int e = 0; e < f->groups[j].n_dof; ++e) scatter_block(f, &f->groups[j], d, e);
}

/* Of one coefficient q of the motion: d(forces of all groups)/dX, product[dim][length][n_rows]. */
static void differentiate_forces(contact_forces *f, size_t q)
{
  const size_t length = (size_t)f->length, rows = (size_t)f->n_rows;
  memset(f->product, 0, (size_t)f->dim * length * rows * sizeof *f->product);
  size_t first = 0;
  for (int j = 0; j < f->n_groups; ++j) {
    const group *g = &f->groups[j];
    const size_t n_dof = (size_t)g->n_dof;
    for (size_t e = 0; e < n_dof; ++e)
      for (int k = 0; k < g->of[e].n; ++k) {
        const double weight = g->of[e].weight[k], *column = g->jac + (e * length + q) * n_dof * length;
        double *out = f->product + (size_t)g->of[e].coordinate[k] * length * rows + first;
        for (size_t p = 0; p < length; ++p)
          for (size_t d = 0; d < n_dof; ++d) out[p * rows + d] += weight * column[d * length + p];
      }
    first += n_dof;
  }
}

/* Where directions have most of the coordinates in them: B^T (J B), block by block. */
static void multiply_groups(contact_forces *f)
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
  if (f->oscillator) differentiate(&f->groups[0]);
  if (f->oscillator) return f->groups[0].jac;
  if (f->assembled) return f->jac;
  for (int j = 0; j < f->n_groups; ++j) differentiate(&f->groups[j]);
  if (f->product) multiply_groups(f);
  else scatter_groups(f);
  f->assembled = true;
  return f->jac;
}

/* ---- what was found ------------------------------------------------------------------------------ */

void contact_forces_sliders(const contact_forces *f, double *w)
{
  for (int j = 0; j < f->n_groups; ++j) {
    const group *g = &f->groups[j];
    if (g->located) exact_force_sliders(g->located, w + g->first);
    else if (g->sampled) aft_sliders(g->sampled, w + g->first);
    else if (g->circle_located) circle_force_slider(g->circle_located, w + g->first);
    else circle_aft_slider(g->circle_sampled, w + g->first);
  }
}

const contact_piece *contact_forces_pieces(const contact_forces *f, int j, int *n)
{
  return exact_force_pieces(f->groups[f->group_of[j]].located, f->oscillator ? j : 0, n);
}

const circle_cycle *contact_forces_circle(const contact_forces *f, int j)
{
  const group *g = &f->groups[f->group_of[j]];
  return g->circle_located ? circle_force_cycle(g->circle_located) : NULL;
}

void contact_forces_held_by(const contact_forces *f, int j, const contact_piece *p, double by[2])
{
  const group *g = &f->groups[f->group_of[j]];
  by[0] = g->across_only && !f->oscillator ? 0 : p->held_by_x[0];
  by[1] = g->n_dof > 1 ? p->held_by_x[1] : g->across_only && !f->oscillator ? p->held_by_x[0] : 0;
}
