#!/usr/bin/env python3
"""The suite: what its files say against its certificates, results of all kinds, wrong programs.

    test_suite.py HBMCHECK HBMCHECK_PROOF WHAT      WHAT: files, family, check (slow: all by check.py), archive, own, results, references, wrong
"""
import csv
import glob
import io
import json
import math
import os
import pathlib
import re
import subprocess
import sys
import tempfile
from fractions import Fraction

ROOT = pathlib.Path(__file__).resolve().parents[2]
SUITE = ROOT / "compare" / "suite"
HBMCHECK, PROOF = sys.argv[1], sys.argv[2]
VERSION, NAMES = (json.loads((SUITE / "suite.json").read_text())[key] for key in ("suite", "cases"))
# Numbers as they stand in the files, exactly.
CASES = {n: json.loads((SUITE / "cases" / f"{n}.json").read_text(), parse_float=Fraction, parse_int=Fraction) for n in NAMES}
FULL = {n: json.loads((SUITE / "cases" / f"{n}.json").read_text()) for n in NAMES}
QUANTITIES = ("amplitude", "mean", "a1", "b1")
failures = 0


def check(true, words):
    global failures
    if not true:
        failures += 1
        print("FAILED:", words)


def suite(*arguments, expect):
    done = subprocess.run([HBMCHECK, "suite", str(SUITE), *arguments, "--format", "csv"], capture_output=True, text=True)
    check(done.returncode == expect, f"suite {' '.join(arguments)}: exit {done.returncode}, expected {expect}: {done.stderr}")
    rows = list(csv.DictReader(io.StringIO("\n".join(x for x in done.stdout.splitlines() if not x.startswith("#")))))
    return {(r["case"], r["program"]): r for r in rows}, done.stdout + done.stderr


# ---- files ---------------------------------------------------------------------------------------------------------------------
def rows_of(matrix):
    return [[Fraction(x) for x in row] for row in matrix]


def contact_of(c):
    return {k: [Fraction(x) for x in v] if isinstance(v, list) else Fraction(v) for k, v in c.items()}


def files():
    """Each reference contains its certificate's claims and is hardly wider; the certificate's model, omega and response are the case's."""
    used = set()
    for name, case in CASES.items():
        smooth = any("law" in c for c in case["model"]["contacts"])
        for r in case["references"]:
            check((r["kind"] == "stated") == smooth, f"{name}: kind")
            if smooth:
                continue
            file = SUITE / "certificates" / r["certificate"]
            used.add(file.name)
            certificate = json.loads(file.read_text())
            model, where = certificate["model"], f"{name} at {float(r['omega'])}"
            for key in ("mass", "damping", "stiffness"):
                check(rows_of(model[key]) == rows_of(case["model"][key]), f"{where}: {key}")
            loads = [(x["harmonic"], [Fraction(v) for v in x["cos"]], [Fraction(v) for v in x["sin"]]) for x in model["forcing"]]
            check(sorted(loads) == [(x["harmonic"], x["cos"], x["sin"]) for x in case["model"]["loads"]], f"{where}: loads")
            check([contact_of(c) for c in model["contacts"]] == case["model"]["contacts"], f"{where}: contacts")
            check(Fraction(certificate["omega"]) == r["omega"] and certificate["multiple"] == 1, f"{where}: omega")
            check([Fraction(v) for v in certificate["response"]] == case["response"], f"{where}: response")
            check(certificate["claims"]["stability"] == r["stability"], f"{where}: stability")
            check(not certificate["rest"] or not any("normal" in c or "law" in c for c in model["contacts"]),
                  f"{where}: a slider that never slips beside a contact that opens: one solution of a family, its amplitude is open")
            for q in QUANTITIES:
                check((r[q] is None) == (q == "mean" and certificate["rest"] != {}), f"{where}: {q} is asked, but history decides it, or the reverse")
                if r[q] is None:
                    continue
                low, high = (Fraction(x) for x in certificate["claims"][q])
                check(r[q][0] <= low and high <= r[q][1] and r[q][1] - r[q][0] <= high - low + abs(high) * Fraction(2, 10**15), f"{where}: {q}")
    check(used == {p.name for p in (SUITE / "certificates").iterdir()}, "certificates that no case has, or the other way")
    done = subprocess.run([PROOF, "check", *sorted(glob.glob(str(SUITE / "certificates" / "*.json")))], capture_output=True, text=True)
    check(done.returncode == 0 and done.stdout.count(": accepted") == len(used), "hbmcheck-proof does not accept all: " + done.stdout[-300:])
    told = (SUITE / "README.md").read_text().split("## Why digits are missing")[1].split("## Cases")[0].split("Version of")[0]
    words = set(re.findall(r"`(\w+)`", told)) - {"cause"}
    known = (ROOT / "docs" / "verify.md").read_text() + (SUITE / "score.c").read_text()
    check(len(words) > 20 and all(re.search(rf"[`\"]{w}[`\"]", known) for w in words), f"causes that nobody tells: {[w for w in words if w not in known]}")
    sample = ["jenkins_7_0.json", "foot_6_0.json", "fold_7.6_1.json"]
    check_py(sample)


def check_py(names):
    paths = [str(SUITE / "certificates" / n) for n in names]
    done = subprocess.run([sys.executable, "-I", "-S", str(ROOT / "proof" / "check.py"), *paths], capture_output=True, text=True)
    check(done.returncode == 0 and done.stdout.count(": accepted") == len(names), "check.py does not accept all: " + done.stdout[-300:])


def family():
    """make.py refuses a reference of a family: a slider that never slips beside a stop or a slanted contact that opens.
    Beside a slider that slips it makes one, whose mean is not asked."""
    sys.path.insert(0, str(SUITE))
    import make, table
    stuck, slips = table.jenkins(60, 1000), table.jenkins(50, 5)
    with tempfile.TemporaryDirectory() as folder:
        make.HERE = f"{folder}/compare/suite"
        for name in ("cases", "certificates"):
            os.makedirs(f"{folder}/compare/suite/{name}")
        os.symlink(ROOT / "proof", f"{folder}/proof")
        for name, contacts, refused in (("stop", [stuck, table.stop(50, 0)], True), ("foot", [stuck, table.foot(40, 60, 0.3, 0.3)], True), ("slider", [stuck, slips], False)):
            table.one("test", name, "title", "tests", "wrong", [9], contacts, harmonics=20)
            try:
                made, said = make.make(HBMCHECK, table.CASES[-1]), ""
            except SystemExit as stopped:
                made, said = 0, str(stopped)
            check(made == (not refused) and ("history decides the amplitude" in said) == refused, f"{name}: {made} references; {said}")
        case = json.loads(pathlib.Path(folder, "compare", "suite", "cases", "slider.json").read_text())
        check(case["references"][0]["mean"] is None and case["references"][0]["amplitude"], "slider beside slider: the mean alone is not asked")


def check_all():
    check_py(sorted(os.listdir(SUITE / "certificates")))


def archive():
    """The archive's bytes do not depend on when and by whom; its check.py decides its certificates with Python alone."""
    with tempfile.TemporaryDirectory() as folder:
        for name, umask in (("a", 0o22), ("b", 0o77)):
            subprocess.run([sys.executable, SUITE / "archive.py", f"{folder}/{name}"], check=True, umask=umask)
        check(pathlib.Path(folder, "a").read_bytes() == pathlib.Path(folder, "b").read_bytes(), "the archive differs from itself")
        subprocess.run(["tar", "xzf", "a"], cwd=folder, check=True)
        inside = pathlib.Path(folder, f"hbmcheck-suite-{VERSION}")
        done = subprocess.run([sys.executable, "-I", "-S", "check.py", "certificates/jenkins_7_0.json"], cwd=inside, capture_output=True, text=True)
        check(": accepted" in done.stdout and len(list((inside / "cases").iterdir())) == 2 * len(NAMES), "what is in the archive: " + done.stderr)
        check(f'version: "{VERSION}"' in (inside / "CITATION.cff").read_text(), "CITATION.cff has the suite's version")


# ---- our own --------------------------------------------------------------------------------------------------------------------
def own():
    """Exact: 9 digits everywhere, or the reference's. Sampled: the interval of a contact is off by up to a sample, and a force that is
    continuous by its square, (2 pi/1024)^2, 4.4 digits; a fold may take one. And our own results, written and read again, score the same."""
    with tempfile.TemporaryDirectory() as folder:
        file = f"{folder}/own.json"
        rows, _ = suite("--write-results", file, expect=0)
        again, _ = suite("--results", file, "--program", "exact", "--digits", "8.9", expect=0)
        for name in NAMES:
            exact, sampled = rows[name, "exact"], rows[name, "sampled"]
            known = 9 if CASES[name]["references"][0]["kind"] == "proven" else 8
            check(float(exact["digits"]) >= known and exact["missing"] == "0", f"{name}: exact has {exact['digits']} digits")
            floor = -2 * math.log10(2 * math.pi / 1024) - (FULL[name]["group"] == "several solutions")
            check(floor <= float(sampled["digits"]) <= float(exact["digits"]) + 0.5, f"{name}: sampled has {sampled['digits']}")
            check(again[name, "exact"]["digits"] == exact["digits"], f"{name}: written and read again")


# ---- results of all kinds ---------------------------------------------------------------------------------------------------------
def middle(r, q):
    return None if r[q] is None else 0.5 * (r[q][0] + r[q][1])


def true_rows(name):
    return [{"omega": r["omega"], **{q: middle(r, q) for q in QUANTITIES}} for r in FULL[name]["references"]]


def write_csv(folder, name, rows, columns=("omega", *QUANTITIES), head=None):
    text = ",".join(head or columns) + "\n" + "".join(",".join("" if r.get(c) is None else repr(r[c]) for c in columns) + "\n" for r in rows)
    pathlib.Path(folder, f"{name}.csv").write_text(text)


def results():
    truth = {n: true_rows(n) for n in NAMES}
    with tempfile.TemporaryDirectory() as folder:
        def score(name, text=None, rows=None, expect=1, **how):
            for old in glob.glob(folder + "/*"):
                os.remove(old)
            if text is not None:
                pathlib.Path(folder, f"{name}.csv").write_text(text)
            else:
                write_csv(folder, name, rows, **how)
            found, said = suite("--results", folder, "--program", "p", expect=expect)
            return found[name, "p"], said

        for name in NAMES:
            write_csv(folder, name, [{**r, "extra": "converged"} for r in reversed(truth[name])], columns=("b1", "extra", "amplitude", "omega", "mean", "a1"))
        rows, said = suite("--results", folder, "--program", "p", expect=0)
        check(all(float(r["score"]) > 99.999 for r in rows.values()), "the truth in another order, with a column more: all points")
        check("fold.csv:1:4: column `extra` is left out" in said, "the column that is left out is told by name")

        fold = truth["fold"]
        row, _ = score("fold", rows=[r for i, r in enumerate(fold) if i % 3 != 1])
        check(row["missing"] == "3" and abs(float(row["score"]) - 200 / 3) < 1e-6, "two of three branches: a third of the points is missing")
        check(row["cause"] == "missing_solutions", "missing solutions are told")
        row, _ = score("fold", rows=fold + fold + [{**fold[0], "omega": 123.0}])
        check(row["missing"] == "0" and row["extra"] == "9" and row["result"] == "pass", "every solution twice, and another frequency: nothing lost")
        foot = truth["foot"]
        row, _ = score("foot", rows=[{**r, "mean": None} for r in foot], columns=("omega", "amplitude", "a1", "b1"))
        check(row["quantity"] == "mean" and abs(float(row["score"]) - 75) < 1e-6, "a column that is missing: its points")
        row, said = score("foot", rows=[{**r, "amplitude": float("nan")} if i == 1 else r for i, r in enumerate(foot)])
        still, _ = score("two_sided", rows=[{**r, "mean": float("nan")} for r in truth["two_sided"]])
        check(abs(float(still["score"]) - 75) < 1e-6, f"nan is no mean of 0: {still['score']}")
        check("foot.csv:3:5: `nan` counts as missing" in said and 95 < float(row["score"]) < 96, "nan counts as missing and is named")
        row, said = score("foot", rows=[{**r, "omega": r["omega"] / (2 * 3.141592653589793)} for r in foot], expect=2)
        check(row["result"] == "refused" and "foot.csv: omega 0.7957747155 is in cycles" in said, "cycles are refused by name")
        row, said = score("foot", rows=[{**r, "omega": r["omega"] * 60 / (2 * 3.141592653589793)} for r in foot], expect=2)
        check(row["result"] == "refused" and "is in revolutions per minute, expected 5 rad per time" in said, "revolutions per minute, too")
        row, said = score("foot", rows=[{**r, "omega": r["omega"] * 7} for r in foot])
        check("foot.csv: no row is at an omega of the case, such as 5" in said and row["missing"] == "6" and not row["cause"], "omegas of nothing")
        row, said = score("foot", rows=[{**r, "omega": r["omega"] * (1 + 1e-6)} for r in foot])
        check("foot.csv: omega 5.000005 is next to one" in said and row["missing"] == "6", "omegas with 6 digits")
        row, said = score("foot", rows=[{q: r[q] * (1 if q == "omega" else 1000) for q in r} for r in foot])
        check(row["cause"] and row["score"] == "0", f"millimetres for metres: no points and a cause, {row['cause']}")
        row, said = score("foot", rows=[{**r, "b1": -r["b1"]} for r in foot])
        check(row["cause"] == "sign_of_b1", f"the sign of b1: {row['cause']}")
        row, said = score("foot", rows=foot, columns=("omega", "amplitude", "mean", "a1"))
        check(row["cause"] == "harmonic_1_alone" and abs(float(row["score"]) - 75) < 1e-6, f"b1 is missing, not its sign: {row['cause']}")
        for factor, cause in ((2, "peak_to_peak"), (-1, "amplitude_alone"), (0.7, "amplitude_alone")):
            row, said = score("fold", rows=[{**r, "amplitude": factor * r["amplitude"]} for r in reversed(fold)])
            check(row["cause"] == cause and abs(float(row["score"]) - 75) < 4, f"amplitude times {factor}: {row['cause']}, {row['score']}")
        row, said = score("fold", rows=fold, columns=("omega", "mean", "a1", "b1"))
        check(row["cause"] == "amplitude_alone" and row["missing"] == "0" and abs(float(row["score"]) - 75) < 1e-6, "no amplitudes")
        row, said = score("foot", rows=[{**r, "mean": 0.0} for r in foot])
        check(row["cause"] == "mean_alone" and 75 <= float(row["score"]) < 85, f"means of 0: {row['cause']}, {row['score']}")
        for text, where in (("omega,amplitude\n5;1\n", ":2:1: `5;1` is not a number"), ("omega,amplitude\n5\n", ":2:1: 1 fields, expected 2"), ("omega,amplitude\n5,1,2\n", ":2:5: more than 2 fields"),
                            ("omega,amplitude\n5,x\n", ":2:3: `x` is not a number"), ("w,amplitude\n5,1\n", ":1:1: no column omega"),
                            ("omega,omega,mean\n", ":1:7: a second column `omega`"), ("", ":1:1: empty")):
            row, said = score("foot", text=text, expect=2)
            check(row["result"] == "refused" and "foot.csv" + where in said and row["score"] == "0", f"{text!r}: {where}")
        row, said = score("foot", rows=[{**r, "omega": float("nan")} if i == 1 else r for i, r in enumerate(foot)])
        check(row["missing"] == "1" and row["cause"] == "missing_solutions", "an omega that is none is a row of no solution")
        row, said = score("foot", text="\ufeff# remark\r\nomega , amplitude\r\n 5 , 1e-1\r\n")
        check(row["result"] == "fail" and row["missing"] == "5", "a byte order mark, remarks and CRLF are read")
        shown = [subprocess.run([HBMCHECK, "suite", str(SUITE), "--results", folder, *more], capture_output=True, text=True).stdout for more in ([], ["--all"])]
        check([text.count("no results") for text in shown] == [0, len(NAMES) - 1] and "foot " in shown[0], "the table leaves out cases without results, but for --all")
        check(f"{len(NAMES) - 1} cases without results count as 0" in shown[0], "it says how many")
        pathlib.Path(folder, "feet.csv").write_text("omega,mean\n5,1\n")
        check("feet.csv: the suite has no such case" in suite("--results", folder, expect=1)[1], "a case that there is not")
        os.remove(folder + "/foot.csv")
        check(": no results, expected files such as open.csv" in suite("--results", folder, expect=2)[1], "no file that a case has")

        file = pathlib.Path(folder, "all.json")
        file.write_text(json.dumps({"cases": truth}))
        check(all(float(r["score"]) > 99.999 for r in suite("--results", str(file), expect=0)[0].values()), "the truth as json: all points")
        for text, where in (('{"cases": {"foot": [\n {"omega": NaN}]}}', ":2:14"), ('{"rows": 1}', "no object `cases`"), ("{", ":1:1")):
            file.write_text(text)
            said = subprocess.run([HBMCHECK, "suite", str(SUITE), "--results", str(file)], capture_output=True, text=True)
            check(said.returncode == 2 and where in said.stderr, f"{text!r}: {said.stderr}")
        file.write_text('{"cases": {"foot": [{"omega": "5"}], "fold": {}, "tip": [{"mean": 1}], "none": []}}')
        found, said = suite("--results", str(file), "--program", "p", expect=2)
        for words in ("cases.foot[0].omega: a number or null was expected", "cases.fold: a list was expected", "cases.tip[0]: no omega", "no case `none`"):
            check(words in said, words)
        file.write_text(json.dumps({"cases": {"foot": [{"omega": r["omega"] / 6.283185307179586, "mean": 1, "phase": 0} for r in foot],
                                              "fold": [{"omega": 7.3, "mean": 0}] * 10001}}))
        found, said = suite("--results", str(file), "--program", "p", expect=2)
        for words in ("all.json: cases.foot: omega 0.7957747155 is in cycles", "cases.foot[0].`phase` is left out", "all.json: cases.fold: more than 10000 rows"):
            check(words in said, words)

        file.write_text(json.dumps({"cases": truth}))
        page, badge, junit = (f"{folder}/out.{x}" for x in ("html", "svg", "xml"))
        done = subprocess.run([HBMCHECK, "suite", str(SUITE), "--results", str(file), "--program", "<p>", "-o", page, "--badge", badge, "--junit", junit, "--digits", "8"],
                              capture_output=True, text=True)
        check(done.returncode == 0 and f"{len(NAMES)} of {len(NAMES)} cases" in done.stdout, "page, badge and JUnit")
        html = pathlib.Path(page).read_text()
        check("&lt;p&gt;" in html and "<p>:" not in html and html.count("<rect") == 2 * len(NAMES), "the page: its program escaped, two bars a case")
        check(f"{len(NAMES)} of {len(NAMES)}, score 100.0" in pathlib.Path(badge).read_text(), "the badge")
        check(f'tests="{len(NAMES)}" failures="0"' in pathlib.Path(junit).read_text(), "JUnit")
        strict, _ = suite("--results", str(file), "--junit", junit, "--digits", "12", expect=1)
        few = sum(r["result"] != "pass" for r in strict.values())
        check(0 < few < len(NAMES) and f'failures="{few}"' in pathlib.Path(junit).read_text(), "JUnit: the digits asked")
        asked = [r[q] for n in NAMES for r in FULL[n]["references"] for q in QUANTITIES if r[q]]
        check(suite("--results", str(file), "--all", expect=0)[1].count(",proven,") + suite("--results", str(file), "--all", expect=0)[1].count(",stated,")
              == len(asked), "--all: every quantity that is asked")


def references():
    """A suite of one case: a reference of 6 digits gives all points to 6; what is wrong in a file of the suite is told by name."""
    case = json.loads((SUITE / "cases" / "foot.json").read_text())
    with tempfile.TemporaryDirectory() as folder:
        def score(expect):
            (pathlib.Path(folder) / "cases" / "foot.json").write_text(json.dumps(case))
            done = subprocess.run([HBMCHECK, "suite", folder, "--results", f"{folder}/foot.json", "--program", "p", "--format", "csv"], capture_output=True, text=True)
            check(done.returncode == expect, f"suite of one case: exit {done.returncode}, expected {expect}: {done.stderr}")
            return [x for x in done.stdout.splitlines() if x.startswith("foot,")][0].split(",") if expect < 2 else done.stderr

        (pathlib.Path(folder) / "cases").mkdir()
        pathlib.Path(folder, "suite.json").write_text('{"suite": "0", "cases": ["foot"]}')
        pathlib.Path(folder, "foot.json").write_text(json.dumps({"cases": {"foot": true_rows("foot")}}))
        for r in case["references"]:
            for q in QUANTITIES:
                half = 1e-6 * r["amplitude"][0]
                r[q] = [middle(r, q) - half, middle(r, q) + half]
        row = score(0)
        check(row[0] == "foot" and abs(float(row[5]) - 6) < 1e-3 and abs(float(row[9]) - 100) < 1e-6, f"a reference of 6 digits: {row}")
        del case["references"][1]["omega"]
        check("foot.json: references[1] is wrong" in score(2), "a reference without omega")
        case["references"] = []
        check("references are missing" in score(2), "no references")


# ---- wrong programs -----------------------------------------------------------------------------------------------------------------
def wrong():
    """The program of sixty lines, and three mistakes in it, each on some cases."""
    try:
        import sixty_lines as program
    except ImportError as missing:
        print("SKIPPED:", missing)
        sys.exit(77)
    mistakes = {"SAMPLES": (64, "too_few_samples", ["jenkins", "clearance", "foot_pressed", "tangent_normal"]),
                "SIGN": (-1.0, "friction_sign", ["foot", "jenkins_mean", "tangent_normal", "normal_side"]),
                "STATIC": (False, "no_static_harmonic", ["clearance", "lifting", "foot", "foot_pull"])}

    def score(names, digits, expect):
        with tempfile.TemporaryDirectory() as folder:
            program.main(SUITE, pathlib.Path(folder), names)
            rows, said = suite("--results", folder, "--program", "p", "--digits", digits, expect=expect)
        return {n: rows[n, "p"] for n in names}, [x for x in said.splitlines() if "what is wrong" in x]

    program.SAMPLES = 128
    right, _ = score(sorted({n for _, _, names in mistakes.values() for n in names}), "3", 1)
    check(all(r["result"] == "pass" for r in right.values()), f"the right program passes: {[(n, r['digits']) for n, r in right.items()]}")
    for mistake, (value, cause, names) in mistakes.items():
        was = getattr(program, mistake)
        setattr(program, mistake, value)
        rows, why = score(names, "4", 1)
        setattr(program, mistake, was)
        mean, before = (sum(float(x[n]["score"]) for n in names) / len(names) for x in (rows, right))
        print(f"{mistake}: score {before:.1f} -> {mean:.1f}", *why)
        check(any(f"what is wrong: {cause} " in x for x in why), f"{mistake}: {cause} expected, told {why}")
        if cause == "friction_sign":
            check(all(r["cause"] == cause for r in rows.values()), f"it is told of each case, {[(n, r['cause']) for n, r in rows.items()]}")
        check(mean < before - 5, f"{mistake}: {mean:.1f} is not visibly below {before:.1f}")


{"files": files, "family": family, "check": check_all, "archive": archive, "own": own, "results": results, "references": references, "wrong": wrong}[sys.argv[3]]()
sys.exit(failures > 0)
