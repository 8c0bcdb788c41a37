#!/usr/bin/env bash
# An oscillator written as a structure of one degree of freedom gives the same bytes: every case of one degree of freedom, whole curve with stability and special
# points, located and sampled forces. Its table has one column more, `response`, and its notes name the response: both are taken out.
#     one_dof.sh HBMCHECK SOURCE
set -euo pipefail
hbmcheck=$1
cd "$2"
own=$(mktemp -d)
trap 'rm -rf "$own"' EXIT
number='\([^,}]*\)'
compared=0
for case in cases/paper/*.yaml cases/adversarial/*.yaml cases/verify/*.yaml; do
  as_structure=$own/$(basename "$case")
  sed "s/^oscillator: {mass: $number, damping: $number, stiffness: $number}/structure: {mass: [\1], damping: [\2], stiffness: [\3]}/" "$case" >"$as_structure"
  if cmp -s "$case" "$as_structure"; then
    echo "$case: no oscillator was found in it"
    exit 1
  fi
  for force in exact sampled; do
    settings=(--set "hbm.force=$force" --set hbm.harmonics=3 --set hbm.samples=64 --format csv --quiet)
    one=0 other=0
    "$hbmcheck" frf "$case" "${settings[@]}" >"$own/one.csv" 2>"$own/one.err" || one=$?
    "$hbmcheck" frf "$as_structure" "${settings[@]}" >"$own/other.csv" 2>"$own/other.err" || other=$?
    sed -i -e '/^#/! s/^\([^,]*,[^,]*\),[^,]*,/\1,/' -e '/^#/ s/amplitude of 1 /amplitude /' "$own/other.csv"
    sed -i "s,$as_structure,$case,g" "$own/other.err"
    if [ "$one" -ne "$other" ] || ! diff "$own/one.csv" "$own/other.csv" || ! diff "$own/one.err" "$own/other.err"; then
      echo "$case, $force: an oscillator (exit $one) and a structure of one degree of freedom (exit $other) differ"
      exit 1
    fi
    compared=$((compared + 1))
  done
done
echo "$compared curves are the same"
[ "$compared" -ge 100 ]
