/* contact_motion.c - see contact_motion.h. */
#include "command/contact_motion.h"

#include <stdlib.h>
#include <string.h>

#include "base/number.h"
#include "casefile/structure.h"
#include "command/case_names.h"
#include "numerics/series.h"

static const char *const motion_names[CONTACT_MOTIONS] = {"motion", "motion-u", "motion-u2", "motion-v"};

/* X[CONTACT_MOST_COEF] from the option; the number of harmonics, 0 if it is not given, or -1 after the message. */
static int read_motion(const cli_common *common, const char *option, const char *motion, double *X)
{
  int n = 0;
  for (const char *at = motion; at;) {
    size_t length = strcspn(at, ",");
    if (n == CONTACT_MOST_COEF) {
      cli_message(common, "--%s takes at most %d coefficients", option, CONTACT_MOST_COEF);
      return -1;
    }
    if (number_read(at, length, &X[n]) != NUMBER_FINE) {
      cli_message(common, "--%s: '%.*s' is not a finite number", option, (int)length, at);
      return -1;
    }
    ++n;
    at = at[length] ? at + length + 1 : NULL;
  }
  if (motion && n % 2 == 0) {
    cli_message(common, "--%s has %d coefficients; expected an odd number: a0,a1,b1,a2,b2,...", option, n);
    return -1;
  }
  return n / 2;
}

/* Which contact: the one that is named, or the only one there is where u or v is given. 0 or the exit code after the
 * message. */
static int choose_contact(const cli_common *common, const contact_options *own, contact_motion *m)
{
  const scene *sc = common->scene;
  const bool own_motion = own->motion[CONTACT_U] || own->motion[CONTACT_U2] || own->motion[CONTACT_V];
  const bool by_itself = own_motion || own->slider;
  const int n = sc->structure ? sc->structure->n : 1;
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

static bool has_direction(int n, const double *direction)
{
  for (int i = 0; i < n; ++i)
    if (direction[i] != 0) return true;
  return false;
}

/* u along nothing would be a mistake unnoticed. */
static int check_directions(const cli_common *common, const contact_options *own, const model *of,
                            const contact_motion *m)
{
  static const char *const words[] = {"tangent", "second tangent", "normal"};
  const model_contact *c = &of->contacts[m->in_model];
  const double *const directions[] = {c->tangent, m->pair ? c[1].tangent : NULL, c->normal};
  char name[CLI_NAME];
  cli_contact_name(common, m->one, name);
  for (int d = 0; d < 3; ++d)
    if (own->motion[CONTACT_U + d] && !(directions[d] && has_direction(of->n, directions[d]))) {
      cli_message(common, "contact %s has no %s; expected no --%s", name, words[d], motion_names[CONTACT_U + d]);
      return EXIT_USAGE;
    }
  return 0;
}

/* W, or W1,W2 of two tangents. */
static bool read_slider(const char *text, contact_motion *m)
{
  const size_t first = m->pair ? strcspn(text, ",") : strlen(text);
  if (number_read(text, first, &m->slider[0]) != NUMBER_FINE) return false;
  if (!m->pair) return true;
  const char *second = text + first + 1;
  return text[first] && number_read(second, strlen(second), &m->slider[1]) == NUMBER_FINE;
}

/* The motions into m->given. 0 or the exit code after the message. */
static int read_motions(const cli_common *common, const contact_options *own, const model *of, contact_motion *m)
{
  for (int k = 0; k < CONTACT_MOTIONS; ++k) {
    const int n = read_motion(common, motion_names[k], own->motion[k], m->given[k]);
    if (n < 0) return EXIT_USAGE;
    if (n > m->n_harm) m->n_harm = n;
  }
  if (own->slider && !read_slider(own->slider, m)) {
    cli_message(common,
                m->pair ? "--slider: '%s' is not two finite numbers W1,W2, of a contact with two tangents"
                        : "--slider: '%s' is not a finite number",
                own->slider);
    return EXIT_USAGE;
  }
  if (m->one < 0) return 0;
  if (own->motion[CONTACT_X])
    for (int i = 0; i < CONTACT_MOST_COEF; ++i) {
      m->given[CONTACT_U][i] = *of->contacts[m->in_model].tangent * m->given[CONTACT_X][i];
      m->given[CONTACT_V][i] = *of->contacts[m->in_model].normal * m->given[CONTACT_X][i];
    }
  /* the law knows u - w alone: from here on the slider starts at 0 */
  for (int k = 0; k < 2; ++k) m->given[CONTACT_U + k][0] -= m->slider[k];
  return 0;
}

static hc_status take_contacts(const model *of, contact_motion *m)
{
  m->n_dof = 1;
  m->n_contacts = of->n_contacts;
  if (m->one < 0) return moving_contacts_of_model(of, &m->contacts);
  if (!(m->contacts = malloc(sizeof *m->contacts))) return HC_NO_MEMORY;
  const given_motion given = given_motion_of_contact(of, m->in_model, m->contacts);
  m->pair = given.pair;
  m->circle = given.circle;
  m->n_dof = given.n_dof;
  m->n_contacts = given.n_contacts;
  return HC_OK;
}

/* Which motion coordinate d is: x of all contacts; u, v of one, or u, u2, v. */
static int motion_at(const contact_motion *m, int d)
{
  if (m->one < 0) return CONTACT_X;
  if (d == 0) return CONTACT_U;
  return m->pair && d == 1 ? CONTACT_U2 : CONTACT_V;
}

/* X from m->given, by coordinates. */
static void pack(contact_motion *m)
{
  const size_t n = (size_t)series_length(m->n_harm);
  for (int d = 0; d < m->n_dof; ++d) memcpy(m->X + (size_t)d * n, m->given[motion_at(m, d)], n * sizeof *m->X);
}

int contact_motion_find(const cli_common *common, const contact_options *own, contact_motion *m)
{
  const scene *sc = common->scene;
  model *of = NULL;
  int code = choose_contact(common, own, m);
  if (code) return code;
  hc_status st = scene_model(sc, &of);
  m->in_model = m->one < 0 ? -1 : scene_model_contact(sc, m->one);
  if (st == HC_OK) st = take_contacts(of, m);
  if (st != HC_OK) code = cli_solver_failed(common, CLI_HBM, "the contact force", st, 0);
  else if (m->one >= 0) code = check_directions(common, own, of, m);
  if (!code) code = read_motions(common, own, of, m);
  if (m->n_harm < sc->hbm.harmonics) m->n_harm = sc->hbm.harmonics; /* auto is 0: the motion's own */
  if (m->n_harm < 1) m->n_harm = 1;
  pack(m);
  model_free(of);
  return code;
}

void contact_motion_clear(contact_motion *m)
{
  free(m->contacts);
  m->contacts = NULL;
}
