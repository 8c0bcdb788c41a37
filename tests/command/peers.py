#!/usr/bin/env python3
"""Other programs' examples, cases/peers: at their numbers of samples our curve is theirs, to 1e-6 of the amplitude.

    peers.py HBMCHECK ROOT

Two programs that solve the same sampled equations differ by their residuals alone (1e-10 and better was seen)."""
import csv
import glob
import os
import re
import subprocess
import sys

HBMCHECK, ROOT = sys.argv[1:3]


def rows(*words):
    p = subprocess.run([HBMCHECK, *words, "--format", "csv"], capture_output=True, text=True, check=False)
    assert p.returncode == 0, f"{words} gave {p.returncode}: {p.stderr[-400:]}"
    return list(csv.DictReader(line for line in p.stdout.splitlines() if line and line[0] != "#"))


def is_on_our_curve(case, theirs):
    with open(theirs, encoding="ascii") as f:
        points = list(csv.DictReader(f))[::4]
    ours = rows("frf", case, "--at", ",".join(p["omega"] for p in points), "--set", "hbm.force=sampled", "--set",
                "hbm.skip_linear=false")
    for p in points:
        omega, theirs_1 = float(p["omega"]), [float(v) for name, v in p.items() if name != "omega"]
        found = {}
        for r in ours:
            if abs(float(r["omega"]) - omega) < 1e-12 * omega:
                found.setdefault(r["branch"], []).append(float(r["harmonic_1"]))
        off = min((max(abs(a - b) for a, b in zip(h, theirs_1)) for h in found.values()), default=1)
        assert off <= 1e-6 * max(theirs_1), f"{case} at {omega}: {theirs_1}, and here {found}"
    return len(points)


def two_solutions_meet_at_a_turning_point(case):
    """On its one side the curve has two more than on the other, however near: to 1e-9 of omega, where rounding moves it."""
    p = subprocess.run([HBMCHECK, "frf", case, "--format", "json"], capture_output=True, text=True, check=True)
    turns = [float(w) for w in re.findall(r"turning point at omega = ([0-9.]+)", p.stdout)]
    assert turns, case
    for turn in turns:
        at = [turn * (1 + side * 10.0 ** -k) for k in range(5, 10) for side in (-1, 1)]
        found = [(float(r["omega"]), r["branch"]) for r in rows("frf", case, "--at", ",".join(map(repr, at)))]
        counts = [len({b for w, b in found if abs(w - omega) < 1e-13 * omega}) for omega in at]
        below, above = counts[::2], counts[1::2]
        assert len(set(below)) == len(set(above)) == 1 and abs(below[0] - above[0]) == 2, f"{case} at {turn}: {counts}"


for name in ("peers/nlvib_01", "peers/nlvib_02", "peers/ansys_1", "paper/case2", "structures/wedge_F10"):
    two_solutions_meet_at_a_turning_point(os.path.join(ROOT, f"cases/{name}.yaml"))
checked = [is_on_our_curve(path[:-4] + ".yaml", path) for path in glob.glob(os.path.join(ROOT, "cases/peers/*.csv"))]
assert len(checked) >= 7 and min(checked) >= 6, checked
