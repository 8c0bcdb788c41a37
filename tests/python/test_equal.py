"""test_equal.py - every function of the package says what the command's csv says, to the last digit, of one degree of freedom
and of several."""
import json
import os
import subprocess
import tempfile

from common import CASE2, CHAIN, COMMAND, SOURCE, SPACE, Test, main, np, table

import hbmcheck

MEASURES = "omega branch amplitude max min rms mean harmonic_1 multiplier residual iterations".split()


class Equal(Test):
    def same_solutions(self, found, said, responses):
        self.same_columns(found, said, MEASURES)
        self.assertEqual(list(found.contact), said["contact"])
        self.assertEqual(list(found.stable), said["stable"])
        self.assertEqual(list(found.mean_free), said["mean_free"])
        if responses:
            self.assertEqual(list(found.response), said["response"])

    def test_curves(self):
        for case, responses in ((CASE2, False), (CHAIN, True)):
            with self.subTest(case=case):
                self.same_solutions(hbmcheck.Model.from_yaml(case).frf(), table("frf", case), responses)

    def test_solutions_at_given_frequencies(self):
        """Outside the sweep, too."""
        for case, at, responses in ((CASE2, [2.5, 8], False), (CHAIN, [1.2585, 1.9], True)):
            with self.subTest(case=case):
                said = table("frf", case, "--at", ",".join(map(str, at)))
                self.same_solutions(hbmcheck.Model.from_yaml(case).frf(at=at), said, responses)

    def test_omegas_of_a_case_in_cycles(self):
        """They are in rad here; the columns have both."""
        model = hbmcheck.Model.from_yaml(CHAIN, set={"sweep.frequency": [0.2, 0.3]})
        found = model.frf(at=[1.485, 1.9])
        np.testing.assert_allclose(np.unique(found.omega), [1.485, 1.9], rtol=1e-15)
        np.testing.assert_allclose(found.frequency, found.omega / (2 * np.pi), rtol=1e-15)

    def test_coefficients_make_the_measures(self):
        found = hbmcheck.Model.from_yaml(CHAIN).frf(at=1.9)
        np.testing.assert_array_equal(found.coefficients[:, 0], found["mean"])
        np.testing.assert_array_equal(np.hypot(*found.coefficients[:, 1:3].T), found.harmonic_1)
        x = found.wave(4096)
        self.assertEqual(x.shape, (3, 4096))
        np.testing.assert_allclose([x.max(axis=1), x.min(axis=1), x.mean(axis=1)], [found.max, found.min, found["mean"]], rtol=1e-5, atol=1e-12)

    def test_every_other_command(self):
        """Their first table is the csv."""
        model = hbmcheck.Model.from_yaml(CASE2)
        for command, options, names in (("modes", {}, "mode omega_open damping_stuck"),
                                        ("advise", {"error": 1e-2, "at": 8.0}, "harmonics samples error next_smaller_error"),
                                        ("gate", {"at": [6, 8]}, "omega branch allowed found"),
                                        ("prove", {"at": 9.0}, "omega amplitude_low amplitude_high radius")):
            with self.subTest(command=command):
                said = table(command, CASE2, *(w for name, value in options.items()
                                               for w in (f"--{name}", ",".join(map(str, np.atleast_1d(value))))))
                found = getattr(model, command)(**options)
                self.same_columns(found, said, names.split())
                self.assertEqual(found.exit_code, 0)
        self.assertEqual(len(model.modes().tables["Contacts at rest"]), 1)
        with tempfile.TemporaryDirectory() as folder:
            blade = hbmcheck.Model.from_yaml(SOURCE / "cases/meshes/blade.yaml")
            self.assertEqual(blade.reduce(os.path.join(folder, "reduced"), modes=4).modes.tolist(), [4])
            self.assertEqual(hbmcheck.Model.from_yaml(os.path.join(folder, "reduced/blade.yaml")).responses, blade.responses)

    def test_replaced(self):
        """The same as the same settings from the start; the model itself stays."""
        model = hbmcheck.Model.from_yaml(CASE2, set={"hbm.harmonics": 3})
        other = model.replace({"contacts[0].gap": -4}, hbm={"harmonics": 5}, sweep=(3, 9))
        self.same_solutions(other.frf(), table("frf", CASE2, *(w for s in ("contacts[0].gap=-4", "hbm.harmonics=5", "sweep.omega=3,9")
                                                               for w in ("--set", s))), False)
        self.assertEqual(model.frf(at=5).harmonics.tolist(), [3])
        self.assertRaises(hbmcheck.BadInput, model.replace, hbm=3)
        self.assertRaises(hbmcheck.BadInput, model.replace, {"hbm.harmonic": 3})

    def test_steady_states(self):
        for case, at in ((CASE2, "6,8"), (CHAIN, "1.9")):
            with self.subTest(case=case):
                said = table("transient", case, "--at", at)
                found = hbmcheck.Model.from_yaml(case).transient([float(a) for a in at.split(",")])
                self.same_columns(found, said, "omega amplitude max min rms mean harmonic_1 periods closure "
                                               "period_multiple period steps multiplier free_sliders".split())
                np.testing.assert_allclose(found.period * found.omega, 2 * np.pi * found.period_multiple, rtol=1e-15)
                self.assertEqual(list(found.contact), said["contact"])
                np.testing.assert_allclose(found.wave.max(axis=1), found["max"], rtol=1e-3)  # of 512 samples

    def test_comparisons(self):
        for case, at in ((CASE2, "6,8"), (CHAIN, "1.9")):
            with self.subTest(case=case):
                said = table("compare", case, "--at", at)
                found = hbmcheck.Model.from_yaml(case).compare([float(a) for a in at.split(",")])
                self.same_columns(found, said, "omega branch hbm_amplitude transient_amplitude amplitude_error "
                                               "harmonic_1_error mean_error waveform_error from_truncation "
                                               "from_regularisation orbit_amplitude orbit_error hbm_predicted "
                                               "transient_predicted".split())
                self.assertEqual(list(found.verdict), said["verdict"])

    PERIOD = "normal_min normal_max traction_max slip_distance work".split()

    def same_contacts(self, found, said, names, regime="regime", period=PERIOD):
        self.same_columns(found, said, ["omega", "contact", *period])
        self.assertEqual(list(found[regime]), said[regime])
        if "name" in said:
            self.assertEqual([names[j] for j in found.contact], said["name"])

    def test_what_contacts_do_in_solutions(self):
        for case, sweep, at in ((CASE2, "3,10", [6, 8]), (CHAIN, "1.2,2", [1.2585, 1.9]), (SPACE, "12,12.5", [12.5])):
            with self.subTest(case=case):
                model = hbmcheck.Model.from_yaml(case, set={"sweep.omega": sweep})
                options = ["--set", f"sweep.omega={sweep}", "--contacts"]
                curve = model.frf(contacts=True)
                self.same_contacts(curve.contacts, table("frf", case, *options, which=1), model.contacts)
                first = curve.contacts.of(model.contacts[0])
                self.assertEqual(list(first.contact), [0] * (len(curve) // len(model.responses)))
                said = table("frf", case, "--at", ",".join(map(str, at)), *options, which=1)
                found = curve.at(at, contacts=True)
                self.same_contacts(found.contacts, said, model.contacts)
                np.testing.assert_array_equal(found.omega[found.contacts.row], found.contacts.omega)
                self.assertIsNone(curve.at(at).contacts)

    def test_what_contacts_do_in_steady_states(self):
        for case, at in ((CASE2, "6,8"), (CHAIN, "1.485,1.9")):
            with self.subTest(case=case):
                model = hbmcheck.Model.from_yaml(case)
                omega = [float(a) for a in at.split(",")]
                found = model.transient(omega, contacts=True)
                said = table("transient", case, "--at", at, "--contacts", which=1)
                self.same_contacts(found.contacts, said, model.contacts)
                self.assertIsNone(model.transient(omega).contacts)

    def test_what_contacts_do_on_both_sides(self):
        for case, at in ((CASE2, "6,8"), (CHAIN, "1.9")):
            with self.subTest(case=case):
                model = hbmcheck.Model.from_yaml(case)
                omega = [float(a) for a in at.split(",")]
                found, said = model.compare(omega, contacts=True).contacts, table("compare", case, "--at", at, "--contacts", which=1)
                for side in ("hbm_", "transient_"):
                    period = [side + name for name in self.PERIOD]
                    self.same_contacts(found, said, model.contacts, side + "regime", period)
                self.same_columns(found, said, ["work_error", "normal_error", "branch"])
                self.assertEqual(list(found.contact_verdict), said["contact_verdict"])
                self.assertIsNone(model.compare(omega).contacts)

    def same_hypotheses(self, found, case, *options):
        """The best of them, as the command writes them."""
        done = subprocess.run([COMMAND, "verify", case, *options, "--format", "json", "--quiet"], capture_output=True, text=True)
        said = json.loads(done.stdout)["Hypotheses"]
        best = range(len(said))
        self.assertGreater(len(said), 2)
        self.assertGreater(len(found), len(said))
        self.assertEqual([found.cause[k] for k in best], [row["cause"] for row in said])
        self.assertEqual([found.quantity[k] for k in best], [row["quantity"] for row in said])
        self.assertEqual([found.slider_restart[k] for k in best], [row["slider_restart"] or "" for row in said])
        for name in "distance omega_factor value_factor harmonics samples".split():
            np.testing.assert_array_equal(found[name][best], [np.nan if row[name] is None else row[name] for row in said], name)

    def same_points(self, found, said):
        self.same_columns(found, said, "omega value nearest error branch".split())
        self.assertEqual(list(found.verdict), said["verdict"])

    def test_a_curve_with_a_mistake(self):
        case, curve = SOURCE / "cases/verify/case2.yaml", SOURCE / "cases/verify/no_static.csv"
        said = table("verify", case, "--against", curve, "--columns", "omega=1,harmonic_1=2")
        lines = [line for line in curve.read_text().splitlines() if line[0].isdigit()]
        omega, value = np.array([line.split(",")[:2] for line in lines], dtype=float).T
        found = hbmcheck.Model.from_yaml(case).verify(omega, value, quantity="harmonic_1")
        self.same_points(found, said)
        self.same_hypotheses(found.hypotheses, case, "--against", str(curve), "--columns", "omega=1,harmonic_1=2")
        self.assertEqual(found.cause, "no_static_harmonic")
        self.assertIn("harmonic 0 is missing", found.sentence)
        self.assertEqual(found.exit_code, 1)

    def test_a_curve_of_a_structure(self):
        at = [0.9, 1.0, 1.1, 1.9]
        model = hbmcheck.Model.from_yaml(CHAIN, set={"hbm.harmonics": 40})
        values = model.frf(at=at).of("2")
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "curve.csv")
            np.savetxt(path, np.c_[values.omega, values.amplitude], delimiter=",", fmt="%.17g")
            said = table("verify", CHAIN, "--against", path, "--columns", "omega=1,amplitude=2", "--response", "2",
                         "--set", "hbm.harmonics=40")
        found = model.verify(values.omega, values.amplitude, response="2")
        self.same_points(found, said)
        self.assertEqual(found.cause, "none")
        model = hbmcheck.Model.from_yaml(CHAIN)  # of fewer harmonics: to search for a cause takes a tenth then
        values = model.frf(at=at).of("2")
        self.assertEqual(model.verify(values.omega, values.amplitude, response="1").cause, "other_response")

    def test_contact_forces(self):
        u, v, u2 = [0.01, 0.2, -0.1, 0.03, 0.02], [0, 0.004, 0.003], [0, 0.1, 0.05]
        text = lambda m: ",".join(map(repr, m))
        for case, contact, second in ((CASE2, "0", False), (SPACE, "foot", True)):
            model = hbmcheck.Model.from_yaml(case)
            options = ["--contact", contact, "--motion-u", text(u), "--motion-v", text(v)]
            options += ["--motion-u2", text(u2)] if second else []
            said = table("contact", case, *options, "--samples", 64)
            kept = max(map(int, said["harmonic"]))
            for samples, suffix in ((None, ""), (64, "_64")):
                with self.subTest(case=case, samples=samples):
                    found = model.contact_force(u, v, u2 if second else None, contact=model.contacts[0],
                                                samples=samples, harmonics=kept)
                    for force, name in ((found.T, "tangential"), (found.T2, "tangential_2"), (found.N, "normal")):
                        if force is None:
                            continue
                        mine = [i for i, f in enumerate(said["force"]) if f == name]
                        cos, sin = ([said[part + suffix][i] for i in mine] for part in ("cos", "sin"))
                        self.same(np.r_[force[0], force[1::2]], cos, name)
                        self.same(force[2::2], sin[1:], name)

    def test_a_model_of_arrays_is_its_case_file(self):
        """Numbers that no short decimal stands for."""
        M, K = np.diag([1 / 3, 0.02]), np.array([[680.1, -40 / 7], [-40 / 7, 40]])
        contacts = [dict(tangential_stiffness=200, normal_stiffness=300, friction=0.3, gap=0.1 / 3, tangent=[1, -1],
                         normal=np.array([0.0, 1.0]))]
        model = hbmcheck.Model(M, {"rayleigh": [0.5, 1e-5]}, K, contacts=contacts, sweep=(10, 30), names=["tip", "root"],
                               forcing=[{"dof": "tip", "amplitude": 10 / 3}], response=["tip", [1, -1]],
                               hbm={"harmonics": 5})
        self.assertEqual(model.responses, ["tip", "tip-root"])
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "case.yaml")
            with open(path, "w", encoding="utf-8") as out:
                out.write(model.text)
            self.same_solutions(model.frf(at=[20.0]), table("frf", path, "--at", "20"), True)

    def test_an_oscillator_of_numbers(self):
        contact = dict(tangential_stiffness=100, normal_stiffness=1000, friction=0.3, angle_deg=45, gap=-5)
        model = hbmcheck.Model(1, 0.4, 40, forcing=100, contacts=[contact], sweep=(3, 20), hbm={"harmonics": 10})
        self.same_solutions(model.frf(), table("frf", CASE2), False)


if __name__ == "__main__":
    main()
