#!/usr/bin/env python3
"""advice.py HBMCHECK CASES [long] - what compare advises was tried, and holds when it is followed; what advise says keeps the error."""
import csv
import io
import json
import re
import subprocess
import sys
import tempfile
import unittest

HBMCHECK, CASES = sys.argv[1:3]
CASE2 = f"{CASES}/paper/case2.yaml"
CHAIN3 = f"{CASES}/structures/chain3.yaml"
NO_FRICTION = ("--set", "contacts[0].friction=0", "--set", "hbm.harmonics=5")


def run(*arguments):
    done = subprocess.run([HBMCHECK, *arguments], capture_output=True, text=True, timeout=120)
    return done.returncode, done.stdout, done.stderr


def table(text): return list(csv.DictReader(io.StringIO("".join(line for line in text.splitlines(True) if line.strip() and not line.startswith("#")))))


def compare(*arguments):
    """(rows, the largest budget in words)"""
    _, out, err = run("compare", *arguments, "--format", "csv", "--quiet")
    said = re.search(r"# largest budget, .*?: (.*)", out)
    assert said, out + err
    return table(out), said.group(1)


def followed(text):
    """--set options of "use hbm.harmonics >= 9 and ..."."""
    words = text.split("; ")[-1].split(" or ")[0].replace(",", "")
    return [x for s in re.findall(r"(?:hbm|transient)\.\w+(?: >= | <= |: )\S+", words) for x in ("--set", re.sub(" >= | <= |: ", "=", s))]


class Compare(unittest.TestCase):
    def test_harmonics_are_those_that_pass(self):
        """Six harmonics, which a law H^-3 asks for, make the amplitude's error three times larger."""
        errors = {}
        for h in (5, 6, 8, 9):
            rows, said = compare(CASE2, "--at", "6", *NO_FRICTION, "--set", f"hbm.harmonics={h}")
            errors[h] = float(rows[0]["amplitude_error"])
            self.assertEqual(rows[0]["verdict"], "match" if h == 9 else "differs")
            if h < 9: self.assertTrue(said.endswith("%: truncation (100 %); use hbm.harmonics >= 9"), said)
        self.assertGreater(errors[6], 3 * errors[5])

    def test_what_is_beyond_its_limit_is_named(self):
        """At H = 5 the amplitude is within its limit, harmonic 1 and the waveform are not."""
        rows, said = compare(CASE2, "--at", "6", *NO_FRICTION)
        self.assertLess(float(rows[0]["amplitude_error"]), 1e-3)
        self.assertTrue(said.startswith("harmonic_1 0.38 %: truncation (100 %)"), said)
        rows, said = compare(CASE2, "--at", "6", *NO_FRICTION, "--set", "gate.harmonic_1=0.1", "--set", "gate.mean=0.1")
        self.assertEqual(rows[0]["verdict"], "differs")
        self.assertTrue(said.startswith("waveform 1.3 %: truncation (100 %); use hbm.harmonics >= "), said)
        self.assertEqual(compare(CASE2, "--at", "6", *NO_FRICTION, *followed(said))[0][0]["verdict"], "match")

    def test_a_family_is_called_one(self):
        for law in ("regularised", "exact"):
            start = (CHAIN3, "--at", "1.5", "--set", "transient.start=rest", "--set", f"transient.law={law}")
            _, said = compare(*start)
            self.assertRegex(said, r"^harmonic_1 1\.3 %: family \(\d+ %\); use .*transient\.start: hbm")
            self.assertNotIn("regularisation", said)
            rows, _ = compare(*start, *followed(said))
            self.assertEqual({r["verdict"] for r in rows if r["response"] == "1"}, {"family"})

    def test_samples_and_exact_forces(self):
        sampled = (CASE2, "--at", "6", "--set", "hbm.force=sampled", "--set", "hbm.samples=32")
        _, said = compare(*sampled)
        self.assertIn("use hbm.force: exact or hbm.samples >= ", said)
        samples = re.search(r"samples >= (\d+)", said).group(1)
        for cure in ("hbm.force=exact", "hbm.samples=" + samples):
            self.assertIn("within the gate", compare(*sampled, "--set", cure)[1])

    def test_nothing_helps_is_said(self):
        _, said = compare(CASE2, "--at", "6", "--set", "gate.amplitude=1e-13")
        self.assertIn("; nothing within 200 harmonics, exact forces, the exact law and transient.tolerance >= 1e-10 passes", said)


    def long_what_helps_is_found_where_newton_from_the_solution_does_not_lead(self):
        """A curve of 30 harmonics, of 71, and forces before transients that take all of the time."""
        for scene, words, *sets in (
                (900785, "use hbm.force: exact and hbm.harmonics >= 30", "hbm.harmonics=1", "hbm.force=sampled", "hbm.samples=64"),
                (903323, "use hbm.force: exact and hbm.harmonics >= 71", "hbm.harmonics=5", "hbm.force=sampled", "hbm.samples=128",
                 "sweep.omega=[4.7, 5.2]")):  # another solution than from 5 on
            _, text, _ = run("stress", "--case", "--first", str(scene), "--structures")
            with tempfile.NamedTemporaryFile("w", suffix=".yaml") as case:
                case.write(text)
                case.flush()
                start = [case.name, "--set", "transient.law=exact", *(x for s in sets for x in ("--set", s))]
                rows, said = compare(*start)
                self.assertIn(rows[0]["verdict"], ("differs", "period_2"))
                self.assertIn(words, said)
                rows, said = compare(*start, *followed(said))
                self.assertIn("within the gate", said)


class Advise(unittest.TestCase):
    def long_the_error_is_kept_and_the_next_smaller_breaks_it(self):
        code, out, err = run("advise", CASE2, "--error", "1e-3", "--format", "csv")
        self.assertEqual(code, 0, err)
        rows = table(out.split("\n\n")[0])
        self.assertEqual([r["force"] for r in rows], ["exact", "sampled"])
        at = ",".join(str(3 + 17 * k / 50) for k in range(51)) + ",9.197,9.198"  # next to the fold at 9.2096
        for r in rows:
            worst = []
            smaller = dict(zip(("harmonics", "samples"), re.findall(r"= (\d+)", r["next_smaller"])))
            for sets in ({"harmonics": r["harmonics"], **({"samples": r["samples"]} if r["samples"] else {})}, smaller):
                found, _ = compare(CASE2, "--at", at, "--set", "hbm.force=" + r["force"], "--set", "transient.law=exact", "--set",
                                   "transient.method=closed_form", *(x for n, v in sets.items() for x in ("--set", f"hbm.{n}={v}")))
                worst.append(max(float(f[q + "_error"]) for f in found if f["verdict"] in ("match", "differs")
                                 for q in ("amplitude", "harmonic_1", "mean", "waveform") if f[q + "_error"]))
            self.assertLessEqual(worst[0], 1e-3, r)
            self.assertGreater(min(worst[1], float(r["next_smaller_error"])), 1e-3, r)

    def test_without_harmonic_0_no_number_suffices(self):
        _, out, _ = run("advise", CASE2, "--at", "8,9", "--without-static", "--format", "json")
        rows = json.loads(out)["Sufficient settings"]
        self.assertEqual([r["static"] for r in rows], ["yes", "yes", "no", "no"])
        self.assertTrue(all(r["harmonics"] is None for r in rows[2:]), rows)

    def test_a_contact_that_never_slips_is_linear(self):
        _, out, _ = run("advise", CASE2, "--at", "8", "--set", "contacts[0].friction=100", "--set", "contacts[0].gap=1000")
        self.assertIn("1 of them linear", out)
        self.assertIn("one harmonic is as good as many", out)

    def test_of_solutions_that_are_not_known_nothing_is_said(self):
        """Harmonic balance of 200 harmonics has an error above 1e-4 itself; one harmonic was said to have none."""
        code, scene, err = run("stress", "--case", "--first", "800156")
        with tempfile.NamedTemporaryFile("w", suffix=".yaml") as case:
            case.write(scene)
            case.flush()
            code, out, err = run("advise", case.name, "--error", "1e-4", "--at", "400,500", "--format", "csv")
        self.assertEqual((code, [r["harmonics"] for r in table(out.split("\n\n")[0])]), (3, ["", ""]), out + err)
        self.assertIn("2 solutions left out", out)

    def test_no_fewer_harmonics_than_the_loads_have(self):
        """A contact that never closes: any number would do, but for the load of harmonic 4."""
        with tempfile.NamedTemporaryFile("w", suffix=".yaml") as case:
            case.write("structure: {mass: [1], stiffness: [[1]], damping: [[0.1]]}\n"
                       "forcing: [{dof: 1, amplitude: 1}, {dof: 1, amplitude: 1, harmonic: 4}]\n"
                       "contacts: [{normal_stiffness: 1, gap: -100, normal: 1}]\nsweep: {omega: [2, 3]}\n")
            case.flush()
            code, out, err = run("advise", case.name, "--at", "2", "--format", "csv")
        self.assertEqual(code, 0, err)
        self.assertEqual([r["harmonics"] for r in table(out.split("\n\n")[0])], ["4", "4"])

    def test_other_programs_and_wrong_usage(self):
        _, out, _ = run("advise", f"{CASES}/paper/case_a.yaml")
        self.assertRegex(out, r"NLvib +H = 6; N = \d+")
        self.assertRegex(out, r"tmdsimpy +h = np.arange\(6 \+ 1\), Nt = \d+")
        self.assertEqual(run("advise", CASE2, "--error", "0")[0], 64)
        self.assertEqual(run("advise", CASE2, "--set", "contacts[0].friction=-1")[0], 2)


loader = unittest.TestLoader()
if sys.argv[3:] == ["long"]: loader.testMethodPrefix = "long"
unittest.main(argv=sys.argv[:1], testLoader=loader)
