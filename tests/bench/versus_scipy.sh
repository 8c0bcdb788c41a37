#!/usr/bin/env bash
# versus_scipy.sh - a benchmark, not a test: the steady state of case 2 at omega = 9 (upper branch) by scipy's LSODA and by time integration here.
# usage: tests/bench/versus_scipy.sh BENCH_TRANSIENT [ROUNDS]      (default 11; Debian's python3-scipy; PYTHON says which python3)
#   scipy   versus_scipy.py: solve_ivp, LSODA, rtol 1e-8, 200 periods, as one does who wants 1e-8 and does not know how soon it is settled
#   ours    bench_transient once: exact law, shooting, transient.tolerance 1e-8
# Both from the same state, that of the HBM orbit (H = 5). Turns are taken; each row: median [quartiles]. "in the process": processor time around the
# solve alone, without the start of a program or of Python; "whole": wall time from fork to exit. Errors: against the exact law at 1e-13.
set -u
[ $# -ge 1 ] && [ -x "$1" ] || { echo "usage: $0 BENCH_TRANSIENT [ROUNDS]" >&2; exit 64; }
bench=$(realpath "$1") rounds=${2:-11} python=${PYTHON:-/usr/bin/python3}
here=$(cd "$(dirname "$0")" && pwd)
"$python" -c 'import scipy.integrate' 2>/dev/null || { echo "$0: no scipy for $python (Debian package python3-scipy): nothing to compare with" >&2; exit 69; }
work=$(mktemp -d) && trap 'rm -rf "$work"' EXIT
cd "$work" || exit 1
export OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1 LC_ALL=C
read -r x v exact < <("$bench" start) || exit 3

measure() { # NAME COMMAND...: seconds in the process to NAME.in, whole to NAME.all, amplitude in NAME.x
  local name=$1 begin end
  shift
  begin=$EPOCHREALTIME
  "$@" > out || { echo "$name failed: $*" >&2; exit 3; }
  end=$EPOCHREALTIME
  awk '{ print $1 }' out >> "$name.in"
  awk '{ print $2 }' out > "$name.x"
  awk -v a="$begin" -v b="$end" 'BEGIN { printf "%.6f\n", b - a }' >> "$name.all"
}
quartiles() { sort -g "$1" | awk -v f="$2" '{ v[NR] = $1 } END { printf f, v[int((NR + 1) / 2)], v[int((NR + 3) / 4)], v[int((3 * NR + 3) / 4)] }'; }
row() { # NAME LABEL
  printf '%-6s in the process %s s   whole %s s   error %s\n' "$2" "$(quartiles "$1.in" '%.5f [%.5f, %.5f]')" "$(quartiles "$1.all" '%.4f [%.4f, %.4f]')" \
    "$(awk -v a="$exact" '{ e = $1 / a - 1; printf "%.1e", e < 0 ? -e : e }' "$1.x")"
}
for ((i = 0; i <= rounds; ++i)); do # the first round only warms the caches
  measure scipy "$python" "$here/versus_scipy.py" 9 "$x" "$v"
  measure ours "$bench" once
  [ "$i" -gt 0 ] || rm -f ./*.in ./*.all
done
echo "case 2 at omega = 9, steady state to 1e-8, $rounds rounds, median [quartiles]; $("$python" -c 'import scipy, sys; print("scipy", scipy.__version__, "python", sys.version.split()[0])')"
row scipy LSODA
row ours ours
for what in in all; do
  paste scipy.$what ours.$what | awk '{ print $1 / $2 }' > ratio
  printf 'LSODA/ours %s = %s\n' "$([ $what = in ] && echo 'in the process' || echo 'whole processes')" "$(quartiles ratio '%.1f [%.1f, %.1f]')"
done
