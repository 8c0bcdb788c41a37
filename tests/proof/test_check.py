#!/usr/bin/env python3
"""The checker in Python: ball arithmetic against exact fractions, true certificates accepted, false ones rejected, damaged files refused.

    test_check.py [HBMCHECK_PROOF]      with the checker in C, which must give the same verdict on each of them
"""
import contextlib
import io
import json
import pathlib
import random
import subprocess
import sys
import tempfile
import types
import unittest
from fractions import Fraction

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))
import falsify  # noqa: E402
from find import check  # noqa: E402

PROGRAM = None
CERTIFICATES = sorted((HERE / "certificates").glob("*.json"))


def holds(ball, value):
    return ball.lo <= value * (1 << check.Ball.bits) <= ball.hi


def outside(rng, trials):
    """How many of the results of random expressions do not contain the exact value: of balls that are rounded, and of balls with a width."""
    missed = 0
    for _ in range(trials):
        check.Ball.bits = rng.choice((8, 20, 64, 200))
        unit = 1 << check.Ball.bits
        pairs = []
        for _ in range(6):
            value = Fraction(rng.randrange(-10 ** 6, 10 ** 6), rng.choice((7, 1000, 10 ** 5)))
            ball = check.Ball.of(value)
            if rng.random() < 0.5:  # a wide ball with the value anywhere in it, at its ends, too
                ball = check.Ball(ball.m, rng.randrange(1, unit))
                value = Fraction(ball.m, unit) + Fraction(ball.r, unit) * rng.choice((-1, 1, Fraction(rng.randrange(-99, 100), 99)))
            pairs.append((ball, value))
        for _ in range(12):
            (a, x), (b, y) = rng.choice(pairs), rng.choice(pairs)
            k = rng.randrange(1, 50)
            operation = rng.randrange(8)
            if operation == 3 and abs(b.m) <= b.r:
                continue
            new = [lambda: (a + b, x + y), lambda: (a - b, x - y), lambda: (a * b, x * y), lambda: (a / b, x / y), lambda: (a.over(k), x / k),
                   lambda: (check.dot([a, b], [b, a]), 2 * x * y), lambda: (check.apply_row({0: a, 1: b}, [b, a]), 2 * x * y),
                   lambda: (check.row_times({0: a}, [{5: b}])[5], x * y)][operation]()
            missed += not holds(*new)
            if new[0].size < unit << 64:
                pairs[rng.randrange(6)] = new
        ball, value = rng.choice(pairs)
        root = (ball * ball).root()  # of a square, whose root is known
        missed += not root.lo <= abs(value) * unit <= root.hi
    return missed


def series(x, first, step):
    """Exact partial sum of exp-like series, sum of terms t_0 = first, t_{j + 1} = t_j step(j), until they are below 10^-90."""
    total = term = Fraction(first)
    j = 0
    while abs(term) > Fraction(1, 10 ** 90) or j < 2 * abs(x) + 4:
        term = term * step(j)
        total += term
        j += 1
    return total


class Balls(unittest.TestCase):
    def test_exact_value_is_inside(self):
        self.assertEqual(outside(random.Random(1), 400), 0)

    def test_broken_rounding_is_seen(self):
        broken = {"rounded": lambda m, r: check.Ball(m >> check.Ball.bits, r >> check.Ball.bits)}
        for name, function in broken.items():
            kept = getattr(check, name)
            setattr(check, name, function)
            try:
                self.assertGreater(outside(random.Random(1), 100), 0)
            finally:
                setattr(check, name, kept)
        for name, function in (("over", lambda self, k: check.Ball(self.m // k, self.r // k)),
                               ("of", staticmethod(lambda v: check.Ball(int(Fraction(v) * (1 << check.Ball.bits))))),
                               ("root", lambda self: check.Ball(check.math.isqrt(max(self.m, 0) << check.Ball.bits), self.r))):
            kept = check.Ball.__dict__[name]
            setattr(check.Ball, name, function)
            try:
                self.assertGreater(outside(random.Random(1), 100), 0, name)
            finally:
                setattr(check.Ball, name, kept)

    def test_cosine_sine_exponential(self):
        rng = random.Random(2)
        for bits in (40, 128, 250):
            check.Ball.bits = bits
            for size in (1e-3, 1, 30):
                x = Fraction(rng.uniform(-size, size))
                cosine, sine = check.cos_sin(check.Ball.of(x))
                exact = [series(x, 1, lambda j: -x * x / ((2 * j + 1) * (2 * j + 2))), series(x, x, lambda j: -x * x / ((2 * j + 2) * (2 * j + 3)))]
                for ball, value in zip((cosine, sine), exact):
                    self.assertTrue(holds(ball, value), (bits, x))
                    self.assertLess(ball.r, 20 + 2 ** 6 * abs(x))  # tight: a few units, more where 2 pi was subtracted
                far = check.cos_sin(check.Ball.of(x) + check.pi().times(2000))
                self.assertTrue(all(holds(ball, value) for ball, value in zip(far, exact)))
                # exp of [[a, 0], [0, 0]] and of a rotation, as segments compute them; weights and norm as there
                a = x / Fraction(size) * 2
                for matrix, wanted in (([{0: check.Ball.of(a)}, {}], series(a, 1, lambda j: a / (j + 1))),
                                       ([{1: -check.Ball.of(a)}, {0: check.Ball.of(a)}], series(a, 1, lambda j: -a * a / ((2 * j + 1) * (2 * j + 2))))):
                    segment = check.Segment.__new__(check.Segment)
                    segment.A, segment.size, segment.e, segment.norm, segment.i = matrix, 2, [0, 3], check.Ball.of(abs(a) * 9).size, 0
                    for tau in (check.Ball.of(1), check.Ball.of(3)):
                        flow = segment.powers(tau)[-1]
                        if tau.m == 1 << bits:
                            self.assertTrue(holds(flow[0][0], wanted), (bits, a))
                            self.assertLess(flow[0][0].r, 2 ** 30)
                    direct = segment.exponential(check.Ball.of(Fraction(1, 16)))
                    sixteenth = matrix[0].get(0)
                    if sixteenth:
                        self.assertTrue(holds(direct[0][0], series(a / 16, 1, lambda j: a / 16 / (j + 1))))

    def test_range_of_a_polynomial(self):
        rng = random.Random(3)
        check.Ball.bits = 64
        for _ in range(30):
            coefficients = [Fraction(rng.randrange(-1000, 1000), 97) for _ in range(rng.randrange(2, 9))]
            whole = check.Polynomial.of([check.Ball.of(v) for v in coefficients])
            value = lambda s: sum(v * s ** j for j, v in enumerate(coefficients)) * (1 << 64)
            for part, low, high in ((whole, 0, 1), (whole.halves()[0], 0, Fraction(1, 2)), (whole.halves()[1].halves()[0], Fraction(1, 2), Fraction(3, 4))):
                self.assertLessEqual(abs(part.b[0] - value(Fraction(low))), part.r)
                self.assertLessEqual(abs(part.b[-1] - value(Fraction(high))), part.r)
                for k in range(11):
                    v = value(low + (high - low) * Fraction(k, 10))
                    self.assertTrue(min(part.b) - part.r <= v <= max(part.b) + part.r)
            top = check.largest([whole])
            self.assertTrue(max(value(Fraction(k, 200)) for k in range(201)) <= top.hi)
            self.assertLess(top.r, 2 ** 16)


class Signs(unittest.TestCase):
    def decided(self, coefficients, start, end):
        """The words for G(s) on a segment of one substep, from its Taylor coefficients; "" if its sign is right."""
        check.Ball.bits = 64
        derivatives = [coefficients]
        for _ in range(2):
            derivatives.append([(j + 1) * v for j, v in enumerate(derivatives[-1][1:])] + [0])
        series = [[check.Ball(check.Ball.of(v).m, 3) for v in z] for z in zip(*derivatives)]
        motion = types.SimpleNamespace(steps=1, h=check.Ball.of(1), segment=types.SimpleNamespace(i=0))
        try:
            check.check_condition(motion, series, 0, 0.0, 0, "G", [{p: check.Ball.of(1)} for p in range(3)], start, end)
        except check.Unproven as error:
            return str(error).rpartition(": ")[2]
        return ""

    def test_zeros_at_the_ends(self):
        for coefficients, start, end, words in (
                ([1, 0, 0, 0], 0, 0, ""), ([-1, 0, 0, 0], 0, 0, "it is negative"), ([0, 1, 0, 0], 1, 0, ""), ([0, -1, 0, 0], 1, 0, "it is negative"),
                ([0, 1, -1, 0], 1, 1, ""), ([0, 0, 1, 0], 2, 0, ""), ([0, 0, -1, 0], 2, 0, "it is negative"), ([0, 0, 1, -1], 2, 1, ""),
                ([1, -1, 0, 0], 0, 1, ""), ([-1, 1, 0, 0], 0, 1, "it is negative"), ([0, 1, 0, 0], 0, 0, "sign not decided"), ([1, -1, 0, 0], 0, 0, "sign not decided"),
                ([0, 0, 1, 0], 1, 0, "sign not decided"), ([0.25, -1, 1, 0], 0, 0, "sign not decided"), ([0.2500001, -1, 1, 0], 0, 0, ""), ([0, 0, 0, 0], 0, 0, "sign not decided"), ([1, -2, 0, 0], 0, 0, "it is negative")):
            self.assertEqual(self.decided(coefficients, start, end), words, (coefficients, start, end))

    def test_proportional_guards(self):
        f = Fraction
        one, two, other = ({"cos 45": {("x", 0): f(k), ("x", 1): f(l)}, "": {"one": f(m)}} for k, l, m in ((1, 2, 3), (2, 4, 6), (2, 4, 5)))
        self.assertTrue(check.proportional(one, two))
        self.assertFalse(check.proportional(one, other))  # parallel motions, another gap
        along, also, across = {"cos 45": {("v", 0): f(1)}}, {"sin 30": {("v", 0): f(-7)}, "cos 30": {("v", 0): f(2)}}, {"cos 45": {("v", 1): f(1)}}
        self.assertTrue(check.proportional(along, also))  # multiples of v_0, whatever the angles
        self.assertFalse(check.proportional(along, across))
        self.assertFalse(check.proportional(along, {}))


def judged(data):
    """The answer of the checker in Python, whose verdict is that of the one in C."""
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder, "certificate.json")
        path.write_text(data if isinstance(data, str) else json.dumps(data))
        answer = check.examine(str(path))
        if PROGRAM:
            run = subprocess.run([PROGRAM, "check", path, "--format", "json"], capture_output=True, text=True, timeout=600)
            other = json.loads(run.stdout)
            assert (other["verdict"], run.returncode) == (answer["verdict"], ("accepted", "rejected", "wrong").index(answer["verdict"])), (answer, other)
        return answer


def quietly(*arguments):
    out, err = io.StringIO(), io.StringIO()
    with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
        status = check.main(list(map(str, arguments)))
    return status, out.getvalue(), err.getvalue()


class Certificates(unittest.TestCase):
    def test_true_ones_are_accepted(self):
        self.assertGreaterEqual(len(CERTIFICATES), 5)
        status, out, _ = quietly("--format", "json", *CERTIFICATES)
        self.assertEqual(status, 0, out)
        for line, path in zip(out.splitlines(), CERTIFICATES):
            self.assertEqual(judged(path.read_text())["verdict"], "accepted")
            answer, claims = json.loads(line), json.loads(path.read_text())["claims"]
            self.assertEqual((answer["verdict"], answer["stability"]), ("accepted", claims["stability"]))
            self.assertTrue(Fraction(claims["max"][0]) <= Fraction(answer["max"][0]) <= Fraction(answer["max"][1]) <= Fraction(claims["max"][1]))

    def test_one_thing_changed(self):
        rng, made, kinds = random.Random(4), 0, set()
        small = [json.loads(path.read_text()) for path in CERTIFICATES if "chain3" not in path.name]
        while made < 40:
            false = falsify.changed(rng.choice(small), rng)
            if false:
                made += 1
                kinds.add(false[0])
                self.assertNotEqual(judged(false[1])["verdict"], "accepted", false)
        self.assertGreater(len(kinds), 12)

    def test_claims(self):
        data = json.loads((HERE / "certificates/case2_9_stable.json").read_text())
        changed = lambda **claims: judged({**data, "claims": {**data["claims"], **claims}})["reason"]
        for name in check.BOUNDS + ("multiplier",):
            low, high = map(Fraction, data["claims"][name])
            middle = falsify.find.digits((low + high) / 2, 60)
            self.assertEqual(changed(**{name: [middle, middle]}), f"claim is too narrow: {name}")
            self.assertEqual(changed(**{name: [falsify.find.digits(2 * high - low + (high - low), 60)] * 2}), f"claim is false: {name}")
        self.assertEqual(changed(stability="unstable"), "claim is false: stability")
        self.assertTrue(judged({k: v for k, v in data.items() if k != "vectors"})["reason"].startswith("stability unproven"))
        data["events"].reverse()
        self.assertTrue(changed().startswith("times not in order"))

    def test_claims_leave_room_for_both_checkers(self):
        """A light mass on contacts 1e5 times as stiff as its spring: what check.py encloses takes no more than half of the room of what `complete` claims."""
        if not PROGRAM:
            self.skipTest("without the checker in C")
        stiffness = (("83.94", "2.909", "0.6696", "7.461e7", "5.919"), ("44.54", "1.571e7", "0.4335", "15470", "1.903"), ("30.81", "29.35", "0.1307", "33.76", "6.558"))
        keys = ("angle_deg", "tangential_stiffness", "friction", "normal_stiffness", "gap")
        model = {"mass": [["8.264"]], "damping": [["10.53"]], "stiffness": [["513.6"]], "forcing": [{"harmonic": 1, "cos": ["1e6"], "sin": ["0"]}],
                 "contacts": [{"direction": ["1"], **dict(zip(keys, numbers))} for numbers in stiffness]}
        events = [{"t": t, "x": [x], "v": [v], "state": state} for t, x, v, state in (
            (0.01284, 0.01116, -0.3526, "S-S"), (0.06362, -0.01339, 0, "SSS"), (0.06397, -0.01339, -0.008841, "S-S"), (0.06526, -0.01345, 0, "SSS"),
            (0.07809, -0.01118, 0.3619, "S+S"), (0.1306, 0.01345, 0, "SSS"))]
        candidate = {"model": model, "omega": "48.1", "rest": {"0": "0", "2": "0"}, "events": events}
        run = subprocess.run([PROGRAM, "complete", "-", "-o", "-"], input=json.dumps(candidate), capture_output=True, text=True)
        made = json.loads(run.stdout)
        self.assertEqual(made["verdict"], "accepted", made["reason"])
        answer = judged(made["certificate"])
        self.assertEqual(answer["verdict"], "accepted", answer["reason"])
        for name in check.BOUNDS + ("multiplier",):
            (low, high), found = map(Fraction, made["certificate"]["claims"][name]), list(map(Fraction, answer[name]))
            room = (high - low) / 4
            self.assertTrue(low + room <= found[0] <= found[1] <= high - room, (name, float((found[1] - found[0]) / (high - low))))

    def test_limits_that_are_reached_together(self):
        """A contact as two: of equal shares they are one limit; of others, although they slip together, two."""
        if not PROGRAM:
            self.skipTest("without the checker in C")
        whole = json.loads((HERE / "certificates/chain3_1.2585.json").read_text())
        contacts = whole["model"]["contacts"]
        shares = lambda *parts: [{**contacts[0], **{k: str(part * float(contacts[0][k])) for k in ("tangential_stiffness", "preload")}} for part in parts]
        events = [{**e, **{k: [float(v) for v in e[k]] for k in "xv"}, "t": float(e["t"]), "state": e["state"][0] + e["state"]} for e in whole["events"]]
        candidate = {k: whole[k] for k in ("omega", "multiple", "response")} | {"events": events}
        candidate["model"] = {**whole["model"], "contacts": shares(0.5, 0.5) + contacts[1:]}
        run = subprocess.run([PROGRAM, "complete", "-", "-o", "-"], input=json.dumps(candidate), capture_output=True, text=True)
        made = json.loads(run.stdout)["certificate"]
        self.assertEqual(judged(made)["verdict"], "accepted")
        made["model"]["contacts"][:2] = shares(0.25, 0.75)
        self.assertRegex(judged(made)["reason"] or "accepted", "^two independent transitions at once")

    def test_null_is_no_claim(self):
        data = json.loads(CERTIFICATES[0].read_text())
        for name in data["claims"]:
            wanted = "wrong" if "radius" in name else "accepted"
            self.assertEqual(judged({**data, "claims": {**data["claims"], name: None}})["verdict"], wanted, name)
        self.assertEqual(judged({**data, "claims": None})["verdict"], "wrong")
        self.assertEqual(judged({**data, "claims": {**data["claims"], "stability": None, "multiplier": None}, "vectors": None})["verdict"], "accepted")

    def test_another_orbit_within_the_radius_of_uniqueness(self):
        """case2_9_stable and _unstable have the same letters: a radius that holds both is refused."""
        stable, other = (json.loads((HERE / f"certificates/case2_9_{name}.json").read_text()) for name in ("stable", "unstable"))
        distance = max(abs(float(a[k][0]) - float(b[k][0])) / float(stable["scales"][k]) for a, b in zip(stable["events"], other["events"]) for k in "xv")
        distance = max([distance] + [abs(float(a["t"]) - float(b["t"])) / float(stable["scales"]["t"]) for a, b in zip(stable["events"], other["events"])])
        stable["claims"]["uniqueness_radius"] = f"{1.01 * distance:.6g}"
        self.assertIn("existence: ", judged(stable)["reason"])

    def test_wrong_sequences_whose_equations_hold(self):
        lines = (HERE / "resolved.jsonl").read_text().splitlines()
        self.assertGreaterEqual(len(lines), 15)
        for line in lines:
            answer = judged(line)
            self.assertEqual(answer["verdict"], "rejected")
            self.assertTrue(answer["reason"].startswith("segment ") and answer["reason"].endswith(("it is negative", "sign not decided")), answer["reason"])
            self.assertIsNotNone(answer["uniqueness_radius"])  # the equations do hold, there is one zero

    def test_damaged_files(self):
        good = CERTIFICATES[0].read_text()
        data = json.loads(good)
        broken = ["", " ", "{", "[" * 100000, "[]", "null", good[:-20], good.replace('"-5.0"', '"1e999999999"'), good.replace('"-5.0"', '"1e401"'),
                  good.replace('"-5.0"', "-5.0"), good.replace('"-5.0"', '"NaN"'), good.replace('"-5.0"', "NaN"), good.replace('"-5.0"', '"' + "1" * 121 + '"'),
                  good.replace('"multiple": 1', '"multiple": ' + "9" * 5000), good.replace('"multiple": 1', '"multiple": true'), good + "x",
                  good.replace('"O"', '"OO"'), good.replace('"O"', '"N"'), good.replace('"45.0"', '"90"'), '{"model":' * 5000]
        for text in broken:
            self.assertEqual(judged(text)["verdict"], "wrong", text[:60])
        for key in data:
            if key not in ("compared", "vectors"):
                self.assertEqual(judged({k: v for k, v in data.items() if k != key})["verdict"], "wrong", key)
        status, out, _ = quietly(CERTIFICATES[0], HERE / "nothing.json")
        self.assertEqual(status, 2)
        self.assertRegex(out, r"nothing\.json: wrong: No such file")

    def test_command_line(self):
        self.assertEqual(quietly()[0], 64)
        self.assertEqual(quietly("--format", "xml", CERTIFICATES[0])[0], 64)
        status, out, _ = quietly("--format=text", CERTIFICATES[0])
        self.assertEqual(status, 0)
        self.assertIn(".json: accepted, stable; amplitude 2.429676339589721", out)
        lines = "".join(json.dumps(json.loads(path.read_text())) + "\n" for path in CERTIFICATES[:2]) + "[]\n"
        run = subprocess.run([sys.executable, check.__file__, "-"], input=lines, capture_output=True, text=True)
        self.assertEqual((run.returncode, [json.loads(line)["verdict"] for line in run.stdout.splitlines()]), (2, ["accepted", "accepted", "wrong"]))


if __name__ == "__main__":
    PROGRAM = sys.argv.pop(1) if len(sys.argv) > 1 and not sys.argv[1].startswith("-") else None
    unittest.main()
