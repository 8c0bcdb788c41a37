#!/usr/bin/env python3
"""Steady states that other programs found (tests/reference/transient_exact.csv, steady_states.csv) against proven enclosures.

    test_references.py HBMCHECK [CASE...]      names those outside of every orbit that is proven at their omega; exit 1 if there are any

Inside: amplitude, harmonic 1 and mean to half a unit of their twelfth digit. The mean counts where no slider rests all period: else it is a
matter of history. steady_states.csv: of cases in cases/structures, by exact propagation between events with matrix exponentials, a program
that shares nothing with this one, good to 1e-11; response counts the case's from 1. Steady states that are families are left out.
"""
import csv
import subprocess
import sys
import tempfile
from fractions import Fraction
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
SCENES = {"a10": (1, .4, 40, 10, 100, 200, .5), "b10": (1, .4, 40, 10, 100, 200, -.5), "c2": (1, .4, 40, 100, 100, 1000, -5),
          "c2kn1e4": (1, .4, 40, 100, 100, 1e4, -5), "c2kt1e4": (1, .4, 40, 100, 1e4, 1000, -5), "gap1": (1, .4, 40, 100, 100, 1000, 1),
          "r1": (1.6, .4, 8e5, 100, 5e5, 7e5, .3), "r2": (1.6, .4, 8e5, 100, 5e5, 7e5, -.2)}
DIGITS = Fraction(5, 10 ** 12)


def scene(name, omegas, folder):
    mass, damping, stiffness, force, kt, kn, gap = SCENES[name]
    path = Path(folder, f"{name}.yaml")
    path.write_text(f"oscillator: {{mass: {mass}, damping: {damping}, stiffness: {stiffness}}}\nforcing: {{amplitude: {force}}}\n"
                    f"contacts:\n  - {{tangential_stiffness: {kt}, normal_stiffness: {kn}, friction: 0.3, angle_deg: 45, gap: {gap}}}\n"
                    f"sweep: {{omega: [{min(omegas)}, {max(omegas)}]}}\n")
    return path


def proven(hbmcheck, case, omegas, response):
    command = [hbmcheck, "prove", case, "--at", ",".join(map(str, omegas)), "--format", "csv", "-q"] + (["--response", response] if response else [])
    done = subprocess.run(command, capture_output=True, text=True, timeout=600)
    return [row for row in csv.DictReader(line for line in done.stdout.splitlines() if not line.startswith("#")) if row["verdict"] == "proven"]


def off(row, given):
    """How far outside the enclosures the given numbers are, of the amplitude: at most; 0: inside, to their digits."""
    amplitude, worst = Fraction(given["amplitude"]), 0
    for name, text in given.items():
        value, low, high = Fraction(text), Fraction(row[name + "_low"]), Fraction(row[name + "_high"])
        worst = max(worst, max(low - value, value - high) - DIGITS * max(abs(value), amplitude))
    return float(worst / amplitude)


def references(only):
    """{(case, response): [(omega, row)]}"""
    found = {}
    for row in csv.DictReader(open(ROOT / "tests/reference/transient_exact.csv")):
        found.setdefault((row["case"], None), []).append((row["omega"], row))
    for row in csv.DictReader(open(HERE / "steady_states.csv")):
        found.setdefault((row["case"], int(row["response"])), []).append((row["omega"], row))
    return {key: rows for key, rows in found.items() if not only or key[0] in only}


def main(hbmcheck, *only):
    inside, outside, none = 0, [], []
    with tempfile.TemporaryDirectory() as folder:
        for (case, number), rows in references(only).items():
            omegas = sorted({omega for omega, _ in rows}, key=float)
            path = scene(case, list(map(float, omegas)), folder) if number is None else ROOT / f"cases/structures/{case}.yaml"
            names = [line for line in path.read_text().splitlines() if line.startswith("response:")]
            response = names[0].split("[")[1].rstrip("]").split(",")[number - 1].strip() if number else None
            at = proven(hbmcheck, str(path), omegas, response)
            for omega, given in rows:
                candidates = [r for r in at if float(r["omega"]) == float(omega)]
                rests = lambda r: any(set(letters) == {"S"} for letters in zip(*r["states"].split())) and "O" not in r["states"]
                distance = [off(r, {k: given[k] for k in ("amplitude", "harmonic_1") + (("mean",) if not rests(r) else ())}) for r in candidates]
                where = (case, omega, number, given.get("sweep", ""))
                if not distance:
                    none.append(where + ("no orbit is proven",))
                elif min(distance) <= 0:
                    inside += 1
                else:
                    outside.append(where + (f"outside by {min(distance):.1e} of the amplitude",))
    for where in outside + none:
        print(*where)
    print(f"{inside} inside, {len(outside)} outside, {len(none)} without a proven orbit")
    return bool(outside or none or not inside)


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
