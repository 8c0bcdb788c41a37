/* report.h - a comparison as one self-contained HTML page: words, interactive plots, tables, and aliasing taught.
 * The way into this folder.
 *
 *     scene -> comparison, tables over H and N, response curve, answers on aliasing (report_gather) -> one page
 *     (report_write)
 *
 * The page needs no network and no other file: page.html, page.css, the scripts and the installed Chart.js are built
 * into the program (embed.cmake). Same input, same bytes: no dates, no seconds. Nothing is printed; not here:
 * options and files (interfaces/command/cmd_report.c). */
#pragma once

#include <jansson.h>
#include <stdio.h>

#include "compare/accuracy/accuracy.h"
#include "compare/comparison.h"
#include "compare/output/progress.h"
#include "model/casefile/scene.h"
#include "numerics/base/status.h"
#include "proof/prove/prove.h"

typedef struct report_data {
  const scene *sc;     /* the caller's */
  compare_setup setup; /* made from it */
  comparison comparison;
  accuracy accuracy;
  proofs proofs;     /* the caller's to fill in, if they are asked for; report_clear frees them */
  hc_status tabled;  /* status of the tables; the rows found are shown whatever it is */
  json_t *response;  /* the curve and what stands on it, of the first response */
  json_t *structure; /* other responses, shapes and contacts (parts.h); JSON null for one degree of freedom */
  json_t *aliasing;  /* answers on aliasing (parts.h); JSON null without contacts */
} report_data;

/* How the page was made, for its last section. UTF-8; escaped by report_write. */
typedef struct report_origin {
  const char *command;  /* the line that makes it again */
  const char *lab;      /* and the one that writes the lab's page with this case */
  const char *versions; /* of the program and its libraries, lines */
  const char *settings; /* a sentence: "Harmonic balance: H = 10, exact forces. Time integration: ..." */
} report_origin;

/* Was Chart.js installed when this was built? Without it no report can be written. */
bool report_has_charts(void);

/* Everything the page shows, the same by however many threads. The stages are labels of the progress, which may be
 * NULL. HC_INTERRUPTED, HC_NO_MEMORY, or why comparison or curve could not be made. report_clear in any case. */
hc_status report_gather(const scene *sc, int jobs, progress *bar, report_data *out);
void report_clear(report_data *d);

/* The page. HC_IO once the stream has failed, HC_NO_MEMORY. */
hc_status report_write(const report_data *d, const report_origin *origin, FILE *to);
