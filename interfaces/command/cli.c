/* cli.c - see cli.h. */
#include "interfaces/command/cli.h"

#include <errno.h>
#include <float.h>
#include <sys/stat.h>
#include <unistd.h>

#include "compare/advice.h"
#include "compare/no_steady_state.h"
#include "compare/output/output.h"
#include "compare/output/progress.h"
#include "compare/output/same_file.h"
#include "interfaces/command/call.h"
#include "model/casefile/structure.h"
#include "numerics/base/constants.h"
#include "numerics/base/nearest.h"

enum { KEY_SET = 0x100, KEY_FORMAT, KEY_WIDE };

static const struct argp_option common_options[] = {
    {"set", KEY_SET, "PATH=VALUE", 0,
     "Set a field of the case, e.g. hbm.harmonics=10 or contacts[0].gap=-1; may be repeated", 10},
    {"format", KEY_FORMAT, "table|csv|json", 0, "Form of the result [table]", 10},
    {"output", 'o', "FILE", 0, "Write the result to FILE, whole or not at all, instead of standard output", 10},
    {"wide", KEY_WIDE, NULL, 0, "Every column in the table [those that fit]", 10},
    {"quiet", 'q', NULL, 0, "No progress, no remarks", 10},
    {0},
};

/* ---- values of options ---- */

#define REFUSE(...) return snprintf(why, CASE_MESSAGE, __VA_ARGS__), false

/* A number that stands there twice is taken once, and said. */
static bool read_list(const cli_common *common, const char *option, const char *text, number_list *out, char *why)
{
  if (out->n > 0) REFUSE("--%s is given twice, expected one list like 5,7,9", option);
  for (const char *at = text;;) {
    size_t length = strcspn(at, ",");
    int same = 0;
    if (out->n == NUMBER_LIST_MAX) REFUSE("--%s takes at most %d numbers", option, NUMBER_LIST_MAX);
    if (number_read(at, length, &out->v[out->n]) != NUMBER_FINE || !(out->v[out->n] > 0))
      REFUSE("--%s: '%.*s' is not a positive number; expected a list like 5,7,9", option, (int)length, at);
    while (out->v[same] != out->v[out->n]) ++same;
    if (same == out->n) ++out->n;
    else cli_message(common, "--%s: %g stands there twice, taken once", option, out->v[same]);
    if (!at[length]) return true;
    at += length + 1;
  }
}

static bool read_integer(const cli_option *o, const char *text, int *value, char *why)
{
  if (number_read_integer(text, strlen(text), value) != NUMBER_FINE || *value < o->low || *value > o->high)
    REFUSE("--%s: '%s' is not an integer %d..%d", o->name, text, o->low, o->high);
  return true;
}

static bool read_format(const char *option, const char *text, bool table_too, table_format *out, char *why)
{
  static const char *const formats[] = {"table", "csv", "json", NULL};
  if (table_too && !strcmp(text, "table")) *out = FORMAT_TABLE;
  else if (!strcmp(text, "csv")) *out = FORMAT_CSV;
  else if (!strcmp(text, "json")) *out = FORMAT_JSON;
  else
    REFUSE("--%s: '%s' is unknown; expected %scsv or json%s", option, text, table_too ? "table, " : "",
           nearest_hint(formats + !table_too, text, (char[NEAREST_HINT]){0}));
  return true;
}

/* What an option fills. */
static void *value_of(cli_common *common, const cli_option *o)
{
  return o->kind == CLI_PLOT ? (void *)&common->drawing.path : (char *)common->own + o->at;
}

bool cli_read_value(cli_common *common, const cli_option *o, const char *text, char why[CASE_MESSAGE])
{
  void *to = value_of(common, o);
  int count;
  switch (o->kind) {
  case CLI_FLAG: *(bool *)to = true; break;
  case CLI_PLOT:
    if (!plot_can(text))
      REFUSE("--plot: '%s' has an unknown ending; expected a name ending in " PLOT_ENDINGS ", or -", text);
    *(const char **)to = text;
    break;
  case CLI_TEXT: *(const char **)to = text; break;
  case CLI_TEXTS: {
    cli_texts *list = to;
    if (list->n == CLI_MOST_TEXTS) REFUSE("more than %d --%s", CLI_MOST_TEXTS, o->name);
    list->text[list->n++] = text;
    break;
  }
  case CLI_LIST: return read_list(common, o->name, text, to, why);
  case CLI_INTEGER: return read_integer(o, text, to, why);
  case CLI_COUNT:
    if (!read_integer(o, text, &count, why)) return false;
    *(long *)to = count;
    break;
  case CLI_POSITIVE:
    if (number_read(text, strlen(text), (double *)to) != NUMBER_FINE || !(*(double *)to > 0))
      REFUSE("--%s: '%s' is not a number > 0", o->name, text);
    break;
  case CLI_FORMAT: return read_format(o->name, text, false, to, why);
  }
  return true;
}

/* ---- the arguments of a command ---- */

/* What the parsers work on: argp's parser for the common options gets all of it, the command's own one gets `own`. */
typedef struct parse_input {
  cli_common *common;
  int max_arguments;
} parse_input;

/* The first key of a command's own options, which come in the order of their table. */
enum { OWN_KEY = 0x200 };
static int own_key(const cli_option *o, int i) { return o->letter ? o->letter : OWN_KEY + i; }

static error_t read_own_option(int key, char *text, struct argp_state *state)
{
  const parse_input *input = state->input;
  const cli_option *o = input->common->command->options;
  for (int i = 0; o && o->name && key != own_key(o, i); ++i) ++o;
  char why[CASE_MESSAGE];
  if (!o || !o->name) return ARGP_ERR_UNKNOWN;
  if (!cli_read_value(input->common, o, text, why)) argp_error(state, "%s", why);
  return 0;
}

static error_t read_common_option(int key, char *text, struct argp_state *state)
{
  parse_input *input = state->input;
  cli_common *common = input->common;
  char why[CASE_MESSAGE];
  switch (key) {
  case ARGP_KEY_INIT: state->child_inputs[0] = input; return 0;
  case ARGP_KEY_ARG:
    if (common->n_arguments == input->max_arguments) argp_error(state, "'%s' is one argument too many", text);
    common->arguments[common->n_arguments++] = text;
    return 0;
  case KEY_SET:
    if (common->n_set == CLI_MAX_SET) argp_error(state, "--set may be given at most %d times", CLI_MAX_SET);
    common->set[common->n_set++] = text;
    return 0;
  case KEY_FORMAT:
    if (!read_format("format", text, true, &common->format, why)) argp_error(state, "%s", why);
    return 0;
  case 'o': common->output = text; return 0;
  case KEY_WIDE: common->wide = true; return 0;
  case 'q': common->quiet = true; return 0;
  default: return ARGP_ERR_UNKNOWN;
  }
}

/* -o FILE, -qo FILE: is what comes next the value of these short options? */
static bool value_follows(const struct argp_option *all, const char *letters)
{
  for (; *letters; ++letters)
    for (const struct argp_option *o = all; o->name; ++o)
      if (o->key == *letters && o->arg) return !letters[1];
  return false;
}

/* "--tabels" ends the program with what was meant; what is near to nothing is left to argp. */
static void refuse_unknown_option(const cli_command *self, const struct argp_option *own, int argc, char **argv)
{
  static const struct argp_option by_argp[] = {
      {"help", '?', 0, 0, 0, 0}, {"usage", 0, 0, 0, 0, 0}, {"version", 'V', 0, 0, 0, 0}, {0}};
  const struct argp_option *const lists[] = {own, common_options, by_argp};
  struct argp_option all[2 * CLI_MOST_OPTIONS] = {{0}};
  for (int i = 0, n = 0; i < 3; ++i)
    for (const struct argp_option *o = lists[i]; o->name; ++o) all[n++] = *o;
  for (int i = 1; i < argc && strcmp(argv[i], "--") != 0; ++i) {
    if (argv[i][0] != '-') continue;
    if (argv[i][1] != '-') {
      i += value_follows(all, argv[i] + 1);
      continue;
    }
    const char *name = argv[i] + 2, *meant = NULL;
    const size_t length = strcspn(name, "=");
    const struct argp_option *known = all; /* what name[length] is or begins, for getopt takes both; or the last, {0} */
    while (known->name && strncmp(known->name, name, length)) ++known;
    int least = NEAREST_FAR;
    i += known->arg && !name[length];
    for (const struct argp_option *o = all; o->name && !known->name; ++o) {
      const int d = nearest_distance(name, length, o->name);
      if (d < least) meant = o->name, least = d;
    }
    if (!meant) continue;
    fprintf(stderr, "hbmcheck %s: unrecognized option '--%.*s', did you mean '--%s'?\nTry 'hbmcheck %s --help'.\n",
            self->name, (int)length, name, meant, self->name);
    exit(EXIT_USAGE);
  }
}

/* The arguments into *common and its own struct. Does not return on --help, --version or wrong usage. */
static void parse(const cli_command *self, int argc, char **argv, cli_common *common)
{
  struct argp_option options[CLI_MOST_OPTIONS + 1] = {{0}};
  for (int i = 0; self->options && self->options[i].name; ++i) {
    const cli_option *o = &self->options[i];
    options[i] = (struct argp_option){o->name, own_key(o, i), o->argument, 0, o->help, o->group ? o->group : 1};
  }
  const struct argp own_argp = {options, read_own_option, NULL, NULL, NULL, NULL, NULL};
  const struct argp_child children[] = {{&own_argp, 0, NULL, 0}, {0}};
  const struct argp argp = {common_options, read_common_option, self->arguments, self->help, children, NULL, NULL};
  const bool several = strstr(self->arguments, "...") != NULL;
  const bool required = *self->arguments && *self->arguments != '[';
  parse_input input = {common, several ? CLI_MAX_ARGUMENTS : *self->arguments ? 1 : 0};
  char name[64];
  snprintf(name, sizeof name, "hbmcheck %s", self->name);
  refuse_unknown_option(self, options, argc, argv);
  argv[0] = name;
  argp_err_exit_status = EXIT_USAGE;
  error_t failed = argp_parse(&argp, argc, argv, 0, NULL, &input); /* wrong usage exits: what is left is ENOMEM */
  argv[0] = (char *)"hbmcheck";
  if (failed == ENOMEM) exit(cli_failed(common, EXIT_NO_SOLUTION, "%s", hc_status_text(HC_NO_MEMORY)));
  if (failed) exit(cli_failed(common, EXIT_BUG, "%s", strerror(failed)));
  if (required && common->n_arguments == 0)
    exit(cli_failed(common, EXIT_USAGE, "no %.*s given\nTry 'hbmcheck %s --help'.", (int)strcspn(self->arguments, "."),
                    self->arguments, self->name));
  /* --plot - may not mix with csv, json or an export on standard output. */
  bool exporting = false;
  for (const cli_option *o = common->command->options; o && o->name; ++o)
    if (o->kind == CLI_FORMAT) exporting |= *(const table_format *)value_of(common, o) != FORMAT_TABLE;
  const bool to_screen = common->drawing.path && !strcmp(common->drawing.path, "-");
  const bool screen = common->format == FORMAT_TABLE;
  if (!to_screen || common->output || (screen && !exporting)) return;
  cli_message(common, "--plot - would mix a drawing into %s; give one of them a file",
              screen ? "the export" : "csv or json");
  exit(EXIT_USAGE);
}

void *cli_own_options(const cli_command *self)
{
  void *own = calloc(1, self->own_size + 1);
  if (own && self->defaults) memcpy(own, self->defaults, self->own_size);
  return own;
}

int cli_run_parsed(cli_common *common)
{
  const cli_command *self = common->command;
  scene sc = {.structure = NULL};
  int code = self->starts_itself ? 0 : cli_check_files(common, 0, NULL);
  if (!code && !self->starts_itself && !strcmp(self->arguments, "CASE"))
    code = cli_load_case(common, common->arguments[0], &sc, &(case_error){{0}});
  if (!code) code = self->run(common, common->own, &sc);
  case_clear(&sc);
  return code;
}

int cli_run(const cli_command *self, int argc, char **argv)
{
  cli_common common = {.command = self};
  if (!strncmp(self->arguments, "CASE", 4)) common.argument_is = "the case file";
  if (!strncmp(self->arguments, "STUDY", 5)) common.argument_is = "the study";
  common.own = cli_own_options(self);
  if (!common.own) return cli_failed(&common, EXIT_NO_SOLUTION, "%s", hc_status_text(HC_NO_MEMORY));
  parse(self, argc, argv, &common);
  const int code = cli_run_parsed(&common);
  free(common.own);
  return code;
}

int cli_jobs(const cli_common *common) { return common->call ? 1 : cli_processors(); }

int cli_processors(void)
{
  long online = sysconf(_SC_NPROCESSORS_ONLN);
  return online < 1 ? 1 : online > CLI_MAX_JOBS ? CLI_MAX_JOBS : (int)online;
}

/* ---- no output over an input. Proof: tests/command/files.transcript ---- */

/* One name and the file it means. */
typedef struct named_file {
  cli_file as;
  file_identity is;
} named_file;

/* Is it a name that the system gives to a stream of ours? Two outputs are mixed there because the user asked for it. */
static bool is_stream(const cli_file *f)
{
  return !f->path || !strncmp(f->path, "/dev/", 5) || !strncmp(f->path, "/proc/", 6);
}

static bool clash(const named_file *a, const named_file *b)
{
  if (a->as.use == CLI_INPUT && b->as.use == CLI_INPUT) return false;
  if (a->as.use != CLI_INPUT && b->as.use != CLI_INPUT && is_stream(&a->as) && is_stream(&b->as)) return false;
  return file_same(&a->is, &b->is);
}

/* "--output a.yaml", "standard output" */
static const char *name_of(const cli_file *f, char *text, size_t size)
{
  if (f->path) snprintf(text, size, "%s %s", f->what, f->path);
  else snprintf(text, size, f->use == CLI_INPUT ? "%s on standard input" : "standard output", f->what);
  return text;
}

/* `written` is an output, `other` what it would replace. */
static void tell(const cli_common *common, const cli_file *written, const cli_file *other)
{
  enum { SIZE = 1024 };
  char one[SIZE], two[SIZE];
  const bool same_name = written->path && other->path && !strcmp(written->path, other->path);
  name_of(written, one, sizeof one);
  if (same_name && other->use == CLI_INPUT) snprintf(two, sizeof two, "%s", other->what);
  else name_of(other, two, sizeof two);
  if (other->use == CLI_INPUT) cli_message(common, "%s is %s itself; give another name", one, two);
  else cli_message(common, "%s and %s are the same file; give another name", one, two);
}

int cli_check_files(cli_common *common, int n, const cli_file *files)
{
  int found = 0, code = 0;
  named_file *list = calloc((size_t)common->n_arguments + 1 + (size_t)n + CLI_MOST_OPTIONS, sizeof *list);
  bool whole = list != NULL;
  const bool prints = common->output || !common->call;
  if (whole && prints) list[found++].as = (cli_file){"--output", common->output, CLI_OUTPUT};
  for (int i = 0; i < common->n_arguments && common->argument_is && whole; ++i)
    list[found++].as = (cli_file){common->argument_is, common->arguments[i], CLI_INPUT};
  for (int i = 0; i < n && whole; ++i)
    if (files[i].path) list[found++].as = files[i];
  for (const cli_option *o = common->command->options; o && o->name && whole; ++o) {
    const char *path = o->file ? *(const char *const *)value_of(common, o) : NULL;
    if (path) list[found++].as = (cli_file){o->file, path, o->use};
  }
  for (int i = 0; i < found && whole; ++i) {
    cli_file *f = &list[i].as;
    if (f->path && !strcmp(f->path, "-") && f->use != CLI_RESULTS) f->path = NULL;
    whole = file_identify(f->path, f->use == CLI_INPUT ? STDIN_FILENO : STDOUT_FILENO, &list[i].is);
  }
  if (!whole) code = cli_solver_failed(common, CLI_BOTH, "the files", HC_NO_MEMORY, 0);
  for (int i = 0; i < found && !code; ++i)
    for (int k = 0; k < i && !code; ++k) {
      if (!clash(&list[i], &list[k])) continue;
      const bool first_is_input = list[i].as.use == CLI_INPUT;
      tell(common, &list[first_is_input ? k : i].as, &list[first_is_input ? i : k].as);
      code = EXIT_USAGE;
    }
  for (int i = 0; i < found; ++i) file_forget(&list[i].is);
  free(list);
  return code;
}

/* ---- messages and exit codes ---- */

/* One line on standard error; a remark for who called. */
static void say(const cli_common *common, bool with_name, const char *format, va_list args)
{
  if (common->call) {
    cli_call_keep_remark(common->call, format, args);
    return;
  }
  if (with_name) fprintf(stderr, "hbmcheck %s: ", common->command->name);
  vfprintf(stderr, format, args);
  fputc('\n', stderr);
}

void cli_message(const cli_common *common, const char *format, ...)
{
  va_list args;
  va_start(args, format);
  say(common, true, format, args);
  va_end(args);
}

void cli_say(const cli_common *common, const char *format, ...)
{
  va_list args;
  va_start(args, format);
  say(common, false, format, args);
  va_end(args);
}

void cli_ended(const cli_common *common, hc_status st)
{
  if (common->call && common->call->status == HC_OK) common->call->status = st;
}

progress *cli_progress(const cli_common *common, const char *label)
{
  progress *bar = progress_start(label, common->quiet || common->call);
  if (common->call && bar) progress_pass_on(bar, &common->call->monitor);
  if (!bar) cli_ended(common, HC_NO_MEMORY); /* nobody could stop it */
  return bar;
}

bool cli_foretells(const cli_common *common) { return !common->quiet && !common->call; }

void cli_foretell_memory(const cli_common *common, double bytes)
{
  const double much = 2e8, machine = (double)sysconf(_SC_PHYS_PAGES) * (double)sysconf(_SC_PAGESIZE);
  if (!cli_foretells(common) || !(bytes > much)) return;
  if (bytes > machine)
    cli_message(common, "takes about %.2g GB of memory, more than the %.2g GB that this machine has", 1e-9 * bytes,
                1e-9 * machine);
  else cli_message(common, "takes about %.2g GB of memory", 1e-9 * bytes);
}

void cli_foretell_time(const cli_common *common, double seconds, int frequencies, const model *m)
{
  const double long_time = 10;
  char sizes[96] = "", count[48] = "a response curve", time[PROGRESS_TIME];
  if (!cli_foretells(common) || !(seconds > long_time)) return;
  if (m) snprintf(sizes, sizeof sizes, ", %d degrees of freedom, %d contact rows", m->n, m->n_contacts);
  if (frequencies) snprintf(count, sizeof count, "%d frequenc%s", frequencies, frequencies == 1 ? "y" : "ies");
  cli_message(common, "takes about %s of processor time: %s%s", progress_time(seconds, time), count, sizes);
}

int cli_plotted(const cli_common *common, hc_status st)
{
  return st == HC_OK ? 0 : cli_failed(common, EXIT_NO_SOLUTION, "no drawing: %s", common->drawing.why);
}

int cli_not_read(const cli_common *common, hc_status st, const case_error *err)
{
  cli_ended(common, st);
  cli_say(common, "%s", err->message[0] ? err->message : hc_status_text(st));
  return st == HC_NO_MEMORY ? EXIT_NO_SOLUTION : EXIT_BAD_CASE;
}

void cli_say_notes(const cli_common *common, const scene *sc)
{
  const char *notes = sc->structure->notes;
  if (notes && !common->quiet) cli_say(common, "%.*s", (int)strlen(notes) - 1, notes); /* ends with its last line */
}

int cli_load_case(cli_common *common, const char *path, scene *sc, case_error *err)
{
  *err = (case_error){{0}};
  common->scene = sc;
  const cli_call *call = common->call;
  const hc_status st = call && call->text
                           ? case_parse(path, call->text, call->length, common->n_set, common->set, sc, err)
                           : case_read(path, common->n_set, common->set, sc, err);
  if (st != HC_OK) return cli_not_read(common, st, err);
  cli_say_notes(common, sc);
  return 0;
}

int cli_load_sparse_case(cli_common *common, scene *sc)
{
  case_error err = {{0}};
  if (common->call && common->call->text) return cli_load_case(common, common->arguments[0], sc, &err);
  common->scene = sc;
  const hc_status st =
      case_read_sparse(common->arguments[0], common->n_set, common->set, MATRIX_MOST_DENSE, sc, NULL, &err);
  if (st != HC_OK) return cli_not_read(common, st, &err);
  cli_say_notes(common, sc);
  return 0;
}

/* ---- frequencies, and the sweep. Proof: tests/command/frequency.transcript ---- */

/* A frequency beyond FAR times the sweep's ends is not reached along the response curve; one that comes within DECADE
 * of them when it is taken for the other unit was probably typed in that. */
static const double FAR = 4, DECADE = 10;
static const double SHORTEST_SWEEP = 1e-3; /* of omega: a curve through a frequency that is solved for alone */

/* [1] How many times omega lies below or above the sweep; 1 inside. */
static double times_outside(const scene *sc, double omega)
{
  const double low = fmin(sc->omega_from, sc->omega_to), high = fmax(sc->omega_from, sc->omega_to);
  return fmax(1, fmax(low / omega, omega / high));
}

/* The omega that was meant if the one given was typed in the other unit; compare.omega of a case is never in cycles. */
static double in_other_unit(bool typed_in_cycles, double omega)
{
  return typed_in_cycles ? omega / TWO_PI : omega * TWO_PI;
}

/* "from 3 to 20", "from 0.5 to 3.2 cycles" into text[64], which is returned. */
static const char *sweep_text(const scene *sc, char text[64])
{
  const double low = fmin(sc->omega_from, sc->omega_to), high = fmax(sc->omega_from, sc->omega_to);
  snprintf(text, 64, "from %.10g to %.10g%s", scene_frequency(sc, low), scene_frequency(sc, high),
           sc->in_cycles ? " cycles" : "");
  return text;
}

/* The frequencies outside the sweep: `outside` of them, the first at `omega`. */
static void warn_outside(const cli_common *common, const scene *sc, double omega, int outside, bool cycles, bool alone)
{
  const double rounding = 8 * DBL_EPSILON;
  char at[SCENE_WHERE], others[32] = "", hint[128] = "", sweep[64];
  if (outside > 1) snprintf(others, sizeof others, " and %d more", outside - 1);
  if (alone || times_outside(sc, in_other_unit(cycles, omega)) <= 1 + rounding)
    snprintf(hint, sizeof hint, "; frequencies here are in %s per %s", cycles ? "cycles" : "rad", sc->unit_time);
  cli_message(common, "%s%s: %soutside the sweep %s, %s%s", scene_where(sc, omega, at), others, alone ? "far " : "",
              sweep_text(sc, sweep),
              alone ? "solved for without the response curve: other branches are not looked for"
                    : "which is widened to it",
              hint);
}

/* Why the frequency is refused, with what to do. */
static void refuse_far(const scene *sc, double omega, bool typed_in_cycles, char why[CASE_MESSAGE])
{
  const double meant = in_other_unit(typed_in_cycles, omega), own = scene_frequency(sc, omega);
  char at[SCENE_WHERE], sweep[64], hint[128];
  if (times_outside(sc, meant) <= DECADE)
    snprintf(hint, sizeof hint, "did you mean %.3g (%s per %s)? Else", typed_in_cycles ? meant / TWO_PI : meant,
             typed_in_cycles ? "cycles" : "rad", sc->unit_time);
  else snprintf(hint, sizeof hint, "expected all frequencies within a factor %g of it;", FAR);
  snprintf(
      why, CASE_MESSAGE, "%s: far outside the sweep %s, %s give it a run of its own, with --set sweep.%s=%.6g,%.6g",
      scene_where(sc, omega, at), sweep_text(sc, sweep), hint, sc->in_cycles ? "frequency" : "omega", own, 1.01 * own);
}

bool cli_frequencies_fit(const cli_common *common, const number_list *at, bool followed, scene *sc,
                         char why[CASE_MESSAGE])
{
  const double rounding = 8 * DBL_EPSILON; /* of 2 pi times an end of the sweep */
  const bool cycles = sc->in_cycles && at->n;
  number_list *omega = &sc->compare.omega;
  double first = NAN, first_far = NAN, low = INFINITY, high = 0;
  int outside = 0, far = 0;
  bool slip = false;
  if (at->n) *omega = *at;
  for (int i = 0; i < omega->n; ++i) {
    if (at->n) omega->v[i] = scene_omega(sc, omega->v[i]);
    const double times = times_outside(sc, omega->v[i]);
    low = fmin(low, omega->v[i]), high = fmax(high, omega->v[i]);
    if (!(times > 1 + rounding)) continue;
    if (outside++ == 0) first = omega->v[i];
    if (!(times > FAR)) continue;
    const bool this_slip = times_outside(sc, in_other_unit(cycles, omega->v[i])) <= DECADE;
    if (far++ == 0 || (this_slip && !slip)) first_far = omega->v[i];
    slip |= this_slip;
  }
  const bool swept = sc->transient.start == TRANSIENT_START_UP || sc->transient.start == TRANSIENT_START_DOWN;
  const bool alone = far > 0 && far == omega->n && high <= FAR * low && !swept;
  if (slip || (far > 0 && followed && !alone)) {
    refuse_far(sc, first_far, cycles, why);
    return false;
  }
  if (outside && !common->quiet) warn_outside(common, sc, first, outside, cycles, alone && followed);
  if (alone && followed) {
    const bool up = sc->omega_from <= sc->omega_to;
    high *= 1 + SHORTEST_SWEEP;
    sc->omega_from = up ? low : high;
    sc->omega_to = up ? high : low;
  }
  return true;
}

int cli_take_frequencies(const cli_common *common, const number_list *at, bool followed, scene *sc)
{
  char why[CASE_MESSAGE];
  return cli_frequencies_fit(common, at, followed, sc, why) ? 0 : cli_failed(common, EXIT_BAD_CASE, "%s", why);
}

/* A structure that cannot be solved at rest: names the motion that nothing holds there. A static load may press its
 * contacts on. */
static bool advice_on_free_motion(const scene_structure *s, char text[ADVICE_TEXT])
{
  message m;
  bool is_free = false;
  for (int i = 0; i < s->n_loads; ++i)
    if (s->loads[i].harmonic == 0 && s->loads[i].amplitude != 0) return false;
  double *x = malloc((size_t)s->n * sizeof *x);
  if (x && structure_free_motion(s, true, x, &is_free) == HC_OK && is_free) {
    message_start(&m, text, ADVICE_TEXT);
    message_add(&m, "while nothing touches, nothing holds the motion {");
    structure_describe_motion(s, x, &m);
    message_add(
        &m, "}: press its contacts on by a gap > 0, a preload or a static load (harmonic: 0), or hold it by a spring");
  }
  free(x);
  return is_free;
}

/* A structure that does not settle: names a mode that nothing damps. */
static bool advice_on_undamped_mode(const scene *sc, char text[ADVICE_TEXT])
{
  double omega;
  char at[SCENE_WHERE];
  if (structure_undamped_mode(sc->structure, &omega) != HC_OK || omega < 0) return false;
  snprintf(text, ADVICE_TEXT,
           "no damping acts on the mode at %s: what the start leaves in it dies out by friction alone, if at all; try "
           "structure.damping",
           scene_where(sc, omega, at));
  return true;
}

/* What a person can try next; "" where no setting helps. */
static const char *advice_for(const scene *sc, cli_solver solver, hc_status st, char text[ADVICE_TEXT])
{
  char other[ADVICE_TEXT];
  text[0] = 0;
  if (!sc) return text;
  const bool no_solution =
      st == HC_SINGULAR || st == HC_STALLED || st == HC_NOT_CONVERGED || st == HC_STEP_TOO_SMALL || st == HC_JUMPED;
  const bool failed_at_mean = solver == CLI_TRANSIENT ? st == HC_NOT_SETTLED : no_solution && sc->hbm.keep_mean;
  if (failed_at_mean && !scene_is_oscillator(sc) && advice_on_free_motion(sc->structure, text)) return text;
  if (failed_at_mean && scene_adrift(sc)) return snprintf(text, ADVICE_TEXT, "%s", SCENE_ADRIFT), text;
  if (solver == CLI_TRANSIENT && st == HC_NOT_SETTLED && !scene_is_oscillator(sc) && advice_on_undamped_mode(sc, text))
    return text;
  if (st == HC_NOT_FINITE) /* of neither side's settings */
    return snprintf(text, ADVICE_TEXT, "%s",
                    !scene_is_oscillator(sc) ? ADVICE_ON_STRUCTURE : advice_on_size(*sc->structure->damping.v)),
           text;
  if (solver != CLI_TRANSIENT) advice_for_hbm(&sc->hbm, st, text);
  if (solver == CLI_HBM || !*advice_for_transient(&sc->transient, st, other)) return text;
  snprintf(text, ADVICE_TEXT, "%s",
           *text ? "hbmcheck frf and hbmcheck transient on the same case tell which side it is" : other);
  return text;
}

int cli_solver_failed(const cli_common *common, cli_solver solver, const char *what, hc_status st, double omega)
{
  char advice[ADVICE_TEXT], at[SCENE_WHERE] = "";
  if (omega > 0) scene_where(common->scene, omega, at);
  advice_for(common->scene, solver, st, advice);
  if (st == HC_NO_MEMORY) cli_ended(common, st);
  if (st == HC_INTERRUPTED)
    cli_message(common, "%s: stopped on request%s%s; what was found is kept", what, *at ? " at " : "", at);
  else if (st == HC_NO_MEMORY) cli_message(common, "%s", hc_status_text(st));
  else
    cli_message(common, "%s%s%s: %s%s%s", what, *at ? " stopped at " : "", at, hc_status_text(st), *advice ? "; " : "",
                advice);
  return EXIT_NO_SOLUTION;
}

int cli_creeps(const cli_common *common, double omega, const char *response, double drift)
{
  char at[SCENE_WHERE];
  cli_message(common, "at %s %s%s slides on by %.9g in each period: there is no periodic motion; %s",
              scene_where(common->scene, omega, at), *response ? "response " : "the body", response, drift,
              ADVICE_ON_CREEP);
  return EXIT_NO_SOLUTION;
}

bool cli_it_creeps(const scene *sc, double omega, const hc_monitor *monitor, char *name, double *drift)
{
  compare_setup setup;
  int response = 0;
  hc_status st = scene_setup(sc, &setup);
  if (st == HC_OK) st = steady_state_creeps(&setup, omega, monitor, &response, drift);
  scene_setup_clear(&setup);
  if (st == HC_CREEPS && !scene_is_oscillator(sc))
    structure_response_name(sc->structure, response, name, RESPONSE_NAME);
  return st == HC_CREEPS;
}

double cli_past(const scene *sc, double omega)
{
  const double beyond = 1e-3; /* of omega */
  return omega * (1 + (sc->omega_to > sc->omega_from ? beyond : -beyond));
}

int cli_file_failed(const cli_common *common, const char *path, hc_status st)
{
  const char *why = st == HC_IO && errno ? strerror(errno) : hc_status_text(st);
  cli_ended(common, st);
  if (!path && st == HC_IO && errno == EPIPE) return EXIT_NO_SOLUTION; /* who reads it has seen enough: `| head` */
  return cli_failed(common, st == HC_BUG ? EXIT_BUG : EXIT_NO_SOLUTION, "%s: %s", path ? path : "standard output", why);
}

int cli_make_folder(const cli_common *common, const char *path)
{
  struct stat st;
  if (!path || mkdir(path, 0777) == 0) return 0;
  if (errno == EEXIST && stat(path, &st) == 0 && S_ISDIR(st.st_mode)) return 0;
  if (errno == EEXIST) errno = ENOTDIR;
  return cli_file_failed(common, path, HC_IO);
}

/* ---- results ---- */

const char *cli_hbm_settings(const scene *sc, int n_harm, int n_time, char *text, size_t size)
{
  char samples[48] = "exact forces";
  if (sc->hbm.force == HBM_FORCE_SAMPLED)
    snprintf(samples, sizeof samples, "%s%d samples", sc->hbm.samples == HBM_AUTO ? "auto, at most " : "", n_time);
  snprintf(text, size, "H = %s%d%s, %s", sc->hbm.harmonics == HBM_AUTO ? "auto, at most " : "", n_harm,
           sc->hbm.keep_mean ? "" : " WITHOUT harmonic 0", samples);
  return text;
}

table *cli_own_table(const char *title, unsigned extra, int n, const table_column *columns)
{
  table_column own[ROWS_MOST];
  int kept = 0;
  for (int i = 0; i < n; ++i)
    if ((extra & ROWS_IN_CYCLES || strcmp(columns[i].name, "frequency") != 0) &&
        (extra & ROWS_RESPONSES || strcmp(columns[i].name, "response") != 0))
      own[kept++] = columns[i];
  return table_new(title, kept, own);
}

unsigned cli_extra_columns(const scene *sc)
{
  return (sc->in_cycles ? ROWS_IN_CYCLES : 0u) | (!scene_is_oscillator(sc) ? ROWS_RESPONSES : 0u);
}

/* What of a case its rows of that kind have: those of whole curves have no response. */
static unsigned extra_of(const cli_common *common, rows_kind kind)
{
  const bool of_curves = kind == ROWS_CURVE || kind == ROWS_ACCURACY || kind == ROWS_ORDER;
  const unsigned of_case = cli_extra_columns(common->scene);
  return (of_curves ? of_case & ROWS_IN_CYCLES : of_case) | (common->call ? ROWS_IN_MEMORY : 0u) |
         (common->bands ? ROWS_BANDS : 0u);
}

bool cli_reads(const cli_common *common, rows_kind kind, const char *column)
{
  table_column columns[ROWS_MOST];
  const int n = rows_columns(kind, extra_of(common, kind), columns);
  const char *const *spare = rows_spare(kind, common->scene->in_cycles);
  const bool fits = common->format == FORMAT_TABLE && !common->wide && !common->drawing.path;
  for (; fits && *spare; ++spare)
    if (!strcmp(*spare, column)) return false;
  for (int i = 0; i < n; ++i)
    if (!strcmp(columns[i].name, column)) return true;
  return false;
}

table *cli_table(const cli_common *common, const char *title, rows_kind kind)
{
  table_column columns[ROWS_MOST];
  table *t = table_new(title, rows_columns(kind, extra_of(common, kind), columns), columns);
  table_spare(t, rows_spare(kind, common->scene->in_cycles));
  return t;
}

void cli_put_row(const cli_common *common, table *t, rows_kind kind, const void *row)
{
  row_cell cells[ROWS_MOST];
  const int n = rows_cells(kind, row, extra_of(common, kind), cells);
  for (int i = 0; i < n; ++i) {
    if (!cells[i].there) table_put_missing(t);
    else if (cells[i].kind == TABLE_TEXT) table_put_text(t, cells[i].as.text);
    else if (cells[i].kind == TABLE_INTEGER) table_put_integer(t, cells[i].as.integer);
    else if (cells[i].kind == TABLE_SERIES) table_put_series(t, cells[i].as.series.n, cells[i].as.series.v);
    else table_put_real(t, cells[i].as.real);
  }
}

int cli_width(const cli_common *common)
{
  enum { LEAST = 40, USUAL = 100 };
  const int width = output_columns(common->output, &(int){0});
  return width <= 0 ? USUAL : width < LEAST ? LEAST : width;
}

bool cli_shows_rows(const cli_common *common)
{
  return !common->call && common->format != FORMAT_TABLE && (!common->output || !strcmp(common->output, "-"));
}

void cli_show_rows(const cli_common *common, const table *t, table_begun *begun)
{
  if (begun->failed || !cli_shows_rows(common)) return;
  progress_erase();
  errno = 0;
  const hc_status st = table_write_begun(t, common->format, stdout, begun);
  if (fflush(stdout) != 0 || st != HC_OK) begun->failed = st == HC_NO_MEMORY ? ENOMEM : errno ? errno : EIO;
}

int cli_write(const cli_common *common, int n, table *const *tables)
{
  return cli_write_rest(common, n, tables, &(table_begun){.several = n != 1});
}

int cli_write_all(const cli_common *common, int n, table *const *tables)
{
  const int code = cli_write(common, n, tables);
  for (int i = 0; i < n; ++i) table_free(tables[i]);
  return code;
}

int cli_write_rest(const cli_common *common, int n, table *const *tables, const table_begun *begun)
{
  output *out = NULL;
  for (int i = 0; i < n && common->call; ++i) cli_call_keep_table(common->call, tables[i]);
  if (common->call) return common->call->status == HC_NO_MEMORY ? EXIT_NO_SOLUTION : 0;
  if (begun->failed) {
    errno = begun->failed;
    return cli_file_failed(common, common->output, errno == ENOMEM ? HC_NO_MEMORY : HC_IO);
  }
  hc_status st = output_open(common->output, &out);
  for (int i = 0; i < n; ++i) {
    if (common->wide) table_show_all(tables[i]);
    else table_fit(tables[i], cli_width(common));
  }
  if (st == HC_OK) st = output_finish(out, table_write_rest(n, tables, common->format, output_stream(out), begun));
  return st == HC_OK ? 0 : cli_file_failed(common, common->output, st);
}
