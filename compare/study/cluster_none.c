/* cluster_none.c - cluster.h for a build without MPI: one process, and a refusal where several are started. */
#include <stdlib.h>

#include "compare/study/cluster.h"

static int number_in(const char *variable)
{
  const char *text = getenv(variable);
  return text ? (int)strtol(text, NULL, 10) : 1;
}

bool cluster_start(int *rank, int *size)
{
  *rank = 0;
  *size = 1;
  return number_in("OMPI_COMM_WORLD_SIZE") <= 1 && number_in("PMI_SIZE") <= 1;
}

void cluster_end(void) {}
int cluster_agree(int code) { return code; }
bool cluster_serve(const cluster_desk *desk) { return (void)desk, false; }
void cluster_work(const study *s, const hc_monitor *monitor) { (void)s, (void)monitor; }
