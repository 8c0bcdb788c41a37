/* cluster_mpi.c - cluster.h by MPI. A rank asks (empty message), rank 0 answers with some scenes' numbers, none when
 * there are no more; a result travels as bytes (study_result_pack), the program being the same everywhere. Messages
 * of a rank arrive in order, so its results are there before its next question. Only the main thread calls MPI. */
#include <mpi.h>
#include <stdlib.h>

#include "compare/study/cluster.h"

enum { TAG_ASK = 1, TAG_SCENES, TAG_RESULT, HANDFUL = 8 };

/* One process has one place in MPI's world. */
static int at_work; /* rank 0: how many ranks have not been told that there is no more */
static int my_rank, n_ranks = 1;

bool cluster_start(int *rank, int *size)
{
  int level, already = 0;
  const char *ours = getenv("OMPI_COMM_WORLD_SIZE"), *other = getenv("PMI_SIZE");
  MPI_Initialized(&already);
  if ((ours || other) && !already) MPI_Init_thread(NULL, NULL, MPI_THREAD_FUNNELED, &level);
  if (ours || other) {
    MPI_Comm_rank(MPI_COMM_WORLD, &my_rank);
    MPI_Comm_size(MPI_COMM_WORLD, &n_ranks);
  }
  *rank = my_rank;
  *size = n_ranks;
  return true;
}

void cluster_end(void)
{
  int there = 0;
  MPI_Initialized(&there);
  if (there) MPI_Finalize();
}

int cluster_agree(int code)
{
  int worst = code;
  if (n_ranks > 1) MPI_Allreduce(&code, &worst, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
  at_work = n_ranks - 1;
  return worst;
}

static void answer(const cluster_desk *desk, int rank)
{
  long ids[HANDFUL];
  MPI_Recv(NULL, 0, MPI_BYTE, rank, TAG_ASK, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
  int n = desk->next_scenes(desk->self, HANDFUL, ids);
  MPI_Send(ids, n, MPI_LONG, rank, TAG_SCENES, MPI_COMM_WORLD);
  if (n == 0) --at_work;
}

bool cluster_serve(const cluster_desk *desk)
{
  int waiting = 1;
  while (at_work > 0 && waiting) {
    MPI_Status from;
    MPI_Iprobe(MPI_ANY_SOURCE, MPI_ANY_TAG, MPI_COMM_WORLD, &waiting, &from);
    if (!waiting) break;
    if (from.MPI_TAG == TAG_RESULT) {
      int size;
      MPI_Get_count(&from, MPI_BYTE, &size);
      char *packed = malloc((size_t)size + 1);
      if (!packed) MPI_Abort(MPI_COMM_WORLD, 1); /* what is kept is kept; the study goes on from there */
      MPI_Recv(packed, size, MPI_BYTE, from.MPI_SOURCE, TAG_RESULT, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
      desk->store(desk->self, packed, (size_t)size);
      free(packed);
    } else answer(desk, from.MPI_SOURCE);
  }
  return at_work > 0;
}

void cluster_work(const study *s, const hc_monitor *monitor)
{
  bool good = true;
  for (int n = 1; n > 0;) { /* also after an interrupt: rank 0 waits until every rank was told that there is no more */
    long ids[HANDFUL];
    MPI_Status answer;
    MPI_Send(NULL, 0, MPI_BYTE, 0, TAG_ASK, MPI_COMM_WORLD);
    MPI_Recv(ids, HANDFUL, MPI_LONG, 0, TAG_SCENES, MPI_COMM_WORLD, &answer);
    MPI_Get_count(&answer, MPI_LONG, &n);
    for (int i = 0; i < n && good; ++i) {
      study_result r;
      char *packed = NULL;
      size_t size;
      good = study_solve(s, ids[i], monitor, &r) == HC_OK && study_result_pack(&r, &packed, &size) == HC_OK;
      if (good) MPI_Send(packed, (int)size, MPI_BYTE, 0, TAG_RESULT, MPI_COMM_WORLD);
      free(packed);
      study_result_clear(&r);
    }
  }
}
