#!/usr/bin/env python3
"""prove.py HBMCHECK PROOF CASES - hbmcheck prove from outside: columns, words, exit codes, enclosures of known values.

Programs that answer in the place of PROOF, line by line, say what it would not say here: every reason, lies."""
import csv
import io
import json
import os
import subprocess
import sys
import tempfile
import unittest
from fractions import Fraction

HBMCHECK, PROOF, CASES = sys.argv[1:4]
CASE2 = f"{CASES}/paper/case2.yaml"
COLUMNS = ["omega", "branch", "verdict", "reason", "states", "transitions", "radius", "stability", "amplitude_low", "amplitude_high", "error_low",
           "error_high", "certificate"]

# Section 12 of the exact law's own reference: omega, letters, amplitude to the digits given, multiplier, stability.
KNOWN = [("5.3", "O S", "7.271633404548", "2.080", "unstable"), ("6", "O S", "8.053701544656", "0.8110", "stable"),
         ("8", "O S", "13.8703020105", "0.855", "stable"), ("8", "S O", "9.25373986781", "2.178", "unstable"),
         ("9", "S O", "23.7153045916317", "0.86968", "stable"), ("9", "S O", "18.0612980874387", "1.22003", "unstable"),
         ("9", "O", "2.42967633958972", "0.86968", "stable"), ("9.2", "S O", "25.9827870832", "0.94575", "stable"),
         ("9.2", "S O", "24.2695332862", "1.04251", "unstable"), ("9.2", "O", "2.23257004789", "0.872", "stable")]


def run(*arguments, proof=PROOF):
    done = subprocess.run([HBMCHECK, *arguments], capture_output=True, text=True, timeout=120, env={**os.environ, "HBMCHECK_PROOF": proof})
    return done.returncode, done.stdout, done.stderr


def prove(*arguments, proof=PROOF):
    code, out, err = run("prove", *arguments, "--format", "csv", proof=proof)
    return code, list(csv.DictReader(io.StringIO("".join(line for line in out.splitlines(True) if not line.startswith("#"))))), err


def unit(digits):
    return Fraction(1, 10 ** len(digits.partition(".")[2]))


class Prove(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = scratch.name

    def liar(self, body):
        """A program that answers each line `c` with the object that `body` makes of it."""
        path = f"{self.folder}/liar{len(os.listdir(self.folder))}"
        with open(path, "w") as to:
            to.write(f"#!{sys.executable}\nimport json, sys\nfor line in sys.stdin:\n    c = json.loads(line)\n    {body}\n    print(json.dumps(a), flush=True)\n")
        os.chmod(path, 0o755)
        return path

    def test_known_orbits_are_enclosed(self):
        code, rows, _ = prove(CASE2, "--at", "5.3,6,8,9,9.2", "--strict")
        self.assertEqual(code, 0)
        self.assertEqual(list(rows[0])[:13], COLUMNS)
        for omega, letters, amplitude, multiplier, stability in KNOWN:
            # Digits that are cut or rounded: to one unit of the last.
            near = [r for r in rows if float(r["omega"]) == float(omega) and float(r["amplitude_low"]) <= float(Fraction(amplitude) + unit(amplitude))
                    and float(r["amplitude_high"]) >= float(Fraction(amplitude) - unit(amplitude))]
            self.assertEqual(len(near), 1, (omega, amplitude))
            r = near[0]
            self.assertEqual(sorted(r["states"].split()), sorted(letters.split()))
            self.assertEqual(r["stability"], stability)
            self.assertLessEqual(abs(float(r["multiplier_low"]) - float(multiplier)), float(unit(multiplier)))
            self.assertLess(float(r["multiplier_low"]), float(r["multiplier_high"]))
            self.assertLess(float(r["amplitude_high"]) - float(r["amplitude_low"]), 1e-14 * float(amplitude))

    def test_each_solution_has_its_own_orbit(self):
        """With 5 harmonics Newton goes from the solution of branch 1 to its neighbour's orbit, four times as far as it was expected to be off."""
        _, rows, _ = prove(f"{CASES}/paper/fig09_gap_m1.yaml", "--at", "4.3308887958766968")
        self.assertEqual([r["stability"] for r in rows], ["stable", "unstable", "stable"])
        self.assertEqual(len({r["amplitude_low"] for r in rows}), 3)
        for r in rows:
            self.assertLess(abs(float(r["error_low"])), 3 * float(r["error_predicted"]))

    def test_the_error_is_enclosed(self):
        _, rows, _ = prove(CASE2, "--at", "9", "--set", "hbm.harmonics=10")
        r = max(rows, key=lambda r: float(r["amplitude_low"]))
        # Truth to 24 digits, of the reference's certificate. The difference of two doubles near 23.7, whose last digits are worth 3.6e-15: one at either
        # end of each. HBM's own rounding: 1e-14 of it.
        low, high = Fraction(r["error_low"]), Fraction(r["error_high"])
        error = Fraction(float(r["hbm_amplitude"])) - Fraction("23.71530459163172779939495")
        self.assertTrue(low <= error <= high, (float(low), float(error), float(high)))
        self.assertLess(high - low, 2e-14)
        self.assertLess(abs(error - Fraction("0.008414399173755")), 1e-12)

    def test_certificates_are_accepted_and_have_the_numbers_of_the_case(self):
        code, rows, _ = prove(CASE2, "--at", "9.10", "--set", "oscillator.damping=0.40", "--set", "contacts[0].angle_deg=44.9", "-o", f"{self.folder}/proofs")
        self.assertEqual(code, 0)
        files = sorted(r["certificate"] for r in rows)
        self.assertEqual(files, sorted(os.listdir(f"{self.folder}/proofs")))
        self.assertIn("case2_9.1_0.json", files)
        for name in files:
            path = f"{self.folder}/proofs/{name}"
            with open(path) as f:
                c = json.load(f)
            self.assertEqual((c["omega"], c["model"]["damping"], c["model"]["contacts"][0]["angle_deg"]), ("9.1", [["0.4"]], "44.9"))
            self.assertEqual(subprocess.run([PROOF, "check", path], capture_output=True, timeout=60).returncode, 0)

    def test_structures(self):
        for name, at in ("chain3", "1.2585"), ("tangent_normal_F50", "3.6"), ("jenkins2", "25.9068"):
            code, rows, err = prove(f"{CASES}/structures/{name}.yaml", "--at", at, "--strict")
            self.assertEqual((code, [r["verdict"] for r in rows]), (0, ["proven"] * len(rows)), err)
            self.assertGreater(len(rows), 0)

    def test_a_steady_state_beside_the_solutions(self):
        _, rows, err = prove(CASE2, "--at", "5.55")  # the period doubles between 5.106 and 5.570
        beside = [r for r in rows if not r["branch"]]
        self.assertEqual([(r["verdict"], r["stability"], r["period_multiple"], r["error_low"]) for r in beside], [("proven", "stable", "2", "")], err)

    def test_a_slider_at_its_limit_is_moved(self):
        code, out, err = run("prove", f"{CASES}/paper/case_a.yaml", "--at", "15.04", "--strict")
        self.assertEqual(code, 0, err)
        self.assertIn("a slider that never slips was on the verge of it", out)

    def test_a_member_of_a_family_says_so(self):
        """Beside a contact that slips and a stop one that never slips: where its slider rests, the orbit is another. Without such a slider nothing is said."""
        case = f"{self.folder}/family.yaml"
        with open(case, "w") as file:
            file.write("structure: {mass: [1], stiffness: [[40]], damping: [[0.4]]}\nforcing: [{dof: 1, amplitude: 10}]\ncontacts:\n"
                       "  - {tangential_stiffness: 20, friction: 0.5, preload: 3, tangent: {1: 1}}\n"
                       "  - {tangential_stiffness: 10, friction: 0.5, preload: 40, tangent: {1: 1}}\n"
                       "  - {normal_stiffness: 30, gap: -0.3, normal: {1: 1}}\nsweep: {omega: [5, 9]}\n")
        words = "in 1 row a slider never slips: the orbit is one of a family"
        code, rows, _ = prove(case, "--at", "6", "-o", self.folder)
        self.assertEqual((code, [(r["verdict"], r["free_sliders"]) for r in rows]), (0, [("proven", "1")]))
        self.assertIn(words, run("prove", case, "--at", "6")[1])
        self.assertIn(words, run("prove", case, "--at", "6", "--format", "json")[1])
        self.assertIn(words, run("compare", case, "--at", "6", "--prove")[1])
        # another member: the same certificate, its slider elsewhere, is proven, too, and the amplitudes exclude each other
        with open(f"{self.folder}/{rows[0]['certificate']}") as file:
            member = json.load(file)
        member["rest"]["1"] = "0.1"
        done = subprocess.run([PROOF, "complete", "-", "-o", "-"], input=json.dumps(member), capture_output=True, text=True, timeout=60)
        other = json.loads(done.stdout)
        self.assertEqual(other["verdict"], "accepted", other["reason"])
        self.assertTrue(Fraction(other["amplitude"][1]) < Fraction(rows[0]["amplitude_low"]) or Fraction(other["amplitude"][0]) > Fraction(rows[0]["amplitude_high"]))
        _, rows, _ = prove(CASE2, "--at", "9")
        self.assertEqual({r["free_sliders"] for r in rows}, {"0"})
        self.assertNotIn("family", run("prove", CASE2, "--at", "9")[1])

    def test_circle(self):
        code, rows, _ = prove(f"{CASES}/structures/plane.yaml")
        self.assertEqual((code, {(r["verdict"], r["reason"], r["certificate"]) for r in rows}), (0, {("unproven", "circle", "")}))

    def test_more_harmonics_lead_to_the_orbit(self):
        code, rows, err = prove(f"{CASES}/paper/fig09_gap_0.yaml", "--at", "3.2673654961781202", "--strict")
        self.assertEqual(code, 0, err)
        led = [r for r in rows if r["harmonics"]]
        self.assertTrue(led and all(int(r["harmonics"]) > 5 and r["branch"] for r in led), rows)  # the case has 5
        self.assertIn("from more harmonics", run("prove", f"{CASES}/paper/fig09_gap_0.yaml", "--at", "3.2673654961781202")[1])

    def scene(self, number):
        """The rows of a random scene."""
        case = f"{self.folder}/scene.yaml"
        with open(case, "w") as file:
            file.write(run("stress", "--first", number, "--case")[1])
        _, rows, err = prove(case)
        return [(r["verdict"], r["reason"]) for r in rows], err

    def test_too_few_harmonics(self):  # one harmonic, without the mean
        rows, err = self.scene("48")
        self.assertEqual(rows, [("unproven", "too few harmonics")], err)

    def test_contacts_that_close_for_an_instant(self):  # kn/k = 1e4: damped steps; t = 0 cuts through a contact
        for number in "534", "1907":
            rows, err = self.scene(number)
            self.assertEqual(set(rows), {("proven", "")}, err)

    def test_every_reason_of_the_checker(self):
        for words, contact, reason in (("segment 0, t = 0 to 1, contact 0: gap: sign not decided", 0, "graze"),
                                       ("two independent transitions at once", None, "two transitions at once"),
                                       ("edge of the cone", 0, "edge of the cone"),
                                       ("the shooting equations are singular", None, "fold"),
                                       ("Newton does not converge", None, "no orbit found"),
                                       ("existence: Krawczyk gives 3e+02 of the box", None, "out of digits")):
            liar = self.liar(f"a = {{'verdict': 'rejected', 'reason': {words!r}, 'contact': {contact!r}, 'certificate': c}}")
            code, rows, err = prove(CASE2, "--at", "8", proof=liar)
            self.assertEqual((code, {(r["verdict"], r["reason"]) for r in rows}), (0, {("unproven", reason)}))
            self.assertIn(words, err)
            self.assertEqual(prove(CASE2, "--at", "8", "--strict", proof=liar)[0], 3)
        rejected = self.liar("a = {'verdict': 'rejected', 'reason': 'segment 0, t = 0 to 6, contact 0: stick: sign not decided', 'contact': 0}")
        _, rows, _ = prove(f"{CASES}/paper/case_a.yaml", "--at", "12.5", proof=rejected)
        self.assertEqual({r["reason"] for r in rows}, {"slider at its limit"})

    def test_a_certificate_of_another_model_proves_nothing(self):
        for change in ("c['model']['mass'][0][0] = '1.0000000000000001'", "c['omega'] = '8.5'", "c['response'] = ['2']", "c['multiple'] = 2",
                       "c['model']['contacts'] = []"):
            liar = self.liar(f"{change}; a = {{'verdict': 'accepted', 'reason': None, 'certificate': c}}")
            _, rows, _ = prove(CASE2, "--at", "8", proof=liar)
            self.assertEqual({r["verdict"] for r in rows}, {"unproven"}, change)
        honest = self.liar("a = {'verdict': 'accepted', 'reason': None, 'certificate': c}")
        self.assertEqual({r["verdict"] for r in prove(CASE2, "--at", "8", proof=honest)[1]}, {"proven"})

    def test_exit_codes(self):
        for program in f"{self.folder}/nowhere", "/bin/false", self.liar("a = None; print('no JSON')"):
            code, _, err = run("prove", CASE2, "--at", "9", proof=program)
            self.assertEqual(code, 3)
            self.assertIn("hbmcheck-proof, which decides", err)
            self.assertEqual(run("compare", CASE2, "--at", "9", "--prove", proof=program)[0], 3)
            self.assertEqual(run("gate", CASE2, "--at", "9", "--set", "gate.proven=true", proof=program)[0], 3)
        self.assertEqual(run("prove", f"{self.folder}/none.yaml")[0], 2)
        self.assertEqual(run("prove", CASE2, "--at", "x")[0], 64)
        with open(f"{self.folder}/file", "w"):
            code, _, err = run("prove", CASE2, "--at", "9", "-o", f"{self.folder}/file")
        self.assertEqual(code, 3)
        self.assertIn("Not a directory", err)

    def test_compare_gate_and_json(self):
        code, out, err = run("compare", CASE2, "--at", "9", "--prove")
        self.assertEqual(code, 0, err)
        self.assertIn("3 of 3 proven", out)
        code, out, err = run("gate", CASE2, "--at", "9", "--set", "gate.proven=true", "--all")
        self.assertEqual((code, out.count(" proven ")), (0, 3), out + err)
        code, out, err = run("gate", CASE2, "--at", "9", "--set", "gate.proven=true", "--set", "gate.amplitude=3.54e-4", "--all")
        self.assertEqual(code, 1)  # 0.00841439917/23.7153 = 3.548e-4
        liar = self.liar("a = {'verdict': 'rejected', 'reason': 'edge of the cone'}")
        code, out, err = run("gate", CASE2, "--at", "9", "--set", "gate.proven=true", "--format", "csv", proof=liar)
        self.assertEqual(code, 1)
        self.assertEqual(out.count("unproven: edge of the cone"), 3)
        code, out, err = run("prove", CASE2, "--at", "9", "--format", "json")
        rows = json.loads(out)
        rows = rows["rows"] if isinstance(rows, dict) else rows
        self.assertEqual([r["verdict"] for r in rows], ["proven"] * 3)


unittest.main(argv=sys.argv[:1])
