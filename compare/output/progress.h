/* progress.h - a line on the terminal during long work, and signals that stop it: SIGINT, SIGTERM and SIGHUP. For the
 * command line only: in the library ticks are passed on (progress_pass_on), and nothing is printed.
 *
 *     a signal -> ticks answer false, the work ends by itself and says what it has found
 *              -> 0.7 s later, where no tick came (reading a pipe, inside one long evaluation, waiting for gnuplot):
 *                 the program ends at once, files whole or as they were */
#pragma once

#include <stdbool.h>
#include <stddef.h>
#include <sys/types.h>

#include "numerics/base/status.h"

typedef struct progress progress;

/* From now on the first SIGINT, SIGTERM or SIGHUP makes every tick answer false, and 0.7 s later ends the program with
 * exit_code, a message and without its child and files beside (output.h); the second of its kind kills, unless there
 * are results to keep (progress_hold). A signal that was ignored (nohup) stays ignored. Call once, early. */
void progress_install_signals(int exit_code);

/* While held, the program does not end 0.7 s after a signal: the caller ends it (interfaces/command/keep_found.h).
 * Let go after a signal, 0.7 s begin. From the first time on a second signal no longer kills. */
void progress_hold(bool held);

/* Ends the program as at the end of the 0.7 s. */
_Noreturn void progress_stop(void);

/* Erases the line, if one is drawn; from any thread, once ticks answer false. */
void progress_erase(void);

/* The process that is waited for, and is not to outlive this one; 0 when there is none any more. */
void progress_child(pid_t pid);

/* The signal that asked to stop, 0 for none. Any thread may ask. */
int progress_interrupted(void);

/* Draws "label", then at most 10 times a second "label  37 %  12 s left" on stderr, if a terminal, TERM set and not
 * dumb, not quiet; elsewhere, not quiet, after 20 s and each time the time has doubled a line "hbmcheck: label  37 %
 * 40 s left" of its own. Never fails: NULL (no memory) draws nothing, and its ticks still answer false after a
 * signal. */
progress *progress_start(const char *label, bool quiet);

/* From now on ticks are *to's alone, and signals nothing; *to must live as long. */
void progress_pass_on(progress *p, const hc_monitor *to);

/* For long work; one thread at a time may tick. done is 0..1, or negative: unknown, the time is shown. */
hc_monitor progress_monitor(progress *p);

/* From the next drawing on, another label. */
void progress_relabel(progress *p, const char *label);

/* Erases the line, frees. Before anything else is written to stderr. */
void progress_end(progress *p);

/* "12 s", "12 min" from 100 s on, "12 h" from 100 min on, at last "ages": in text[PROGRESS_TIME], which is returned. */
enum { PROGRESS_TIME = 32 };
const char *progress_time(double seconds, char text[PROGRESS_TIME]);

/* The line itself, without control sequences: elapsed in seconds, at most `columns` wide and size - 1 bytes long. */
void progress_line(char *line, size_t size, const char *label, double done, double elapsed, int columns);
