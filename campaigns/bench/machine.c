/* machine.c - what the figures were measured on. */
#include <stdio.h>
#include <string.h>
#include <sys/utsname.h>
#include <unistd.h>

#include "campaigns/bench/bench.h"

/* Linux says it in /proc/cpuinfo; elsewhere the kind of machine has to do. */
static void processor(char *text, size_t size)
{
  char line[256];
  FILE *from = fopen("/proc/cpuinfo", "r");
  text[0] = 0;
  while (from && !text[0] && fgets(line, sizeof line, from)) {
    char *at = strncmp(line, "model name", 10) ? NULL : strstr(line, ": ");
    if (at) snprintf(text, size, "%.*s", (int)strcspn(at + 2, "\n"), at + 2);
  }
  if (from) fclose(from);
}

void bench_machine(char *text, int size)
{
  struct utsname name;
  char chip[160];
  processor(chip, sizeof chip);
  if (uname(&name) != 0) snprintf(name.sysname, sizeof name.sysname, "unknown"), name.release[0] = name.machine[0] = 0;
  snprintf(text, (size_t)size, "%s%s%s, %ld processors, %s, compiler %s", chip, chip[0] ? ", " : "", name.machine,
           sysconf(_SC_NPROCESSORS_ONLN), name.sysname, __VERSION__);
}
