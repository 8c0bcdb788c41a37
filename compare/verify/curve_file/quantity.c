/* quantity.c - see quantity.h. */
#include "compare/verify/curve_file/quantity.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "numerics/base/number.h"
#include "numerics/series.h"

static const struct {
  const char *name;
  bool of_mean;
} kinds[] = {
#define VERIFY_KIND_WORDS(code, name, free, formula) {name, free},
    VERIFY_KIND_LIST(VERIFY_KIND_WORDS)
#undef VERIFY_KIND_WORDS
};

const char verify_quantity_names[] =
    "amplitude, double_amplitude, peak, max, min, mean, rms, norm, norm_over_root_2, harmonic_K, velocity, "
    "acceleration, velocity_harmonic_K, acceleration_harmonic_K, or dB of one like dB_harmonic_1";

/* ---- names ---- */

static bool has_harmonic(verify_kind k)
{
  return k == KIND_HARMONIC || k == KIND_VELOCITY_HARMONIC || k == KIND_ACCELERATION_HARMONIC;
}

static bool is_kind(verify_kind k, const char *text, size_t length, verify_quantity *out)
{
  const size_t name = strlen(kinds[k].name);
  int harmonic = 0;
  if (length < name || memcmp(text, kinds[k].name, name)) return false;
  if (!has_harmonic(k)) return length == name && (*out = (verify_quantity){.kind = k}, true);
  for (size_t i = name; i < length; ++i) /* digits only: no sign */
    if (text[i] < '0' || text[i] > '9') return false;
  if (number_read_integer(text + name, length - name, &harmonic) != NUMBER_FINE) return false;
  if (harmonic > VERIFY_MOST_HARMONIC) return false;
  *out = (verify_quantity){.kind = k, .harmonic = harmonic};
  return true;
}

bool verify_quantity_read(const char *text, size_t length, verify_quantity *out)
{
  const bool decibel = length >= 2 && (text[0] == 'd' || text[0] == 'D') && text[1] == 'B';
  if (decibel && length == 2) {
    *out = (verify_quantity){.kind = KIND_AMPLITUDE, .decibel = true};
    return true;
  }
  if (decibel && text[2] != '_') return false;
  const size_t prefix = decibel ? 3 : 0;
  for (int k = 0; k <= KIND_ACCELERATION_HARMONIC; ++k) {
    if (!is_kind((verify_kind)k, text + prefix, length - prefix, out)) continue;
    out->decibel = decibel;
    return true;
  }
  return false;
}

const char *verify_quantity_name(const verify_quantity *q, char text[VERIFY_QUANTITY_TEXT])
{
  const char *decibel = q->decibel ? "dB_" : "";
  if (has_harmonic(q->kind)) snprintf(text, VERIFY_QUANTITY_TEXT, "%s%s%d", decibel, kinds[q->kind].name, q->harmonic);
  else snprintf(text, VERIFY_QUANTITY_TEXT, "%s%s", decibel, kinds[q->kind].name);
  return text;
}

bool verify_quantity_same(const verify_quantity *a, const verify_quantity *b)
{
  return a->kind == b->kind && a->harmonic == b->harmonic && a->decibel == b->decibel;
}

const char *verify_quantity_refused_of_structure(const verify_quantity *q)
{
  if (q->kind != KIND_ACCELERATION) return NULL;
  return "acceleration is known of one degree of freedom alone; of a structure take acceleration_harmonic_1, or "
         "velocity";
}

bool verify_quantity_signed(const verify_quantity *q)
{
  return q->decibel || q->kind == KIND_MAX || q->kind == KIND_MIN || q->kind == KIND_MEAN;
}

bool verify_quantity_of_mean(const verify_quantity *q)
{
  return kinds[q->kind].of_mean || (has_harmonic(q->kind) && q->harmonic == 0);
}

/* ---- values ---- */

verify_motion verify_motion_of(double omega, int n_harm, const double *X)
{
  verify_motion m = {.omega = omega, .n_harm = n_harm, .X = X};
  series_extrema(n_harm, X, &m.max, &m.min);
  return m;
}

/* (max - min)/2 of the derivative of order 1 or 2 with respect to time. */
static double rate_amplitude(const verify_motion *m, int order)
{
  if (m->rates[order - 1] > 0) return m->rates[order - 1];
  double rate[2 * VERIFY_MOST_HARMONIC + 1] = {0}, high, low;
  for (int k = 1; k <= m->n_harm; ++k) {
    const double a = m->X[2 * k - 1], b = m->X[2 * k], kw = k * m->omega;
    rate[2 * k - 1] = order == 1 ? kw * b : -kw * kw * a;
    rate[2 * k] = order == 1 ? -kw * a : -kw * kw * b;
  }
  series_extrema(m->n_harm, rate, &high, &low);
  return 0.5 * (high - low);
}

void verify_motion_find_rates(verify_motion *m)
{
  for (int order = 1; order <= 2; ++order) m->rates[order - 1] = rate_amplitude(m, order);
}

static double modulus(const verify_motion *m, int k)
{
  if (k == 0) return fabs(m->X[0]);
  return k <= m->n_harm ? hypot(m->X[2 * k - 1], m->X[2 * k]) : 0;
}

/* sum over k >= 1 of modulus^power, power 1 or 2 */
static double sum_of(const verify_motion *m, int power)
{
  double sum = 0;
  for (int k = 1; k <= m->n_harm; ++k) {
    const double r = modulus(m, k);
    sum += power == 1 ? r : r * r;
  }
  return sum;
}

double verify_quantity_of(const verify_quantity *q, const verify_motion *m)
{
  const double mean = m->X[0], k = q->harmonic;
  switch (q->kind) {
  case KIND_AMPLITUDE: return 0.5 * (m->max - m->min);
  case KIND_DOUBLE_AMPLITUDE: return m->max - m->min;
  case KIND_PEAK: return fmax(fabs(m->max), fabs(m->min));
  case KIND_MAX: return m->max;
  case KIND_MIN: return m->min;
  case KIND_MEAN: return mean;
  case KIND_RMS: return sqrt(mean * mean + sum_of(m, 2) / 2);
  case KIND_NORM: return sqrt(mean * mean + sum_of(m, 2));
  case KIND_VELOCITY: return rate_amplitude(m, 1);
  case KIND_ACCELERATION: return rate_amplitude(m, 2);
  case KIND_HARMONIC: return modulus(m, q->harmonic);
  case KIND_VELOCITY_HARMONIC: return k * m->omega * modulus(m, q->harmonic);
  case KIND_ACCELERATION_HARMONIC: return k * m->omega * k * m->omega * modulus(m, q->harmonic);
  case KIND_RMS_ALTERNATING: return sqrt(sum_of(m, 2) / 2);
  case KIND_RMS_NLVIB: return sqrt((mean * mean + sum_of(m, 2)) / 2);
  case KIND_NORM_ALTERNATING: return sqrt(sum_of(m, 2));
  case KIND_SUM_OF_MODULI: return sum_of(m, 1);
  case KIND_SUM_WITH_MEAN: return fabs(mean) + sum_of(m, 1);
  case KIND_COSINE: return m->n_harm ? fabs(m->X[1]) : 0;
  case KIND_SINE: return m->n_harm ? fabs(m->X[2]) : 0;
  case KIND_PEAK_OF_HARMONIC: return fabs(mean) + modulus(m, 1);
  case VERIFY_KINDS: break;
  }
  return NAN;
}

double verify_quantity_scale(const verify_quantity *q, const verify_motion *m)
{
  const double amplitude = 0.5 * (m->max - m->min);
  switch (q->kind) {
  case KIND_VELOCITY:
  case KIND_VELOCITY_HARMONIC: return rate_amplitude(m, 1);
  case KIND_ACCELERATION:
  case KIND_ACCELERATION_HARMONIC: return rate_amplitude(m, 2);
  case KIND_DOUBLE_AMPLITUDE: return 2 * amplitude;
  default: return amplitude;
  }
}

double verify_quantity_from_column(const verify_quantity *q, double number)
{
  return q->decibel ? pow(10, number / 20) : number;
}

double verify_quantity_to_column(const verify_quantity *q, double value)
{
  return q->decibel ? 20 * log10(fabs(value)) : value;
}
