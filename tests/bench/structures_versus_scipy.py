#!/usr/bin/env python3
"""A benchmark, not a test: the steady state of structures of two and three degrees of freedom by scipy's LSODA, marched from rest, and by hbmcheck.

usage: structures_versus_scipy.py BUILD [CASE...] [--rounds R] [--periods P] [--rtol E]
  BUILD    the build folder: hbmcheck is taken from it
  CASE     names of the table CASES_AT below; default: all
LSODA marches P periods (default 200) at rtol E (default 1e-8), as one does who does not know how soon the motion is settled; its right-hand side is
scalar code, regularised as hbmcheck's default law, the slider of each contact a state. hbmcheck is the whole process, `transient --at` with start: rest: its default (regularised law,
confirmed by CVODE) and the exact law in closed form. Both run R times (default 3), in turns; times are medians of processor time, LSODA's of
solve_ivp alone. Errors: of the amplitude (max - min)/2 of the first response, against the exact law in closed form at 1e-13.

exit: 0  1 a run failed  64 usage  77 scipy is not here"""
import csv
import math
import os
import statistics
import sys
import time

import versus_peer

# One frequency of each case where a contact slips or opens and nothing rests where its history left it.
CASES_AT = {"jenkins2": 25.9068, "stop2": 0.635, "chain3": 1.9, "tangent_normal_F50": 3.6, "tangent_normal_F100": 3.6, "wedge_F2": 35, "wedge_F10": 33, "wedge_F20": 34}
REGULARISATION = 1e-4
SAMPLES = 4096  # of the last period


def right_hand_side(p, omega):
    """f(t, y) of y = x, x', and of each contact where its slider is. M is diagonal. With a slider that moves at once LSODA chatters and does not
    end: it follows within REGULARISATION/omega, as hbmcheck's does in its default law."""
    n, creep = p["n"][0], omega / REGULARISATION
    rows = range(n)
    mass = [p["M"][i * n + i] for i in rows]
    D, K = ([[(j, m[i * n + j]) for j in rows if m[i * n + j]] for i in rows] for m in (p["D"], p["K"]))
    static, load = p["static"], p["force"]
    contacts = []
    for at, c in enumerate(p["elements"]):
        tangent, normal = ([(i, a) for i, a in enumerate(c[k]) if a] for k in ("tangent", "normal"))
        contacts.append((tangent, normal, c["kt"], c["kn"], c["mu"], c["preload"], c["gap"], max(c["kn"] * c["gap"], 0.0), 2 * n + at))

    def f(t, y):
        swing = math.cos(omega * t)
        force = [static[i] + load[i] * swing for i in rows]
        sliders = []
        for tangent, normal, kt, kn, mu, preload, gap, N0, slider in contacts:
            N = preload
            if normal:
                N = max(kn * (sum(a * y[i] for i, a in normal) + gap), 0.0)
                for i, a in normal:
                    force[i] -= a * (N - N0)
            if not tangent:
                sliders.append(0.0)
                continue
            S = kt * (sum(a * y[i] for i, a in tangent) - y[slider])
            T = max(-mu * N, min(mu * N, S))
            sliders.append((S - T) / kt * creep)
            for i, a in tangent:
                force[i] -= a * T
        for i in rows:
            for j, a in D[i]:
                force[i] -= a * y[n + j]
            for j, a in K[i]:
                force[i] -= a * y[j]
        return [*y[n:2 * n], *(force[i] / mass[i] for i in rows), *sliders]

    return f


def extreme(x, sign):
    """The largest of sign x over a period's samples, by the parabola through the three at the top."""
    i = max(range(1, len(x) - 1), key=lambda k: sign * x[k])
    a, b, c = sign * x[i - 1], sign * x[i], sign * x[i + 1]
    return sign * (b - 0.125 * (c - a) ** 2 / (a - 2 * b + c))


def by_lsoda(p, omega, periods, rtol):
    """(processor seconds, amplitude, evaluations)"""
    from scipy.integrate import solve_ivp

    period, r = 2 * math.pi / omega, p["responses"][0]
    n = p["n"][0]
    last = [period * (periods - 1 + k / SAMPLES) for k in range(SAMPLES + 1)]
    began = time.process_time()
    s = solve_ivp(right_hand_side(p, omega), (0.0, last[-1]), [0.0] * (2 * n + len(p["elements"])), method="LSODA", rtol=rtol, atol=1e-3 * rtol, t_eval=last)
    seconds = time.process_time() - began
    if not s.success:
        versus_peer.fail(1, "LSODA: " + s.message)
    x = [sum(a * s.y[i][k] for i, a in enumerate(r)) for k in range(SAMPLES + 1)]
    x.append(x[1])
    return seconds, 0.5 * (extreme(x, 1.0) - extreme(x, -1.0)), s.nfev


def by_hbmcheck(hbmcheck, case, omega, settings):
    """(processor seconds of the process, amplitude of the first response)"""
    command = [hbmcheck, "transient", case, "--at", repr(omega), "--format", "csv", "--quiet", "--set", "transient.start=rest"]
    seconds, out = versus_peer.run(command + [a for s in settings for a in ("--set", "transient." + s)])
    row = next(csv.DictReader(line for line in out.splitlines() if line[0] != "#"))
    return seconds, float(row["amplitude"])


def versus(hbmcheck, name, omega, rounds, periods, rtol):
    p, case = versus_peer.read_case(name), os.path.join(versus_peer.CASES, name + ".yaml")
    closed = ["law=exact", "method=closed_form"]
    exact = by_hbmcheck(hbmcheck, case, omega, [*closed, "tolerance=1e-13"])[1]
    runs = [[by_lsoda(p, omega, periods, rtol), by_hbmcheck(hbmcheck, case, omega, []), by_hbmcheck(hbmcheck, case, omega, closed)] for _ in range(rounds)]
    seconds = [statistics.median(r[k][0] for r in runs) for k in range(3)]
    errors = [abs(runs[0][k][1] / exact - 1) for k in range(3)]
    print("%-20s %-7g %8.3f s %7.1e %8d   %8.4f s %7.1e %6.0f   %8.4f s %7.1e %6.0f" % (
        name, omega, seconds[0], errors[0], runs[0][0][2], seconds[1], errors[1], seconds[0] / seconds[1], seconds[2], errors[2], seconds[0] / seconds[2]), flush=True)


def main(arguments):
    options, names, rest = {"--rounds": 3, "--periods": 200, "--rtol": 1e-8}, [], iter(arguments[1:])
    try:
        build = os.path.abspath(arguments[0])
        for a in rest:
            if a in options:
                options[a] = type(options[a])(next(rest))
            else:
                names.append((a, CASES_AT[a]))
    except (IndexError, KeyError, StopIteration, ValueError):
        versus_peer.fail(64, __doc__)
    try:
        import scipy
    except ImportError:
        versus_peer.fail(77, "skipped: scipy is not here (Debian's python3-scipy)")
    print("scipy %s, Python %s; LSODA: %d periods from rest, rtol %g" % (scipy.__version__, sys.version.split()[0], options["--periods"], options["--rtol"]))
    print("%-20s %-7s %-28s   %-26s   %s" % ("case", "omega", "LSODA: time, error, calls", "hbmcheck: time, error, LSODA/it", "closed form: time, error, LSODA/it"))
    for name, omega in names or CASES_AT.items():
        versus(os.path.join(build, "hbmcheck"), name, omega, *options.values())


if __name__ == "__main__":
    main(sys.argv[1:])
