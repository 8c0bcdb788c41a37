/* same_file.c - see same_file.h. Proof: tests/output/test_same_file.c. */
#include "compare/output/same_file.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "numerics/base/path.h"

enum { MAX_LINKS = 40, MAX_LINK_TEXT = 4096 };

char *file_follow_links(const char *path)
{
  char *at = strdup(path);
  for (int links = 0; at; ++links) {
    char text[MAX_LINK_TEXT];
    ssize_t n = readlink(at, text, sizeof text);
    if (n < 0) return at; /* no link, or nothing there */
    if (links == MAX_LINKS || n == (ssize_t)sizeof text) {
      free(at);
      errno = ELOOP;
      return NULL;
    }
    char *next = path_beside(at, text, (size_t)n);
    free(at);
    at = next;
  }
  return NULL;
}

/* The folder that `path`, its links followed, is in. False where there is none. */
static bool look_at_folder(const char *path, struct stat *folder)
{
  char *of = path_beside(path, ".", 1);
  bool found = of && stat(of, folder) == 0;
  free(of);
  return found;
}

/* What is not there yet: the folder and the name in it. False: out of memory. */
static bool identify_what_is_to_come(const char *path, file_identity *out)
{
  struct stat folder;
  char *target = file_follow_links(path);
  if (!target) return errno != ENOMEM;
  const char *slash = strrchr(target, '/'), *name = slash ? slash + 1 : target;
  bool whole = true;
  if (*name && look_at_folder(target, &folder)) {
    *out = (file_identity){FILE_TO_COME, folder.st_dev, folder.st_ino, strdup(name)};
    whole = out->name != NULL;
  }
  free(target);
  return whole;
}

bool file_identify(const char *path, int fd, file_identity *out)
{
  struct stat st;
  *out = (file_identity){.kind = FILE_OTHER};
  if ((path ? stat(path, &st) : fstat(fd, &st)) == 0) {
    if (S_ISREG(st.st_mode)) *out = (file_identity){FILE_THERE, st.st_dev, st.st_ino, NULL};
    return true;
  }
  return !path || identify_what_is_to_come(path, out);
}

void file_forget(file_identity *f)
{
  free(f->name);
  *f = (file_identity){.kind = FILE_OTHER};
}

bool file_same(const file_identity *a, const file_identity *b)
{
  if (a->kind == FILE_OTHER || a->kind != b->kind || a->device != b->device || a->number != b->number) return false;
  return a->kind == FILE_THERE || (a->name && b->name && !strcmp(a->name, b->name));
}

bool file_is_in(const char *path, const char *folder)
{
  struct stat above, asked;
  char *target = file_follow_links(path);
  bool in = target && look_at_folder(target, &above) && stat(folder, &asked) == 0 && above.st_dev == asked.st_dev &&
            above.st_ino == asked.st_ino;
  free(target);
  return in;
}
