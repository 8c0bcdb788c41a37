"""tmdsimpy.py - runs tmdsimpy (J. H. Porter, MIT) on the suite, by its public functions; nothing of it is stored here.

    python3 tmdsimpy.py TMDSIMPY_FOLDER SUITE_FOLDER OUT.json [--refined H Nt] [H Nt [NAME...]]      8 and 128, as in its examples

A case that its forces cannot say has no results; friction under a normal load that varies wants its ElasticDryFriction2D, and with it JAX.
Solutions: Continuation over the case's frequencies, then NonlinearSolver on hbm_res at each that the curve passes;
--refined H Nt: from there NonlinearSolver with the harmonics that the case asks, at most H, and Nt samples.
"""
import contextlib
import io
import json
import pathlib
import sys

import numpy as np

sys.path.insert(0, sys.argv[1])
sys.path[:] = [p for p in sys.path if pathlib.Path(p or ".").resolve() != pathlib.Path(__file__).resolve().parent]  # this file has its name
from tmdsimpy.continuation import Continuation  # noqa: E402
from tmdsimpy.nlforces.general_poly_stiffness import GenPolyForce  # noqa: E402
from tmdsimpy.nlforces.vector_jenkins import VectorJenkins  # noqa: E402
from tmdsimpy.nlforces.unilateral_spring import UnilateralSpring  # noqa: E402
from tmdsimpy.solvers import NonlinearSolver  # noqa: E402
from tmdsimpy.utils import harmonic as hutils  # noqa: E402
from tmdsimpy.vibration_system import VibrationSystem  # noqa: E402

try:
    from tmdsimpy.jax.nlforces.elastic_dry_fric_2d import ElasticDryFriction2D
except ImportError:
    ElasticDryFriction2D = None


def force_of(c):
    """The contact as one of its forces, and a static load that goes with it (N0 along the normal); None: it has none."""
    row = {k: np.array([c[k]], float) for k in ("tangent", "normal", "direction") if k in c}
    if c.get("law") == "polynomial":
        powers = [int(p) for p in c["coefficients"]]
        return GenPolyForce(row["direction"], row["direction"].T, np.array([[float(v) for v in c["coefficients"].values()]]), np.array([[p] for p in powers])), 0
    if "law" in c:
        return None
    if "normal" not in c:
        return VectorJenkins(row["tangent"], row["tangent"].T, c["tangential_stiffness"], c["friction"] * c["preload"]), 0
    preload = max(c["normal_stiffness"] * c["gap"], 0)
    if "tangent" not in c:
        return UnilateralSpring(row["normal"], row["normal"].T, c["normal_stiffness"], Npreload=preload, delta=-c["gap"]), 0
    if ElasticDryFriction2D is None:
        return None
    Q = np.vstack([row["tangent"], row["normal"]])
    return ElasticDryFriction2D(Q, Q.T, c["tangential_stiffness"], c["normal_stiffness"], c["friction"], u0=0.0, meso_gap=-c["gap"]), preload * row["normal"][0]


def top(y):
    """Of the parabola through the largest sample and its neighbours."""
    i = y.argmax()
    a, m, c = y[i - 1], y[i], y[(i + 1) % y.size]
    return m + (c - a) ** 2 / (8 * (2 * m - a - c))


def solve_case(case, H, Nt, fine):
    model, h, rows = case["model"], np.arange(H + 1), []
    system = VibrationSystem(np.array(model["mass"], float), np.array(model["stiffness"], float), C=np.array(model["damping"], float))
    n = system.M.shape[0]
    load = np.zeros((hutils.Nhc(h), n))
    for entry in model["loads"]:
        if entry["harmonic"] > H:
            return rows
        i = 2 * entry["harmonic"] - 1 if entry["harmonic"] else 0
        load[i] += entry["cos"]
        load[i + 1] += np.array(entry["sin"]) if entry["harmonic"] else 0
    for contact in model["contacts"]:
        found = force_of(contact)
        if found is None:
            return rows
        system.add_nl_force(found[0])
        load[0] += found[1]
    Fl, omega = load.ravel(), sorted(case["omega"])
    start, end, solver = 0.8 * omega[0], 1.25 * omega[-1], NonlinearSolver()
    residual = lambda Uw: system.hbm_res(Uw, Fl, h, Nt=Nt)  # noqa: E731
    linear = np.linalg.solve(hutils.harmonic_stiffness(system.M, system.C, system.K, start, h)[0], Fl)
    U = solver.nsolve(lambda U: residual(np.r_[U, start])[:2], linear, verbose=False)[0]
    scale = hutils.harmonic_wise_conditioning(np.r_[U, start], n, h, delta=1e-3 * np.abs(U).max())
    scale[-1] = end
    config = {"DynamicCtoP": True, "MaxSteps": 4000, "dsmin": 1e-3, "dsmax": 0.1, "verbose": -1, "xtol": 1e-9 * Fl.size, "corrector": "Ortho"}
    curve = Continuation(solver, ds0=0.05, CtoP=scale, RPtoC=1 / np.abs(np.diag(residual(np.r_[U, start])[1])).max(), config=config)
    points = curve.continuation(residual, np.r_[U, start], start, end)
    stages = [(h, Nt)] + ([(np.arange(max(H, min(fine[0], case["harmonics"])) + 1), fine[1])] if fine else [])
    for w in case["omega"]:
        for j in np.nonzero((points[:-1, -1] - w) * (points[1:, -1] - w) <= 0)[0]:
            a, b = points[j], points[j + 1]
            U = (a + (w - a[-1]) / (b[-1] - a[-1]) * (b - a))[:-1]
            for hs, Ns in stages:
                load = np.r_[Fl, np.zeros(hutils.Nhc(hs) * n - Fl.size)]
                U = np.r_[U, np.zeros(load.size - U.size)]
                residual_at = lambda U: system.hbm_res(np.r_[U, w], load, hs, Nt=Ns, aft_tol=1e-12 if fine else 1e-7)[:2]  # noqa: B023, E731
                U, R, _, _ = solver.nsolve(residual_at, U, verbose=False, xtol=1e-12)
            if not np.abs(R).max() < (1e-9 if fine else 1e-7) * np.abs(Fl).max():
                continue
            y = U.reshape(-1, n) @ case["response"]
            spectrum = np.zeros(65536, complex)
            spectrum[hs[1:]] = y[1::2] - 1j * y[2::2]
            motion = 65536 * np.fft.ifft(spectrum).real
            rows.append({"omega": w, "amplitude": (top(motion) + top(-motion)) / 2, "mean": y[0], "a1": y[1], "b1": y[2]})
    return rows


def main():
    arguments, fine = sys.argv[2:], None
    if "--refined" in arguments:
        at = arguments.index("--refined")
        fine = [int(x) for x in arguments[at + 1:at + 3]]
        del arguments[at:at + 3]
    suite, out, rest = pathlib.Path(arguments[0]), arguments[1], arguments[2:]
    H, Nt = (int(rest[0]), int(rest[1])) if len(rest) > 1 else (8, 128)
    results = {}
    for name in rest[2:] or json.loads((suite / "suite.json").read_text())["cases"]:
        case = json.loads((suite / "cases" / f"{name}.json").read_text())
        try:
            with contextlib.redirect_stdout(io.StringIO()):  # it reports every step
                rows = solve_case(case, H, Nt, fine)
        except (AssertionError, ValueError, np.linalg.LinAlgError) as problem:
            print(f"{name}: {problem}", flush=True)
            continue
        print(name, len(rows), flush=True)
        if rows:
            results[name] = rows
    pathlib.Path(out).write_text(json.dumps({"program": f"tmdsimpy, H = {H}, Nt = {Nt}" + (f", refined {fine}" if fine else ""), "cases": results}, indent=1))


if __name__ == "__main__":
    main()
