#!/usr/bin/env python3
"""falsify.py - certificates that are false, from true ones; each is held against both checkers.

    python3 falsify.py changed  FOLDER COUNT SEED [--other COMMAND]   one thing changed, so that the statement is false
    python3 falsify.py resolved FOLDER COUNT SEED [--other COMMAND]   a wrong sequence of letters, solved so that the equations hold
    python3 falsify.py true     FOLDER COUNT SEED [--other COMMAND]   the certificates of FOLDER themselves, each confirmed by march.py

FOLDER holds true certificates (find.py). COMMAND is another checker, such as "build/release/hbmcheck-proof check"; its verdicts are compared. --keep FOLDER:
what is made is kept there.
What is accepted although it should be false is confirmed by an integration of the law in time, or else printed. Exit 1 if anything is left.
"""
import json
import math
import random
import shlex
import subprocess
import sys
import tempfile
from fractions import Fraction
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
import find  # noqa: E402
from find import check  # noqa: E402
from march import Law, March, dot  # noqa: E402


def copy(data):
    return json.loads(json.dumps(data))


# ---- the referee: the law integrated in time -------------------------------------------------------------------------------------------
def sliders(law, data):
    """w of every contact after event 0."""
    events, w = data["events"], [0.0] * len(law.contacts)
    for i, c in enumerate(law.contacts):
        if events[0]["state"][i] != "S":
            continue
        if str(i) in data["rest"]:
            w[i] = float(data["rest"][str(i)])
            continue
        k = 0
        while events[k - 1]["state"][i] == "S":
            k -= 1
        x, before = [float(v) for v in events[k]["x"]], events[k - 1]["state"][i]
        w[i] = dot(c["t"], x) - {"O": 0, "+": 1, "-": -1}[before] * c["mu"] * law.normal(c, x) / c["kt"]
    return w


def confirm(data, steps=4096, tolerance=1e-5):
    """None if one period of the law from event 0 goes through the certificate's letters at its times, closes and has its max and min; else what differs."""
    law = Law(data)
    T, events = 2 * math.pi / law.omega * data["multiple"], data["events"]
    e = events[0]
    m = March(law, float(e["t"]), [float(v) for v in e["x"]], [float(v) for v in e["v"]], e["state"], sliders(law, data), steps)
    for i, c in enumerate(law.contacts):
        k = 0
        while k > 1 - len(events) and events[k - 1]["state"][i] == "S":
            k -= 1
        if e["state"][i] == "S" and events[k - 1]["state"][i] == "O":
            m.touched.add(i)
    start, size = (list(m.x), list(m.v)), (max(map(abs, m.x)) + float(data["scales"]["x"]), max(map(abs, m.v)) + float(data["scales"]["v"]))
    response, high, low = [float(v) for v in data["response"]], -math.inf, math.inf
    # The last event is event 0 again: end a little before it, then continue with its letters as they come.
    end = m.t + T
    for k in range(steps * data["multiple"]):
        m.run(min(float(e["t"]) + (k + 1) * T / (steps * data["multiple"]), end - 1e-7 * T), 4 * len(events) + 20)
        if len(m.events) > len(events) + 3:
            return "more transitions"
        r = dot(response, m.x)
        high, low = max(high, r), min(low, r)
    for x in [e["x"] for e in events]:
        r = dot(response, [float(v) for v in x])
        high, low = max(high, r), min(low, r)
    got = [(t, s) for t, _, _, s, _ in m.events]
    asked = [(float(e["t"]), e["state"]) for e in events[1:]]
    if [s for _, s in got] != [s for _, s in asked]:
        return f"letters {' '.join(s for _, s in got)}"
    if any(abs(a - b) > tolerance * T for (a, _), (b, _) in zip(got, asked)):
        return "times"
    x, v = m.at(law.series(m.t, m.x, m.v, m.w, m.letters), end - m.t)
    if max(abs(a - b) for a, b in zip(x, start[0])) > tolerance * size[0] or max(abs(a - b) for a, b in zip(v, start[1])) > tolerance * size[1]:
        return "does not close"
    for name, value in (("max", high), ("min", low)):
        if abs(value - float(data["claims"][name][0])) > 1e-4 * size[0]:
            return name
    return None


# ---- one thing changed -----------------------------------------------------------------------------------------------------------------
def parts(data):
    """Decimal strings that matter, as (words, object, key); model numbers that no segment uses are left out."""
    states = [e["state"] for e in data["events"]]
    model, n = data["model"], len(data["model"]["mass"])
    out = [("omega", data, "omega")]
    for name in ("mass", "damping", "stiffness"):
        out += [(name, row, j) for row in model[name] for j in range(n)]
    for f in model["forcing"]:
        out += [("forcing", f["cos"], j) for j in range(n)] + [("forcing", f["sin"], j) for j in range(n) if f["harmonic"]]
    for i, c in enumerate(model["contacts"]):
        letters = {s[i] for s in states}
        closed, slips, sticks = letters != {"O"}, letters & set("+-"), "S" in letters
        for key in ("normal_stiffness", "gap", "angle_deg"):
            if key in c and (closed or key == "gap" and float(c[key]) > 0):
                out.append((key, c, key))
        if sticks:
            out.append(("tangential_stiffness", c, "tangential_stiffness"))
        if slips:
            out.append(("friction", c, "friction"))
            if "preload" in c:
                out.append(("preload", c, "preload"))
    out += [("rest", data["rest"], key) for key in data["rest"]]
    return out


def closed_gap_matters(data):
    """kn and gap of a closed contact enter the motion by N - N0: with a gap > 0 that never opens, and no friction that depends on N, gap does not."""
    states = [e["state"] for e in data["events"]]
    return [not (float(c.get("gap", "0")) > 0 and {s[i] for s in states} <= set("SN")) for i, c in enumerate(data["model"]["contacts"])]


def changed(data, rng):
    """(words, certificate) with a false statement, or None where the draw would leave it true."""
    out, section = copy(data), "section" in data["events"][0]
    kind = rng.choice(("time", "state", "letter", "model", "model", "model", "bounds", "bounds", "radius", "uniqueness", "scales", "multiplier", "stability",
                       "multiple", "events", "response", "precision"))
    claims, events = out["claims"], out["events"]
    e = rng.choice(events)
    relative = Fraction(10) ** -rng.randrange(1, 16) * rng.choice((-1, 1))
    scale = {k: Fraction(v) for k, v in data["scales"].items()}
    if kind == "time":
        if section:
            return None
        e["t"] = find.digits(Fraction(e["t"]) + relative * scale["t"], 40)
    elif kind == "state":
        key = rng.choice("xv")
        j = rng.randrange(len(e[key]))
        e[key][j] = find.digits(Fraction(e[key][j]) + relative * scale[key], 40)
    elif kind == "letter":
        if not e["state"]:
            return None
        i = rng.randrange(len(e["state"]))
        letter = rng.choice([v for v in check.Contact(out["model"]["contacts"][i], "", len(e["x"])).letters if v != e["state"][i]] or " ")
        if letter == " ":
            return None
        e["state"] = e["state"][:i] + letter + e["state"][i + 1:]
    elif kind == "model":
        kind, holder, key = rng.choice(parts(out))
        if kind == "gap" and not closed_gap_matters(data)[next(i for i, c in enumerate(out["model"]["contacts"]) if c is holder)]:
            return None
        old = Fraction(holder[key])
        holder[key] = find.digits(old * (1 + relative) if old else relative, 40)
        if kind == "mass":
            for i, row in enumerate(out["model"]["mass"]):
                for j in range(i):
                    if row is not holder and out["model"]["mass"][j] is not holder:
                        continue
                    row[j] = out["model"]["mass"][j][i] = row[j] if row is holder and j == key else out["model"]["mass"][j][i]
    elif kind == "bounds":
        kind = rng.choice(check.BOUNDS)
        low, high = map(Fraction, claims[kind])
        by = (high - low) * rng.choice((2, 10, 10 ** 6, 10 ** 15)) * rng.choice((-1, 1))
        ends = [low + by, high + by] if rng.random() < 0.8 else [high, low]
        claims[kind] = [find.digits(v, 60) for v in ends]
    elif kind in ("radius", "scales"):
        test = check.Krawczyk(check.Orbit(check.Certificate(data)))
        distance = Fraction(max(test.step), 1 << check.Ball.bits)
        if distance < Fraction(1, 10 ** 35):
            return None
        factor = distance * Fraction(3, 10) / Fraction(claims["radius"])
        if kind == "radius":
            claims["radius"] = find.digits(factor * Fraction(claims["radius"]), 20)
        else:
            out["scales"] = {k: find.digits(factor * v, 20) for k, v in scale.items()}
    elif kind == "multiplier":
        if "multiplier" not in claims or claims["stability"] == "unproven":
            return None
        low, high = map(Fraction, claims[kind])
        by = (high - low) * rng.choice((2, 100, 10 ** 9)) * rng.choice((-1, 1))
        claims[kind] = [find.digits(v + by, 40) for v in (low, high)]
    elif kind == "stability":
        if claims[kind] == "unproven":
            return None
        claims[kind] = "unstable" if claims[kind] == "stable" else "stable"
    elif kind == "multiple":
        if section:
            return None
        out["multiple"] = data["multiple"] + 1
    elif kind == "events":
        if section:
            return None
        i, how = rng.randrange(len(events)), rng.choice(("dropped", "doubled", "swapped"))
        if how == "swapped" and len(events) < 2:
            return None
        if how == "dropped":
            events.pop(i)
        elif how == "doubled":
            events.insert(i, copy(events[i]))
        else:
            events[i - 1], events[i] = events[i], events[i - 1]
    elif kind == "response":
        j = rng.randrange(len(out["response"]))
        out["response"][j] = find.digits(Fraction(out["response"][j]) + relative, 40)
        if abs(relative) < Fraction(1, 10 ** 8):
            return None
    elif kind in ("uniqueness", "precision"):
        return None  # more may be true than was claimed; the bits say nothing of the orbit
    return kind, out


# ---- wrong sequences, solved -------------------------------------------------------------------------------------------------------------
def legal(a, b):
    changes = [(p, q) for p, q in zip(a, b) if p != q]
    return len(changes) == 1 and changes[0] not in (("+", "-"), ("-", "+"))


def resolved(data, rng):
    """A certificate of another sequence whose equations hold, or None."""
    out, law = copy(data), Law(data)
    T, events = 2 * math.pi / law.omega * data["multiple"], out["events"]
    section = "section" in events[0]
    allowed = [check.Contact(c, "", law.n).letters for c in out["model"]["contacts"]]
    if not allowed:
        return None
    i, how = rng.randrange(len(events)), rng.choice(("insert", "insert", "drop", "letter", "letter", "pair", "swap"))
    c = rng.randrange(len(allowed))
    others = [v for v in allowed[c] if v != events[i]["state"][c]]
    put = lambda s, v: s[:c] + v + s[c + 1:]
    if how == "insert" and others:
        # Another letter for a while within segment i; states by the march with that segment's letters.
        begin, e = float(events[i]["t"]), events[i]
        end = float(events[i + 1]["t"]) if i + 1 < len(events) else float(events[0]["t"]) + T
        at = sorted(begin + (end - begin) * rng.uniform(0.02, 0.98) for _ in range(2))
        letter, new = rng.choice(others), []
        m = March(law, begin, [float(v) for v in e["x"]], [float(v) for v in e["v"]], e["state"], sliders(law, {**out, "events": events[i:] + events[:i]}))
        m.violations = lambda x, v, slack=0.0: {}
        for t, state in zip(at, (put(e["state"], letter), e["state"])):
            m.run(t)
            new.append({"t": repr(t), "x": list(map(repr, m.x)), "v": list(map(repr, m.v)), "state": state})
        events[i + 1:i + 1] = new
        if section:
            events.pop(0)
    elif how == "drop" and len(events) > 2:
        events.pop(i)
    elif how == "pair" and len(events) > 3:
        events.pop(i)
        events.pop(i % len(events))
    elif how == "letter" and others:
        letter, old = rng.choice(others), events[i]["state"][c]
        for k in range(len(events)):  # along the whole run of that letter, or on this segment
            e = events[(i + k) % len(events)]
            if e["state"][c] != old:
                break
            e["state"] = put(e["state"], letter)
            if rng.random() < 0.3:
                break
    elif how == "swap" and len(events) > 1:
        a, b = events[i - 1], events[i]
        a["state"], b["state"] = b["state"], a["state"]
    else:
        return None
    if len(events) > 1:
        out["events"] = events = [e for k, e in enumerate(events) if e["state"] != events[k - 1]["state"]]
    if len(events) < 2 or [e["state"] for e in events] == [e["state"] for e in data["events"]]:
        return None
    if not all(legal(events[k - 1]["state"], e["state"]) for k, e in enumerate(events)):
        return None
    stuck = {str(k) for k in range(len(allowed)) if all(e["state"][k] == "S" for e in events)}
    out["rest"] = {k: out["rest"].get(k, "0") for k in stuck}
    solved = find.newton(out, steps=25)
    if not solved:
        return None
    try:
        return find.complete(solved)[0]
    except (check.Unproven, check.Wrong):
        return None


# ---- both checkers -----------------------------------------------------------------------------------------------------------------------
class Judges:
    def __init__(self, other, keep):
        self.other, self.keeps, self.folder = other, keep is not None, Path(keep or tempfile.mkdtemp())
        self.folder.mkdir(parents=True, exist_ok=True)
        self.tally, self.differ, self.left = {}, 0, 0

    def both(self, name, data):
        path = self.folder / (f"{name}.json" if self.keeps else "certificate.json")
        path.write_text(json.dumps(data))
        answers = [check.examine(str(path))]
        if self.other:
            run = subprocess.run(shlex.split(self.other) + [str(path), "--format", "json"], capture_output=True, text=True, timeout=600)
            answers.append(json.loads(run.stdout.splitlines()[0]) if run.stdout.strip() else {"verdict": f"exit {run.returncode}", "reason": run.stderr})
        if len({a["verdict"] for a in answers}) > 1:
            self.differ += 1
            self.keep(f"differ-{name}", data)
            print("DIFFER", name, *((a["verdict"], a["reason"]) for a in answers), flush=True)
        return answers

    def keep(self, name, data):
        (self.folder / f"{name}.json").write_text(json.dumps(data, indent=1))

    def count(self, key):
        self.tally[key] = self.tally.get(key, 0) + 1


def cause(reason):
    for words in ("singular", "not in order", "Krawczyk", "negative", "not decided", "two independent", "edge of the cone", "false", "narrow", "stability unproven"):
        if words in (reason or ""):
            return words
    return reason or "accepted"


def main():
    arguments, options = sys.argv[1:], {}
    for name in ("--other", "--keep"):
        if name in arguments:
            k = arguments.index(name)
            options[name] = arguments[k + 1]
            del arguments[k:k + 2]
    kind, folder, count, seed = arguments[0], Path(arguments[1]), int(arguments[2]), int(arguments[3])
    files, rng, judges = sorted(folder.glob("*.json")), random.Random(seed), Judges(options.get("--other"), options.get("--keep"))
    made = tries = 0
    while made < count and tries < 60 * count:
        file = files[tries % len(files)] if kind == "true" else rng.choice(files)
        tries += 1
        data = json.loads(file.read_text())
        if kind == "true":
            words, false = "true", data
        elif kind == "changed":
            words, false = changed(data, rng) or (None, None)
        else:
            words, false = "resolved", resolved(data, rng)
        if false is None:
            continue
        made += 1
        name = f"{words.split()[0]}-{file.stem}-{seed}-{tries}"
        answer, *others = judges.both(name, false)
        if any(a["verdict"] == "accepted" for a in [answer] + others):
            differs = confirm(false)
            judges.count(f"{words}: accepted, " + ("confirmed" if differs is None else "NOT CONFIRMED"))
            if differs is not None or kind == "changed":
                judges.left += 1
                judges.keep(f"accepted-{name}", false)
                print("ACCEPTED", words, name, differs, flush=True)
        else:
            judges.count(f"{words}: {cause(answer['reason']) if answer['verdict'] == 'rejected' else 'wrong'}")
            if kind == "true":
                judges.left += 1
                print("REJECTED", name, answer["reason"], flush=True)
    for key in sorted(judges.tally):
        print(f"{judges.tally[key]:6d} {key}")
    print(f"{made} certificates of {tries} tries, {judges.left} left, {judges.differ} differ; kept in {judges.folder}")
    return 1 if judges.left or judges.differ else 0


if __name__ == "__main__":
    sys.exit(main())
