/* test_contact_period.c - the rows of a model's contacts become one for each contact of the case. */
#include "model/contact_period.h"
#include "tests/check.h"

static void check_period(const contact_period *p, contact_regime regime, const double numbers[5])
{
  assert_int_equal(p->regime, regime);
  assert_true(p->normal_min == numbers[0] && p->normal_max == numbers[1] && p->traction_max == numbers[2]);
  assert_true(p->slip_distance == numbers[3] && p->work == numbers[4]);
}

/* A contact with one tangent, a pair, another one, a pair. */
static void pairs_become_one(CHECK_STATE)
{
  static const contact_pair pair[6] = {CONTACT_ALONE, CONTACT_FIRST, CONTACT_SECOND,
                                       CONTACT_ALONE, CONTACT_FIRST, CONTACT_SECOND};
  contact_period p[6] = {{CONTACT_STUCK, 1, 2, 3, 4, 5},      {CONTACT_SLIPS, 1, 2, 7, 4, 5},
                         {CONTACT_STUCK, 1, 2, 9, 0.5, 0.25}, {CONTACT_LINEAR, 0, 0, 0, 0, 0},
                         {CONTACT_SLIPS, 0.5, 8, 3, 2, 1},    {CONTACT_SEPARATES, 0.5, 8, 1, 0, 0}};
  CHECK_MADE(model, m, model_new(2, 0, 6, 1, &m));
  for (int j = 0; j < 6; ++j) m->contacts[j].pair = pair[j];
  assert_int_equal(model_whole_contacts(m), 4);
  contact_periods_merge(m, p);
  check_period(&p[0], CONTACT_STUCK, (double[]){1, 2, 3, 4, 5});
  check_period(&p[1], CONTACT_SLIPS, (double[]){2, 4, 9, 4.5, 5.25});
  check_period(&p[2], CONTACT_LINEAR, (double[]){0, 0, 0, 0, 0});
  check_period(&p[3], CONTACT_SEPARATES, (double[]){1, 16, 3, 2, 1});
  model_free(m);
}

CHECK_TESTS("model.contact_period", 60, pairs_become_one)
