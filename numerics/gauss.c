/* gauss.c - see gauss.h. */
#include "numerics/gauss.h"

enum { HALF = GAUSS_POINTS / 2 };
static const double node[HALF] = {0.09501250983763744, 0.28160355077925891, 0.45801677765722739, 0.61787624440264375,
                                  0.75540440835500303, 0.86563120238783174, 0.94457502307323258, 0.98940093499164993};
static const double weight[HALF] = {0.18945061045506850, 0.18260341504492359, 0.16915651939500254, 0.14959598881657673,
                                    0.12462897125553387, 0.09515851168249278, 0.06225352393864789, 0.02715245941175409};

double gauss_node(int i) { return i < HALF ? -node[HALF - 1 - i] : node[i - HALF]; }
double gauss_weight(int i) { return weight[i < HALF ? HALF - 1 - i : i - HALF]; }

static void add_panel(gauss_functions *f, const void *self, double middle, double half, double sum[2])
{
  for (int i = 0; i < HALF; ++i) {
    double left[2], right[2];
    f(self, middle - half * node[i], left);
    f(self, middle + half * node[i], right);
    for (int k = 0; k < 2; ++k) sum[k] += half * weight[i] * (left[k] + right[k]);
  }
}

void gauss_integrals(gauss_functions *f, const void *self, double from, double to, int n_panels, double sum[2])
{
  const double half = 0.5 * (to - from) / n_panels;
  sum[0] = sum[1] = 0;
  for (int i = 0; i < n_panels; ++i) add_panel(f, self, from + (2 * i + 1) * half, half, sum);
}
