/* test_fields.c - defaults inside their ranges, names unique, rivals mutual; describe shows all fields. */
#include "model/casefile/fields.h"
#include "tests/cases/case_text.h"

static void defaults_pass_their_own_reader(CHECK_STATE)
{
  for (int i = 0, bad; i < field_count(); ++i) {
    const field *f = field_at(i);
    scene sc; /* larger than a scene_contact */
    char text[256];
    message m;
    field_value v;
    if (!f->fallback || !*f->fallback) continue;
    message_start(&m, text, sizeof text);
    field_split(f, f->fallback, strlen(f->fallback), &v);
    if (!field_store(f, &sc, &v, &m, &bad)) fail_msg("%s.%s%s", f->section, f->name, text);
  }
}

static void defaults_are_those_of_the_interface(CHECK_STATE)
{
  scene sc;
  static const double harmonics[] = {1, 3, 5, 10}, samples[] = {32, 128, 512, 2048};
  accepted(SMALLEST, NULL, &sc);
  assert_string_equal(sc.title, "f");
  assert_string_equal(sc.unit_length, "m");
  assert_string_equal(sc.unit_force, "N");
  assert_string_equal(sc.unit_time, "s");
  assert_int_equal(sc.structure->n_contacts, 0);
  assert_true(sc.hbm.harmonics == 5 && sc.hbm.keep_mean && sc.hbm.samples == 1024 &&
              sc.hbm.restart == HBM_RESTART_INTERPOLATED);
  assert_true(sc.hbm.continuation == HBM_CONTINUATION_AUTO && sc.hbm.tolerance == 1e-10);
  assert_true(sc.hbm.step == 0.02 && sc.hbm.iterations == 20);
  assert_true(sc.transient.law == TRANSIENT_LAW_REGULARISED && sc.transient.regularisation == 1e-4 &&
              sc.transient.tolerance == 1e-9);
  assert_true(sc.transient.steady == TRANSIENT_STEADY_AUTO && sc.transient.start == TRANSIENT_START_HBM &&
              sc.transient.max_periods == 20000);
  assert_true(sc.compare.omega.n == 0 && sc.compare.points == 20);
  assert_int_equal(sc.compare.harmonics.n, 4);
  assert_int_equal(sc.compare.samples.n, 4);
  assert_memory_equal(sc.compare.harmonics.v, harmonics, sizeof harmonics);
  assert_memory_equal(sc.compare.samples.v, samples, sizeof samples);
  assert_true(sc.gate.most.amplitude == 1e-3 && sc.gate.most.harmonic_1 == 1e-3 && sc.gate.most.mean == 1e-3 &&
              sc.gate.most.waveform == 5e-3);
}

static void rows_are_sound(CHECK_STATE)
{
  for (int i = 0; i < field_count(); ++i) {
    const field *f = field_at(i);
    assert_ptr_equal(field_find(f->section, f->name, strlen(f->name)), f); /* unique */
    assert_true(!*f->section || field_find_section(f->section, strlen(f->section)));
    assert_true(strlen(f->meaning) > 0);
    const size_t of_contact = f->kind == FIELD_PART ? sizeof(structure_contact) : sizeof(scene_contact);
    assert_true(f->offset < (f->flags & FIELD_IN_CONTACT     ? of_contact
                             : f->flags & FIELD_IN_LOAD      ? sizeof(structure_load)
                             : f->flags & FIELD_IN_STRUCTURE ? sizeof(scene_structure)
                             : f->flags & FIELD_OSCILLATOR   ? sizeof(scene_structure)
                                                             : sizeof(scene)));
    assert_int_equal((f->flags & FIELD_IN_CONTACT) != 0, !strcmp(f->section, "contacts"));
    assert_int_equal((f->flags & FIELD_IN_LOAD) != 0, !strcmp(f->section, "forcing[]"));
    assert_true(f->kind != FIELD_PART || f->expects);
    if (f->kind != FIELD_TEXT && f->kind != FIELD_FLAG && f->kind != FIELD_CHOICE && f->kind != FIELD_PART)
      assert_true(f->low < f->high && *f->unit);
    assert_int_equal(f->group != NULL, field_rival(f, 0) != NULL);
    const field *rival;
    for (int k = 0; (rival = field_rival(f, k)) != NULL; ++k) {
      assert_ptr_not_equal(rival, f);
      assert_string_equal(rival->section, f->section);
      assert_string_equal(rival->group, f->group);
    }
  }
}

/* What describe writes about `name`, in a buffer to free. */
static char *described(const char *name, hc_status expect, case_error *err)
{
  char *text = NULL;
  size_t size;
  FILE *to = open_memstream(&text, &size);
  assert_int_equal(case_describe(name, to, err), expect);
  fclose(to);
  return text;
}

static void describe_mentions_every_field(CHECK_STATE)
{
  case_error err;
  char *all = described(NULL, HC_OK, &err), path[FIELD_PATH];
  for (const char *line = all; *line;) {
    size_t n = strcspn(line, "\n");
    if (n > 100) fail_msg("%.*s", (int)n, line);
    line += n + (line[n] == '\n');
  }
  for (int i = 0; i < field_count(); ++i) {
    const field *f = field_at(i);
    assert_non_null(strstr(all, f->meaning));
    assert_non_null(strstr(all, f->name));
    char *one = described(field_path(f, -1, path), HC_OK, &err);
    assert_non_null(strstr(one, f->meaning));
    assert_ptr_equal(strstr(one, path), one);
    assert_true(!*f->unit || strstr(one, f->unit));
    assert_true(!f->fallback || strstr(one, f->fallback));
    for (int c = 0; f->choices && f->choices[c]; ++c) assert_non_null(strstr(one, f->choices[c]));
    free(one);
  }
  free(all);
}

static void describe_finds_by_section_name_and_symbol(CHECK_STATE)
{
  static const char *const all[][3] = {{"gate", "waveform", "waveform"},
                                       {"samples", "hbm.samples", "compare.samples"}, /* there are two */
                                       {"kt", "contacts[].tangential_stiffness", ""},
                                       {"contacts[3].gap", "contacts[].gap", ""}};
  case_error err;
  char *text;
  for (int i = 0; i < 4; ++i) {
    text = described(all[i][0], HC_OK, &err);
    assert_true(strstr(text, all[i][1]) && strstr(text, all[i][2]) && (i > 0 || !strstr(text, "mass")));
    free(text);
  }
  text = described("hbm.sampels", HC_BAD_INPUT, &err);
  assert_string_equal(text, "");
  assert_non_null(strstr(err.message, "did you mean `hbm.samples`?"));
  free(text);
  free(described("\033[2J", HC_BAD_INPUT, &err));
  check_message(&err);
}

CHECK_TESTS("cases.fields", 60, defaults_pass_their_own_reader, defaults_are_those_of_the_interface, rows_are_sound,
            describe_mentions_every_field, describe_finds_by_section_name_and_symbol)
