/* hbmcheck.h - the library: harmonic balance of an oscillator, or a structure, on friction and gap contacts, held
 * against time integration.
 *
 *     M x'' + C x' + K x + sum_j [ t_j T_j + n_j (N_j - N0_j) ] = F0 cos(omega t)
 *     u_j = t_j x, v_j = n_j x        (t_j, n_j): cosine and sine of the contact's angle
 *     N_j = max(kn (v_j + gap), 0), N0_j = max(kn gap, 0)
 *     T_j: a spring kt behind a Coulomb slider, |T_j| <= mu N_j
 *
 *     hbmcheck_case_read or _parse     what a case file says: oscillator or structure, contacts, sweep, limits
 *     hbmcheck_run                     a command of `hbmcheck` on it, its options as on the command line
 *     hbmcheck_result_table            what it found: tables, with the rows, columns, names and numbers of its csv
 *
 * Units: any consistent set; [length], [force], [time] are the case's. omega is in rad per unit time.
 * Handles: opaque; each has its _free, which takes NULL. A result does not need the case any more. A table is its
 * result's, and so are texts. What asks takes NULL for a handle, and answers 0, NaN or NULL.
 * The library prints nothing, never exits, handles no signals, and keeps no global state.
 * BLAS: where OpenBLAS is the system's, it is told to use one thread when the library is loaded, which holds for the
 * whole process (NumPy of Debian, too): several wait for each other longer than they compute here. One that was built
 * without threads (libopenblas0-serial) gives wrong answers to two at once: handles take turns in it, and a program
 * must not call it itself while another thread is in this library.
 * Threads: any number, each with handles of its own. FFTW's planner is shared by a process, and guarded among these
 * handles only: a program that plans with FFTW itself must not do so while another thread is in this library. Where
 * `modes` and `reduce` work on large sparse matrices they take turns: ARPACK has one state.
 * GSL: its error handler, which aborts unless told otherwise, is the program's: call gsl_set_error_handler_off(). */
#ifndef HBMCHECK_H
#define HBMCHECK_H

#include <stddef.h>

#define HBMCHECK_VERSION_MAJOR 1
#define HBMCHECK_VERSION_MINOR 0
#define HBMCHECK_VERSION_PATCH 0
#define HBMCHECK_VERSION       "1.0.0"

#ifdef __cplusplus
extern "C" {
#endif

/* HBMCHECK_VERSION of the library in use, which may be newer than this header. A constant string. */
const char *hbmcheck_version(void);

/* ---- statuses, and a way to stop long work ---- */

typedef enum hbmcheck_status {
  HBMCHECK_OK,
  HBMCHECK_BAD_INPUT,       /* an argument is outside its documented range, or a case file is wrong */
  HBMCHECK_NO_MEMORY,       /* out of memory */
  HBMCHECK_IO,              /* a file could not be read */
  HBMCHECK_STALLED,         /* Newton steps became tiny while the residual stayed large */
  HBMCHECK_NOT_CONVERGED,   /* the Newton residual stayed above tolerance */
  HBMCHECK_SINGULAR,        /* the Jacobian is singular */
  HBMCHECK_NOT_FINITE,      /* a force, residual or solution was not finite */
  HBMCHECK_STEP_TOO_SMALL,  /* the continuation step shrank to its minimum */
  HBMCHECK_TOO_MANY_POINTS, /* the response curve needs more points than allowed */
  HBMCHECK_NOT_CLOSED,      /* a contact's slider did not come back to where it began the period */
  HBMCHECK_INTEGRATOR,      /* CVODE gave up */
  HBMCHECK_CHATTER,         /* more contact transitions in a period than allowed */
  HBMCHECK_NOT_SETTLED,     /* the transient did not reach a steady state within transient.max_periods */
  HBMCHECK_APERIODIC,       /* the motion never repeats: it is chaotic, or runs on a torus */
  HBMCHECK_INTERRUPTED,     /* the monitor asked to stop */
  HBMCHECK_UNSUPPORTED,     /* not done: in a row, what was not computed because something before it failed */
  HBMCHECK_BUG,             /* an error of the library: please report it */
  HBMCHECK_JUMPED,          /* a fixed step of the curve leads to another branch */
  HBMCHECK_UNBOUNDED,       /* the motion grows without bound */
  HBMCHECK_CREEPS           /* the body slides on by as much in each period: there is no periodic motion */
} hbmcheck_status;

/* The words for a status; a constant string, never NULL. */
const char *hbmcheck_status_text(hbmcheck_status status);

/* Long work calls tick now and then, in the thread that does the work: done is the fraction finished, 0..1, or
 * negative where it is not known. Answer 0 to stop: the work returns HBMCHECK_INTERRUPTED. Anything else: go on.
 * To stop at Ctrl-C, let the signal handler set a flag and tick look at it. tick must return: memory is lost if it
 * jumps or throws out of the library. A monitor may be NULL, and so may tick. */
typedef struct hbmcheck_monitor {
  size_t size; /* sizeof(hbmcheck_monitor): later versions may know more members */
  int (*tick)(void *self, double done);
  void *self; /* the caller's, handed to tick */
} hbmcheck_monitor;

/* ---- a case ---- */

typedef struct hbmcheck_case hbmcheck_case;

/* The YAML case file at path with the n_set >= 0 assignments "PATH=VALUE", such as "hbm.harmonics=10", in order; each
 * run reads it again. set may be NULL if n_set = 0. message[size] gets one line without a newline, "FILE:LINE:COLUMN:
 * what is wrong, what was expected", cut to size (512 holds any), or "" if all is well; it may be NULL. HBMCHECK_OK;
 * HBMCHECK_BAD_INPUT (the message says what), HBMCHECK_IO, HBMCHECK_NO_MEMORY: *out is NULL. */
hbmcheck_status hbmcheck_case_read(const char *path, int n_set, const char *const *set, char *message, size_t size,
                                   hbmcheck_case **out);

/* From text[length], which is copied, called name in messages. HBMCHECK_OK; HBMCHECK_BAD_INPUT, HBMCHECK_NO_MEMORY:
 * *out is NULL. */
hbmcheck_status hbmcheck_case_parse(const char *name, const char *text, size_t length, int n_set,
                                    const char *const *set, char *message, size_t size, hbmcheck_case **out);

/* Numbers values[rows][columns] of the caller's, copied, for what `name` says: a field of the case that is a list
 * (rows = 1) or a matrix, as "compare.omega" or "structure.mass", from now on; or "against": what `verify` judges in
 * the place of a file, rows = 2: omega in any order, then as many values of --quantity.
 * HBMCHECK_OK; HBMCHECK_BAD_INPUT (message[size] says what; the case is as it was), HBMCHECK_NO_MEMORY. */
hbmcheck_status hbmcheck_case_give(hbmcheck_case *c, const char *name, int rows, int columns, const double *values,
                                   char *message, size_t size);

void hbmcheck_case_free(hbmcheck_case *c);

/* ---- commands ---- */

typedef struct hbmcheck_result hbmcheck_result;

/* Run `command` on the case: compare, frf, transient, survey, modes, verify, advise, prove, reduce, gate or contact,
 * whose help and columns are those of `hbmcheck COMMAND --help` and docs/interface.md; or names: what its responses and
 * contacts are called. options[n]: "--at=6,8", or "--at" and "6,8"; --set, --output (of a folder or file that the
 * command writes) and --quiet are taken, too; --format, --wide and --plot are not. One run at a time of a case.
 * Where a command's csv and json leave something to remarks, its tables have columns and tables more: stable, status,
 * coefficients, wave, ...; special points and summary of a curve; the gate's numbers of a comparison.
 * HBMCHECK_OK: it did what was asked, also where single rows failed, which say so. HBMCHECK_BAD_INPUT: the case or the
 * options are wrong; else why the work ended early. Remarks say more, and tables hold what was found until then: *out
 * is NULL after HBMCHECK_NO_MEMORY alone, and where an argument here is NULL or no command. */
hbmcheck_status hbmcheck_run(const hbmcheck_case *c, const char *command, int n, const char *const *options,
                             const hbmcheck_monitor *monitor, hbmcheck_result **out);

/* What the command would exit with: 0 done, and agreed; 1 a comparison failed; 2 the case is wrong; 3 something could
 * not be solved or written; 64 the options are wrong. 70 for NULL. */
int hbmcheck_result_exit_code(const hbmcheck_result *r);

/* Line i of what it would say on standard error; NULL past the last. */
const char *hbmcheck_result_remark(const hbmcheck_result *r, int i);

typedef struct hbmcheck_table hbmcheck_table;

/* Table i in the command's order, the result's; NULL past the last. */
const hbmcheck_table *hbmcheck_result_table(const hbmcheck_result *r, int i);

void hbmcheck_result_free(hbmcheck_result *r);

/* ---- tables ---- */

typedef enum hbmcheck_kind {
  HBMCHECK_TEXT,
  HBMCHECK_INTEGER,
  HBMCHECK_REAL,
  HBMCHECK_SERIES /* real numbers, as many as the row has */
} hbmcheck_kind;

typedef struct hbmcheck_column {
  size_t size; /* sizeof(hbmcheck_column), from the caller: later versions may know more members */
  hbmcheck_kind kind;
  const char *name;
  const char *unit;    /* "length", "force", "rad/time", "1" for a ratio; "" of counts and texts, or not known */
  const char *meaning; /* one line, "" where the command's help has it */
} hbmcheck_column;

/* "Response curve". */
const char *hbmcheck_table_title(const hbmcheck_table *t);

/* Remark i below the table; NULL past the last. */
const char *hbmcheck_table_remark(const hbmcheck_table *t, int i);

int hbmcheck_table_rows(const hbmcheck_table *t);

/* Column j, from 0: as many members of *out as its size has. HBMCHECK_OK; HBMCHECK_BAD_INPUT: there is none. */
hbmcheck_status hbmcheck_table_column(const hbmcheck_table *t, int j, hbmcheck_column *out);

/* The number in that row, from 0, and the column of that name, of kind HBMCHECK_INTEGER or _REAL; NaN: there is
 * none. */
double hbmcheck_table_number(const hbmcheck_table *t, int row, const char *column);

/* The text there; NULL where there is none. */
const char *hbmcheck_table_text(const hbmcheck_table *t, int row, const char *column);

/* How many numbers there are, of which the first cap are written to values: of a series the row's; of another column,
 * with row = -1, one for each row. cap = 0 asks for how many alone: values may be NULL then. */
int hbmcheck_table_numbers(const hbmcheck_table *t, int row, const char *column, int cap, double *values);

#ifdef __cplusplus
}
#endif
#endif
