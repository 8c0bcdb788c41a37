"""One response curve by tmdsimpy; called by versus_peer.py, which writes the problem and reads the curve.

usage: tmdsimpy_curve.py FOLDER PROBLEM CURVE       (FOLDER: its tmdsimpy/ is the package)
  PROBLEM   as in nlvib.m, and: static (force of harmonic 0), dsmax,
            coupled KT KN MU TANGENT... NORMAL...   (gap 0)
  CURVE     a line for each point: omega, |residual|/|force|, the coefficients: 0, cos 1, sin 1, ..., n of each
Printed last, in seconds of processor time: the first solution and the continuation; the residuals and writing; the evaluations.

Jenkins elements and unilateral springs are tmdsimpy's own. Its elastic dry friction with a normal force that varies needs JAX, which Debian
does not have; in its place stands the same element in NumPy (class Coupled), with nothing in a loop over the samples but one number."""
import sys
import time

import numpy as np

folder, problem, curve = sys.argv[1:4]
sys.path.insert(0, folder)

from tmdsimpy.continuation import Continuation  # noqa: E402
from tmdsimpy.nlforces.nonlinear_force import HystereticForce  # noqa: E402
from tmdsimpy.nlforces.unilateral_spring import UnilateralSpring  # noqa: E402
from tmdsimpy.nlforces.vector_jenkins import VectorJenkins  # noqa: E402
from tmdsimpy.solvers import NonlinearSolver  # noqa: E402
from tmdsimpy.utils import harmonic  # noqa: E402
from tmdsimpy.vibration_system import VibrationSystem  # noqa: E402


class Coupled(HystereticForce):
    """T = clamp(T_before + kt du, -mu N, mu N), N = max(kn v, 0); the slider starts from 0; two periods, as in tmdsimpy's own."""

    def __init__(self, Q, T, kt, kn, mu):
        super().__init__(Q, T)
        self.kt, self.kn, self.mu = kt, kn, mu

    def local_force_history(self, unlt, unltdot, h, cst, unlth0, max_repeats=2, atol=1e-10, rtol=1e-10):
        samples, n_coefficients = cst.shape
        u, v = unlt.T
        closed = (v > 0).astype(float)
        normal = self.kn * v * closed
        slip = np.zeros(2 * samples)  # the sign of slip at each of the samples of two periods, 0: stuck
        traction = np.empty(samples)
        force = previous = 0.0
        wanted, limit = (self.kt * u).tolist(), (self.mu * normal).tolist()
        for i in range(2 * samples):
            k = i % samples
            force += wanted[k] - previous
            previous = wanted[k]
            if force >= limit[k]:
                force, slip[i] = limit[k], 1.0
            elif force <= -limit[k]:
                force, slip[i] = -limit[k], -1.0
            if i >= samples:
                traction[k] = force
        last = np.maximum.accumulate(np.where(slip != 0, np.arange(2 * samples), -1))[samples:]
        at = last % samples
        since = np.where(last >= 0, slip[last], 0.0)[:, None]  # a slider that never slipped hangs at 0
        moved = np.where(last[:, None] >= 0, cst - cst[at], cst)
        slope = np.zeros((samples, 2, 2, n_coefficients))
        slope[:, 0, 0] = self.kt * moved
        slope[:, 0, 1] = since * self.mu * self.kn * closed[at, None] * cst[at]
        slope[:, 1, 1] = self.kn * closed[:, None] * cst
        return np.column_stack((traction, normal)), slope, np.zeros_like(slope)


p = {"contacts": []}
with open(problem) as lines:
    for line in lines:
        word, *numbers = line.split()
        x = np.array([float(a) for a in numbers])
        if word in ("jenkins", "spring", "coupled"):
            p["contacts"].append((word, x))
        else:
            p[word] = x
n, H, samples = int(p["n"][0]), int(p["H"][0]), int(p["N"][0])
M, D, K = (p[name].reshape(n, n) for name in ("M", "D", "K"))
vibration = VibrationSystem(M, K, C=D)
for word, x in p["contacts"]:
    if word == "coupled":
        Q = x[3:].reshape(2, n)
        vibration.add_nl_force(Coupled(Q, Q.T, *x[:3]))
    else:
        Q = x[2:].reshape(1, n)
        vibration.add_nl_force(VectorJenkins(Q, Q.T, *x[:2]) if word == "jenkins" else UnilateralSpring(Q, Q.T, x[0], delta=x[1]))
h = np.arange(H + 1)
load = np.zeros(harmonic.Nhc(h) * n)
load[:n], load[n:2 * n] = p["static"], p["force"]
lam0, lam1 = p["sweep"]
began = time.process_time()
evaluations = 0


def residual(uw):
    global evaluations
    evaluations += 1
    return vibration.hbm_res(uw, load, h, Nt=samples)


solver = NonlinearSolver()
stuck = K + sum(x[0] * np.outer(x[2:], x[2:]) for word, x in p["contacts"] if word == "jenkins")
guess = np.zeros_like(load)
q = np.linalg.solve(stuck - lam0**2 * M + 1j * lam0 * D, p["force"])
guess[n:2 * n], guess[2 * n:3 * n] = q.real, -q.imag
first, _, slope, _ = solver.nsolve(lambda u: residual(np.hstack((u, lam0)))[:2], guess, verbose=False, xtol=1e-12)
start = np.hstack((first, lam0))
scale = harmonic.harmonic_wise_conditioning(start, n, h, delta=float(p["scale"][0]))
scale[-1] = abs(lam1 - lam0)
settings = {"DynamicCtoP": True, "TargetNfev": 200, "MaxSteps": 8000, "dsmin": 1e-3 * p["dsmax"][0], "dsmax": p["dsmax"][0], "verbose": -1,
            "xtol": 1e-9 * load.size, "corrector": "Ortho", "FracLamList": [0.5, 0.9, 0.1, 1.0]}
path = Continuation(solver, ds0=0.5 * p["dsmax"][0], CtoP=scale, RPtoC=1 / np.max(np.abs(np.diag(slope * scale[:-1]))), config=settings)
found = path.continuation(residual, start, lam0, lam1)
seconds, evaluated = time.process_time() - began, evaluations
size = np.linalg.norm(p["force"])
with open(curve, "w") as out:
    for x in found:
        out.write(" ".join("%.17g" % a for a in (x[-1], np.linalg.norm(residual(x)[0]) / size, *x[:-1])) + "\n")
print("%.6f %.6f %d" % (seconds, time.process_time() - began - seconds, evaluated))
