/* structure_text.h - what the tests of structures share: texts of cases, and the model of one. */
#pragma once

#include "model/casefile/structure.h"
#include "tests/cases/case_text.h"

#define SWEEP "sweep: {omega: [3, 20]}\n"

/* Two degrees of freedom; what is appended starts on line 6. */
#define TWO                                                                                                            \
  "structure:\n  mass: [1, 0.02]\n  stiffness: [[680, -40], [-40, 40]]\n"                                              \
  "  damping: [[0.1, -0.05], [-0.05, 0.05]]\n" SWEEP
#define TWO_NAMED                                                                                                      \
  "structure:\n  mass: [1, 0.02]\n  stiffness: [[680, -40], [-40, 40]]\n  damping: {modal: 0.01}\n"                    \
  "  names: [tip, root]\n" SWEEP
#define JENKINS "{tangential_stiffness: 200, friction: 1, preload: 5, tangent: {2: 1}}"

/* The model of text with one assignment or NULL. */
static inline model *model_of(const char *text, const char *set)
{
  scene sc;
  accepted(text, set, &sc);
  CHECK_MADE(model, m, scene_model(&sc, &m));
  case_clear(&sc);
  return m;
}

/* Do two models have the same bits? */
static inline void same_models(const model *a, const model *b)
{
  const size_t n = (size_t)a->n, vector = n * sizeof(double);
  assert_int_equal(a->n, b->n);
  assert_int_equal(a->n_loads, b->n_loads);
  assert_int_equal(a->n_contacts, b->n_contacts);
  assert_int_equal(a->n_responses, b->n_responses);
  assert_memory_equal(a->mass, b->mass, n * vector);
  assert_memory_equal(a->damping, b->damping, n * vector);
  assert_memory_equal(a->stiffness, b->stiffness, n * vector);
  for (int i = 0; i < a->n_loads; ++i) {
    assert_int_equal(a->loads[i].harmonic, b->loads[i].harmonic);
    assert_int_equal(a->loads[i].inertial, b->loads[i].inertial);
    assert_memory_equal(a->loads[i].cosine, b->loads[i].cosine, vector);
    assert_memory_equal(a->loads[i].sine, b->loads[i].sine, vector);
  }
  for (int j = 0; j < a->n_contacts; ++j) {
    const contact *x = &a->contacts[j].law, *y = &b->contacts[j].law; /* there are bytes of nothing behind `smooth` */
    assert_memory_equal(x, y, offsetof(contact, smooth));
    assert_int_equal(x->smooth, y->smooth);
    assert_memory_equal(&x->epsilon, &y->epsilon, sizeof *x - offsetof(contact, epsilon));
    assert_int_equal(a->contacts[j].pair, b->contacts[j].pair);
    assert_int_equal(a->contacts[j].circle, b->contacts[j].circle);
    assert_memory_equal(a->contacts[j].tangent, b->contacts[j].tangent, vector);
    assert_memory_equal(a->contacts[j].normal, b->contacts[j].normal, vector);
  }
  assert_memory_equal(a->responses, b->responses, (size_t)a->n_responses * vector);
}

/* A file of the test's own in a new folder. */
typedef struct own_file {
  char folder[64], path[128];
} own_file;

static inline own_file write_file(const char *name, const char *text, size_t length)
{
  own_file f;
  const char *temporary = getenv("TMPDIR");
  snprintf(f.folder, sizeof f.folder, "%.40s/hbmcheck-XXXXXX", temporary ? temporary : "/tmp");
  assert_non_null(mkdtemp(f.folder));
  snprintf(f.path, sizeof f.path, "%.60s/%.60s", f.folder, name);
  FILE *to = fopen(f.path, "wb");
  assert_non_null(to);
  assert_int_equal(fwrite(text, 1, length, to), length);
  assert_int_equal(fclose(to), 0);
  return f;
}

static inline void remove_file(const own_file *f)
{
  unlink(f->path);
  rmdir(f->folder);
}
