/* contact_force.c - see contact_force.h; the forces themselves are given_motion's (hbm/). */
#include "command/contact_force.h"

#include <stdio.h>
#include <string.h>

#include "command/case_names.h"
#include "hbm/circle_force.h"
#include "hbm/circle_measures.h"
#include "hbm/contact_measures.h"
#include "hbm/exact_force.h"
#include "hbm/given_motion.h"
#include "numerics/series.h"

/* ---- forces -------------------------------------------------------------------------------------- */

static given_motion given_of(const contact_motion *m)
{
  return (given_motion){.pair = m->pair,
                        .circle = m->circle,
                        .n_harm = m->n_harm,
                        .n_dof = m->n_dof,
                        .n_contacts = m->n_contacts,
                        .contacts = m->contacts,
                        .X = m->X};
}

hc_status contact_force_of(const contact_motion *m, hbm_restart restart, int n_time, double *F)
{
  const given_motion given = given_of(m);
  const hc_status st = given_motion_force(&given, restart, n_time, F);
  if (st == HC_OK && m->one >= 0) F[(m->n_dof - 1) * series_length(m->n_harm)] += given_motion_preload(&given);
  return st;
}

/* ---- remarks ------------------------------------------------------------------------------------- */

enum { SHOWN = 16 };

static void note_more(table *t, const char *name, int n)
{
  if (n == 0) table_note(t, "contact %s: separated all period", name);
  if (n > SHOWN) table_note(t, "contact %s: and %d pieces more", name, n - SHOWN);
}

/* The pieces of the period in which a contact sticks or slips; in the rest it is separated. */
static void note_pieces(table *t, const char *name, int n, const contact_piece *p)
{
  static const char *const names[] = {"separated", "sticks", "slips forward", "slips backward"};
  for (int i = 0; i < n && i < SHOWN; ++i)
    table_note(t, "contact %s: %s from %.12g to %.12g rad", name, names[p[i].state], p[i].from, p[i].to);
  note_more(t, name, n);
}

static void note_period(table *t, const char *name, const contact_period *p)
{
  table_note(t, "contact %s: N from %.9g to %.9g, |T| at most %.9g, slip path %.9g, work %.9g in a period", name,
             p->normal_min, p->normal_max, p->traction_max, p->slip_distance, p->work);
}

static hc_status note_circle_pieces(table *t, const contact_motion *m, const char *name)
{
  const contact *law = &m->contacts->law;
  double F[CONTACT_MOST_DOF * CONTACT_MOST_COEF];
  circle_force *f = NULL;
  hc_status st = circle_force_new(m->n_harm, given_motion_circle_dof(law), law, &f);
  if (st == HC_OK) st = circle_force_eval(f, m->X, F, NULL, NULL);
  if (st == HC_OK) {
    const circle_cycle *c = circle_force_cycle(f);
    for (int i = 0; i < c->n && i < SHOWN; ++i)
      table_note(t, "contact %s: %s from %.12g to %.12g rad", name,
                 c->piece[i].state == CONTACT_STICK ? "sticks" : "slips", c->piece[i].from, c->piece[i].to);
    note_more(t, name, c->n);
  }
  circle_force_free(f);
  return st;
}

static hc_status note_circle(table *t, const contact_motion *m, const char *name)
{
  contact_period p[2];
  hc_status st = note_circle_pieces(t, m, name);
  if (st == HC_OK)
    st = circle_measures_of(&m->contacts->law, m->n_harm, m->given[CONTACT_U], m->given[CONTACT_U2],
                            m->given[CONTACT_V], p);
  if (st != HC_OK) return st;
  p[0] = contact_period_of_pair(&p[0], &p[1]);
  note_period(t, name, p);
  return HC_OK;
}

static hc_status note_halves(table *t, const contact_motion *m, const char *name)
{
  static const char *const tangents[] = {"tangential", "tangential_2"};
  contact_period p[2];
  for (int d = 0, n; d < 2; ++d) {
    const double *const x[] = {m->given[d ? CONTACT_U2 : CONTACT_U], m->given[CONTACT_V]};
    const size_t length = (size_t)series_length(m->n_harm);
    double X[2 * CONTACT_MOST_COEF], F[2 * CONTACT_MOST_COEF];
    char half[CLI_NAME + 16];
    exact_force *e = NULL;
    for (size_t k = 0; k < 2; ++k) memcpy(X + k * length, x[k], length * sizeof *X);
    snprintf(half, sizeof half, "%s, %s", name, tangents[d]);
    hc_status st = exact_force_new(m->n_harm, 2, 1, m->contacts, &e);
    if (st == HC_OK) st = exact_force_eval(e, X, F, NULL, NULL);
    if (st == HC_OK) {
      const contact_piece *piece = exact_force_pieces(e, 0, &n);
      note_pieces(t, half, n, piece);
    }
    exact_force_free(e);
    if (st == HC_OK) st = contact_measures_of(&m->contacts->law, m->n_harm, x[0], x[1], &p[d]);
    if (st != HC_OK) return st;
  }
  p[0] = contact_period_of_pair(&p[0], &p[1]);
  note_period(t, name, p);
  return HC_OK;
}

static hc_status note_measures(table *t, const contact_motion *m, const char *name)
{
  contact_period p;
  hc_status st = contact_measures_of(&m->contacts->law, m->n_harm, m->given[CONTACT_U], m->given[CONTACT_V], &p);
  if (st == HC_OK) note_period(t, name, &p);
  return st;
}

hc_status contact_force_note(table *t, const cli_common *common, const contact_motion *m)
{
  double F[2 * CONTACT_MOST_COEF];
  char name[CLI_NAME];
  const given_motion given = given_of(m);
  if (m->pair) cli_contact_name(common, m->one, name);
  if (m->pair) return given_motion_in_circle(&given) ? note_circle(t, m, name) : note_halves(t, m, name);
  exact_force *e = NULL;
  hc_status st = exact_force_new(m->n_harm, m->n_dof, m->n_contacts, m->contacts, &e);
  if (st == HC_OK) st = exact_force_eval(e, m->X, F, NULL, NULL);
  for (int j = 0, n; j < m->n_contacts && st == HC_OK; ++j) {
    const contact_piece *p = exact_force_pieces(e, j, &n);
    note_pieces(t, cli_contact_name(common, m->one < 0 ? j : m->one, name), n, p);
  }
  if (st == HC_OK && m->one >= 0) st = note_measures(t, m, name);
  exact_force_free(e);
  return st;
}
