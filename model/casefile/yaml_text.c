/* yaml_text.c - from bytes to a YAML document safe to walk, in three passes: the characters; the events, which stop
 * deep nesting, aliases and second documents before libyaml builds anything (in quadratic time); then the document. */
#include <string.h>

#include "model/casefile/case_reader.h"
#include "numerics/base/utf8.h"

enum { DEEPEST = 16 }; /* a case file needs 4 */

/* YAML 1.1 ends lines at U+0085, U+2028 and U+2029, too; editors do not, and messages count lines as they do. */
static bool is_yaml_character(unsigned long c)
{
  if (c == '\t' || c == '\n' || c == '\r') return true;
  return c >= 0x20 && !(c >= 0x7F && c < 0xA0) && c != 0x2028 && c != 0x2029 && c != 0xFEFF && c != 0xFFFE &&
         c != 0xFFFF;
}

static bool starts_with(const char *text, size_t length, const char *word)
{
  return length >= strlen(word) && !memcmp(text, word, strlen(word));
}

/* A thousand %TAG lines take libyaml a million comparisons, a megabyte of them minutes; no case file needs one. */
static hc_status check_characters(case_reader *r, const char *text, size_t length)
{
  case_place at = {.set = r->set_now, .line = 1, .column = 1};
  for (size_t i = 0, n; i < length; i += n) {
    unsigned long code = 0;
    n = utf8_character(text + i, length - i, &code);
    if (n == 0)
      return case_refuse(r, at, "byte 0x%02X is not UTF-8, expected a %s file in UTF-8",
                         (unsigned)(unsigned char)text[i], r->noun);
    if (!is_yaml_character(code)) return case_refuse(r, at, "control character 0x%02lX, expected text", code);
    if (at.column == 1 && starts_with(text + i, length - i, "%TAG"))
      return case_refuse(r, at, "a %%TAG line, expected plain YAML");
    bool line_end = code == '\n' || (code == '\r' && !starts_with(text + i + 1, length - i - 1, "\n"));
    if (line_end) ++at.line, at.column = 1;
    else ++at.column;
  }
  if (r->set_now == 0) r->end = at;
  return HC_OK;
}

static hc_status parser_failed(case_reader *r, const yaml_parser_t *p)
{
  message *m = case_blame(r, case_place_of(r, p->problem_mark));
  if (p->error == YAML_MEMORY_ERROR || p->error == YAML_NO_ERROR) { /* without memory libyaml sometimes sets no error */
    message_add(m, "out of memory");
    return HC_NO_MEMORY;
  }
  message_add(m, "not YAML: %s", p->problem ? p->problem : "cannot be parsed");
  if (p->context && r->set_now == 0)
    message_add(m, " (%s from line %zu on)", p->context, case_place_of(r, p->context_mark).line);
  message_add(m, ", expected `key: value` lines, indented with spaces");
  return HC_BAD_INPUT;
}

typedef struct nesting {
  int depth, documents;
} nesting;

/* What a case file has no use for, or NULL if the event is welcome. */
static const char *objection(const yaml_event_t *e, nesting *g)
{
  const yaml_char_t *anchor = NULL, *tag = NULL;
  switch (e->type) {
  case YAML_DOCUMENT_START_EVENT:
    return ++g->documents > 1 ? "a second YAML document, expected one scene a file" : NULL;
  case YAML_ALIAS_EVENT: return "a YAML alias (*), expected the value itself";
  case YAML_SCALAR_EVENT: anchor = e->data.scalar.anchor, tag = e->data.scalar.tag; break;
  case YAML_SEQUENCE_START_EVENT:
    anchor = e->data.sequence_start.anchor, tag = e->data.sequence_start.tag, ++g->depth;
    break;
  case YAML_MAPPING_START_EVENT:
    anchor = e->data.mapping_start.anchor, tag = e->data.mapping_start.tag, ++g->depth;
    break;
  case YAML_SEQUENCE_END_EVENT:
  case YAML_MAPPING_END_EVENT: --g->depth; break;
  default: break;
  }
  if (g->depth > DEEPEST) return "lists or mappings nested too deeply, expected a few levels";
  if (anchor) return "a YAML anchor (&), expected the value alone";
  return tag ? "a YAML tag (!), expected the value alone" : NULL;
}

static hc_status check_events(case_reader *r, yaml_parser_t *p)
{
  nesting g = {0};
  for (bool more = true; more;) {
    yaml_event_t e;
    if (!yaml_parser_parse(p, &e)) return parser_failed(r, p);
    const char *why = objection(&e, &g);
    if (why) message_add(case_blame(r, case_place_of(r, e.start_mark)), "%s", why);
    more = e.type != YAML_STREAM_END_EVENT;
    yaml_event_delete(&e);
    if (why) return HC_BAD_INPUT;
  }
  if (g.documents > 0) return HC_OK;
  message *m = case_blame(r, (case_place){.set = r->set_now, .line = 1, .column = 1});
  if (r->set_now) message_add(m, "nothing here, expected [{...}, ...] or {...}, or [] for no contacts");
  else message_add(m, "nothing here, expected a %s with %s", r->noun, r->required);
  return HC_BAD_INPUT;
}

hc_status yaml_text_load(case_reader *r, const char *text, size_t length)
{
  yaml_parser_t p;
  if (length > CASE_LARGEST) {
    return case_refuse(r, (case_place){0}, "larger than 16 MB, expected a %s file (a few kB; large matrices in files)",
                       r->noun);
  }
  /* libyaml skips the mark only where it guesses the encoding */
  if (starts_with(text, length, "\xEF\xBB\xBF")) text += 3, length -= 3;
  hc_status st = check_characters(r, text, length);
  for (int pass = 0; pass < 2 && st == HC_OK; ++pass) {
    if (!yaml_parser_initialize(&p)) {
      message_add(case_blame(r, (case_place){.set = r->set_now, .line = 1, .column = 1}), "out of memory");
      return HC_NO_MEMORY;
    }
    yaml_parser_set_encoding(&p, YAML_UTF8_ENCODING);
    yaml_parser_set_input_string(&p, (const unsigned char *)text, length);
    st = pass == 0 ? check_events(r, &p) : yaml_parser_load(&p, &r->doc) ? HC_OK : parser_failed(r, &p);
    yaml_parser_delete(&p);
  }
  return st;
}
