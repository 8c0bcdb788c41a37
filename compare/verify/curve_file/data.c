/* data.c - see csv.h: the points of a curve, from arrays. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/constants.h"
#include "base/message.h"
#include "compare/verify/curve_file/csv.h"

verify_fault verify_point_convert(const verify_quantity *q, bool cycles, verify_point *p)
{
  if (!verify_quantity_signed(q) && !(p->value >= 0)) return VERIFY_NEGATIVE;
  if (cycles) p->omega *= TWO_PI;
  p->value = verify_quantity_from_column(q, p->value);
  if (!isfinite(p->omega)) return VERIFY_OMEGA_TOO_LARGE;
  return isfinite(p->value) ? VERIFY_FINE : VERIFY_VALUE_TOO_LARGE;
}

/* Point i into *p, which the message is about if it is none. */
static hc_status convert(const verify_quantity *q, int i, verify_point *p, message *m)
{
  const double omega = p->omega, value = p->value;
  char name[VERIFY_QUANTITY_TEXT];
  if (!isfinite(omega)) message_add(m, "omega[%d] = %g is not finite, expected a number", i, omega);
  else if (!isfinite(value))
    message_add(m, "value[%d] = %g is not finite, expected %s", i, value, verify_quantity_name(q, name));
  else switch (verify_point_convert(q, false, p)) {
    case VERIFY_FINE: return HC_OK;
    case VERIFY_NEGATIVE:
      message_add(m, "value[%d] = %g is too small, expected a number >= 0", i, value);
      if (!q->decibel) message_add(m, "; is it in dB? Name it dB, or dB_ and the quantity");
      break;
    case VERIFY_OMEGA_TOO_LARGE: message_add(m, "omega[%d] = %g is too large, expected a number", i, omega); break;
    case VERIFY_VALUE_TOO_LARGE: message_add(m, "value[%d] = %g is too large, expected a number", i, value); break;
    }
  return HC_BAD_INPUT;
}

static hc_status read_quantity(const char *name, double noise, verify_quantity *q, message *m)
{
  if (!(noise >= 0 && noise <= 1))
    message_add(m, "noise = %g is no scatter, expected a number from 0 to 1 such as 1e-2", noise);
  else if (!verify_quantity_read(name, strlen(name), q)) {
    message_add(m, "quantity '");
    message_add_input(m, name, strlen(name), 60);
    message_add(m, "' is unknown, expected one of %s", verify_quantity_names);
  }
  return m->used ? HC_BAD_INPUT : HC_OK;
}

static hc_status read_points(int n, const double *omega, const double *value, verify_data *out, message *m)
{
  if (n > VERIFY_MOST_POINTS) {
    message_add(m, "%d points, expected at most %d", n, VERIFY_MOST_POINTS);
    return HC_BAD_INPUT;
  }
  out->points = malloc((n > 0 ? (size_t)n : 1) * sizeof *out->points);
  if (!out->points) {
    message_add(m, "%s", hc_status_text(HC_NO_MEMORY));
    return HC_NO_MEMORY;
  }
  for (int i = 0; i < n; ++i) {
    verify_point p = {.omega = omega[i], .value = value[i], .line = i + 1};
    hc_status st = convert(&out->quantity, i, &p, m);
    if (st != HC_OK) return st;
    if (p.omega > 0) out->points[out->n++] = p;
    else ++out->left_out;
  }
  if (out->n >= VERIFY_LEAST_POINTS) return HC_OK;
  message_add(m, "%d point%s%s, expected at least %d", out->n, out->n == 1 ? "" : "s",
              out->left_out ? " at omega > 0" : "", VERIFY_LEAST_POINTS);
  return HC_BAD_INPUT;
}

hc_status verify_data_of(const char *quantity, double noise, int n, const double *omega, const double *value,
                         verify_data *out, char *words)
{
  message m;
  message_start(&m, words, VERIFY_TEXT);
  *out = (verify_data){.noise = noise};
  hc_status st = read_quantity(quantity, noise, &out->quantity, &m);
  return st == HC_OK ? read_points(n, omega, value, out, &m) : st;
}

void verify_data_clear(verify_data *d)
{
  free(d->points);
  *d = (verify_data){0};
}
