/* step_equations.h - the linear equations of an implicit step of a structure with contacts, whose own states (sliders,
 * directions of slip) have been eliminated:
 *
 *     x = a + gamma p,   p + gamma (C p + K x + sum_j t_j f_j + n_j g_j) = b        (C, K: by_C C, by_K K)
 *     f_j = by_u u_j + by_v v_j + c_j,   g_j = n_v v_j,   u_j = t_j . x,   v_j = n_j . x
 *
 * by elimination of x and then of p: with D = 1 + gamma C + gamma^2 K, which is diagonal or factored, B the rows t_j,
 * n_j, and the forces S B x + c,
 *     (I + gamma^2 B D^-1 B^T S) B x = B (a + gamma D^-1 (b - gamma K a)) - gamma^2 B D^-1 B^T c
 * is a small dense system, whatever n. A solve costs O(n contacts), factors O(n contacts^2) where the factors of the
 * whole matrix cost (2 n + contacts)^3. Nothing is allocated after step_equations_make. */
#pragma once

#include "timeint/law/contact_rows.h"
#include "timeint/law/scaled.h"

/* The contact's derivatives. With two directions by_u has two rows, and n_v is half the contact's. */
typedef struct step_contact {
  int directions; /* 1 or 2 for a contact's first direction; 0 for its second, which the first includes */
  double by_u[2][2], by_v[2], n_v;
} step_contact;

typedef struct step_equations {
  const modal_base *base;    /* not owned */
  int n, n_contacts, n_rows; /* n_rows = rows.count */
  contact_rows rows;
  double gamma, by_K, by_C;
  step_contact *contact; /* [n_contacts] set by the caller before step_equations_factor */
  double *D;             /* [n] D if diagonal, else [n][n] its factors */
  double *pulled;        /* [n][n_rows] D^-1 B^T */
  double *compliant;     /* [n_rows][n_rows] B D^-1 B^T */
  double *small;         /* [n_rows][n_rows] factors of I + gamma^2 B D^-1 B^T S */
  double *force, *q;     /* [n_rows] c, after solving the forces; B x */
  double *p;             /* [n] */
  int *pivot, *small_pivot;
} step_equations;

/* Arrays are memory's. HC_NO_MEMORY. */
hc_status step_equations_make(step_equations *s, const modal_base *base, workspace *memory);

/* Factors the equations with s->contact, s->gamma and *m's coefficients; false: singular. */
bool step_equations_factor(step_equations *s, const scaled_model *m);

/* a[n], b[n] become x, p. On entry s->force[n_rows] is c, on return s->q is B x. */
void step_equations_solve(step_equations *s, double *a, double *b);

/* The motion of contact j from s->q: u in its directions; returns v. */
double step_equations_motion(const step_equations *s, int j, int directions, double u[2]);

/* force[row] += f, unless row is -1. */
static inline void step_equations_add(double *force, int row, double f)
{
  if (row >= 0) force[row] += f;
}
