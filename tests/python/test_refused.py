"""test_refused.py - what is wrong is an exception in the library's words: shapes, NaN, freed handles, work that stops."""
import tempfile

from common import CASE2, CHAIN, SPACE, Test, main, np

import hbmcheck

EYE = np.eye(2)


class Refused(Test):
    def refuses(self, words, call, *arguments, kind=hbmcheck.BadInput, **named):
        with self.assertRaises(kind) as caught:
            call(*arguments, **named)
        self.assertIn(words, str(caught.exception))
        return caught.exception

    def test_case_files(self):
        read = hbmcheck.Model.from_yaml
        self.refuses("/no/such/file: cannot be opened", read, "/no/such/file", kind=hbmcheck.Error)
        self.refuses("/no/such/file: cannot be opened", read, "/no/such/file", kind=FileNotFoundError)
        self.refuses("hbm.harmonic", read, CASE2, set={"hbm.harmonic": 3})
        with tempfile.NamedTemporaryFile("w", suffix=".yaml") as case:
            case.write("oscillator: {mas: 1}\n")
            case.flush()
            self.refuses(f"{case.name}:1:14: unknown key `mas`", read, case.name)
        self.refuses("scene:1:14: unknown key", hbmcheck.Model.from_text, "oscillator: {mas: 1}", name="scene")

    def test_matrices(self):
        model = hbmcheck.Model
        self.refuses("K: shape (3, 3)", model, EYE, None, np.eye(3))
        self.refuses("C: shape (3,)", model, EYE, np.ones(3), EYE)
        self.refuses("M: shape (2, 3)", model, np.ones((2, 3)), None, EYE)
        self.refuses("M: shape (0,)", model, [], None, EYE)
        self.refuses("M: shape (1, 1, 1)", model, [[[1]]], None, EYE)
        self.refuses("K: not all of it is finite", model, EYE, None, [[1, np.nan], [0, 1]])
        self.refuses("M: complex", model, EYE * 1j, None, EYE)
        self.refuses("M: not an array of real numbers", model, "heavy", None, EYE)
        self.refuses("M is a number, and K or C is not", model, 1, None, EYE)
        self.refuses("forcing: a number", model, EYE, None, EYE, forcing=3.0)
        self.refuses("positive definite", model, -EYE, None, EYE, sweep=(1, 2))
        self.refuses("contacts[0].tangent: shape (3,), expected (2,)", model, EYE, None, EYE,
                     contacts=[{"tangent": [1, 0, 0]}])
        self.refuses("contacts[0]: int, expected a dictionary", model, EYE, None, EYE, contacts=[3])
        self.refuses("unknown key `tangential_stifness`", model, EYE, None, EYE, sweep=(1, 2),
                     contacts=[{"tangential_stifness": 3, "tangent": [1, 0]}])
        self.refuses("forcing.amplitude is `NaN`", model, 1, 0.1, 1, forcing=np.nan, sweep=(1, 2))
        self.refuses("sweep", model, 1, 0.1, 1, forcing=1)
        self.refuses("is neither a number", model, 1, 0.1, 1, hbm={"harmonics": object()})

    def test_frequencies(self):
        model = hbmcheck.Model.from_yaml(CASE2, set={"compare.omega": [6]})
        for call in (model.transient, model.compare, lambda omega: model.frf(at=omega)):
            self.refuses("omega[1] = nan is not finite", call, [1, np.nan])
            self.refuses("omega[0] = -3.0, expected omega > 0", call, [-3, 2])
            self.refuses("omega: shape (1, 2), expected one dimension", call, [[1, 2]])
            self.refuses("omega: not an array of real numbers", call, ["fast"])
        self.refuses("omega: empty", model.transient, [])
        self.refuses("--at takes at most 1024 numbers", model.transient, np.linspace(3, 4, 1025))
        self.refuses("give --at LIST, or compare.omega in the case", hbmcheck.Model(1, 0.1, 1, forcing=1, sweep=(1, 2)).transient)

    def test_curves_to_verify(self):
        model, omega = hbmcheck.Model.from_yaml(CASE2), np.array([3.5, 4, 4.5])
        self.refuses("amplitude: shape (2,), expected (3,)", model.verify, omega, [1, 2])
        self.refuses("amplitude[1] = nan", model.verify, omega, [1, np.nan, 2])
        self.refuses("value[1] = -1 is too small, expected a number >= 0", model.verify, omega, [1, -1, 2])
        self.refuses("2 points, expected at least 3", model.verify, omega[:2], [1, 2])
        self.refuses("--quantity: 'amplitud' is unknown", model.verify, omega, omega, quantity="amplitud")
        self.refuses("'2.0' is no scatter", model.verify, omega, omega, noise=2)
        self.refuses("response: the case has no 'y', expected one of x", model.verify, omega, omega, response="y")
        self.refuses("response: the case has no 1", model.verify, omega, omega, response=1)
        self.refuses("0 points, expected at least 3", model.verify, [], [])

    def test_options_of_commands(self):
        model = hbmcheck.Model.from_yaml(CASE2)
        self.refuses("unrecognized option '--att', did you mean", model.frf, att=3)
        self.refuses("--count: 'many' is not an integer", model.run, "modes", count="many")
        self.refuses("", model.run, "study")
        self.refuses("a case from memory is not reduced", hbmcheck.Model(1, 0.1, 1, forcing=1, sweep=(1, 2)).reduce, "/tmp/x")

    def test_motions_of_contacts(self):
        model = hbmcheck.Model.from_yaml(CHAIN)
        self.refuses("u: 2 coefficients, expected an odd number", model.contact_force, [1, 2])
        self.refuses("u[1] = inf", model.contact_force, [1, np.inf, 2])
        self.refuses("contact: the case has no 'wall', expected one of ground, between, stop", model.contact_force, [1],
                     contact="wall")
        self.refuses("contact stop has no tangent", model.contact_force, [0, 1, 0], contact="stop")
        self.refuses("contact ground has no second tangent", model.contact_force, u2=[0, 1, 0], contact="ground")
        self.refuses("samples: 4 for 2 harmonics, expected 5", model.contact_force, [0, 1, 0, 1, 0], samples=4)
        self.refuses("samples: 0", model.contact_force, [0, 1, 0], samples=0)
        self.refuses("201 harmonics, expected at most 200", model.contact_force, np.zeros(403))
        space = hbmcheck.Model.from_yaml(SPACE)
        self.assertEqual(len(space.contact_force([0, 0.1, 0], u2=[0, 0, 0.1]).T2), 3)

    def test_what_is_closed(self):
        model = hbmcheck.Model.from_yaml(CASE2)
        curve = model.frf()
        model.close()
        model.close()
        for call in (model.frf, lambda: model.transient(6), lambda: model.compare(6),
                     lambda: model.verify([3, 4, 5], [1, 1, 1]), lambda: model.contact_force([0, 1, 0]),
                     model.modes):
            self.refuses("the model is closed", call, kind=ValueError)
        self.assertEqual(len(curve.at(8)), 3)  # it outlives the model
        with hbmcheck.Model.from_yaml(CASE2) as model:
            self.refuses("the model is in use", model.frf, progress=lambda done: model.close(), kind=ValueError)
        self.refuses("the model is closed", model.frf, kind=ValueError)

    def test_a_curve_that_stops_keeps_what_it_found(self):
        """With steps of one length and two iterations a simple continuation ends at the first fold or kink."""
        model = hbmcheck.Model.from_yaml(CASE2, set={"hbm.continuation": "fixed_step", "hbm.step": 1, "hbm.iterations": 1})
        with self.assertRaises(hbmcheck.Stopped) as caught:
            model.frf()
        stopped = caught.exception
        self.assertIn("residual", str(stopped))
        self.assertIsInstance(stopped.result, hbmcheck.Curve)
        self.assertLess(stopped.result.omega.max(), 20)

    def test_results_name_their_columns(self):
        found = hbmcheck.Model.from_yaml(CHAIN).frf(at=1.9)
        self.refuses("no column amplitud, expected one of omega", lambda: found.amplitud, kind=AttributeError)
        self.refuses("no response 4, expected one of 1, 2, 3", found.of, "4", kind=KeyError)
        self.assertEqual([row["response"] for row in found.rows()], ["1", "2", "3"])

    def test_keywords(self):
        self.refuses("force: unknown argument, did you mean `forcing`?", hbmcheck.Model, 1, 0.4, 40, force=1, sweep=(1, 2))
        self.refuses("hmb: unknown argument, did you mean `hbm`?", hbmcheck.Model, 1, 0.4, 40, forcing=1, hmb={})
        self.refuses("colour: unknown argument", hbmcheck.Model, 1, 0.4, 40, forcing=1, colour="red")

    def test_a_model_counts_its_contacts(self):
        model = hbmcheck.Model.from_yaml(CHAIN)
        self.assertEqual(repr(model), "<Model: 3 responses (1, 2, 3); 3 contacts (ground, between, stop)>")
        self.assertEqual(repr(hbmcheck.Model(1, 0.4, 40, forcing=1, sweep=(1, 9))), "<Model: 1 response (x); 0 contacts>")


if __name__ == "__main__":
    main()
