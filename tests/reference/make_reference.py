#!/usr/bin/env python3
"""Make the reference values of this folder, or hold those that stand here against what is made (Python 3 alone).

usage: make_reference.py [--check] [--only hbm|peak|transient]... [--case NAME]...
  without --check  prints the tables as csv, each after a line "# FILE", at the frequencies of the files beside this one
  --check          prints the worst difference per table, case and column, and what is off, in a minute or two
exit: 0 all within the limits of README.md  1 something is not  2 wrong usage
example: make_reference.py --check --only transient --case c2
"""
import argparse
import csv
import os
import sys

sys.dont_write_bytecode = True      # leave nothing in the source tree

import harmonic_balance
import transient
from contact_law import SCENES

HERE = os.path.dirname(os.path.abspath(__file__))
FILES = {"hbm": "hbm_exact.csv", "peak": "hbm_peak.csv", "transient": "transient_exact.csv"}
RESPONSE = ("amplitude", "max", "min", "harmonic_1", "mean")
LIMIT = 1e-9            # of the row's amplitude
BELOW_TOP = 1e-4        # a peak's row is the highest point of a run, this much below the top at most
BESIDE_TOP = 1e-3       # and its omega this far from the top's


def read(kind, cases):
    with open(os.path.join(HERE, FILES[kind]), newline="") as f:
        reader = csv.DictReader(f)
        return reader.fieldnames, [row for row in reader if row["case"] in cases]


class Report:
    """Worst differences and what is off."""

    def __init__(self):
        self.off = 0

    def say(self, kind, case, worst, notes=()):
        print("%-9s %-8s %s" % (kind, case, "  ".join("%s %.1e" % w for w in worst.items())), *notes, flush=True)

    def fault(self, *words):
        self.off += 1
        print("off:", *words, flush=True)


def curves(cases):
    """{(case, harmonics, static): (curve, rows wanted, peak row wanted)}: one run serves both tables."""
    _, rows = read("hbm", cases)
    _, peaks = read("peak", cases)
    for peak in peaks:
        key = peak["case"], int(peak["harmonics"]), int(peak["static"])
        wanted = [r for r in rows if (r["case"], int(r["harmonics"]), int(r["static"])) == key]
        omegas = {float(r["omega"]) for r in wanted}
        at_peak = float(peak["omega_at_peak"])
        curve = harmonic_balance.Curve(SCENES[key[0]], key[1], bool(key[2]), omegas | {at_peak})
        beside = [r for r in curve.rows if r[1] == at_peak]
        curve.rows = [r for r in curve.rows if r[1] in omegas]
        yield key, curve, wanted, peak, beside


def print_hbm(kinds, cases):
    tables = {kind: [",".join(read(kind, cases)[0])] for kind in kinds}
    for key, curve, _, _, _ in curves(cases):
        start = "%s,%d,%d" % key
        for branch, omega, values in curve.rows:
            tables.get("hbm", []).append("%s,%d,%s" % (start, branch, numbers((omega,) + values)))
        omega, values = curve.top
        tables.get("peak", []).append("%s,%s" % (start, numbers((omega, values[0], values[3]))))
    for kind in kinds:
        print("# " + FILES[kind], *tables[kind], sep="\n")


def numbers(values):
    return ",".join("%.12g" % v for v in values)


def check_hbm(kinds, cases, report):
    worst = {}
    for key, curve, wanted, peak, beside in curves(cases if kinds else []):
        name = "%s H=%d static=%d" % key
        if "hbm" in kinds:
            compare_rows(name, curve, wanted, worst.setdefault(("hbm", key[0]), dict.fromkeys(RESPONSE, 0.0)), report)
        if "peak" in kinds:
            compare_peak(name, curve, peak, beside, worst.setdefault(("peak", key[0]), {}), report)
    for (kind, case), figures in sorted(worst.items()):
        report.say(kind, case, figures)


def compare_rows(name, curve, wanted, worst, report):
    made = [(b, w) for b, w, _ in curve.rows]
    asked = [(int(r["branch"]), float(r["omega"])) for r in wanted]
    if made != asked:
        report.fault(name, "branch, omega made %s, not %s" % (made, asked))
        return
    for row, (branch, omega, values) in zip(wanted, curve.rows):
        for column, value in zip(RESPONSE, values):
            difference = abs(value - float(row[column])) / float(row["amplitude"])
            worst[column] = max(worst[column], difference)
            if not difference <= LIMIT:
                place = "%s branch %d omega %g %s" % (name, branch, omega, column)
                report.fault("%s: %.12g, not %s" % (place, value, row[column]))


def compare_peak(name, curve, peak, beside, worst, report):
    """The row is a solution of the curve, and the top hardly above it, unless the curve rises to its very end."""
    amplitude, omega, harmonic_1 = (float(peak[c]) for c in ("peak_amplitude", "omega_at_peak", "harmonic_1_at_peak"))
    off = min([max(abs(v[0] - amplitude), abs(v[3] - harmonic_1)) / amplitude for _, _, v in beside] + [float("inf")])
    figures = {"on the curve": off}
    if not curve.at_end:
        top = curve.top[1][0]
        figures.update({"below the top": top / amplitude - 1, "omega": abs(curve.top[0] / omega - 1)})
    for what, value in figures.items():
        worst[what] = max(worst.get(what, 0.0), value)
    if not off <= LIMIT:
        report.fault("%s: no solution at the peak's omega within %.1e: %.1e" % (name, LIMIT, off))
    if not (-LIMIT <= figures.get("below the top", 0) <= BELOW_TOP and figures.get("omega", 0) <= BESIDE_TOP):
        report.fault("%s: the top is %r" % (name, curve.top))


def sweeps(cases):
    _, rows = read("transient", cases)
    for case in cases:
        for direction in ("up", "down"):
            wanted = [r for r in rows if r["case"] == case and r["sweep"] == direction]
            omegas = [float(r["omega"]) for r in wanted]
            states = transient.sweep(SCENES[case], omegas)
            for row, omega in zip(wanted, omegas):
                state = states[omega]
                yield case, row, omega, state and transient.measure(SCENES[case], omega, state)


def print_transient(cases):
    print("# " + FILES["transient"], ",".join(read("transient", cases)[0]), sep="\n")
    for case, row, omega, values in sweeps(cases):
        if values:
            print("%s,%s,%s,%d,%.1e" % (case, row["sweep"], numbers((omega,) + values[:5]), values[5], values[6]))
        else:
            print("%s %s: no motion of one period settled at omega %g" % (case, row["sweep"], omega), file=sys.stderr)


def check_transient(cases, report):
    worst = {case: dict.fromkeys(RESPONSE + ("closure",), 0.0) for case in cases}
    stuck = dict.fromkeys(cases, 0)
    counted = dict.fromkeys(cases, 0)
    for case, row, omega, values in sweeps(cases):
        scene, name = SCENES[case], "%s %s omega %g" % (case, row["sweep"], omega)
        if not values:
            report.fault(name, "no motion of one period settled")
            continue
        given = {c: float(row[c]) for c in RESPONSE}
        made, amplitude = dict(zip(RESPONSE, values)), given["amplitude"]
        if values[5] == 0 and abs(made["mean"] - given["mean"]) > LIMIT * amplitude:
            size, low, high = transient.stuck_means(scene, omega)
            if low <= given["mean"] + LIMIT * size and given["mean"] - LIMIT * size <= high:
                stuck[case] += 1                # the slider may rest where it does: the mean is the sweep's own
                made.update({"mean": given["mean"], "max": given["mean"] + size, "min": given["mean"] - size})
        for column in RESPONSE:
            difference = abs(made[column] - given[column]) / amplitude
            worst[case][column] = max(worst[case][column], difference)
            if not difference <= LIMIT:
                report.fault("%s %s: %.12g, not %s" % (name, column, made[column], row[column]))
        worst[case]["closure"] = max(worst[case]["closure"], values[6] / amplitude)
        # Where a contact leaves without having slipped, traction and limit vanish together: rounding may count a slip.
        more = int(row["events_per_period"]) - values[5]
        counted[case] += more == 1
        if more and not (more == 1 and scene.pull <= scene.grip and values[5] == 2):
            report.fault("%s: %d transitions, not %s" % (name, values[5], row["events_per_period"]))
    for case in cases:
        notes = ["%d stuck means by history" % stuck[case]] * (stuck[case] > 0)
        report.say("transient", case, worst[case], notes + ["%d counts one more" % counted[case]] * (counted[case] > 0))


def main():
    parser = argparse.ArgumentParser(usage=__doc__.split("usage: ")[1])
    parser.add_argument("--check", action="store_true")
    parser.add_argument("--only", action="append", choices=FILES)
    parser.add_argument("--case", action="append", choices=SCENES)
    options = parser.parse_args()
    kinds, cases = options.only or list(FILES), options.case or list(SCENES)
    of_hbm = [k for k in kinds if k != "transient"]
    report = Report()
    if options.check:
        check_hbm(of_hbm, cases, report)
        check_transient(cases if "transient" in kinds else [], report)
    else:
        if of_hbm:
            print_hbm(of_hbm, cases)
        if "transient" in kinds:
            print_transient(cases)
    return 1 if report.off else 0


if __name__ == "__main__":
    sys.exit(main())
