/* fuzz_set.c - bytes as assignments "PATH=VALUE" on a good case, parted by a line end and "--set ". */
#include <string.h>

#include "tests/fuzz/fuzz.h"

/* Nothing in it is at odds with anything but an assignment, so that an assignment is always to blame. */
static const char good[] =
    "title: T\noscillator: {mass: 1, damping: 0.4, stiffness: 40}\nforcing: {amplitude: 100}\nsweep: {omega: [3, 20]}\n"
    "contacts:\n  - {tangential_stiffness: 100, normal_stiffness: 1000, friction: 0.3, angle_deg: 45, gap: -5}\n"
    "  - {tangential_stiffness: 50, normal_stiffness: 10, friction: 0, angle_deg: 90}\ncompare: {omega: [5, 6]}\n";
static const char between[] = "\n--set ";
enum { MOST = 16 };

/* set[] points into text, which is cut up; how many there are. */
static int split(char *text, const char *set[MOST])
{
  int n = 0;
  for (char *at = text; at && n < MOST;) {
    char *stop = strstr(at, between);
    set[n++] = at;
    if (stop) *stop = '\0';
    at = stop ? stop + sizeof between - 1 : NULL;
  }
  return n;
}

/* For a structure a matrix may be to blame, which is in a file of its own. */
static const char structure[] =
    "structure:\n  mass: [[1, 0.1], [0.1, 2]]\n  stiffness: [[680, -40], [-40, 40]]\n  damping: {modal: 0.01}\n"
    "  names: [tip, root]\n  nodes: [[tip, 17, y]]\nforcing: [{dof: tip, amplitude: 1}]\nsweep: {omega: [3, 20]}\n"
    "contacts:\n  - {name: joint, tangential_stiffness: 200, friction: 1, preload: 5, tangent: {tip: 1, root: -1}}\n"
    "  - {normal_stiffness: 30, gap: -0.25, normal: {root: 1}}\nresponse: [tip, {tip: 1, root: -1}]\n";

static void set_on(const char *base, size_t length, const uint8_t *data, size_t size)
{
  const char *set[MOST];
  scene sc;
  case_error err;
  char *text = fuzz_string(data, size);
  scene_mark(&sc);
  hc_status st = case_parse("f", base, length, split(text, set), set, &sc, &err);
  if (st == HC_OK) {
    ++fuzz_accepted;
    must(!*err.message, "read, with a message: %s", err.message);
    scene_is_in_range(&sc);
    scene_echoes(&sc);
    case_clear(&sc);
  } else {
    ++fuzz_refused;
    must(st == HC_BAD_INPUT, "status %d: %s", (int)st, err.message);
    message_is_clean(err.message, sizeof err.message);
    must(base == structure || !strncmp(err.message, "--set ", 6), "not about an assignment: %s", err.message);
    must(scene_is_marked(&sc), "refused, but the scene has changed: %s", err.message);
  }
  free(text);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
  set_on(good, sizeof good - 1, data, size);
  set_on(structure, sizeof structure - 1, data, size);
  return 0;
}
