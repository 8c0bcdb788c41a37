/* structure.h - what a case says with `structure`, or `oscillator`: its loads, contacts and responses, as written; the
 * damping matrix that follows, and its model. Degrees of freedom count from 0 here, from 1 in a file. Vectors are
 * dense, [n]. */
#pragma once

#include "model/casefile/contact_model.h"
#include "model/casefile/matrices/matrix_file.h"

enum { SCENE_MAX_CONTACTS = 16 /* of an oscillator in a case file; others have any number */ };

/* Where something was given: the set-th assignment from 1, or 0 and a line and column of the file; line 0: nowhere. */
typedef struct case_place {
  int set;
  size_t line, column;
} case_place;

typedef enum structure_damping {
  STRUCTURE_DAMPING_MATRIX,
  STRUCTURE_DAMPING_RAYLEIGH, /* alpha M + beta K */
  STRUCTURE_DAMPING_MODAL,    /* one ratio for every mode of M, K */
  STRUCTURE_DAMPING_MODES     /* a ratio for each, in ascending order of frequency */
} structure_damping;

/* One matrix as it was given. */
typedef struct structure_matrix {
  double *v;            /* [n][n] by columns, or NULL if it has not been given, or is kept sparse */
  sparse kept;          /* of a structure that is kept sparse; start NULL: it has not been given */
  char *file;           /* that it came from, or NULL */
  const char *part;     /* of that file: the one it is where the file has several, a constant; or NULL */
  matrix_label *labels; /* [n], what the file says that its rows are, or NULL */
  case_place place;     /* in the case */
} structure_matrix;

/* What entries of lists own comes first in them. */
typedef struct structure_load { /* amplitude cos(harmonic omega t + phase) along `direction` */
  double *direction;            /* [n] [1] */
  double amplitude;             /* [force] */
  double phase_deg;             /* [deg] */
  int harmonic;                 /* >= 0; 0: a static load */
  bool by_node;                 /* its place was given as a node */
  case_place place;
} structure_load;

typedef struct structure_contact {
  double *tangent, *tangent_2, *normal; /* [n] [1] u = tangent . x, v = normal . x; all 0 where there is none */
  scene_contact given;                  /* its scalars; kt = mu = 0 without a tangent, kn = gap = 0 without a normal */
  double area;   /* of a pair of nodes, given.law's stiffnesses being per area times this; 0: none */
  bool by_angle; /* of one degree of freedom: given.angle_deg and the law say where it acts, and they are 0 */
  case_place place;
} structure_contact;

typedef struct structure_response {
  double *direction; /* [n] [1] */
  bool by_node;      /* it was given as a node, and is named by it */
  case_place place;
} structure_response;

/* Has A[n][n] no entry but 0 beside its diagonal? */
static inline bool structure_is_diagonal(const double *A, int n)
{
  for (size_t i = 0; i < (size_t)n * (size_t)n; ++i)
    if (A[i] != 0 && i % ((size_t)n + 1)) return false;
  return true;
}

/* 'x', 'y' or 'z'; the end of a string is none of them. */
static inline bool structure_is_axis(char c) { return c >= 'x' && c <= 'z'; }

typedef struct structure_node { /* of the finite-element mesh: which degree of freedom moves it in this direction */
  int dof, node;
  char direction; /* 'x', 'y' or 'z' */
} structure_node;

typedef struct scene_structure {
  int n;
  bool is_oscillator; /* written with `oscillator`: n = 1, one load, contacts by_angle */
  bool is_sparse;     /* case_read_sparse: its matrices are kept as they came, and neither checked nor resolved */
  structure_matrix mass, stiffness, damping; /* damping.v: what results from any kind of damping */
  structure_damping how;
  double rayleigh[2]; /* alpha [1/time], beta [time] */
  double modal;       /* [1] of critical */
  double *ratios;     /* [n] [1], for STRUCTURE_DAMPING_MODES */
  char **names;       /* [n], then NULL; or NULL */
  int n_nodes;        /* in order of node, then direction */
  structure_node *nodes;
  char *mesh;  /* path of the file that sets of nodes are in, or NULL */
  char *notes; /* how pairs of nodes were found, a line an entry, or NULL */
  int n_loads;
  structure_load *loads;
  double *base; /* [n] [1] the way of each degree of freedom as the base moves by 1; NULL: it does not move */
  int n_contacts;
  structure_contact *contacts;
  int n_responses; /* 0: the default */
  structure_response *responses;
  double reduction_error; /* [1] of the receptance, that a reduction stated; 0: none did */
  double reduction_at;    /* the frequency where, in the sweep's unit */
  case_place place;
} scene_structure;

/* An empty one; an oscillator, which has a load of harmonic 1 and no contacts; a copy that shares nothing; free takes
 * NULL. NULL when out of memory. */
scene_structure *structure_new(void);
scene_structure *structure_new_oscillator(double mass, double damping, double stiffness, double force);
scene_structure *structure_copy(const scene_structure *s);
void structure_free(scene_structure *s);

/* Forget a matrix. */
void structure_free_matrix(structure_matrix *m);

/* One more line of notes. HC_NO_MEMORY. */
hc_status structure_note(scene_structure *s, const char *line);

/* Remove all loads, contacts with their notes, or responses. */
void structure_clear_loads(scene_structure *s);
void structure_clear_contacts(scene_structure *s);
void structure_clear_responses(scene_structure *s);

/* Contact j is gone, and those behind it move up. */
void structure_drop_contact(scene_structure *s, int j);

/* Only response r, 0 <= r < n_responses, stays; nothing to do where the default is all there is. */
void structure_keep_response(scene_structure *s, int r);

/* One more at the end, with vectors of zeros and all else 0, an oscillator's contact by_angle; NULL when out of memory.
 */
structure_load *structure_add_load(scene_structure *s);
structure_contact *structure_add_contact(scene_structure *s);
structure_response *structure_add_response(scene_structure *s);

/* The degree of freedom of that name, or of that number from 1; -1 if there is none. */
int structure_dof(const scene_structure *s, const char *text, size_t length);

/* The degree of freedom of a node in a direction, -1 if there is none. */
int structure_node_dof(const scene_structure *s, int node, char direction);

/* The node and direction that a degree of freedom moves; NULL: none is known. */
const structure_node *structure_node_of(const scene_structure *s, int dof);

/* The contact of that name, -1 if there is none. */
int structure_contact_named(const scene_structure *s, const char *name, size_t length);

/* A degree of freedom in words: its name, or its number from 1. In text[STRUCTURE_WORD], which is returned. */
enum { STRUCTURE_WORD = 32 };
const char *structure_dof_name(const scene_structure *s, int dof, char text[STRUCTURE_WORD]);

/* `tip`, `tip-root`, `0.5*tip+root` into text[size], cut with "..." at its end. Returns text. */
const char *structure_direction_name(const scene_structure *s, const double *direction, char *text, size_t size);

/* ---- files of nodes (nodes_file.c) ----
 *
 * Which degree of freedom moves which node of a mesh in which direction: a csv file of lines dof,node,direction, that
 * line itself the first; CalculiX' JOB.dof; or a matrix file of Abaqus or CalculiX that says what its rows are
 * (matrix_file.h). The first line tells which. */

/* One more node of s, in order of node and direction; it must not be there yet. HC_NO_MEMORY. */
hc_status nodes_add(scene_structure *s, int dof, int node, char direction);

/* The file into s->nodes. HC_BAD_INPUT: "PATH:LINE:COLUMN: ..." in m; HC_IO: words to follow its name; HC_NO_MEMORY. */
hc_status nodes_file_read(const char *path, scene_structure *s, struct message *m);

/* The same from text[length], which `name` stands for. */
hc_status nodes_file_parse(const char *name, const char *text, size_t length, scene_structure *s, struct message *m);

/* ---- the model ---- */

/* To free with model_free. The loads of a harmonic are summed: amplitude cos(k omega t + phase) is amplitude
 * cos(phase) cos(k omega t) - amplitude sin(phase) sin(k omega t). M base cos(omega t) is one more, the last. A
 * response where the case names none is the DOF that the first load with a harmonic >= 1 acts on most, or else the
 * first one. HC_NO_MEMORY: *out is NULL. */
hc_status structure_model(const scene_structure *s, model **out);

/* The first of the model's contacts that contact j is, for 0 <= j <= n_contacts: n_contacts gives their number. */
int structure_model_contact(const scene_structure *s, int j);

/* The number of responses; the name of one, its node `1328 z` or its direction, an oscillator's x, in text[size], which
 * is returned. */
int structure_response_count(const scene_structure *s);
const char *structure_response_name(const scene_structure *s, int r, char *text, size_t size);

/* Cosine and sine of an angle [deg], exact at multiples of 90. */
void structure_cosine_sine(double angle_deg, double *cosine, double *sine);

#define STRUCTURE_SYMMETRY 1e-10

/* Is A[n][n] unsymmetric beyond 1e-10 of its diagonal? Then the first such entry, from 0, i > j. */
bool structure_unsymmetric(int n, const double *A, int *i, int *j);

/* ---- what its matrices must be: rules, without words (structure_check.c) ---- */

/* *order = 0: M[n][n] is positive definite beyond rounding; else of the first minor that is not. HC_NO_MEMORY. */
hc_status structure_not_definite(int n, const double *M, int *order);

/* A motion x[n], largest entry 1, that neither K nor any contact resists: *free_motion = true if there is one. The
 * stiffness then is singular to rounding with every contact stuck, kt t t^T + kn n n^T each where it can hold, and with
 * d d^T of any size where a polynomial restores; at_rest: each that is pressed on without a load. HC_NO_MEMORY. */
hc_status structure_free_motion(const scene_structure *s, bool at_rest, double *x, bool *free_motion);

/* The same of a motion that M[n][n], symmetric, gives no kinetic energy to. HC_NO_MEMORY. */
hc_status structure_massless_motion(int n, const double *M, double *x, bool *massless);

/* *omega of the first mode that C (resolved) does not damp beyond rounding, or -1. HC_NO_MEMORY, HC_NOT_CONVERGED. */
hc_status structure_undamped_mode(const scene_structure *s, double *omega);

/* The degrees of freedom that move most, at most four, in words; x is used up. */
void structure_describe_motion(const scene_structure *s, double *x, struct message *m);

/* s->damping.v from the kind of damping: alpha M + beta K; or for modal damping M Phi diag(2 z omega) Phi^T M, the
 * columns of Phi being the modes of M and K with Phi^T M Phi = 1 (Craig and Kurdila, Fundamentals of Structural
 * Dynamics, 2006, chapter 10), K being symmetric then. HC_BAD_INPUT if a mode's omega^2 is negative beyond rounding;
 * HC_NO_MEMORY, HC_NOT_CONVERGED. */
hc_status structure_resolve_damping(scene_structure *s);
