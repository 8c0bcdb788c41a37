#!/usr/bin/env python3
"""A benchmark, not a test: whole response curves of structures by NLvib or tmdsimpy and by hbmcheck, times and answers side by side.

usage: versus_peer.py nlvib|tmdsimpy FOLDER BUILD [CASE...] [--rounds R] [--samples N] [--limit S] [--keep FOLDER]
  FOLDER   the peer, as its repository is: NLvib with SRC/ in it (github.com/maltekrack/NLvib), run by Debian's octave;
           tmdsimpy with tmdsimpy/ in it (github.com/tmd-lab/tmdsimpy), run by Debian's python3 with python3-numpy and python3-scipy
  BUILD    the build folder: hbmcheck and tests/bench/bench_curve_parts are taken from it
  CASE     names of the table SETTINGS below; default: all that the peer can do
Both solve the file of cases/structures that is named: same M, C, K, contacts, loads and range of omega, H = 7, harmonic 0 kept. The peer
samples its contacts N times a period (N of the table, or --samples), and is ended after S seconds on the clock (default: never). Its
points are kept in FOLDER of --keep, and as curves for `hbmcheck verify`.

Printed for each case: points; processor time of the whole process and of the solver alone (medians of R rounds, in turns; default 3) and the ratios
peer/hbmcheck: hbmcheck's curve has exact forces, Floquet multipliers and located special points, the peer's has none of these. Then the
largest difference of every point of the peer from hbmcheck's solution at the same omega (frf --at), once with forces sampled at the same N
and once with exact ones: of the amplitude (max - min)/2 and of harmonic 1, of all responses, relative to the largest amplitude there. Points
where hbmcheck says `mean_free` are counted apart: a slider that never slips rests where its history left it, which is the codes' own.

exit: 0  1 a run failed  64 usage  77 the peer, or what runs it, is not here"""
import csv
import io
import math
import os
import resource
import statistics
import subprocess
import sys
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))
CASES = os.path.join(HERE, "..", "..", "cases", "structures")
H = 7
AT_MOST = 256  # numbers that --at takes
SOLVED = 1e-7  # |residual|/|force| up to which a point of a peer is a solution of its own equations
BESIDE = 1e-3  # relative distance of omega from a turning point
# Of NLvib its step, the scales of its unknowns and of omega, and fsolve's tolerance (with a smaller one it turns back where stop2 leaves its
# stop; chain3 it does not finish), of tmdsimpy its largest step and the smallest scale: found by trial, steps as large as they get on with.
SETTINGS = {
    "jenkins2": {"N": 1024, "nlvib": {"step": 0.05, "scale": 1e-2, "omega_scale": 1, "tolerance": 1e-10}, "tmdsimpy": {"dsmax": 0.1, "scale": 1e-3}},
    "stop2": {"N": 1024, "nlvib": {"step": 0.005, "scale": 1, "omega_scale": 0.8, "tolerance": 1e-8}, "tmdsimpy": {"dsmax": 0.1, "scale": 1e-3}},
    "chain3": {"N": 1024, "nlvib": {"step": 0.005, "scale": 1, "omega_scale": 0.5, "tolerance": 1e-8}, "tmdsimpy": {"dsmax": 0.01, "scale": 1e-1}},
    "tangent_normal_F50": {"N": 1024, "tmdsimpy": {"dsmax": 0.1, "scale": 1e-2}},
    "tangent_normal_F100": {"N": 1024, "tmdsimpy": {"dsmax": 0.1, "scale": 1e-2}},
    "beam16": {"N": 1024, "nlvib": {"step": 2, "scale": 1e-7, "omega_scale": 140, "tolerance": 1e-12}, "tmdsimpy": {"dsmax": 0.05, "scale": 1e-8}},
}


def fail(code, words):
    print("versus_peer.py: " + words, file=sys.stderr)
    sys.exit(code)


# ---- the case file, as much of it as the cases of SETTINGS use


def read_mtx(path):
    """A Matrix Market file, coordinate, real, general or symmetric: rows."""
    with open(path) as f:
        symmetric = "symmetric" in f.readline()
        lines = [line.split() for line in f if line[0] != "%"]
    n = int(lines[0][0])
    rows = [[0.0] * n for _ in range(n)]
    for i, j, a in lines[1:]:
        rows[int(i) - 1][int(j) - 1] = float(a)
        if symmetric:
            rows[int(j) - 1][int(i) - 1] = float(a)
    return rows


def matrix(given, others):
    if isinstance(given, str):
        return read_mtx(os.path.join(CASES, given))
    if isinstance(given, dict):
        alpha, beta = given["rayleigh"]
        M, K = others
        return [[float(alpha) * m + float(beta) * k for m, k in zip(*rows)] for rows in zip(M, K)]
    if isinstance(given[0], list):
        return [[float(a) for a in row] for row in given]
    return [[float(a) if i == j else 0.0 for j in range(len(given))] for i, a in enumerate(given)]


def read_case(name):
    import yaml

    with open(os.path.join(CASES, name + ".yaml")) as f:
        y = yaml.safe_load(f)
    s = y["structure"]
    M, K = matrix(s["mass"], None), matrix(s["stiffness"], None)
    n = len(M)
    names = {str(a): i for i, a in enumerate(s.get("names", []))}

    def vector(of):
        v = [0.0] * n
        for dof, a in (of if isinstance(of, dict) else {of: 1}).items():
            v[names[dof] if dof in names else int(dof) - 1] = float(a)
        return v

    p = {"n": [n], "M": sum(M, []), "D": sum(matrix(s["damping"], (M, K)), []), "K": sum(K, []), "H": [H], "sweep": [float(w) for w in y["sweep"]["omega"]],
         "static": [0.0] * n, "force": [0.0] * n, "contacts": [], "elements": [], "responses": [vector(r) for r in y["response"]], "names": [str(r) for r in y["response"]]}
    for load in y["forcing"]:
        d = vector(load.get("direction", load.get("dof")))
        key = "static" if load.get("harmonic", 1) == 0 else "force"
        p[key] = [a + float(load["amplitude"]) * b for a, b in zip(p[key], d)]
    for c in y["contacts"]:
        p["elements"].append({**{k: float(c.get(of, 0)) for k, of in (("kt", "tangential_stiffness"), ("kn", "normal_stiffness"), ("mu", "friction"), ("preload", "preload"), ("gap", "gap"))},
                              **{k: vector(c.get(k, {})) for k in ("tangent", "normal")}})
        if "normal" not in c:
            p["contacts"].append(("jenkins", [c["tangential_stiffness"], float(c["friction"]) * float(c["preload"]), *vector(c["tangent"])]))
        elif "tangent" not in c:
            p["contacts"].append(("spring", [c["normal_stiffness"], -float(c["gap"]), *vector(c["normal"])]))  # clearance: positive there
        else:
            assert c.get("gap", 0) == 0  # the peers' element has none
            p["contacts"].append(("coupled", [c["tangential_stiffness"], c["normal_stiffness"], c["friction"], *vector(c["tangent"]), *vector(c["normal"])]))
    return p


# ---- the peers


def peer_command(peer, folder):
    """The start of a command that takes FOLDER PROBLEM CURVE; exit 77 where it cannot be run."""
    here = os.path.join(HERE, "peers")
    python = os.environ.get("PYTHON", "/usr/bin/python3")
    command, wanted, needs = {
        "nlvib": (["octave-cli", "--norc", os.path.join(here, "nlvib.m")], "SRC/solve_and_continue.m", ["octave-cli", "--version"]),
        "tmdsimpy": ([python, os.path.join(here, "tmdsimpy_curve.py")], "tmdsimpy/continuation.py", [python, "-c", "import scipy.optimize"]),
    }[peer]
    try:
        there = subprocess.run(needs, capture_output=True).returncode == 0
    except OSError:
        there = False
    if not there:
        fail(77, "skipped: what runs %s is not here (`%s` fails)" % (peer, " ".join(needs)))
    if not os.path.exists(os.path.join(folder, wanted)):
        fail(77, "skipped: %s is not in %s (no %s)" % (peer, folder, wanted))
    return [*command, folder]


def run(command, limit=None):
    """(processor seconds, stdout) of a command; stdout is None where it was ended after `limit` seconds."""
    began = resource.getrusage(resource.RUSAGE_CHILDREN)
    try:
        r = subprocess.run(command, capture_output=True, text=True, timeout=limit)
    except subprocess.TimeoutExpired:
        r = None
    ended = resource.getrusage(resource.RUSAGE_CHILDREN)
    seconds = ended.ru_utime + ended.ru_stime - began.ru_utime - began.ru_stime
    if r is None:
        return seconds, None
    if r.returncode:
        fail(1, "%s: exit %d\n%s" % (" ".join(command)[:200], r.returncode, (r.stderr or r.stdout)[-2000:]))
    return seconds, r.stdout


# ---- what is compared


def measures(a):
    """(amplitude, harmonic 1, norm_over_root_2) of the coefficients a0, a1, b1, ...: (max - min)/2 from 1024 samples, each extreme by Newton from there."""
    def motion(t, order):
        turns = [(1, 0), (0, 1), (-1, 0), (0, -1)][order]
        value = a[0] if order == 0 else 0.0
        for k in range(1, len(a) // 2 + 1):
            c, s = math.cos(k * t), math.sin(k * t)
            value += k**order * (a[2 * k - 1] * (turns[0] * c - turns[1] * s) + a[2 * k] * (turns[0] * s + turns[1] * c))
        return value

    def extreme(of):
        t = 2 * math.pi * of(range(1024), key=lambda i: motion(2 * math.pi * i / 1024, 0)) / 1024
        for _ in range(6):
            curvature = motion(t, 2)
            t -= motion(t, 1) / curvature if curvature else 0
        return motion(t, 0)

    return 0.5 * (extreme(max) - extreme(min)), math.hypot(a[1], a[2]), math.sqrt(0.5 * sum(c * c for c in a))


def read_points(path, p):
    """[(omega, [measures of each response])] of the solutions within the sweep, the numbers of all points and of those that are no solutions, the last omega."""
    n, points, total, unsolved = p["n"][0], [], 0, 0
    low, high = min(p["sweep"]), max(p["sweep"])
    with open(path) as f:
        for line in f:
            omega, residual, *x = map(float, line.split())
            total += 1
            unsolved += not residual <= SOLVED
            if low <= omega <= high and residual <= SOLVED:
                motions = [[sum(r[i] * x[k * n + i] for i in range(n)) for k in range(2 * H + 1)] for r in p["responses"]]
                points.append((omega, [measures(m) for m in motions]))
    return points, total, unsolved, omega


def keep_curve(path, peer, name, p, N, points, unsolved):
    """For hbmcheck verify: omega, and of every response its amplitude and NLvib's RMS."""
    with open(path, "w") as f:
        f.write("# %s by %s: H = %d, N = %d; made by tests/bench/versus_peer.py.\n" % (name, peer, H, N))
        f.write("# Points that do not solve its own equations to %g are left out: %d.\n" % (SOLVED, unsolved))
        f.write(",".join(["omega", *("%s@%s" % (q, r) for r in p["names"] for q in ("amplitude", "norm_over_root_2"))]) + "\n")
        for omega, measured in points:
            f.write(",".join(["%.10g" % omega, *("%.10g,%.10g" % (m[0], m[2]) for m in measured)]) + "\n")


def turning_points(hbmcheck, case, settings, n_responses):
    """The omegas where the curve's branch turns, to half a step."""
    _, out = run([hbmcheck, "frf", case, "--format", "csv", "--quiet", *settings])
    rows = list(csv.DictReader(io.StringIO("".join(line for line in out.splitlines(True) if line[0] != "#"))))[::n_responses]
    omega, branch = [float(r["omega"]) for r in rows], [r["branch"] for r in rows]
    return [max(omega[i - 1:i + 1], key=lambda w: abs(w - omega[max(i - 3, 0)])) for i in range(1, len(rows)) if branch[i] != branch[i - 1]]


def solutions_at(hbmcheck, case, omegas, settings, n_responses):
    """{omega: [(mean_free, [measures of each response])]} by frf --at."""
    ordered, found = sorted(set(omegas)), {}
    for begin in range(0, len(ordered), AT_MOST):
        at = ",".join("%.17g" % w for w in ordered[begin:begin + AT_MOST])
        _, out = run([hbmcheck, "frf", case, "--at", at, "--format", "csv", "--quiet", *settings])
        rows = list(csv.DictReader(io.StringIO("".join(line for line in out.splitlines(True) if line[0] != "#"))))
        for i in range(0, len(rows), n_responses):
            group = rows[i:i + n_responses]
            solution = [(float(r["amplitude"]), float(r["harmonic_1"])) for r in group]
            found.setdefault(float(group[0]["omega"]), []).append((group[0]["mean_free"] == "yes", solution))
    return found


def differences(points, found):
    """Of each point from the nearest solution at its omega: [(difference, omega, mean_free)], None where there is no solution."""
    result = []
    for omega, mine in points:
        size = max(m[0] for m in mine)
        near = [(max(abs(x - y) for a, b in zip(mine, other) for x, y in zip(a, b)) / size, omega, free) for free, other in found.get(omega, [])]
        result.append(min(near, default=None))
    return result


def say_differences(label, d, turning):
    """What a turning point shifted by s does to the amplitude is not s but its root: points beside one are counted apart."""
    missing = sum(x is None for x in d)
    beside = [x for x in d if x and any(abs(x[1] - w) <= BESIDE * w for w in turning)]
    rest = [x for x in d if x and x not in beside]
    unique, free = ([x for x in rest if x[2] == state] for state in (False, True))
    worst, where, _ = max(unique, default=(math.nan, math.nan, None))
    median = statistics.median(x[0] for x in unique) if unique else math.nan
    print("  %-22s largest %.1e at omega %.6g, median %.1e, %d points" % (label, worst, where, median, len(unique)))
    for words, group in (("free means", free), ("beside a turning point", beside)):
        if group:
            print("  %-22s %d points: %s: largest %.1e" % ("", len(group), words, max(x[0] for x in group)))
    if missing:
        print("  %-22s %d points WITHOUT a solution of hbmcheck" % ("", missing))


def versus(peer, command, build, name, rounds, samples, limit, work):
    setting = SETTINGS[name]
    p, case = read_case(name), os.path.join(CASES, name + ".yaml")
    os.makedirs(work, exist_ok=True)
    hbmcheck, inside = os.path.join(build, "hbmcheck"), os.path.join(build, "tests", "bench", "bench_curve_parts")
    N = samples or setting["N"]
    problem, curve = (os.path.join(work, "%s_%s.%s" % (peer, name, what)) for what in ("problem", "curve"))
    words = {**{k: p[k] for k in ("n", "M", "D", "K", "static", "force", "H", "sweep")}, "N": [N], **{k: [v] for k, v in setting[peer].items()}}
    with open(problem, "w") as f:
        for word, numbers in [*words.items(), *p["contacts"]]:
            f.write(" ".join([word, *("%.17g" % float(a) for a in numbers)]) + "\n")
    exact = ["--set", "hbm.force=exact", "--set", "hbm.harmonics=%d" % H]
    sampled = ["--set", "hbm.force=sampled", "--set", "hbm.samples=%d" % N, "--set", "hbm.harmonics=%d" % H]
    ours = [hbmcheck, "frf", case, "--format", "csv", "--quiet", *exact]
    run(ours)
    print("%s: %d degrees of freedom, H = %d, N = %d" % (name, p["n"][0], H, N), flush=True)
    whole, alone, whole_here, alone_here = [], [], [], []
    for _ in range(rounds):
        seconds, out = run([*command, problem, curve], limit)
        if out is None:
            here = run(ours)[0]
            print("  %s was ended after %.0f s of processor time; hbmcheck takes %.4f s: ratio beyond %.0f" % (peer, seconds, here, seconds / here), flush=True)
            return
        inner, checked, evaluations = out.split()[-3:]
        whole.append(seconds - float(checked))
        alone.append(float(inner))
        whole_here.append(statistics.median(run(ours)[0] for _ in range(5)))
        _, _, _, points_here, inner, *_ = run([inside, "5", case, "--set", *exact[1::2]])[1].splitlines()[-1].split()
        alone_here.append(1e-3 * float(inner))
    points, total, unsolved, last = read_points(curve, p)
    keep_curve(os.path.splitext(curve)[0] + ".csv", peer, name, p, N, points, unsolved)
    begin, end = p["sweep"]
    arrived = "" if (last - end) * (end - begin) >= 0 else " and STOPPED at omega %.6g" % last
    print("  points                 %s %d (%s evaluations)%s, hbmcheck %s" % (peer, total, evaluations, arrived, points_here))
    if unsolved:
        print("  %-22s %d points of %s do not solve its equations (residual beyond %g): left out below" % ("", unsolved, peer, SOLVED))
    for label, a, b in (("whole process", whole, whole_here), ("solver alone", alone, alone_here)):
        a, b = statistics.median(a), statistics.median(b)
        print("  %-22s %s %.3f s, hbmcheck %.5f s: ratio %.0f" % (label, peer, a, b, a / b))
    omegas = [w for w, _ in points]
    for label, settings in (("sampled, the same N", sampled), ("exact", exact)):
        n = len(p["responses"])
        found = solutions_at(hbmcheck, case, omegas, settings, n)
        say_differences(label, differences(points, found), turning_points(hbmcheck, case, settings, n))
    sys.stdout.flush()


def main(argv):
    rounds, samples, limit, keep, names = 3, 0, None, None, []
    rest = iter(argv)
    for a in rest:
        if a == "--rounds":
            rounds = int(next(rest))
        elif a == "--samples":
            samples = int(next(rest))
        elif a == "--limit":
            limit = float(next(rest))
        elif a == "--keep":
            keep = next(rest)
        else:
            names.append(a)
    if len(names) < 3 or names[0] not in ("nlvib", "tmdsimpy") or rounds < 1:
        fail(64, __doc__)
    peer, folder, build, *cases = names
    able = [c for c in SETTINGS if peer in SETTINGS[c]]
    for c in cases:
        if c not in able:
            fail(64, "no case %s of %s; there are: %s" % (c, peer, " ".join(able)))
    command = peer_command(peer, os.path.abspath(folder))
    os.environ.update(OMP_NUM_THREADS="1", OPENBLAS_NUM_THREADS="1", LC_ALL="C")
    with tempfile.TemporaryDirectory() as work:
        for c in cases or able:
            versus(peer, command, os.path.abspath(build), c, rounds, samples, limit, keep or work)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
