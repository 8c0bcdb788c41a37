#!/usr/bin/env python3
"""proven.py HBMCHECK [--check] - proven.txt beside this file: what `hbmcheck prove` proves of the cases that the page carries.

Of each case of cases/paper with one contact a line `== M C K F0 | kt kn mu angle gap`, then a line for each certified periodic orbit of the
exact law: omega, amplitude to 8 digits, `stable`, `unstable` or `unproven`. --check: nothing is written; exit 1 if an orbit
is not there any more or its amplitude is another."""
import csv, io, math, pathlib, subprocess, sys

HERE = pathlib.Path(__file__).resolve().parent
CASES = HERE.parents[2] / "cases/paper"
FIELDS = ["oscillator.mass", "oscillator.damping", "oscillator.stiffness", "forcing.amplitude"]
CONTACT = ["tangential_stiffness", "normal_stiffness", "friction", "angle_deg", "gap"]
PER_CASE = 16  # frequencies


def rows(*arguments):
    text = subprocess.run([sys.argv[1], *arguments, "--format", "csv", "-q"], capture_output=True, text=True).stdout
    table = text.split("\n\n")[0]
    return list(csv.DictReader(io.StringIO("\n".join(line for line in table.split("\n") if not line.startswith("#")))))


def orbits(case):
    values = {row["field"]: row["value"] for row in rows("describe", "--case", str(case))}
    contact = [values[f"contacts[0].{name}"] for name in CONTACT]
    if "contacts[1].gap" in values: return
    yield f"== {' '.join(values[name] for name in FIELDS)} | {' '.join(contact)}"
    low, high = map(float, values["sweep.omega"].strip("[]").split(","))
    at = ",".join(f"{low + (high - low) * (i + 0.5) / PER_CASE:.4g}" for i in range(PER_CASE))
    for row in rows("prove", str(case), "--at", at, "--set", "hbm.harmonics=20", "--set", "hbm.static=true"):
        if row["verdict"] == "proven":
            yield f"{float(row['omega']):.6g} {float(row['amplitude_low']):.8g} {row['stability']}"


def same(said, found):
    if said.startswith("==") or found.startswith("=="): return said == found
    (a, x, s), (b, y, t) = said.split(), found.split()
    return a == b and s == t and math.isclose(float(x), float(y), rel_tol=2e-8)


def main():
    found, seen = [], set()
    for case in sorted(CASES.glob("*.yaml")):
        lines = list(orbits(case))
        if lines and lines[0] not in seen: found += lines
        seen.update(lines[:1])
    path = HERE / "proven.txt"
    if "--check" not in sys.argv: path.write_text("\n".join(found) + "\n")
    said = path.read_text().splitlines()
    wrong = [f"{a} in proven.txt, {b} now" for a, b in zip(said, found) if not same(a, b)]
    if len(said) != len(found): wrong.append(f"{len(said)} lines in proven.txt, {len(found)} now")
    print("\n".join(wrong[:10]) or f"{sum(not line.startswith('==') for line in found)} proven orbits of {len(seen)} cases")
    return 1 if wrong else 0


sys.exit(main())
