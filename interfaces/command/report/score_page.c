/* score_page.c - the suite's scores as an HTML page, and as a badge. */
#include <math.h>
#include <string.h>

#include "interfaces/command/report/html.h"
#include "interfaces/command/report/parts.h"
#include "interfaces/command/report/scores.h"

enum { LEFT = 190, WIDTH = 620, BAR = 9, ROW_GAP = 4, MOST_DIGITS = 15 };

static double x_of(double digits) { return LEFT + digits * WIDTH / MOST_DIGITS; }

/* A row a case, a bar a program: pale to the mean of its digits, full to the fewest; marks at what is asked. */
static void draw(const suite *s, int n, const scores *all, FILE *to)
{
  const int row = n * BAR + ROW_GAP;
  fprintf(to,
          "<div class=\"wide\"><svg viewBox=\"0 0 %d %d\" width=\"%d\" role=\"img\" aria-label=\"Digits of each case\" "
          "font-size=\"9\" fill=\"currentColor\">\n",
          LEFT + WIDTH + 30, s->n * row + 30, LEFT + WIDTH + 30);
  for (int d = 0; d <= MOST_DIGITS; d += 3)
    fprintf(to,
            "<path d=\"M%.1f 14V%d\" stroke=\"var(--%s)\" fill=\"none\"/><text x=\"%.1f\" y=\"10\" "
            "text-anchor=\"middle\">%d</text>\n",
            x_of(d), s->n * row + 16, d == SUITE_FULL ? "soft" : "line", x_of(d), d);
  for (int i = 0; i < s->n; ++i) {
    const int y = 18 + i * row;
    fprintf(to, "<text x=\"%d\" y=\"%d\" text-anchor=\"end\">", LEFT - 6, y + n * BAR / 2 + 3);
    html_text(to, s->cases[i].name);
    fputs("</text>", to);
    for (int p = 0; p < n; ++p) {
      const suite_score *r = &all[p].scores[i];
      const char *colour = r->digits >= all[p].digits ? "good" : "bad";
      fprintf(to,
              "<rect x=\"%d\" y=\"%d\" width=\"%.1f\" height=\"%d\" fill=\"var(--bar)\"/><rect x=\"%d\" y=\"%d\" "
              "width=\"%.1f\" height=\"%d\" fill=\"var(--%s)\"/>",
              LEFT, y + p * BAR, x_of(r->mean) - LEFT, BAR - 1, LEFT, y + p * BAR, fmax(x_of(r->digits) - LEFT, 1.5),
              BAR - 1, colour);
    }
    putc('\n', to);
  }
  fputs("</svg></div>\n", to);
}

static void list_cases(const suite *s, int n, const scores *all, FILE *to)
{
  static const char *const heads[] = {"case",        "group",         "program",       "solutions",
                                      "missing",     "fewest digits", "of what",       "at omega",
                                      "mean digits", "score",         "what is wrong", "tests"};
  html_table(to, "Cases", sizeof heads / sizeof *heads, heads);
  for (int i = 0; i < s->n; ++i)
    for (int p = 0; p < n; ++p) {
      const suite_case *c = &s->cases[i];
      const suite_score *r = &all[p].scores[i];
      const suite_answer *a = &all[p].answers[i];
      html_row(to);
      html_cell_text(to, c->name);
      html_cell_text(to, c->group);
      html_cell_text(to, all[p].program);
      fprintf(to, "<td>%d</td><td>%d</td><td>%.1f</td>", c->n, r->missing, r->digits);
      html_cell_text(to, suite_quantity[r->quantity]);
      fprintf(to, "<td>%.6g</td><td>%.1f</td><td>%.1f</td>", c->references[r->worst].omega, r->mean, 100 * r->points);
      html_cell_text(to, *a->wrong ? a->wrong : all[p].causes[i]);
      html_cell_text(to, c->tests);
      html_row_end(to);
    }
  html_table_end(to);
}

hc_status scores_page(const suite *s, int n, const scores *all, const char *why, FILE *to)
{
  fputs("<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<meta name=\"viewport\" "
        "content=\"width=device-width, initial-scale=1\">\n<title>hbmcheck suite</title>\n<style>\n",
        to);
  fwrite(asset_style.bytes, 1, asset_style.length, to);
  fprintf(to,
          "</style>\n</head>\n<body>\n<header>\n<p class=\"tool\">hbmcheck suite %s: %d cases with references that are "
          "proven, or of stated error</p>\n<h1>",
          s->version, s->n);
  for (int p = 0; p < n; ++p) html_printf(to, "%s%s: %.1f of 100", p ? "; " : "", all[p].program, all[p].total);
  fputs("</h1>\n</header>\n<main>\n", to);
  for (int p = 0; p < n; ++p) {
    fprintf(to, "<p class=\"verdict %s\"><strong>", all[p].passed == s->n ? "good" : "bad");
    html_printf(to, "%s: %d of %d cases with %g digits everywhere", all[p].program, all[p].passed, s->n, all[p].digits);
    fputs("</strong></p>\n", to);
  }
  if (*why) {
    fputs("<p class=\"note\">", to);
    html_text(to, why);
    fputs("</p>\n", to);
  }
  fprintf(
      to,
      "<h2>Digits</h2>\n<p>Of a quantity: -log10(|value - reference| / amplitude). Dark: the fewest of a case; pale: "
      "their mean. %d digits everywhere, or as many as the reference has, are all points of a case.</p>\n",
      SUITE_FULL);
  draw(s, n, all, to);
  fputs("<h2>Cases</h2>\n", to);
  list_cases(s, n, all, to);
  fputs("</main>\n</body>\n</html>\n", to);
  return ferror(to) ? HC_IO : HC_OK;
}

hc_status scores_badge(const suite *s, const scores *one, FILE *to)
{
  char left[64], right[96];
  snprintf(left, sizeof left, "hbmcheck suite %s", s->version);
  snprintf(right, sizeof right, "%d of %d, score %.1f", one->passed, s->n, one->total);
  const int a = 7 * (int)strlen(left) + 12, b = 7 * (int)strlen(right) + 12;
  const char *colour = one->passed == s->n ? "#1f7a44" : one->total >= 50 ? "#8a5a00" : "#b3261e";
  fprintf(to,
          "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%d\" height=\"20\" role=\"img\">\n<rect width=\"%d\" "
          "height=\"20\" fill=\"#444\"/><rect x=\"%d\" width=\"%d\" height=\"20\" fill=\"%s\"/>\n<g fill=\"#fff\" "
          "font-family=\"DejaVu Sans,Verdana,sans-serif\" font-size=\"11\" text-anchor=\"middle\">",
          a + b, a, a, b, colour);
  fprintf(to, "<text x=\"%d\" y=\"14\">", a / 2);
  html_text(to, left);
  fprintf(to, "</text><text x=\"%d\" y=\"14\">%s</text></g>\n</svg>\n", a + b / 2, right);
  return ferror(to) ? HC_IO : HC_OK;
}
