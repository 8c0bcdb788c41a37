/* variations.h - the monodromy matrix of a period of the exact law, from one change of contact state to the next. In a
 * phase (phase.h) a variation of the motion obeys a linear equation with constant coefficients,
 *     dX'' + c dX' + k dX = sum_j (dP'/dW_j) dW_j,     dW_j constant where contact j sticks,
 * whose solution is known in closed form; the force is continuous, so the saltation matrix of a transition is the
 * identity. libm only. */
#ifndef HC_VARIATIONS_H
#define HC_VARIATIONS_H

#include "timeint/phase.h"

typedef struct variations {
  int n;          /* states of the scaled model */
  double theta;   /* up to which `matrix` has come */
  double *matrix; /* [n][n] by columns, the owner's; a slider's row is valid while its contact sticks */
} variations;

/* The identity at theta = 0, in the phase that begins there. */
void variations_begin(variations *v, const phase *ph);

/* On to theta in the phase *ph. */
void variations_advance(variations *v, const phase *ph, double theta);

/* The phase has changed at v->theta: rows of the sliders that stick now and did not in *before. */
void variations_stick(variations *v, const phase *ph, const phase *before);

/* On to theta = 2 pi, the end of the period; monodromy[n * n] with the rows of sliders that are tied to X. */
void variations_end(variations *v, const phase *ph, double *monodromy);

#endif
