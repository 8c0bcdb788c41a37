/* curve.h - a response curve as it is drawn: shared by the figures of frf, compare and transient. */
#pragma once

#include "interfaces/command/plot/figure.h"

typedef struct curve_point {
  double omega, amplitude; /* [rad/time], [length] */
  int stable;              /* +1, -1, 0 unknown */
  int part;                /* of the curve: points of two parts are not joined */
} curve_point;

typedef struct curve_shape {
  char of[RESPONSE_NAME];   /* the response in words; "x" of an oscillator */
  int among;                /* of several on the same axes which one, from 1; 0: it is the only one */
  const char *stable_title; /* its stable parts in the legend; NULL: harmonic balance's */
  int n;
  curve_point *points; /* [n] along the curve */
  int n_special;
  hbm_special *special;   /* [n_special] */
  int harmonics, samples; /* in use */
  double low, high;       /* [rad/time] the sweep */
} curve_shape;

/* Response r in words that a label can say; "x" of an oscillator. */
void curve_response_name(const scene *sc, int r, char text[RESPONSE_NAME]);

/* The shape of a curve that was computed, by the model's first response. */
hc_status curve_shape_of(const scene *sc, hbm_solver *s, const hbm_curve *curve, curve_shape *out);
/* The same curve, of which `first` is the shape, by response r. */
hc_status curve_shape_response(const curve_shape *first, const scene *sc, hbm_solver *s, const hbm_curve *curve, int r,
                               curve_shape *out);
/* Computes the curve over the sweep, widened to `asked`, as far as it goes. HC_OK, HC_NO_MEMORY. */
hc_status curve_shape_trace(const scene *sc, const number_list *asked, curve_shape *out);
void curve_shape_clear(curve_shape *c);

/* figure_open for a drawing over frequency: in cycles per time where the scene's sweep is. */
hc_status curve_figure_open(figure *g, plot_order *p, const scene *sc, int width, int height);

/* First its data blocks, then its items in the plot command; among several each has a colour, and its name in the key.
 * quiet: thin, grey, without special points: the background of something else. */
void curve_shape_data(figure *g, const curve_shape *c);
void curve_shape_items(figure *g, const curve_shape *c, bool quiet);
/* After the last items of several curves c[n]: what the dashes mean, in the key, and all special points. */
void curve_shapes_rest(figure *g, int n, const curve_shape *c);
/* The label of the axis of frequencies. */
void curve_x_label(figure *g, const scene *sc);
/* Axes and ranges of amplitude over omega; the label names the response where it is the only one. */
void curve_shape_axes(figure *g, const scene *sc, const curve_shape *c);
/* The part of the sweep and of the amplitudes that holds all special points, to be drawn beside the whole. */
typedef struct curve_window {
  double low, high;   /* [rad/time] */
  double least, most; /* [length] amplitudes */
} curve_window;
/* False: there are no special points, or their part is not small against the sweep. */
bool curve_shape_window(const curve_shape *c, curve_window *out);
/* "H = 10, exact forces" */
const char *curve_shape_settings(const scene *sc, const curve_shape *c, char text[96]);
