/* full_equations.h - the equations of motion of a structure, nothing condensed, at a harmonic-balance solution: what is
 * left of them in each harmonic. Contact forces by marching the law along the motion (marched_law.h) and integrating by
 * Gauss and Legendre's rule between its changes. */
#pragma once

#include "model/model.h"
#include "tests/hbm/marched_law.h"

enum { FULL_MAX_DOFS = 16, FULL_MAX_LENGTH = 64, FULL_NODES = 12, FULL_STEPS = 64 /* a period at least */ };

typedef struct full_motion {
  const model *m;
  int n_harm;
  double omega;
  double x[FULL_MAX_DOFS][FULL_MAX_LENGTH]; /* series of every DOF */
} full_motion;

/* Nodes and weights on [0, 1]: Newton on the Legendre polynomial. */
static inline void gauss_legendre(double *node, double *weight)
{
  for (int i = 0; i < FULL_NODES; ++i) {
    double z = cos(0.5 * TWO_PI * (i + 0.75) / (FULL_NODES + 0.5)), slope = 1;
    for (int it = 0; it < 50; ++it) {
      double p = 1, before = 0;
      for (int k = 1; k <= FULL_NODES; ++k) {
        const double next = ((2 * k - 1) * z * p - (k - 1) * before) / k;
        before = p;
        p = next;
      }
      slope = FULL_NODES * (z * p - before) / (z * z - 1);
      z -= p / slope;
    }
    node[i] = 0.5 * (1 + z);
    weight[i] = 1 / ((1 - z * z) * slope * slope);
  }
}

static inline void along_direction(int n, const double *direction, double (*x)[TAYLOR + 1], double *u)
{
  memset(u, 0, (TAYLOR + 1) * sizeof *u);
  for (int i = 0; i < n; ++i)
    for (int k = 0; k <= TAYLOR; ++k) u[k] += direction[i] * x[i][k];
}

/* u and v of contact j next to t. */
static inline void full_contact_motion(const full_motion *f, int j, double t, double *u, double *v)
{
  double x[FULL_MAX_DOFS][TAYLOR + 1];
  for (int i = 0; i < f->m->n; ++i) taylor_of_series(f->n_harm, f->x[i], f->omega, t, x[i]);
  along_direction(f->m->n, f->m->contacts[j].tangent, x, u);
  along_direction(f->m->n, f->m->contacts[j].normal, x, v);
}

/* The integrals of the force over [t, t + s], times omega/pi, added to T and N [2H+1] (the mean's: twice it). */
static inline void add_integrals(const full_motion *f, const marched *c, const double *u, const double *v, double t,
                                 double s, double *T, double *N)
{
  double node[FULL_NODES], weight[FULL_NODES], traction[TAYLOR + 1], change[TAYLOR + 1];
  gauss_legendre(node, weight);
  for (int k = 0; k <= TAYLOR; ++k) marched_force(c, k, u[k], v[k], &change[k], &traction[k]);
  for (int q = 0; q < FULL_NODES; ++q) {
    const double at = s * node[q], part = weight[q] * s * 2 * f->omega / TWO_PI;
    const double of_T = part * taylor_at(traction, at), of_N = part * taylor_at(change, at);
    T[0] += of_T, N[0] += of_N;
    for (int h = 1; h <= f->n_harm; ++h) {
      const double cosine = cos(h * f->omega * (t + at)), sine = sin(h * f->omega * (t + at));
      T[2 * h - 1] += of_T * cosine, N[2 * h - 1] += of_N * cosine;
      T[2 * h] += of_T * sine, N[2 * h] += of_N * sine;
    }
  }
}

/* Contact j from w = 0 at t = 0 through three periods; T and N [2H+1] of the last one. *c is its state at
 * the end, and of the last period how often that changed and how long it was not stuck. */
static inline void march_contact(const full_motion *f, int j, marched *c, double *T, double *N)
{
  const double period = TWO_PI / f->omega;
  const int steps = FULL_STEPS + 8 * f->n_harm;
  double u[TAYLOR + 1], v[TAYLOR + 1];
  memset(T, 0, FULL_MAX_LENGTH * sizeof *T);
  memset(N, 0, FULL_MAX_LENGTH * sizeof *N);
  *c = (marched){.law = f->m->contacts[j].law};
  full_contact_motion(f, j, 0, u, v);
  marched_begin(c, u, v, 0);
  for (int k = 0; k < 3 * steps; ++k) {
    if (k % steps == 0) c->changes = 0, c->loose = 0;
    double t = period * (k % steps) / steps;
    const double end = period * (k % steps + 1) / steps;
    while (t < end) {
      int which;
      full_contact_motion(f, j, t, u, v);
      const double s = marched_first_change(c, u, v, end - t, &which);
      if (k >= 2 * steps) add_integrals(f, c, u, v, t, s, T, N);
      c->changed = false;
      if (c->state != STUCK) c->loose += s;
      if (which >= 0) marched_change(c, u, v, s, which), ++c->changes;
      t = which >= 0 ? t + s : end;
      assert_true(c->changes < 10 * steps);
    }
  }
  T[0] /= 2, N[0] /= 2;
}

/* What the equations of x leave in any harmonic of any DOF, relative to the largest force that they are made of. */
static inline double full_residual(const full_motion *f)
{
  const model *m = f->m;
  static double left[FULL_MAX_DOFS][FULL_MAX_LENGTH];
  double T[FULL_MAX_LENGTH], N[FULL_MAX_LENGTH], scale = 0, worst = 0;
  memset(left, 0, sizeof left);
  for (int i = 0; i < m->n; ++i)
    for (int k = 0; k < m->n; ++k) {
      const double M = m->mass[k * m->n + i], C = m->damping[k * m->n + i], K = m->stiffness[k * m->n + i];
      const double *x = f->x[k];
      left[i][0] += K * x[0];
      scale = fmax(scale, fabs(K * x[0]));
      for (int h = 1; h <= f->n_harm; ++h) {
        const double w = h * f->omega, a = x[2 * h - 1], b = x[2 * h];
        left[i][2 * h - 1] += (K - w * w * M) * a + w * C * b;
        left[i][2 * h] += (K - w * w * M) * b - w * C * a;
        scale = fmax(scale, (fabs(K) + w * w * fabs(M) + w * fabs(C)) * (fabs(a) + fabs(b)));
      }
    }
  for (int j = 0; j < m->n_contacts; ++j) {
    marched c;
    march_contact(f, j, &c, T, N);
    for (int i = 0; i < m->n; ++i)
      for (int k = 0; k <= 2 * f->n_harm; ++k) {
        const double force = m->contacts[j].tangent[i] * T[k] + m->contacts[j].normal[i] * N[k];
        left[i][k] += force;
        scale = fmax(scale, fabs(force));
      }
  }
  for (int l = 0; l < m->n_loads; ++l)
    for (int i = 0; i < m->n; ++i) {
      const int h = m->loads[l].harmonic;
      left[i][h ? 2 * h - 1 : 0] -= m->loads[l].cosine[i];
      if (h) left[i][2 * h] -= m->loads[l].sine[i];
      scale = fmax(scale, fabs(m->loads[l].cosine[i]));
    }
  for (int i = 0; i < m->n; ++i) worst = larger(worst, norm_max(2 * f->n_harm + 1, left[i]));
  return worst / scale;
}
