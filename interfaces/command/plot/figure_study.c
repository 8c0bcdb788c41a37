/* figure_study.c - a study's results: a measure over the axis that is a scale, a line for each value of the other
 * axes, or a heat map. Proof: tests/command/plot/plots.transcript. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "interfaces/command/plot/figure.h"
#include "numerics/base/number.h"
#include "numerics/base/utf8.h"

enum {
  MOST_LINES = 12,
  LEAST_HEAT = 4,
  TEXT = 160,
  /* of a heat map in the largest font of the terminals: characters across, with those of its rows' texts; rows */
  ACROSS = 92,
  DOWN = 24
};

typedef struct chart {
  const study *s;
  const char *measure;
  const char *response;     /* of a structure; NULL: the first */
  bool of_rows;             /* the largest of a column of rows */
  double *value;            /* [n_scenes] NaN: none */
  int x;                    /* axis along the drawing; -1: nothing varies */
  const study_field *scale; /* its field that is a scale, or NULL: its values stand side by side */
  int heat;                 /* the other axis of a heat map, or -1 */
  long lines, drawn;        /* combinations of the other axes; as many of them as are drawn */
} chart;

/* ---- the measure ---- */

static bool is_number_column(rows_kind kind, unsigned extra, const char *name)
{
  table_column columns[ROWS_MOST];
  const int n = rows_columns(kind, extra, columns);
  for (int i = 0; i < n; ++i)
    if (!strcmp(columns[i].name, name)) return columns[i].kind != TABLE_TEXT;
  return false;
}

static void name_columns(plot_order *p, rows_kind kind, unsigned extra)
{
  table_column columns[ROWS_MOST];
  const int n = rows_columns(kind, extra, columns);
  for (int i = 0; i < n; ++i) {
    size_t used = strlen(p->why);
    if (columns[i].kind != TABLE_TEXT && used + 48 < sizeof p->why)
      snprintf(p->why + used, sizeof p->why - used, ", %s", columns[i].name);
  }
}

static hc_status choose_measure(plot_order *p, const char *asked, chart *c)
{
  bool curve = c->s->kind != STUDY_TRANSIENT;
  c->measure = asked                         ? asked
               : curve && !c->response       ? "peak_amplitude"
               : c->s->kind == STUDY_COMPARE ? "hbm_amplitude"
                                             : "amplitude";
  if (c->response && is_number_column(ROWS_CURVE, study_extra_columns(c->s), c->measure)) {
    snprintf(p->why, sizeof p->why, "--plot-y: %s is of the first response; with --response expected a column of rows",
             c->measure);
    name_columns(p, study_rows(c->s), study_extra_columns(c->s));
    return HC_BAD_INPUT;
  }
  if (!strcmp(c->measure, "seconds") || (curve && is_number_column(ROWS_CURVE, study_extra_columns(c->s), c->measure)))
    return HC_OK;
  c->of_rows = is_number_column(study_rows(c->s), study_extra_columns(c->s), c->measure);
  if (c->of_rows) return HC_OK;
  snprintf(p->why, sizeof p->why, "--plot-y: '%.40s' is no measure of this study; expected seconds",
           asked ? asked : "");
  if (curve) name_columns(p, ROWS_CURVE, study_extra_columns(c->s));
  name_columns(p, study_rows(c->s), study_extra_columns(c->s));
  return HC_BAD_INPUT;
}

/* c->measure was found among our own column names: the query holds no text of the user's. */
static hc_status read_values(plot_order *p, study_store *store, chart *c)
{
  sqlite3 *db = study_store_readonly(store);
  sqlite3_stmt *query = NULL;
  char sql[320];
  static const char first_response[] =
      "WHERE response = (SELECT response FROM \"row\" AS first WHERE first.scene = \"row\".scene "
      "AND first.number = 0) ";
  const bool responses = study_extra_columns(c->s) & ROWS_RESPONSES;
  if (c->of_rows)
    snprintf(sql, sizeof sql, "SELECT scene, max(\"%s\") FROM \"row\" %sGROUP BY scene", c->measure,
             c->response ? "WHERE response = ?1 "
             : responses ? first_response
                         : "");
  else snprintf(sql, sizeof sql, "SELECT id, \"%s\" FROM scene", c->measure);
  c->value = calloc((size_t)c->s->n_scenes, sizeof *c->value);
  if (!c->value) return HC_NO_MEMORY;
  for (long i = 0; i < c->s->n_scenes; ++i) c->value[i] = NAN;
  int code = sqlite3_prepare_v2(db, sql, -1, &query, NULL);
  if (code == SQLITE_OK && c->of_rows && c->response)
    code = sqlite3_bind_text(query, 1, c->response, -1, SQLITE_STATIC);
  while (code == SQLITE_OK || code == SQLITE_ROW) {
    code = sqlite3_step(query);
    if (code != SQLITE_ROW || sqlite3_column_type(query, 1) == SQLITE_NULL) continue;
    long id = (long)sqlite3_column_int64(query, 0);
    if (id >= 0 && id < c->s->n_scenes) c->value[id] = sqlite3_column_double(query, 1);
  }
  if (code != SQLITE_DONE) snprintf(p->why, sizeof p->why, "the study's results: %s", sqlite3_errmsg(db));
  sqlite3_finalize(query);
  return code == SQLITE_DONE ? HC_OK : HC_IO;
}

/* ---- the axes ---- */

static bool number_of(const study_field *f, int i, double *out)
{
  return number_read(f->values[i].text, strlen(f->values[i].text), out) == NUMBER_FINE;
}

/* A field of the axis whose values are numbers, all rising or all falling. */
static const study_field *scale_of(const study_axis *a)
{
  for (int k = 0; k < a->n_fields; ++k) {
    double before, now;
    int rising = 0, falling = 0, i = 1;
    if (a->n < 2 || !number_of(&a->fields[k], 0, &before)) continue;
    for (; i < a->n && number_of(&a->fields[k], i, &now); ++i, before = now) {
      rising += now > before;
      falling += now < before;
    }
    if (i == a->n && (rising == a->n - 1 || falling == a->n - 1)) return &a->fields[k];
  }
  return NULL;
}

/* c->x: the first axis with a scale of three or more values, else with any scale, else that varies. */
static void choose_axes(chart *c)
{
  const study *s = c->s;
  int plain = -1, varying = 0, heat[2] = {-1, -1};
  c->x = c->heat = -1;
  for (int i = s->n_axes - 1; i >= 0; --i)
    if (s->axes[i].n > 1) {
      plain = i;
      heat[varying++ > 0] = i;
    }
  for (int least = 3; least >= 2 && c->x < 0; --least)
    for (int i = 0; i < s->n_axes && c->x < 0; ++i)
      if (s->axes[i].n >= least && scale_of(&s->axes[i])) c->x = i;
  if (c->x < 0) c->x = plain;
  if (c->x < 0) return;
  c->scale = scale_of(&s->axes[c->x]);
  c->lines = s->n_scenes / s->axes[c->x].n;
  c->drawn = c->lines < MOST_LINES ? c->lines : MOST_LINES;
  if (varying == 2 && s->axes[heat[0]].n >= LEAST_HEAT && s->axes[heat[1]].n >= LEAST_HEAT)
    c->heat = heat[0] == c->x ? heat[1] : heat[0];
}

static bool is_log_axis(const study_field *f, int n)
{
  double v = 0, before = 0, ratio = 1, low = INFINITY, high = -INFINITY;
  bool even = n >= 3;
  for (int i = 0; i < n; ++i, before = v) {
    number_of(f, i, &v);
    low = fmin(low, v);
    high = fmax(high, v);
    if (i == 1) ratio = v / before;
    if (i >= 2) even &= fabs(v / before / ratio - 1) < 1e-6;
  }
  return low > 0 && (even ? high > 3 * low : high >= 100 * low);
}

static bool is_log_measure(const chart *c, double *low, double *high)
{
  *low = INFINITY;
  *high = -INFINITY;
  for (long i = 0; i < c->s->n_scenes; ++i) {
    if (!isfinite(c->value[i])) continue;
    *low = fmin(*low, c->value[i]);
    *high = fmax(*high, c->value[i]);
  }
  return *low > 0 && *high >= 100 * *low;
}

/* ---- labels ---- */

static const char *measure_unit(const chart *c, char unit[FIGURE_UNIT])
{
  static const struct {
    const char *measures, *unit; /* each between blanks */
  } units[] = {
      {" amplitude peak_amplitude hbm_amplitude transient_amplitude orbit_amplitude max min rms mean harmonic_1 "
       "peak_harmonic_1 hbm_harmonic_1 transient_harmonic_1 ",
       "length"},
      {" omega peak_omega ", "rad/time"},
      {" frequency peak_frequency ", "cycles/time"},
      {" seconds ", "s"}};
  char name[TEXT];
  snprintf(name, sizeof name, " %s ", c->measure);
  for (int i = 0; i < 4; ++i)
    if (strstr(units[i].measures, name)) return figure_unit(&c->s->base, units[i].unit, unit);
  return "1";
}

static void measure_label(const chart *c, char text[TEXT])
{
  char unit[FIGURE_UNIT];
  snprintf(text, TEXT, "%s%s%s%s [%s]", c->of_rows ? "largest " : "", c->measure, c->response ? " of " : "",
           c->response ? c->response : "", measure_unit(c, unit));
}

static bool varies(const study_axis *a, const study_field *f)
{
  for (int i = 1; i < a->n; ++i)
    if (strcmp(f->values[i].text, f->values[0].text) != 0) return true;
  return false;
}

/* Value i of a field as it was given; a long number with four digits, and as many as tell it from its neighbour. */
static const char *short_value(const study_axis *a, const study_field *f, int i, char text[TEXT])
{
  enum { LONG = 8, LEAST = 4, MOST = 15 };
  double v, beside;
  snprintf(text, TEXT, "%s", f->values[i].text);
  if (strlen(text) <= LONG || !number_of(f, i, &v)) return text;
  if (a->n < 2 || !number_of(f, i > 0 ? i - 1 : 1, &beside) || beside == v) beside = 0;
  const double digits = 1 + ceil(log10(fabs(v) / fabs(v - beside))); /* the last one is a tenth of the step */
  snprintf(text, TEXT, "%.*g", digits > LEAST ? digits < MOST ? (int)digits : MOST : LEAST, v);
  return text;
}

/* "false, sampled": value i of the fields of an axis that vary; with i < 0 their names. */
static void join_fields(const study_axis *a, int i, char text[TEXT])
{
  char value[TEXT];
  size_t used = 0;
  text[0] = 0;
  for (int k = 0; k < a->n_fields && used < TEXT - 1; ++k)
    if (varies(a, &a->fields[k]))
      used += (size_t)snprintf(text + used, TEXT - used, "%s%s", used ? ", " : "",
                               i < 0 ? a->fields[k].path : short_value(a, &a->fields[k], i, value));
}

/* "hbm.samples [1]" or the names of the fields that vary of an axis without a scale. */
static const char *axis_text(const study *s, const study_axis *a, const study_field *scale, char text[TEXT])
{
  char unit[FIGURE_UNIT];
  if (scale) snprintf(text, TEXT, "%s [%s]", scale->path, figure_unit(&s->base, scale->f->unit, unit));
  else join_fields(a, -1, text);
  return text;
}

/* Value i of an axis: its scale's number, or those of its fields. */
static const char *value_text(const study_axis *a, const study_field *scale, int i, char text[TEXT])
{
  if (scale) short_value(a, scale, i, text);
  else join_fields(a, i, text);
  return text;
}

/* The last part of a field's path; all of it where another field in the legend ends alike. */
static const char *short_name(const chart *c, const study_field *f)
{
  const char *dot = strrchr(f->path, '.');
  for (int i = 0; i < c->s->n_axes && dot; ++i)
    for (int k = 0; k < c->s->axes[i].n_fields && i != c->x; ++k) {
      const study_field *other = &c->s->axes[i].fields[k];
      const char *end = strrchr(other->path, '.');
      if (other != f && end && !strcmp(dot, end) && varies(&c->s->axes[i], other)) return f->path;
    }
  return dot ? dot + 1 : f->path;
}

/* "gap = -1; static = false, force = sampled": what varies beside x, in that scene. */
static const char *line_text(const chart *c, long id, char text[TEXT])
{
  char value[TEXT];
  size_t n = 0;
  text[0] = 0;
  for (int i = 0; i < c->s->n_axes; ++i) {
    const study_axis *a = &c->s->axes[i];
    bool first = true;
    for (int k = 0; k < a->n_fields && n < TEXT - 1; ++k) {
      const study_field *f = &a->fields[k];
      if (i == c->x || !varies(a, f)) continue;
      n += (size_t)snprintf(text + n, TEXT - n, "%s%s = %s",
                            n == 0  ? ""
                            : first ? "; "
                                    : ", ",
                            short_name(c, f), short_value(a, f, study_index(c->s, id, i), value));
      first = false;
    }
  }
  return text;
}

/* ---- lines ---- */

/* Scenes of one line are those that differ in axis x only: its first scene, and how far apart the others are. */
static long stride_of(const chart *c)
{
  long stride = 1;
  for (int i = c->x + 1; i < c->s->n_axes; ++i) stride *= c->s->axes[i].n;
  return stride;
}

static long first_of_line(const chart *c, long line)
{
  long stride = stride_of(c);
  return line / stride * stride * c->s->axes[c->x].n + line % stride;
}

static void write_tics(figure *g, const char *command, const study_axis *a, const study_field *scale, int most)
{
  char text[TEXT];
  int every = a->n > most ? (a->n + most - 1) / most : 1;
  figure_script(g, "set %s (", command);
  for (int i = 0; i < a->n; i += every) {
    figure_script(g, "%s", i ? ", " : "");
    figure_text(g, "%s", value_text(a, scale, i, text));
    figure_script(g, " %d", i);
  }
  figure_script(g, ")\n");
}

/* Characters of an axis' longest text. */
static int longest_text(const study_axis *a, const study_field *scale)
{
  char text[TEXT];
  int longest = 0;
  for (int i = 0; i < a->n; ++i) {
    const int n = utf8_width(value_text(a, scale, i, text));
    if (n > longest) longest = n;
  }
  return longest;
}

static void draw_lines(figure *g, chart *c)
{
  const study_axis *a = &c->s->axes[c->x];
  char text[TEXT];
  for (long l = 0; l < c->drawn; ++l) {
    line_text(c, first_of_line(c, l), text);
    figure_series(g, "linespoints", figure_mark(g, (int)l, 1.6), text[0] ? text : c->measure);
    for (int i = 0; i < a->n; ++i) {
      double x = i, y = c->value[first_of_line(c, l) + i * stride_of(c)];
      if (c->scale) number_of(c->scale, i, &x);
      if (isfinite(y)) figure_point(g, x, y);
      else figure_gap(g); /* no line across a scene without a value */
    }
    figure_series_end(g);
  }
  measure_label(c, text);
  figure_set(g, "ylabel", "%s", text);
  figure_below(g, "%s", axis_text(c->s, a, c->scale, text));
  if (!c->scale) {
    write_tics(g, "xtics", a, NULL, 12);
    figure_script(g, "set xrange [-0.5:%g]\n", a->n - 0.5);
    /* the first one, of a slope, begins left of the axis */
    const int left = 4 * longest_text(a, NULL) / 5 - 40 / a->n, least = 10;
    if (a->n > 3) figure_script(g, "set xtics rotate by 20 right\nset lmargin %d\n", left > least ? left : least);
  } else if (is_log_axis(c->scale, a->n)) {
    double first = 1, last = 1;
    number_of(c->scale, 0, &first);
    number_of(c->scale, a->n - 1, &last);
    figure_script(g, "set logscale x\nset format x '%%g'\nset xrange [%.10g:%.10g]\n", fmin(first, last) / 1.15,
                  fmax(first, last) * 1.15);
    if (a->n <= 12) {
      figure_script(g, "set xtics (");
      for (int i = 0; i < a->n; ++i) figure_script(g, "%s%s", i ? ", " : "", value_text(a, c->scale, i, text));
      figure_script(g, ")\n");
    }
  }
  double low, high;
  if (is_log_measure(c, &low, &high)) figure_log(g, "y");
  figure_script(g, "set offsets graph 0.02, graph 0.02, 0, 0\n");
  figure_draw(g);
}

/* ---- heat map ---- */

static void draw_heat(figure *g, chart *c)
{
  const study_axis *ax = &c->s->axes[c->x], *ay = &c->s->axes[c->heat];
  const study_field *sy = scale_of(ay);
  double low, high;
  char text[TEXT];
  int longest = 0;
  figure_series(g, "points", "", NULL);
  for (long id = 0; id < c->s->n_scenes; ++id) {
    if (!isfinite(c->value[id])) continue;
    const int n = figure_cell(g, study_index(c->s, id, c->x), study_index(c->s, id, c->heat), c->value[id]);
    if (n > longest) longest = n;
  }
  figure_series_end(g);
  figure_below(g, "%s", axis_text(c->s, ax, c->scale, text));
  figure_set(g, "ylabel", "%s", axis_text(c->s, ay, sy, text));
  const int across = ACROSS - longest_text(ay, sy), texts = across / (longest_text(ax, c->scale) + 1);
  write_tics(g, "xtics", ax, c->scale, texts > 1 ? texts : 1);
  write_tics(g, "ytics", ay, sy, DOWN);
  figure_script(g, "set xrange [-0.5:%g]\nset yrange [-0.5:%g]\n", ax->n - 0.5, ay->n - 0.5);
  measure_label(c, text);
  bool logarithmic = is_log_measure(c, &low, &high);
  figure_heat(g, text, logarithmic, low, high, ax->n * (longest + 1) <= across && ay->n <= DOWN);
}

hc_status plot_study_check(plot_order *p, const study *s, const char *measure, const char *response)
{
  chart c = {.s = s, .response = response};
  return choose_measure(p, measure, &c);
}

hc_status plot_study(plot_order *p, const study *s, study_store *store, const char *measure, const char *response)
{
  figure g = {0};
  chart c = {.s = s, .response = response};
  char about[TEXT + 64];
  bool any = false;
  p->why[0] = 0;
  hc_status st = choose_measure(p, measure, &c);
  choose_axes(&c);
  if (st == HC_OK) st = read_values(p, store, &c);
  for (long i = 0; st == HC_OK && i < s->n_scenes; ++i) any |= isfinite(c.value[i]);
  if (st == HC_OK && (!any || c.x < 0)) {
    if (any) snprintf(p->why, sizeof p->why, "nothing varies in this study: there is no axis to draw along");
    else snprintf(p->why, sizeof p->why, "no scene has a %s to draw", c.measure);
    st = HC_BAD_INPUT;
  }
  bool heat = c.heat >= 0 && strcmp(p->path, "-") != 0; /* letters have no shades */
  if (st == HC_OK) st = figure_open(&g, p, 860, heat || c.drawn <= 4 ? 560 : 560 + 20 * (int)(c.drawn - 4));
  if (st == HC_OK) {
    snprintf(about, sizeof about, "%s", s->base.title);
    if (!heat && c.drawn < c.lines)
      snprintf(about, sizeof about, "%.100s; the first %ld of %ld lines", s->base.title, c.drawn, c.lines);
    figure_title(&g, "set title", s->title, about);
    if (heat) draw_heat(&g, &c);
    else draw_lines(&g, &c);
  }
  free(c.value);
  return figure_close(&g, st);
}
