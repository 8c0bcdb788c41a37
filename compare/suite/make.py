#!/usr/bin/env python3
"""make.py - makes the files of the suite from table.py.

    python3 compare/suite/make.py HBMCHECK [NAME...]      all cases, or these; HBMCHECK is the built program, hbmcheck-proof beside it

For each case cases/NAME.yaml, cases/NAME.json, and a certificate a reference; then suite.json and the list in README.md.
Cases whose laws have straight pieces: `hbmcheck prove` at the case's frequencies, everything must be proven. Others:
hbmcheck's own solutions, with the larger of two errors: half of the harmonics, and time integration.
"""
import csv
import glob
import io
import json
import os
import subprocess
import sys
import textwrap
from fractions import Fraction

import table

HERE = os.path.dirname(os.path.abspath(__file__))
VERSION = "1.1"
QUANTITIES = ("amplitude", "mean", "a1", "b1")
CERTIFIED_DIGITS = 16  # of the decimals of an enclosure that a case states; rounded outward


def flow(x):
    """YAML and JSON at once, but for keys that are numbers."""
    if isinstance(x, dict):
        return "{" + ", ".join(f"{k}: {flow(v)}" for k, v in x.items()) + "}"
    if isinstance(x, list):
        return "[" + ", ".join(flow(v) for v in x) + "]"
    return f"{x:.15g}" if isinstance(x, float) else str(x)


def yaml_of(c):
    lines = [f"# {c['tests']}", f"# Goes wrong most often: {c['wrong']}", f"title: {c['title']}", "structure:"]
    lines += [f"  {key}: {flow(c[key])}" for key in ("mass", "damping", "stiffness")]
    for key in ("loads", "contacts"):
        lines.append({"loads": "forcing", "contacts": "contacts"}[key] + ":")
        lines += [f"  - {flow(entry)}" for entry in c[key]]
    lines += [f"response: [{c['response']}]", f"sweep: {{omega: {flow(c['sweep'])}}}", f"compare: {{omega: {flow(c['at'])}}}",
              f"hbm: {{harmonics: {min(c['harmonics'], 20)}}}"]
    return "\n".join(lines) + "\n"


def row(c, direction):
    return [direction.get(i + 1, 0) for i in range(len(c["mass"]))]


def model_of(c):
    """The model as plain numbers."""
    loads = {}
    for load in c["loads"]:
        entry = loads.setdefault(load["harmonic"], [0] * len(c["mass"]))
        entry[load["dof"] - 1] += load["amplitude"]
    contacts = [{k: row(c, v) if k in ("tangent", "normal", "direction") else v for k, v in k_.items()} for k_ in c["contacts"]]
    return {"mass": c["mass"], "damping": c["damping"], "stiffness": c["stiffness"],
            "loads": [{"harmonic": h, "cos": v, "sin": [0] * len(v)} for h, v in sorted(loads.items())], "contacts": contacts}


def run(arguments, okay=(0,)):
    done = subprocess.run(arguments, capture_output=True, text=True)
    if done.returncode not in okay:
        sys.exit(f"{' '.join(arguments)}: exit {done.returncode}\n{done.stderr}")
    return done.stdout


def rows_of(text):
    return list(csv.DictReader(io.StringIO("\n".join(line for line in text.splitlines() if line and not line.startswith("#")))))


def decimal(text, up):
    """A decimal string rounded outward to CERTIFIED_DIGITS significant digits, as a JSON number."""
    value = Fraction(text)
    if value == 0:
        return "0"
    power = 0
    while abs(value) * Fraction(10) ** power < 10 ** (CERTIFIED_DIGITS - 1):
        power += 1
    while abs(value) * Fraction(10) ** power >= 10 ** CERTIFIED_DIGITS:
        power -= 1
    scaled = value * Fraction(10) ** power
    digits = str(-(-scaled.numerator // scaled.denominator) if up else scaled.numerator // scaled.denominator)
    sign, digits = ("-", digits[1:]) if digits[0] == "-" else ("", digits)
    return f"{sign}{digits[0]}.{digits[1:]}e{len(digits) - 1 - power}"


def interval(bounds):
    return f"[{decimal(bounds[0], False)}, {decimal(bounds[1], True)}]"


def family(certificate):
    """A slider rests all period beside a contact that is no slider of constant limit: the solution is one of a continuum, and not
    the mean alone depends on where the slider rests. (Beside sliders of constant limit all of it is shifted by a constant.)"""
    return bool(certificate["rest"]) and any(set(k) != {"tangential_stiffness", "friction", "preload", "tangent"}
                                             for k in certificate["model"]["contacts"])


def proven(hbmcheck, c, path):
    """References as JSON text: a row an orbit that is proven. The certificates are kept, without blanks."""
    folder = os.path.join(HERE, "certificates")
    for old in glob.glob(os.path.join(folder, c["name"] + "_[0-9]*.json")):
        os.remove(old)
    found = rows_of(run([hbmcheck, "prove", path, "-o", folder, "--format", "csv", "-q"]))
    if any(r["verdict"] != "proven" for r in found):
        sys.exit(f"{c['name']}: " + "; ".join(f"{r['omega']} {r['branch']} {r['reason']}" for r in found if r["verdict"] != "proven"))
    out = []
    for r in found:
        file = os.path.join(folder, r["certificate"])
        if r["period_multiple"] != "1":  # no solution of the load's period: not asked
            os.remove(file)
            continue
        with open(file, encoding="utf-8") as f:
            certificate = json.load(f)
        with open(file, "w", encoding="utf-8") as f:
            f.write("{" + ",\n".join(f"{json.dumps(k)}:{json.dumps(v, separators=(',', ':'))}" for k, v in certificate.items()) + "}\n")
        if family(certificate):
            sys.exit(f"{c['name']}: at {r['omega']} a slider never slips beside a contact that opens: history decides the amplitude")
        run([sys.executable, "-I", "-S", os.path.join(HERE, "..", "..", "proof", "check.py"), file])  # the other checker, too
        quantities = [f'"{q}": ' + ("null" if certificate["rest"] and q == "mean" else interval(certificate["claims"][q])) for q in QUANTITIES]
        out.append(f'{{"omega": {certificate["omega"]}, "stability": "{r["stability"]}", "kind": "proven", "certificate": "{r["certificate"]}",\n     '
                   + ", ".join(quantities) + "}")
    return out


def stated(hbmcheck, c, path):
    """References as JSON text: our own solutions, and as their error the larger of what half of the harmonics change and
    how far the orbit of time integration next to each is. Of smooth laws."""
    rows = []
    for harmonics in (c["harmonics"], c["harmonics"] // 2):
        dummy = [f'{{"omega": {w}, "kind": "stated", "stability": "stable", "amplitude": [1, 1], "mean": null, "a1": null, "b1": null}}' for w in c["at"]]
        write_case(c, path, dummy, harmonics)
        run([hbmcheck, "suite", HERE, "--write-results", path + ".own", "-q"], okay=(0, 1))
        with open(path + ".own", encoding="utf-8") as f:
            rows.append(json.load(f)["cases"][c["name"]])
        os.remove(path + ".own")
    orbits = rows_of(run([hbmcheck, "compare", path, "--format", "csv", "-q", "--set", f"hbm.harmonics={c['harmonics']}",
                          "--set", "transient.tolerance=1e-12"], okay=(0, 1)))
    if not len(rows[0]) == len(rows[1]) == len(orbits):
        sys.exit(f"{c['name']}: {len(rows[0])} solutions, {len(rows[1])} of half the harmonics, {len(orbits)} orbits")
    out = []
    for fine, coarse, orbit in zip(*rows, orbits):
        error = max([abs(fine[q] - coarse[q]) for q in QUANTITIES] + [float(orbit["orbit_error"]) * fine["amplitude"], 1e-12 * fine["amplitude"]])
        if not error < 1e-8 * fine["amplitude"]:
            sys.exit(f"{c['name']}: at {fine['omega']} the error is {error:.1e}")
        stability = "unstable" if orbit["verdict"] == "unstable" else "stable"
        quantities = [f'"{q}": [{fine[q] - error!r}, {fine[q] + error!r}]' for q in QUANTITIES]
        out.append(f'{{"omega": {fine["omega"]!r}, "stability": "{stability}", "kind": "stated",\n     ' + ", ".join(quantities) + "}")
    return out


def write_case(c, path, references, harmonics):
    head = {"name": c["name"], "group": c["group"], "title": c["title"], "tests": c["tests"], "goes_wrong": c["wrong"]}
    lines = [f" {json.dumps(k)}: {json.dumps(v)}" for k, v in head.items()]
    model = ",\n".join(f"  {json.dumps(k)}: {json.dumps(v)}" for k, v in model_of(c).items())
    lines += [f' "model": {{\n{model}}}', f' "response": {json.dumps(row(c, {c["response"]: 1}))}', f' "omega": {json.dumps(c["at"])}',
              f' "harmonics": {harmonics}', ' "references": [\n    ' + ",\n    ".join(references) + "]"]
    with open(path[:-5] + ".json", "w", encoding="utf-8") as f:
        f.write("{\n" + ",\n".join(lines) + "\n}\n")


def write_suite(names):
    with open(os.path.join(HERE, "suite.json"), "w", encoding="utf-8") as f:
        f.write(json.dumps({"suite": VERSION, "cases": names}, indent=1) + "\n")


def write_readme():
    """The list of cases, between the marks in README.md."""
    path, mark, end, group = os.path.join(HERE, "README.md"), "<!-- made by make.py -->\n", "<!-- end -->\n", None
    with open(path, encoding="utf-8") as f:
        before, after = f.read().split(mark)
    lines = [before + mark]
    for c in table.CASES:
        with open(os.path.join(HERE, "cases", c["name"] + ".json"), encoding="utf-8") as f:
            references = json.load(f)["references"]
        if c["group"] != group:
            group = c["group"]
            lines.append(f"\n### {group[0].upper()}{group[1:]}\n")
        unstable = sum(r["stability"] == "unstable" for r in references)
        counted = f"{len(c['mass'])}/{len(references)}" + (f"/{unstable}" if unstable else "")
        item = f"- [{c['name']}](cases/{c['name']}.json) {counted}: {c['title']}"
        lines.append(textwrap.fill(item, 120, subsequent_indent="  ", break_long_words=False, break_on_hyphens=False) + "\n")
    with open(path, "w", encoding="utf-8") as f:
        f.write("".join(lines) + end + after.split(end)[1])


def make(hbmcheck, c):
    path = os.path.join(HERE, "cases", c["name"] + ".yaml")
    with open(path, "w", encoding="utf-8") as f:
        f.write(yaml_of(c))
    if any("law" in k for k in c["contacts"]):
        write_suite([c["name"]])
    references = (stated if any("law" in k for k in c["contacts"]) else proven)(hbmcheck, c, path)
    write_case(c, path, references, c["harmonics"])
    return len(references)


def main():
    hbmcheck, names = os.path.abspath(sys.argv[1]), sys.argv[2:]
    for folder in ("cases", "certificates"):
        os.makedirs(os.path.join(HERE, folder), exist_ok=True)
    for c in table.CASES:
        if not names or c["name"] in names:
            print(c["name"], make(hbmcheck, c), flush=True)
    write_suite([c["name"] for c in table.CASES])
    write_readme()


if __name__ == "__main__":
    main()
