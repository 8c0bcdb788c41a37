#!/usr/bin/env python3
"""Polynomial springs, tables and tanh friction, from the case file to the verdict.

    laws.py HBMCHECK ROOT [long]        long: verify names what is wrong with them, nothing else

Both sides meet; what is a table is what it stands for; what is wrong is refused with its place."""
import csv
import math
import os
import re
import subprocess
import sys
import tempfile

HBMCHECK, ROOT = sys.argv[1:3]
LONG = sys.argv[3:] == ["long"]
FOLDER = tempfile.mkdtemp()
DUFFING = """title: Duffing
oscillator: {mass: 1, damping: 0.05, stiffness: 1}
forcing: {amplitude: 0.05}
contacts:
  - {law: polynomial, coefficients: {3: 3}}
sweep: {omega: [0.5, 2.0]}
hbm: {harmonics: 15}
"""
MIXED = """title: mixed laws
structure: {mass: [1, 0.5, 0.2], stiffness: [[3, -1, 0], [-1, 2, -1], [0, -1, 1.5]], damping: {rayleigh: [0.02, 0.01]}}
forcing: [{dof: 1, amplitude: 1}, {dof: 3, amplitude: 0.2, harmonic: 2, phase_deg: 30}]
contacts:
  - {name: cubic, law: polynomial, direction: {1: 1, 2: -1}, coefficients: {3: 0.5, 2: 0.1}}
  - {tangential_stiffness: 2, friction: 0.3, preload: 1, tangent: {3: 1}}
  - {name: stop, law: table, direction: {2: 1}, points: [[-2, -1], [0, 0], [0.3, 0.1], [1, 3]]}
  - {law: tanh, friction: 0.2, normal_stiffness: 2, gap: 0.4, epsilon: 0.2, tangent: {1: 1}, normal: {3: 1}}
sweep: {omega: [0.8, 2.0]}
hbm: {harmonics: 15}
"""
GAP = """oscillator: {mass: 1, damping: 0.1, stiffness: 1}
forcing: {amplitude: 1}
contacts:
  - CONTACT
sweep: {omega: [0.5, 3.0]}
hbm: {harmonics: 15}
"""


def write(text, name="case.yaml"):
    path = os.path.join(FOLDER, name)
    with open(path, "w", encoding="ascii") as f:
        f.write(text)
    return path


def run(*words, code=0):
    p = subprocess.run([HBMCHECK, *words], capture_output=True, text=True, check=False)
    assert p.returncode == code, f"{words} gave {p.returncode}: {p.stdout[-400:]} {p.stderr[-400:]}"
    return p


def rows(*words, code=0):
    text = run(*words, "--wide", "--format", "csv", code=code).stdout
    return list(csv.DictReader(line for line in text.splitlines() if line and line[0] != "#"))


def near(a, b, tolerance, what):
    assert abs(float(a) - float(b)) <= tolerance, f"{what}: {a}, {b}"


def duffing_meets_time_integration():
    """H = 15 leaves less than 1e-9 of the amplitude (harmonic 17 of a cubic spring at these amplitudes), and time
    integration is within its tolerance of 1e-9; multipliers of the regularised law's variational equations, and of the
    exact law's differences, which are good to 1e-7."""
    case = write(DUFFING)
    for law in ("regularised", "exact"):
        found = rows("compare", case, "--at", "0.8,1.2,1.4", "--set", f"transient.law={law}")
        matches = [r for r in found if r["verdict"] == "match"]
        assert len(found) == 7 and len(matches) == 5 and all(r["verdict"] in ("match", "unstable") for r in found)
        for r in matches:
            assert float(r["amplitude_error"]) < 1e-9, r
        balance = rows("frf", case, "--at", "1.2")
        for k, r in enumerate(rows("transient", case, "--at", "1.2", "--set", f"transient.law={law}")):
            if balance[k]["stable"] == "yes":
                near(r["multiplier"], balance[k]["multiplier"], 2e-7, law)
                assert r["contact"] == balance[k]["contact"] == "smooth"


def mixed_laws_meet():
    """To what 15 harmonics leave of kinks; three times as many leave some 3^-3 of that."""
    case = write(MIXED)
    errors = []
    for harmonics, laws in ((15, ("regularised", "exact")), (45, ("exact",))):
        for law in laws:
            found = rows("compare", case, "--at", "1.5", "--set", f"hbm.harmonics={harmonics}", "--set",
                         f"transient.law={law}")
            assert [r["verdict"] for r in found] == ["match"], found
        errors.append(max(float(r["amplitude_error"]) for r in found))
    assert errors[0] < 1e-3 and errors[1] < errors[0] / 9, errors
    echoed = run("describe", "--case", case).stdout
    assert "[[-2, -1], [0, 0], [0.3, 0.1], [1, 3]]" in echoed and "contacts[0].coefficients.3" in echoed
    prove = rows("prove", case, "--at", "0.9")
    assert prove[0]["verdict"] == "unproven" and prove[0]["reason"] == "smooth law"


def a_table_is_what_it_stands_for():
    """Two points are a spring, three a gap: the same equations but for the rounding of slopes."""
    gap = "{tangential_stiffness: 0, normal_stiffness: 4, friction: 0, angle_deg: 90, gap: -0.5}"
    pairs = (("{law: table, points: [[-1, 0], [0.5, 0], [1.5, 4]]}", gap, "1"),
             ("{law: table, points: [[-1, -3], [1, 3]]}", "", "4"),
             ("{law: table, points: [[-3, -1], [-0.5, 0], [1.5, 0]]}", None, "1"))
    for table, other, stiffness in pairs:
        one = write(GAP.replace("CONTACT", table))
        if other is None:  # mirrored: what it does to cos(omega t) the other does half a period later
            other = "{law: table, points: [[-1.5, 0], [0.5, 0], [3, 1]]}"
        text = GAP.replace("CONTACT", other) if other else GAP.replace("\n  - CONTACT", " []")
        two = write(text.replace("stiffness: 1}", f"stiffness: {stiffness}}}"), "other.yaml")
        a, b = (rows("frf", c, "--at", "1.5,2.2") for c in (one, two))
        assert len(a) == len(b) == 2
        for r, s in zip(a, b):
            near(r["amplitude"], s["amplitude"], 1e-12, table)
            near(r["multiplier"], s["multiplier"], 1e-12, table)
        found = rows("compare", one, "--at", "1.5", "--set", "transient.law=exact", "--set", "transient.method=closed_form")
        assert found[0]["verdict"] == "match", found
        assert rows("prove", one, "--at", "1.5")[0]["verdict"] == "proven"
    steps = write(GAP.replace("CONTACT", "{law: table, points: [[-3, -2], [-1, 0], [1, 0], [3, 2], [5, 2], [7, 4]]}")
                  .replace("stiffness: 1}", "stiffness: 0.1}"))  # softer by 1 twice: with all its springs open K is -0.9
    for method in ("closed_form", "cvode"):
        found = rows("compare", steps, "--at", "0.9", "--set", "transient.law=exact", "--set", f"transient.method={method}", "--set",
                     "hbm.harmonics=40")
        assert [r["verdict"] for r in found] == ["match"] and float(found[0]["hbm_amplitude"]) > 10, found


def symmetry_breaks():
    """A hard-driven Duffing: between two points the symmetric motion is unstable, though the curve does not turn, and time
    integration has a mean. They are branch points of the truncated equations, to 1e-9 the same with 12 and with 25 harmonics;
    the point beside a turning point, where only too few harmonics tell the two apart, is none."""
    case = os.path.join(ROOT, "cases/peers/tmdsimpy_sdof_duffing.yaml")
    said = [re.findall(r"symmetry breaking at omega = ([0-9.]+)", run("frf", case, "--set", f"hbm.harmonics={harmonics}").stdout)
            for harmonics in (12, 25)]
    assert len(said[1]) >= 2, said
    low, high = (float(w) for w in said[0][-2:])
    for w, other in zip(said[0][-2:], said[1][-2:]):
        near(w, other, 2e-9, "with more harmonics")
    assert not any(0.4 < float(w) < 0.6 for w in said[0]), said
    for omega, stable in ((low * (1 - 1e-6), "yes"), (low * (1 + 1e-6), "no"), (high * (1 - 1e-6), "no"), (high * (1 + 1e-6), "yes")):
        found = [r for r in rows("frf", case, "--at", repr(omega), "--set", "hbm.harmonics=12")
                 if float(r["amplitude"]) < 2 and float(r["mean"]) == 0]
        assert [r["stable"] for r in found] == [stable], found  # beside it, in between, one with a mean: the other branch
    settled = rows("transient", case, "--at", repr((low + high) / 2), "--set", "sweep.omega=[0.6, 0.9]")
    assert abs(float(settled[0]["mean"])) > 0.01, settled


def a_table_under_a_given_motion():
    """Its harmonics are those of the table itself: sums over 2^16 instants err by (2 pi/N)^2 of the slopes' jumps, 1e-8."""
    case, n = write(MIXED), 1 << 16
    points = [(-2, -1), (0, 0), (0.3, 0.1), (1, 3)]
    sums = [0.0] * 3
    for i in range(n):
        c, s = math.cos(2 * math.pi * i / n), math.sin(2 * math.pi * i / n)
        d, k = 0.1 + 1.2 * c + 0.3 * s, 0
        while k < 2 and d > points[k + 1][0]:
            k += 1
        (x, y), (x_2, y_2) = points[k:k + 2]
        f = y + (y_2 - y) / (x_2 - x) * (d - x)
        sums = [sums[0] + f / n, sums[1] + 2 * f * c / n, sums[2] + 2 * f * s / n]
    found = rows("contact", case, "--contact", "stop", "--motion-v", "0.1,1.2,0.3")
    for want, row, part in zip(sums, (0, 1, 1), ("cos", "cos", "sin")):
        near(found[row][part], want, 1e-7, f"harmonic {row}, {part}")
    said = run("contact", case, "--contact", "stop", "--motion-u", "0,1,0", code=64).stderr
    assert "contact stop has no tangent" in said, said


def the_report_draws_their_forces():
    """Of each law its own loop; and one harmonic for a load of harmonic 2 has no row in its tables."""
    case, page = write("""structure: {mass: [1, 0.5], damping: {rayleigh: [0.05, 0.05]}, stiffness: [[2, -1], [-1, 1.5]]}
forcing: [{dof: 1, amplitude: 0.3}, {dof: 2, harmonic: 2, amplitude: 0.1}]
contacts:
  - {law: polynomial, direction: {1: 1, 2: -1}, coefficients: {2: 0.4, 3: 2}}
  - {law: table, direction: {2: 1}, points: [[-0.4, -0.2], [-0.2, 0], [0.2, 0], [0.4, 0.3]]}
  - {law: tanh, friction: 0.2, preload: 0.5, epsilon: 0.2, tangent: {1: 1}}
sweep: {omega: [1, 1.4]}
hbm: {harmonics: 3}
compare: {omega: [1.2], harmonics: [1, 3], samples: [16]}
"""), os.path.join(FOLDER, "page.html")
    run("report", case, "--quiet", "--output", page, code=1)
    with open(page, encoding="utf-8") as f:
        assert re.findall(r'"of": ?"([^"]+)"', f.read())[:3] == ["f over d", "f over d", "T over u"]


def what_is_wrong_is_refused():
    wrong = (
        ("{law: polynomial}", "4:5: missing key `coefficients`"),
        ("{law: polynomial, coefficients: {}}", "4:37: contacts[0].coefficients is empty"),
        ("{law: polynomial, coefficients: 3}", "4:37: contacts[0].coefficients is a single value"),
        ("{law: polynomial, coefficients: {1: 3}}", "4:38: contacts[0].coefficients has the power `1`"),
        ("{law: polynomial, coefficients: {10: 3}}", "4:38: contacts[0].coefficients has the power `10`"),
        ("{law: polynomial, coefficients: {2.5: 3}}", "4:38: contacts[0].coefficients has the power `2.5`"),
        ("{law: polynomial, coefficients: {3: nan}}", "4:41: contacts[0].coefficients.3 is `nan`"),
        ("{law: polynomial, coefficients: {3: 1e400}}", "4:41: contacts[0].coefficients.3 is `1e400`"),
        ("{law: polynomial, coefficients: {3: 1, 3: 2}}", "4:44: contacts[0].coefficients gives a power twice"),
        ("{law: polynomial, coefficients: {3: 1}, friction: 0.3}", "4:55: friction in `contacts[0]`, whose law is polynomial"),
        ("{law: table, points: []}", "4:26: contacts[0].points is a list of too few or too many"),
        ("{law: table, points: [[0, 0]]}", "4:26: contacts[0].points is a list of too few or too many"),
        ("{law: table, points: [[0, 0], [0, 1]]}", "4:35: contacts[0].points has the distance 0 behind 0"),
        ("{law: table, points: [[1, 0], [0, 1]]}", "4:35: contacts[0].points has the distance 0 behind 1"),
        ("{law: table, points: [[0, 0], [1, nan]]}", "4:39: contacts[0].points is `nan`"),
        ("{law: table, points: [[0, 0], [1, 2, 3]]}", "4:35: contacts[0].points has a list as a point"),
        ("{law: table, points: [[0, 0], [1e-300, 1e300]]}", "4:35: contacts[0].points has a slope too large"),
        ("{law: tanh, normal_stiffness: 1, friction: 0.3, angle_deg: 0, epsilon: 0}", "4:76: contacts[0].epsilon is `0`"),
        ("{law: tanh, normal_stiffness: 1, friction: 0.3, angle_deg: 0, epsilon: -1}", "4:76: contacts[0].epsilon is `-1`"),
        ("{law: tanh, normal_stiffness: 1, friction: 0.3, angle_deg: 0}", "4:5: contacts[0] is a tanh without `epsilon`"),
        ("{law: cubic, coefficients: {3: 1}}", "4:11: contacts[0].law is `cubic`, expected contact, polynomial, tanh or table"),
    )
    for contact, words in wrong:
        path = write(GAP.replace("CONTACT", contact))
        said = run("frf", path, code=2).stderr
        assert f"{path}:{words}" in said, f"{contact}: {said} is not {words}"
    path = write(GAP.replace("CONTACT", "{tangential_stiffness: 1, normal_stiffness: 1, friction: 0.3, angle_deg: 10}"))
    for law, needs in ("table", "points"), ("tanh", "epsilon"):
        said = run("frf", path, "--set", f"contacts[0].law={law}", code=2).stderr
        assert f"{path}:4:5: contacts[0] is a {law} without `{needs}`" in said, said
    path = write(DUFFING)
    said = run("transient", path, "--at", "1", "--set", "transient.law=exact", "--set", "transient.method=closed_form",
               code=2).stderr
    assert "smooth law, which has no closed form" in said, said


def verify_names_what_is_wrong_with_them():
    """Curves of ours with one number wrong are held against the case: the cause is named, with the number."""
    tanh = """structure: {mass: [1], damping: [0.1], stiffness: [1]}
forcing: [{dof: 1, amplitude: 1}]
contacts:
  - {law: tanh, preload: 1, friction: 0.6, epsilon: 0.5, tangent: {1: 1}}
sweep: {omega: [0.5, 2.0]}
hbm: {harmonics: 15}
"""
    gentle = DUFFING.replace("amplitude: 0.05", "amplitude: 0.02").replace("3: 3", "3: 1")
    two = """structure: {mass: [1, 0.5], damping: {rayleigh: [0.05, 0.05]}, stiffness: [[2, -1], [-1, 1.5]]}
forcing: [{dof: 1, amplitude: 0.3}]
contacts:
  - {law: polynomial, direction: {1: 1, 2: -1}, coefficients: {2: 0.4, 3: 2}}
  - {law: table, direction: {2: 1}, points: [[-0.4, -0.2], [-0.2, 0], [0.2, 0], [0.4, 0.3]]}
sweep: {omega: [0.6, 2.0]}
hbm: {harmonics: 10}
"""
    wrong = (
        (DUFFING, "coefficients={3: 4}", "wrong_coefficient", "coefficients times 1.333"),
        (gentle, "coefficients={3: -1}", "wrong_coefficient", "coefficients times -1"),
        (gentle, "coefficients={4: 1}", "wrong_power", "powers one higher"),
        (gentle, "coefficients={2: 1}", "wrong_power", "powers one lower"),
        (tanh, "epsilon=0.3", "wrong_epsilon", "epsilon times 0.6"),
        (two, "coefficients={3: 1, 2: 0.4}", "wrong_coefficient", "power 3 times 0.5"),
        (two, "coefficients={3: 2, 2: -0.4}", "wrong_coefficient", "times -1 of contact 0's power 2"),
    )
    for text, change, cause, words in wrong if LONG else wrong[::6]:
        case, curve = write(text), os.path.join(FOLDER, "theirs.csv")
        theirs = rows("frf", case, "--at", "0.6,0.7,0.8,0.9,1,1.1,1.2,1.3,1.4,1.5,1.6,1.7,1.8", "--set",
                      f"contacts[0].{change}")
        with open(curve, "w", encoding="ascii") as f:
            f.write("omega,amplitude\n" + "".join(f"{r['omega']},{r['amplitude']}\n" for r in theirs
                                                  if r["stable"] == "yes" and r.get("response", "1") == "1"))
        said = run("verify", case, "--against", curve, "--quiet", code=1).stdout
        assert cause in said and words in said, f"{change}: {said}"


def assignments_reach_them():
    case = write(DUFFING)
    plain = rows("frf", case, "--at", "1")[0]["amplitude"]
    for words in ("contacts[0].coefficients.3=3", "contacts[0].coefficients={3: 3}", "contacts[0]={law: polynomial, coefficients: {3: 3}}"):
        assert rows("frf", case, "--at", "1", "--set", "contacts[0].coefficients.3=1", "--set", words)[0]["amplitude"] == plain
    softer = rows("frf", case, "--at", "1", "--set", "contacts[0].coefficients.3=0")[0]
    near(softer["amplitude"], 1, 1e-12, "without the cubic spring: F0/(C omega)")


if LONG:
    verify_names_what_is_wrong_with_them()
    sys.exit()
duffing_meets_time_integration()
mixed_laws_meet()
a_table_is_what_it_stands_for()
a_table_under_a_given_motion()
symmetry_breaks()
the_report_draws_their_forces()
what_is_wrong_is_refused()
verify_names_what_is_wrong_with_them()
assignments_reach_them()
