/* call_kept.c - see call.h: what a call keeps of what a command writes. */
#include <stdlib.h>

#include "interfaces/command/call.h"
#include "numerics/base/growing.h"

void cli_call_keep_table(cli_call *call, table *t)
{
  const hc_status st = table_status(t);
  table **tables = st == HC_OK ? growing(call->tables, call->n_tables, sizeof(table *)) : NULL;
  if (!tables) {
    call->status = st == HC_OK ? HC_NO_MEMORY : st;
    return;
  }
  call->tables = tables;
  tables[call->n_tables++] = table_keep(t);
}

void cli_call_keep_remark(cli_call *call, const char *format, va_list args)
{
  va_list again;
  va_copy(again, args);
  const int n = vsnprintf(NULL, 0, format, again);
  va_end(again);
  char *text = n < 0 ? NULL : malloc((size_t)n + 1);
  char **remarks = text ? growing(call->remarks, call->n_remarks, sizeof(char *)) : NULL;
  if (!remarks) {
    free(text);
    call->status = HC_NO_MEMORY;
    return;
  }
  vsnprintf(text, (size_t)n + 1, format, args);
  call->remarks = remarks;
  remarks[call->n_remarks++] = text;
}

void cli_call_clear(cli_call *call)
{
  for (int i = 0; i < call->n_tables; ++i) table_free(call->tables[i]);
  for (int i = 0; i < call->n_remarks; ++i) free(call->remarks[i]);
  free(call->tables);
  free(call->remarks);
  call->tables = NULL, call->remarks = NULL;
  call->n_tables = call->n_remarks = 0;
}
