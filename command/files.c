/* files.c - see files.h. Proof: tests/command/test_files.c. */
#include "command/files.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "output/same_file.h"

/* One name and the file it means. */
typedef struct named_file {
  cli_file as;
  file_identity is;
} named_file;

static bool add_file(named_file *list, int *n, cli_file f)
{
  if (f.path && !strcmp(f.path, "-") && f.use != CLI_RESULTS) f.path = NULL;
  list[*n].as = f;
  return file_identify(f.path, f.use == CLI_INPUT ? STDIN_FILENO : STDOUT_FILENO, &list[(*n)++].is);
}

/* Everything into list[common->n_arguments + 1 + n], *found of it. False: out of memory. */
static bool add_all_files(const cli_common *common, int n, const cli_file *files, named_file *list, int *found)
{
  bool whole = add_file(list, found, (cli_file){"--output", common->output, CLI_OUTPUT});
  for (int i = 0; i < common->n_arguments && common->argument_is && whole; ++i)
    whole = add_file(list, found, (cli_file){common->argument_is, common->arguments[i], CLI_INPUT});
  for (int i = 0; i < n && whole; ++i)
    if (files[i].path) whole = add_file(list, found, files[i]);
  return whole;
}

/* Is it a name that the system gives to a stream of ours? Two outputs are mixed there because the user asked for it. */
static bool is_stream(const cli_file *f)
{
  return !f->path || !strncmp(f->path, "/dev/", 5) || !strncmp(f->path, "/proc/", 6);
}

static bool clash(const named_file *a, const named_file *b)
{
  if (a->as.use == CLI_INPUT && b->as.use == CLI_INPUT) return false;
  if (a->as.use != CLI_INPUT && b->as.use != CLI_INPUT && is_stream(&a->as) && is_stream(&b->as)) return false;
  return file_same(&a->is, &b->is);
}

/* "--output a.yaml", "standard output" */
static const char *name_of(const cli_file *f, char *text, size_t size)
{
  if (f->path) snprintf(text, size, "%s %s", f->what, f->path);
  else snprintf(text, size, f->use == CLI_INPUT ? "%s on standard input" : "standard output", f->what);
  return text;
}

/* `written` is an output, `other` what it would replace. */
static void tell(const cli_common *common, const cli_file *written, const cli_file *other)
{
  enum { SIZE = 1024 };
  char one[SIZE], two[SIZE];
  const bool same_name = written->path && other->path && !strcmp(written->path, other->path);
  name_of(written, one, sizeof one);
  if (same_name && other->use == CLI_INPUT) snprintf(two, sizeof two, "%s", other->what);
  else name_of(other, two, sizeof two);
  if (other->use == CLI_INPUT) cli_message(common, "%s is %s itself; give another name", one, two);
  else cli_message(common, "%s and %s are the same file; give another name", one, two);
}

int cli_check_files(const cli_common *common, int n, const cli_file *files)
{
  int found = 0, code = 0;
  named_file *list = calloc((size_t)common->n_arguments + 1 + (size_t)n, sizeof *list);
  if (!list || !add_all_files(common, n, files, list, &found)) {
    cli_message(common, "%s", hc_status_text(HC_NO_MEMORY));
    code = EXIT_NO_SOLUTION;
  }
  for (int i = 0; i < found && !code; ++i)
    for (int k = 0; k < i && !code; ++k) {
      if (!clash(&list[i], &list[k])) continue;
      const bool first_is_input = list[i].as.use == CLI_INPUT;
      tell(common, &list[first_is_input ? k : i].as, &list[first_is_input ? i : k].as);
      code = EXIT_USAGE;
    }
  for (int i = 0; i < found; ++i) file_forget(&list[i].is);
  free(list);
  return code;
}
