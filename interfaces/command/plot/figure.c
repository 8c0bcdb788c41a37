/* figure.c - see figure.h. */
#include "interfaces/command/plot/figure.h"

#include <ctype.h>
#include <errno.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include "compare/output/output.h"
#include "compare/output/progress.h"
#include "model/casefile/scene.h"
#include "numerics/base/utf8.h"

/* ---- gnuplot: a child process, without a shell; script and drawing are temporary files: no pipe can fill or break */

extern char **environ;

enum { WORDS = 400 };

/* Starts gnuplot on these streams, SIGPIPE as by default, without the user's settings. 0 or an errno. */
static int start_gnuplot(FILE *script, FILE *drawing, FILE *words, pid_t *pid)
{
  char name[] = "gnuplot", settings[] = "--default-settings", *argv[] = {name, settings, NULL};
  posix_spawn_file_actions_t streams;
  posix_spawnattr_t how;
  sigset_t pipe;
  sigemptyset(&pipe);
  sigaddset(&pipe, SIGPIPE);
  int bad = posix_spawn_file_actions_init(&streams);
  if (bad) return bad;
  bad = posix_spawnattr_init(&how);
  if (!bad) {
    bad = posix_spawnattr_setsigdefault(&how, &pipe);
    if (!bad) bad = posix_spawnattr_setflags(&how, POSIX_SPAWN_SETSIGDEF);
    if (!bad) bad = posix_spawn_file_actions_adddup2(&streams, fileno(script), STDIN_FILENO);
    if (!bad) bad = posix_spawn_file_actions_adddup2(&streams, fileno(drawing), STDOUT_FILENO);
    if (!bad) bad = posix_spawn_file_actions_adddup2(&streams, fileno(words), STDERR_FILENO);
    if (!bad) bad = posix_spawnp(pid, name, &streams, &how, argv, environ);
    posix_spawnattr_destroy(&how);
  }
  posix_spawn_file_actions_destroy(&streams);
  return bad;
}

static hc_status start_and_wait(FILE *script, FILE *drawing, FILE *words, char *why, size_t size)
{
  pid_t pid;
  int status, bad = start_gnuplot(script, drawing, words, &pid);
  if (bad == ENOENT) {
    snprintf(why, size, "gnuplot is not installed, or not in PATH: try apt install gnuplot-nox");
    return HC_IO;
  }
  if (bad) {
    snprintf(why, size, "gnuplot could not be started: %s", strerror(bad));
    return bad == ENOMEM ? HC_NO_MEMORY : HC_IO;
  }
  progress_child(pid);
  int gone;
  do gone = waitpid(pid, &status, 0);
  while (gone < 0 && errno == EINTR);
  progress_child(0);
  if (gone < 0) {
    snprintf(why, size, "gnuplot: %s", strerror(errno));
    return HC_IO;
  }
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0 && lseek(fileno(drawing), 0, SEEK_END) > 0) return HC_OK;
  /* How gnuplot ended and what it wrote to stderr, in one line. */
  char text[WORDS];
  message m;
  message_start(&m, why, size);
  rewind(words);
  size_t n = fread(text, 1, sizeof text, words), begin = 0;
  for (size_t i = 0; i < n; ++i)
    if (text[i] == '\n' || text[i] == '\t') text[i] = ' ';
  while (begin < n && text[begin] == ' ') ++begin;
  while (n > begin && text[n - 1] == ' ') --n;
  if (WIFSIGNALED(status)) message_add(&m, "gnuplot was ended by signal %d", WTERMSIG(status));
  else message_add(&m, "gnuplot failed (%d)", WEXITSTATUS(status));
  if (n > begin) message_add(&m, ": ");
  message_add_input(&m, text + begin, n - begin, WORDS);
  return HC_IO;
}

enum {
  MOST_TEXT = 512,
  PLAIN_WIDTH = 100,
  PLAIN_HEIGHT = 32,
  LEAST_WIDTH = 40,
  LEAST_HEIGHT = 15,
  MOST_WIDTH = 240,
  LONG_TITLE = 90
};

static bool ends_in(const char *path, const char *ending)
{
  size_t n = strlen(path), k = strlen(ending);
  return n > k && !strcmp(path + n - k, ending);
}

bool plot_can(const char *path)
{
  return !strcmp(path, "-") || ends_in(path, ".svg") || ends_in(path, ".png") || ends_in(path, ".pdf");
}

/* ---- the terminal ---- */

hc_status figure_open(figure *g, plot_order *p, int width, int height)
{
  *g = (figure){.order = p, .letters = !strcmp(p->path, "-"), .x_unit = 1};
  snprintf(p->why, sizeof p->why, "%s", hc_status_text(HC_NO_MEMORY));
  g->to = open_memstream(&g->script, &g->length);
  g->plot = g->to ? open_memstream(&g->items, &g->items_length) : NULL;
  if (!g->plot) return HC_NO_MEMORY;
  p->why[0] = 0;
  const char *path = g->order->path;
  figure_script(g, "set encoding utf8\n");
  /* Two lines less high than the terminal, so that the prompt leaves all of it visible. */
  if (g->letters) {
    int down, across = output_columns(path, &down);
    down -= 2;
    if (across <= 0) across = PLAIN_WIDTH;
    across = across < LEAST_WIDTH ? LEAST_WIDTH : across > MOST_WIDTH ? MOST_WIDTH : across;
    if (down <= 0 || down > across / 2) down = across > 2 * PLAIN_HEIGHT ? PLAIN_HEIGHT : across / 2;
    figure_script(g, "set terminal dumb enhanced mono size %d,%d\n", across, down < LEAST_HEIGHT ? LEAST_HEIGHT : down);
  } else if (ends_in(path, ".svg"))
    figure_script(g, "set terminal svg enhanced size %d,%d font 'sans,13' background rgb 'white'\n", width, height);
  else if (ends_in(path, ".png"))
    figure_script(g,
                  "set terminal pngcairo enhanced size %d,%d font 'sans,10' fontscale 1.5 linewidth 1.5 pointscale 1.5 "
                  "background rgb 'white'\n",
                  3 * width / 2, 3 * height / 2);
  else
    figure_script(g, "set terminal pdfcairo enhanced size %.2fin,%.2fin font 'sans,10' background rgb 'white'\n",
                  width / 90.0, height / 90.0);
  figure_script(g, "set border lw 0.8\nset tics nomirror out\nset key noautotitle Left reverse samplen 3\n");
  if (!g->letters)
    figure_script(g, "set grid lw 0.7 lc rgb '#d5d5d5' dt 1\nset key outside below center horizontal width 1\n");
  return HC_OK;
}

/* ---- the drawing to its file ---- */

static hc_status copy_stream(FILE *drawing, FILE *to)
{
  char buffer[4096];
  rewind(drawing);
  for (size_t n; (n = fread(buffer, 1, sizeof buffer, drawing)) > 0;)
    if (fwrite(buffer, 1, n, to) != n) return HC_IO;
  return ferror(drawing) ? HC_IO : HC_OK;
}

static hc_status run_script(figure *g)
{
  FILE *drawing = tmpfile();
  if (!drawing) {
    snprintf(g->order->why, PLOT_WHY, "no temporary file: %s", strerror(errno));
    return HC_IO;
  }
  /* The script's output goes into `drawing`. HC_IO: why[size] says that gnuplot is missing, or has its words. */
  FILE *in = tmpfile(), *words = tmpfile();
  hc_status st = HC_IO;
  if (in && words && fwrite(g->script, 1, g->length, in) == g->length && fflush(in) == 0 &&
      lseek(fileno(in), 0, SEEK_SET) == 0)
    st = start_and_wait(in, drawing, words, g->order->why, PLOT_WHY);
  else snprintf(g->order->why, PLOT_WHY, "no temporary file: %s", strerror(errno));
  if (in) fclose(in);
  if (words) fclose(words);
  if (st == HC_OK) {
    output *out = NULL;
    plot_order *p = g->order;
    st = output_open(g->letters ? NULL : p->path, &out);
    if (st == HC_OK) st = output_finish(out, copy_stream(drawing, output_stream(out)));
    if (st != HC_OK)
      snprintf(p->why, sizeof p->why, "%s: %s", g->letters ? "standard output" : p->path,
               st == HC_IO && errno ? strerror(errno) : hc_status_text(st));
  }
  fclose(drawing);
  return st;
}

hc_status figure_close(figure *g, hc_status st)
{
  if (!g->to) return st; /* never opened: nothing to free, and the reason is the caller's */
  bool lost = ferror(g->to) || !g->plot || ferror(g->plot);
  lost |= fclose(g->to) != 0 || !g->script;
  if (g->plot) fclose(g->plot);
  if (st == HC_OK && lost) st = HC_NO_MEMORY;
  if (st == HC_OK) st = run_script(g);
  if (st != HC_OK && !g->order->why[0]) snprintf(g->order->why, PLOT_WHY, "%s", hc_status_text(st));
  free(g->script);
  free(g->items);
  return st;
}

/* ---- script and texts ---- */

void figure_script(figure *g, const char *format, ...)
{
  va_list args;
  va_start(args, format);
  vfprintf(g->to, format, args);
  va_end(args);
}

/* Inside double quotes: plain characters as they are, gnuplot's markup behind a backslash, all else octal. */
static void write_escaped(FILE *to, const char *text)
{
  char *clean = utf8_clean(text, true);
  for (const char *c = clean ? clean : ""; *c; ++c) {
    unsigned char u = (unsigned char)*c;
    if (strchr("^_{}@&~\\", u)) fprintf(to, "\\134\\%03o", u);
    else if (u >= 0x80 || isalnum(u) || strchr(" .,:;()+-/=<>|*?#", u)) fputc(u, to);
    else fprintf(to, "\\%03o", u);
  }
  free(clean);
}

static void write_quoted(FILE *to, const char *format, va_list args)
{
  char text[MOST_TEXT];
  vsnprintf(text, sizeof text, format, args);
  fputc('"', to);
  write_escaped(to, text);
  fputc('"', to);
}

void figure_text(figure *g, const char *format, ...)
{
  va_list args;
  va_start(args, format);
  write_quoted(g->to, format, args);
  va_end(args);
}

void figure_set(figure *g, const char *command, const char *format, ...)
{
  va_list args;
  va_start(args, format);
  fprintf(g->to, "set %s ", command);
  write_quoted(g->to, format, args);
  fputc('\n', g->to);
  va_end(args);
}

void figure_below(figure *g, const char *format, ...)
{
  char text[MOST_TEXT];
  va_list args;
  va_start(args, format);
  vsnprintf(text, sizeof text, format, args);
  va_end(args);
  figure_script(g, "set xlabel \"");
  write_escaped(g->to, text);
  figure_script(g, g->letters ? "\"\n" : "\\n{/*0.4  }\"\n");
}

void figure_title(figure *g, const char *command, const char *title, const char *about)
{
  bool small = !g->letters && utf8_width(title) > LONG_TITLE;
  figure_script(g, "%s \"%s", command, small ? "{/*0.75 " : "");
  write_escaped(g->to, title);
  figure_script(g, "%s", small ? "}" : "");
  figure_script(g, g->letters ? "\\n" : "\\n{/*0.85 ");
  write_escaped(g->to, about);
  figure_script(g, g->letters ? "\"\n" : "}\"\n");
}

/* ---- series ---- */

/* Before the next item of the plot: "plot ", or what separates two. */
static void begin_item(figure *g)
{
  if (g->drawn) rewind(g->plot);
  g->drawn = false;
  g->before = ftell(g->plot);
  fputs(g->before > 0 ? ", \\\n  " : "plot ", g->plot);
}

static void write_look(figure *g, const char *look, const char *title)
{
  fprintf(g->plot, " %s %s", look, title ? "title \"" : "notitle");
  if (title) write_escaped(g->plot, title), fputc('"', g->plot);
}

void figure_series(figure *g, const char *how, const char *look, const char *title)
{
  begin_item(g);
  fprintf(g->plot, "$d%d using %s%s", ++g->blocks, strchr(how, ':') ? "" : "1:2 with ", how);
  write_look(g, look, title);
  g->points = 0;
  figure_script(g, "$d%d << EOD\n", g->blocks);
}

void figure_point(figure *g, double x, double y)
{
  if (!isfinite(x) || !isfinite(y)) return;
  figure_script(g, "%.10g %.10g\n", x / g->x_unit, y);
  ++g->points;
}

void figure_arrow(figure *g, double x, double y, double height)
{
  figure_script(g, "%.10g %.10g %.10g\n", x / g->x_unit, y, height);
  ++g->points;
}

void figure_gap(figure *g) { figure_script(g, "\n"); }

bool figure_series_end(figure *g)
{
  figure_script(g, "EOD\n");
  if (g->points == 0) fseek(g->plot, g->before, SEEK_SET);
  return g->points > 0;
}

void figure_item(figure *g, const char *look, const char *title, const char *what, ...)
{
  va_list args;
  begin_item(g);
  va_start(args, what);
  vfprintf(g->plot, what, args);
  va_end(args);
  write_look(g, look, title);
}

void figure_draw(figure *g)
{
  fflush(g->plot);
  if (g->items) figure_script(g, "%.*s\n", (int)g->items_length, g->items);
  g->drawn = true;
}

const char *figure_words(figure *g, const char *format, ...)
{
  va_list args;
  va_start(args, format);
  vsnprintf(g->words, sizeof g->words, format, args);
  va_end(args);
  return g->words;
}

hc_status figure_refuse(plot_order *p, const char *why)
{
  snprintf(p->why, sizeof p->why, "%s", why);
  return HC_BAD_INPUT;
}

/* ---- looks: Okabe and Ito's colours, dark before light ---- */

static const char *const colours[] = {"#0072B2", "#D55E00", "#000000", "#009E73",
                                      "#CC79A7", "#E69F00", "#56B4E9", "#777777"};
static const int dashes[] = {1, 2, 4, 5, 3}, shapes[] = {6, 5, 8, 13, 2, 11, 4, 7, 3, 12};
enum {
  N_COLOURS = sizeof colours / sizeof *colours,
  N_DASHES = sizeof dashes / sizeof *dashes,
  N_SHAPES = sizeof shapes / sizeof *shapes
};

const char *figure_look(figure *g, int n, const char *look, ...)
{
  va_list args;
  va_start(args, look);
  if (g->letters) snprintf(g->look, sizeof g->look, "lt %d", n + 1);
  else vsnprintf(g->look, sizeof g->look, look, args);
  va_end(args);
  return g->look;
}

const char *figure_colour(int n) { return colours[n % N_COLOURS]; }

const char *figure_line(figure *g, int n, double width)
{
  return figure_look(g, n, "lw %g dt %d lc rgb '%s'", width, dashes[n % N_DASHES], colours[n % N_COLOURS]);
}

const char *figure_mark(figure *g, int n, double width)
{
  figure_look(g, n, "lw %g dt %d lc rgb '%s' pt %d ps 0.9", width, dashes[n % N_DASHES], colours[n % N_COLOURS],
              shapes[n % N_SHAPES]);
  if (g->letters) snprintf(g->look, sizeof g->look, "lt %d pt %d", n + 1, n + 1);
  return g->look;
}

void figure_log(figure *g, const char *axis)
{
  figure_script(g, "set logscale %s\nset format %s '%s'\n", axis, axis, g->letters ? "%.0e" : "10^{%T}");
}

const char *figure_unit(const scene *sc, const char *unit, char text[FIGURE_UNIT])
{
  const struct {
    const char *word, *label;
  } words[] = {{"force", sc->unit_force}, {"length", sc->unit_length}, {"time", sc->unit_time}};
  size_t n = 0;
  text[0] = 0;
  while (*unit && n < FIGURE_UNIT - 17) {
    size_t skip = 1, w;
    for (w = 0; w < 3; ++w)
      if (!strncmp(unit, words[w].word, strlen(words[w].word))) break;
    if (w < 3) {
      n += (size_t)snprintf(text + n, FIGURE_UNIT - n, "%s", words[w].label);
      skip = strlen(words[w].word);
    } else {
      text[n++] = *unit;
      text[n] = 0;
    }
    unit += skip;
  }
  return text;
}

void figure_response_name(const scene *sc, int r, char text[RESPONSE_NAME])
{
  char name[RESPONSE_NAME];
  structure_response_name(sc->structure, r, name, sizeof name);
  const bool number = strspn(name, "0123456789") == strlen(name);
  if (number) snprintf(text, RESPONSE_NAME, "DOF %.*s", RESPONSE_NAME - 5, name);
  else snprintf(text, RESPONSE_NAME, "%s", name);
}

#define CELL_NUMBER "%.3g"

int figure_cell(figure *g, int column, int row, double value)
{
  figure_script(g, "%d %d %.8g\n", column, row, value);
  ++g->points;
  return snprintf(NULL, 0, CELL_NUMBER, value);
}

/* Small values are light; the palette darkens evenly, also in grey. Numbers on the darker half are white. */
void figure_heat(figure *g, const char *label, bool logarithmic, double low, double high, bool numbered)
{
  const int cells = g->blocks;
  if (!(high > low)) high = low + (low != 0 ? 0.1 * fabs(low) : 1); /* one value only */
  figure_script(g, "set palette defined (0 '#fdf6e3', 0.35 '#f0a860', 0.7 '#a8325a', 1 '#2a0a4a')\nset cblabel ");
  figure_text(g, "%s", label);
  figure_script(g, "\nunset key\nunset grid\nset tics scale 0\nset autoscale noextend\n%s",
                logarithmic ? "set logscale cb\nset format cb '10^{%T}'\n" : "");
  figure_script(g, "low = %.10g\nhigh = %.10g\n", low, high);
  figure_script(g, "set cbrange [low:high]\nfraction(v) = %s\n",
                logarithmic ? "log(v/low)/log(high/low)" : "(v - low)/(high - low)");
  figure_script(g,
                "half = 0.5\nplot $d%d using 1:2:($1-half):($1+half):($2-half):($2+half):3 with boxxyerror "
                "fill solid noborder lc palette",
                cells);
  for (int dark = 0; dark < 2 && numbered; ++dark)
    figure_script(g,
                  ", \\\n  $d%d using (fraction($3) < 0.5 ? %s):2:(sprintf('%s', $3)) with labels "
                  "tc rgb '%s'",
                  cells, dark ? "NaN : $1" : "$1 : NaN", CELL_NUMBER, dark ? "white" : "black");
  figure_script(g, "\n");
  g->drawn = true;
}

/* ---- points by verdict ---- */

/* Open shapes where both sides agree, filled ones and crosses where not; all can be told apart without colour. */
static const struct verdict_look {
  const char *name, *look;
} verdict_looks[] = {
    {"match", "pt 6 ps 1.2 lw 1.6 lc rgb '#D55E00'"},
    {"family", "pt 7 ps 0.9 lc rgb '#D55E00'"},
    {"settled", "pt 6 ps 1.2 lw 1.6 lc rgb '#D55E00'"},
    {"differs", "pt 5 ps 1.0 lc rgb '#000000'"},
    {"other_branch", "pt 8 ps 1.2 lw 1.6 lc rgb '#009E73'"},
    {"unstable", "pt 2 ps 1.1 lw 1.8 lc rgb '#000000'"},
    {"aperiodic", "pt 3 ps 1.2 lw 1.4 lc rgb '#CC79A7'"},
    {"not_settled", "pt 1 ps 1.2 lw 1.8 lc rgb '#E69F00'"},
    {"solver_failed", "pt 10 ps 1.2 lw 1.6 lc rgb '#555555'"},
    {"unbounded", "pt 9 ps 1.2 lw 1.6 lc rgb '#D55E00'"},
    {"creeps", "pt 4 ps 1.1 lw 1.6 lc rgb '#0072B2'"},
    {"undecided", "pt 14 ps 1.2 lw 1.6 lc rgb '#555555'"},
    {"skipped", "pt 7 ps 0.4 lc rgb '#999999'"},
    {"period_k", "pt 12 ps 1.3 lw 1.6 lc rgb '#CC79A7'"},
};
enum { N_VERDICT_LOOKS = sizeof verdict_looks / sizeof *verdict_looks };

enum { VERDICTS_MOST = 16 };
typedef struct verdicts {
  int n, count[VERDICTS_MOST];
  char name[VERDICTS_MOST][24];
} verdicts;

/* The place of a verdict, a new one if there is room. */
static int verdict_place(verdicts *v, const char *name)
{
  int i = 0;
  while (i < v->n && strcmp(v->name[i], name)) ++i;
  if (i == v->n && v->n < VERDICTS_MOST) snprintf(v->name[v->n++], sizeof v->name[0], "%s", name);
  return i < VERDICTS_MOST ? i : VERDICTS_MOST - 1;
}

void figure_verdicts(figure *g, const char *of, int n, const void *rows, verdict_point *at)
{
  double x, y;
  char text[24];
  verdicts v = {0};
  for (int i = 0; i < n; ++i) {
    const char *name = at(rows, i, &x, &y, text);
    if (name) ++v.count[verdict_place(&v, name)];
  }
  for (int k = 0; k < v.n; ++k) {
    int look = 0;
    while (look < N_VERDICT_LOOKS - 1 && strcmp(verdict_looks[look].name, v.name[k])) ++look; /* last: period_2, ... */
    figure_series(g, "points", figure_look(g, 10 + look, "%s", verdict_looks[look].look),
                  figure_words(g, "%s: %s (%d)", of, v.name[k], v.count[k]));
    for (int i = 0; i < n; ++i) {
      const char *name = at(rows, i, &x, &y, text);
      if (name && verdict_place(&v, name) == k) figure_point(g, x, y);
    }
    figure_series_end(g);
  }
}
