/* test_browser.c - the page in headless Chromium: from disk with #selftest it draws, reads its pixels back, works every
 * control and says what came of it (start.js); the console stays empty. Skipped without Chromium. */
#include "tests/command/report/run.h"

/* Debian's chromium runs as any user in a container only without its sandbox; the page is our own. */
#define HEADLESS                                                                                                       \
  " --headless=new --no-sandbox --disable-gpu --disable-dev-shm-usage --no-first-run --enable-logging=stderr "         \
  "--virtual-time-budget=30000 "

#define DARK "--blink-settings=preferredColorScheme=0" /* a reader whose scheme is dark */

/* `scheme`: DARK, or "". */
static void open_page(const char *of, const char *set, int code, const char *scheme)
{
  char args[1024];
  snprintf(args, sizeof args, "report %s%s -o $D/page.html 2>&1", of, set);
  assert_int_equal(run(args), code);
  snprintf(args, sizeof args,
           CHROMIUM HEADLESS
           "%s --user-data-dir=$D/profile --dump-dom \"file://$D/page.html#selftest\" >$D/dom 2>$D/log",
           scheme);
  shell_read(args, out, sizeof out);
  char *dom = folder_read("dom", NULL), *log = folder_read("log", NULL);
  const char *said = strstr(dom, "<pre id=\"selftest\">");
  bool good = said && !strncmp(said + strlen("<pre id=\"selftest\">"), "selftest: ok ", 13) && !strstr(log, "CONSOLE");
  if (!good) print_error("%s\n%.2000s\n%.4000s\n", set, said ? said : "the page did not run", log);
  assert_true(good);
  free(dom);
  free(log);
}

static void every_plot_is_drawn_and_every_control_works(CHECK_STATE)
{
  static const struct {
    const char *set;
    int code;
    const char *scheme;
  } pages[] = {
      {"", 0, DARK},
      {"--at 8,8.9", 0, ""}, /* H = 1 has lost the branch that touches; 16 samples have gained one */
      {"--set contacts=[]", 0, ""},
      {"--set contacts[0].gap=100", 0, ""}, /* no mean to draw, nothing to sample */
      {"--set hbm.static=false", 1, ""},
      {"--set hbm.slider_restart=sample --set contacts[0].gap=0 --set contacts[0].friction=1", 0, ""},
      {"--set contacts[0].gap=-0.5", 0, ""}, /* a curve that comes back from below the sweep */
      {"--set contacts[0].gap=1 --set contacts[0].normal_stiffness=100 --at 10,12", 0, ""}, /* slip to and fro */
      {"--set sweep.frequency=0.5,3.2 --at 1,1.2", 0, ""},
      {"--set 'title=</script><b>x' --set 'units.length=<i>'", 0, ""}};
  if (!CHROMIUM[0]) {
    print_message("SKIPPED: chromium is not installed (Debian: chromium), so the page was not opened\n");
    skip();
  }
  if (!HAVE_CHARTJS) {
    print_message("SKIPPED: built without Chart.js (Debian: libjs-chart.js), so there is no page\n");
    skip();
  }
  for (size_t i = 0; i < sizeof pages / sizeof *pages; ++i)
    open_page(strstr(pages[i].set, "--at") ? CASE2 TABLES : CASE2 SMALL, pages[i].set, pages[i].code, pages[i].scheme);
  open_page("cases/structures/jenkins2.yaml -q ", "--at 24,25.9 --harmonics 5 --samples 64,256", 1, DARK);
  open_page("cases/structures/stop2.yaml -q ", "--at 0.6 --harmonics 5 --samples 64", 1, "");
}

CHECK_TESTS_WITH("compare_report.browser", 600, folder_make, folder_remove, every_plot_is_drawn_and_every_control_works)
