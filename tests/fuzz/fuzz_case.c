/* fuzz_case.c - bytes as a case file: read and echoed bit for bit, or refused with a place. */

#include "model/casefile/case_reader.h"
#include "tests/fuzz/fuzz.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
  scene sc;
  case_error err;
  scene_mark(&sc);
  const char *text = size ? (const char *)data : "";
  hc_status st = case_parse("f", text, size, 0, NULL, &sc, &err);
  if (st != HC_OK) {
    ++fuzz_refused;
    must(st == HC_BAD_INPUT, "status %d: %s", (int)st, err.message);
    message_is_clean(err.message, sizeof err.message);
    if (size > CASE_LARGEST) must(!strncmp(err.message, "f: larger than", 14), "%zu bytes: %s", size, err.message);
    else place_is_inside(err.message, "f", text, size, true);
    must(scene_is_marked(&sc), "refused, but the scene has changed: %s", err.message);
    return 0;
  }
  ++fuzz_accepted;
  must(!*err.message, "read, with a message: %s", err.message);
  /* No line ends that editors do not show: the lines in messages would not be those on the screen. */
  static const char *const ends[] = {"\xC2\x85", "\xE2\x80\xA8", "\xE2\x80\xA9"};
  for (size_t k = 0; k < sizeof ends / sizeof *ends; ++k)
    for (size_t i = 0, n = strlen(ends[k]); i + n <= size; ++i)
      must(memcmp(text + i, ends[k], n) != 0, "a strange line end at byte %zu", i);
  scene_is_in_range(&sc);
  scene_echoes(&sc);
  case_clear(&sc);
  return 0;
}
