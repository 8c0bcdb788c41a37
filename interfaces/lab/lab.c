/* lab.c - see lab.h: the case, the table, the words. Questions: the other files. */
#include "interfaces/lab/lab.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "compare/first_guess.h"
#include "interfaces/lab/lab_inside.h"
#include "numerics/base/growing.h"

lab *lab_new(void) { return calloc(1, sizeof(lab)); }

static void drop_curves(lab *l)
{
  for (int f = 0; f < LAB_FORCES; ++f) {
    hbm_solver_free(l->kept[f].solver);
    hbm_curve_free(&l->kept[f].curve);
    l->kept[f] = (lab_kept){0};
  }
}

void lab_free(lab *l)
{
  if (!l) return;
  drop_curves(l);
  case_clear(&l->sc);
  free(l->values);
  free(l->words);
  free(l);
}

/* ---- the case ---- */

static hc_status read_oscillator(const char *text, scene *sc, case_error *err)
{
  hc_status st = case_parse("case", text, strlen(text), 0, NULL, sc, err);
  if (st != HC_OK) return st;
  bool other_law = false;
  for (int j = 0; j < scene_contact_count(sc); ++j) {
    const int kind = scene_contact_at(sc, j)->kind;
    other_law |= kind > LAB_POLYNOMIAL && kind != LAB_TABLE;
  }
  if (scene_is_oscillator(sc) && !other_law && !scene_base_moves(sc)) return HC_OK;
  snprintf(err->message, sizeof err->message, "case: %s",
           !scene_is_oscillator(sc) ? "structure: the lab has one degree of freedom, an `oscillator` was expected"
           : scene_base_moves(sc)
               ? "base: the lab has a force, `forcing` was expected"
               : "the lab has no fields for a contact's law, contact, polynomial or table were expected");
  case_clear(sc);
  return HC_BAD_INPUT;
}

int lab_read(lab *l, const char *text)
{
  scene sc;
  case_error err = {""};
  const hc_status st = read_oscillator(text, &sc, &err);
  lab_begin(l, 0);
  if (st == HC_OK) {
    drop_curves(l);
    case_clear(&l->sc);
    l->sc = sc;
    l->has_case = true;
    l->n_harm = 0;
  }
  lab_answer(l, st);
  if (err.message[0]) memcpy(l->message, err.message, sizeof l->message);
  return st;
}

int lab_case(lab *l)
{
  _Static_assert((int)LAB_POLYNOMIAL == CONTACT_POLYNOMIAL && (int)LAB_TABLE == SCENE_LAW_TABLE, "lab.h says so");
  lab_begin(l, LAB_POINTS + 2 * SCENE_MOST_POINTS);
  if (!l->has_case) return lab_answer(l, HC_BAD_INPUT);
  const scene *sc = &l->sc;
  const scene_structure *s = sc->structure;
  const hbm_settings *h = &sc->hbm;
  hc_status st =
      LAB_ADD(l, *s->mass.v, *s->damping.v, *s->stiffness.v, s->loads->amplitude, sc->omega_from, sc->omega_to,
              h->harmonics, h->samples, h->keep_mean, h->force == HBM_FORCE_SAMPLED, h->restart == HBM_RESTART_SAMPLE);
  for (int j = 0; j < s->n_contacts && st == HC_OK; ++j) {
    const scene_contact *c = &s->contacts[j].given;
    double *row = lab_row(l);
    if (!row) return lab_answer(l, HC_NO_MEMORY);
    /* The page has no constant normal force: of a contact along x it is that of any spring and gap. */
    const contact law = scene_contact_law(c);
    const bool slides = law.load > 0 && law.kn == 0;
    const double touching[] = {law.kt, slides ? law.load : law.kn, law.mu, c->angle_deg, slides ? 1 : law.gap};
    if (c->kind == CONTACT_KINKED) memcpy(row, touching, sizeof touching);
    if (c->kind == CONTACT_POLYNOMIAL) memcpy(row, c->law.power, sizeof c->law.power);
    memcpy(row + LAB_POINTS, c->points, (size_t)c->n_points * sizeof *c->points);
    row[LAB_LAW] = c->kind;
  }
  return lab_answer(l, st);
}

const char *lab_title(const lab *l) { return l->sc.title; }

hc_status lab_scene(const lab *l, int force, scene *out)
{
  if (!l->has_case || force < 0 || force >= LAB_FORCES) return HC_BAD_INPUT;
  *out = l->sc;
  out->hbm.force = force == LAB_EXACT ? HBM_FORCE_EXACT : HBM_FORCE_SAMPLED;
  return HC_OK;
}

void lab_exact_law(scene *sc)
{
  sc->transient.law = TRANSIENT_LAW_EXACT;
  sc->transient.method = TRANSIENT_METHOD_CLOSED_FORM;
  for (int j = 0; j < scene_contact_count(sc); ++j)
    if (scene_contact_law(scene_contact_at(sc, j)).smooth != CONTACT_KINKED)
      sc->transient.method = TRANSIENT_METHOD_CVODE;
}

hc_status lab_solver(const scene *sc, hbm_solver **out)
{
  model *m;
  *out = NULL;
  hc_status st = scene_model(sc, &m);
  if (st == HC_OK) st = guided_hbm_solver_new(m, &sc->hbm, out);
  model_free(m);
  return st;
}

/* ---- the answer ---- */

void lab_begin(lab *l, int columns)
{
  free(l->values);
  l->values = NULL;
  l->rows = l->n_named = l->n_words = 0;
  l->columns = columns;
}

void lab_begin_results(lab *l, rows_kind kind, int series)
{
  lab_begin(l, 0);
  l->n_named = rows_columns(kind, ROWS_IN_MEMORY, l->named);
  l->columns = l->n_named - (series > 0) + series;
}

double *lab_row(lab *l)
{
  double *grown = growing(l->values, l->rows, (size_t)l->columns * sizeof *grown);
  if (!grown) return NULL;
  l->values = grown;
  double *row = l->values + (size_t)l->rows++ * (size_t)l->columns;
  for (int i = 0; i < l->columns; ++i) row[i] = NAN;
  return row;
}

hc_status lab_add(lab *l, size_t n, const double *numbers)
{
  double *row = lab_row(l);
  if (row) memcpy(row, numbers, n * sizeof *row);
  return row ? HC_OK : HC_NO_MEMORY;
}

/* The number of a text among the table's; -1: out of memory. */
static int word_number(lab *l, const char *text)
{
  for (int i = 0; i < l->n_words; ++i)
    if (!strcmp(l->words[i], text)) return i;
  if (!GROW(l->words, l->n_words)) return -1;
  snprintf(l->words[l->n_words], sizeof *l->words, "%s", text);
  return l->n_words++;
}

hc_status lab_add_result(lab *l, rows_kind kind, const void *of)
{
  row_cell cells[ROWS_MOST];
  const int n = rows_cells(kind, of, ROWS_IN_MEMORY, cells);
  double *row = lab_row(l);
  if (!row) return HC_NO_MEMORY;
  for (int c = 0; c < n; ++c) {
    const row_cell *cell = &cells[c];
    if (!cell->there) continue;
    if (cell->kind == TABLE_REAL) row[c] = cell->as.real;
    if (cell->kind == TABLE_INTEGER) row[c] = (double)cell->as.integer;
    if (cell->kind == TABLE_TEXT && (row[c] = word_number(l, cell->as.text)) < 0) return HC_NO_MEMORY;
    if (cell->kind == TABLE_SERIES) memcpy(row + c, cell->as.series.v, (size_t)cell->as.series.n * sizeof *row);
  }
  return HC_OK;
}

int lab_answer(lab *l, hc_status st)
{
  snprintf(l->message, sizeof l->message, "%s", st == HC_OK ? "" : hc_status_text(st));
  return (int)st;
}

const char *lab_message(const lab *l) { return l->message; }
int lab_rows(const lab *l) { return l->rows; }
int lab_columns(const lab *l) { return l->columns; }
const double *lab_values(const lab *l) { return l->values; }

const char *lab_name(const lab *l, int c) { return c < l->n_named ? l->named[c].name : NULL; }
const char *lab_kind(const lab *l, int c)
{
  static const char *const kinds[] = {"text", "integer", "real", "series"}; /* of table_kind */
  return c < l->n_named ? kinds[l->named[c].kind] : NULL;
}
const char *lab_word(const lab *l, int i) { return i < l->n_words ? l->words[i] : NULL; }
int lab_column(const lab *l, const char *name)
{
  int c = l->n_named;
  while (--c >= 0 && strcmp(l->named[c].name, name) != 0) continue;
  return c;
}
