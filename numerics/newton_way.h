/* newton_way.h - how the linear equations of a Newton step are solved. */
#ifndef HC_NEWTON_WAY_H
#define HC_NEWTON_WAY_H

#include <stdbool.h>

typedef enum newton_way {
  NEWTON_AUTO,      /* by the number of unknowns and the BLAS at hand: newton_linear.c has the limits and why */
  NEWTON_OWN_LU,    /* lu.h */
  NEWTON_LAPACK_LU, /* dgetrf */
  NEWTON_KRYLOV     /* SPGMR, preconditioned by the factors made last */
} newton_way;

/* What has been done since it was made. */
typedef struct newton_work {
  newton_way way;      /* never NEWTON_AUTO */
  bool lapack;         /* factors are LAPACK's */
  long factored;       /* factorisations */
  long krylov, rounds; /* solves by SPGMR, and iterations in them all */
  long krylov_failed;  /* of these solves: the matrix was factored instead */
} newton_work;

#endif
