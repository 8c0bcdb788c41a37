#!/usr/bin/env bash
# paper.sh - compute every study of the paper and put the tables into docs/paper.md, between its markers. usage: docs/paper.sh HBMCHECK
set -euo pipefail
hbmcheck=$(realpath "${1:?usage: docs/paper.sh HBMCHECK}")
cd "$(dirname "$0")/.."
tables=$(mktemp) page=$(mktemp)
trap 'rm -f "$tables" "$page"' EXIT
COLUMNS=150 "$hbmcheck" study cases/paper/studies/*.yaml --results :memory: --quiet >"$tables"
awk -v tables="$tables" '
  function part(from, to,   line, on) { # the lines of the tables from one that begins with `from` to one that begins with `to`
    print "```text"
    while ((getline line < tables) > 0) { if (index(line, from) == 1) on = 1; if (to != "" && index(line, to) == 1) break; if (on) print line }
    close(tables)
    print "```"
  }
  /^<!-- end -->$/ { inside = 0 }
  !inside { print }
  /^<!-- claims -->$/ { inside = 1; part("Claims, with", "Claims that") }
  /^<!-- steps -->$/ { inside = 1; part("Claims that", "Seconds") }
  /^<!-- seconds -->$/ { inside = 1; part("Seconds", "") }
  /^<!-- studies -->$/ { inside = 1; part("Studies", "Claims") }
' docs/paper.md >"$page"
cat "$page" >docs/paper.md
