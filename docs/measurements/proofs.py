#!/usr/bin/env python3
"""How much does `prove` prove, do both checkers agree, and is HBM's predicted error right? The tables of docs/proof.md and docs/prediction.md.

usage: proofs.py sets HBMCHECK FOLDER [WORDS]   runs `prove` on the sets below (whose names have these words); certificates and rows.csv into
                                          FOLDER, going on from what is there
       proofs.py both HBMCHECK FOLDER SECONDS    both checkers on the certificates there (C beside HBMCHECK, Python in proof/), into both.csv,
                                          a set no longer than that, in random order
       proofs.py tables FOLDER            the tables, from these
       proofs.py trouble HBMCHECK         towards a fold, a graze, a cone's edge, and stiff contacts: where rows turn unproven
Random scenes are those of `hbmcheck stress --case --first 0, 1, ...`. Standard library only."""
import collections, csv, glob, json, math, os, random, re, resource, statistics, subprocess, sys, tempfile, time
from decimal import Decimal, getcontext
from fractions import Fraction

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
SECONDS = 100  # [s] of processor time that a case may take, either program
STRUCTURES = "brake chain3 jenkins2 stop2 tangent_normal_F100 tangent_normal_F50 wedge_F0.5 wedge_F10 wedge_F2 wedge_F20".split()


def chain(path):
    """Twelve masses in a row, the first and the last held; sliders under a constant load on three of them, stops before two."""
    spring = [[2 if i == j else -1 if abs(i - j) == 1 else 0 for j in range(12)] for i in range(12)]
    lines = ["title: Chain of 12", "structure:", f"  mass: {[1] * 12}", f"  stiffness: {spring}", "  damping: {rayleigh: [0, 0.02]}"]
    lines += ["forcing:", "  - {dof: 1, amplitude: 1}", "contacts:"]
    for i, load in ((3, 0.3), (6, 0.2), (9, 0.1)):
        lines += [f"  - {{name: slider{i}, tangential_stiffness: 2, friction: 1, preload: {load}, tangent: {{{i}: 1}}}}"]
    for i, gap in ((4, -0.3), (11, -0.2)): lines += [f"  - {{name: stop{i}, normal_stiffness: 5, gap: {gap}, normal: {{{i}: 1}}}}"]
    lines += ["response: [12]", "sweep: {omega: [0.2, 1.9]}", "hbm: {harmonics: 30}"]
    with open(path, "w") as f: f.write("\n".join(lines) + "\n")


def cases(exe, folder, only):
    """(set, name, case file, further arguments) of the sets whose names contain `only`"""
    case2 = os.path.join(ROOT, "cases/paper/case2.yaml")
    yield "case 2, 200 frequencies", "case2", case2, ["--at", ",".join(f"{3 + 17 * i / 199:.6g}" for i in range(200))]
    paper = os.path.join(ROOT, "cases/paper")
    for name in sorted(os.listdir(paper)):
        if name.endswith(".yaml"): yield "cases/paper", name[:-5], os.path.join(paper, name), []
    for name in STRUCTURES: yield "cases/structures", name, os.path.join(ROOT, f"cases/structures/{name}.yaml"), []
    path = os.path.join(folder, "chain12.yaml")
    chain(path)
    yield "chain of 12", "chain12", path, ["--at", ",".join(f"{0.25 + 0.07 * i:.4g}" for i in range(24))]
    for words, n, option in (("random oscillators", 2000, []), ("random structures", 500, ["--structures"])):
        i = 0
        while n > 0 and only in words:
            path = os.path.join(folder, "scene.yaml")
            subprocess.run([exe, "stress", "--case", "--first", str(i), "-o", path, *option], check=True)
            if not re.search("law: (polynomial|tanh)", open(path).read()):  # smooth laws are not provable
                n -= 1
                yield words, f"scene{i}", path, []
            i += 1


def made(path): return list(csv.DictReader(open(path))) if os.path.exists(path) else []


def keep(path, rows):
    new = not os.path.exists(path)
    known = rows[0] if new else next(csv.reader(open(path)))
    with open(path, "a", newline="") as f:
        out = csv.DictWriter(f, known, restval="")
        if new: out.writeheader()
        out.writerows(rows)


def sets(exe, folder, only=""):
    os.makedirs(folder, exist_ok=True)
    path = os.path.join(folder, "rows.csv")
    known = {(r["set"], r["case"]) for r in made(path)}
    for words, name, case, more in cases(exe, folder, only):
        if only not in words or (words, name) in known: continue
        to = os.path.join(place(folder, words), name)
        os.makedirs(to, exist_ok=True)
        args = [exe, "prove", case, "--quiet", "--format", "csv", "-o", to, *more]
        out = subprocess.run(args, capture_output=True, text=True, preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_CPU, (SECONDS, SECONDS)))
        if out.returncode: print(f"{words} {name}: exit {out.returncode} {out.stderr.strip()[:200]}", flush=True)
        rows = list(csv.DictReader(l for l in out.stdout.splitlines() if l and not l.startswith("#")))
        if not rows and (out.returncode < 0 or "hbmcheck-proof" in out.stderr): rows = [{"verdict": "unproven", "reason": f"more than {SECONDS} s"}]
        if rows: keep(path, [{"set": words, "case": name, **r} for r in rows])


def both(exe, folder, seconds):
    sys.path.insert(0, os.path.join(ROOT, "proof"))
    from check import examine
    path = os.path.join(folder, "both.csv")
    known = {r["file"] for r in made(path)}
    checker = [os.path.join(os.path.dirname(os.path.abspath(exe)), "hbmcheck-proof"), "check", "--format", "json"]
    for words in sorted({r["set"] for r in made(os.path.join(folder, "rows.csv"))}, key=len, reverse=True):
        files = sorted(glob.glob(os.path.join(place(folder, words), "*", "*.json")))
        random.Random(1).shuffle(files)
        began = time.monotonic()
        for file in files:
            if file in known: continue
            if time.monotonic() - began > seconds: break
            answers = [json.loads(subprocess.run(checker + [file], capture_output=True, text=True).stdout), examine(file)]
            said = [f"{a['verdict']}, {a['stability']}" for a in answers]
            meet = all(Fraction(a) <= Fraction(d) and Fraction(c) <= Fraction(b) for name in ("amplitude", "mean", "harmonic_1")
                       for (a, b), (c, d) in [[a[name] or ["0", "0"] for a in answers]])
            keep(path, [{"set": words, "file": file, "of": len(files), "c": said[0], "python": said[1], "enclosures meet": meet,
                         "reason": next((a["reason"] for a in answers if a["reason"]), "")}])


def stats(rows, key): return collections.Counter(r[key] for r in rows).most_common()


def place(folder, words): return os.path.join(folder, words.replace(" ", "_").replace("/", "_"))


def of_family(folder, r):
    """Does a slider never slip? Where it rests decides on the amplitude."""
    return bool(json.load(open(os.path.join(place(folder, r["set"]), r["case"], r["certificate"])))["rest"])


def tables(folder):
    rows = made(os.path.join(folder, "rows.csv"))
    print("| set | rows | proven | without those of too few harmonics | stability proven | the rest |\n|---|---|---|---|---|---|")
    for words in dict.fromkeys(r["set"] for r in rows):
        own = [r for r in rows if r["set"] == words]
        proven = [r for r in own if r["verdict"] == "proven"]
        fair = [r for r in own if r["reason"] != "too few harmonics"]
        rest = ", ".join(f"{n} `{why}`" for why, n in stats([r for r in own if r["verdict"] != "proven"], "reason"))
        print(f"| {words} | {len(own)} | {100 * len(proven) / len(own):.2f} % | {100 * len(proven) / len(fair):.2f} % | "
              f"{sum(r['stability'] != 'unproven' for r in proven)} | {rest} |")
    print("\n| set | proven <= 3 x said | share | median proven/said |\n|---|---|---|---|")
    every, ratios, outside = [], [], []
    for words in dict.fromkeys(r["set"] for r in rows):
        own = [r for r in rows if r["set"] == words and r["error_low"] and r["error_predicted"] and int(r["transitions"] or 0) > 0 and not of_family(folder, r)]
        pairs = [(max(abs(float(r["error_low"])), abs(float(r["error_high"]))), float(r["error_predicted"]), r) for r in own]
        pairs = [(e, p, r) for e, p, r in pairs if p > 1e-9 * abs(float(r["hbm_amplitude"]))]
        if not pairs: continue
        held = sum(e <= 3 * p for e, p, _ in pairs)
        finite = [e / p for e, p, _ in pairs if math.isfinite(p)]
        every += pairs
        print(f"| {words} | {held} of {len(pairs)} | {100 * held / len(pairs):.1f} % | {statistics.median(finite):.2f} |")
    print("\n| proven/said | rows |\n|---|---|")
    edges = [-1, 0.01, 0.03, 0.1, 0.3, 1, 3, math.inf]
    for low, high in zip(edges, edges[1:]): print(f"| {max(low, 0)} .. {high} | {sum(low < e / p <= high for e, p, _ in every)} |")
    for e, p, r in every:
        if e > 3 * p: print(f"  {r['set']} {r['case']} omega {float(r['omega']):.7g}: proven {e:.3g}, said {p:.3g}, amplitude {float(r['hbm_amplitude']):.4g}, "
                            f"harmonics {r['harmonics'] or 'its own'}, {r['transitions']} transitions, {r['stability']}")
    print("\n| set | certificates by both checkers | of | same verdict | enclosures meet | verdicts |\n|---|---|---|---|---|---|")
    judged = made(os.path.join(folder, "both.csv"))
    for words in dict.fromkeys(r["set"] for r in judged):
        own = [r for r in judged if r["set"] == words]
        print(f"| {words} | {len(own)} | {own[0]['of']} | {sum(r['c'] == r['python'] for r in own)} | {sum(r['enclosures meet'] == 'True' for r in own)} | "
              + ", ".join(f"{n} {v}" for v, n in stats(own, "c")) + " |")


def complete(exe, candidates):
    checker = os.path.join(os.path.dirname(os.path.abspath(exe)), "hbmcheck-proof")
    text = "".join(json.dumps(c) + "\n" for c in candidates)
    return [json.loads(l) for l in subprocess.run([checker, "complete", "-", "-o", "-"], input=text, capture_output=True, text=True).stdout.splitlines()]


def said(answer, confirm):
    """Its verdict; of what is accepted, whether an integration of the law in time confirms it."""
    if answer["verdict"] != "accepted": return answer["reason"].split(":")[-1 if answer["reason"].startswith("segment") else 0].strip()
    differs = confirm(answer["certificate"])
    return f"proven {answer['stability']}" + ("" if differs is None else f", NOT CONFIRMED: {differs}")


def trouble(exe):
    sys.path.insert(0, os.path.join(ROOT, "tests/proof"))
    from falsify import confirm
    from oscillator import Oscillator
    getcontext().prec = 60
    print("Case 2 towards its fold: both orbits, the next start extrapolated from the ones before\n")
    print("| fold - omega | multipliers | lower, upper | alone within | beyond by as much |\n|---|---|---|---|---|")
    at, pairs = [Decimal("9.19"), Decimal("9.2")], []
    for omega in at:
        o = Oscillator(float(omega))
        found = [a for a in complete(exe, [dict(o.candidate(b), omega=str(omega)) for b in o.orbits()]) if a["transitions"] == 2]
        pairs.append(sorted(found, key=lambda a: float(a["amplitude"][0])))
    margin = lambda pair: (Decimal(pair[0]["multiplier"][0]) - 1) ** 2
    values = lambda a: [[Decimal(e["t"]), Decimal(e["x"][0]), Decimal(e["v"][0])] for e in a["certificate"]["events"]]
    for k in range(3, 32):
        slope = (margin(pairs[-1]) - margin(pairs[-2])) / (at[-1] - at[-2])
        fold = at[-1] - margin(pairs[-1]) / slope
        omega = fold - (fold - at[-1]) / 10
        (a, b), shrunk = pairs[-1], ((fold - omega) / (fold - at[-1])).sqrt()
        starts = []
        for side in (-1, 1):
            events = [dict(e, **dict(zip("txv", (str(t), [str(x)], [str(v)])))) for e, (t, x, v) in zip(a["certificate"]["events"], [
                [(p + q) / 2 + side * (q - p) / 2 * shrunk for p, q in zip(u, w)] for u, w in zip(values(a), values(b))])]
            starts.append({**{key: a["certificate"][key] for key in ("model", "response", "rest")}, "omega": str(omega), "events": events})
        pair = complete(exe, starts)
        beyond, = complete(exe, [dict(starts[0], omega=str(2 * fold - omega))])
        print(f"| {fold - omega:.1e} | {' '.join(str(float(x['multiplier'][0])) if x['multiplier'] else '' for x in pair)} | {'; '.join(said(x, confirm) for x in pair)} | "
              f"{' '.join(x['uniqueness_radius'] or '' for x in pair)} | {said(beyond, confirm)} |", flush=True)
        if any(x["verdict"] != "accepted" for x in pair): break
        at.append(omega), pairs.append(pair)
    graze = ((Decimal("79.84") - (Decimal("79.84") ** 2 - 5600).sqrt()) / 2).sqrt()  # (40 - u)^2 + 0.16 u = 200, u = omega^2
    print("\n| omega - graze | before: open all period | beyond |\n|---|---|---|")
    for k in (2, 5, 10, 15, 20, 22, 24, 25, 26, 27, 28, 30):
        answers = []
        for omega in (graze - Decimal(10) ** -k, graze + Decimal(10) ** -k):
            o = Oscillator(float(omega))
            answers += complete(exe, [dict(o.candidate((o.forced.real, -float(omega) * o.forced.imag, [])), omega=str(omega))])
        print(f"| 1e-{k} | {said(answers[0], confirm)} | {said(answers[1], confirm)} |", flush=True)
    print("\n| friction/edge - 1 | inside the cone, both orbits | outside |\n|---|---|---|")
    o = Oscillator(9.0)
    orbits = [b for b in o.orbits() if b[2]]
    for k in (1, 3, 6, 9, 12, 20, 30, 35, 36, 37, 38, 39, 40, 45):
        words = []
        for friction in (Decimal("0.1") * (1 + Decimal(10) ** -k), Decimal("0.1") * (1 - Decimal(10) ** -k)):
            candidates = [json.loads(json.dumps(o.candidate(b))) for b in orbits]
            for c in candidates: c["model"]["contacts"][0]["friction"] = str(friction)
            words.append("; ".join(sorted({said(a, confirm) for a in complete(exe, candidates)})))
        print(f"| 1e-{k} | {words[0]} | {words[1]} |", flush=True)
    print("\n| kn/k | rows | proven | confirmed in time | the rest |\n|---|---|---|---|---|")
    for j in range(0, 7):
        with tempfile.TemporaryDirectory() as folder:
            args = ["--at", ",".join(str(3 + i) for i in range(0, 15)), "--set", f"contacts[0].normal_stiffness={4 * 10 ** (j + 1)}", "-q", "--format", "csv", "-o", folder]
            out = subprocess.run([exe, "prove", os.path.join(ROOT, "cases/paper/case2.yaml"), *args], capture_output=True, text=True).stdout
            rows = list(csv.DictReader(l for l in out.splitlines() if not l.startswith("#")))
            differ = [confirm(json.load(open(f)), 4096 if j < 4 else 32768) for f in sorted(glob.glob(folder + "/*.json"))]
            rest = ", ".join(f"{n} `{why}`" for why, n in stats([r for r in rows if r["verdict"] != "proven"], "reason"))
            print(f"| 1e{j} | {len(rows)} | {sum(r['verdict'] == 'proven' for r in rows)} | {differ.count(None)} of {len(differ)} | {rest}"
                  f"{[d for d in differ if d] or ''} |", flush=True)


if __name__ == "__main__":
    if sys.argv[1:2] == ["sets"]: sets(*sys.argv[2:5])
    elif sys.argv[1:2] == ["both"]: both(*sys.argv[2:4], float(sys.argv[4]))
    elif sys.argv[1:2] == ["tables"]: tables(sys.argv[2])
    elif sys.argv[1:2] == ["trouble"]: trouble(sys.argv[2])
