#!/usr/bin/env bash
# study.sh - a study of 10 000 scenes, killed ten times at random moments and resumed, against one that nobody disturbed; then what a second
# thread is worth. Run by hand: tests/bench/study.sh build/release/hbmcheck [SEED]. Prints figures; fails if anything is lost or there twice.
set -euo pipefail
command="$(realpath "${1:?usage: study.sh HBMCHECK [SEED]}")"
RANDOM="${2:-1}"
folder="$(mktemp -d)"
trap 'rm -r "$folder"' EXIT
cd "$folder"

cat >many.yaml <<'YAML'
study: Ten thousand scenes of an intermittent contact
case:
  oscillator: {mass: 1.0, damping: 0.4, stiffness: 40.0}
  forcing: {amplitude: 100.0}
  contacts:
    - {tangential_stiffness: 100, normal_stiffness: 1000, friction: 0.3, angle_deg: 45, gap: -5}
  sweep: {omega: [3, 20]}
run: frf
set: {hbm.harmonics: 1, compare.omega: [5, 8]}
vary:
  - contacts[0].gap: {from: -5, to: 3, count: 25}
  - contacts[0].normal_stiffness: {from: 1e2, to: 1e4, count: 20, scale: log}
  - {forcing.amplitude: {from: 1, to: 50, count: 20}}
YAML

seconds() { date +%s.%N; }
run() { # results, threads
  local start; start="$(seconds)"
  "$command" study many.yaml --quiet --results "$1" --jobs "$2" >/dev/null || [ $? -eq 3 ] # a scene may well fail
  awk -v a="$start" -v b="$(seconds)" 'BEGIN {printf "%.2f\n", b - a}'
}

one="$(run one.sqlite 1)"
two="$(run two.sqlite 2)"
echo "10000 scenes: $one s with 1 thread, $two s with 2: ratio $(awk -v a="$one" -v b="$two" 'BEGIN {printf "%.2f", a / b}')"

kills=0
for _ in $(seq 10); do
  "$command" study many.yaml --quiet --results killed.sqlite --jobs 2 >/dev/null 2>&1 &
  process=$!
  sleep "$(awk -v r="$RANDOM" -v t="$two" 'BEGIN {printf "%.3f", 0.02 + r / 32768 * t / 12}')"
  kill -KILL "$process" 2>/dev/null && kills=$((kills + 1))
  wait "$process" 2>/dev/null || true
done
run killed.sqlite 2 >/dev/null
for results in one two killed; do
  "$command" study many.yaml --quiet --results "$results.sqlite" --export csv --output "$results.csv" || [ $? -eq 3 ]
done
cmp one.csv two.csv
cmp one.csv killed.csv
echo "$kills kills; $(awk -F, -v last=-1 'NR > 1 && $1 != last {n++; last = $1} END {print n}' killed.csv) scenes, exports identical ($(wc -c <one.csv) bytes)"
