#!/usr/bin/env python3
"""Response curves by tmdsimpy for ../../../../cases/verify/: the frequency response of an oscillator on a unilateral
spring, by harmonic balance with sampled forces (AFT) and its own continuation.

    tmdsimpy_curves.py TMDSIMPY COMMIT TARGET
      TMDSIMPY  a checkout of https://github.com/tmd-lab/tmdsimpy; needs numpy and scipy
      COMMIT    what it is a checkout of, for the files' remarks
      TARGET    the folder to write into

tmdsimpy's unilateral spring: f = k max(q - delta, 0) - Npreload, so that ours is that with delta = -gap and, for a
preload, Npreload = k gap. Case 2 of the paper never slips, so it is one of kt cos^2 + kn sin^2 from x = -gap/sin(angle)
on. Its solutions are coefficients; the columns are their 2-norm and the modulus of harmonic 1.
"""
import datetime
import math
import os
import sys

import numpy as np


def curve(spring, force, omega_from, omega_to, step, harmonics, samples, most_steps, dynamic):
    """Rows of omega, X0, a1, b1, ..., in the continuation's order, unconverged ones included."""
    from tmdsimpy import Continuation, NonlinearSolver, VibrationSystem
    from tmdsimpy.nlforces import UnilateralSpring
    one = np.array([[1.0]])
    mass, damping, stiffness, k, gap = spring
    system = VibrationSystem(mass * one, stiffness * one, damping * one)
    system.add_nl_force(UnilateralSpring(one, one, np.array([k]), k * max(gap, 0), np.array([-gap])))
    load = np.zeros(2 * harmonics + 1)
    load[1] = force
    linear = force / (stiffness + k * (gap > 0) - omega_from**2 * mass + 1j * omega_from * damping)
    start = np.zeros(2 * harmonics + 2)
    start[1], start[2], start[-1] = linear.real, -linear.imag, omega_from
    settings = {"MaxSteps": most_steps, "DynamicCtoP": dynamic, "verbose": -1, "xtol": 1e-10}
    scale = np.append(np.ones(2 * harmonics + 1), omega_from)
    path = Continuation(NonlinearSolver(), ds0=step, CtoP=scale, config=settings)
    solutions = path.continuation(lambda U: system.hbm_res(U, load, np.arange(harmonics + 1), Nt=samples), start,
                                  omega_from, omega_to)
    return np.column_stack([solutions[:, -1], solutions[:, :-1]])


def write(name, what, **how):
    rows = curve(**how)
    with open(os.path.join(sys.argv[3], name), "w", encoding="ascii") as file:
        print(f"# {what}, by tmdsimpy (commit {sys.argv[2]}) with numpy {np.__version__}, {datetime.date.today()}.",
              file=file)
        print("# Made by tests/compare/verify/peers/tmdsimpy_curves.py; nothing was left out.", file=file)
        print(f"# H = {how['harmonics']}, N = {how['samples']}, step {how['step']:g} from omega {how['omega_from']:g} "
              f"to {how['omega_to']:g}, at most {how['most_steps']} steps, "
              f"{'with' if how['dynamic'] else 'without'} dynamic scaling.", file=file)
        print("omega,norm,harmonic_1", file=file)
        for omega, *X in rows:
            print(f"{omega:.10g},{math.hypot(*X):.10g},{math.hypot(X[1], X[2]):.10g}", file=file)


def main():
    sys.path.insert(0, sys.argv[1])
    case2 = {"spring": (1.0, 0.4, 40.0, 550.0, -5 * math.sqrt(2)), "force": 100.0, "omega_from": 3.0, "omega_to": 20.0}
    gap = {"force": 0.2, "omega_from": 0.4, "omega_to": 2.5}
    write("tmdsimpy_case2.csv", "Case 2", **case2, harmonics=10, samples=1024, step=0.1, most_steps=200, dynamic=True)
    write("tmdsimpy_case2_wandered.csv", "Case 2", **case2, harmonics=5, samples=128, step=0.1, most_steps=100,
          dynamic=False)
    write("tmdsimpy_clearance.csv", "The unilateral spring, gap -1", spring=(1.0, 0.06, 1.0, 2.0, -1.0), **gap,
          harmonics=7, samples=4096, step=0.02, most_steps=200, dynamic=True)
    write("tmdsimpy_preloaded.csv", "The unilateral spring, gap 0.5", spring=(1.0, 0.06, 1.0, 2.0, 0.5), **gap,
          harmonics=10, samples=4096, step=0.02, most_steps=200, dynamic=True)


main()
