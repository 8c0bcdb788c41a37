/* fuzz_study.c - a study beside base.yaml: refused with a place in either, or the scenes that --set makes of it. */

#include "compare/study/study.h"
#include "tests/fuzz/fuzz.h"

static const char base[] =
    "oscillator: {mass: 1, damping: 0.4, stiffness: 40}\nforcing: {amplitude: 100}\nsweep: {omega: [3, 20]}\n"
    "contacts:\n  - {tangential_stiffness: 100, normal_stiffness: 1000, friction: 0.3, angle_deg: 45, gap: -5}\n"
    "compare: {omega: [5, 6]}\n";

static void refusal_is_clean(hc_status st, const case_error *err, const char *path, const char *text, size_t length)
{
  char beside[FUZZ_PATH];
  must(st == HC_BAD_INPUT || (st == HC_IO && strstr(err->message, "the base case: ")), "status %d: %s", (int)st,
       err->message);
  message_is_clean(err->message, sizeof err->message);
  snprintf(beside, sizeof beside, "%.*sbase.yaml", (int)(strrchr(path, '/') + 1 - path), path);
  if (!strncmp(err->message, beside, strlen(beside)))
    place_is_inside(err->message, beside, base, sizeof base - 1, true);
  else place_is_inside(err->message, path, text, length, true);
}

/* "PATH=VALUE" for every field that varies, of scene id; to free, and how many there are. */
static char **assignments(const study *s, long id, int *n)
{
  char **set = calloc(STUDY_MOST_FIELDS, sizeof *set);
  must(set != NULL, "out of memory");
  *n = 0;
  for (int a = 0; a < s->n_axes; ++a)
    for (int k = 0; k < s->axes[a].n_fields; ++k) {
      const study_field *sf = &s->axes[a].fields[k];
      const char *value = sf->values[study_index(s, id, a)].text;
      size_t size = strlen(sf->path) + strlen(value) + 2;
      char *one = set[(*n)++] = malloc(size);
      must(one != NULL, "out of memory");
      snprintf(one, size, "%s=%s", sf->path, value);
    }
  return set;
}

/* The same scene by two ways: the study's, and the one a user has on the command line. */
static void scene_is_what_set_makes(const study *s, long id)
{
  scene ours, theirs;
  case_error err, other;
  char *text = NULL;
  size_t length = 0;
  int n;
  scene_mark(&ours);
  hc_status st = study_scene(s, id, &ours, &err);
  char **set = assignments(s, id, &n);
  FILE *to = open_memstream(&text, &length);
  must(to != NULL && case_echo(&s->base, to) == HC_OK && fclose(to) == 0, "no echo");
  hc_status by_set = case_parse("base", text, length, n, (const char *const *)set, &theirs, &other);
  must(st == by_set, "scene %ld: %s, by --set %s\n%s", id, err.message, other.message, text);
  if (st == HC_OK) {
    scene_is_in_range(&ours);
    must(scenes_are_same(&ours, &theirs), "scene %ld is not what --set makes of\n%s", id, text);
    case_clear(&ours);
    case_clear(&theirs);
  } else {
    must(st == HC_BAD_INPUT && scene_is_marked(&ours), "scene %ld, status %d: %s", id, (int)st, err.message);
    message_is_clean(err.message, sizeof err.message);
  }
  for (int i = 0; i < n; ++i) free(set[i]);
  free(set);
  free(text);
}

static void study_is_whole(const study *s)
{
  long product = 1;
  for (int a = 0; a < s->n_axes; ++a) product *= s->axes[a].n;
  must(s->n_axes >= 1 && product == s->n_scenes && product >= 1 && product <= STUDY_MOST_SCENES, "%ld scenes",
       s->n_scenes);
  must(memchr(s->title, 0, sizeof s->title) != NULL, "no end to the title");
  scene_is_what_set_makes(s, 0);
  scene_is_what_set_makes(s, s->n_scenes / 2);
  scene_is_what_set_makes(s, s->n_scenes - 1);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
  static bool base_is_there;
  char path[FUZZ_PATH];
  case_error err = {{0}};
  study *s = NULL;
  if (!base_is_there) fuzz_write("base.yaml", base, sizeof base - 1, path);
  base_is_there = true;
  fuzz_write("study.yaml", (const char *)data, size, path);
  hc_status st = study_read(path, 0, NULL, &s, &err);
  must((st == HC_OK) == (s != NULL) && (st == HC_OK) == !*err.message, "status %d: %s", (int)st, err.message);
  if (st == HC_OK) ++fuzz_accepted, study_is_whole(s);
  else ++fuzz_refused, refusal_is_clean(st, &err, path, (const char *)data, size);
  study_free(s);
  return 0;
}
