/* keep_found.h - rows that were found are shown at once, and kept after a signal, wherever the work is. The work looks
 * for a signal only now and then, a whole period of time integration apart: beside it a thread waits for the signal,
 * then for the work to end by itself, and if that does not, writes what there is and ends the program. Further signals
 * change nothing.
 *
 *     keep_found_begin -> the work, which holds `found` whenever it changes what it has found -> keep_found_end */
#pragma once

#include <pthread.h>
#include <stdbool.h>

#include "interfaces/command/cli.h"

typedef struct keep_found {
  pthread_mutex_t found;
  pthread_cond_t ended;
  bool over;                /* the work has ended; under the lock */
  bool watched;             /* there is a thread */
  int (*write)(void *self); /* while the lock is held: writes what was found; the exit code, or < 0: nothing was */
  void *self;
  pthread_t thread;
} keep_found;

/* In a call by a program signals are the program's. Where the system has no more locks or threads, the program ends at
 * once after a signal, as it would by itself. */
void keep_found_begin(keep_found *k, const cli_common *common, int (*write)(void *self), void *self);

/* Does not return while the thread is writing: the program ends there. */
void keep_found_end(keep_found *k);

/* Rows shown when found, where cli_shows_rows: the thread that finds them puts them into its own table `rows` and
 * writes. The other writes the rest, holding `writing`, which lasts as long as the program then: no row twice. */
typedef struct shown_rows {
  table *rows; /* NULL before the first one */
  table_begun begun;
  pthread_mutex_t writing;
} shown_rows;

/* several: more tables follow these rows. */
void shown_rows_begin(shown_rows *s, bool several);
void shown_rows_write(shown_rows *s, const cli_common *common);
void shown_rows_end(shown_rows *s);
