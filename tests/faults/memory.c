/* memory.c - see memory.h. Under gcc's address sanitizer the real functions are the sanitizer's, so that it still
 * sees every leak and overrun; else glibc's. strdup is here because the sanitizer's does not come through malloc. */
#include "tests/faults/memory.h"

#include <cvodes/cvodes.h>
#include <errno.h>
#include <fftw3.h>
#include <kinsol/kinsol.h>
#include <nvector/nvector_serial.h>
#include <stdatomic.h>
#include <stddef.h>
#include <string.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

static atomic_long asked, refused;
static long first; /* written while one thread runs */
static memory_mode how;
static _Thread_local int sheltered;

void memory_fail(long n, memory_mode mode)
{
  first = n;
  how = mode;
  atomic_store(&asked, 0);
  atomic_store(&refused, 0);
}

long memory_asked(void) { return atomic_load(&asked); }
long memory_refused(void) { return atomic_load(&refused); }

static bool refuse(void)
{
  if (sheltered) return false;
  long n = atomic_fetch_add(&asked, 1) + 1;
  if (first == 0 || (how == MEMORY_ONE ? n != first : n < first)) return false;
  atomic_fetch_add(&refused, 1);
  errno = ENOMEM;
  return true;
}

#if defined __SANITIZE_ADDRESS__
#define REAL(name) __interceptor_##name
#else
#define REAL(name) __libc_##name
#endif
void *REAL(malloc)(size_t);
void *REAL(calloc)(size_t, size_t);
void *REAL(realloc)(void *, size_t);
void *REAL(memalign)(size_t, size_t);

void *malloc(size_t n) { return refuse() ? NULL : REAL(malloc)(n); }
void *calloc(size_t n, size_t size) { return refuse() ? NULL : REAL(calloc)(n, size); }
void *realloc(void *p, size_t n) { return refuse() ? NULL : REAL(realloc)(p, n); }
void *memalign(size_t align, size_t n);
void *memalign(size_t align, size_t n) { return refuse() ? NULL : REAL(memalign)(align, n); }
void *aligned_alloc(size_t align, size_t n) { return refuse() ? NULL : REAL(memalign)(align, n); }
int posix_memalign(void **p, size_t align, size_t n)
{
  return refuse() || !(*p = REAL(memalign)(align, n)) ? ENOMEM : 0;
}

char *strdup(const char *text)
{
  size_t bytes = strlen(text) + 1;
  char *copy = malloc(bytes);
  return copy ? memcpy(copy, text, bytes) : NULL;
}

/* Calls that crash without memory, by the linker's --wrap (CMakeLists.txt has the list, and numerics/room.h the
 * reasons): some where one allocation fails, some of SUNDIALS 7 only where all do. */
#define SHELTERED_IF(crashes, type, name, parameters, arguments)                                                       \
  type __real_##name parameters;                                                                                       \
  type __wrap_##name parameters;                                                                                       \
  type __wrap_##name parameters                                                                                        \
  {                                                                                                                    \
    const int shelter = (crashes);                                                                                     \
    sheltered += shelter;                                                                                              \
    type answer = __real_##name arguments;                                                                             \
    sheltered -= shelter;                                                                                              \
    return answer;                                                                                                     \
  }
#define SHELTERED(type, name, parameters, arguments) SHELTERED_IF(true, type, name, parameters, arguments)
#define SHELTERED_FROM_ALL(type, name, parameters, arguments)                                                          \
  SHELTERED_IF(how == MEMORY_ALL_FROM, type, name, parameters, arguments)

SHELTERED(fftw_plan, fftw_plan_dft_c2r_1d, (int n, fftw_complex *from, double *to, unsigned flags),
          (n, from, to, flags))
SHELTERED(fftw_plan, fftw_plan_dft_r2c_1d, (int n, double *from, fftw_complex *to, unsigned flags),
          (n, from, to, flags))
SHELTERED(int, KINInit, (void *kin, KINSysFn f, N_Vector v), (kin, f, v))
SHELTERED(int, KINSetLinearSolver, (void *kin, SUNLinearSolver ls, SUNMatrix a), (kin, ls, a))
SHELTERED(int, CVodeInit, (void *cv, CVRhsFn f, sunrealtype t, N_Vector y), (cv, f, t, y))
SHELTERED(int, CVodeSetLinearSolver, (void *cv, SUNLinearSolver ls, SUNMatrix a), (cv, ls, a))
SHELTERED(int, CVode, (void *cv, sunrealtype to, N_Vector y, sunrealtype *t, int task), (cv, to, y, t, task))
SHELTERED(int, CVodeSensSStolerances, (void *cv, sunrealtype relative, sunrealtype *absolute), (cv, relative, absolute))
SHELTERED(int, CVodeSensInit, (void *cv, int n, int method, CVSensRhsFn f, N_Vector *s), (cv, n, method, f, s))
SHELTERED(N_Vector *, N_VCloneVectorArray, (int n, N_Vector v), (n, v))
#if SUNDIALS_VERSION_MAJOR >= 7
SHELTERED(SUNErrCode, SUNContext_Create, (SUNComm comm, SUNContext *ctx), (comm, ctx))
SHELTERED_FROM_ALL(N_Vector, N_VNew_Serial, (sunindextype n, SUNContext ctx), (n, ctx))
SHELTERED_FROM_ALL(SUNMatrix, SUNDenseMatrix, (sunindextype rows, sunindextype columns, SUNContext ctx),
                   (rows, columns, ctx))
SHELTERED_FROM_ALL(SUNLinearSolver, SUNLinSol_Dense, (N_Vector y, SUNMatrix a, SUNContext ctx), (y, a, ctx))
SHELTERED_FROM_ALL(SUNLinearSolver, SUNLinSolNewEmpty, (SUNContext ctx), (ctx))
SHELTERED_FROM_ALL(void *, KINCreate, (SUNContext ctx), (ctx))
SHELTERED_FROM_ALL(void *, CVodeCreate, (int method, SUNContext ctx), (method, ctx))
SHELTERED_FROM_ALL(int, CVodeRootInit, (void *cv, int n, CVRootFn g), (cv, n, g))
#else
SHELTERED(int, SUNContext_Create, (void *comm, SUNContext *ctx), (comm, ctx))
#endif
