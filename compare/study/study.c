/* study.c - from the number of a scene to the scene; see study.h. Reading the file: study_file.c, study_axes.c. */
#include "compare/study/study.h"

#include "compare/study/study_reader.h"

const char *study_kind_name(study_kind kind)
{
  static const char *const names[] = {
      [STUDY_FRF] = "frf", [STUDY_TRANSIENT] = "transient", [STUDY_COMPARE] = "compare"};
  return names[kind];
}

int study_index(const study *s, long id, int axis)
{
  for (int a = s->n_axes - 1; a > axis; --a) id /= s->axes[a].n;
  return (int)(id % s->axes[axis].n);
}

/* The value was accepted when the file was read. */
static hc_status apply(case_reader *r, const study_field *sf, const study_value *value)
{
  field_value v;
  message why;
  char words[16];
  int bad;
  case_target t = case_target_of(sf->f, sf->contact, sf->whole);
  r->here = (case_place){.line = value->line, .column = value->column};
  do {
    void *base = case_target_base(r, t);
    if (!base) return HC_NO_MEMORY;
    case_drop_rivals(r, sf->f, base);
    message_start(&why, words, sizeof words);
    field_split(sf->f, value->text, strlen(value->text), &v);
    field_store(sf->f, base, &v, &why, &bad);
    case_target_given(r, t);
  } while (case_target_next(r, &t));
  return HC_OK;
}

hc_status study_scene(const study *s, long id, scene *out, case_error *err)
{
  case_reader r;
  case_reader_start(&r, s->name, NULL, err);
  r.sc = s->base;
  memset(r.contact_has, 0xff, sizeof r.contact_has); /* the base is whole */
  hc_status st = HC_OK;
  for (int a = 0; a < s->n_axes; ++a)
    for (int k = 0; k < s->axes[a].n_fields && st == HC_OK; ++k)
      st = apply(&r, &s->axes[a].fields[k], &s->axes[a].fields[k].values[study_index(s, id, a)]);
  if (st == HC_OK) st = case_check(&r);
  return case_reader_take(&r, st, out);
}

bool study_in_cycles(const study *s)
{
  bool any = s->base.in_cycles;
  for (int a = 0; a < s->n_axes; ++a)
    for (int k = 0; k < s->axes[a].n_fields; ++k) {
      const field *f = s->axes[a].fields[k].f;
      any |= f->in_cycles && f->scale != 0;
    }
  return any;
}

/* FNV-1a, 64 bits. The end of a text counts: "ab", "c" is not "a", "bc". */
static uint64_t mix(uint64_t h, const char *text)
{
  do h = (h ^ (unsigned char)*text) * 0x100000001b3u;
  while (*text++);
  return h;
}

hc_status study_take_fingerprint(study *s)
{
  char *text = NULL, count[32];
  size_t size;
  scene base = s->base;
  memset(base.title, 0, sizeof base.title);
  FILE *to = open_memstream(&text, &size);
  if (!to) return HC_NO_MEMORY;
  hc_status st = case_echo(&base, to);
  if (fclose(to) != 0 || st != HC_OK || !text /* glibc closes well, too, where its first allocation failed */) {
    free(text);
    return HC_NO_MEMORY;
  }
  uint64_t h = mix(mix(0xcbf29ce484222325u, study_kind_name(s->kind)), text);
  free(text);
  for (int a = 0; a < s->n_axes; ++a)
    for (int k = 0; k < s->axes[a].n_fields; ++k) {
      snprintf(count, sizeof count, "%d %d", a, s->axes[a].n);
      h = mix(mix(h, count), s->axes[a].fields[k].path);
      for (int i = 0; i < s->axes[a].n; ++i) h = mix(h, s->axes[a].fields[k].values[i].text);
    }
  s->fingerprint = h;
  return HC_OK;
}

void study_free(study *s)
{
  if (!s) return;
  for (int a = 0; a < s->n_axes; ++a) {
    for (int k = 0; k < s->axes[a].n_fields; ++k) {
      study_field *f = &s->axes[a].fields[k];
      for (int i = 0; i < s->axes[a].n && f->values; ++i) free(f->values[i].text);
      free(f->values);
    }
    free(s->axes[a].fields);
  }
  for (int i = 0; i < s->n_claims; ++i) {
    study_claim *c = &s->claims[i];
    free(c->source.text);
    free(c->says.text);
    free(c->reported.text);
    for (int a = 0; a < STUDY_ANSWERS; ++a) {
      free(c->answers[a].found.text);
      free(c->answers[a].holds.text);
      free(c->answers[a].seconds.text);
    }
  }
  for (int i = 0; i < s->n_views; ++i) {
    free(s->views[i].name.text);
    free(s->views[i].query.text);
  }
  case_clear(&s->base);
  free(s->axes);
  free(s->claims);
  free(s->views);
  free(s->name);
  free(s->base_name);
  free(s);
}
