/* text_file.c - see text_file.h. */
#include "model/casefile/matrices/text_file.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

static hc_status cannot_open(int error, message *m)
{
  message_add(m, "cannot be opened: ");
  message_add_errno(m, error);
  return error == ENOMEM ? HC_NO_MEMORY : HC_IO;
}

/* The file at `path`, of *size bytes; regular ones only: anything else may have no end, or wait for ever. */
static hc_status open_file(const char *path, size_t most, FILE **from, size_t *size, message *m)
{
  struct stat info;
  *from = NULL;
  *size = 0;
  if (stat(path, &info) != 0) return cannot_open(errno, m);
  if (!S_ISREG(info.st_mode)) {
    message_add(m, "is no file");
    return HC_IO;
  }
  if ((size_t)info.st_size > most) {
    message_add(m, "is larger than %zu MB", most >> 20);
    return HC_IO;
  }
  *size = (size_t)info.st_size;
  return (*from = fopen(path, "rb")) ? HC_OK : cannot_open(errno, m);
}

hc_status text_file_read(const char *path, size_t most, char **text, size_t *length, message *m)
{
  FILE *from;
  size_t size;
  *text = NULL;
  *length = 0;
  hc_status st = open_file(path, most, &from, &size, m);
  if (st != HC_OK) return st;
  if (!(*text = malloc(size + 1))) {
    st = HC_NO_MEMORY;
  } else if ((*length = fread(*text, 1, size, from)) < size && ferror(from)) {
    message_add(m, "cannot be read");
    st = HC_IO;
  }
  if (*text) (*text)[*length] = '\0';
  fclose(from);
  return st;
}
