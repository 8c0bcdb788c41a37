/* stress_files.c - see stress_files.h. Proof: tests/command/test_files.c. */
#include "command/stress_files.h"

#include <dirent.h>
#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

#include "command/files.h"
#include "output/same_file.h"

enum { PATH_ROOM = 4096 };

/* Is that the name of a finding's case file, of this seed? */
static bool is_finding(unsigned long seed, const char *name)
{
  static const char ending[] = ".yaml";
  char start[64];
  const size_t length = strlen(name), tail = sizeof ending - 1;
  const int head = snprintf(start, sizeof start, "stress-%lu-", seed);
  return !strncmp(name, start, (size_t)head) && length > tail && !strcmp(name + length - tail, ending);
}

/* Is one of the findings in the folder, which may be written again, this very file, under whatever name? */
static bool is_kept_there(unsigned long seed, const char *folder, const file_identity *it)
{
  bool same = false;
  DIR *from = opendir(folder);
  for (struct dirent *e; from && !same && (e = readdir(from));) {
    char path[PATH_ROOM];
    file_identity there;
    if (!is_finding(seed, e->d_name)) continue;
    snprintf(path, sizeof path, "%s/%s", folder, e->d_name);
    file_identify(path, -1, &there);
    same = file_same(it, &there);
    file_forget(&there);
  }
  if (from) closedir(from);
  return same;
}

static bool may_be_replaced(unsigned long seed, const char *folder, const char *path)
{
  file_identity it;
  const char *slash = strrchr(path, '/');
  if (file_is_in(path, folder) && is_finding(seed, slash ? slash + 1 : path)) return true;
  file_identify(path, -1, &it);
  const bool kept = is_kept_there(seed, folder, &it);
  file_forget(&it);
  return kept;
}

int stress_check_files(const cli_common *common, const stress_plan *plan, const char *findings)
{
  const cli_file others[] = {{"--results", plan->journal, CLI_RESULTS}, {"--output", common->output, CLI_OUTPUT}};
  int code = cli_check_files(common, 1, others);
  for (int i = 0; i < 2 && findings && !code; ++i)
    if (others[i].path && may_be_replaced(plan->seed, findings, others[i].path)) {
      cli_message(common, "%s %s is where --findings %s keeps a case file; give another name", others[i].what,
                  others[i].path, findings);
      code = EXIT_USAGE;
    }
  return code;
}

int stress_make_folder(const cli_common *common, const char *findings)
{
  struct stat st;
  if (!findings || mkdir(findings, 0777) == 0) return 0;
  if (errno == EEXIST && stat(findings, &st) == 0 && S_ISDIR(st.st_mode)) return 0;
  if (errno == EEXIST) errno = ENOTDIR;
  return cli_file_failed(common, findings, HC_IO);
}
