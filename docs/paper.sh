#!/usr/bin/env bash
# paper.sh - compute every study of the paper: all tables into docs/measurements/paper.txt, the verdicts into
# docs/paper.md, between its markers. usage: docs/paper.sh HBMCHECK
set -euo pipefail
hbmcheck=$(realpath "${1:?usage: docs/paper.sh HBMCHECK}")
cd "$(dirname "$0")/.."
COLUMNS=118 "$hbmcheck" study cases/paper/studies/*.yaml --results :memory: --quiet |
  sed 's/ *$//' >docs/measurements/paper.txt
"$hbmcheck" study cases/paper/studies/*.yaml --results :memory: --quiet --format csv | python3 -c '
import csv, re, sys, textwrap
WORDS = {"agrees": "yes", "does not agree": "no", "cannot be said": "unsaid"}
head, verdicts = [], {}
for row in csv.reader(sys.stdin):
    if row[:1] == ["source"]: head = row
    elif len(row) == len(head) and "paper_holds" in head:
        named = {name[:-6]: WORDS[value] for name, value in zip(head, row) if name.endswith("_holds")}
        verdicts.setdefault((row[0], row[1]), {}).update(named)
lines = ["%-15s %-6s %-6s %-11s %s" % ("source", "paper", "ours", "fixed_step", "says")]
for (source, says), found in verdicts.items():
    text = textwrap.wrap(says, 76, break_on_hyphens=False)
    columns = "%-15s %-6s %-6s %-11s " % (source, found["paper"], found["ours"], found.get("fixed_step", ""))
    lines += [columns + text[0]] + [" " * 42 + line for line in text[1:]]
page = open("docs/paper.md").read()
table = "<!-- claims -->\n```text\n" + "\n".join(lines) + "\n```\n<!-- end -->"
open("docs/paper.md", "w").write(re.sub("<!-- claims -->.*?<!-- end -->", lambda _: table, page, flags=re.S))'
