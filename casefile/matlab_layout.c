/* matlab_layout.c - see matlab_layout.h. A file of version 5 is a header of 128 bytes and one element a variable:
 *   tag: type (uint32), bytes (uint32)             type MATRIX: its parts; COMPRESSED: those with their tag, by zlib
 * A variable's parts: flags, dimensions, name, then for numbers their real part, for sparse ones row indices, column
 * starts and real part. Each part is a tag, data, and zeros to a multiple of 8; up to 4 bytes of data may stand in the
 * tag instead, whose first word is then type + 65536 bytes. */
#include "casefile/matlab_layout.h"

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <zlib.h>

enum { INT8 = 1, INT32 = 5, UINT32 = 6, MATRIX = 14, COMPRESSED = 15 }; /* types of elements and parts */
enum { SPARSE = 5, FIRST_NUMBERS = 6, LAST_NUMBERS = 15 };              /* classes of variables */
enum { COMPLEX = 0x800, LOGICAL = 0x200 };                              /* of its flags */
enum { HEADER = 128, CHUNK = 4096, LONGEST_NAME = 4096 };

typedef struct walker {
  FILE *from;
  bool big;              /* endian, unlike this machine's or not */
  uint32_t in_file;      /* bytes of the variable that are still in the file */
  bool packed, unpacked; /* by zlib; to the end, with the checksum */
  z_stream z;
  unsigned char chunk[CHUNK]; /* that z eats from */
  size_t padding;             /* before the next part */
} walker;

static uint32_t word(const walker *w, const unsigned char b[4])
{
  const uint32_t b0 = b[w->big ? 3 : 0], b1 = b[w->big ? 2 : 1], b2 = b[w->big ? 1 : 2], b3 = b[w->big ? 0 : 3];
  return b0 | b1 << 8 | b2 << 16 | b3 << 24;
}

/* More for z to eat. */
static bool feed(walker *w)
{
  const size_t most = w->in_file < CHUNK ? w->in_file : CHUNK;
  const size_t n = fread(w->chunk, 1, most, w->from);
  w->in_file -= (uint32_t)n;
  w->z.next_in = w->chunk;
  w->z.avail_in = (uInt)n;
  return n > 0;
}

/* As much as z has room for, or knows so far. */
static bool unpack(walker *w)
{
  if (w->unpacked || (w->z.avail_in == 0 && !feed(w))) return false;
  const int flag = inflate(&w->z, Z_NO_FLUSH);
  w->unpacked = flag == Z_STREAM_END;
  return flag == Z_OK || flag == Z_STREAM_END;
}

/* The next n bytes of the variable. */
static bool take(walker *w, void *bytes, size_t n)
{
  if (!w->packed) {
    if (n > w->in_file) return false;
    w->in_file -= (uint32_t)n;
    return fread(bytes, 1, n, w->from) == n;
  }
  w->z.next_out = bytes;
  w->z.avail_out = (uInt)n;
  bool right = true;
  while (right && w->z.avail_out > 0) right = unpack(w);
  w->z.next_out = NULL;
  return right;
}

static bool skip(walker *w, size_t n)
{
  unsigned char nothing[CHUNK];
  for (; n > CHUNK; n -= CHUNK)
    if (!take(w, nothing, CHUNK)) return false;
  return take(w, nothing, n);
}

/* The tag of the next part; its data follow. */
static bool next_part(walker *w, uint32_t *type, size_t *bytes)
{
  unsigned char tag[4];
  if (!skip(w, w->padding) || !take(w, tag, 4)) return false;
  const uint32_t first = word(w, tag);
  *type = first & 0xffff;
  *bytes = first >> 16;
  if (*bytes > 0) {
    w->padding = 4 - *bytes;
    return *bytes <= 4;
  }
  if (!take(w, tag, 4)) return false;
  *bytes = word(w, tag);
  w->padding = (8 - *bytes % 8) % 8;
  return true;
}

static size_t size_of(uint32_t type)
{
  static const unsigned char sizes[] = {0, 1, 1, 2, 2, 4, 4, 4, 0, 8, 0, 0, 8, 8};
  return type < sizeof sizes ? sizes[type] : 0;
}

/* A part of `count` numbers. */
static bool skip_numbers(walker *w, size_t count)
{
  uint32_t type;
  size_t bytes;
  if (!next_part(w, &type, &bytes)) return false;
  const size_t size = size_of(type);
  return size > 0 && bytes % size == 0 && bytes / size == count && skip(w, bytes);
}

/* Row indices, column starts and values, as many of these as the columns end at. */
static bool skip_sparse(walker *w, size_t columns)
{
  uint32_t type;
  size_t bytes;
  unsigned char last[4] = {0};
  if (!next_part(w, &type, &bytes) || (type != INT32 && type != UINT32) || bytes % 4 != 0 || !skip(w, bytes))
    return false;
  const size_t rows_given = bytes / 4;
  if (!next_part(w, &type, &bytes) || (type != INT32 && type != UINT32) || bytes / 4 != columns + 1) return false;
  if (!skip(w, bytes - 4) || !take(w, last, 4)) return false;
  const size_t entries = word(w, last);
  if (!next_part(w, &type, &bytes)) return false;
  const size_t size = size_of(type);
  return entries <= rows_given && size > 0 && bytes % size == 0 && bytes / size >= entries && skip(w, bytes);
}

typedef struct variable {
  uint32_t flags, rows, columns; /* rows = columns = 0: not of two dimensions */
  char name[LONGEST_NAME + 1];
} variable;

static bool read_head(walker *w, variable *v)
{
  unsigned char bytes[16];
  uint32_t type;
  size_t length;
  if (!next_part(w, &type, &length) || type != UINT32 || length != 8 || !take(w, bytes, 8)) return false;
  v->flags = word(w, bytes);
  if (!next_part(w, &type, &length) || type != INT32 || length % 4 != 0) return false;
  v->rows = v->columns = 0;
  if (length != 8 && !skip(w, length)) return false;
  if (length == 8) {
    if (!take(w, bytes, 8)) return false;
    v->rows = word(w, bytes), v->columns = word(w, bytes + 4);
  }
  if (!next_part(w, &type, &length) || type != INT8 || length > LONGEST_NAME || !take(w, v->name, length)) return false;
  v->name[length] = '\0';
  return true;
}

/* The rest of a variable that may be a matrix for us; what else there is, is refused by its class. */
static bool skip_body(walker *w, const variable *v)
{
  const uint32_t class = v->flags & 0xff;
  if (v->flags & (COMPLEX | LOGICAL)) return true;
  if (class == SPARSE) return skip_sparse(w, v->columns);
  if (class < FIRST_NUMBERS || class > LAST_NUMBERS || v->rows == 0 || v->columns == 0) return true;
  return skip_numbers(w, (size_t)v->rows * v->columns);
}

/* What is compressed ends with its checksum, which zlib compares. */
static bool checksum_holds(walker *w)
{
  unsigned char nothing[CHUNK];
  bool right = true;
  while (right && !w->unpacked) {
    w->z.next_out = nothing;
    w->z.avail_out = CHUNK;
    right = unpack(w);
  }
  w->z.next_out = NULL;
  return right;
}

/* Behind the tag of an element. *found: it is the one called `name`, and all of it is right. */
static bool walk_variable(walker *w, const char *name, bool *found)
{
  unsigned char tag[8];
  variable v;
  w->padding = 0;
  if (w->packed && (!take(w, tag, 8) || word(w, tag) != MATRIX)) return false;
  if (!w->packed && w->in_file == 0) return true; /* an empty one has no parts and no name */
  if (!read_head(w, &v)) return false;
  *found = !name || !strcmp(v.name, name);
  return !*found || (skip_body(w, &v) && (!w->packed || checksum_holds(w)));
}

/* One after the other. *where: the byte of the element that is wrong. */
static bool walk(walker *w, const char *name, long *where)
{
  unsigned char tag[8];
  bool found = false;
  while (!found) {
    *where = ftell(w->from);
    const size_t n = fread(tag, 1, 8, w->from);
    if (n == 0) return true;
    const uint32_t type = word(w, tag), bytes = word(w, tag + 4);
    if (n < 8 || (type != MATRIX && type != COMPRESSED)) return false;
    w->packed = type == COMPRESSED;
    w->in_file = bytes;
    w->unpacked = false;
    w->z = (z_stream){0};
    if (w->packed && inflateInit(&w->z) != Z_OK) return false;
    const bool right = walk_variable(w, name, &found);
    if (w->packed) inflateEnd(&w->z);
    if (!right || fseek(w->from, *where + 8 + (long)bytes, SEEK_SET) != 0) return false;
  }
  return true;
}

hc_status matlab_layout_check(const char *path, const char *name, message *m)
{
  unsigned char header[HEADER];
  long where = 0;
  walker w = {.from = fopen(path, "rb")};
  bool right = w.from && fread(header, 1, HEADER, w.from) == HEADER;
  w.big = right && header[126] == 'M'; /* "MI" as a number of 16 bits */
  right = right && walk(&w, name, &where);
  const long end = w.from && fseek(w.from, 0, SEEK_END) == 0 ? ftell(w.from) : 0;
  if (w.from) fclose(w.from);
  if (right) return HC_OK;
  message_add(
      m, "cannot be read: the file is damaged or cut short (the variable at byte %ld of %ld), expected a whole one",
      where, end);
  return HC_BAD_INPUT;
}
