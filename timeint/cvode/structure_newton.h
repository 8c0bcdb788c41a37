/* structure_newton.h - the linear equations of an implicit step of a structure with the regularised law,
 *
 *     (I - gamma J) (x, p, w) = (a, b, d),   J that of scaled.h:
 *     x = a + gamma p,   p + gamma (C p + K x + sum_j t_j f_j + n_j g_j) = b
 *     w_j = d_j + gamma (r_u (u_j - w_j) + r_v v_j)
 *     f_j = t_u (u_j - w_j) + t_v v_j,   g_j = n_v v_j,   u_j = t_j . x,   v_j = n_j . x      (C, K: by_C C, by_K K)
 * where two directions share the law of a circle r_u, t_u are matrices of two rows,
 *
 * by elimination of x and w, and then of p: with D = 1 + gamma C + gamma^2 K, which is diagonal or factored, B the rows
 * t_j, n_j, and the forces S B x + c of the contacts after their sliders' elimination,
 *     (I + gamma^2 B D^-1 B^T S) B x = B (a + gamma D^-1 (b - gamma K a)) - gamma^2 B D^-1 B^T c
 * is a small dense system, whatever n. A solve costs O(n contacts), factors O(n contacts^2) where the factors of the
 * whole matrix cost (2 n + contacts)^3. Nothing is allocated after structure_newton_make. */
#ifndef HC_TIMEINT_STRUCTURE_NEWTON_H
#define HC_TIMEINT_STRUCTURE_NEWTON_H

#include "timeint/law/contact_rows.h"
#include "timeint/law/scaled.h"

typedef struct structure_newton { /* from structure_newton_make, to structure_newton_free */
  const modal_base *base;         /* the owner's */
  int n, n_contacts, n_rows;      /* n_rows = rows.count */
  planar_derivatives *law;        /* [n_contacts] where the equations were linearised */
  int *directions;                /* [n_contacts] that share that law: 1, 2; 0: the second, whose law is the first's */
  contact_rows rows;
  double gamma, by_K, by_C;
  double *D;         /* [n] or [n][n]: D, or its factors */
  double *pulled;    /* [n][n_rows] D^-1 B^T */
  double *compliant; /* [n_rows][n_rows] B D^-1 B^T */
  double *small;     /* [n_rows][n_rows] factors of I + gamma^2 B D^-1 B^T S */
  double *force, *q; /* [n_rows] c, then the forces; B x */
  double *p;         /* [n] */
  int *pivot, *small_pivot;
  double *numbers; /* of all arrays of doubles */
} structure_newton;

hc_status structure_newton_make(structure_newton *s, const modal_base *base); /* HC_NO_MEMORY; free it in any case */
void structure_newton_free(structure_newton *s);

/* dy[n_states] at theta and y[n_states], the same as scaled_rhs. Answers whether all of it is finite. */
bool structure_newton_rate(const structure_newton *s, const scaled_model *m, double theta, const double *y, double *dy);

/* state[n_contacts] at y, as scaled_contact_state. */
void structure_newton_states(const structure_newton *s, const scaled_model *m, const double *y, contact_state *state);

/* The law's derivatives at y. */
void structure_newton_linearise(structure_newton *s, const scaled_model *m, const double *y);

/* Factors for that gamma and *m's coefficients; false: singular. */
bool structure_newton_factor(structure_newton *s, const scaled_model *m, double gamma);

/* r[n_states] := (I - gamma J)^-1 r. */
void structure_newton_solve(structure_newton *s, double *r);

/* out[n_states] := J z. */
void structure_newton_multiply(structure_newton *s, const scaled_model *m, const double *z, double *out);

#endif
