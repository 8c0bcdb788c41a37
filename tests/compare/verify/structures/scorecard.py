#!/usr/bin/env python3
"""scorecard.py HBMCHECK CURVES [--only TEXT] [--hidden] [--results FILE] [--markdown] [--share PERCENT]
What `hbmcheck verify` says of every curve in the folder CURVES (make.py) of the mistakes of curves.py:

    right     it names what is wrong, in words that curves.py accepts; of noise: that the points scatter
    guess     it names nothing, and gives a nearest guess (a guess that holds the right words: "good guess")
    nothing   neither
    wrong     it names something else

--hidden: those written last alone. --markdown: the tables of docs/measurements/verify_structures.md, by cause. exit: 0 none wrong, and at
least PERCENT [85] of the mistakes that change their curve by more than 2 % are right  1 not  64 usage"""
import argparse
import datetime
import json
import pathlib
import resource
import subprocess
import sys
import textwrap

import curves

MUCH = 2.0       # [%] a mistake that changes its curve by more must be named
MOST_SECONDS = 300


def words(text):
    return frozenset(text.split("+")) if text and text not in ("none", "unknown") else frozenset()


def ask(binary, curve, m):
    scene = curves.SCENES[m.scene]
    columns = ",".join(["omega=1"] + [f"amplitude{'@' * bool(r)}{r}={k + 2}" for k, r in enumerate(scene.names)])
    run = subprocess.Popen(["prlimit", f"--cpu={MOST_SECONDS}", binary, "verify", str(scene.case), "--against", curve, "--columns", columns, "--format",
                            "json", "-q"], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    out, err = run.communicate()
    return run.returncode, out, err


def judge(binary, folder, m):
    curve = folder / f"{m.file}.csv"
    off = float(curve.read_text().split("off by ")[1].split(" %")[0])
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    code, out, err = ask(binary, str(curve), m)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    seconds = after.ru_utime - before.ru_utime + after.ru_stime - before.ru_stime
    if code not in (0, 1, 3) or not out:
        return m, off, "nothing", seconds, f"exit {code}: {err.strip()}"
    rows = json.loads(out)["Summary"]
    named = {words(r["cause"]) for r in rows} - {frozenset()}
    guessed = {words(r["nearest_guess"]) for r in rows} - {frozenset()}
    accepted = [words(w) for w in m.words]
    if curves.SCENES[m.scene].coarse:
        accepted += [a | {"too_few_harmonics"} for a in accepted]
    said = next((r["sentence"] for r in rows if r["cause"] != "none"), rows[0]["sentence"])
    if named:
        outcome = "right" if all(n in accepted for n in named) else "**wrong**: " + ", ".join("+".join(sorted(n)) for n in named)
    elif guessed:
        good = any(a <= g for a in accepted for g in guessed)
        text = ", ".join(sorted("+".join(sorted(g)) for g in guessed))
        noise = frozenset({"noise"})
        outcome = "right" if noise in accepted and guessed == {noise} else f"{'good guess' if good else 'guess'}: {text}"
    else:
        outcome = "nothing" if code == 3 or any(r["differs"] for r in rows) else "match"  # 3: points not judged
    return m, off, outcome, seconds, said


def tables(results):
    print(f"{datetime.date.today():%-d %B %Y}\n\n| | curves | more than 2 % off | right of these | wrong | median | most |\n|---|---|---|---|---|---|---|")
    for text, part in (("all", results), ("seen while `verify` was made", [r for r in results if not r[0].hidden]),
                       ("hidden", [r for r in results if r[0].hidden])):
        much, seconds = [r for r in part if r[1] > MUCH], sorted(r[3] for r in part) or [0]
        right, wrong = sum(r[2] == "right" for r in much), sum(r[2].startswith("**wrong**") for r in part)
        print(f"| {text} | {len(part)} | {len(much)} | {right} ({100 * right / max(1, len(much)):.0f} %) | {wrong} | "
              f"{seconds[len(seconds) // 2]:.1f} s | {seconds[-1]:.1f} s |")
    causes = {}
    for m, _, outcome, _, _ in results:
        causes.setdefault("".join(m.words[:1]) or "nothing", []).append(outcome == "right")
    print("\n" + textwrap.fill("Right, of so many curves: " + ", ".join(f"{c} {sum(r)} of {len(r)}" for c, r in sorted(causes.items())) + ".",
                               118, break_on_hyphens=False))
    print("\n| not right | off by | hbmcheck verify | processor time [s] |\n|---|---|---|---|")
    for m, off, outcome, seconds, _ in results:
        if outcome != "right":
            print(f"| {m.name}{' (hidden)' * m.hidden} | {off:.2g} % | {outcome.replace('_', ' ').replace('+', ' + ')} | {seconds:.1f} |")
    print()


def main():
    parser = argparse.ArgumentParser(usage=__doc__)
    parser.add_argument("hbmcheck")
    parser.add_argument("curves", type=pathlib.Path)
    parser.add_argument("--only", default="")
    parser.add_argument("--hidden", action="store_true")
    parser.add_argument("--results", type=pathlib.Path)
    parser.add_argument("--markdown", action="store_true")
    parser.add_argument("--share", type=float, default=85)
    o = parser.parse_args()
    chosen = [m for m in curves.MISTAKES if o.only in m.name and (m.hidden or not o.hidden)]
    chosen = [m for m in chosen if (o.curves / f"{m.file}.csv").exists()]
    results, done = [], {}
    if o.results and o.results.exists():
        done = {r[0]: r for r in map(json.loads, o.results.read_text().splitlines())}
    for m in chosen:  # one after the other: processor time is counted of all children
        if m.name in done:
            _, *found = done[m.name]
        else:
            _, *found = judge(o.hbmcheck, o.curves, m)
            if o.results:
                with open(o.results, "a", encoding="ascii") as to:
                    to.write(json.dumps([m.name, *found]) + "\n")
        off, outcome, seconds, said = found
        results.append((m, *found))
        if not o.markdown:
            print(f"{m.name}: off by {off:.2g} %: {outcome} ({seconds:.1f} s)" + ("" if outcome == "right" else f": {said}"), flush=True)
    if o.markdown:
        tables(results)
    much = [r for r in results if r[1] > MUCH]
    right = [r for r in much if r[2] == "right"]
    wrong = [r for r in results if r[2].startswith("**wrong**")]
    seconds = sorted(r[3] for r in results) or [0]
    share = 100 * len(right) / max(1, len(much))
    print(f"\n{len(results)} curves; of {len(much)} more than 2 % off {len(right)} right: {share:.0f} %; {len(wrong)} wrong; "
          f"median {seconds[len(seconds) // 2]:.1f} s, most {seconds[-1]:.1f} s")
    return 0 if results and not wrong and share >= o.share else 1


if __name__ == "__main__":
    sys.exit(main())
