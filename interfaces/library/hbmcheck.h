/* hbmcheck.h - the library: harmonic balance of an oscillator, or a structure, on friction and gap contacts, held
 * against time integration.
 *
 *     M x'' + C x' + K x + sum_j [ t_j T_j + n_j (N_j - N0_j) ] = F0 cos(omega t)
 *     u_j = t_j x, v_j = n_j x        (t_j, n_j): cosine and sine of the contact's angle
 *     N_j = max(kn (v_j + gap), 0), N0_j = max(kn gap, 0)
 *     T_j: a spring kt behind a Coulomb slider, |T_j| <= mu N_j
 *
 *     hbmcheck_case_read       what a case file says: oscillator, contacts, sweep, settings, limits
 *     hbmcheck_curve_trace     its HBM response curve; hbmcheck_curve_at: every solution at an omega
 *     hbmcheck_transient_run   its steady states by time integration
 *     hbmcheck_comparison_run  both at the same frequencies, with verdicts
 *     hbmcheck_verification_run  another program's response curve held against both; hbmcheck_contact_force: the forces
 *                              of one contact under a motion that is given
 *
 * Units: any consistent set; [length], [force], [time] are the case's. omega is in rad per unit time.
 * Handles: opaque; each has its _free, which takes NULL. A result owns its memory and outlives the case. Pointers to
 * results (struct hbmcheck_solution, ...) are the caller's and are filled with plain numbers. They are filled whole
 * or not touched.
 * Errors: every function that can fail returns a status and lists those it returns. HBMCHECK_BAD_INPUT is also the
 * answer to NULL where an object or a place for results is expected, and to an index out of range. Where a function
 * makes a handle, *out is NULL after HBMCHECK_BAD_INPUT and HBMCHECK_NO_MEMORY; after any other status it holds what
 * was found until then, and is to be freed.
 * The library prints nothing, never exits, and keeps no global state. Functions that count answer 0 for NULL.
 * BLAS: where OpenBLAS is the system's, it is told to use one thread when the library is loaded, which holds for the
 * whole process (NumPy of Debian, too): several wait for each other longer than they compute here. One that was built
 * without threads (libopenblas0-serial) gives wrong answers to two at once: handles take turns in it, and a program
 * must not call it itself while another thread is in this library.
 * Threads: any number, each with handles of its own. FFTW's planner is shared by a process, and guarded among these
 * handles only: a program that plans with FFTW itself must not do so while another thread is in this library.
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
  int (*tick)(void *self, double done);
  void *self; /* the caller's, handed to tick */
} hbmcheck_monitor;

/* ---- a case ---- */

typedef struct hbmcheck_case hbmcheck_case;

/* Read the YAML case file at path ("-": standard input), then apply the n_set >= 0 assignments "PATH=VALUE", such as
 * "hbm.harmonics=10", in order. set may be NULL if n_set = 0. message[size] gets one line without a newline,
 * "FILE:LINE:COLUMN: what is wrong, what was expected", cut to size (512 holds any), or "" if all is well; it may be
 * NULL. HBMCHECK_OK; HBMCHECK_BAD_INPUT (the message says what), HBMCHECK_IO, HBMCHECK_NO_MEMORY: *out is NULL. */
hbmcheck_status hbmcheck_case_read(const char *path, int n_set, const char *const *set, char *message, size_t size,
                                   hbmcheck_case **out);

/* From text[length], called name in messages. HBMCHECK_OK; HBMCHECK_BAD_INPUT, HBMCHECK_NO_MEMORY: *out is NULL. */
hbmcheck_status hbmcheck_case_parse(const char *name, const char *text, size_t length, int n_set,
                                    const char *const *set, char *message, size_t size, hbmcheck_case **out);

void hbmcheck_case_free(hbmcheck_case *c);

/* What is reported of a structure's motion x is each of its responses r . x, of which results tell by number, from 0;
 * an oscillator has one, x itself. How many; 0 for NULL. */
int hbmcheck_case_responses(const hbmcheck_case *c);

/* Response r in words, "x" of an oscillator, into text[size], cut to size (32 holds any). HBMCHECK_OK or _BAD_INPUT. */
hbmcheck_status hbmcheck_case_response_name(const hbmcheck_case *c, int r, char *text, size_t size);

/* The contacts, numbered from 0 in the case's order. How many; 0 for NULL. */
int hbmcheck_case_contacts(const hbmcheck_case *c);

/* The name of contact j, or its number, into text[size], cut to size (32 holds any). HBMCHECK_OK or _BAD_INPUT. */
hbmcheck_status hbmcheck_case_contact_name(const hbmcheck_case *c, int j, char *text, size_t size);

/* In how many tangential directions contact j may slip: 1, or 2 in space; 0: no such contact, NULL, no memory. */
int hbmcheck_case_contact_tangents(const hbmcheck_case *c, int j);

/* Shall hbmcheck_transient_run and hbmcheck_comparison_run of c measure what each contact does, too? on = 0: no, as at
 * first; it may take as long again. Of harmonic balance hbmcheck_curve_contacts tells at any time. NULL: none. */
void hbmcheck_case_watch_contacts(hbmcheck_case *c, int on);

/* ---- harmonic balance ----
 *
 *     x(t) ~ X[0] + sum_{h=1..H} X[2h-1] cos(h omega t) + X[2h] sin(h omega t) */

/* The strongest thing that happens to any contact in a period. */
typedef enum hbmcheck_contact {
  HBMCHECK_CONTACT_LINEAR,     /* no contact is ever closed */
  HBMCHECK_CONTACT_STICK,      /* those that are closed stay closed and stick */
  HBMCHECK_CONTACT_SLIP,       /* those that are closed stay closed, and one of them slips */
  HBMCHECK_CONTACT_SEPARATION, /* one opens and closes */
  HBMCHECK_CONTACT_SMOOTH      /* none slips or opens, and one has a smooth law: between stick and slip */
} hbmcheck_contact;

/* What one contact does over a period of a motion, as the commands say with --contacts; two tangents are one. */
typedef struct hbmcheck_contact_period {
  double normal_min, normal_max; /* [force] extrema of the normal force N >= 0 */
  double traction_max;           /* [force] the largest |T| */
  double slip_distance;          /* [length] path of the slider over the surface while it slips */
  double work;                   /* [force length] dissipated by friction in the period */
  hbmcheck_contact regime;       /* of this contact: never closed, closed and sticking, ... */
} hbmcheck_contact_period;

/* "linear", "stick", "slip", "separation", "smooth"; a constant string, never NULL. */
const char *hbmcheck_contact_name(hbmcheck_contact contact);

/* One solution. */
typedef struct hbmcheck_solution {
  double omega;             /* [rad/time] */
  double amplitude;         /* [length] (max - min)/2 of x over a period */
  double max, min;          /* [length] */
  double rms, mean;         /* [length] rms: mean included */
  double harmonic_1;        /* [length] |a1 + i b1| = hypot(X[1], X[2]) */
  double multiplier;        /* [1] modulus of the largest Floquet multiplier; NaN: it could not be computed */
  double residual;          /* [1] of the equations, largest component, relative to the forces that make it up */
  int stable;               /* 1 stable, -1 unstable, 0 unknown */
  int branch;               /* turning points passed since the start of the curve */
  int harmonics;            /* H kept at this point: changes along the curve for hbm.harmonics: auto */
  int iterations;           /* of Newton; 0: taken from the linear closed form */
  hbmcheck_contact contact; /* what happens at the contacts */
  int mean_free;            /* 1: a slider never slips, and mean, max, min and rms depend on the history */
} hbmcheck_solution;

/* Several solutions in the order of the curve they lie on. */
typedef struct hbmcheck_solutions hbmcheck_solutions;

int hbmcheck_solutions_count(const hbmcheck_solutions *s);

/* Solution k, 0 <= k < count. HBMCHECK_OK, HBMCHECK_BAD_INPUT. */
hbmcheck_status hbmcheck_solutions_get(const hbmcheck_solutions *s, int k, hbmcheck_solution *out);

/* The same of response r; r = 0 is what hbmcheck_solutions_get gives. */
hbmcheck_status hbmcheck_solutions_get_response(const hbmcheck_solutions *s, int k, int r, hbmcheck_solution *out);

/* Fourier coefficients of solution k: *n = 2H+1 is how many there are, of which the first cap are written to
 * X [length]. cap = 0 asks for *n alone: X may be NULL then. HBMCHECK_OK, HBMCHECK_BAD_INPUT. */
hbmcheck_status hbmcheck_solutions_coefficients(const hbmcheck_solutions *s, int k, int cap, double *X, int *n);

/* The same of response r. */
hbmcheck_status hbmcheck_solutions_response_coefficients(const hbmcheck_solutions *s, int k, int r, int cap, double *X,
                                                         int *n);

void hbmcheck_solutions_free(hbmcheck_solutions *s);

/* A response curve, with the means to search it again. */
typedef struct hbmcheck_curve hbmcheck_curve;

/* Follow the response curve of c over its sweep, from the solution at the sweep's first omega, past turning points;
 * with the stability of every point. HBMCHECK_OK: to the sweep's end, or to where the branch turned back and left the
 * sweep (left_at_start of struct hbmcheck_summary). HBMCHECK_BAD_INPUT, HBMCHECK_NO_MEMORY: *out is NULL. Why the curve
 * stops before its end: HBMCHECK_INTERRUPTED, HBMCHECK_STALLED, HBMCHECK_NOT_CONVERGED, HBMCHECK_SINGULAR,
 * HBMCHECK_NOT_FINITE, HBMCHECK_STEP_TOO_SMALL, HBMCHECK_TOO_MANY_POINTS, HBMCHECK_NOT_CLOSED, HBMCHECK_CHATTER. */
hbmcheck_status hbmcheck_curve_trace(const hbmcheck_case *c, const hbmcheck_monitor *monitor, hbmcheck_curve **out);

/* The points of the curve, to look at: they are the curve's and go with it. NULL for NULL. */
const hbmcheck_solutions *hbmcheck_curve_points(const hbmcheck_curve *curve);

/* Every solution on the curve at omega > 0, each solved for. None, with HBMCHECK_OK, where a whole curve never comes to
 * that omega. Where the curve stops before its end the status says why it does, and what is in *out may not be all.
 * HBMCHECK_OK; HBMCHECK_BAD_INPUT, HBMCHECK_NO_MEMORY: *out is NULL; else as hbmcheck_curve_trace. */
hbmcheck_status hbmcheck_curve_at(hbmcheck_curve *curve, double omega, hbmcheck_solutions **out);

/* What each contact does in solution k of s, which are the points of this curve or what hbmcheck_curve_at found on it;
 * by the exact law, also where hbm.force is sampled. *n = hbmcheck_case_contacts of the case, of which the first cap
 * are written to out; cap = 0 asks for *n alone: out may be NULL then. HBMCHECK_OK; *n and out are not touched after
 * HBMCHECK_BAD_INPUT, HBMCHECK_NO_MEMORY, HBMCHECK_NOT_FINITE, HBMCHECK_CHATTER, HBMCHECK_NOT_CLOSED,
 * HBMCHECK_NOT_CONVERGED, HBMCHECK_SINGULAR. */
hbmcheck_status hbmcheck_curve_contacts(hbmcheck_curve *curve, const hbmcheck_solutions *s, int k, int cap,
                                        hbmcheck_contact_period *out, int *n);

typedef enum hbmcheck_special_kind {
  HBMCHECK_SPECIAL_TURNING_POINT,
  HBMCHECK_SPECIAL_PERIOD_DOUBLING,
  HBMCHECK_SPECIAL_CONTACT_CHANGE,
  HBMCHECK_SPECIAL_NEIMARK_SACKER,   /* a complex pair of multipliers passes the unit circle */
  HBMCHECK_SPECIAL_SYMMETRY_BREAKING /* of smooth laws: two motions begin that are each other's mirror image */
} hbmcheck_special_kind;

/* A point where the curve changes its nature, located to 1e-9 of omega or better. */
typedef struct hbmcheck_special {
  double omega;     /* [rad/time] */
  double amplitude; /* [length] */
  int branch;       /* a turning point belongs to the branch it ends */
  hbmcheck_special_kind kind;
  hbmcheck_contact before, after; /* along the curve; equal where only the number of transitions in a period changes */
} hbmcheck_special;

/* All of them in the curve's order: *n is how many there are, of which the first cap are written to out; cap = 0 asks
 * for *n alone: out may be NULL then. HBMCHECK_OK; HBMCHECK_BAD_INPUT, HBMCHECK_NO_MEMORY: *n and out are not touched.
 * Any other status of hbmcheck_curve_trace: at least one more was noticed, and could not be located for this reason. */
hbmcheck_status hbmcheck_curve_specials(hbmcheck_curve *curve, int cap, hbmcheck_special *out, int *n);

/* A whole curve in a few numbers. */
typedef struct hbmcheck_summary {
  double peak_omega, peak_amplitude, peak_harmonic_1; /* [rad/time], [length]: largest amplitude; NaN: no peak found */
  int points, turning_points;
  int harmonics, samples;       /* in use: for auto, the most the curve needed. samples 0: exact forces */
  int rejected;                 /* continuation steps tried and not taken */
  long iterations, evaluations; /* of Newton, of the contact force; rejected steps included */
  int reached_end;              /* 1: the curve comes to the end of its sweep */
  int left_at_start;            /* 1: the branch turned back and left the sweep where it began */
  int inaccurate;               /* 1: somewhere the most that auto takes did not meet hbm.accuracy */
} hbmcheck_summary;

/* HBMCHECK_OK, HBMCHECK_BAD_INPUT, HBMCHECK_NO_MEMORY. */
hbmcheck_status hbmcheck_curve_summary(hbmcheck_curve *curve, hbmcheck_summary *out);

void hbmcheck_curve_free(hbmcheck_curve *curve);

/* ---- time integration ---- */

enum { HBMCHECK_MAX_OMEGAS = 1024 /* in one run, as in a case file */ };

/* One steady state. Measures are of the orbit found, over all its period_multiple periods; NaN unless status is
 * HBMCHECK_OK, HBMCHECK_NOT_SETTLED or HBMCHECK_APERIODIC. In the latter two they are those of the last period. */
typedef struct hbmcheck_steady {
  hbmcheck_status status;      /* HBMCHECK_OK: settled. Else HBMCHECK_NOT_SETTLED, HBMCHECK_APERIODIC,
                                  HBMCHECK_INTEGRATOR, HBMCHECK_NOT_FINITE, HBMCHECK_CHATTER, HBMCHECK_NOT_CONVERGED,
                                  HBMCHECK_SINGULAR, HBMCHECK_STALLED, HBMCHECK_NOT_CLOSED, HBMCHECK_INTERRUPTED */
  hbmcheck_status without_hbm; /* why a start on an HBM orbit became a start at rest; HBMCHECK_OK: it did not */
  double omega;                /* [rad/time] */
  double amplitude, max, min;  /* [length] amplitude = (max - min)/2 */
  double rms, mean;            /* [length] */
  double harmonic_1;           /* [length] |a1 + i b1| */
  double closure;              /* [1] estimated distance to the periodic orbit, relative to the amplitude; may be
                                  infinite */
  double multiplier;           /* [1] modulus of the orbit's largest Floquet multiplier; NaN: not known */
  double from_regularisation;  /* [1] estimated error of the amplitude by the regularised law, relative; NaN: not
                                  known */
  int stable;                  /* 1 stable, -1 unstable (an orbit found by shooting), 0 unknown */
  int period_multiple;         /* forcing periods after which the motion repeats; 0: status is not HBMCHECK_OK */
  int periods;                 /* forcing periods integrated */
  long steps;                  /* CVODE's */
  int free_sliders;            /* contacts that stick all the time: the mean is a matter of history where > 0 */
  int left_orbit;              /* 1: the orbit next to the start is unstable, and the motion left it */
  int response;                /* which one, from 0: of a structure there is one of these for each, together */
  hbmcheck_contact contact;    /* what happens at the contacts in a period */
} hbmcheck_steady;

typedef struct hbmcheck_transient hbmcheck_transient;

/* The steady states of c at omega[n], each > 0 and finite, 0 <= n <= HBMCHECK_MAX_OMEGAS; n = 0: at the case's own
 * compare.omega (omega may be NULL then). Equal ones count once; results are in ascending order, in descending order
 * for transient.start: down. Each starts where transient.start says: on each HBM solution's orbit (one steady state a
 * solution), at rest, or swept from an end of the sweep. HBMCHECK_OK also where single states failed: they say so.
 * HBMCHECK_BAD_INPUT (also: n = 0 and the case has no compare.omega), HBMCHECK_NO_MEMORY: *out is NULL.
 * HBMCHECK_INTERRUPTED. */
hbmcheck_status hbmcheck_transient_run(const hbmcheck_case *c, int n, const double *omega,
                                       const hbmcheck_monitor *monitor, hbmcheck_transient **out);

int hbmcheck_transient_count(const hbmcheck_transient *t);

/* Steady state k, 0 <= k < count. HBMCHECK_OK, HBMCHECK_BAD_INPUT. */
hbmcheck_status hbmcheck_transient_get(const hbmcheck_transient *t, int k, hbmcheck_steady *out);

/* Its last period: *n values of x [length] at i/n of it from the forcing's maximum on, the first cap written; cap = 0
 * (x may be NULL) asks for *n alone. *n = 0: it has no measures. HBMCHECK_OK, HBMCHECK_BAD_INPUT. */
hbmcheck_status hbmcheck_transient_wave(const hbmcheck_transient *t, int k, int cap, double *x, int *n);

/* What contacts do in steady state k, by its law: *n = hbmcheck_case_contacts, the first cap to out; cap = 0 (out may
 * be NULL) asks for *n alone. *n = 0: not told to watch, no measures, or not to be told. HBMCHECK_OK or _BAD_INPUT. */
hbmcheck_status hbmcheck_transient_contacts(const hbmcheck_transient *t, int k, int cap, hbmcheck_contact_period *out,
                                            int *n);

void hbmcheck_transient_free(hbmcheck_transient *t);

/* ---- the comparison ---- */

typedef enum hbmcheck_verdict {
  HBMCHECK_VERDICT_MATCH,        /* every error is within the case's gate */
  HBMCHECK_VERDICT_DIFFERS,      /* same orbit, but an error is beyond the gate */
  HBMCHECK_VERDICT_OTHER_BRANCH, /* the transient runs on another orbit than the stable one next to this HBM solution */
  HBMCHECK_VERDICT_UNSTABLE,     /* this HBM solution is unstable: no motion stays there */
  HBMCHECK_VERDICT_PERIOD_K,     /* the transient repeats only after k > 1 forcing periods: period_multiple */
  HBMCHECK_VERDICT_APERIODIC,    /* the transient never repeats: it is chaotic, or runs on a torus */
  HBMCHECK_VERDICT_NOT_SETTLED,  /* no steady state within transient.max_periods */
  HBMCHECK_VERDICT_SOLVER_FAILED, /* one side gave up: hbm_status, transient_status */
  HBMCHECK_VERDICT_UNBOUNDED,     /* the motion grows without bound */
  HBMCHECK_VERDICT_CREEPS,        /* the body slides on by as much in each period */
  HBMCHECK_VERDICT_UNDECIDED      /* no orbit was found next to the HBM solution: not known whether that is wrong */
} hbmcheck_verdict;

/* "match", "differs", "other_branch", "unstable", "period_k", "aperiodic", "not_settled", "solver_failed", "unbounded",
 * "creeps", "undecided"; not NULL. */
const char *hbmcheck_verdict_name(hbmcheck_verdict verdict);

/* One HBM solution and the transient. Errors are relative to the transient's amplitude, those named orbit_ to the
 * orbit's; phases are as they are: the forcing fixes them. */
typedef struct hbmcheck_row {
  double omega;                     /* [rad/time] */
  hbmcheck_verdict verdict;         /* what the comparison came to */
  hbmcheck_status hbm_status;       /* HBMCHECK_OK, or why there is no HBM solution: as hbmcheck_curve_trace */
  hbmcheck_status transient_status; /* as in struct hbmcheck_steady, or HBMCHECK_UNSUPPORTED: not tried */
  hbmcheck_status orbit_status;     /* of the search for the orbit; the same */
  int branch;                       /* of the HBM solution; -1: there is none */
  int stable;                       /* of the HBM solution: 1 stable, -1 unstable, 0 unknown */
  int period_multiple;              /* forcing periods after which the transient repeats; 0: it does not */
  int accounted;                    /* 1: the transient is within the gate of this or another HBM solution at omega */
  double multiplier;                /* [1] modulus of the HBM solution's largest Floquet multiplier; NaN: not known */
  double hbm_amplitude;             /* [length] NaN: no HBM solution */
  double transient_amplitude;       /* [length] NaN: no transient */
  /* [length] of the exact law's periodic orbit next to the HBM solution, stable or not; NaN: not found */
  double orbit_amplitude;
  double amplitude_error;  /* [1] |difference of (max - min)/2| */
  double harmonic_1_error; /* [1] |difference of |a1 + i b1|| */
  double mean_error;       /* [1] |difference of the means|; NaN where mean_free */
  double waveform_error;   /* [1] largest |difference of x| over the period. These four: NaN: nothing to compare */
  double orbit_error;      /* [1] largest |difference of x| to the orbit; NaN: not found */
  /* [1] what the difference in amplitude is made of: each measured by taking that cause alone away; NaN: not known */
  double from_aliasing, from_truncation, from_regularisation, from_integration, from_settling;
  /* [1] of its own amplitude: the error each side expects of itself, before it sees the other; NaN: not known */
  double hbm_predicted, transient_predicted;
  int unexpected; /* 1: the discrepancy is above three times what both predicted: something is wrong */
  int mean_free;  /* 1: a slider never slips: the mean depends on the history and was not compared */
  int response;   /* which one, from 0: of a structure a row for each, together */
  int still;      /* 1: it moves less than 1e-9 of the largest, and is not compared */
  int family;     /* 1: a slider that never slips decides on the harmonics, too: one of many steady states */
} hbmcheck_row;

/* The gate: every number of the comparison against the limits of the case. */
typedef struct hbmcheck_gate {
  int checks;         /* made */
  int failed;         /* of them beyond the limit */
  int errors;         /* of them without anything to hold the number against */
  int exit_code;      /* 0: all within; 1: something failed; 3: else, something could not be compared */
  int not_applicable; /* of them about a mean that a slider which never slips leaves open */
} hbmcheck_gate;

/* One contact in one HBM solution, and in the transient it is held against. */
typedef struct hbmcheck_contact_row {
  /* By the exact law along the HBM solution; by the transient's own law. What is not known is NaN. */
  hbmcheck_contact_period hbm, transient;
  double work_error;   /* [1] |difference| of the work relative to the largest of any contact on either side; NaN: not
                          known */
  double normal_error; /* [1] |difference| of normal_min relative to the largest normal force of this contact; NaN: not
                          known, or a matter of history */
  int compared;        /* 1: both sides are known, and of one orbit: differs says something */
  int differs;         /* 1: an error is beyond the gate's waveform, or one side never touches */
  hbmcheck_status hbm_status, transient_status; /* HBMCHECK_OK, or why that side is not known */
} hbmcheck_contact_row;

typedef struct hbmcheck_comparison hbmcheck_comparison;

/* Both sides at omega[n] as in hbmcheck_transient_run; n = 0: at the case's compare.omega, or compare.points of them
 * chosen along the curve. One row a frequency, HBM solution and response. HBMCHECK_OK also where single rows failed:
 * their verdicts say so. HBMCHECK_BAD_INPUT, HBMCHECK_NO_MEMORY: *out is NULL. HBMCHECK_INTERRUPTED. Where
 * compare.points could not be chosen, why: as hbmcheck_curve_trace. */
hbmcheck_status hbmcheck_comparison_run(const hbmcheck_case *c, int n, const double *omega,
                                        const hbmcheck_monitor *monitor, hbmcheck_comparison **out);

int hbmcheck_comparison_count(const hbmcheck_comparison *c);

/* Row k, 0 <= k < count. HBMCHECK_OK, HBMCHECK_BAD_INPUT. */
hbmcheck_status hbmcheck_comparison_get(const hbmcheck_comparison *c, int k, hbmcheck_row *out);

/* Each contact in row k: *n = hbmcheck_case_contacts, the first cap to out; cap = 0 (out may be NULL) asks for *n
 * alone. *n = 0: not told to watch them, or no HBM solution. HBMCHECK_OK, HBMCHECK_BAD_INPUT. */
hbmcheck_status hbmcheck_comparison_contacts(const hbmcheck_comparison *c, int k, int cap, hbmcheck_contact_row *out,
                                             int *n);

/* What `hbmcheck compare` exits with: 0 both sides agree; 1 a transient differs from every HBM solution at its omega,
 * or has another period; 3 something could not be compared, c is NULL, or its run did not end with HBMCHECK_OK. */
int hbmcheck_comparison_exit_code(const hbmcheck_comparison *c);

/* What `hbmcheck gate` says. HBMCHECK_OK, HBMCHECK_BAD_INPUT; or, for a run that did not end with HBMCHECK_OK, its
 * status: part of a comparison is not judged. */
hbmcheck_status hbmcheck_comparison_gate(const hbmcheck_comparison *c, hbmcheck_gate *out);

void hbmcheck_comparison_free(hbmcheck_comparison *c);

/* ---- another program's curve ---- */

/* What is to be judged: values of one quantity of response `response`, as `hbmcheck verify` takes them from a file. */
typedef struct hbmcheck_foreign {
  int response;         /* from 0, as in hbmcheck_case_response_name */
  const char *quantity; /* "amplitude", "harmonic_1", "dB_harmonic_1", "rms", ...: docs/verify.md has them all */
  int n;                /* 3..100000; those at omega <= 0 are left out and do not count */
  const double *omega;  /* [n] [rad/time] finite, in any order */
  const double *value;  /* [n] [length], of velocities and accelerations per time or time^2; finite; >= 0 unless it is
                           of max, min, mean or in dB */
  double noise;         /* [1] 0..1: standard deviation of a value relative to the amplitude, as of a measured curve */
} hbmcheck_foreign;

/* One point of it, in their order. */
typedef struct hbmcheck_point {
  double omega;             /* [rad/time] */
  double value, nearest;    /* in the quantity's unit: theirs, and that of the nearest solution; NaN: there is none */
  double error;             /* [1] |value - nearest| relative to the amplitude; NaN: there is no solution */
  hbmcheck_verdict verdict; /* HBMCHECK_VERDICT_MATCH, _DIFFERS, _UNSTABLE, _OTHER_BRANCH or _SOLVER_FAILED */
  int index;                /* in the arrays handed in, from 0 */
  int branch;               /* of the nearest solution; -1: there is none */
  int stable;               /* of it: 1 stable, -1 unstable, 0 unknown */
  int skipped;              /* 1: the quantity depends on where a slider rests that never slips: not compared */
} hbmcheck_point;

/* What came of all of them. */
typedef struct hbmcheck_findings {
  int points;                                                /* judged or skipped */
  int match, differs, unstable, other_branch, solver_failed; /* of those that are not skipped */
  int skipped;                                               /* of them */
  int left_out;                                              /* at omega <= 0 */
  int reversals;                                             /* how often omega turns back */
  int harmonics;                                             /* of the solutions they are held against */
  int checked, unchecked; /* solutions held against time integration; where that found no orbit */
  int exit_code;          /* of `hbmcheck verify`: 0 every point matches, 1 some do not, 3 could not be judged */
  double gate;            /* [1] what the error may be */
  double checked_error;   /* [1] the largest difference of the solutions checked, relative to the amplitude */
  double truth_distance;  /* [1] how far off nine of ten points that differ are; NaN: no cause was looked for */
  double noise;           /* [1] scatter from point to point, as estimated; NaN: it was not */
} hbmcheck_findings;

typedef struct hbmcheck_verification hbmcheck_verification;

/* Judge the points of *curve, whose arrays are not needed afterwards, and look for the cause where they are off.
 * message[size] as in hbmcheck_case_read: what is wrong with them, or "". HBMCHECK_OK. HBMCHECK_BAD_INPUT (the message
 * says what), HBMCHECK_NO_MEMORY: *out is NULL. HBMCHECK_INTERRUPTED; or why there is no solution to hold them against,
 * as hbmcheck_curve_trace: what was judged until then is kept. */
hbmcheck_status hbmcheck_verification_run(const hbmcheck_case *c, const hbmcheck_foreign *curve,
                                          const hbmcheck_monitor *monitor, char *message, size_t size,
                                          hbmcheck_verification **out);

/* How many points have been judged. */
int hbmcheck_verification_count(const hbmcheck_verification *v);

/* Point k, 0 <= k < count. HBMCHECK_OK, HBMCHECK_BAD_INPUT. */
hbmcheck_status hbmcheck_verification_get(const hbmcheck_verification *v, int k, hbmcheck_point *out);

/* HBMCHECK_OK, HBMCHECK_BAD_INPUT. */
hbmcheck_status hbmcheck_verification_findings(const hbmcheck_verification *v, hbmcheck_findings *out);

/* The suspected cause in one word, several joined by "+": "none" where every point is right, "unknown" where no cause
 * is sure; the nearest guess where none is, "none" without one; and the cause in a sentence. Strings of v, gone with
 * it; "" for NULL. */
const char *hbmcheck_verification_cause(const hbmcheck_verification *v);
const char *hbmcheck_verification_guess(const hbmcheck_verification *v);
const char *hbmcheck_verification_sentence(const hbmcheck_verification *v);

/* A mistake that was made on purpose: our own harmonic balance with it, and the columns read so. */
typedef struct hbmcheck_hypothesis {
  double distance;     /* [1] relative to the amplitude: nine of ten points that differ are within it, and of ten that
                          match */
  double omega_factor; /* omega is this times what the points say */
  double value_factor; /* a value is this times the quantity */
  int harmonics;       /* H; 0: without contact forces, or with sliders stuck, which is linear */
  int keep_mean;       /* 1: harmonic 0 is kept; 0 also where it is linear */
  int samples;         /* per period; 0: exact forces */
  int slider_restart;  /* where contact is made between samples the slider starts 0: at the sample, 1: interpolated */
} hbmcheck_hypothesis;

/* How many were made: the best of every set of mistakes; none where every point is right. */
int hbmcheck_verification_hypotheses(const hbmcheck_verification *v);

/* Number k, 0 <= k < that, the best first. HBMCHECK_OK, HBMCHECK_BAD_INPUT. */
hbmcheck_status hbmcheck_verification_hypothesis(const hbmcheck_verification *v, int k, hbmcheck_hypothesis *out);

/* Its mistakes in one word, several joined by "+", and the quantity that values are then, into cause[cause_size] and
 * quantity[quantity_size], cut to size (1024 and 48 hold any). HBMCHECK_OK, HBMCHECK_BAD_INPUT. */
hbmcheck_status hbmcheck_verification_hypothesis_text(const hbmcheck_verification *v, int k, char *cause,
                                                      size_t cause_size, char *quantity, size_t quantity_size);

void hbmcheck_verification_free(hbmcheck_verification *v);

/* ---- one contact under a motion that is given ---- */

enum { HBMCHECK_MAX_HARMONICS = 200 };

/* Fourier coefficients [force] of contact j's tangential force T (of two tangents T and T2) and normal force N, preload
 * included, in the steady state of its slider under u, u2 and v [length], from w = 0 where it never slips. All are
 * [2 harmonics + 1] in the order X[0], a1, b1, a2, ... of harmonic balance, 1 <= harmonics <= HBMCHECK_MAX_HARMONICS,
 * finite. u, u2, v may be NULL: no such motion; u2 and T2 must be NULL of a contact with one tangent. samples 0: exact,
 * no aliasing; else by that many samples a period, >= 2 harmonics + 1, the slider as hbm.slider_restart says.
 * Of a polynomial N is its force along v; of tanh omega is 1. HBMCHECK_OK; T, T2 and N are not touched after
 * HBMCHECK_BAD_INPUT (also: u where the contact has no tangent, v where it has no normal; a table, which is several),
 * HBMCHECK_NO_MEMORY, HBMCHECK_NOT_FINITE, HBMCHECK_CHATTER, HBMCHECK_NOT_CLOSED,
 * HBMCHECK_NOT_CONVERGED, HBMCHECK_SINGULAR. */
hbmcheck_status hbmcheck_contact_force(const hbmcheck_case *c, int j, int harmonics, const double *u, const double *u2,
                                       const double *v, int samples, double *T, double *T2, double *N);

#ifdef __cplusplus
}
#endif
#endif
