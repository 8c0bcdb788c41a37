#!/usr/bin/env python3
"""right_curves.py HBMCHECK [--only SCENE] - right curves of every quantity on the eight reference scenes, of several
makes: `hbmcheck verify` must blame none of them. right_curves.py --make [SCENE...] computes right/SCENE.csv again.
right_curves.py HBMCHECK --random N [FIRST] - right curves of random scenes, oscillators and structures in turn, of
one quantity of one make each: every solution, the stable ones alone, or one branch of 100 harmonics (at omegas where
60 give the same), or the motions from rest under the exact law, one of a family where sliders may rest anywhere.

    reference  tests/reference/transient_exact.csv: swept up from rest, and down; the mean is the history's
    rest       `hbmcheck transient` from rest
    hbm        `hbmcheck frf`, 50 harmonics, every solution
    aft        right/SCENE.csv: by aft.py, every solution; every quantity, x'' from the equation of motion

Where a slider never slips the mean and all that contains it is open, so such points may be skipped; no other may.
exit: 0 none is blamed  1 some are  64 usage"""
import csv
import datetime
import io
import json
import math
import pathlib
import random
import re
import subprocess
import sys
import tempfile

import aft
import make_curves

HERE = pathlib.Path(__file__).resolve().parent
TESTS = HERE.parents[2]
PATIENCE, MAKING = 60, 10  # seconds of processor time for one command; for one that makes a random curve
OPEN = {"peak", "max", "min", "mean", "rms", "norm"}  # where a slider never slips

SCENE = re.compile(r'\{"(\w+)",' + r" ([-\d.e]+)," * 8 + r" ([-\d.e]+)\}")


def scenes():
    """name: [mass, damping, stiffness, force, kt, kn, gap, omega_from, omega_to], from tests/reference_scenes.h."""
    found = SCENE.findall((TESTS / "reference_scenes.h").read_text())
    assert len(found) == 8, found
    return {name: [float(number) for number in numbers] for name, *numbers in found}


def case_text(numbers):
    m, c, k, f, kt, kn, gap, low, high = numbers
    return (f"oscillator: {{mass: {m}, damping: {c}, stiffness: {k}}}\nforcing: {{amplitude: {f}}}\n"
            f"contacts:\n  - {{tangential_stiffness: {kt}, normal_stiffness: {kn}, friction: 0.3, angle_deg: 45, "
            f"gap: {gap}}}\n"
            f"sweep: {{omega: [{low}, {high}]}}\n")


def reference(file, scene):
    with open(TESTS / "reference" / file, encoding="ascii") as rows:
        return [row for row in csv.DictReader(rows) if row["case"] == scene]


def omegas(scene):
    return sorted({float(row["omega"]) for row in reference("hbm_exact.csv", scene)})


def with_derived(row):
    """The quantities of one solution, and those that follow from them."""
    q = {name: float(row[name]) for name in QUANTITIES if row.get(name, "") != ""}
    q["double_amplitude"] = 2 * q["amplitude"]
    q["peak"] = max(abs(q["max"]), abs(q["min"]))
    for name in ("amplitude", "harmonic_1", "rms", "velocity"):
        if q.get(name, 0) > 0:
            q["dB_" + name] = 20 * math.log10(q[name])
    return float(row["omega"]), q


QUANTITIES = ("amplitude", "double_amplitude", "peak", "max", "min", "mean", "rms", "norm", "harmonic_1", "harmonic_2",
              "harmonic_3", "velocity", "acceleration", "velocity_harmonic_1", "acceleration_harmonic_1")

# ---- by aft.py ----

HARMONICS = {"c2kn1e4": (60, 8192), "c2kt1e4": (60, 8192)}  # stiff; others (30, 4096)


def unit_free(numbers):
    """The oscillator in units in which its numbers are near 1, and those units: length, time."""
    m, c, k, f, kt, kn, gap, _, _ = numbers
    length, time = (0.3, 0.01) if k > 1e4 else (1.0, 1.0)
    stiff = time * time / m
    return aft.Oscillator(1.0, c * time / m, k * stiff, f * stiff / length, kt * stiff, kn * stiff, 0.3, 45.0,
                          gap / length), length, time


def acceleration_of(e, omega, X):
    """(max x'' - min x'')/2 over the samples, x'' = (F0 cos(th) - C x' - K x - f)/M."""
    D = make_curves.derived(X, omega)
    x = [sum(map(aft.mul, row, X)) for row in e.rows]
    v = [sum(map(aft.mul, row, D)) for row in e.rows]
    f = aft.follow(e.o, e.code, x)[0]
    a = [(e.o.force * row[1] - e.o.damping * v[i] - e.o.stiffness * x[i] - f[i]) / e.o.mass
         for i, row in enumerate(e.rows)]
    return (max(a) - min(a)) / 2


def make(scene, numbers):
    o, length, time = unit_free(numbers)
    coarse = aft.Equations(o, aft.Code(harmonics=10, samples=512))
    harmonics, samples = HARMONICS.get(scene, (30, 4096))
    fine = aft.Equations(o, aft.Code(harmonics=harmonics, samples=samples))
    path = aft.trace(coarse, numbers[-2] * time, numbers[-1] * time, 0.03 if time != 1 else 0.3)  # r1, r2: sharp peaks
    lines = ["# By right_curves.py --make: every solution at the omegas of tests/reference/hbm_exact.csv",
             ",".join(("omega",) + QUANTITIES)]
    for omega, _, X in aft.solutions(coarse, path, [w * time for w in omegas(scene)]):
        try:
            X = aft.newton(fine, X + [0.0] * (2 * harmonics + 1 - len(X)), omega)[0]
        except aft.NoSolution:
            continue  # next to a turn
        high, low = make_curves.extent(X)
        h = [math.hypot(X[2 * k - 1], X[2 * k]) for k in (1, 2, 3)]
        q = [(high - low) / 2, high - low, max(abs(high), abs(low)), high, low, X[0],
             math.hypot(X[0], math.hypot(*X[1:]) / math.sqrt(2)), math.hypot(*X)] + h
        rates = [make_curves.half_range(make_curves.derived(X, omega)) / time,
                 acceleration_of(fine, omega, X) / time ** 2, omega * h[0] / time, omega ** 2 * h[0] / time ** 2]
        lines.append(",".join(f"{value:.9g}" for value in [omega / time] + [length * a for a in q + rates]))
    (HERE / "right").mkdir(exist_ok=True)
    (HERE / "right" / f"{scene}.csv").write_text("\n".join(lines) + "\n")
    print(f"{scene}: {len(lines) - 2} solutions", flush=True)


# ---- the curves, and what verify says ----

def command(*arguments, seconds=PATIENCE):
    limited = ["prlimit", f"--cpu={seconds}", *map(str, arguments)]
    run = subprocess.run(limited, capture_output=True, text=True, check=False)
    if run.returncode < 0:
        raise subprocess.TimeoutExpired(limited, seconds)
    return run


def computed(binary, case, what, at, *settings, seconds=PATIENCE):
    sets = [a for s in settings for a in ("--set", s)]
    run = command(binary, what, case, "--at", ",".join(f"{w:.12g}" for w in at), "--format", "csv", "-q", *sets,
                  seconds=seconds)
    lines = [line for line in run.stdout.split("\n") if line and not line.startswith("#")]
    rows = csv.DictReader(io.StringIO("\n".join(lines)))
    return [row for row in rows
            if row.get("verdict", "settled") == "settled" and row.get("period_multiple", "1") in "01"]


def makes(binary, scene, case):
    """(make, rows) of the scene's right curves."""
    at = omegas(scene)
    swept = reference("transient_exact.csv", scene)
    yield "reference up", [row for row in swept if row["sweep"] == "up"]
    yield "reference down", [row for row in swept if row["sweep"] == "down"]
    yield "rest", computed(binary, case, "transient", at, "transient.start=rest")
    yield "hbm", computed(binary, case, "frf", at, "hbm.harmonics=50")
    with open(HERE / "right" / f"{scene}.csv", encoding="ascii") as rows:
        yield "aft", list(csv.DictReader(line for line in rows if not line.startswith("#")))


def blamed(binary, case, curve, name):
    """What verify holds against the curve of that quantity; "" for nothing."""
    columns = f"omega=1,{name}=2"
    try:
        run = command(binary, "verify", case, "--against", curve, "--columns", columns, "--format", "json", "-q")
    except subprocess.TimeoutExpired:
        return f"no answer within {PATIENCE} s"
    if run.returncode not in (0, 1, 3) or not run.stdout:
        return f"exit {run.returncode}: {run.stderr.strip()}"
    s = json.loads(run.stdout)["Summary"][0]
    wrong = [f"{key} {s[key]}" for key in ("cause", "nearest_guess") if s[key] not in (None, "none")]
    wrong += [f"{key} {s[key]}" for key in ("differs", "other_branch", "solver_failed", "left_out") if s[key]]
    if s["skipped"] and name.removeprefix("dB_") not in OPEN:
        wrong.append(f"skipped {s['skipped']}")
    return "; ".join(wrong)


def judge(binary, scene, case, curve):
    """How many curves of the scene there are, and how many of them are blamed."""
    curves = failed = 0
    for source, rows in makes(binary, scene, case):
        points = [with_derived(row) for row in rows]
        for name in points[0][1] if points else ["amplitude"]:  # no points: an empty file, which fails
            lines = [f"omega,{name}"] + [f"{w:.12g},{q[name]:.12g}" for w, q in points]
            curve.write_text("\n".join(lines) + "\n")
            wrong = blamed(binary, case, curve, name)
            curves, failed = curves + 1, failed + bool(wrong)
            if wrong:
                print(f"{scene}, {source}, {name}, {len(points)} points: {wrong}", flush=True)
    return curves, failed


# ---- random scenes ----

KINDS = ([], ["--structures"], [], ["--space"])
RANDOM_QUANTITIES = ("amplitude", "max", "min", "rms", "mean", "harmonic_1")
BRANCHES = ("every solution", "stable ones", "one branch", "from rest")


def same_curves(rows, others, key):
    """Those of the rows whose quantity one of the others' at the same omega has to a tenth of the gate."""
    near = {}
    for row in others:
        near.setdefault(row["omega"], []).append(row)
    return [r for r in rows if any(abs(float(o[key]) - float(r[key])) <= 1e-4 * float(r["amplitude"])
                                   for o in near.get(r["omega"], []))]


def count_at(rows, omega):
    return sum(r["omega"] == omega for r in rows)


def random_curve(binary, case, rng, quantity, which):
    """(response, rows) of the case's first response."""
    low, high = map(float, re.search(r"omega: \[(.*), (.*)\]\n", case.read_text()).groups())
    at = sorted(low + (high - low) * (k + rng.random()) / 24 for k in range(24))
    exact = ("transient.law=exact", "transient.method=closed_form", "hbm.static=true", "hbm.force=exact")
    if which == "from rest":
        rows = computed(binary, case, "transient", at, "transient.start=rest", *exact, seconds=MAKING)
    else:
        rows, fewer = (computed(binary, case, "frf", at, f"hbm.harmonics={h}", *exact, seconds=MAKING)
                       for h in (100, 60))
        every, rows = rows, same_curves(rows, [r for r in fewer if r["amplitude"]], quantity)
        if which == "every solution":  # an unstable one without the stable one beside it is a mistake
            rows = [r for r in rows if count_at(rows, r["omega"]) == count_at(every, r["omega"])]
    response = next((r.get("response") for r in rows), None)
    rows = [r for r in rows if r.get("response") == response]
    if which == "stable ones":
        rows = [r for r in rows if r["stable"] == "yes"]
    if which == "one branch":
        branch = rng.choice([r["branch"] for r in rows] or [""])
        rows = [r for r in rows if r["branch"] == branch]
    return rows


def judge_random(binary, wanted, first, folder):
    """How many right curves there were of scenes from number `first` on, how many blamed, could not be judged."""
    rng, curves, failed, unjudged, i = random.Random(first), 0, 0, 0, first
    case, curve = folder / "scene.yaml", folder / "curve.csv"
    while curves < int(wanted):
        command(binary, "stress", "--case", "--first", i, "-o", case, *KINDS[i % len(KINDS)])
        which, name = BRANCHES[i // len(KINDS) % len(BRANCHES)], rng.choice(RANDOM_QUANTITIES)
        try:
            rows = random_curve(binary, case, rng, name, which)
        except subprocess.TimeoutExpired:
            rows = []
        i += 1
        unstable = [r["stable"] != "yes" for r in rows if "stable" in r]
        if len(rows) < 4 or (unstable and all(unstable)) or (which == "one branch" and any(unstable)):
            continue  # unstable solutions alone are a mistake
        curve.write_text("\n".join([f"omega,{name}"] + [f"{r['omega']},{r[name]}" for r in rows]) + "\n")
        wrong = blamed(binary, case, curve, name)
        if re.fullmatch(r"cause unknown(; solver_failed \d+)?(; skipped \d+)?|solver_failed \d+(; skipped \d+)?", wrong):
            unjudged += 1  # no point is said to differ
            continue
        curves, failed = curves + 1, failed + bool(wrong)
        if wrong:
            print(f"{i - 1} {KINDS[(i - 1) % len(KINDS)]}, {which}, {name}, {len(rows)} points: {wrong}", file=sys.stderr)
    return curves, failed, unjudged, i - first


def main(arguments):
    if arguments[1:2] == ["--random"] and len(arguments) in (3, 4):
        first = int(arguments[3]) if len(arguments) == 4 else 0
        with tempfile.TemporaryDirectory() as folder:
            curves, failed, unjudged, drawn = judge_random(*arguments[:3:2], first, pathlib.Path(folder))
        print(f"## Right curves of random scenes, {datetime.date.today():%-d %B %Y}\n\n| what | number |\n|---|---|\n"
              f"| random scenes, from {first} on | {drawn} |\n| right curves | {curves} |\n| blamed | {failed} |\n"
              f"| others, of which it is said that they cannot be judged | {unjudged} |")
        return 1 if failed or not curves else 0
    if arguments[:1] == ["--make"]:
        for scene, numbers in scenes().items():
            if not arguments[1:] or scene in arguments[1:]:
                make(scene, numbers)
        return 0
    if len(arguments) not in (1, 3) or (len(arguments) == 3 and arguments[1] != "--only"):
        print(__doc__, file=sys.stderr)
        return 64
    binary, only = arguments[0], arguments[2] if len(arguments) == 3 else ""
    curves = failed = 0
    with tempfile.TemporaryDirectory() as folder:
        for scene, numbers in scenes().items():
            if only in ("", scene):
                case = pathlib.Path(folder) / f"{scene}.yaml"
                case.write_text(case_text(numbers))
                tried, wrong = judge(binary, scene, case, pathlib.Path(folder) / "curve.csv")
                curves, failed = curves + tried, failed + wrong
    print(f"{curves} right curves, {failed} blamed")
    return 1 if failed or not curves else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
