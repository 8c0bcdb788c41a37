/* case_text.h - what the tests of the reader share: a smallest case, and reading it. */
#pragma once

#include <dirent.h>

#include "model/casefile/case_file.h"
#include "numerics/random.h"
#include "tests/check.h"
#include "tests/oscillator.h"

/* Three lines: what is appended starts on line 4. */
#define SMALLEST                                                                                                       \
  "oscillator: {mass: 1, damping: 0.4, stiffness: 40}\nforcing: {amplitude: 100}\nsweep: {omega: [3, 20]}\n"
#define CONTACT_1 "{tangential_stiffness: 100, normal_stiffness: 1000, friction: 0.3, angle_deg: 45, gap: -5}"

static inline hc_status parse(const char *text, scene *sc, case_error *err)
{
  return case_parse("f", text, strlen(text), 0, NULL, sc, err);
}

/* A text that is refused by this message: the place it names, with the blank after it, and words that it has. */
typedef struct mistake {
  char text[2048], message[512], at[64];
  const char *words; /* in message */
} mistake;

/* to[] of a line of mistakes.txt. */
static inline void unescape(const char *line, char *to)
{
  if (!strcmp(line, "\"\"\n")) line += 2;
  for (; *line != '\n'; ++line) {
    unsigned code;
    if (*line != '\\') *to++ = *line;
    else if (*++line != 'x') *to++ = *line == 'n' ? '\n' : *line == 't' ? '\t' : *line == 'r' ? '\r' : *line;
    else {
      assert_int_equal(sscanf(line + 1, "%2x", &code), 1);
      *to++ = (char)code, line += 2;
    }
  }
  *to = 0;
}

/* check() is given those of a section of mistakes.txt, so many. */
static inline void each_mistake(const char *section, int expected, void (*check)(const mistake *m))
{
  FILE *f = fopen(SOURCE_DIR "/tests/cases/mistakes.txt", "r");
  const size_t length = strlen(section);
  char line[2048];
  mistake m;
  bool here = false;
  int n = 0;
  assert_non_null(f);
  while (fgets(line, sizeof line, f)) {
    if (*line == '#' || *line == '\n') continue;
    if (!strncmp(line, "== ", 3)) here = !strncmp(line + 3, section, length) && line[3 + length] == '\n';
    else if (here && strncmp(line, "    ", 4) != 0) unescape(line, m.text);
    else if (here) {
      unescape(line + 4, m.message);
      snprintf(m.at, sizeof m.at, "%.*s", (int)strcspn(m.message, " ") + 1, m.message);
      m.words = m.message + strlen(m.at);
      check(&m), ++n;
    }
  }
  fclose(f);
  assert_int_equal(n, expected);
}

/* text, or one assignment on it (or NULL), is refused by a message that starts so and has this; the scene stays. */
static inline void refused(const char *text, const char *set, const char *start, const char *fragment)
{
  scene sc, before;
  case_error err = {{0}};
  memset(&sc, 0x5A, sizeof sc);
  before = sc;
  hc_status st = case_parse("f", text, strlen(text), set != NULL, &set, &sc, &err);
  if (st == HC_OK || strncmp(err.message, start, strlen(start)) || !strstr(err.message, fragment))
    fail_msg("%s%s%s\n  gave %d `%s`\n  not `%s...%s...`", text, set ? "--set " : "", set ? set : "", (int)st,
             err.message, start, fragment);
  assert_int_equal(st, HC_BAD_INPUT);
  assert_memory_equal(&sc, &before, sizeof sc);
}

static inline void accepted(const char *text, const char *set, scene *sc)
{
  case_error err = {{0}};
  hc_status st = case_parse("f", text, strlen(text), set != NULL, &set, sc, &err);
  if (st != HC_OK) print_error("%s%s%s: %s\n", text, set ? "--set " : "", set ? set : "", err.message);
  assert_int_equal(st, HC_OK);
  assert_string_equal(err.message, "");
  if (st == HC_OK) scene_kept(*sc);
}

/* What case_echo writes of the scene, with the status it is to have; to free. */
static inline char *echoed(const scene *sc, hc_status expect)
{
  char *text = NULL;
  size_t size;
  FILE *to = open_memstream(&text, &size);
  assert_int_equal(case_echo(sc, to), expect);
  fclose(to);
  return text;
}

/* One line, no control characters, not empty, terminated. */
static inline void check_message(const case_error *err)
{
  size_t n = strnlen(err->message, sizeof err->message);
  assert_in_range(n, 1, sizeof err->message - 1);
  for (size_t i = 0; i < n; ++i) assert_true((unsigned char)err->message[i] >= 0x20 && err->message[i] != 0x7F);
}

/* Each case file of the folder is read and checked; how many there are. */
static inline int each_case_of(const char *folder, void (*check)(const scene *sc))
{
  DIR *dir = opendir(folder);
  int n = 0;
  assert_non_null(dir);
  for (struct dirent *e; (e = readdir(dir)) != NULL;) {
    char path[1024];
    scene sc;
    case_error err;
    if (!strstr(e->d_name, ".yaml")) continue;
    snprintf(path, sizeof path, "%s/%s", folder, e->d_name);
    if (case_read(path, 0, NULL, &sc, &err) != HC_OK) fail_msg("%s", err.message);
    check(&sc);
    case_clear(&sc);
    ++n;
  }
  closedir(dir);
  return n;
}
