# lsoda.py - the steady state of one degree of freedom as a person finds it who has scipy and no event location: the
# law's cases in the right-hand side, a tight rtol, many periods. Built into hbmcheck, which runs it by `python3 -c`.
#     arguments: omega periods repeats x v M C K F0, then for each contact w kt kn mu gap cos sin
#     prints a line a run: rtol seconds amplitude harmonic_1; exit 69 without scipy
# Where the slider's rate jumps LSODA may take ever smaller steps at a tight rtol (1e-8 on case 2): scipy.c limits it.
import math
import sys
import time

try:
    import scipy
    from scipy.integrate import solve_ivp
except ImportError:
    sys.exit(69)
print('# scipy', scipy.__version__, 'python', sys.version.split()[0], flush=True)
a = [float(s) for s in sys.argv[1:]]
omega, periods, repeats = a[0], int(a[1]), int(a[2])
M, C, K, F0 = a[5:9]
contacts = [tuple(a[i + 1:i + 7]) for i in range(9, len(a), 7)]
y0 = a[3:5] + [a[i] for i in range(9, len(a), 7)]


def motion(t, y):
    x, v = y[0], y[1]
    f = F0 * cos(omega * t) - C * v - K * x
    rates = []
    for j, (kt, kn, mu, gap, c, s) in enumerate(contacts):
        n = kn * (s * x + gap)
        f += max(kn * gap, 0.0) * s
        if n <= 0.0:
            rates.append(c * v)
            continue
        T, most, rate = kt * (c * x - y[2 + j]), mu * n, 0.0
        if abs(T) >= most:
            sign = 1.0 if T > 0.0 else -1.0
            T = sign * most
            if kt == 0.0:
                rate = c * v
            elif sign * kt * c * v > mu * kn * s * v:
                rate = c * v - sign * mu * kn * s * v / kt
        rates.append(rate)
        f -= T * c + n * s
    return [v, f / M] + rates


def top(x):
    i = max(range(1, len(x) - 1), key=lambda k: x[k])
    p, q, r = x[i - 1:i + 2]
    return q - 0.125 * (r - p) ** 2 / (p - 2.0 * q + r)


T1, N = 2.0 * math.pi / omega, 4096
size = max(abs(y0[0]), abs(y0[1]) / omega)
last = [T1 * (periods - 1 + k / N) for k in range(N)] + [T1 * periods]
for rtol in (1e-4, 1e-6, 1e-8, 1e-10):
    for repeat in range(repeats):
        began = time.process_time()
        r = solve_ivp(motion, (0.0, last[-1]), y0, method='LSODA', rtol=rtol, atol=rtol * size, t_eval=last)
        seconds = time.process_time() - began
        if not r.success:
            continue
        x = [float(b) for b in r.y[0]]
        a1 = 2.0 / N * sum(x[k] * math.cos(2.0 * math.pi * k / N) for k in range(N))
        b1 = 2.0 / N * sum(x[k] * math.sin(2.0 * math.pi * k / N) for k in range(N))
        x.append(x[1])
        print(rtol, seconds, 0.5 * (top(x) + top([-b for b in x])), math.hypot(a1, b1), flush=True)
