/* plot.h - drawings of results, made by gnuplot as a process of its own: the way into this folder.
 *
 *     what was found -> figure_*.c write a script with its data (figure.h) -> gnuplot draws it (gnuplot.h) -> a
 *     file, whole or not at all
 *
 * The ending of the file's name says what it becomes; "-" is a drawing of letters on standard output. Solid, dashed
 * and dotted lines and shapes tell things apart, colours only help. Prints nothing but the drawing of letters.
 * Not here: what the numbers mean. */
#pragma once

#include "compare/accuracy/accuracy.h"
#include "compare/accuracy/bench.h"
#include "compare/comparison.h"
#include "compare/steady_states.h"
#include "compare/study/store.h"
#include "compare/survey.h"
#include "compare/verify/verify.h"
#include "hbm/forces/given_motion.h"
#include "hbm/hbm.h"

#define PLOT_ENDINGS ".svg, .png or .pdf"

enum { PLOT_WHY = 768 };

/* Where to draw, and why not. */
typedef struct plot_order {
  const char *path;   /* "curve.svg", or "-" */
  char why[PLOT_WHY]; /* when the answer is not HC_OK: what is wrong and what to do, one line */
} plot_order;

/* Does the name have an ending that can be drawn, or is it "-"? */
bool plot_can(const char *path);

/* Each returns HC_OK, HC_NO_MEMORY, HC_BAD_INPUT (nothing to draw) or HC_IO (no gnuplot, or not written). */

/* The responses of a model from `first` to `last`. */
typedef struct plot_responses {
  int first, last;
} plot_responses;

/* The curve, its stability and special points. `asked` (or NULL): marked. */
hc_status plot_frf(plot_order *p, const scene *sc, hbm_solver *s, const hbm_curve *curve, const hbm_curve *asked,
                   plot_responses of);

/* The same with the transients by verdict; a (or NULL): panels over samples and harmonics beside it. */
hc_status plot_compare(plot_order *p, const scene *sc, const comparison *c, const accuracy *a);

/* By the first response: at one frequency the motion, at several the amplitudes on the curve. */
hc_status plot_transient(plot_order *p, const scene *sc, const steady_states *found);

/* Which start goes where, and the motions that they come to, in the plane (x, v/omega) of one degree of freedom; a
 * panel for each of up to four frequencies. */
hc_status plot_survey(plot_order *p, const scene *sc, const survey *s);

/* Contacts under a given motion. */
typedef struct plot_motion {
  int first;              /* the first contact's number in the case */
  double slider[2];       /* [length] has been taken off u, or u_1 and u_2: u - w is what the law knows */
  const given_motion *of; /* with n_harm >= 1 */
} plot_motion;
/* Hysteresis loops T over u and the forces over the period; of one contact with two tangents the traction in the plane
 * with the limit of friction, and the ways of the motion and of the slider. */
hc_status plot_contact(plot_order *p, const scene *sc, const plot_motion *m);

/* A measure (a column of scenes, or the largest of a column of rows; NULL: the peak's amplitude, or the amplitude)
 * of a response (a structure's; NULL: the first)
 * over the first axis that is a scale, a line for each value of the others; a heat map for two axes of four values
 * and more. */
hc_status plot_study(plot_order *p, const study *s, study_store *store, const char *measure, const char *response);
/* Does the study (of a structure: that response) have the measure? HC_BAD_INPUT: p->why says which there are. */
hc_status plot_study_check(plot_order *p, const study *s, const char *measure, const char *response);

/* Error over time, a panel each frequency. */
hc_status plot_bench(plot_order *p, const scene *sc, const bench *b);

/* Another program's curve over ours, each point by its verdict; the report holds ours (verify_data.with_line). */
hc_status plot_verify(plot_order *p, const scene *sc, const verify_data *data, const verify_report *r);
