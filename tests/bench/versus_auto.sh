#!/usr/bin/env bash
# versus_auto.sh - a benchmark, not a test: hbmcheck against AUTO-07p on case 2, whole processes, interleaved; then hbmcheck on r2.
# usage: tests/bench/versus_auto.sh HBMCHECK [ROUNDS]      (default 15; AUTO from Debian's auto-07p, or wherever AUTO_DIR says)
#   AUTO      auto/bilinear.c with auto/c.bilinear: collocation 100 x 4, smoothed force, Floquet multipliers. Compiled beforehand; only the run
#             is timed, without AUTO's Python front end (which would add its own start). One thread.
#   hbmcheck  frf of cases/paper/case2.yaml, exact forces, the same range of omega, csv: H = 10, and H = 30 and 40, whose errors are AUTO's
#             (docs/measurements/benchmarks.txt).
# Each row: median [quartiles] of wall time from fork to exit, and the largest resident size seen. Ratios are of neighbouring runs.
set -u
[ $# -ge 1 ] && [ -x "$1" ] || { echo "usage: $0 HBMCHECK [ROUNDS]" >&2; exit 64; }
hbmcheck=$(realpath "$1") rounds=${2:-15}
here=$(cd "$(dirname "$0")" && pwd) cases=$(cd "$(dirname "$0")/../../cases/paper" && pwd)
[ -x /usr/bin/time ] || { echo "$0: /usr/bin/time is needed (Debian package time)" >&2; exit 69; }
work=$(mktemp -d) && trap 'rm -rf "$work"' EXIT
cd "$work" || exit 1
export OMP_NUM_THREADS=1 LC_ALL=C

# NAME COMMAND...: appends seconds to NAME.s and kB to NAME.kb; the output is in NAME.out
measure() {
  local name=$1 begin end
  shift
  begin=$EPOCHREALTIME
  /usr/bin/time -q -o kb -f %M "$@" > "$name.out" 2> "$name.err" || { echo "$name failed: $*" >&2; head -3 "$name.err" >&2; exit 1; }
  end=$EPOCHREALTIME
  awk -v a="$begin" -v b="$end" 'BEGIN { printf "%.6f\n", b - a }' >> "$name.s"
  cat kb >> "$name.kb"
}
case2() {
  measure "h$1" "$hbmcheck" frf "$cases/case2.yaml" --set hbm.force=exact --set hbm.harmonics="$1" --set 'sweep.omega=[3.1623,15.8114]' --format csv --quiet
}
r2() { measure r2 "$hbmcheck" frf "$cases/table10_case2.yaml" --set hbm.force=exact --set hbm.harmonics=10 --format csv --quiet; }
quartiles() { sort -g "$1" | awk -v f="$2" '{ v[NR] = $1 } END { printf f, v[int((NR + 1) / 2)], v[int((NR + 3) / 4)], v[int((3 * NR + 3) / 4)] }'; }
row() { # NAME LABEL REMARK
  printf '%-10s %s s  %6d kB  %s\n' "$2" "$(quartiles "$1.s" '%8.4f [%.4f, %.4f]')" "$(sort -g "$1.kb" | tail -1)" "$3"
}
# Points and highest column $2 over $1, of a csv with a header of comments and one line of names
csv_peak() { awk -F, '!/^#/ && n++ && $4 > m { m = $4; w = $1 } END { printf "%d points, max x %.4f at %.4f sqrt(K/M)", n - 1, m, w / sqrt(40) }' "$1"; }
auto_peak() { awk '$1 != 0 && $2 != 0 { ++n; if ($7 > m) { m = $7; w = $5 } } END { printf "%d points, max x %.4f at %.4f sqrt(K/M)", n, m, w / sqrt(40) }' fort.7; }

AUTO_DIR=${AUTO_DIR:-/usr/lib/auto-07p} auto=no
if [ ! -f "$AUTO_DIR/lib/libauto_c.a" ]; then
  echo "AUTO-07p is not installed (no $AUTO_DIR/lib/libauto_c.a; Debian package auto-07p): hbmcheck alone, no ratio"
elif ! { gcc -O2 -I/usr/include -I"$AUTO_DIR/include" -c "$here/auto/bilinear.c" -o bilinear.o &&
         gfortran -O2 -std=legacy -fopenmp bilinear.o "$AUTO_DIR"/lib/*.o -L"$AUTO_DIR/lib" -lauto_c -o bilinear.exe; } 2> build.err; then
  echo "AUTO-07p is installed but bilinear.c did not build (gcc and gfortran are needed): hbmcheck alone, no ratio"
  head -5 build.err
else
  auto=yes
  cp "$here/auto/c.bilinear" fort.2
  measure auto ./bilinear.exe && rm -f auto.s auto.kb
fi
case2 10 && rm -f h10.s h10.kb # the first runs only warm the caches
for ((i = 0; i < rounds; ++i)); do
  [ $auto = no ] || measure auto ./bilinear.exe
  for h in 10 30 40; do case2 $h; done
  r2
done

echo "case 2, 0.5 to 2.5 sqrt(K/M), whole processes, $rounds rounds, wall time median [quartiles], peak memory"
[ $auto = no ] || row auto AUTO-07p "$(auto_peak)"
for h in 10 30 40; do row h$h "H = $h" "$(csv_peak h$h.out)"; done
for h in 10 30 40; do
  [ $auto = yes ] || break
  paste auto.s h$h.s | awk '{ print $1 / $2 }' > ratio.s
  printf 'AUTO/hbmcheck, H = %d: %s\n' $h "$(quartiles ratio.s '%.1f [%.1f, %.1f]')"
done
echo "r2, 600 to 1100"
row r2 hbmcheck "$(awk '!/^#/ && n++ { } END { printf "%d points", n - 1 }' r2.out)"
