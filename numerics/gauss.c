/* gauss.c - see gauss.h. */
#include "numerics/gauss.h"

enum { HALF = GAUSS_POINTS / 2 };
static const double node[HALF] = {0.09501250983763744, 0.28160355077925891, 0.45801677765722739, 0.61787624440264375,
                                  0.75540440835500303, 0.86563120238783174, 0.94457502307323258, 0.98940093499164993};
static const double weight[HALF] = {0.18945061045506850, 0.18260341504492359, 0.16915651939500254, 0.14959598881657673,
                                    0.12462897125553387, 0.09515851168249278, 0.06225352393864789, 0.02715245941175409};
static const double few_nodes[GAUSS_FEW / 2] = {0.33998104358485626, 0.86113631159405258};
static const double few_weights[GAUSS_FEW / 2] = {0.65214515486254614, 0.34785484513745386};

double gauss_node(int points, int i)
{
  const double *of = points == GAUSS_FEW ? few_nodes : node;
  const int half = points / 2;
  return i < half ? -of[half - 1 - i] : of[i - half];
}

double gauss_weight(int points, int i)
{
  const double *of = points == GAUSS_FEW ? few_weights : weight;
  const int half = points / 2;
  return of[i < half ? half - 1 - i : i - half];
}

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
