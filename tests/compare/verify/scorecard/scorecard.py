#!/usr/bin/env python3
"""scorecard.py HBMCHECK [--only TEXT] [--every N] [--before HBMCHECK] [--wrong N] [--share PERCENT] [--jobs N] [--markdown]
What `hbmcheck verify` says of every curve of mistakes.py:

    right     it names what is wrong, in words that mistakes.py accepts
    guess     it names nothing, and gives a nearest guess (a guess that holds the right words: "good guess")
    nothing   neither, or the curve was refused
    wrong     it names something else

--only: the curves whose name contains TEXT. --every: one in N of them. --before: another build beside it, for a table of both. --markdown: that
table as docs/verify.md has it. exit: 0 no more than N wrong [0], and at least PERCENT [85] of the mistakes that change
their curve by more than 2 % are right  1 not  64 usage"""
import argparse
import concurrent.futures
import json
import pathlib
import subprocess
import sys
import time
from dataclasses import dataclass

import mistakes

HERE = pathlib.Path(__file__).resolve().parent
CASES = {"case2": HERE.parents[3] / "cases/verify/case2.yaml", "preloaded": HERE / "preloaded.yaml"}
PATIENCE = 300  # seconds for one curve; a hang is no answer
MUCH = 0.02     # [1] a mistake that changes its curve by more must be named
OUTCOMES = ("right", "guess", "nothing", "wrong")


@dataclass
class Answer:
    named: frozenset
    guessed: frozenset
    exit_code: int
    seconds: float
    sentence: str


def words(text):
    return frozenset(text.split("+")) if text and text not in ("none", "unknown") else frozenset()


def ask(binary, m):
    command = [binary, "verify", str(CASES[m.scene]), "--against", str(HERE / "curves" / f"{m.name}.csv"), "--columns",
               f"omega=1,{m.said}=2", "--format", "json", "-q"]
    begin = time.monotonic()
    try:
        run = subprocess.run(command, capture_output=True, text=True, timeout=PATIENCE, check=False)
    except subprocess.TimeoutExpired:
        return Answer(frozenset(), frozenset(), -1, PATIENCE, "no answer")
    seconds = time.monotonic() - begin
    if run.returncode not in (0, 1, 3) or not run.stdout:
        asked = frozenset({"decibel"} if "is it in dB?" in run.stderr else {})  # refused, and told why
        return Answer(asked, frozenset(), run.returncode, seconds, run.stderr.strip())
    said = json.loads(run.stdout)
    if "Summary" in said:
        summary = said["Summary"][0]
        return Answer(words(summary["cause"]), words(summary["nearest_guess"]), run.returncode, seconds,
                      summary["sentence"])
    notes = said["notes"]  # before there was a summary, the cause was in the remarks alone
    notes = notes["Points"] if isinstance(notes, dict) else notes
    return Answer(words(notes[-1].removeprefix("cause: ")), frozenset(), run.returncode, seconds, notes[-2])


def outcome(m, a):
    if a.named:
        return "right" if a.named in m.right else "wrong"
    if frozenset({"noise"}) in m.right and a.guessed == frozenset({"noise"}):  # a remark, without --noise
        return "right"
    if frozenset() in m.right:
        return "right" if a.exit_code in (0, 1, 3) and not a.guessed else "nothing"
    return "guess" if a.guessed else "nothing"


def shown(m, a):
    """The outcome as a person reads it."""
    if a.guessed and not a.named and outcome(m, a) != "right":
        return ("good guess: " if a.guessed in m.right else "guess: ") + "+".join(sorted(a.guessed))
    kind = outcome(m, a)
    return kind if kind in ("right", "nothing") else f"{kind}: " + "+".join(sorted(a.named))


def change(m):
    return float((HERE / "curves" / f"{m.name}.csv").read_text().split("\n")[1].removeprefix("# change: "))


def counts(listed, answers):
    return {kind: sum(outcome(m, a) == kind for m, a in zip(listed, answers)) for kind in OUTCOMES}


def share(listed, answers):
    """[%] named right, of those that have a name and change their curve by more than MUCH; and of how many."""
    much = [(m, a) for m, a in zip(listed, answers) if change(m) > MUCH and m.right]
    good = sum(outcome(m, a) == "right" for m, a in much)
    return 100 * good / len(much) if much else 100.0, len(much)


def percent(number):
    return f"{100 * number:.2g} %" if number < 0.995 else "100 %"


def table(listed, columns, markdown):
    """columns: (title, answers) of each build."""
    head = ["mistake", "changes the curve by"] + [title for title, _ in columns]
    rows = [[m.name.replace("_", " "), percent(change(m))] + [shown(m, answers[i]) for _, answers in columns]
            for i, m in enumerate(listed)]
    for kind in OUTCOMES:
        rows.append([f"**{kind}**" if markdown else kind, ""] + [str(counts(listed, a)[kind]) for _, a in columns])
    rows.append([("**{}**" if markdown else "{}").format("right, of those above 2 %"), ""]
                + ["{:.0f} % of {}".format(*share(listed, a)) for _, a in columns])
    if markdown:
        return "\n".join(["| " + " | ".join(r) + " |" for r in [head, ["---"] * len(head)] + rows])
    widths = [max(len(r[i]) for r in [head] + rows) for i in range(len(head))]
    return "\n".join("  ".join(cell.ljust(w) for cell, w in zip(r, widths)).rstrip() for r in [head] + rows)


def main():
    usage = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    usage.add_argument("hbmcheck")
    usage.add_argument("--only", default="")
    usage.add_argument("--every", type=int, default=1)
    usage.add_argument("--before")
    usage.add_argument("--wrong", type=int, default=0)
    usage.add_argument("--share", type=float, default=85.0)
    usage.add_argument("--jobs", type=int, default=1)
    usage.add_argument("--markdown", action="store_true")
    usage.exit_on_error = False
    try:
        o = usage.parse_args()
    except argparse.ArgumentError as e:
        print(e, file=sys.stderr)
        return 64
    listed = [m for m in mistakes.MISTAKES if o.only in m.name][:: max(o.every, 1)]
    if not listed:
        print(f"no mistake is called like '{o.only}'", file=sys.stderr)
        return 64
    with concurrent.futures.ThreadPoolExecutor(o.jobs) as pool:
        def all_of(binary):
            return list(pool.map(lambda m: ask(binary, m), listed))
        columns = ([("before", all_of(o.before))] if o.before else []) + [("now", all_of(o.hbmcheck))]
    now = columns[-1][1]
    print(table(listed, columns, o.markdown))
    for m, a in zip(listed, now):
        if not o.markdown and outcome(m, a) != "right":
            print(f"\n{m.name} ({a.seconds:.1f} s): {a.sentence}")
    slowest = max(zip(now, listed), key=lambda pair: pair[0].seconds)
    if not o.markdown:
        print(f"\n{sum(a.seconds for a in now):.0f} s, the longest {slowest[0].seconds:.1f} s: {slowest[1].name}")
    return 0 if counts(listed, now)["wrong"] <= o.wrong and share(listed, now)[0] >= o.share else 1


if __name__ == "__main__":
    sys.exit(main())
