#!/usr/bin/env python3
"""500 certificates of which one number or field is another: both checkers give the same verdict on each, for the same kind of reason.

    test_mutants.py HBMCHECK_PROOF [COUNT [SEED]]     exit 1 and a line for each certificate on which they differ

Of true certificates, those of certificates/ and what `complete` makes of their candidates and of two more (whose radius of uniqueness, a thousand times
larger, is about as large as may be), every number and field is drawn as often: a thousand times itself, a thousandth, its negative, 0, off by 1e-3 or 1e-9 of
itself, missing.
"""
import collections
import json
import pathlib
import random
import subprocess
import sys
from fractions import Fraction

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))
from falsify import cause  # noqa: E402
from find import check, digits  # noqa: E402
from test_verdicts import rounded  # noqa: E402

# Case 2 at other omega: t, x, v, letter at the two events
CASE_2 = {"6": ((0.084722396952438, 7.07106781186548, -28.976748491705, "O"), (1.023722491109933, 7.07106781186548, 29.282877733037, "S")),
          "6.5": ((0.091556122471352, 7.07106781186548, -40.998251300774, "O"), (0.944046035458982, 7.07106781186548, 41.486450793113, "S"))}
CHANGES = {"* 1000": lambda v: 1000 * v, "/ 1000": lambda v: v / 1000, "negative": lambda v: -v, "0": lambda v: 0 * v,
           "+ 1e-3": lambda v: v * (1 + Fraction(1, 1000)), "+ 1e-9": lambda v: v * (1 + Fraction(1, 10 ** 9)), "missing": None}

KINDS = {"singular": "Krawczyk"}  # rounding decides whether floats have an inverse of what has none


def answers(program, command, objects):
    run = subprocess.run([program, *command], input="".join(json.dumps(o) + "\n" for o in objects), capture_output=True, text=True)
    return [json.loads(line) for line in run.stdout.splitlines()]


def true_ones(program):
    stored = [json.loads(path.read_text()) for path in sorted((HERE / "certificates").glob("*.json"))]
    candidates = [rounded(c) for c in stored]
    stable = next(c for c in candidates if len(c["events"]) == 2)
    for omega, events in CASE_2.items():
        candidates.append({**stable, "omega": omega, "events": [dict(zip(("t", "x", "v", "state"), (t, [x], [v], s))) for t, x, v, s in events]})
    made = [a["certificate"] for a in answers(program, ["complete", "-", "-o", "-"], candidates)]
    assert all(made), "a candidate is not completed"
    return stored + made


def places(value, path=()):
    """Paths to every number and field."""
    for key in value if isinstance(value, dict) else range(len(value)):
        yield path + (key,)
        if isinstance(value[key], (dict, list)):
            yield from places(value[key], path + (key,))


def mutant(data, path, change):
    """The certificate with that changed there, or None: it is no number, or the same."""
    out = json.loads(json.dumps(data))
    holder = out
    for key in path[:-1]:
        holder = holder[key]
    old = holder[path[-1]]
    if change is None:
        del holder[path[-1]]
        return out
    if isinstance(old, str) and check.NUMBER.match(old):
        holder[path[-1]] = digits(Fraction(change(Fraction(old))), 100)
    elif isinstance(old, int):
        holder[path[-1]] = int(change(old))
    return out if holder[path[-1]] != old else None


def main():
    program, count, seed = sys.argv[1], int((sys.argv[2:] or [500])[0]), int((sys.argv[3:] or [58])[0])
    rng, true, mutants, tally, differ = random.Random(seed), true_ones(program), [], collections.Counter(), 0
    every = [list(places(data)) for data in true]
    # the radius of uniqueness of each, a thousand times larger, first
    drawn = [(k, ("claims", "uniqueness_radius"), "* 1000") for k in range(len(true))]
    while len(mutants) < count:
        k, path, name = drawn.pop() if drawn else (k := rng.randrange(len(true)), rng.choice(every[k]), rng.choice(list(CHANGES)))
        if data := mutant(true[k], path, CHANGES[name]):
            mutants.append((f"certificate {k}, {'.'.join(map(str, path))} {name}", data))
    for (name, data), theirs in zip(mutants, answers(program, ["check", "-"], [data for _, data in mutants])):
        ours = check.examine(name, json.dumps(data).encode())
        same = [(a["verdict"], a["verdict"] == "wrong" or KINDS.get(cause(a["reason"]), cause(a["reason"]))) for a in (ours, theirs)]
        tally[ours["verdict"]] += 1
        if same[0] != same[1]:
            differ += 1
            print(f"{name}: {ours['verdict']} ({ours['reason']}) in Python, {theirs['verdict']} ({theirs['reason']}) in C")
    print(f"{len(mutants)} mutants, on {differ} the checkers differ; " + ", ".join(f"{n} {verdict}" for verdict, n in sorted(tally.items())))
    return 1 if differ or len(tally) < 3 else 0


if __name__ == "__main__":
    sys.exit(main())
