"""Case 2 of the paper by scipy's LSODA, for versus_scipy.sh.
usage: versus_scipy.py OMEGA X V [PERIODS] [RTOL]       prints: seconds of solve_ivp, amplitude over the last period, steps' right-hand sides

The exact law, written plainly. Where this contact touches it sticks, and never slips (kt cos <= mu kn sin: docs/theory.md, 2), so that the force is
    x > xc:  kt cos^2 (x - xc) + kn (x sin + gap) sin          xc = -gap/sin: where it touches; the slider stays there
    else 0
and no slider has to be integrated: LSODA gets the smallest system there is, and scalar code."""
import math
import sys
import time

from scipy.integrate import solve_ivp

omega, x0, v0 = (float(a) for a in sys.argv[1:4])
periods = int(sys.argv[4]) if len(sys.argv) > 4 else 200
rtol = float(sys.argv[5]) if len(sys.argv) > 5 else 1e-8
C, K, F0, KT, KN, GAP = 0.4, 40.0, 100.0, 100.0, 1000.0, -5.0  # mass 1, 45 degrees
S = math.sqrt(0.5)
XC, STUCK = -GAP / S, (KT + KN) * S * S
cos = math.cos


def motion(t, y):
    x, v = y
    force = STUCK * (x - XC) if x > XC else 0.0
    return v, F0 * cos(omega * t) - C * v - K * x - force


def extreme(x, sign):
    """The largest of sign x over a period's samples, by the parabola through the three at the top."""
    i = max(range(1, len(x) - 1), key=lambda k: sign * x[k])
    a, b, c = sign * x[i - 1], sign * x[i], sign * x[i + 1]
    return sign * (b - 0.125 * (c - a) ** 2 / (a - 2 * b + c))


period, n = 2 * math.pi / omega, 4096
last = [period * (periods - 1 + k / n) for k in range(n + 1)]
last[-1] = periods * period
began = time.process_time()
r = solve_ivp(motion, (0.0, periods * period), (x0, v0), method="LSODA", rtol=rtol, atol=rtol, t_eval=last)
seconds = time.process_time() - began
if not r.success:
    sys.exit("LSODA: " + r.message)
x = [float(a) for a in r.y[0]]
x.append(x[1])
print("%.9g %.15g %d" % (seconds, 0.5 * (extreme(x, 1.0) - extreme(x, -1.0)), r.nfev))
