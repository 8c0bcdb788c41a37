/* cmd_contact.c - hbmcheck contact: Fourier coefficients of the contact force of a given motion. */
#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "compare/output/table.h"
#include "hbm/contact/contact_measures.h"
#include "hbm/contact/exact_force.h"
#include "hbm/forces/contact_kind.h"
#include "hbm/forces/given_motion.h"
#include "hbm/planar/planar_force.h"
#include "hbm/planar/planar_measures.h"
#include "interfaces/command/case_names.h"
#include "interfaces/command/cli.h"
#include "interfaces/command/commands.h"
#include "numerics/base/number.h"
#include "numerics/norm.h"
#include "numerics/series.h"

/* ---- the motion that is asked about ------------------------------------------------------------ */

/* x of one degree of freedom, which moves all contacts; or u (u_1, u_2) and v of one contact. */
enum { CONTACT_X, CONTACT_U, CONTACT_U2, CONTACT_V, CONTACT_MOTIONS };
typedef struct contact_options {
  const char *contact;                 /* NULL: not given */
  const char *motion[CONTACT_MOTIONS]; /* the same */
  const char *slider;                  /* the same */
  number_list samples;
} contact_options;

typedef struct contact_motion {
  int one;      /* which contact of the case, -1: all */
  int in_model; /* the same of its model, -1: all of a model's */
  const scene_contact
      *table;      /* NULL: that contact is none; its springs, a model by themselves, are moved by d, its v */
  given_motion of; /* with these: */
  moving_contact *contacts;
  double slider[2];                               /* [length] where it starts: taken off u, or u_1 and u_2 */
  double given[CONTACT_MOTIONS][GIVEN_MOST_COEF]; /* [length] x; or u - slider, of two tangents both, and v */
  double X[GIVEN_MOST_DOF * GIVEN_MOST_COEF];
} contact_motion;

static const char *const motion_names[CONTACT_MOTIONS] = {"motion", "motion-u", "motion-u2", "motion-v"};

/* X[GIVEN_MOST_COEF] from the option; the number of harmonics, 0 if it is not given, or -1 after the message. */
static int read_motion(const cli_common *common, const char *option, const char *motion, double *X)
{
  int n = 0;
  for (const char *at = motion; at;) {
    size_t length = strcspn(at, ",");
    if (n == GIVEN_MOST_COEF)
      return cli_failed(common, -1, "--%s takes at most %d coefficients", option, GIVEN_MOST_COEF);
    if (number_read(at, length, &X[n++]) != NUMBER_FINE)
      return cli_failed(common, -1, "--%s: '%.*s' is not a finite number", option, (int)length, at);
    at = at[length] ? at + length + 1 : NULL;
  }
  if (motion && n % 2 == 0)
    return cli_failed(common, -1, "--%s has %d coefficients; expected an odd number: a0,a1,b1,a2,b2,...", option, n);
  return n / 2;
}

/* The contact that is named, or the only one where u or v is given. 0 or the exit code after the message. */
static int choose_contact(const cli_common *common, const contact_options *own, contact_motion *m)
{
  const scene *sc = common->scene;
  const bool own_motion = own->motion[CONTACT_U] || own->motion[CONTACT_U2] || own->motion[CONTACT_V];
  const bool by_itself = own_motion || own->slider;
  const int n = sc->structure->n;
  m->one = -1;
  if (own->contact && (m->one = cli_contact_named(common, own->contact)) < 0) return EXIT_USAGE;
  if (m->one < 0 && (by_itself || n > 1) && scene_contact_count(sc) == 1) m->one = 0;
  if (m->one < 0 && by_itself) cli_message(common, "of which contact? expected --contact NAME, too");
  else if (m->one < 0 && n > 1)
    cli_message(common,
                "the case has %d degrees of freedom; expected --contact NAME with its --motion-u and --motion-v", n);
  else if (n > 1 && own->motion[CONTACT_X])
    cli_message(common,
                "--motion is for one degree of freedom, and the case has %d; expected --motion-u and --motion-v", n);
  else if (own->motion[CONTACT_X] && own_motion)
    cli_message(common,
                "--motion is of x, and u and v follow from it; expected --motion, or --motion-u and --motion-v");
  else if (!own->motion[CONTACT_X] && !own_motion)
    cli_message(common, m->one < 0 ? "no motion given: --motion a0,a1,b1,..."
                                   : "no motion given: --motion-u a0,a1,b1,... and --motion-v a0,a1,b1,...");
  else return 0;
  return EXIT_USAGE;
}

/* u along nothing would be a mistake unnoticed. */
static int check_directions(const cli_common *common, const contact_options *own, const model *of,
                            const contact_motion *m)
{
  static const char *const words[] = {"tangent", "second tangent", "normal"};
  const model_contact *c = &of->contacts[m->table ? 0 : m->in_model];
  const double *const directions[] = {c->tangent, m->of.pair ? c[1].tangent : NULL, c->normal};
  char name[CLI_NAME];
  cli_contact_name(common, m->one, name);
  for (int d = 0; d < 3; ++d)
    if (own->motion[CONTACT_U + d] && (!directions[d] || is_zero(of->n, directions[d])))
      return cli_failed(common, EXIT_USAGE, "contact %s has no %s; expected no --%s", name, words[d],
                        motion_names[CONTACT_U + d]);
  return 0;
}

/* W, or W1,W2 of two tangents. */
static bool read_slider(const char *text, contact_motion *m)
{
  const size_t first = m->of.pair ? strcspn(text, ",") : strlen(text);
  if (number_read(text, first, &m->slider[0]) != NUMBER_FINE) return false;
  if (!m->of.pair) return true;
  const char *second = text + first + 1;
  return text[first] && number_read(second, strlen(second), &m->slider[1]) == NUMBER_FINE;
}

/* The motions into m->given. 0 or the exit code after the message. */
static int read_motions(const cli_common *common, const contact_options *own, const model *of, contact_motion *m)
{
  for (int k = 0; k < CONTACT_MOTIONS; ++k) {
    const int n = read_motion(common, motion_names[k], own->motion[k], m->given[k]);
    if (n < 0) return EXIT_USAGE;
    if (n > m->of.n_harm) m->of.n_harm = n;
  }
  if (own->slider && !read_slider(own->slider, m))
    return cli_failed(common, EXIT_USAGE,
                      m->of.pair ? "--slider: '%s' is not two finite numbers W1,W2, of a contact with two tangents"
                                 : "--slider: '%s' is not a finite number",
                      own->slider);
  if (m->one < 0) return 0;
  if (m->table && own->motion[CONTACT_X]) memcpy(m->given[CONTACT_V], m->given[CONTACT_X], sizeof *m->given);
  else if (own->motion[CONTACT_X])
    for (int i = 0; i < GIVEN_MOST_COEF; ++i) {
      m->given[CONTACT_U][i] = *of->contacts[m->in_model].tangent * m->given[CONTACT_X][i];
      m->given[CONTACT_V][i] = *of->contacts[m->in_model].normal * m->given[CONTACT_X][i];
    }
  /* the law knows u - w alone: from here on the slider starts at 0 */
  for (int k = 0; k < 2; ++k) m->given[CONTACT_U + k][0] -= m->slider[k];
  return 0;
}

static hc_status take_contacts(const model *of, contact_motion *m)
{
  if (m->in_model < 0) {
    const hc_status st = moving_contacts_of_model(of, &m->contacts);
    m->of = (given_motion){.n_dof = 1, .n_contacts = of->n_contacts, .contacts = m->contacts, .X = m->X};
    return st;
  }
  if (!(m->contacts = malloc(sizeof *m->contacts))) return HC_NO_MEMORY;
  m->of = given_motion_of_contact(of, m->in_model, m->contacts);
  m->of.X = m->X;
  return HC_OK;
}

/* The model of an oscillator whose one contact is that table. */
static hc_status table_alone(const scene_contact *given, model **out)
{
  scene_structure *s = structure_new_oscillator(1, 0, 0, 0);
  structure_contact *c = s ? structure_add_contact(s) : NULL;
  if (c) c->given = *given;
  const hc_status st = c ? structure_model(s, out) : HC_NO_MEMORY;
  structure_free(s);
  return st;
}

/* The motion, of as many harmonics as it or the case has. 0 or the exit code; m->contacts is to be freed. */
static int contact_motion_find(const cli_common *common, const contact_options *own, contact_motion *m)
{
  const scene *sc = common->scene;
  model *of = NULL;
  int code = choose_contact(common, own, m);
  if (code) return code;
  const scene_contact *one = m->one < 0 ? NULL : scene_contact_at(sc, m->one);
  if (one && scene_contact_is_composed(one)) m->table = one;
  hc_status st = m->table ? table_alone(m->table, &of) : scene_model(sc, &of);
  m->in_model = m->one < 0 || m->table ? -1 : scene_model_contact(sc, m->one);
  if (st == HC_OK) st = take_contacts(of, m);
  if (st != HC_OK) code = cli_solver_failed(common, CLI_HBM, "the contact force", st, 0);
  else if (m->one >= 0) code = check_directions(common, own, of, m);
  if (!code) code = read_motions(common, own, of, m);
  if (m->of.n_harm < sc->hbm.harmonics) m->of.n_harm = sc->hbm.harmonics; /* auto is 0: the motion's own */
  if (m->of.n_harm < 1) m->of.n_harm = 1;
  const size_t n = (size_t)series_length(m->of.n_harm);
  for (int d = 0; d < m->of.n_dof; ++d) {
    const int motion = m->one < 0             ? CONTACT_X
                       : m->table             ? CONTACT_V
                       : d == 0               ? CONTACT_U
                       : m->of.pair && d == 1 ? CONTACT_U2
                                              : CONTACT_V;
    memcpy(m->X + (size_t)d * n, m->given[motion], n * sizeof *m->X);
  }
  model_free(of);
  return code;
}

/* ---- in words what the exact law does along it ------------------------------------------- */

enum { SHOWN = 16 };

static void note_more(table *t, const char *name, int n)
{
  if (n == 0) table_note(t, "contact %s: separated all period", name);
  if (n > SHOWN) table_note(t, "contact %s: and %d pieces more", name, n - SHOWN);
}

/* Where each contact sticks or slips (else it is separated); names of the case from `first` on, and `part`. */
static hc_status note_pieces(table *t, const cli_common *common, const given_motion *of, int first, const char *part)
{
  static const char *const words[] = {"separated", "sticks", "slips forward", "slips backward"};
  char name[CLI_NAME + 16];
  double F[2 * GIVEN_MOST_COEF];
  exact_force *e = NULL;
  hc_status st = exact_force_new(of->n_harm, of->n_dof, of->n_contacts, of->contacts, &e);
  if (st == HC_OK) st = exact_force_eval(e, of->X, F, NULL, NULL);
  for (int j = 0, n; j < of->n_contacts && st == HC_OK; ++j) {
    const contact_interval *p = exact_force_intervals(e, j, &n);
    if (contact_never_opens(&of->contacts[j].law)) continue;
    snprintf(name, sizeof name, "%s%s", cli_contact_name(common, first + j, (char[CLI_NAME]){0}), part);
    for (int i = 0; i < n && i < SHOWN; ++i)
      table_note(t, "contact %s: %s from %.12g to %.12g rad", name, words[p[i].state], p[i].from, p[i].to);
    note_more(t, name, n);
  }
  exact_force_free(e);
  return st;
}

/* The lines below the table of a contact with two tangents under the law of the circle. */
static hc_status note_circle(table *t, const contact_motion *m, const char *name, contact_period p[2])
{
  const contact *law = &m->contacts->law;
  double F[GIVEN_MOST_DOF * GIVEN_MOST_COEF];
  planar_force *f = NULL;
  hc_status st = planar_force_new(m->of.n_harm, given_motion_planar_dof(law), law, &f);
  if (st == HC_OK) st = planar_force_eval(f, m->X, F, NULL, NULL);
  if (st == HC_OK) {
    const planar_cycle *c = planar_force_cycle(f);
    for (int i = 0; i < c->n && i < SHOWN; ++i)
      table_note(t, "contact %s: %s from %.12g to %.12g rad", name,
                 c->interval[i].state == CONTACT_STICK ? "sticks" : "slips", c->interval[i].from, c->interval[i].to);
    note_more(t, name, c->n);
  }
  planar_force_free(f);
  if (st != HC_OK) return st;
  return planar_measures_of(law, m->of.n_harm, m->given[CONTACT_U], m->given[CONTACT_U2], m->given[CONTACT_V], p);
}

static hc_status note_halves(table *t, const cli_common *common, const contact_motion *m, contact_period p[2])
{
  static const char *const parts[] = {", tangential", ", tangential_2"};
  hc_status st = HC_OK;
  for (int d = 0; d < 2 && st == HC_OK; ++d) {
    const double *const x[] = {m->given[d ? CONTACT_U2 : CONTACT_U], m->given[CONTACT_V]};
    const size_t length = (size_t)series_length(m->of.n_harm);
    double X[2 * GIVEN_MOST_COEF];
    for (size_t k = 0; k < 2; ++k) memcpy(X + k * length, x[k], length * sizeof *X);
    const given_motion half = {.n_harm = m->of.n_harm, .n_dof = 2, .n_contacts = 1, .contacts = m->contacts, .X = X};
    st = note_pieces(t, common, &half, m->one, parts[d]);
    if (st == HC_OK) st = contact_measures_of(&m->contacts->law, m->of.n_harm, x[0], x[1], &p[d]);
  }
  return st;
}

/* Below the table: when each contact sticks and slips; of one contact extrema, slip path and work, too. */
static hc_status contact_force_note(table *t, const cli_common *common, const contact_motion *m)
{
  char name[CLI_NAME];
  contact_period p[2];
  if (m->one < 0) return note_pieces(t, common, &m->of, 0, "");
  if (m->table) return HC_OK; /* nothing sticks or slips */
  cli_contact_name(common, m->one, name);
  hc_status st = given_motion_is_planar(&m->of) ? note_circle(t, m, name, p)
                 : m->of.pair                   ? note_halves(t, common, m, p)
                                                : note_pieces(t, common, &m->of, m->one, "");
  if (st == HC_OK && m->of.pair) p[0] = contact_period_of_pair(&p[0], &p[1]);
  else if (st == HC_OK) {
    const placed_contact one = {.law = m->contacts->law};
    st = contact_kind_of(&one)->measures(&one.law, m->of.n_harm, m->given[CONTACT_U], NULL, m->given[CONTACT_V], p);
  }
  if (st == HC_OK)
    table_note(t, "contact %s: N from %.9g to %.9g, |T| at most %.9g, slip path %.9g, work %.9g in a period", name,
               p->normal_min, p->normal_max, p->traction_max, p->slip_distance, p->work);
  return st;
}

static const char help[] =
    "You test a contact element of your own: Fourier coefficients of CASE's contact force sum_j T_j cos(alpha_j) + "
    "(N_j - N0_j) sin(alpha_j) under the motion x = a0 + a1 cos + b1 sin + a2 cos 2 + ... of --motion; or of one "
    "contact's T and N under its own u and v, of --motion-u and --motion-v (--motion-u2: the second tangent): exact, "
    "or as hbm.force says, and sampled at each N of --samples."
    "\vRow 0 is the mean. As many harmonics as the motion or hbm.harmonics has, whichever is more. With --contact a "
    "column `force`: first the rows of `tangential`, of two tangents of `tangential_2`, then those of `normal`, N0 "
    "included.\n"
    "example: hbmcheck contact cases/paper/case2.yaml --motion 0,8,0 --samples 64,512\n"
    "example: hbmcheck contact cases/structures/chain3.yaml --contact ground --motion-u 0,0.1,0";

static const cli_option options[] = {
    {CLI_TEXT, "motion", "a0,a1,b1,...", "The motion's coefficients, an odd number of them; of one DOF",
     offsetof(contact_options, motion[CONTACT_X])},
    {CLI_TEXT, "contact", "NAME", "One contact, by its name or its number from 0", offsetof(contact_options, contact)},
    {CLI_TEXT, "motion-u", "a0,a1,b1,...", "Its tangential motion [none]",
     offsetof(contact_options, motion[CONTACT_U])},
    {CLI_TEXT, "motion-u2", "a0,a1,b1,...", "The same along its second tangent [none]",
     offsetof(contact_options, motion[CONTACT_U2])},
    {CLI_TEXT, "motion-v", "a0,a1,b1,...", "Its normal motion [none]", offsetof(contact_options, motion[CONTACT_V])},
    {CLI_TEXT, "slider", "W",
     "Where its slider starts (of two tangents W1,W2), if it never separates and the start decides [0]",
     offsetof(contact_options, slider)},
    {CLI_LIST, "samples", "LIST", "Also at these numbers of samples per period", offsetof(contact_options, samples)},
    CLI_PLOT_OPTION,
    {0},
};

/* A set: the coefficients for one number of samples. */
enum { MAX_SETS = 17, MOST_NUMBERS = GIVEN_MOST_DOF * GIVEN_MOST_COEF };

/* What drives each coordinate of m->X, of one contact T (T_1, T_2) and N, for each number of samples n_time[n_sets],
 * into F[n_sets][MOST_NUMBERS]. 0 or the exit code after the message. */
static int evaluate(const cli_common *common, const contact_motion *m, const int *n_time, int n_sets,
                    double (*F)[MOST_NUMBERS])
{
  for (int i = 0; i < n_sets; ++i) {
    hc_status st = given_motion_force(&m->of, common->scene->hbm.restart, n_time[i], F[i]);
    if (st == HC_BAD_INPUT)
      return cli_failed(common, EXIT_USAGE, "%d samples are too few for %d harmonics; expected at least %d", n_time[i],
                        m->of.n_harm, 2 * m->of.n_harm + 1);
    cli_ended(common, st);
    if (st != HC_OK) return cli_solver_failed(common, CLI_HBM, "the contact force", st, 0);
    for (int k = 0; m->table && k < series_length(m->of.n_harm); ++k)
      F[i][k] += scene_contact_slope(m->table) * m->X[k] + (k == 0 ? scene_contact_table(m->table, 0) : 0);
    if (m->in_model >= 0) F[i][(m->of.n_dof - 1) * series_length(m->of.n_harm)] += given_motion_preload(&m->of);
  }
  return 0;
}

static int write_table(const cli_common *common, const contact_motion *m, const int *n_time, int n_sets,
                       double (*F)[MOST_NUMBERS])
{
  static const char *const forces[] = {"tangential", "tangential_2", "normal"};
  const scene *sc = common->scene;
  const bool single = m->one >= 0;
  table_column columns[2 + 2 * MAX_SETS] = {TEXT("force"), INTEGER("harmonic"), REAL("cos"), REAL("sin")};
  char names[2 * MAX_SETS][24];
  for (int i = 1; i < n_sets; ++i)
    for (int part = 0; part < 2; ++part) {
      snprintf(names[2 * i + part], sizeof names[0], "%s_%d", part ? "sin" : "cos", n_time[i]);
      columns[2 + 2 * i + part] = (table_column){names[2 * i + part], TABLE_REAL};
    }
  table *t = table_new("Contact force", 1 + single + 2 * n_sets, columns + !single);
  for (int d = 0; d < m->of.n_dof; ++d)
    for (int h = 0; h <= m->of.n_harm; ++h) {
      if (single) table_put_text(t, forces[d == m->of.n_dof - 1 ? 2 : d]);
      table_put_integer(t, h);
      for (int i = 0; i < n_sets; ++i) {
        const double *f = F[i] + d * series_length(m->of.n_harm);
        table_put_real(t, h ? f[2 * h - 1] : f[0]);
        table_put_real(t, h ? f[2 * h] : 0);
      }
    }
  if (n_time[0] == GIVEN_EXACT) table_note(t, "%s: cos and sin exact", sc->title);
  else table_note(t, "%s: cos and sin by sampling, N = %d", sc->title, n_time[0]);
  hc_status st = contact_force_note(t, common, m);
  int code =
      st == HC_NO_MEMORY ? cli_solver_failed(common, CLI_HBM, "the contact force", st, 0) : cli_write(common, 1, &t);
  table_free(t);
  return code;
}

/* The numbers of samples, the first one of the case. How many, or -1 after the message. */
static int list_sets(const cli_common *common, const contact_options *own, int n_time[MAX_SETS])
{
  const scene *sc = common->scene;
  static const double most = 1 << 24;
  int n_sets = 0;
  n_time[n_sets++] = sc->hbm.force == HBM_FORCE_EXACT ? GIVEN_EXACT : sc->hbm.samples;
  for (int i = 0; i < own->samples.n; ++i) {
    const double n = own->samples.v[i];
    if (n_sets == MAX_SETS) return cli_failed(common, -1, "--samples takes at most %d numbers", MAX_SETS - 1);
    if (n != floor(n) || n > most)
      return cli_failed(common, -1, "--samples: %.15g is not a whole number 3..%.0f", n, most);
    n_time[n_sets++] = (int)n;
  }
  return n_sets;
}

static int put_forces(cli_common *common, const contact_options *own, const contact_motion *m)
{
  const scene *sc = common->scene;
  int n_time[MAX_SETS];
  if (sc->hbm.force == HBM_FORCE_SAMPLED && sc->hbm.samples == HBM_AUTO)
    return cli_failed(common, EXIT_NO_SOLUTION,
                      "hbm.samples: auto chooses along a response curve, and there is none here; try --set "
                      "hbm.samples=N, or --set hbm.force=exact");
  const int n_sets = list_sets(common, own, n_time);
  if (n_sets < 0) return EXIT_USAGE;
  double(*F)[MOST_NUMBERS] = calloc(MAX_SETS, sizeof *F);
  if (!F) return cli_solver_failed(common, CLI_HBM, "the contact force", HC_NO_MEMORY, 0);
  int code = evaluate(common, m, n_time, n_sets, F);
  if (!code) code = write_table(common, m, n_time, n_sets, F);
  const plot_motion motion = {m->one < 0 ? 0 : m->one, {m->slider[0], m->slider[1]}, &m->of};
  if (!code && common->drawing.path) code = cli_plotted(common, plot_contact(&common->drawing, sc, &motion));
  free(F);
  return code;
}

static int run_contact(cli_common *common, void *own, scene *sc)
{
  (void)sc;
  contact_motion motion = {0};
  int code = contact_motion_find(common, own, &motion);
  if (!code) code = put_forces(common, own, &motion);
  free(motion.contacts);
  return code;
}

CLI_COMMAND(contact, contact_options, "CASE", "Fourier coefficients of the contact force of a given motion");
