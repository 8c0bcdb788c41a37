/* same_file.h - do two names mean one file? By device and inode number, so that symbolic and hard links and other
 * spellings (./a, b/../a) do not hide it; of what is not there yet, by its folder and its name in it. Only regular
 * files count: a terminal, a pipe or /dev/null may be written to under any number of names. */
#pragma once

#include <stdbool.h>
#include <sys/stat.h>

/* Which file a name means. */
typedef struct file_identity {
  enum { FILE_OTHER /* no regular file, or in no folder */, FILE_THERE, FILE_TO_COME } kind;
  dev_t device; /* FILE_THERE: of the file; FILE_TO_COME: of the folder it would be in */
  ino_t number;
  char *name; /* FILE_TO_COME: its name there; else NULL */
} file_identity;

/* What identifies `path`, or with NULL the open descriptor fd. False: out of memory. file_forget in any case. */
bool file_identify(const char *path, int fd, file_identity *out);
void file_forget(file_identity *f);

bool file_same(const file_identity *a, const file_identity *b);

/* Would `path` be a file right in the folder `folder`? False where there is no such folder. */
bool file_is_in(const char *path, const char *folder);

/* Where the links at its end lead, to be freed. NULL and errno: ENOMEM, or ELOOP for a circle. */
char *file_follow_links(const char *path);
