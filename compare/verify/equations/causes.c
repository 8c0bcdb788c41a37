/* causes.c - see causes.h. */
#include "compare/verify/equations/causes.h"

#include "base/message.h"

_Static_assert(VERIFY_CAUSES <= 64, "one bit each");

static const struct {
  const char *word, *meaning, *remedy;
} causes[] = {
#define VERIFY_CAUSE_WORDS(code, word, meaning, remedy) {word, meaning, remedy},
    VERIFY_CAUSE_LIST(VERIFY_CAUSE_WORDS)
#undef VERIFY_CAUSE_WORDS
};

const char *verify_cause_word(int cause) { return causes[cause].word; }
const char *verify_cause_meaning(int cause) { return causes[cause].meaning; }
const char *verify_cause_remedy(int cause) { return causes[cause].remedy; }

const char *verify_cause_words(verify_causes bits, char text[VERIFY_TEXT])
{
  message m;
  message_start(&m, text, VERIFY_TEXT);
  for (int i = 0; i < VERIFY_CAUSES; ++i)
    if (bits & VERIFY_BIT(i)) message_add(&m, "%s%s", m.used ? "+" : "", causes[i].word);
  if (!m.used) message_add(&m, "none");
  return text;
}

int verify_cause_count(verify_causes bits)
{
  int n = 0;
  for (; bits; bits &= bits - 1) ++n;
  return n;
}
