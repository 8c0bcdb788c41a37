/* html.h - text, numbers and tables as HTML. Everything that comes from a case file passes through html_text. */
#pragma once

#include <jansson.h>
#include <stdio.h>

#include "compare/output/rows.h"
#include "model/casefile/scene.h"

/* Text between tags or in an attribute: <, >, &, quotes escaped, control characters as spaces. */
void html_text(FILE *to, const char *text);
/* Text as a part of an address (RFC 3986): all but unreserved characters as %XX, a byte each. */
void html_percent(FILE *to, const char *text);
/* html_text, formatted; at most 511 bytes */
void html_printf(FILE *to, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* write(to, the resolved case), as html_text or html_percent. HC_NO_MEMORY. */
hc_status html_case(FILE *to, const scene *sc, void (*write)(FILE *to, const char *text));

/* A table: html_table with its columns (NULL: none), html_row, cells, html_row_end, html_table_end. */
void html_table(FILE *to, const char *caption, int n, const char *const *heads);
void html_row(FILE *to);
void html_row_end(FILE *to);
void html_cell_text(FILE *to, const char *text);
void html_cell_number(FILE *to, double value); /* 6 significant digits; NaN: empty */
/* An error [1] with a bar from 1e-12 to 1, logarithmic; marked when beyond the limit. */
void html_cell_bar(FILE *to, double value, double limit);
void html_table_end(FILE *to);

/* All rows of a kind; columns named in `without` (ending in NULL, or NULL) are left out. */
void html_rows(FILE *to, const char *caption, rows_kind kind, unsigned extra, int n, const void *rows,
               const char *const *without);

/* Columns of a row by their names (ending in NULL), each value appended to the list of that name in *to; null: none. */
void html_append_row(json_t *to, rows_kind kind, const void *row, const char *const *names);

/* JSON that may stand in a script element: no "<" in it. HC_NO_MEMORY, HC_OK. */
hc_status html_json(FILE *to, const json_t *value);
