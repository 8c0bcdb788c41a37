/* figure.h - a gnuplot script as it is written: the terminal, texts, series of points and their looks. Every text that
 * comes from outside goes through figure_text, which writes what gnuplot or its markup could act on as octal escapes: a
 * title can neither end its string nor run anything. A write that failed is reported by figure_close.
 *
 *     figure_series, figure_point ..., figure_series_end    for each: its data go into the script, and it into the plot
 *     figure_draw                                           the plot of all of them, with what is set by then */
#pragma once

#include <stdbool.h>
#include <stdio.h>

#include "interfaces/command/plot/plot.h"

typedef struct figure {
  plot_order *order;
  bool letters; /* drawn with letters, in the terminal */
  FILE *to;     /* the script so far */
  char *script;
  size_t length;
  FILE *plot; /* the items of the plot command */
  char *items;
  size_t items_length;
  bool drawn;                /* they were: the next item is the first of another plot */
  int blocks, points;        /* data blocks written; points of the last one */
  long before;               /* in `plot`: where the item of that one begins */
  char look[96], words[512]; /* what figure_look and figure_words made last */
  double x_unit;             /* figure_point divides x by it; 1 from figure_open on */
} figure;

/* A drawing of about width x height points of 1/90 inch. */
hc_status figure_open(figure *g, plot_order *p, int width, int height);
/* With st = HC_OK draws it to order->path; otherwise returns st. Frees the figure in any case. */
hc_status figure_close(figure *g, hc_status st);

/* Append to the script. */
void figure_script(figure *g, const char *format, ...) __attribute__((format(printf, 2, 3)));
/* Append a text as a quoted string, escaped. */
void figure_text(figure *g, const char *format, ...) __attribute__((format(printf, 2, 3)));
/* "set COMMAND TEXT" */
void figure_set(figure *g, const char *command, const char *format, ...) __attribute__((format(printf, 3, 4)));
/* The label of the x axis, with a space between it and the legend. */
void figure_below(figure *g, const char *format, ...) __attribute__((format(printf, 2, 3)));
/* Title and, smaller and below it, what is drawn. `command` is "set title", or "set multiplot ... title". */
void figure_title(figure *g, const char *command, const char *title, const char *about);

/* A series of points, drawn "lines", "points", "linespoints", "steps", or as columns and style say ("1:2:(0):3 with
 * vectors"); title NULL: not in the key. */
void figure_series(figure *g, const char *how, const char *look, const char *title);
/* A point (x / x_unit, y) of it, only where both are numbers; a gap interrupts a line. */
void figure_point(figure *g, double x, double y);
void figure_gap(figure *g);
/* A point with a third column, such as the height of an arrow. */
void figure_arrow(figure *g, double x, double y, double height);
/* False: it had no point, and is not drawn. */
bool figure_series_end(figure *g);
/* One more item of the plot, without data: what = "0.5 with lines". */
void figure_item(figure *g, const char *look, const char *title, const char *what, ...)
    __attribute__((format(printf, 4, 5)));
/* Draws all since the last figure_draw; the same once more, if nothing came since. */
void figure_draw(figure *g);
/* For its title. */
const char *figure_words(figure *g, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* Looks: a given one (letters: line type n); line n; line and point n, told apart by dashes and shapes. */
const char *figure_look(figure *g, int n, const char *look, ...) __attribute__((format(printf, 3, 4)));
const char *figure_line(figure *g, int n, double width);
const char *figure_colour(int n);
const char *figure_mark(figure *g, int n, double width);

/* There is nothing to draw, and why: returns HC_BAD_INPUT. */
hc_status figure_refuse(plot_order *p, const char *why);

/* Logarithmic, with powers of ten as its labels. axis: "x" or "y" */
void figure_log(figure *g, const char *axis);

/* "force/length" -> "N/m", by the scene's labels, into text[64], which is returned. */
enum { FIGURE_UNIT = 64 };
const char *figure_unit(const scene *sc, const char *unit, char text[FIGURE_UNIT]);

/* Response r in words that a label can say; "x" of an oscillator. */
void figure_response_name(const scene *sc, int r, char text[RESPONSE_NAME]);

/* A point of a series of cells, which figure_heat draws in the place of figure_draw; characters of its number. */
int figure_cell(figure *g, int column, int row, double value);
/* The cells, low <= value <= high; numbered: each with its number. Axes and tics are the caller's. */
void figure_heat(figure *g, const char *label, bool logarithmic, double low, double high, bool numbered);

/* Where point i of `rows` is drawn: the name of its verdict, perhaps in text; NULL: it has none. */
typedef const char *verdict_point(const void *rows, int i, double *x, double *y, char text[24]);
/* n points, a series for each verdict in order of appearance, in the key as "OF: match (12)". */
void figure_verdicts(figure *g, const char *of, int n, const void *rows, verdict_point *at);

/* Several plots in one drawing, row by row; in a drawing of letters one below the other. */
void panels_begin(figure *g, int rows, int columns, const char *title, const char *about);
void panels_end(figure *g);

/* Heat map over N x H, error over N, error over H: three panels. */
void panels_accuracy(figure *g, const accuracy *a);
