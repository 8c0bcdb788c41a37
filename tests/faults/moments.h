/* moments.h - something done to the command at a known place of its work, whatever the machine is busy with: each
 * call of the functions in moments.c, and each write of SQLite's, is a moment, and they are counted. For a child
 * (child.h) that runs hbmcheck_main. */
#pragma once

#include "tests/faults/child.h"

/* At the n-th moment from here on, what(self) is called by the thread that came to it; n = 0: never. The count goes
 * into *child_count as it grows. */
void moments_expect(long n, void (*what)(void *self), void *self);

/* "hbmcheck LINE" in a child to which `number` is signalled at its n-th moment; both 0: never. Threads of a study or
 * stress that come to a moment after it wait until the command has told them to stop: it looks for signals some twenty
 * times a second, and might be done by then. */
void moments_run(const char *line, int number, long n, outcome *o);
