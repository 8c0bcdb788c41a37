#!/usr/bin/env python3
"""make_curves.py [NAME...] - the curves of the scorecard, spoiled by aft.py as mistakes.py says: curves/NAME.csv.
make_curves.py --check NAME... - compares instead of writing; exit 1 where a number is not the file's.

Every curve is the solutions at a grid of omegas, along the branch from the sweep's low end, with 7 digits. Its second
line says how much the mistake changes it: the difference from the right curve (16 harmonics, 2048 samples), relative to
the amplitude there, that one point in twenty exceeds; where the right curve has no solution a point is 1 off."""
import dataclasses
import functools
import math
import pathlib
import sys
from operator import mul

import aft
import mistakes

HERE = pathlib.Path(__file__).resolve().parent
SCENES = {
    "case2": aft.Oscillator(1.0, 0.4, 40.0, 100.0, 100.0, 1000.0, 0.3, 45.0, -5.0),
    "preloaded": aft.Oscillator(1.0, 0.4, 40.0, 100.0, 400.0, 600.0, 0.3, 30.0, 0.5),
}
GRIDS = {"case2": [4 + 0.2 * i for i in range(51)], "preloaded": [7 + 0.25 * i for i in range(53)]}
STARTS = {"case2": 3.0, "preloaded": 4.0}
MOST_POINTS = 80
SAME = 2e-6  # the 7th digit, and what Newton leaves


def extent(X):
    """max and min of the series X, by 720 samples and a parabola through the outermost three."""
    x = [sum(map(mul, row, X)) for row in aft.basis(len(X) // 2, 720)[0]]

    def top(y):
        i = max(range(len(y)), key=y.__getitem__)
        a, b, c = y[i - 1], y[i], y[(i + 1) % len(y)]
        return b if a + c == 2 * b else b - (c - a) ** 2 / (8 * (a - 2 * b + c))
    return top(x), -top([-a for a in x])


def derived(X, omega):
    """The series of x'."""
    D = [0.0] * len(X)
    for h in range(1, len(X) // 2 + 1):
        D[2 * h - 1], D[2 * h] = h * omega * X[2 * h], -h * omega * X[2 * h - 1]
    return D


def half_range(X):
    high, low = extent(X)
    return (high - low) / 2


QUANTITIES = {
    "amplitude": lambda w, X: half_range(X),
    "decibel": lambda w, X: 20 * math.log10(half_range(X)),
    "velocity": lambda w, X: half_range(derived(X, w)),
    "acceleration": lambda w, X: half_range(derived(derived(X, w), w)),
    "peak": lambda w, X: max(map(abs, extent(X))),
    "max": lambda w, X: extent(X)[0],
    "harmonic_1": lambda w, X: math.hypot(X[1], X[2]),
    "cosine": lambda w, X: abs(X[1]),
    "sine": lambda w, X: abs(X[2]),
    "norm": lambda w, X: math.hypot(*X),
    "norm_over_root_2": lambda w, X: math.hypot(*X) / math.sqrt(2),
    "rms": lambda w, X: math.hypot(X[0], math.hypot(*X[1:]) / math.sqrt(2)),
    "rms_without_mean": lambda w, X: math.hypot(*X[1:]) / math.sqrt(2),
    "sum_of_moduli": lambda w, X: sum(math.hypot(*X[i:i + 2]) for i in range(1, len(X), 2)),
}


def noise(n):
    """n numbers of standard deviation 1 or so, always the same: sums of twelve uniform ones."""
    seed, out = 12345, []
    for _ in range(n):
        total = -6.0
        for _ in range(12):
            seed = (1103515245 * seed + 12345) % 2 ** 31
            total += seed / 2 ** 31
        out.append(total)
    return out


@functools.lru_cache(maxsize=None)
def solved(oscillator, code, scene):
    """[(omega, branch, X)] on the scene's grid: of the sweep upwards and, where that gets stuck, of one downwards."""
    e, grid = aft.Equations(oscillator, code), GRIDS[scene]
    low, high = STARTS[scene], grid[-1] + 0.3
    path = aft.trace(e, low, high)
    found = aft.solutions(e, path, grid)
    if path[-1][0] >= high:
        return found
    size = oscillator.force / oscillator.stiffness
    for omega, branch, X in aft.solutions(e, aft.trace(e, high, low), grid):
        if all(omega != w or max(abs(a - b) for a, b in zip(X, Y)) > 1e-6 * size for w, _, Y in found):
            found.append((omega, branch, X))
    return found


def chosen(found, how):
    """The solutions that the file has, in its order."""
    alone = {w for w, _, _ in found if sum(v == w for v, _, _ in found) == 1}
    if how == "unstable":  # branch 1: between the turns
        return sorted((p for p in found if p[0] in alone or p[1] == 1), key=lambda p: p[0])
    if how == "hopping":  # three omegas on the one stable branch, three on the other
        ends = {w: (min(p[1] for p in found if p[0] == w), max(p[1] for p in found if p[0] == w)) for w, _, _ in found}
        order = {w: i for i, w in enumerate(sorted(ends))}
        return sorted((p for p in found if p[1] == ends[p[0]][order[p[0]] // 3 % 2]), key=lambda p: p[0])
    if how == "wandering":  # back from the first turn, past omega = 0, and to and fro
        there = [p for p in found if p[1] == 0]
        back = there[::-1] + [(-w, b, X) for w, b, X in there[:4]]
        return (there + back)[:MOST_POINTS]
    return found[::-(-len(found) // MOST_POINTS)] if len(found) > MOST_POINTS else found


def curve(m):
    """[(omega, value)] as the file says them."""
    oscillator = SCENES[m.scene]
    factors = {name: getattr(oscillator, name) * factor for name, factor in m.times.items()}
    oscillator = dataclasses.replace(oscillator, **factors, **m.values)
    points = chosen(solved(oscillator, aft.Code(**m.code), m.scene), m.points)
    values = [m.value_factor * QUANTITIES[m.holds](w, X) for w, _, X in points]
    if m.points == "noise":
        values = [v * (1 + 0.01 * g) for v, g in zip(values, noise(len(values)))]
    if m.points == "outlier":
        values[2 * len(values) // 3] *= 1.3
    return [(m.omega_factor * p[0], v) for p, v in zip(points, values)]


@functools.lru_cache(maxsize=None)
def truth(scene, said):
    """[(omega, value, amplitude)] along the right curve, densely."""
    e = aft.Equations(SCENES[scene], aft.Code(harmonics=16, samples=2048))
    path = aft.trace(e, STARTS[scene], GRIDS[scene][-1] + 0.3, 0.1)
    return [(w, QUANTITIES[said](w, X), half_range(X)) for w, X in path]


def change(m, points):
    off = []
    for omega, value in points:
        least, along = 1.0, truth(m.scene, m.said)
        for (w0, v0, a0), (w1, v1, a1) in zip(along, along[1:]):
            if (w0 - omega) * (w1 - omega) <= 0 and w0 != w1:
                part = (omega - w0) / (w1 - w0)
                least = min(least, abs(value - v0 - part * (v1 - v0)) / (a0 + part * (a1 - a0)))
        if omega > 0:
            off.append(least)
    return sorted(off)[len(off) - 1 - len(off) // 20]


def text(m):
    points = curve(m)
    lines = [f"# {m.scene}, {m.name[len(m.scene) + 1:]}: by make_curves.py", f"# change: {change(m, points):.2g}",
             f"omega,{m.said}"]
    return "\n".join(lines + [f"{w:.7g},{v:.7g}" for w, v in points]) + "\n"


def read(path):
    return [tuple(map(float, line.split(","))) for line in path.read_text().split("\n")[3:] if line]


def same(m):
    here, there = curve(m), read(HERE / "curves" / f"{m.name}.csv")
    return len(here) == len(there) and all(
        abs(a - b) <= SAME * abs(b) for p, q in zip(here, there) for a, b in zip(p, q))


def main(arguments):
    check = "--check" in arguments
    names = [a for a in arguments if a != "--check"]
    unknown = set(names) - {m.name for m in mistakes.MISTAKES}
    if unknown:
        sys.exit("no such mistake: " + ", ".join(sorted(unknown)))
    failed = 0
    for m in mistakes.MISTAKES:
        if names and m.name not in names:
            continue
        if check:
            good = same(m)
            failed += not good
            print(f"{m.name}: {'the same' if good else 'NOT what the file says'}")
        else:
            (HERE / "curves").mkdir(exist_ok=True)
            written = text(m)
            (HERE / "curves" / f"{m.name}.csv").write_text(written)
            print(f"{m.name}: {written.count(chr(10)) - 3} points, {written.split(chr(10))[1][2:]}", flush=True)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
