# lab.sh HBMCHECK ROOT - hbmcheck lab: the page that is installed beside the program, as it is and with a case in it; and what is refused.
set -eu
root=$2
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
mkdir -p "$folder/bin" "$folder/share/hbmcheck" "$folder/alone/bin"
cp "$1" "$folder/bin/hbmcheck"
cp "$1" "$folder/alone/bin/hbmcheck"
hbmcheck=$folder/bin/hbmcheck
page='<p>before</p><pre id="case-given" hidden></pre><p>after</p>'
echo "$page" >"$folder/share/hbmcheck/lab.html"
cd "$folder"

fail() { echo "$*"; exit 1; }
expect() { # EXIT WORDS COMMAND...
  code=$1 words=$2
  shift 2
  got=0
  "$@" >said 2>&1 || got=$?
  [ "$got" = "$code" ] || fail "$*: exit $got, not $code: $(cat said)"
  [ -z "$words" ] || grep -qF -- "$words" said || fail "$*: says $(cat said), not $words"
}

expect 0 "wrote lab.html" "$hbmcheck" lab
[ "$(cat lab.html)" = "$page" ] || fail "the page is not the one installed"
expect 0 "" "$hbmcheck" lab -q --case "$root/cases/paper/case2.yaml" --set 'title=<b>"A&B"</b>' --set hbm.harmonics=7 -o made.html
grep -q '^<p>before</p><pre id="case-given" hidden>title: ' made.html || fail "the case is not in its place: $(head -3 made.html)"
grep -q '^  harmonics: 7$' made.html && grep -q '</pre><p>after</p>$' made.html || fail "not the whole case and page: $(cat made.html)"
! grep -q '<b>' made.html || fail "the title is not escaped"
expect 0 "<p>after</p>" "$hbmcheck" lab -q -o -
expect 2 "one degree of freedom" "$hbmcheck" lab --case "$root/cases/structures/stop2.yaml" -o none.html
expect 2 "hbm.harmonics" "$hbmcheck" lab --case "$root/cases/paper/case2.yaml" --set hbm.harmonics=0 -o none.html
expect 64 "--case CASE was expected" "$hbmcheck" lab --set hbm.harmonics=3 -o none.html
expect 64 "--format does not apply" "$hbmcheck" lab --format csv -o none.html
cp "$root/cases/paper/case2.yaml" own.yaml
expect 64 "own.yaml" "$hbmcheck" lab --case own.yaml -o own.yaml
cmp -s "$root/cases/paper/case2.yaml" own.yaml || fail "a case was written over"
expect 3 "" "$hbmcheck" lab -o nowhere/lab.html
# Without a page beside it the program looks where it was to be installed, where there may be one.
code=0
"$folder/alone/bin/hbmcheck" lab -q -o none.html >said 2>&1 || code=$?
if [ $code -ne 0 ]; then
  [ $code = 3 ] && grep -q 'the page is not installed' said && grep -q 'HBMCHECK_LAB_MODULE' said || fail "without a page: exit $code: $(cat said)"
  [ ! -e none.html ] || fail "none.html was written"
fi
