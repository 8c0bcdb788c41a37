#!/usr/bin/env python3
"""find.py - random scenes, their steady states by marching (march.py), and complete certificates of them. Nobody trusts it.

    python3 find.py COUNT SEED FOLDER      writes FOLDER/SEED-i.json for every steady state found and refined; says what was not
"""
import json
import math
import random
import sys
from fractions import Fraction
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "proof"))
import check  # noqa: E402
from march import Law, March, dot  # noqa: E402


# ---- scenes ----------------------------------------------------------------------------------------------------------------------------
def text(value, digits=4):
    return f"{value:.{digits}g}"


def scene(rng):
    """A chain of 1 to 4 masses with 1 to 3 contacts of every kind, loaded near one of its frequencies."""
    n = rng.choice((1, 1, 1, 2, 2, 3, 4))
    zero = lambda: [[0.0] * n for _ in range(n)]
    mass, stiffness = zero(), zero()
    for j in range(n):
        mass[j][j] = float(text(rng.uniform(0.5, 2), 2))
    for j in range(n + 1):
        k = float(text(rng.uniform(20, 60), 2)) if j < n or rng.random() < 0.5 else 0.0
        ends = [i for i in (j - 1, j) if 0 <= i < n]
        for a in ends:
            for b in ends:
                stiffness[a][b] += k if a == b else -k
    damping = [[float(text(stiffness[i][j] * 0.01 + mass[i][j] * 0.3, 3)) for j in range(n)] for i in range(n)]
    omega = math.sqrt(stiffness[0][0] / mass[0][0]) * rng.uniform(0.5, 1.8)
    amplitude = rng.uniform(5, 120)
    unit = lambda j: [text(float(i == j)) for i in range(n)]
    load = [text(amplitude * (j == rng.randrange(n) or n == 1)) for j in range(n)]
    if not any(map(float, load)):
        load[0] = text(amplitude)
    forcing = [{"harmonic": 1, "cos": load, "sin": ["0"] * n}]
    if rng.random() < 0.3:
        forcing.append({"harmonic": rng.choice((0, 2, 3)), "cos": [text(rng.uniform(-10, 10)) for _ in range(n)], "sin": ["0"] * n})
    contacts = []
    for _ in range(rng.choice((1, 1, 2, 3))):
        j, kind = rng.randrange(n), rng.choice(("angle", "angle", "friction", "stop", "both", "both" if n > 1 else "angle"))
        other = rng.randrange(n)
        direction = [a - b if j != other and rng.random() < 0.5 else a for a, b in zip(map(float, unit(j)), map(float, unit(other)))]
        direction = [text(v) for v in direction]
        kt, kn, mu = text(rng.uniform(20, 200), 3), text(rng.uniform(20, 800), 3), text(rng.choice((rng.uniform(0.05, 0.6), rng.uniform(0.05, 1.5))), 2)
        gap = text(rng.choice((-1, 1)) * rng.uniform(0.02, 1), 2)
        rub = {"tangential_stiffness": kt, "friction": mu}
        push = {"normal_stiffness": kn, "gap": gap}
        if kind == "angle":
            contacts.append({"direction": direction, "angle_deg": text(rng.uniform(10, 80), 3)} | rub | push)
        elif kind == "friction":
            contacts.append({"tangent": direction, "preload": text(rng.uniform(0.5, 20), 3)} | rub)
        elif kind == "stop":
            contacts.append({"normal": direction} | push)
        else:
            normal = [text(rng.choice((-1, 1)) * float(v)) for v in unit(rng.randrange(n))]
            contacts.append({"tangent": direction, "normal": normal} | rub | push)
    if rng.random() < 0.1 and contacts:
        contacts.append(json.loads(json.dumps(contacts[0])))  # two equal contacts: transitions at once
    rows = lambda m: [[repr(v) for v in row] for row in m]
    return {"model": {"mass": rows(mass), "damping": rows(damping), "stiffness": rows(stiffness), "forcing": forcing, "contacts": contacts},
            "omega": text(omega), "multiple": 1, "precision_bits": 128, "response": unit(rng.randrange(n)), "rest": {}}


# ---- steady states ---------------------------------------------------------------------------------------------------------------------
def begin(law, rng):
    """From a random state, every contact where its letter may begin."""
    x, v = [rng.gauss(0, 0.3) for _ in range(law.n)], [rng.gauss(0, 1) for _ in range(law.n)]
    letters, w = "", [0.0] * len(law.contacts)
    for i, c in enumerate(law.contacts):
        closed = not c["n"] or dot(c["n"], x) + c["gap"] > 0
        letters += "O" if not closed else "S" if c["t"] else "N"
        if c["t"]:
            w[i] = dot(c["t"], x)
    return March(law, 0.0, x, v, letters, w, 128)


def steady(data, rng, periods=60, most=4):
    """The motion after many periods as a candidate (events in floats), or a word for why not."""
    law = Law(data)
    T, m = 2 * math.pi / law.omega, begin(law, rng)
    try:
        if not m.run(periods * T, 60 * periods):
            return "chatter"
        past = []
        for k in range(160):
            past.append((list(m.x), list(m.v)))
            size = max(map(abs, m.x)) + 1e-3, max(map(abs, m.v)) + 1e-3
            for multiple in range(1, most + 1):
                if len(past) > multiple:
                    x, v = past[-1 - multiple]
                    if max(abs(a - b) for a, b in zip(x, m.x)) < 1e-7 * size[0] and max(abs(a - b) for a, b in zip(v, m.v)) < 1e-7 * size[1]:
                        return candidate(data, m, multiple, T)
            start = m.t
            m.events = []
            m.run((periods + k + 1) * T, 100)
            if m.t <= start:
                return "chatter"
    except (OverflowError, RecursionError):
        return "diverges"
    return "aperiodic"


def candidate(data, m, multiple, T):
    begin_at = round(m.t / T) * T
    m.events, first = [], (list(m.x), list(m.v), m.letters, list(m.w))
    if not m.run(begin_at + multiple * T, 300):
        return "chatter"
    events = [(t - begin_at, x, v, s, w) for t, x, v, s, w in m.events]
    merged = []
    for e in events:  # simultaneous transitions make segments of no length
        if merged and e[0] - merged[-1][0] < 1e-9 * T:
            merged[-1] = (merged[-1][0], merged[-1][1], merged[-1][2], e[3], e[4])
        else:
            merged.append(e)
    if len(merged) > 1 and merged[0][0] + multiple * T - merged[-1][0] < 1e-9 * T:
        merged.pop()
    merged = [e for k, e in enumerate(merged) if e[3] != merged[k - 1][3]]
    if len(merged) == 1 or len({e[3] for e in merged}) == 1:
        merged = []
    out = json.loads(json.dumps(data))
    out["multiple"] = multiple if merged else 1
    fixed = {c for c in range(len(m.law.contacts)) if all(e[3][c] == "S" for e in merged) and (merged or first[2][c] == "S")}
    out["rest"] = {str(c): repr(first[3][c]) for c in sorted(fixed)}
    if merged:
        out["events"] = [{"t": repr(t), "x": list(map(repr, x)), "v": list(map(repr, v)), "state": s} for t, x, v, s, _ in merged]
    else:
        out["events"] = [{"section": 1, "t": "0", "x": list(map(repr, first[0])), "v": list(map(repr, first[1])), "state": first[2]}]
    return out


# ---- refinement and claims -------------------------------------------------------------------------------------------------------------
def digits(value, count):
    """A fraction to so many significant digits, as decimal text."""
    if not value:
        return "0"
    exponent = math.floor(math.log10(abs(value))) if abs(value) > Fraction(1, 10 ** 300) else -300
    mantissa = round(value * Fraction(10) ** (count - 1 - exponent))
    return f"{mantissa}e{exponent - count + 1}"


def with_dummies(data):
    """What a certificate needs beside what a candidate has."""
    out = dict(data)
    xs, vs = ([abs(float(v)) for e in data["events"] for v in e[k]] for k in "xv")
    out["scales"] = {"x": text(max(xs) or 1, 3), "v": text(max(vs) or 1, 3), "t": text(1 / float(data["omega"]), 3)}
    out["claims"] = {"radius": "1e-20", "uniqueness_radius": "1e-20", "stability": "unproven"} | {k: ["0", "0"] for k in check.BOUNDS}
    out.pop("vectors", None)
    return out


def unknowns(cert):
    return [v for t, x, v, _ in cert.events for v in x + v + ([] if cert.section else [t])]


def newton(data, steps=40, count=25, damped=True):
    """The candidate with its events solved to `count` digits, or None. Newton on the checker's equations, B anew while steps are large."""
    data = json.loads(json.dumps(data))
    n = len(data["model"]["mass"])
    last = math.inf
    for k in range(steps):
        data = with_dummies(data)
        try:
            orbit = check.Orbit(check.Certificate(data))
            test = check.Krawczyk.__new__(check.Krawczyk)
            test.__init__(orbit)
        except (check.Wrong, check.Unproven, OverflowError, ValueError, ZeroDivisionError):
            return None
        values, _ = orbit.shoot(test.y, test.flows, test.taus)
        unit = 1 << check.Ball.bits
        step = [Fraction(sum(b * f.m for b, f in zip(row, values)) >> check.Ball.bits, unit) for row in test.B]  # scaled
        size = float(min(max(map(abs, step)), 10 ** 9))
        if not size < 1e6 or k > 12 and size > 0.5 * last and size > 1e-12:
            return None
        last = size
        factor = Fraction(1 / max(1.0, size / 0.3)) if damped else 1
        at = iter(step)
        scale = [Fraction(data["scales"][k]) for k in "xvt"]
        for e in data["events"]:
            for key, s in (("x", scale[0]), ("v", scale[1])):
                e[key] = [digits(Fraction(old) - factor * next(at) * s, count) for old in e[key]]
            if "section" not in e:
                e["t"] = digits(Fraction(e["t"]) - factor * next(at) * scale[2], count)
        if size < 1e-22:
            return with_dummies(data)
    return None


def widen(ball, slack):
    lo, hi = ball.m - 4 * ball.r - slack, ball.m + 4 * ball.r + slack
    unit = 1 << check.Ball.bits
    ten = 10 ** 31
    lo, hi = lo * ten // unit, -(-hi * ten // unit)
    return [f"{'-' if v < 0 else ''}{abs(v) // ten}.{abs(v) % ten:031d}" for v in (lo, hi)]


def complete(data, signs=True):
    """Claims for a refined candidate; signs=False: also where the law does not hold (to falsify). (certificate, reason or None)"""
    cert = check.Certificate(data)
    orbit = check.Orbit(cert)
    test = check.Krawczyk(orbit)
    unit = 1 << check.Ball.bits
    exponent = math.ceil(math.log10(max(8 * max(test.step) / unit, 1e-26)))
    claims = data["claims"]
    claims["radius"] = f"1e{exponent}"
    box = test.box(Fraction(claims["radius"]))
    for k in range(0, -exponent + 1):
        try:
            test.image(Fraction(f"1e-{k}"))
            claims["uniqueness_radius"] = f"1e-{k}"
            break
        except check.Unproven:
            continue
    else:
        return None, "no uniqueness"
    flows, measures = [], check.Measures(orbit)
    for i, tau in enumerate(orbit.times(box)):
        motion = check.Motion(orbit, i, box, tau)
        for k in range(motion.steps):
            measures.add(motion.length(k), motion.series(k))
        flows.append(motion.flow)
    slack = int(float(cert.scales[0]) * 10 ** exponent * unit)
    for name, ball in measures.found().items():
        claims[name] = widen(ball, slack)
    try:
        import numpy
    except ImportError:
        return data, None
    matrix = check.monodromy(orbit, box, flows)
    values, vectors = numpy.linalg.eig(numpy.array([[float(v) for v in row] for row in matrix]))
    vectors = [[[repr(float(z.real)), repr(float(z.imag))] for z in row] for row in vectors.astype(complex)]
    try:
        largest = check.multipliers(matrix, [[[Fraction(v) for v in z] for z in row] for row in vectors])
    except check.Unproven:
        return data, None
    if largest.hi < unit or largest.lo > unit:
        claims["stability"] = "stable" if largest.hi < unit else "unstable"
        claims["multiplier"] = widen(largest, int(1e-15 * unit) + 1000 * largest.r)
        data["vectors"] = vectors
    return data, None


def certificate(rng):
    """(scene with its certificate or None, word)."""
    data = scene(rng)
    found = steady(data, rng)
    if isinstance(found, str):
        return None, found
    try:
        solved = newton(found)
        if not solved:
            return found, "Newton"
        return complete(solved)
    except (check.Unproven, check.Wrong) as error:
        return None, str(error)


def main():
    count, seed, folder = int(sys.argv[1]), int(sys.argv[2]), Path(sys.argv[3])
    folder.mkdir(parents=True, exist_ok=True)
    tally = {}
    for i in range(count):
        data, reason = certificate(random.Random(seed * 100003 + i))
        if reason is None:
            (folder / f"{seed}-{i}.json").write_text(json.dumps(data, indent=1))
        tally[reason or "written"] = tally.get(reason or "written", 0) + 1
    print(tally)


if __name__ == "__main__":
    main()
