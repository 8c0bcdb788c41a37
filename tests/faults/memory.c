/* memory.c - see memory.h. Under gcc's address sanitizer the real functions are the sanitizer's, so that it still
 * sees every leak and overrun; else glibc's. strdup is here because the sanitizer's does not come through malloc. */
#include "tests/faults/memory.h"
#include "tests/wrap.h"

#include <cvodes/cvodes.h>
#include <dlfcn.h>
#include <errno.h>
#include <fftw3.h>
#include <kinsol/kinsol.h>
#include <malloc.h>
#include <nvector/nvector_serial.h>
#include <pthread.h>
#include <stdatomic.h>
#include <string.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

static atomic_long asked, refused, in_use, peak; /* the last two: bytes since memory_fail */
static long first;                               /* written while one thread runs; MEMORY_LIMIT: bytes */
static memory_mode how;
static atomic_bool limited; /* MEMORY_LIMIT: from the first call on that is sheltered else */
static _Thread_local int sheltered;

void memory_fail(long n, memory_mode mode)
{
  first = n;
  how = mode;
  atomic_store(&asked, 0);
  atomic_store(&refused, 0);
  atomic_store(&in_use, 0);
  atomic_store(&peak, 0);
  atomic_store(&limited, false);
}

/* What is in use now is where the limit counts from. */
static void start_limit(void)
{
  if (atomic_exchange(&limited, true)) return;
  atomic_store(&in_use, 0);
  atomic_store(&peak, 0);
}

long memory_asked(void) { return atomic_load(&asked); }
long memory_refused(void) { return atomic_load(&refused); }
long memory_peak(void) { return atomic_load(&peak); }

/* At an allocation of so many bytes more. */
static bool refuse(size_t bytes)
{
  if (sheltered) return false;
  long n = atomic_fetch_add(&asked, 1) + 1;
  if (first == 0 || (how == MEMORY_ONE && n != first) || (how == MEMORY_ALL_FROM && n < first)) return false;
#if defined __SANITIZE_ADDRESS__
  if (how == MEMORY_LIMIT) return false;
#endif
  if (how == MEMORY_LIMIT && !limited) return false;
  if (how == MEMORY_LIMIT && bytes < (size_t)PTRDIFF_MAX && atomic_load(&in_use) + (long)bytes <= first) return false;
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
void REAL(free)(void *);

#if defined                                                                                                            \
    __SANITIZE_ADDRESS__ /* calls free before it is ready for us: bytes are not counted, and there is no limit */
#define SIZE_OF(p) ((size_t)0)
#else
#define SIZE_OF(p) malloc_usable_size(p)
#endif

static void count(long bytes)
{
  const long now = atomic_fetch_add(&in_use, bytes) + bytes;
  if (now > atomic_load(&peak)) atomic_store(&peak, now);
}

static void *counted(void *p)
{
  if (p) count((long)SIZE_OF(p));
  return p;
}

void *malloc(size_t n) { return refuse(n) ? NULL : counted(REAL(malloc)(n)); }
void *calloc(size_t n, size_t size) { return refuse(n * size) ? NULL : counted(REAL(calloc)(n, size)); }
void *realloc(void *p, size_t n)
{
  const size_t before = p ? SIZE_OF(p) : 0;
  if (refuse(n > before ? n - before : 0)) return NULL;
  void *moved = REAL(realloc)(p, n);
  if (moved || n == 0) count(-(long)before);
  return counted(moved);
}
void *memalign(size_t align, size_t n);
void *memalign(size_t align, size_t n) { return refuse(n) ? NULL : counted(REAL(memalign)(align, n)); }
void *aligned_alloc(size_t align, size_t n) { return memalign(align, n); }
int posix_memalign(void **p, size_t align, size_t n) { return (*p = memalign(align, n)) ? 0 : ENOMEM; }
#if !defined __SANITIZE_ADDRESS__
void free(void *p)
{
  if (p) count(-(long)SIZE_OF(p));
  REAL(free)(p);
}
#endif

#if defined __SANITIZE_ADDRESS__
/* The sanitizer asks this where a thread begins, and ends the program if there is no memory for the answer. */
int pthread_getattr_np(pthread_t thread, pthread_attr_t *attributes)
{
  int (*real)(pthread_t, pthread_attr_t *);
  ++sheltered;
  *(void **)&real = dlsym(RTLD_NEXT, "pthread_getattr_np");
  const int answer = real(thread, attributes);
  --sheltered;
  return answer;
}
#endif

char *strdup(const char *text)
{
  size_t bytes = strlen(text) + 1;
  char *copy = malloc(bytes);
  return copy ? memcpy(copy, text, bytes) : NULL;
}

/* Calls that crash without memory, by the linker's --wrap (CMakeLists.txt has the list, and numerics/room.h the
 * reasons): some where one allocation fails, some of SUNDIALS 7 only where all do. Under a limit nothing is sheltered:
 * hc_room_for has asked for more than such a call takes, and the call is not made. */
#define SHELTERED_IF(crashes, type, name, parameters, arguments)                                                       \
  WRAP(type, name, parameters)                                                                                         \
  {                                                                                                                    \
    const int shelter = (crashes) && how != MEMORY_LIMIT;                                                              \
    sheltered += shelter;                                                                                              \
    type answer = __real_##name arguments;                                                                             \
    sheltered -= shelter;                                                                                              \
    start_limit();                                                                                                     \
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
/* OpenBLAS 0.3.21 takes room for small products without a look at what malloc says. */
typedef const int *sizes;
typedef const double *entries;
WRAP(void, dgemm_,
     (const char *at, const char *bt, sizes m, sizes n, sizes k, entries alpha, entries a, sizes lda, entries b,
      sizes ldb, entries beta, double *c, sizes ldc, size_t one, size_t also_one))
{
  const int shelter = how != MEMORY_LIMIT;
  sheltered += shelter;
  __real_dgemm_(at, bt, m, n, k, alpha, a, lda, b, ldb, beta, c, ldc, one, also_one);
  sheltered -= shelter;
}
#if SUNDIALS_VERSION_MAJOR >= 7
SHELTERED(SUNErrCode, SUNContext_Create, (SUNComm comm, SUNContext *ctx), (comm, ctx))
SHELTERED_FROM_ALL(N_Vector, N_VNew_Serial, (sunindextype n, SUNContext ctx), (n, ctx))
SHELTERED_FROM_ALL(SUNMatrix, SUNDenseMatrix, (sunindextype rows, sunindextype columns, SUNContext ctx),
                   (rows, columns, ctx))
SHELTERED_FROM_ALL(SUNLinearSolver, SUNLinSol_Dense, (N_Vector y, SUNMatrix a, SUNContext ctx), (y, a, ctx))
SHELTERED_FROM_ALL(SUNLinearSolver, SUNLinSolNewEmpty, (SUNContext ctx), (ctx))
SHELTERED_FROM_ALL(SUNMatrix, SUNMatNewEmpty, (SUNContext ctx), (ctx))
SHELTERED_FROM_ALL(void *, KINCreate, (SUNContext ctx), (ctx))
SHELTERED_FROM_ALL(void *, CVodeCreate, (int method, SUNContext ctx), (method, ctx))
SHELTERED(int, KINSol, (void *kin, N_Vector u, int strategy, N_Vector u_scale, N_Vector f_scale),
          (kin, u, strategy, u_scale, f_scale))
SHELTERED_FROM_ALL(int, CVodeRootInit, (void *cv, int n, CVRootFn g), (cv, n, g))
#else
SHELTERED(int, SUNContext_Create, (void *comm, SUNContext *ctx), (comm, ctx))
#endif
