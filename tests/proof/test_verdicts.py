#!/usr/bin/env python3
"""hbmcheck-proof from outside: what must be accepted is, with the numbers known; nothing that is false is accepted; nothing crashes it.
    test_verdicts.py HBMCHECK_PROOF"""
import copy
import glob
import json
import os
import random
import subprocess
import sys
import unittest
from decimal import Decimal, localcontext
from fractions import Fraction

from oscillator import Oscillator

FOLDER = os.path.join(os.path.dirname(os.path.abspath(__file__)), "certificates")
STORED = {os.path.basename(path)[:-5]: json.load(open(path)) for path in sorted(glob.glob(os.path.join(FOLDER, "*.json")))}
QUANTITIES = ("max", "min", "amplitude", "mean", "a1", "b1", "harmonic_1", "multiplier")
PROGRAM = None


def run(*arguments, text=""):
    if isinstance(text, str):
        text = text.encode()
    return subprocess.run([PROGRAM, *arguments], input=text, capture_output=True, timeout=600)


def answers(command, objects):
    """One answer an object, in order."""
    done = run(*command, text="".join(json.dumps(o) + "\n" for o in objects))
    lines = [json.loads(line) for line in done.stdout.splitlines()]
    assert len(lines) == len(objects), (done.returncode, done.stderr[-500:], len(lines), len(objects))
    worst = max({"accepted": 0, "rejected": 1, "wrong": 2}[a["verdict"]] for a in lines)
    assert done.returncode == worst, (done.returncode, worst)
    return lines


def check(objects):
    return answers(["check", "-"], objects)


def complete(objects):
    return answers(["complete", "-", "-o", "-"], objects)


def inside(inner, outer):
    return Fraction(outer[0]) <= Fraction(inner[0]) <= Fraction(inner[1]) <= Fraction(outer[1])


def rounded(certificate, digits=11):
    """A candidate: the orbit in double precision."""
    short = lambda text: float("%.*g" % (digits, float(text)))
    candidate = {key: value for key, value in certificate.items() if key in ("model", "omega", "multiple", "response", "rest")}
    candidate["events"] = [dict(e, t=short(e["t"]), x=[short(x) for x in e["x"]], v=[short(v) for v in e["v"]]) for e in certificate["events"]]
    return candidate


class Accepted(unittest.TestCase):
    def test_the_stored_certificates_with_their_claims(self):
        self.assertEqual(len(STORED), 6)
        for name, answer in zip(STORED, check(STORED.values())):
            self.assertEqual((answer["verdict"], answer["reason"], answer["segment"]), ("accepted", None, None), name)
            for key in QUANTITIES:
                self.assertTrue(inside(answer[key], STORED[name]["claims"][key]), (name, key))
            self.assertEqual(answer["states"], [e["state"] for e in STORED[name]["events"]])
            self.assertEqual(answer["transitions"], 0 if name.endswith("linear") else len(STORED[name]["events"]))
            for compared in STORED[name].get("compared", []):  # an HBM value less the enclosure
                low, high = answer[compared["quantity"]]
                error = [str(Decimal(compared["value"]) - Decimal(high)), str(Decimal(compared["value"]) - Decimal(low))]
                self.assertTrue(inside(error, compared["error"]), (name, error))

    def test_completed_from_double_precision_they_enclose_the_same(self):
        done = complete([dict(rounded(c), id=name) for name, c in STORED.items()])
        for name, answer in zip(STORED, done):
            self.assertEqual((answer["verdict"], answer["id"]), ("accepted", name), answer["reason"])
            for key in QUANTITIES[:-1]:
                (a, b), (c, d) = answer[key], STORED[name]["claims"][key]
                self.assertTrue(Fraction(a) <= Fraction(d) and Fraction(c) <= Fraction(b), (name, key))
                self.assertTrue(inside(answer[key], answer["certificate"]["claims"][key]), (name, key))
        again = check([a["certificate"] for a in done])  # whose approximate inverse is another
        for key in ("verdict", "radius", "uniqueness_radius", "stability", "states", "transitions"):
            self.assertEqual([a[key] for a in again], [a[key] for a in done])

    def test_the_numbers_known_of_case_2(self):
        # omega: amplitude and largest multiplier of each orbit, from a third program (integer ball arithmetic in Python)
        known = {
            5.3: [("7.271633404548", "2.080")],
            6.0: [("8.053701544656", "0.8110")],
            8.0: [("13.8703020105", "0.855"), ("9.25373986781", "2.178")],
            9.0: [("23.7153045916317", "0.86968"), ("18.0612980874387", "1.22003"), ("2.42967633958972", "0.86968")],
            9.2: [("25.9827870832", "0.94575"), ("24.2695332862", "1.04251"), ("2.23257004789", "0.872")]}
        for omega, orbits in known.items():
            o = Oscillator(omega)
            found = complete([o.candidate(orbit) for orbit in o.orbits()])
            self.assertEqual([a["verdict"] for a in found], ["accepted"] * len(found), omega)
            for amplitude, multiplier in orbits:
                near = lambda text, interval: all(abs(Decimal(end) - Decimal(text)) <= Decimal(1).scaleb(Decimal(text).as_tuple().exponent) for end in interval)
                fitting = [a for a in found if near(amplitude, a["amplitude"])]
                self.assertEqual(len(fitting), 1, (omega, amplitude, [a["amplitude"] for a in found]))
                self.assertTrue(near(multiplier, fitting[0]["multiplier"]), (omega, fitting[0]["multiplier"]))
                self.assertEqual(fitting[0]["stability"], "stable" if float(multiplier) < 1 else "unstable")

    def test_the_open_orbit_is_proven_up_to_grazing_and_refused_beyond(self):
        # (40 - u)^2 + 0.16 u = (100 sin(45)/5)^2 = 200, u = omega^2
        with localcontext() as context:
            context.prec = 60
            graze, unit = ((Decimal("79.84") - (Decimal("79.84") ** 2 - 5600).sqrt()) / 2).sqrt(), Decimal("1e-24")
            around = [graze - unit, graze + unit]
        self.assertTrue(str(graze).startswith("5.099583150937923"))
        o = Oscillator(float(graze))
        candidates = []
        for omega in around:
            z = 100 / complex(40 - float(omega) ** 2, 0.4 * float(omega))
            candidates.append(dict(o.candidate((z.real, -float(omega) * z.imag, [])), omega=str(omega)))
        before, beyond = complete(candidates)
        self.assertEqual((before["verdict"], beyond["verdict"]), ("accepted", "rejected"))
        self.assertRegex(beyond["reason"], r"^segment 0, t = .*contact 0, open.*(not decided|negative)$")

    def test_what_is_proportional_may_change_at_one_event(self):
        whole = STORED["case2_9_stable"]
        halves = rounded(whole)
        halves["model"] = copy.deepcopy(whole["model"])
        contact = halves["model"]["contacts"][0]
        contact.update(tangential_stiffness="50", normal_stiffness="500")
        halves["model"]["contacts"] = [contact, dict(contact, friction="0.7")]
        for event in halves["events"]:
            event["state"] *= 2
        other = copy.deepcopy(halves)
        other["model"]["contacts"][1]["gap"] = "-5.0000001"
        twice, apart = complete([halves, other])
        self.assertEqual(twice["verdict"], "accepted", twice["reason"])
        for key in QUANTITIES[:-1]:
            (a, b), (c, d) = twice[key], whole["claims"][key]
            self.assertTrue(Fraction(a) <= Fraction(d) and Fraction(c) <= Fraction(b), key)
        self.assertRegex(apart["reason"], "^two independent transitions at once")


    def test_a_slider_that_sticks_all_period_may_rest_within_its_limits(self):
        # x = z cos(2 t - phi) + kt w/(k + kt); |T| = kt |x - w| <= mu P asks for |z - k w/(k + kt)| and |z + ...| <= 0.5
        z = 3 / complex(10 + 20 - 4, 0.2)
        size, answers_at = abs(z), {}
        for w in ("0", "1.15", "1.16", "-1.16"):
            model = {"mass": [["1"]], "damping": [["0.1"]], "stiffness": [["10"]], "forcing": [{"harmonic": 1, "cos": ["3"], "sin": ["0"]}],
                     "contacts": [{"tangent": ["1"], "tangential_stiffness": "20", "friction": "0.5", "preload": "20"}]}
            candidate = {"model": model, "omega": "2", "rest": {"0": w},
                         "events": [{"section": 1, "t": "0", "x": [z.real + 20 * float(w) / 30], "v": [-2 * z.imag], "state": "S"}]}
            answers_at[w], = complete([candidate])
        self.assertTrue(size + 10 * 1.15 / 30 < 0.5 < size + 10 * 1.16 / 30)
        self.assertEqual([a["verdict"] for a in answers_at.values()], ["accepted", "accepted", "rejected", "rejected"])
        self.assertRegex(answers_at["1.16"]["reason"], "stick T > -mu N: it is negative")
        self.assertRegex(answers_at["-1.16"]["reason"], "stick T < mu N: it is negative")
        for w in ("0", "1.15"):
            low, high = map(float, answers_at[w]["mean"])
            self.assertTrue(low - 1e-15 <= 20 * float(w) / 30 <= high + 1e-15)
        missing, = complete([dict(candidate, rest={})])
        self.assertEqual(missing["verdict"], "wrong")


class Rejected(unittest.TestCase):
    """One thing is changed, and the statement with it."""

    def refused(self, changed, words="."):
        for (name, what), answer in zip(changed, check([c for c in changed.values()])):
            self.assertNotEqual(answer["verdict"], "accepted", (name, what))
            self.assertRegex(answer["reason"], words, (name, what))

    def each(self, change):
        """{(name, what): certificate} of change(certificate), which yields (what, the changed copy)."""
        return {(name, what): changed for name, stored in STORED.items() for what, changed in change(stored)}

    def test_events(self):
        def change(stored):
            for i, event in enumerate(stored["events"]):
                for key in ("t", "x", "v"):
                    if key == "t" and "section" in event:
                        continue
                    for k in range(1 if key == "t" else len(event[key])):
                        scale = Decimal(stored["scales"][key])
                        for size in ("1e-15", "-1e-3"):
                            changed = copy.deepcopy(stored)
                            if key == "t":
                                changed["events"][i]["t"] = str(Decimal(event["t"]) + scale * Decimal(size))
                            else:
                                changed["events"][i][key][k] = str(Decimal(event[key][k]) + scale * Decimal(size))
                            yield (i, key, k, size), changed
        self.refused(self.each(change), "existence|equations|segment|times")

    def test_letters(self):
        def change(stored):
            for i, event in enumerate(stored["events"]):
                for j, letter in enumerate(event["state"]):
                    for other in "OSN+-":
                        if other != letter:
                            changed = copy.deepcopy(stored)
                            changed["events"][i]["state"] = event["state"][:j] + other + event["state"][j + 1:]
                            yield (i, j, other), changed
        self.refused(self.each(change))

    def test_the_order_of_events(self):
        def change(stored):
            for i in range(len(stored["events"]) - 1):
                changed = copy.deepcopy(stored)
                changed["events"][i], changed["events"][i + 1] = changed["events"][i + 1], changed["events"][i]
                yield i, changed
                changed = copy.deepcopy(stored)
                del changed["events"][i]
                yield ("less", i), changed
        self.refused(self.each(change))

    def test_model(self):
        def numbers(value, path=()):
            if isinstance(value, str):
                yield path
            elif isinstance(value, (list, dict)):
                for key in (value if isinstance(value, dict) else range(len(value))):
                    if key not in ("harmonic", "section"):
                        yield from numbers(value[key], path + (key,))

        def change(stored):
            never_slips = stored["model"]["contacts"][0].get("angle_deg") and not any(set(e["state"]) & set("+-") for e in stored["events"])
            never_touches = all(e["state"] == "O" for e in stored["events"])
            for path in [("omega",)] + [("model",) + p for p in numbers(stored["model"])]:
                # statements that stay true: the friction of a contact that does not slip, all but the mass of one that stays open
                if (never_slips and path[-1] == "friction") or (never_touches and "contacts" in path):
                    continue
                changed = copy.deepcopy(stored)
                place = changed
                for key in path[:-1]:
                    place = place[key]
                number = Decimal(place[path[-1]])
                place[path[-1]] = str(number * (1 + Decimal("1e-8")) if number else Decimal("1e-8"))
                yield path, changed
            changed = copy.deepcopy(stored)
            changed["multiple"] = 2
            # an orbit without transitions, twice around, has the square of its multipliers
            yield "multiple", changed
        self.refused(self.each(change))

    def test_claims(self):
        def change(stored):
            claims = stored["claims"]
            for key, value in (("radius", "1e-40"), ("uniqueness_radius", "0.2")):
                if not (key == "uniqueness_radius" and "section" in stored["events"][0]):
                    yield key, dict(stored, claims=dict(claims, **{key: value}))
            for word in ("stable", "unstable"):
                if word != claims["stability"]:
                    yield word, dict(stored, claims=dict(claims, stability=word))
            for key in QUANTITIES:
                low, high = map(Decimal, claims[key])
                width = high - low
                for what, moved in (("above", (high, high + width)), ("below", (low - width, low)), ("narrow", (low, low + width / 10 ** 6))):
                    yield (key, what), dict(stored, claims=dict(claims, **{key: [str(end) for end in moved]}))
        self.refused(self.each(change), "claim|existence|stability")

    def test_claims_that_cut_what_is_found(self):
        found = dict(zip(STORED, check(STORED.values())))

        def change(stored):
            answer, = [found[name] for name in STORED if STORED[name] is stored]
            for key in QUANTITIES:
                low, high = map(Decimal, answer[key])
                middle = str((low + high) / 2)
                for what, cut in (("below", [middle, stored["claims"][key][1]]), ("above", [stored["claims"][key][0], middle])):
                    yield (key, what), dict(stored, claims=dict(stored["claims"], **{key: cut}))
        self.refused(self.each(change), "^claim is too narrow")

    def test_vectors(self):
        def change(stored):
            n = len(stored["vectors"])
            identity = [[["1" if i == j else "0", "0"] for j in range(n)] for i in range(n)]
            singular = [[["1", "0"]] * n for i in range(n)]
            for what, vectors in (("identity", identity), ("singular", singular), ("none", None), ("few", [[["1", "0"]]])):
                yield what, dict(stored, vectors=vectors)
        self.refused(self.each(change), "stability unproven|claim is (false|too narrow): multiplier")

    def test_wrong_sequences_whose_equations_hold(self):
        """Case 2 with its contact glued: the linear orbit of stick all round has gaps below 0; and open, where it should touch."""
        for omega, words in ((6.0, "open"), (5.3, "open")):
            z = 100 / complex(40 - omega ** 2, 0.4 * omega)
            o = Oscillator(omega)
            answer, = complete([o.candidate((z.real, -omega * z.imag, []))])
            self.assertEqual(answer["verdict"], "rejected")
            self.assertRegex(answer["reason"], words + ".*it is negative")
        stiff = 40 + 50 + 500
        z = 100 / complex(stiff - 81, 3.6)
        rest = 5 * 2 ** 0.5 * 550 / stiff
        candidate = dict(Oscillator(9.0).candidate((0, 0, [])), rest={"0": repr(5.0)})
        candidate["events"][0].update(x=[z.real + rest], v=[-9 * z.imag], state="S")
        answer, = complete([candidate])
        self.assertEqual(answer["verdict"], "rejected")
        self.assertRegex(answer["reason"], "closed.*it is negative")


    def test_stick_that_goes_on_over_a_higher_turn(self):
        """x is near cos t + 0.02 sin t - 0.35 cos 2t, whose second maximum is above the first, where slip ended: at the second the slider is dragged again.
        Stick with a double zero at its start, whose limit is passed for an instant long after it, with an upward curvature."""
        for side, (back, forth) in ((1, "-+"), (-1, "+-")):
            text = lambda value: repr(side * value)
            model = {"mass": [["1"]], "damping": [["0.5"]], "stiffness": [["6"]],
                     "forcing": [{"harmonic": h, "cos": [text(a)], "sin": [text(b)]} for h, a, b in ((1, 5.01, -0.4), (2, -0.7, 0.35))],
                     "contacts": [{"tangent": ["1"], "tangential_stiffness": "0.5", "friction": "1", "preload": "0.1"}]}
            events = [{"t": t, "x": [text(x)], "v": [text(v)], "state": letter} for t, x, v, letter in (
                (-0.753, 0.693, 0, "S"), (1.644, 0.293, -1.101, back), (3.150, -1.350, 0, "S"), (3.753, -0.950, 1.215, forth))]
            answer, = complete([{"model": model, "omega": "1", "events": events}])
            self.assertIsNotNone(answer["uniqueness_radius"], answer["reason"])
            self.assertRegex(answer["reason"], "^segment 0, .*stick T %smu N: it is negative$" % ("< " if side > 0 else "> -"))

    def test_slip_that_goes_on_while_the_motion_turns(self):
        z = 3 / complex(10 - 4, 0.2)
        model = {"mass": [["1"]], "damping": [["0.1"]], "stiffness": [["10"]], "forcing": [{"harmonic": 1, "cos": ["3"], "sin": ["0"]}],
                 "contacts": [{"tangent": ["1"], "tangential_stiffness": "20", "friction": "0.5", "preload": "0.2"}]}
        for letter, force in (("+", 0.1), ("-", -0.1)):
            event = {"section": 1, "t": "0", "x": [z.real - force / 10], "v": [-2 * z.imag], "state": letter}
            answer, = complete([{"model": model, "omega": "2", "events": [event]}])
            self.assertRegex(answer["reason"], r"contact 0, slip \%s: it is negative" % letter)

    def test_the_edge_of_the_cone(self):
        candidates = []
        for friction in ("0.1", "0.1000001", "0.0999999"):  # kt cos(45) = mu kn sin(45) at 0.1
            candidates.append(rounded(STORED["case2_9_stable"]))
            candidates[-1]["model"] = copy.deepcopy(candidates[-1]["model"])
            candidates[-1]["model"]["contacts"][0]["friction"] = friction
        edge, inside_it, outside = complete(candidates)
        self.assertRegex(edge["reason"], "^edge of the cone: segment 0, contact 0")
        self.assertEqual(inside_it["verdict"], "accepted")
        self.assertRegex(outside["reason"], "segment 0, contact 0, stick .*it is negative")


class Wrong(unittest.TestCase):
    """What is no certificate ends in exit status 2 and words, whatever it is."""

    def test_shapes(self):
        good = STORED["fig08_7"]
        wrong = []
        for key in ("model", "omega", "multiple", "precision_bits", "response", "rest", "scales", "events", "claims"):
            wrong.append({k: v for k, v in good.items() if k != key})
            for other in (None, -7, "x", [], {}, True, [[]], "1e500", 10 ** 15, "nan"):
                if not (key == "rest" and other == {}):
                    wrong.append(dict(good, **{key: other}))
        model = good["model"]
        for other in (dict(model, stiffnes=[["1"]]), dict(model, mass=[["1", "2"]]), dict(model, mass=[["1"]] * 100), dict(model, contacts=[{}]),
                      dict(model, contacts=[dict(model["contacts"][0], preload="1")]), dict(model, contacts=[dict(model["contacts"][0], angle_deg="90")]),
                      dict(model, contacts=[dict(model["contacts"][0], normal_stiffness="-1")]), dict(model, forcing=model["forcing"] * 2)):
            wrong.append(dict(good, model=other))
        for certificate, answer in zip(wrong, check(wrong)):
            self.assertEqual(answer["verdict"], "wrong", (answer["reason"], certificate))
            self.assertTrue(answer["reason"])
        self.assertIn("singular", check([dict(good, model=dict(model, mass=[["0"]]))])[0]["reason"])

    def test_bytes(self):
        rng = random.Random(7)
        whole = json.dumps(STORED["case2_9_stable"]).encode()
        for _ in range(150):
            text = bytearray(whole)
            for _ in range(rng.choice((1, 1, 2, 5))):
                at = rng.randrange(len(text))
                if rng.random() < 0.5:
                    text[at] = rng.choice(b'0123456789eE+-."[]{},:SON\\\x00\xff')
                else:
                    del text[at:at + rng.randrange(1, 40)]
            done = run("check", "-", text=bytes(text).replace(b"\n", b" ") + b"\n")
            self.assertIn(done.returncode, (0, 1, 2), (bytes(text), done.stderr))
        done = run("check", "-", text="[" * 100000 + "\n")
        self.assertEqual(done.returncode, 2)

    def test_files_and_usage(self):
        path = os.path.join(FOLDER, "case2_9_stable.json")
        done = run("check", path, path)
        self.assertEqual((done.returncode, done.stdout.count(b": accepted, stable; amplitude 23.7153045916317277993")), (0, 2))
        self.assertEqual(run("check", path, "/nowhere").returncode, 2)
        self.assertEqual(run("check", __file__).returncode, 2)
        self.assertEqual(json.loads(run("check", "--format", "json", path).stdout)["file"], path)
        for arguments in ((), ("check",), ("chek", path), ("check", path, "--format"), ("check", path, "--format", "xml"), ("complete", path),
                          ("complete", "-", "-o", "file"), ("complete", path, "-o", "-", "--precision-bits", "3"), ("complete", path, path, "-o", os.devnull),
                          ("complete", "-"), ("complete", "-o", os.devnull)):
            self.assertEqual(run(*arguments).returncode, 64, arguments)
        self.assertEqual(run("complete", path, "-o", os.devnull).returncode, 0)


if __name__ == "__main__":
    PROGRAM = sys.argv.pop(1)
    unittest.main()
