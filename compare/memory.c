/* memory.c - see memory.h. Proof: tests/command/test_memory.c. */
#include "compare/memory.h"

#include "numerics/norm.h"

static const double program = 6e6; /* [bytes] */

/* Matrices of a kind at once. */
enum { OF_STRUCTURE = 60, OF_CURVE = 6, OF_PREDICTION = 3, OF_TRANSIENT = 25 };
/* Harmonics of auto, more than most cases need; those of a prediction (hbm/curve/predict.c). */
enum { AUTO = 14, FEWEST_PREDICTED = 14, MOST_PREDICTED = 100, PREDICTED_UNKNOWNS = 1500 };

static double matrices(int count, double rows) { return 8.0 * count * rows * rows; }

/* Directions of contacts, each pair's normal once, and of the response. */
static double coordinates(const model *m)
{
  int count = 1;
  for (int j = 0; j < m->n_contacts; ++j) {
    const model_contact *c = &m->contacts[j];
    count += !is_zero(m->n, c->tangent);
    count += c->pair != CONTACT_SECOND && !is_zero(m->n, c->normal);
  }
  return fmin(count, m->n);
}

static double unknowns(const model *m, int harmonics) { return coordinates(m) * (2 * harmonics + 1); }

static int harmonics_of(const hbm_settings *how) { return how->harmonics == HBM_AUTO ? AUTO : how->harmonics; }

/* At least twice as many harmonics; more where these are few. */
static double predicted_unknowns(const model *m, const hbm_settings *how)
{
  const double twice = unknowns(m, 2 * harmonics_of(how)), fewest = unknowns(m, FEWEST_PREDICTED);
  return fmax(fmax(twice, fewest), fmin(PREDICTED_UNKNOWNS, unknowns(m, MOST_PREDICTED)));
}

double memory_of_curve(const model *m, const hbm_settings *how)
{
  return program + matrices(OF_STRUCTURE, m->n) + matrices(OF_CURVE, unknowns(m, harmonics_of(how)));
}

double memory_of_comparison(const compare_setup *setup)
{
  const model *m = setup->model;
  return memory_of_curve(m, &setup->hbm) + matrices(OF_PREDICTION, predicted_unknowns(m, &setup->hbm)) +
         matrices(OF_TRANSIENT, 2 * m->n + m->n_contacts);
}
