/* assets.h - the parts of the page that are built into the program, as bytes (embed.cmake makes the source). */
#ifndef HC_REPORT_ASSETS_H
#define HC_REPORT_ASSETS_H

#include <stddef.h>

typedef struct asset {
  const unsigned char *bytes;
  size_t length;
} asset;

extern const unsigned char asset_page_bytes[], asset_style_bytes[], asset_script_bytes[], asset_chart_bytes[];
/* page.html, page.css */
extern const asset asset_page, asset_style;
/* plots.js to start.js, in the order of CMakeLists.txt: one script */
extern const asset asset_script;
/* Chart.js with its licence notice; length 0: it was not installed */
extern const asset asset_chart;

#endif
