#!/usr/bin/env python3
"""What both sides said beforehand against what compare found (docs/measurements/predictions.md).

usage: prediction.py HBMCHECK [STRESS.csv]
The rows: the reference scenes at the frequencies of tests/reference/transient_exact.csv, and every case of cases/paper, with
H = 3, 5, 10, 30, both laws, exact and sampled forces. STRESS.csv: of `hbmcheck stress --all --format csv`. Standard library only."""
import csv, glob, math, os, statistics, subprocess, sys, tempfile

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
SCENES = {  # M C K F0 kt kn gap from to: tests/reference_scenes.h
    "a10": (1, .4, 40, 10, 100, 200, .5, 3, 20), "b10": (1, .4, 40, 10, 100, 200, -.5, 3, 20),
    "c2": (1, .4, 40, 100, 100, 1000, -5, 3, 20), "c2kn1e4": (1, .4, 40, 100, 100, 1e4, -5, 3, 20),
    "c2kt1e4": (1, .4, 40, 100, 1e4, 1000, -5, 3, 20), "gap1": (1, .4, 40, 100, 100, 1000, 1, 3, 30),
    "r1": (1.6, .4, 8e5, 100, 5e5, 7e5, .3, 750, 1050), "r2": (1.6, .4, 8e5, 100, 5e5, 7e5, -.2, 600, 850)}
SETTINGS = [["hbm.harmonics=%d" % h, "transient.law=" + law] + force
            for h in (3, 5, 10, 30)
            for law, force in (("regularised", []), ("exact", []), ("exact", ["hbm.force=sampled", "hbm.samples=256"]))]
BINS = [0.01, 0.03, 0.1, 0.3, 1, 3, 10, math.inf]


def case_file(name, folder):
    m, c, k, f, kt, kn, gap, a, b = SCENES[name]
    path = os.path.join(folder, name + ".yaml")
    with open(path, "w") as out:
        out.write(f"oscillator: {{mass: {m!r}, damping: {c!r}, stiffness: {float(k)!r}}}\nforcing: {{amplitude: {f!r}}}\ncontacts:\n"
                  f"  - {{tangential_stiffness: {float(kt)!r}, normal_stiffness: {float(kn)!r}, friction: 0.3, angle_deg: 45, gap: {gap!r}}}\n"
                  f"sweep: {{omega: [{a!r}, {b!r}]}}\n")
    return path


def compare(exe, path, sets, at=None):
    args = [exe, "compare", path, "--quiet", "--format", "csv"] + [x for s in sets for x in ("--set", s)]
    if at: args += ["--at", ",".join(at)]
    out = subprocess.run(args, capture_output=True, text=True).stdout
    return list(csv.DictReader(l for l in out.splitlines() if l and not l.startswith("#")))


def rows(exe):
    """(name, omega, settings, observed, said) of every row on one orbit where a contact does something."""
    omegas = {}
    with open(os.path.join(ROOT, "tests/reference/transient_exact.csv")) as table:
        for r in csv.DictReader(table): omegas.setdefault(r["case"], set()).add(r["omega"])
    with tempfile.TemporaryDirectory() as folder:
        jobs = [(n, case_file(n, folder), sorted(omegas[n], key=float)) for n in SCENES]
        jobs += [(os.path.basename(p)[:-5], p, None) for p in sorted(glob.glob(os.path.join(ROOT, "cases/paper/*.yaml")))]
        for name, path, at in jobs:
            for sets in SETTINGS:
                for r in compare(exe, path, sets, at):
                    if r["verdict"] not in ("match", "differs") or not r["hbm_predicted"] or not r["transient_predicted"]: continue
                    if float(r["from_truncation"] or "inf") < 1e-13: continue  # nothing happens at the contacts
                    yield name, r["omega"], " ".join(sets), float(r["amplitude_error"]), float(r["hbm_predicted"]) + float(r["transient_predicted"])


def histogram(title, ratios):
    print(f"\n{title}: {len(ratios)} rows; observed <= 3 x said in {100 * sum(x <= 3 for x in ratios) / len(ratios):.2f} %; "
          f"median said/observed {1 / max(statistics.median(ratios), 1e-99):.2f}\n\n| observed/said | rows | |\n|---|---|---|")
    low = 0
    for high in BINS:
        n = sum(low < x <= high or (low == 0 and x == 0) for x in ratios)
        print(f"| {low:g} .. {high:g} | {n} | {'#' * round(60 * n / len(ratios))} |")
        low = high


def main(argv):
    found = list(rows(argv[1]))
    histogram("Reference scenes and the paper's cases", [o / s if o else 0 for _, _, _, o, s in found])
    worst = sorted((x for x in found if x[3] > 3 * x[4]), key=lambda x: -x[3] / x[4])
    print(f"\nwithout bound: {sum(math.isinf(s) for *_, s in found)}; beyond 3: {len(worst)}")
    for name, omega, sets, o, s in worst[:40]: print(f"- {name} at {omega}, {sets}: observed {o:.2e}, said {s:.2e}")
    if len(argv) > 2:
        with open(argv[2]) as table:
            lines = [l for l in table if l.count(",") > 4 and ",prediction," in l]
        ratios = [float(l.split(",")[4]) for l in lines if l.split(",")[2] != "skipped" and l.split(",")[4]]
        if ratios: histogram("Random scenes", ratios)


if __name__ == "__main__": main(sys.argv)
