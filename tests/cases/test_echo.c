/* test_echo.c - what is echoed reads back to the same bytes; the paper's scenes are what they say. */

#include "model/casefile/fields.h"
#include "tests/case_scene.h"
#include "tests/cases/case_text.h"

static void check_round_trip(const scene *sc)
{
  scene back;
  case_error err;
  char *text = echoed(sc, HC_OK);
  if (case_parse("other", text, strlen(text), 0, NULL, &back, &err) != HC_OK) fail_msg("%s\n%s", text, err.message);
  if (!scene_equals(sc, &back)) {
    char *again = echoed(&back, HC_OK);
    fail_msg("%s\nbecame\n%s", text, again);
  }
  case_clear(&back);
  free(text);
}

/* A number in the field's range: often one of its ends, else spread over the magnitudes, all bits random. */
static double random_in(const field *f, uint64_t *s)
{
  for (;;) {
    double x = ldexp(random_unit(s) + 0x1p-53, random_int(s, -1070, 1020) / (random_bits(s) % 4 ? 40 : 1));
    int what = random_int(s, 0, 9);
    if (what == 0) x = f->low;
    if (what == 1) x = f->high;
    if (what == 2) x = 0;
    if (f->low > -INFINITY && f->high < INFINITY && what > 4) x = f->low + (f->high - f->low) * random_unit(s);
    if (f->low < 0 && what % 2) x = -x;
    if (isfinite(x) && x >= f->low && x <= f->high && !(f->flags & FIELD_OPEN && x == f->low)) return x;
  }
}

static void random_list(const field *f, number_list *list, uint64_t *s)
{
  memset(list, 0, sizeof *list);
  list->n = random_bits(s) % 8 ? random_int(s, 1, 6) : NUMBER_LIST_MAX;
  for (int i = 0; i < list->n; ++i)
    list->v[i] = f->kind == FIELD_INTEGERS ? random_int(s, (int)f->low, (int)f->high) : random_in(f, s);
}

static void random_text(char *to, size_t size, uint64_t *s)
{
  static const char *const pieces[] = {
      "a", "Z", " ", "\"", "\\", "'", ":", "#", "%", "{", "]", "- ", "\xC3\xA9", "\xE2\x82\xAC", "\xF0\x9F\x98\x80",
      "~", "0", ","};
  memset(to, 0, size);
  for (int n = random_int(s, 0, 60); n > 0; --n) {
    const char *p = pieces[random_bits(s) % (sizeof pieces / sizeof *pieces)];
    if (strlen(to) + strlen(p) < size) strcat(to, p);
  }
}

static void random_field(const field *f, void *base, uint64_t *s)
{
  void *to = field_place(f, base);
  int n = 0;
  switch (f->kind) {
  case FIELD_REAL: *(double *)to = random_in(f, s); break;
  case FIELD_PAIR: ((double *)to)[0] = random_in(f, s), ((double *)to)[1] = random_in(f, s); break;
  case FIELD_INTEGER:
    *(int *)to = f->flags & FIELD_AUTO && random_bits(s) % 4 == 0 ? HBM_AUTO : random_int(s, (int)f->low, (int)f->high);
    break;
  case FIELD_FLAG: *(bool *)to = random_bits(s) % 2; break;
  case FIELD_CHOICE:
    while (f->choices[n]) ++n;
    *(int *)to = random_int(s, 0, n - 1);
    break;
  case FIELD_TEXT: random_text(to, f->size, s); break;
  default: random_list(f, to, s); break;
  }
}

/* As many limits as ranges, each range from its lower end to its upper. */
static void mend_gate_ranges(gate_ranges *r)
{
  number_list *limits[] = {&r->amplitude, &r->harmonic_1, &r->mean, &r->waveform};
  if (r->ends.n % 2) r->ends.v[--r->ends.n] = 0;
  for (int i = 0; i < r->ends.n; i += 2)
    if (r->ends.v[i] > r->ends.v[i + 1]) r->ends.v[i + 1] = r->ends.v[i];
  for (int k = 0; k < 4; ++k) {
    for (; limits[k]->n < r->ends.n / 2; ++limits[k]->n) limits[k]->v[limits[k]->n] = 1e-3;
    for (; limits[k]->n > r->ends.n / 2; --limits[k]->n) limits[k]->v[limits[k]->n - 1] = 0;
  }
  if (r->ends.n > 2) memset(limits[r->ends.n % 3], 0, sizeof *limits[0]); /* not every limit need differ there */
}

/* A contact of some law, with that law's fields alone. */
static void random_contact(scene_contact *c, uint64_t *s)
{
  field_contact_defaults(c);
  random_field(field_named("contacts", "law"), c, s);
  for (int i = 0; i < field_count(); ++i) {
    const field *f = field_at(i);
    const bool plain = f->flags & FIELD_IN_CONTACT && !(f->flags & FIELD_STRUCTURE) && f->kind != FIELD_PART;
    if (plain && field_is_of_law(f, c) && strcmp(f->name, "law") != 0) random_field(f, c, s);
  }
  if (!isfinite(scene_contact_law(c).gap) || random_bits(s) % 2) c->preload = 0;
  if (c->preload > 0) c->law.gap = 0;
  if (c->kind != SCENE_LAW_TABLE) return;
  c->n_points = random_int(s, 2, SCENE_MOST_POINTS);
  for (int i = 0; i < c->n_points; ++i) c->points[i][0] = i + random_unit(s) / 2, c->points[i][1] = random_signed(s);
}

/* Any scene a reader could have made. Of compare's rivals one is at its default, and the samples suffice. */
static void random_scene(scene *sc, uint64_t *s)
{
  field_defaults(sc);
  sc->structure = scene_oscillator(0, 0, 0, 0).structure;
  for (int n = random_int(s, 0, 3); n > 0; --n) scene_add_contact(sc, (scene_contact){.kind = 0});
  for (int i = 0; i < field_count(); ++i) {
    const field *f = field_at(i);
    if (f->flags & FIELD_STRUCTURE) continue;
    if (!(f->flags & FIELD_IN_CONTACT) && !(f->flags & FIELD_NO_ECHO))
      random_field(f, f->flags & FIELD_OSCILLATOR ? (void *)sc->structure : sc, s);
    if (f->scale != 0 && !(f->flags & FIELD_NO_ECHO)) { /* as the reader stores it */
      sc->omega_from *= f->scale, sc->omega_to *= f->scale;
    }
  }
  bool smooth = false;
  for (int j = 0; j < sc->structure->n_contacts; ++j) {
    random_contact(&sc->structure->contacts[j].given, s);
    smooth |= sc->structure->contacts[j].given.kind == CONTACT_POLYNOMIAL ||
              sc->structure->contacts[j].given.kind == CONTACT_TANH;
  }
  *(random_bits(s) % 2 ? &sc->base.amplitude : &sc->base.acceleration) = 0;
  if (random_bits(s) % 2) sc->base = (scene_base){0};
  else if (scene_base_moves(sc)) sc->structure->loads->amplitude = 0;
  mend_gate_ranges(&sc->gate.ranges);
  if (random_bits(s) % 2) sc->compare.points = 20;
  else memset(&sc->compare.omega, 0, sizeof sc->compare.omega);
  bool adapts = sc->hbm.harmonics == HBM_AUTO || sc->hbm.samples == HBM_AUTO;
  if (adapts && sc->hbm.continuation == HBM_CONTINUATION_FIXED_STEP) sc->hbm.continuation = HBM_CONTINUATION_AUTO;
  if (sc->hbm.samples != HBM_AUTO && sc->hbm.samples < 2 * sc->hbm.harmonics + 1)
    sc->hbm.samples = 2 * sc->hbm.harmonics + 1;
  if (sc->transient.law != TRANSIENT_LAW_EXACT || smooth) sc->transient.method = TRANSIENT_METHOD_CVODE;
  if (sc->omega_from == sc->omega_to) sc->omega_to = sc->omega_from > 1 ? 1 : 2;
  if (sc->transient.method == TRANSIENT_METHOD_CLOSED_FORM) sc->transient.law = TRANSIENT_LAW_EXACT;
}

static void random_scenes_come_back_bit_for_bit(CHECK_STATE)
{
  uint64_t s = 6;
  for (int i = 0; i < 2000; ++i) {
    scene sc;
    random_scene(&sc, &s);
    check_round_trip(&sc);
  }
}

static void frequencies_and_assignments_come_back_too(CHECK_STATE)
{
  scene sc;
  accepted("oscillator: {mass: 1, damping: 0, stiffness: 1}\nforcing: {amplitude: 1}\nsweep: {frequency: [0.1, 3.3]}\n",
           "title= \"x\\\" ", &sc);
  check_round_trip(&sc);
  accepted(SMALLEST, "sweep.frequency=100,125", &sc); /* 125 * 2 pi / 2 pi is not 125 */
  char *text = echoed(&sc, HC_OK);
  assert_non_null(strstr(text, "frequency: [100, 125]"));
  free(text);
}

static void what_is_no_scene_is_not_echoed(CHECK_STATE)
{
  scene sc;
  accepted(SMALLEST, NULL, &sc);
  sc.hbm.force = 7;
  free(echoed(&sc, HC_BAD_INPUT));
  accepted(SMALLEST, NULL, &sc);
  for (int j = 0; j <= SCENE_MAX_CONTACTS; ++j) scene_add_contact(&sc, (scene_contact){.kind = 0});
  free(echoed(&sc, HC_BAD_INPUT));
}

static void check_a_scene_of_the_paper(const scene *sc)
{
  check_round_trip(sc);
  assert_true(sc->structure->n_contacts >= 1 && sc->structure->contacts[0].given.law.mu == 0.3 &&
              sc->structure->contacts[0].given.angle_deg == 45 && *sc->structure->damping.v == 0.4); /* all of them */
  assert_true(sc->hbm.keep_mean);
}

static void the_papers_scenes_are_all_readable(CHECK_STATE)
{
  assert_true(each_case_of(SOURCE_DIR "/cases/paper", check_a_scene_of_the_paper) >= 25);
}

/* Against tests/reference/README.md: M, K, F0, kt, kn, gap. */
static void reference_scenes_are_what_they_say(CHECK_STATE)
{
  static const struct {
    const char *name;
    double mass, stiffness, force, kt, kn, gap;
  } all[] = {
      {"paper/case_a", 1, 40, 10, 100, 200, 0.5},
      {"paper/case1", 1, 40, 10, 100, 200, 0.5},
      {"paper/case_b", 1, 40, 10, 100, 200, -0.5},
      {"paper/case2", 1, 40, 100, 100, 1000, -5},
      {"paper/fig17_kn_1e4", 1, 40, 100, 100, 1e4, -5},
      {"paper/fig17_kn_200", 1, 40, 100, 100, 200, -5},
      {"paper/fig18_kt_1e4", 1, 40, 100, 1e4, 1000, -5},
      {"paper/fig09_gap_p1", 1, 40, 100, 100, 1000, 1},
      {"paper/fig09_gap_m5", 1, 40, 100, 100, 1000, -5},
      {"paper/fig07_f0_1", 1, 40, 1, 100, 200, 0.5},
      {"paper/fig08_f0_1", 1, 40, 1, 100, 200, -0.5},
      {"paper/table10_case1", 1.6, 8e5, 100, 5e5, 7e5, 0.3},
      {"paper/table10_case2", 1.6, 8e5, 100, 5e5, 7e5, -0.2},
  };
  for (size_t i = 0; i < sizeof all / sizeof *all; ++i) {
    const scene sc = case_scene(all[i].name, 0, NULL);
    const contact *c = &sc.structure->contacts[0].given.law;
    bool same = *sc.structure->mass.v == all[i].mass && *sc.structure->stiffness.v == all[i].stiffness &&
                sc.structure->loads->amplitude == all[i].force && c->kt == all[i].kt && c->kn == all[i].kn &&
                c->gap == all[i].gap;
    if (!same) fail_msg("%s", all[i].name);
  }
}

CHECK_TESTS("cases.echo", 120, random_scenes_come_back_bit_for_bit, frequencies_and_assignments_come_back_too,
            what_is_no_scene_is_not_echoed, the_papers_scenes_are_all_readable, reference_scenes_are_what_they_say)
