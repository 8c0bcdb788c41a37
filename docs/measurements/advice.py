#!/usr/bin/env python3
"""Is what hbmcheck advises right?

usage: advice.py followed HBMCHECK [ROWS [FIRST]]     the advice of `compare` on rows that differ, followed once
       advice.py settings HBMCHECK [SCENES [FIRST]]   the settings of `advise`, compared with time integration
Scenes: `hbmcheck stress --case --first FIRST, FIRST + 1, ...`, one in six a structure, solved with settings drawn at random (seed
1 + FIRST). Progress and what failed go to standard error, a dated table for advice.md to standard output; SIGTERM ends a set early,
with the table of what was seen. Standard library only."""
import csv, datetime, itertools, os, random, re, resource, signal, statistics, subprocess, sys, tempfile

SECONDS = 15  # [s] of processor time that a run of hbmcheck may take


def run(args):
    """(standard output, processor time [s]); None where it took too long."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    ran = subprocess.run(["prlimit", f"--cpu={SECONDS}"] + args, capture_output=True, text=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    took = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return (None if ran.returncode < 0 else ran.stdout), took


def note(*words): print(*words, file=sys.stderr, flush=True)


class Ended(Exception): pass


def end(*_): raise Ended


def table_of(title, rows):
    """A dated Markdown table of (what, number)."""
    print(f"## {title}, {datetime.date.today():%-d %B %Y}\n\n| what | number |\n|---|---|")
    for what, number in rows: print(f"| {what} | {number} |")


def table(text): return list(csv.DictReader(l for l in text.splitlines() if l and not l.startswith("#")))


def scene(exe, i, folder):
    path = os.path.join(folder, "scene.yaml")
    subprocess.run([exe, "stress", "--case", "--first", str(i), "-o", path] + (["--structures"] if i % 6 == 5 else []), check=True)
    return path


def compare(exe, path, sets, at=()):
    args = [exe, "compare", path, "--quiet", "--format", "csv"] + [x for s in sets for x in ("--set", s)]
    return run(args + (["--at", ",".join(map(repr, at))] if at else []))


def drawn(rng):
    h = rng.choice([1, 2, 3, 5, 7])
    sets = [f"hbm.harmonics={h}", f"hbm.static={rng.choice(['true'] * 5 + ['false'])}"]
    if rng.random() < 0.5: sets += ["hbm.force=sampled", f"hbm.samples={max(2 * h + 2, rng.choice([16, 32, 64, 128]))}"]
    if rng.random() < 0.7: sets += ["transient.law=exact", "transient.method=closed_form"]
    else: sets += [f"transient.regularisation={rng.choice(['3e-2', '1e-2', '1e-3', '1e-4'])}"]
    if rng.random() < 0.1: sets += ["transient.start=rest", "transient.max_periods=300"]
    return sets


def settings_in(advice):
    """["hbm.harmonics=9", ...] of "use hbm.harmonics >= 9 and ..."."""
    return [re.sub(r" >= | <= |: ", "=", s) for s in re.findall(r"(?:hbm|transient)\.\w+(?: >= |: | <= )\S+", advice.split(" or ")[0].replace(",", ""))]


def key(r): return float(r["transient_amplitude"] or "nan")


def worst_row(rows, advice):
    """The row that the advice is about."""
    m = re.search(r"branch (-?\d+)(?:, ([^:]*))?:", advice)
    return next((r for r in rows if r["branch"] == m.group(1) and r.get("response", "") in (m.group(2) or "", "")), None)


def followed(exe, wanted, start):
    rng, seen, passed, helped, causes, why = random.Random(1 + start), 0, 0, 0, {}, {}
    nothing, too_long, i = 0, 0, start
    limits = ["hbm.static=true", "hbm.force=exact", "transient.law=exact", "transient.start=hbm", "transient.tolerance=1e-10"]
    with tempfile.TemporaryDirectory() as folder:
        try:
            for i in itertools.count(start):
                if seen >= wanted: break
                path, sets = scene(exe, i, folder), drawn(rng)
                out, _ = compare(exe, path, sets)
                said = re.search(r"# largest budget, .*", out or "")
                if not said: continue
                row = worst_row(table(out), said.group())
                if not row or row["verdict"] != "differs" or "within the gate" in said.group(): continue
                advised = "use " in said.group()
                again = compare(exe, path, sets + settings_in(said.group().split("; ", 1)[1]))[0] if advised else ""
                if again is None:
                    too_long += 1
                    continue
                seen += 1
                cause = "orbit left" if "left the orbit" in said.group() else re.search(r"%: (\w+)", said.group()).group(1)
                causes[cause] = causes.get(cause, 0) + 1
                if advised:
                    found = verdicts(table(again), row)
                    passed += "match" in found
                    if "match" not in found: note("not", i, sets, said.group(), row["transient_amplitude"], found)
                else:
                    nothing += 1
                    for h in (20, 50) if nothing <= 50 else ():
                        again, _ = compare(exe, path, sets + limits + [f"hbm.harmonics={h}"])
                        if "match" in verdicts(table(again or ""), row):
                            helped += 1
                            note("helped after all", i, sets, h, said.group())
                            break
                if seen % 20 == 0: note(seen, i, passed, nothing, helped)
        except Ended: pass
    asked = seen - nothing
    table_of("Advice of `compare` followed once", [
        (f"random scenes, from {start} on", i - start), ("rows that differ", seen), ("by cause", ", ".join(f"{c} {n}" for c, n in sorted(causes.items()))),
        ("advised", asked), ("pass after following once", f"{passed} ({100 * passed / max(asked, 1):.1f} %)"), ("told that nothing helps", nothing),
        ("of these tried with 20 and 50 harmonics and all that is named", min(nothing, 50)), ("that did help", helped),
        (f"not counted: more than {SECONDS} s of processor time", too_long)])


def verdicts(rows, row):
    """Of the same response, where the transient is nearest to the row's; half as large again is another orbit."""
    same = [r for r in rows if r.get("response", "") == row.get("response", "") and r["transient_amplitude"] and abs(key(r) - key(row)) <= 0.5 * key(row)]
    nearest = min((abs(key(r) - key(row)) for r in same), default=0)
    return [r["verdict"] for r in same if abs(key(r) - key(row)) <= nearest + 1e-3 * key(row)]


def worst(rows, error):
    """The largest error of any row on one orbit; of an unstable one that of the waveform against the orbit."""
    top, family = 0, False
    for r in rows:
        if r["verdict"] in ("match", "differs"):
            e = [float(r[q + "_error"] or 0) for q in ("amplitude", "harmonic_1", "waveform")] + [float(r["mean_error"] or 0) * (r["mean_free"] != "yes")]
        elif r["verdict"] == "unstable" and r["orbit_error"]: e = [float(r["orbit_error"])]
        else: continue
        if max(e) > error and r["mean_free"] == "yes": family = True
        top = max(top, *e)
    return top, family


def settings(exe, wanted, start):
    rng, seen, kept, broken, smaller, too_long, seconds, i = random.Random(1 + start), 0, 0, 0, 0, 0, [], start
    exact = ["transient.law=exact", "transient.method=closed_form", "transient.start=hbm", "hbm.static=true"]
    with tempfile.TemporaryDirectory() as folder:
        try:
            for i in itertools.count(start):
                if seen >= wanted: break
                path, error = scene(exe, i, folder), rng.choice([1e-2, 1e-3, 1e-4])
                out, took = run([exe, "advise", path, "--error", repr(error), "--format", "csv", "--quiet"])
                if out is None:
                    seconds.append(took)
                    continue
                found = [r for r in table(out.split("\n\n")[0]) if r.get("harmonics")]
                if len(found) != 2 or "nothing nonlinear" in out: continue  # linear, or too few harmonics
                seconds.append(took)
                low, high = sorted(map(float, re.search(r"omega: \[(.*), (.*)\]\n", open(path).read()).groups()))
                strip = [(float(a), float(b)) for a, b in re.findall(r"left out: within (\S+) of the turning point at omega = (\S+)", out)]
                at = [w for w in (low + (high - low) * (k + rng.random()) / 60 for k in range(60)) if all(abs(w / b - 1) > a for a, b in strip)]
                counts, runs = [0, 0, 0], []
                for r in found:
                    force = ["hbm.force=" + r["force"]]
                    own = [f"hbm.harmonics={r['harmonics']}"] + ([f"hbm.samples={r['samples']}"] if r["samples"] else [])
                    runs.append(compare(exe, path, exact + force + own, at)[0])
                    here, family = worst(table(runs[-1] or ""), error)
                    counts[0] += here <= error
                    if here > error: note("above", i, r["force"], error, here, "family" if family else "", r)
                    if not r["next_smaller"]: continue
                    counts[1] += 1
                    next_sets = [f"hbm.{n}={v}" for n, v in zip(("harmonics", "samples"), re.findall(r"= (\d+)", r["next_smaller"]))]
                    runs.append(compare(exe, path, exact + force + next_sets, at)[0])
                    there, _ = worst(table(runs[-1] or ""), error)
                    breaks = there > 0.9 * error or float(r["next_smaller_error"]) > 0.9 * error
                    counts[2] += breaks
                    if not breaks: note("next keeps", i, r, there)
                if None in runs:
                    too_long += 1
                    continue
                seen += 1
                kept, smaller, broken = kept + counts[0], smaller + counts[1], broken + counts[2]
                if seen % 10 == 0: note(f"{seen} scenes of {i - start + 1}, {2 * seen} settings: {kept} kept; the next smaller of {smaller} breaks {broken}; "
                                        f"median {statistics.median(seconds):.2f} s, most {max(seconds):.2f} s")
        except Ended: pass
    seconds = seconds or [0]
    table_of("Settings of `advise` at 60 other frequencies", [
        (f"random scenes, from {start} on", i - start), ("with a contact that changes its state", seen), ("settings", 2 * seen),
        ("error kept", f"{kept} ({100 * kept / max(2 * seen, 1):.1f} %)"), ("settings with a next smaller one", smaller),
        ("that breaks the error, or comes within 10 % of it", f"{broken} ({100 * broken / max(smaller, 1):.1f} %)"),
        ("processor time of `advise`, median", f"{statistics.median(seconds):.2f} s"), ("most", f"{max(seconds):.2f} s"),
        (f"not counted: `compare` took more than {SECONDS} s", too_long)])


if __name__ == "__main__":
    signal.signal(signal.SIGTERM, end)
    {"followed": followed, "settings": settings}[sys.argv[1]](sys.argv[2], int(sys.argv[3]) if len(sys.argv) > 3 else 1000, int(sys.argv[4]) if len(sys.argv) > 4 else 0)
