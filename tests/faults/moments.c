/* moments.c - see moments.h. The functions are wrapped by the linker (hbmcheck_moments in tests/CMakeLists.txt);
 * pwrite64, by which SQLite writes, is this program's own, and so comes before the C library's. */
#include "tests/faults/moments.h"

#include <cvodes/cvodes.h>
#include <signal.h>
#include <sys/syscall.h>
#include <sys/types.h>
#include <unistd.h>

#include "compare/output/output.h"
#include "compare/study/store.h"
#include "hbm/forces/contact_forces.h"
#include "numerics/workers.h"
#include "tests/wrap.h"

enum { HANGS = 600 /* [s] of a child, to end hangs */ };

static atomic_long passed;
static long expected; /* written while one thread runs, as are the next two */
static void (*act)(void *);
static void *acts_on;

/* After a signal: threads beside the first one stand still until the command has stopped them. */
static pthread_t first;
static pthread_mutex_t gate = PTHREAD_MUTEX_INITIALIZER;
static pthread_cond_t opened = PTHREAD_COND_INITIALIZER;
static bool closed; /* under the gate's lock */

void moments_expect(long n, void (*what)(void *self), void *self)
{
  expected = n;
  act = what;
  acts_on = self;
  first = pthread_self();
  atomic_store(&passed, 0);
}

static void set_gate(bool to)
{
  pthread_mutex_lock(&gate);
  closed = to;
  pthread_cond_broadcast(&opened);
  pthread_mutex_unlock(&gate);
}

typedef struct order {
  const char *line;
  int number;
  long n;
} order;

static void raise_ordered(void *self)
{
  const order *what = self;
  set_gate(true);
  raise(what->number);
}

static int obey(void *self)
{
  const order *what = self;
  if (what->number) signal(what->number, SIG_DFL); /* who started the tests may ignore it */
  moments_expect(what->n, raise_ordered, self);
  return child_command(what->line);
}

void moments_run(const char *line, int number, long n, outcome *o)
{
  order what = {line, number, n};
  child_run(obey, &what, HANGS, o);
}

static void moment(void)
{
  long n = atomic_fetch_add(&passed, 1) + 1;
  if (child_count) *child_count = n;
  if (n == expected) act(acts_on);
  if (pthread_equal(first, pthread_self())) return;
  pthread_mutex_lock(&gate);
  while (closed) pthread_cond_wait(&opened, &gate);
  pthread_mutex_unlock(&gate);
}

#define MOMENT(type, name, parameters, arguments)                                                                      \
  WRAP(type, name, parameters)                                                                                         \
  {                                                                                                                    \
    moment();                                                                                                          \
    return __real_##name arguments;                                                                                    \
  }

MOMENT(hc_status, contact_forces_eval,
       (contact_forces * f, const double *X, double *F, bool derive, contact_report *report), (f, X, F, derive, report))
MOMENT(int, CVode, (void *cv, sunrealtype to, N_Vector y, sunrealtype *t, int task), (cv, to, y, t, task))
MOMENT(hc_status, output_open, (const char *path, output **out), (path, out))
MOMENT(hc_status, output_commit, (output * o), (o))
MOMENT(hc_status, study_store_put, (study_store * store, const study_result *r), (store, r))

WRAP(void, workers_stop, (workers * w, hc_status why))
{
  __real_workers_stop(w, why);
  set_gate(false);
}

ssize_t pwrite64(int fd, const void *bytes, size_t n, off_t at);
ssize_t pwrite64(int fd, const void *bytes, size_t n, off_t at)
{
  moment();
  return syscall(SYS_pwrite64, fd, bytes, n, at);
}
