/* signs.c - checks that the sequence of letters obeys the law. On every segment each contact must satisfy its
 * inequalities strictly inside. At an end a function may be exactly 0 (a guard vanishes there, or w is defined so);
 * then the derivative of the order of that zero must have a sign on a neighbourhood of the end. With these, the state
 * after a transition is the prescribed one, and every transition is transversal: the same inequalities say so just
 * before and after it. */
#include "proof/orbit.h"
#include <math.h>

enum { DEPTH = 62, PARTS = 20000, FEW = 12, FEW_DEPTH = 3 };

typedef struct condition {
  int contact;
  const char *words;
  int start, end; /* order of the zero that is allowed at either end; 0: none */
  arb_ptr row;    /* [3][size] G and its derivatives, as rows on Z */
} condition;

typedef struct sequence {
  pool pool;
  const orbit *o;
  int segment;
  failure *f;
  int n;
  condition conditions[3 * LIMIT_CONTACTS];
  arb_ptr rows;         /* [3 contacts][3][largest] */
  arb_ptr polynomial;   /* [degree + 1] */
  arb_ptr coefficients; /* [DEPTH + 2][3][degree + 1] G, at the start, at the end */
  double from, width;   /* the current substep, in time */
  long parts;
} sequence;

/* ---- which conditions ---- */

static arb_ptr new_row(sequence *q, int contact, const char *words, int start, int end)
{
  condition *c = &q->conditions[q->n];
  *c = (condition){contact, words, start, end, q->rows + (slong)q->n * 3 * q->o->largest};
  q->n++;
  return c->row;
}

/* row A */
static void derive(const orbit *o, const orbit_segment *s, arb_srcptr row, arb_ptr derivative)
{
  _arb_vec_zero(derivative, s->size);
  for (int i = 0; i < s->size; i++)
    if (!arb_is_zero(row + i))
      _arb_vec_scalar_addmul(derivative + s->first[i], arb_mat_entry(s->a, i, s->first[i]), s->length[i], row + i,
                             o->precision);
}

/* Stick after touching, with u and v proportional: both limits are exactly (mu kn -+ kt t/n)(v + gap), so the signs of
 * two constants and the gap's condition decide. In balls both ends would be 0/0. */
static bool inside_cone(const sequence *q, int contact)
{
  const slong precision = q->o->precision;
  const contact_balls *f = &q->o->friction[contact];
  LOCAL(arb) normal = {0}, tangential = {0};
  arb_mul(normal, f->mu, f->kn, precision);
  arb_mul(tangential, f->kt, f->ratio, precision);
  arb_abs(tangential, tangential);
  arb_sub(normal, normal, tangential, precision);
  const bool inside = arb_is_positive(normal), outside = arb_is_negative(normal);
  if (!inside && !outside)
    return refute(q->f, q->segment, contact, "edge of the cone: segment %d, contact %d", q->segment, contact);
  return inside || refute(q->f, q->segment, contact, "segment %d, contact %d, stick |T| < mu N: it is negative",
                          q->segment, contact);
}

static bool list_conditions(sequence *q)
{
  const orbit *o = q->o;
  const int i = q->segment;
  const orbit_segment *s = &o->segments[i];
  q->n = 0;
  for (int j = 0; j < o->contacts; j++) {
    const char letter = s->letters[j], before = orbit_letter(o, i - 1, j), after = orbit_letter(o, i + 1, j);
    const int sign = sign_of(letter), opened = before == 'O', opens = after == 'O';
    /* O: -(n.x + gap) > 0; simple zeros where it opened and where it closes. */
    if (letter == 'O') {
      row_gap(o, s, j, -1, new_row(q, j, "open n.x + gap < 0", before != 'O', after != 'O'));
      continue;
    }
    /* Closed, with a normal direction: n.x + gap > 0; simple zeros after O and before O. */
    if (o->c->contacts[j].normal) row_gap(o, s, j, 1, new_row(q, j, "closed n.x + gap > 0", opened, opens));
    /* Stick: mu N -+ kt (t.x - w) > 0, both. At the start from O: simple zeros, both. From slip s: double for s (value
     * by the definition of w, derivative by the guard), none for -s. At the end to slip s: simple for s. */
    if (letter == 'S' && s->began[j] >= 0 && s->from[j] == 'O' && o->friction[j].parallel) {
      if (!inside_cone(q, j)) return false;
    } else if (letter == 'S') {
      for (int side = 1; side >= -1; side -= 2) {
        const int start = opened ? 1 : before != 'S' && sign_of(before) == side ? 2 : 0;
        const int end = after != 'S' && sign_of(after) == side;
        row_limit(o, s, j, side, new_row(q, j, side > 0 ? "stick T < mu N" : "stick T > -mu N", start, end));
      }
    }
    /* Slip s: s kt t.v - mu kn n.v > 0; no zero at the start, not even from S or O; a simple one before stick. */
    if (sign) row_slip(o, s, j, sign, new_row(q, j, sign > 0 ? "slip +" : "slip -", 0, after == 'S'));
  }
  for (int c = 0; c < 2 * q->n; c++) {
    arb_ptr row = q->conditions[c / 2].row + c % 2 * o->largest;
    derive(o, s, row, row + o->largest);
  }
  return true;
}

/* ---- whether they hold ---- */

/* Replaces the failure by this one. Returns false. */
static bool ended(const sequence *q, const condition *c, double a, double b, const char *what)
{
  q->f->reason[0] = 0;
  q->f->from = q->from + a * q->width;
  q->f->to = q->from + b * q->width;
  return refute(q->f, q->segment, c->contact, "segment %d, t = %.9g to %.9g, contact %d, %s: %s", q->segment,
                q->f->from, q->f->to, c->contact, c->words, what);
}

/* Decides whether G > 0 on the part [a, b] of the substep, except allowed zeros at the segment's ends. Bernstein
 * coefficients at `level`: of G, of its derivative at the start (if `starts`), of that at the end (if `ends`). false:
 * negative somewhere. true with *decided false: not decided within `depth`, but no part is proven negative. */
static bool positive_on(sequence *q, const condition *c, int degree, int depth, int level, double a, double b,
                        bool starts, bool ends, bool *decided)
{
  const slong n = q->o->degree + 1;
  arb_ptr g = q->coefficients + 3 * n * level, left = g + 3 * n;
  const known_sign value = bernstein_side(g, degree), rises = starts ? bernstein_side(g + n, degree) : SIDE_BOTH,
                   falls = ends ? bernstein_side(g + 2 * n, degree) : SIDE_BOTH;
  if (value == SIDE_POSITIVE) return true; /* everywhere else: G > 0 */
  if (rises == SIDE_POSITIVE) return true; /* start, order p: G^(p) > 0 on [0, b] */
  if (falls == SIDE_NEGATIVE) return true; /* end, order 1: G' < 0 on [a, end], the longest possible */
  if (value == SIDE_NEGATIVE || rises == SIDE_NEGATIVE || falls == SIDE_POSITIVE)
    return ended(q, c, a, b, "it is negative");
  if (level == depth || ++q->parts > PARTS) {
    if (*decided) ended(q, c, a, b, "sign not decided");
    *decided = false;
    return true;
  }
  const double middle = 0.5 * (a + b);
  for (int k = 0; k < 3; k++)
    if (k == 0 || (k == 1 ? starts : ends))
      bernstein_halve(g + k * n, left + k * n, g + k * n, degree, q->o->precision);
  if (!positive_on(q, c, degree, depth, level + 1, a, middle, starts, false, decided)) return false;
  _arb_vec_swap(left, g, 3 * n); /* the right half: its coefficients move one level down */
  return positive_on(q, c, degree, depth, level + 1, middle, b, false, ends, decided);
}

static bool holds_on_substep(sequence *q, const walk *w, const condition *c)
{
  /* attempts: constant term only, low degree, full degree */
  static const int degrees[] = {0, FEW, 1 << 20}, depths[] = {0, FEW_DEPTH, DEPTH};
  const orbit *o = q->o;
  const slong n = o->degree + 1;
  const bool starts = c->start && w->k == 0, ends = c->end && w->k == w->steps - 1;
  LOCAL(mag) rest = {0};
  for (int attempt = 0; attempt < 3; attempt++) {
    const int degree = degrees[attempt] < w->degree ? degrees[attempt] : w->degree;
    bool decided = true;
    for (int k = 0; k < 3; k++) {
      const int order = k == 0 ? 0 : k == 1 ? c->start : 1;
      if (k > 0 && !(k == 1 ? starts : ends)) continue;
      walk_polynomial(w, c->row + order * o->largest, q->polynomial, rest);
      bernstein(q->coefficients + k * n, q->polynomial, w->degree, degree, rest, o->precision);
    }
    if (!positive_on(q, c, degree, depths[attempt], 0, 0, 1, starts, ends, &decided)) return false;
    if (decided) return true;
    if (attempt < 2) *q->f = (failure){.segment = -1, .contact = -1, .from = NAN, .to = NAN};
  }
  return false;
}

static bool segment_holds(sequence *q)
{
  const orbit *o = q->o;
  walk w;
  if (!list_conditions(q)) return false;
  q->parts = 0;
  q->from = arf_get_d(arb_midref(orbit_event(o, q->segment) + 2 * o->n), ARF_RND_NEAR);
  bool holds = true;
  walk_start(&w, o, q->segment);
  while (holds && walk_next(&w)) {
    q->width = arf_get_d(arb_midref(w.width), ARF_RND_NEAR);
    for (int c = 0; c < q->n && holds; c++) holds = holds_on_substep(q, &w, &q->conditions[c]);
    q->from += q->width;
  }
  walk_end(&w);
  return holds;
}

bool sequence_check(const orbit *o, failure *f)
{
  sequence *q = flint_calloc(1, sizeof *q);
  q->o = o;
  q->f = f;
  q->rows = pool_balls(&q->pool, 9L * (o->contacts + 1) * o->largest);
  q->polynomial = pool_balls(&q->pool, o->degree + 1);
  q->coefficients = pool_balls(&q->pool, 3L * (DEPTH + 2) * (o->degree + 1));
  bool holds = true;
  LOCAL(arb) left = {0}, span = {0};
  for (int i = 0; i < o->m && holds; i++) {
    const orbit_segment *s = &o->segments[i];
    flow_duration(o, i, left);
    arb_sub(span, s->span, s->step, o->precision); /* all substeps but the last are in the segment, too */
    if (!arb_is_positive(left) || !arb_gt(left, span)) holds = refute(f, i, -1, "times not in order: segment %d", i);
  }
  for (q->segment = 0; q->segment < o->m && holds; q->segment++) holds = segment_holds(q);
  pool_clear(&q->pool);
  flint_free(q);
  return holds;
}
