/* workspace.h - the arrays of one object with a common lifetime: arrays are allocated one by one, failure is checked
 * once at the end (`failed`), and one call frees all. */
#pragma once

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

typedef struct workspace_block {
  struct workspace_block *before;
  max_align_t first[]; /* the array */
} workspace_block;

/* Empty with {0}. */
typedef struct workspace {
  workspace_block *last;
  bool failed; /* an allocation failed: some array is NULL */
} workspace;

/* n entries of `size` bytes, all 0, aligned for any type (and for FFTW); n may be 0. NULL: out of memory, and w->failed
 * is set. */
static inline void *workspace_array(workspace *w, size_t n, size_t size)
{
  const bool fits = n <= (SIZE_MAX - sizeof(workspace_block)) / size;
  workspace_block *block = fits ? calloc(1, sizeof *block + n * size) : NULL;
  if (!block) {
    w->failed = true;
    return NULL;
  }
  block->before = w->last;
  w->last = block;
  return block->first;
}

static inline double *workspace_doubles(workspace *w, size_t n) { return workspace_array(w, n, sizeof(double)); }

static inline void workspace_free(workspace *w)
{
  while (w->last) {
    workspace_block *before = w->last->before;
    free(w->last);
    w->last = before;
  }
}
