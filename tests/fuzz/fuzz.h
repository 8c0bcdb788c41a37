/* fuzz.h - what the fuzz targets share: properties that hold for any input, beyond not crashing. One that does not ends
 * the process with its words on stderr: libFuzzer's finding, ctest's failure. Refused means: one line of clean UTF-8
 * with a place inside the input, and nothing changed. A finding goes into corpus/ under a name that says what. */
#pragma once

#include <stdint.h>

#include "model/casefile/case_file.h"

/* One input; libFuzzer fixes the name. Always 0. */
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

/* Inputs so far that were read, and that were refused: a corpus has some of both. */
extern long fuzz_accepted, fuzz_refused;

/* Holds, or the process ends with the words. */
#if defined(__GNUC__)
__attribute__((format(printf, 2, 3)))
#endif
void must(bool holds, const char *format, ...);

/* An input as a string of its own, cut at its first NUL: its end is the sanitizer's. To free. */
char *fuzz_string(const uint8_t *data, size_t size);

/* words[size]: terminated, not empty, one line, UTF-8, no control characters. */
void message_is_clean(const char *words, size_t size);

/* The words start with "NAME:LINE:COLUMN: ", a place in text[length] or just behind a line. In YAML a CR ends one. */
void place_is_inside(const char *words, const char *name, const char *text, size_t length, bool yaml);

/* A reader of "f" ended with st: counted, and read without a message (true), or refused with a clean one. */
bool fuzz_was_read(hc_status st, const char *words, size_t size, const char *text, size_t length);

/* Every field is finite and within the range that `hbmcheck describe` tells, and fields go together. */
void scene_is_in_range(const scene *sc);

/* The same bits, their structures' too. */
bool scenes_are_same(const scene *a, const scene *b);

/* case_echo's text reads back to the same scene, bit for bit. */
void scene_echoes(const scene *sc);

/* A scene no reader has any reason to leave behind, and whether it is still that. */
void scene_mark(scene *sc);
bool scene_is_marked(const scene *sc);

/* This process' own folder, made when first asked for; length bytes as its file `name`, its path in path[]. */
enum { FUZZ_PATH = 128 };
void fuzz_write(const char *name, const char *text, size_t length, char path[FUZZ_PATH]);
