/* fields.c - the table of fields; see fields.h. Defaults and ranges stand here and nowhere else. */
#include "model/casefile/fields.h"

#include "numerics/base/constants.h"
#include "numerics/base/nearest.h"

static const char *const force_names[] = {[HBM_FORCE_EXACT] = "exact", [HBM_FORCE_SAMPLED] = "sampled", NULL};
static const char *const restart_names[] = {
    [HBM_RESTART_INTERPOLATED] = "interpolated", [HBM_RESTART_SAMPLE] = "sample", NULL};
static const char *const continuation_names[] = {[HBM_CONTINUATION_AUTO] = "auto",
                                                 [HBM_CONTINUATION_NATURAL] = "natural",
                                                 [HBM_CONTINUATION_ARCLENGTH] = "arclength",
                                                 [HBM_CONTINUATION_FIXED_STEP] = "fixed_step",
                                                 NULL};
static const char *const law_names[] = {
    [TRANSIENT_LAW_REGULARISED] = "regularised", [TRANSIENT_LAW_EXACT] = "exact", NULL};
static const char *const method_names[] = {
    [TRANSIENT_METHOD_CVODE] = "cvode", [TRANSIENT_METHOD_CLOSED_FORM] = "closed_form", NULL};
static const char *const steady_names[] = {[TRANSIENT_STEADY_AUTO] = "auto",
                                           [TRANSIENT_STEADY_MARCH] = "march",
                                           [TRANSIENT_STEADY_SHOOTING] = "shooting",
                                           NULL};
static const char *const start_names[] = {[TRANSIENT_START_HBM] = "hbm",
                                          [TRANSIENT_START_REST] = "rest",
                                          [TRANSIENT_START_UP] = "up",
                                          [TRANSIENT_START_DOWN] = "down",
                                          NULL};

#define LAW_NAME(code, name) #name,
static const char *const contact_law_names[] = {"contact", CONTACT_SMOOTH_LIST(LAW_NAME) "table", NULL};
static const char *const limit_names[] = {[CONTACT_LIMIT_CIRCLE] = "circle", [CONTACT_LIMIT_SQUARE] = "square", NULL};
static const char *const band_names[] = {[COMPARE_BAND_AUTO] = "auto", [COMPARE_BAND_OFF] = "off", NULL};
static const char *const nonlinear_names[] = {
    [GATE_NONLINEAR_ANY] = "any", [GATE_NONLINEAR_REQUIRED] = "required", NULL};

static const field_section sections[] = {
    {"", "one scene a file"},
    {"units", "labels for plots and tables; any consistent set of units will do"},
    {"oscillator", "M x'' + C x' + K x + contact forces = F0 cos(omega t)"},
    {"structure", "instead of oscillator: M, C, K as matrices; DOFs go by name or by number from 1"},
    {"forcing", "F0 cos(omega t), where there is one DOF"},
    {"forcing[]", "a list of loads, with structure: amplitude cos(harmonic omega t + phase) each"},
    {"base", "instead of a force with omega: it moves, with it the ground of contacts; x is relative to it"},
    {"contacts", "a list, one entry a contact, all at once on the same mass or structure; none: a linear one"},
    {"sweep", "the frequencies of the response curve"},
    {"hbm", "harmonic balance"},
    {"transient", "integration in time"},
    {"compare", "where, and over what, the two are compared"},
    {"gate", "the largest discrepancies, relative to the transient's amplitude, that still pass"},
};

/* Shorthands for the rows below. */
#define SCENE(member) .offset = offsetof(scene, member)
#define OSCILLATOR(pointer, within, more)                                                                              \
  .flags = FIELD_OSCILLATOR | (more), .offset = offsetof(scene_structure, pointer), .behind = (within)
#define CONTACT(member) .flags = FIELD_IN_CONTACT, .offset = offsetof(scene_contact, member)
#define LOAD(member)    .flags = FIELD_IN_LOAD | FIELD_STRUCTURE, .offset = offsetof(structure_load, member)
#define STRUCTURE(member)                                                                                              \
  .flags = FIELD_IN_STRUCTURE | FIELD_STRUCTURE | FIELD_NO_ECHO, .offset = offsetof(scene_structure, member)
#define PART(within, words) FIELD_PART, .flags = (within) | FIELD_STRUCTURE, .expects = (words)
#define DIRECTION(within, type, member, words)                                                                         \
  PART(within, words), .offset = offsetof(type, member), .size = sizeof(double *)
#define ACROSS(member)                                                                                                 \
  DIRECTION(FIELD_IN_CONTACT, structure_contact, member, "a DOF, or factors of DOFs such as {tip: 1, root: -1}")
#define POWER(p)                                                                                                       \
  {                                                                                                                    \
    "contacts", "coefficients." #p, "", FIELD_REAL,                                                                    \
        .unit = "force/length^" #p, .flags = FIELD_IN_CONTACT | FIELD_NO_ECHO,                                         \
        .offset = offsetof(scene_contact, law.power[(p)-CONTACT_LEAST_POWER]), .fallback = "0", UNBOUNDED,             \
        .laws = SCENE_LAWS(CONTACT_POLYNOMIAL), .meaning = "one of them, for --set and studies"                        \
  }
#define RUBS (SCENE_LAWS(CONTACT_KINKED) | SCENE_LAWS(CONTACT_TANH))
#define TEXT(member)                                                                                                   \
  .kind = FIELD_TEXT, .unit = "", .offset = offsetof(scene, member), .size = sizeof((scene *)0)->member
#define CHOICE(names, member)                                                                                          \
  .kind = FIELD_CHOICE, .unit = "", .choices = (names), .offset = offsetof(scene, member),                             \
  .size = sizeof((scene *)0)->member
#define WITHIN(a, b) .low = (a), .high = (b)
#define UNBOUNDED    WITHIN(-INFINITY, INFINITY)
#define NOT_NEGATIVE WITHIN(0, INFINITY)
#define POSITIVE     .flags = FIELD_OPEN, WITHIN(0, INFINITY)
#define GIVES_SWEEP  .group = "sweep", .in_cycles = offsetof(scene, in_cycles)
#define MOST_SAMPLES 16777216 /* 2^24: sizes in bytes stay far inside an int */

/* clang-format off */
static const field table[] = {
  {"", "title", "", TEXT(title), .fallback = "", .meaning = "what the scene is, in a few words"},

  {"units", "length", "", TEXT(unit_length), .fallback = "m", .meaning = "label of lengths"},
  {"units", "force", "", TEXT(unit_force), .fallback = "N", .meaning = "label of forces"},
  {"units", "time", "", TEXT(unit_time), .fallback = "s", .meaning = "label of times"},

  {"oscillator", "mass", "M", FIELD_REAL, .unit = "force time^2/length", OSCILLATOR(mass.v, 0, FIELD_OPEN),
   WITHIN(0, INFINITY), .meaning = "the moving mass"},
  {"oscillator", "damping", "C", FIELD_REAL, .unit = "force time/length", OSCILLATOR(damping.v, 0, 0), NOT_NEGATIVE,
   .meaning = "of the linear damper"},
  {"oscillator", "stiffness", "K", FIELD_REAL, .unit = "force/length", OSCILLATOR(stiffness.v, 0, 0), NOT_NEGATIVE,
   .meaning = "of the linear spring, without contacts"},

  {"structure", "mass", "M", PART(0, "a matrix: rows, a diagonal, or a FILE of one"),
   .unit = "force time^2/length", .meaning = "symmetric and positive definite; its size is the number of DOFs"},
  {"structure", "stiffness", "K", PART(0, "a matrix: rows, a diagonal, or a FILE of one"),
   .unit = "force/length", .meaning = "without contacts, which may have to hold what K does not"},
  {"structure", "damping", "C", PART(0, "a matrix as above, {rayleigh: ...} or {modal: ...}"),
   .unit = "force time/length", .meaning = "any matrix, or what is said of it by one of the two below"},
  {"structure", "damping.rayleigh", "", FIELD_PAIR, .unit = "1/time, time", STRUCTURE(rayleigh), .fallback = "",
   UNBOUNDED, .expects = "two numbers, [ALPHA, BETA]", .group = "damping",
   .meaning = "alpha and beta of C = alpha M + beta K"},
  {"structure", "damping.rayleigh[0]", "", FIELD_REAL, .unit = "1/time", STRUCTURE(rayleigh[0]), .fallback = "",
   UNBOUNDED, .meaning = "alpha alone, for --set and studies"},
  {"structure", "damping.rayleigh[1]", "", FIELD_REAL, .unit = "time", STRUCTURE(rayleigh[1]), .fallback = "",
   UNBOUNDED, .meaning = "beta alone"},
  {"structure", "damping.modal", "", FIELD_REAL, .unit = "1", STRUCTURE(modal), .fallback = "", NOT_NEGATIVE,
   .group = "damping", .meaning = "of critical, for every mode of M and K; or a list, one a mode"},
  {"structure", "names", "", PART(0, "a list of names, one a DOF"), .unit = "", .fallback = "",
   .meaning = "of the DOFs"},
  {"structure", "nodes", "", PART(0, "a FILE (csv, .dof), or a list of [DOF, NODE, x|y|z]"), .unit = "",
   .fallback = "", .meaning = "then {node: 17, direction: y} means a DOF, too"},
  {"structure", "mesh", "", PART(0, "a FILE of CalculiX or Abaqus (.inp)"), .unit = "", .fallback = "",
   .meaning = "whose sets of nodes `pairs: {between: ...}` names"},

  {"structure", "reduction", "", PART(0, "{error: 2e-4, at: 500}, both numbers >= 0"),
   .unit = "1, rad/time", .fallback = "",
   .meaning = "largest relative error of the receptance, as `reduce` states it, and at which frequency"},

  {"forcing", "amplitude", "F0", FIELD_REAL, .unit = "force",
   OSCILLATOR(loads, offsetof(structure_load, amplitude), 0), NOT_NEGATIVE,
   .meaning = "of the force F0 cos(omega t)"},

  {"forcing[]", "dof", "", DIRECTION(FIELD_IN_LOAD, structure_load, direction, "a DOF"),
   .unit = "", .fallback = "", .meaning = "where it acts"},
  {"forcing[]", "direction", "",
   DIRECTION(FIELD_IN_LOAD, structure_load, direction, "factors of DOFs such as {tip: 1, root: -0.5}"), .unit = "1",
   .fallback = "", .meaning = "instead of dof, where it acts on several"},
  {"forcing[]", "amplitude", "", FIELD_REAL, .unit = "force", LOAD(amplitude), UNBOUNDED,
   .meaning = "of amplitude cos(harmonic omega t + phase)"},
  {"forcing[]", "phase_deg", "", FIELD_REAL, .unit = "deg", LOAD(phase_deg), .fallback = "0", UNBOUNDED,
   .meaning = "ahead of cos(harmonic omega t)"},
  {"forcing[]", "harmonic", "", FIELD_INTEGER, .unit = "1", LOAD(harmonic), .fallback = "1",
   WITHIN(0, HBM_MAX_HARMONICS), .meaning = "of omega; 0: a static load"},

  {"base", "direction", "", PART(0, "x, y or z of structure.nodes, a DOF, or factors of DOFs"), .unit = "1",
   .fallback = "", .meaning = "how far each DOF of a structure moves with the base, which moves by 1"},
  {"base", "amplitude", "", FIELD_REAL, .unit = "length", SCENE(base.amplitude), .fallback = "0", NOT_NEGATIVE,
   .group = "base", .meaning = "of the base's motion, A cos(omega t)"},
  {"base", "acceleration", "", FIELD_REAL, .unit = "length/time^2", SCENE(base.acceleration), .fallback = "0",
   NOT_NEGATIVE, .group = "base", .meaning = "instead: the same at every omega, a cos(omega t)"},

  {"contacts", "name", "", FIELD_TEXT, .laws = SCENE_ANY_LAW, .unit = "", .flags = FIELD_IN_CONTACT | FIELD_STRUCTURE,
   .offset = offsetof(scene_contact, name), .size = SCENE_NAME, .fallback = "",
   .meaning = "then contacts[NAME] means it, too"},
  {"contacts", "tangential_stiffness", "kt", FIELD_REAL, .unit = "force/length", CONTACT(law.kt), NOT_NEGATIVE,
   .along = "tangent", .meaning = "of the spring along the contact, in series with the slider"},
  {"contacts", "normal_stiffness", "kn", FIELD_REAL, .unit = "force/length", CONTACT(law.kn), NOT_NEGATIVE,
   .laws = RUBS, .along = "normal", .meaning = "of the spring across the contact: N = max(kn (v + gap), 0)"},
  {"contacts", "friction", "mu", FIELD_REAL, .unit = "1", CONTACT(law.mu), NOT_NEGATIVE, .along = "tangent",
   .laws = RUBS, .meaning = "Coulomb's coefficient: |T| <= mu N"},
  {"contacts", "angle_deg", "alpha", FIELD_REAL, .laws = RUBS, .unit = "deg", CONTACT(angle_deg), WITHIN(-90, 90),
   .meaning = "from x to the tangent: u = x cos(alpha), v = x sin(alpha); of one DOF"},
  {"contacts", "tangent", "", ACROSS(tangent), .laws = RUBS,
   .unit = "1", .fallback = "", .meaning = "u = tangent . x; none: a spring across the contact alone"},
  {"contacts", "tangent_2", "", ACROSS(tangent_2),
   .unit = "1", .fallback = "", .meaning = "a second tangent, across the first: the traction is a vector then"},
  {"contacts", "limit", "", FIELD_CHOICE, .unit = "", .choices = limit_names,
   .flags = FIELD_IN_CONTACT | FIELD_STRUCTURE,
   .offset = offsetof(scene_contact, limit), .fallback = "circle", .along = "tangent_2",
   .meaning = "of two tangents: |(T_1, T_2)| <= mu N; square: |T_1| and |T_2| <= mu N each"},
  {"contacts", "normal", "", ACROSS(normal), .laws = RUBS,
   .unit = "1", .fallback = "", .meaning = "v = normal . x; none: N = preload, constant"},
  {"contacts", "pairs", "", PART(FIELD_IN_CONTACT, "a csv file node_a,node_b[,gap][,preload][,area], rows, or "
   "{between: ...}"), .unit = "", .fallback = "",
   .meaning = "a contact for each pair of nodes; stiffnesses are per area"},
  {"contacts", "axes", "", PART(FIELD_IN_CONTACT, "{normal: [X, Y, Z], tangent: [X, Y, Z]}, tangent_2: none"),
   .unit = "1", .fallback = "", .meaning = "of pairs, of a's motion less b's; tangent_2 is normal x tangent"},
  {"contacts", "gap", "g", FIELD_REAL, .laws = RUBS, .unit = "length", CONTACT(law.gap), .fallback = "0", UNBOUNDED,
   .group = "preload", .along = "normal", .meaning = "> 0: preload, N0 = kn gap; < 0: clearance"},
  {"contacts", "preload", "", FIELD_REAL, .laws = RUBS, .unit = "force", CONTACT(preload), .fallback = "0",
   NOT_NEGATIVE, .group = "preload",
   .meaning = "instead of gap = preload/kn; without normal: N itself"},
  {"contacts", "rest", "", FIELD_REAL, .laws = SCENE_LAWS(CONTACT_KINKED), .unit = "length", CONTACT(rest[0]),
   .fallback = "0", UNBOUNDED, .along = "tangent",
   .meaning = "where the slider begins, on both sides: one that never slips stays there; also transient.rest"},
  {"contacts", "rest_2", "", FIELD_REAL, .laws = SCENE_LAWS(CONTACT_KINKED), .unit = "length",
   .flags = FIELD_IN_CONTACT | FIELD_STRUCTURE, .offset = offsetof(scene_contact, rest[1]), .fallback = "0", UNBOUNDED,
   .along = "tangent_2", .meaning = "the same along the second tangent"},

  {"contacts", "law", "", FIELD_CHOICE, .unit = "", .laws = SCENE_ANY_LAW, .choices = contact_law_names,
   .flags = FIELD_IN_CONTACT, .offset = offsetof(scene_contact, kind), .fallback = "contact",
   .meaning = "contact: friction and gap, as above; the others have the fields below"},
  {"contacts", "direction", "", ACROSS(normal), .laws = SCENE_LAWS(CONTACT_POLYNOMIAL) | SCENE_LAWS(SCENE_LAW_TABLE),
   .unit = "1", .fallback = "", .meaning = "of a polynomial or a table: d = direction . x; of one DOF d = x"},
  {"contacts", "coefficients", "", FIELD_PART, .flags = FIELD_IN_CONTACT, .laws = SCENE_LAWS(CONTACT_POLYNOMIAL),
   .expects = "{POWER: COEFFICIENT, ...}, powers 2..9", .unit = "force/length^POWER",
   .meaning = "of a polynomial: the force is the sum of coefficient d^power"},
  POWER(2), POWER(3), POWER(4), POWER(5), POWER(6), POWER(7), POWER(8), POWER(9),
  {"contacts", "points", "", FIELD_PART, .flags = FIELD_IN_CONTACT, .laws = SCENE_LAWS(SCENE_LAW_TABLE),
   .expects = "[[DISTANCE, FORCE], ...], 2 to 32 points, distances ascending", .unit = "length, force",
   .meaning = "of a table: the force is linear between them, and goes on with the slopes at its ends"},
  {"contacts", "epsilon", "", FIELD_REAL, .unit = "length/time", .flags = FIELD_IN_CONTACT | FIELD_OPEN,
   .offset = offsetof(scene_contact, law.epsilon), .fallback = "", WITHIN(0, INFINITY),
   .laws = SCENE_LAWS(CONTACT_TANH), .meaning = "of tanh: the traction is mu N tanh(u'/epsilon)"},

  {"", "response", "", PART(0, "a list of DOFs or directions such as [tip, {tip: 1, root: -1}]"), .unit = "",
   .fallback = "", .meaning = "what is reported of a structure, first one first; none: the forced DOF"},

  {"sweep", "omega", "", FIELD_PAIR, .unit = "rad/time", SCENE(omega_from), POSITIVE, GIVES_SWEEP,
   .meaning = "from and to; downwards if from > to"},
  {"sweep", "frequency", "", FIELD_PAIR, .unit = "cycles/time", SCENE(omega_from), POSITIVE, GIVES_SWEEP,
   .scale = TWO_PI,
   .meaning = "instead of omega = 2 pi frequency; then --at, gate.ranges and all results are in cycles, too"},

  {"hbm", "harmonics", "H", FIELD_INTEGER, .unit = "1", .flags = FIELD_AUTO, SCENE(hbm.harmonics), .fallback = "5",
   WITHIN(1, HBM_MAX_HARMONICS), .meaning = "the highest harmonic kept"},
  {"hbm", "static", "", FIELD_FLAG, .unit = "", SCENE(hbm.keep_mean), .fallback = "true",
   .meaning = "keep harmonic 0, the mean; false is the paper's mode"},
  {"hbm", "force", "", CHOICE(force_names, hbm.force), .fallback = "exact",
   .meaning = "contact force located by its events, free of aliasing, or sampled (AFT)"},
  {"hbm", "samples", "N", FIELD_INTEGER, .unit = "1", .flags = FIELD_AUTO, SCENE(hbm.samples), .fallback = "1024",
   WITHIN(3, MOST_SAMPLES), .meaning = "per period, at least 2 harmonics + 1; for the sampled force"},
  {"hbm", "slider_restart", "", CHOICE(restart_names, hbm.restart), .fallback = "interpolated",
   .meaning = "where the slider starts after a separation; for the sampled force"},
  {"hbm", "continuation", "", CHOICE(continuation_names, hbm.continuation), .fallback = "auto",
   .meaning = "how the response curve is followed; fixed_step: as by a simple code"},
  {"hbm", "step", "", FIELD_REAL, .unit = "1", SCENE(hbm.step), .fallback = "0.02", .flags = FIELD_OPEN, WITHIN(0, 1),
   .meaning = "for fixed_step: arc length from point to point (docs/theory.md, section 6)"},
  {"hbm", "iterations", "", FIELD_INTEGER, .unit = "1", SCENE(hbm.iterations), .fallback = "20", WITHIN(1, 1000),
   .meaning = "for fixed_step: the most that Newton may take at a point"},
  {"hbm", "tolerance", "", FIELD_REAL, .unit = "1", SCENE(hbm.tolerance), .fallback = "1e-10", WITHIN(1e-14, 1e-2),
   .meaning = "of the residual, relative to the forces that make it up"},
  {"hbm", "accuracy", "", FIELD_REAL, .unit = "1", SCENE(hbm.accuracy), .fallback = "1e-4",
   WITHIN(HBM_LEAST_ACCURACY, 1e-1), .meaning = "relative error that harmonics: auto and samples: auto aim at"},
  {"hbm", "skip_linear", "", FIELD_FLAG, .unit = "", SCENE(hbm.skip_linear), .fallback = "true",
   .meaning = "take points where nothing happens at the contacts from the closed form"},

  {"transient", "law", "", CHOICE(law_names, transient.law), .fallback = "regularised",
   .meaning = "contact law that is integrated"},
  {"transient", "method", "", CHOICE(method_names, transient.method), .fallback = "cvode",
   .meaning = "integration by CVODE, or the exact law in closed form"},
  {"transient", "scout", "", FIELD_FLAG, .unit = "", SCENE(transient.scout), .fallback = "true",
   .meaning = "look for orbits in closed form first, and confirm them by CVODE; false: CVODE alone"},
  {"transient", "regularisation", "eta", FIELD_REAL, .unit = "1", SCENE(transient.regularisation),
   .fallback = "1e-4", WITHIN(1e-8, TRANSIENT_MOST_REGULARISATION),
   .meaning = "of the contact law's corners; the error vanishes with it"},
  {"transient", "steady_state", "", CHOICE(steady_names, transient.steady), .fallback = "auto",
   .meaning = "how the steady state is reached"},
  {"transient", "start", "", CHOICE(start_names, transient.start), .fallback = "hbm",
   .meaning = "on the HBM orbit, at rest, or swept up or down as on a shaker"},
  {"transient", "rest", "", FIELD_PART, .flags = FIELD_NO_ECHO, .expects = "{CONTACT: W, ...}, by names or numbers",
   .unit = "length", .fallback = "", .meaning = "where sliders begin, of several contacts at once: contacts[].rest"},
  {"transient", "tolerance", "", FIELD_REAL, .unit = "1", SCENE(transient.tolerance), .fallback = "1e-9",
   WITHIN(TRANSIENT_LEAST_TOLERANCE, 1e-2), .meaning = "relative distance to the periodic orbit"},
  {"transient", "max_periods", "", FIELD_INTEGER, .unit = "1", SCENE(transient.max_periods), .fallback = "20000",
   WITHIN(1, TRANSIENT_MOST_PERIODS), .meaning = "forcing periods before the answer is not_settled"},

  {"compare", "omega", "", FIELD_REALS, .unit = "rad/time", SCENE(compare.omega),
   .fallback = "", POSITIVE, .group = "where", .meaning = "the frequencies at which to compare"},
  {"compare", "frequency", "", FIELD_REALS, .unit = "cycles/time", .flags = FIELD_OPEN | FIELD_NO_ECHO,
   SCENE(compare.omega), .fallback = "", WITHIN(0, INFINITY), .scale = TWO_PI, .group = "where",
   .meaning = "the same in cycles, instead of omega = 2 pi frequency"},
  {"compare", "points", "", FIELD_INTEGER, .unit = "1", SCENE(compare.points), .fallback = "20",
   WITHIN(1, NUMBER_LIST_MAX), .group = "where",
   .meaning = "instead: how many frequencies, spread over the sweep, dense at peaks"},
  {"compare", "harmonics", "", FIELD_INTEGERS, .unit = "1", SCENE(compare.harmonics), .fallback = "[1, 3, 5, 10]",
   WITHIN(1, HBM_MAX_HARMONICS), .meaning = "truncation orders of the table that compare --tables prints"},
  {"compare", "samples", "", FIELD_INTEGERS, .unit = "1", SCENE(compare.samples), .fallback = "[32, 128, 512, 2048]",
   WITHIN(3, MOST_SAMPLES), .meaning = "sampling rates of that table; exact forces stand beside them"},
  {"compare", "band", "", CHOICE(band_names, compare.band), .fallback = "auto",
   .meaning = "auto: the amplitudes of all steady states that differ by where sliders rest that never slip"},

  {"gate", "amplitude", "", FIELD_REAL, .unit = "1", SCENE(gate.most.amplitude), .fallback = "1e-3", POSITIVE,
   .meaning = "of (max - min)/2 over a period"},
  {"gate", "harmonic_1", "", FIELD_REAL, .unit = "1", SCENE(gate.most.harmonic_1), .fallback = "1e-3", POSITIVE,
   .meaning = "of the fundamental, a1 + i b1"},
  {"gate", "mean", "", FIELD_REAL, .unit = "1", SCENE(gate.most.mean), .fallback = "1e-3", POSITIVE,
   .meaning = "of harmonic 0"},
  {"gate", "waveform", "", FIELD_REAL, .unit = "1", SCENE(gate.most.waveform), .fallback = "5e-3", POSITIVE,
   .meaning = "anywhere in the period"},
  {"gate", "band", "", FIELD_REAL, .unit = "1", SCENE(gate.band), .fallback = "0", NOT_NEGATIVE,
   .meaning = "half width of the band of steady states, relative; 0: any, and the verdict says `family`"},
  {"gate", "nonlinear", "", CHOICE(nonlinear_names, gate.nonlinear), .fallback = "any",
   .meaning = "required: fail if no contact changes its state at any frequency; any: only say so"},
  {"gate", "proven", "", FIELD_FLAG, .unit = "", SCENE(gate.proven), .fallback = "false",
   .meaning = "fail unless each orbit is proven, and its error below gate.amplitude (hbmcheck prove)"},
  {"gate", "ranges", "", FIELD_REALS, .unit = "rad/time", SCENE(gate.ranges.ends), .fallback = "", POSITIVE,
   .meaning = "FROM, TO, ...: where the limits below hold, the last range first; in the sweep's unit"},
  {"gate", "range_amplitude", "", FIELD_REALS, .unit = "1", SCENE(gate.ranges.amplitude), .fallback = "", POSITIVE,
   .meaning = "instead of amplitude in the ranges: a limit for each; none: as elsewhere"},
  {"gate", "range_harmonic_1", "", FIELD_REALS, .unit = "1", SCENE(gate.ranges.harmonic_1), .fallback = "", POSITIVE,
   .meaning = "instead of harmonic_1 in the ranges: a limit for each; none: as elsewhere"},
  {"gate", "range_mean", "", FIELD_REALS, .unit = "1", SCENE(gate.ranges.mean), .fallback = "", POSITIVE,
   .meaning = "instead of mean in the ranges: a limit for each; none: as elsewhere"},
  {"gate", "range_waveform", "", FIELD_REALS, .unit = "1", SCENE(gate.ranges.waveform), .fallback = "", POSITIVE,
   .meaning = "instead of waveform in the ranges: a limit for each; none: as elsewhere"},
  {"gate", "iterations", "", FIELD_INTEGER, .unit = "1", SCENE(gate.iterations), .fallback = "0", WITHIN(0, 1e9),
   .meaning = "Newton iterations the whole response curve may take; 0: any number"},
  {"gate", "evaluations", "", FIELD_INTEGER, .unit = "1", SCENE(gate.evaluations), .fallback = "0", WITHIN(0, 1e9),
   .meaning = "contact force evaluations the whole response curve may take; 0: any number"},
};
/* clang-format on */

/* Fields that an earlier version had, and what does their work now. */
static const struct removed_field {
  const char *path, *instead;
} removed[] = {
    {"transient.richardson", "law: exact is nearer to the limit at less cost"},
};

enum { COUNT = sizeof table / sizeof *table, SECTIONS = sizeof sections / sizeof *sections };
_Static_assert((int)COUNT <= (int)FIELD_MAX, "case_reader keeps one place a field");
_Static_assert(offsetof(scene, omega_to) == offsetof(scene, omega_from) + sizeof(double),
               "FIELD_PAIR stores both at once");

bool field_is_of_law(const field *f, const scene_contact *c)
{
  const unsigned laws = f->laws ? f->laws : SCENE_LAWS(CONTACT_KINKED);
  return f->laws == SCENE_ANY_LAW || laws & SCENE_LAWS(c->kind);
}

int field_count(void) { return COUNT; }

const field *field_at(int i) { return &table[i]; }

int field_index(const field *f) { return (int)(f - table); }

const field *field_rival(const field *f, int i)
{
  for (int k = 0; k < COUNT && f->group; ++k) {
    const field *other = &table[k];
    if (other == f || !other->group || strcmp(other->section, f->section) || strcmp(other->group, f->group)) continue;
    if (i-- == 0) return other;
  }
  return NULL;
}

const field_section *field_section_at(int i) { return i < SECTIONS ? &sections[i] : NULL; }

static bool same(const char *word, const char *name, size_t length)
{
  return strlen(word) == length && memcmp(word, name, length) == 0;
}

const field_section *field_find_section(const char *name, size_t length)
{
  for (int i = 1; i < SECTIONS; ++i)
    if (same(sections[i].name, name, length)) return &sections[i];
  return NULL;
}

const field *field_find(const char *section, const char *name, size_t length)
{
  for (int i = 0; i < COUNT; ++i)
    if (!strcmp(table[i].section, section) && same(table[i].name, name, length)) return &table[i];
  return NULL;
}

const char *field_path(const field *f, int j, char path[FIELD_PATH])
{
  message m;
  message_start(&m, path, FIELD_PATH);
  message_add(&m, "%.*s", (int)strcspn(f->section, "["), f->section);
  if (field_is_in_list(f) && j >= 0) message_add(&m, "[%d]", j);
  else if (field_is_in_list(f)) message_add(&m, "[]");
  message_add(&m, "%s%s", *f->section ? "." : "", f->name);
  return path;
}

/* ---- what was meant ---- */

bool field_was_removed(message *m, const char *path, size_t length)
{
  for (size_t i = 0; i < sizeof removed / sizeof *removed; ++i) {
    if (strlen(removed[i].path) != length || memcmp(removed[i].path, path, length)) continue;
    message_add(m, "%s was removed: %s", removed[i].path, removed[i].instead);
    return true;
  }
  return false;
}

enum { FAR = NEAREST_FAR };

suggestion suggest_key(const char *section, const char *key, size_t length)
{
  suggestion best = {0};
  int best_cost = FAR;
  const field_section *s;
  for (int i = 1; (s = field_section_at(i)) != NULL; ++i) {
    int d = nearest_distance(key, length, s->name), cost = 2 * d + (*section != '\0');
    if (cost < best_cost && (!*section || d == 0)) best = (suggestion){.s = s}, best_cost = cost;
  }
  for (int i = 0; i < field_count(); ++i) {
    const field *f = field_at(i);
    bool here = !strcmp(f->section, section);
    if (!here && f->flags & FIELD_STRUCTURE) continue; /* few cases have one */
    bool symbol = *f->symbol && strlen(f->symbol) == length && !memcmp(key, f->symbol, length);
    int d = symbol ? 0 : nearest_distance(key, length, f->name), cost = 2 * d + !here;
    if (cost < best_cost && (here ? d : 2 * d) <= 2) best = (suggestion){.f = f}, best_cost = cost;
  }
  return best;
}

suggestion suggest_path(const char *path, size_t length)
{
  const char *point = memchr(path, '.', length); /* the first: structure.damping.modal */
  const size_t dot = point ? (size_t)(point - path) + 1 : 0;
  if (dot == 0) return suggest_key("", path, length);
  size_t stem = dot - 1;
  const char *index = memchr(path, '[', stem);
  if (index) stem = (size_t)(index - path);
  suggestion section = suggest_key("", path, stem);
  const char *name = section.s ? section.s->name : "";
  if (index && !strcmp(name, "forcing")) name = "forcing[]";
  const field *f = field_find(name, path + dot, length - dot);
  if (f) return (suggestion){.f = f};
  return suggest_key(name, path + dot, length - dot);
}
