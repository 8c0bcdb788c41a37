/* replay.c - a fuzz target without libFuzzer: every file of the folders, and every beginning of the small ones. An
 * error if all were read or all refused: then it is not the corpus it should be. */
#include <dirent.h>
#include <string.h>
#include <unistd.h>

#include "tests/fuzz/fuzz.h"

enum { LARGEST = 1 << 21, SMALL = 1500, SECONDS = 1400 };

/* Each input at the very end of a block of its own: a byte too far is the sanitizer's. */
static void run(const char *text, size_t length)
{
  uint8_t *own = malloc(length ? length : 1);
  must(own != NULL, "out of memory");
  memcpy(own, text, length);
  LLVMFuzzerTestOneInput(own, length);
  free(own);
}

static int replay_folder(const char *path)
{
  DIR *folder = opendir(path);
  must(folder != NULL, "%s is no folder", path);
  int files = 0;
  for (const struct dirent *entry; (entry = readdir(folder)) != NULL;) {
    char name[4096];
    if (entry->d_name[0] == '.') continue;
    snprintf(name, sizeof name, "%s/%s", path, entry->d_name);
    static char text[LARGEST];
    FILE *from = fopen(name, "rb");
    must(from != NULL, "%s cannot be opened", name);
    size_t length = fread(text, 1, sizeof text, from);
    must(!ferror(from) && length < sizeof text, "%s cannot be read, or is too large", name);
    fclose(from);
    fprintf(stderr, "%s\n", name); /* the last one named is the one that failed */
    run(text, length);
    for (size_t part = 0; length <= SMALL && part < length; ++part) run(text, part);
    ++files;
  }
  closedir(folder);
  return files;
}

int main(int argc, char **argv)
{
  int files = 0;
  alarm(SECONDS); /* a hang is a failure */
  for (int i = 1; i < argc; ++i) files += replay_folder(argv[i]);
  printf("%d files, %ld inputs read, %ld refused\n", files, fuzz_accepted, fuzz_refused);
  return files > 0 && fuzz_accepted > 0 && fuzz_refused > 0 ? 0 : 1;
}
