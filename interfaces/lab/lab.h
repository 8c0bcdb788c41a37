/* lab.h - what the page asks of the library: a case in, tables of numbers out. Compiled to WebAssembly it is the
 * module's whole interface (interfaces/lab/README.md); natively it is what tests hold the module against.
 *
 * One degree of freedom: a structure is refused by lab_read. Tables are by rows, lab_rows by lab_columns values of type
 * double at lab_values; integers and enumerations stand in them as numbers, what is not known as NaN. A table is the
 * lab's and lasts until the next question. Units are the case's; omega in rad per unit time, th = omega t [rad].
 * Tables of results have the columns, with names, that all other interfaces have: compare/output/rows.c. A text of
 * theirs is the number of a lab_word; a series, the last column, takes the rest of the row.
 * Every question answers with a status of numerics/base/status.h as an int, 0 = HC_OK; what was found before it failed
 * is in the table all the same. The library's words for it are in lab_message. Nothing is printed. One lab, one thread.
 *
 *     X[2H+1]    x(th) = X[0] + sum_{h=1..H} X[2h-1] cos(h th) + X[2h] sin(h th) */
#pragma once

typedef struct lab lab;

lab *lab_new(void); /* NULL: out of memory */
void lab_free(lab *l);

/* The case file text[] becomes the lab's case; whatever was asked before is forgotten. HC_BAD_INPUT, and the case is
 * the old one: lab_message says "case:LINE:COLUMN: what is wrong, what was expected". HC_NO_MEMORY. */
int lab_read(lab *l, const char *text);

/* Its numbers. First row: mass, damping, stiffness, force, omega from, to, H, N (0: `auto`), and 1 or 0 for hbm.static,
 * hbm.force: sampled, hbm.slider_restart: sample. Then a contact's kt, kn, mu, angle [deg], gap, or of a polynomial the
 * coefficients of d^2..d^9; in column LAB_LAW its law: 0, or one of these; from LAB_POINTS on a table's points d, f.
 * HC_BAD_INPUT: none. */
enum { LAB_LAW = 10, LAB_POLYNOMIAL = 1, LAB_TABLE = 3, LAB_POINTS = 11 };
int lab_case(lab *l);

/* Its title, "" without one. */
const char *lab_title(const lab *l);

/* The words for the last answer, "" if it was HC_OK. */
const char *lab_message(const lab *l);

int lab_rows(const lab *l);
int lab_columns(const lab *l);
const double *lab_values(const lab *l);

/* Of a table of results: the name of column c, and which of "real", "integer", "text", "series" it is; its text number
 * i. NULL past the last, and of other tables. */
const char *lab_name(const lab *l, int c);
const char *lab_kind(const lab *l, int c);
const char *lab_word(const lab *l, int i);

/* The number of a column; -1: there is none of that name. */
int lab_column(const lab *l, const char *name);

/* ---- harmonic balance ---- */

enum { LAB_EXACT, LAB_SAMPLED }; /* the contact force: event-located, or with hbm.samples */

/* The response curve over the case's sweep, kept until the next of its kind: ROWS_FRF. Errors of hbm_trace. */
int lab_curve(lab *l, int force);

/* Every solution of that curve at omega, each solved for. HC_BAD_INPUT: there is no curve. Errors of hbm_curve_at. */
int lab_curve_at(lab *l, int force, double omega);

/* The sampled equations' solution next to each point of the exact curve, at its omega: Newton's from there. It is the
 * response with samples in little time; what has no exact counterpart, as folds of the samples, is not on it. A row
 * as of lab_curve for each point; omega and branch alone where Newton fails, or ends further off than half the motion,
 * at another solution. HC_BAD_INPUT: there is no exact curve, or the samples are too few for the harmonics. */
int lab_neighbours(lab *l);

/* The same of every exact solution at omega. Errors of hbm_curve_at. */
int lab_neighbours_at(lab *l, double omega);

/* Special points: ROWS_SPECIALS. */
int lab_specials(lab *l, int force);

/* ---- one motion X[2 n_harm + 1] ---- */

/* Memory for the X of the following questions, n_harm <= HBM_MAX_HARMONICS; the lab's. */
double *lab_motion(lab *l, int n_harm);

/* n instants th = 2 pi i/n; n may be the number of samples. Columns: th, x, and each contact's u, v, N and T: the exact
 * law's with LAB_EXACT, else as the n samples give it; of a polynomial or a table N is
 * its force. HC_BAD_INPUT: n < 1, no motion. Errors of exact_force_eval. */
int lab_signal(lab *l, int force, int n);

/* The contact force's harmonics h = 0..n_shown: h, cosine and sine of the true one, and of that sampled n times a
 * period (0 above n_harm and where n is too small for n_harm). Errors of exact_force_eval, aft_eval. */
int lab_spectrum(lab *l, int n, int n_shown);

/* A row a contact, by the exact law: contact_regime, least and largest N, largest |T|, slip path, work. */
int lab_work(lab *l);

/* ---- time integration by the exact law, in closed form, or by CVODE where a law has none ---- */

/* Steady states at omega[n], n <= NUMBER_LIST_MAX, from where transient.start says: ROWS_TRANSIENT. Errors of
 * steady_states_run. */
int lab_transients(lab *l, int n, const double *omega);

/* ---- error over H and N ---- */

/* The errors of the lab's motion, a solution at omega: for each of compare.harmonics, exact forces and each of
 * compare.samples: H, N (0: exact), status, amplitude, error of it against the closed form's orbit next to that
 * solution, relative; Newton's systems put to solve it. HC_BAD_INPUT: no motion, or no omega. Errors of timeint_orbit.
 */
int lab_errors(lab *l, double omega);
