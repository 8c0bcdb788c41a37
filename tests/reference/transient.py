"""The steady state of the equation of motion, omega swept slowly up or down, in closed form between transitions.

In a phase x = q + Re[P exp(i omega t)] + exp(-d t) (A cos + B sin)(wd t). Turns of x are found by scanning and
bisection, transitions by bisection between turns, all to rounding. A periodic orbit is a fixed point of the map over
one period: Newton with differences for its derivative. The sweep follows the stable orbit in small steps of omega and
marches only from where that orbit has ended or lost its stability.
"""
import cmath
import math

from contact_law import SEPARATED, Phase, bisect, solve, turns

MAX_EVENTS = 10000


class NoOrbit(Exception):
    """Newton on the period map found no stable orbit near the start."""


class Flow:
    """x(t) of one phase from x, v at time t0."""

    def __init__(self, scene, omega, phase, t0, x, v):
        k, f0 = scene.line(phase)
        stiffness = scene.stiffness + k
        self.q = -f0 / stiffness
        p = scene.force / complex(stiffness - scene.mass * omega ** 2, scene.damping * omega)
        self.P, self.omega, self.t0 = p, omega, t0
        self.pc, self.ps = p.real, -p.imag
        self.d = scene.damping / (2 * scene.mass)
        self.wd = math.sqrt(stiffness / scene.mass - self.d ** 2)
        c, s = math.cos(omega * t0), math.sin(omega * t0)
        self.A = x - self.q - self.pc * c - self.ps * s
        self.B = (v - omega * (self.ps * c - self.pc * s) + self.d * self.A) / self.wd
        self.A1, self.B1 = self.wd * self.B - self.d * self.A, -self.wd * self.A - self.d * self.B
        self.A2, self.B2 = self.wd * self.B1 - self.d * self.A1, -self.wd * self.A1 - self.d * self.B1
        self.step = 2 * math.pi / (24 * max(omega, self.wd))

    def x(self, t):
        a, b, tau = self.omega * t, self.wd * (t - self.t0), t - self.t0
        return (self.q + self.pc * math.cos(a) + self.ps * math.sin(a)
                + math.exp(-self.d * tau) * (self.A * math.cos(b) + self.B * math.sin(b)))

    def slope(self, t):
        a, b, tau = self.omega * t, self.wd * (t - self.t0), t - self.t0
        return (self.omega * (self.ps * math.cos(a) - self.pc * math.sin(a))
                + math.exp(-self.d * tau) * (self.A1 * math.cos(b) + self.B1 * math.sin(b)))

    def curvature(self, t):
        a, b, tau = self.omega * t, self.wd * (t - self.t0), t - self.t0
        return (-self.omega ** 2 * (self.pc * math.cos(a) + self.ps * math.sin(a))
                + math.exp(-self.d * tau) * (self.A2 * math.cos(b) + self.B2 * math.sin(b)))

    def integral(self, b, n):
        """Integral of x exp(-i n omega t) from t0 to b, in closed form."""
        def power(rate):                        # integral of exp(rate (t - t0))
            return (cmath.exp(rate * (b - self.t0)) - 1) / rate if rate else b - self.t0
        z, turn = complex(self.A, -self.B), -1j * n * self.omega
        rate = complex(-self.d, self.wd)
        start = cmath.exp(turn * self.t0)
        forced = cmath.exp(1j * self.omega * self.t0)
        return start * (self.q * power(turn)
                        + 0.5 * self.P * forced * power(turn + 1j * self.omega)
                        + 0.5 * (self.P * forced).conjugate() * power(turn - 1j * self.omega)
                        + 0.5 * z * power(turn + rate) + 0.5 * z.conjugate() * power(turn + rate.conjugate()))


def begins(scene, state):
    """The phase at t = 0. A state is (x, v, w); where the contact is open, w is where the slider will touch. A slider
    about to slip begins as one that sticks: the first look at its limits finds the slip."""
    x, _, w = state
    return SEPARATED if x <= scene.touch else Phase("stick", scene.holds(x, w))


def slider(scene, x, phase):
    """w of a phase at x."""
    if phase.kind == "slip":
        return scene.cos * x - phase.sign * (scene.grip * x + scene.limit) / scene.kt
    return phase.w if phase.kind == "stick" else scene.cos * scene.touch


def period(scene, omega, state, record=None):
    """The state after one period from t = 0. record, if given, gets (flow, end, phase, extremes of x) per phase."""
    x, v, _ = state
    phase = begins(scene, state)
    t, end = 0.0, 2 * math.pi / omega
    for _ in range(MAX_EVENTS):
        flow = Flow(scene, omega, phase, t, x, v)
        at, after, extremes = until_event(scene, flow, phase, end)
        x, v = flow.x(at), flow.slope(at)
        if record is not None:
            record.append((flow, at, phase, extremes + [x]))
        if after is None:
            return x, v, slider(scene, x, phase)
        t, phase = at, after
    raise NoOrbit("more than %d transitions in a period" % MAX_EVENTS)


def until_event(scene, flow, phase, end):
    """(time of the phase's end or of the period's, next phase or None, x at the turns passed)."""
    a = flow.t0
    x_a, slope_a, curvature_a = flow.x(a), flow.slope(a), flow.curvature(a)
    extremes = [x_a]
    while a < end:
        b = min(a + flow.step, end)
        slope_b, curvature_b = flow.slope(b), flow.curvature(b)
        for c in turns(flow.slope, flow.curvature, a, b, slope_a, slope_b, curvature_a, curvature_b) + [b]:
            x_c = flow.x(c)
            event = scene.event(phase, x_a, x_c) if x_c != x_a else None
            if event:
                level, after = event
                if after.turned:
                    return a, after, extremes
                started = x_a >= level if x_c > x_a else x_a <= level
                return (a if started else bisect(lambda t: flow.x(t) - level, a, c)), after, extremes
            if c < b:
                extremes.append(x_c)
            a, x_a = c, x_c
        slope_a, curvature_a = slope_b, curvature_b
    return end, None, extremes


def linear_orbit(scene, omega, phase):
    """The orbit that stays in one phase: (half range, mean, state at t = 0)."""
    k, f0 = scene.line(phase)
    p = scene.force / complex(scene.stiffness + k - scene.mass * omega ** 2, scene.damping * omega)
    q = -f0 / (scene.stiffness + k)
    return abs(p), q, (q + p.real, -omega * p.imag, slider(scene, 0.0, phase))


def stuck_means(scene, omega):
    """(amplitude, lowest, highest mean) of the orbits that never slip; lowest > highest if there is none. Each limit,
    mu N -+ kt (u - w) >= 0 at x = mean +- amplitude, is linear in the mean, as w is: pull w = (K + k) mean + f0(0)."""
    k, f0 = scene.line(Phase("stick"))
    stiffness = scene.stiffness + k
    size = abs(scene.force / complex(stiffness - scene.mass * omega ** 2, scene.damping * omega))
    low, high = scene.touch + size, math.inf
    for sign in (1, -1):
        by_x, by_w = scene.grip - sign * scene.pull, sign * scene.kt
        slope = by_x + by_w * stiffness / scene.pull
        rest = scene.limit + by_w * f0 / scene.pull - abs(by_x) * size
        if slope > 0:
            low = max(low, -rest / slope)
        else:
            high = min(high, -rest / slope)
    return size, low, high


def linear_steady(scene, omega, state, near):
    """The state of the orbit without transitions within `near` of `state`, or None. A slider is moved no further than
    friction makes it."""
    if state[0] <= scene.touch:
        size, mean, at_0 = linear_orbit(scene, omega, SEPARATED)
        if mean + size > scene.touch:
            return None
    else:
        size, low, high = stuck_means(scene, omega)
        if low > high:
            return None
        k, f0 = scene.line(Phase("stick"))
        mean = min(max((scene.pull * state[2] - f0) / (scene.stiffness + k), low), high)
        at_0 = linear_orbit(scene, omega, Phase("stick", ((scene.stiffness + k) * mean + f0) / scene.pull))[2]
    return at_0 if distance(omega, at_0, state) <= near * size else None


def distance(omega, a, b):
    """The larger of the differences in x and v/omega."""
    return max(abs(a[0] - b[0]), abs(a[1] - b[1]) / omega)


def newton(scene, omega, state, near):
    """(state, largest multiplier) of the periodic orbit within `near` of `state`; NoOrbit if none is found."""
    start, best, units = state, math.inf, (1.0, omega, 1.0)
    for _ in range(15):
        off = [p - q for p, q in zip(period(scene, omega, state), state)]
        size = max(abs(state[0]), abs(state[1]) / omega)
        M = [[0.0] * 3 for _ in range(3)]
        for j in range(3):
            sides = []
            for h in (1e-6 * size, -1e-6 * size):
                beside = list(state)
                beside[j] += h * units[j]
                sides.append(period(scene, omega, beside))
            for i in range(3):
                M[i][j] = (sides[0][i] - sides[1][i]) / (2e-6 * size * units[j])
        try:
            step = solve([[(i == j) - M[i][j] for j in range(3)] for i in range(3)], off[:])
        except ZeroDivisionError:
            raise NoOrbit("a free slider") from None
        length = max(abs(d) / u for d, u in zip(step, units)) / size
        if length < 1e-10 and length >= 0.5 * best or length < 1e-15:
            return state, spectral_radius([[M[i][j] * units[j] / units[i] for j in range(3)] for i in range(3)])
        best = min(best, length)
        state = [p + d for p, d in zip(state, step)]
        if not distance(omega, state, start) <= near * size:
            break
    raise NoOrbit("not converged")


def spectral_radius(M):
    """|M^(2^k)|^(1/2^k), scaled on the way."""
    n, log, power = len(M), 0.0, 1
    for _ in range(20):
        size = max(abs(v) for row in M for v in row)
        if size == 0:
            return 0.0
        log += math.log(size) / power
        M = [[v / size for v in row] for row in M]
        M = [[sum(M[i][m] * M[m][j] for m in range(n)) for j in range(n)] for i in range(n)]
        power *= 2
    return math.exp(log)


def measure(scene, omega, state):
    """amplitude, max, min, harmonic_1, mean, transitions, closure of the period from `state`."""
    record = []
    after = period(scene, omega, state, record)
    levels = [x for _, _, _, e in record for x in e]
    first = sum(flow.integral(b, 1) for flow, b, _, _ in record) * omega / math.pi
    mean = sum(flow.integral(b, 0) for flow, b, _, _ in record).real * omega / (2 * math.pi)
    kinds = [(phase.kind, phase.sign * (phase.kind == "slip")) for flow, b, phase, _ in record
             if b - flow.t0 > 1e-12 * record[-1][1]]   # not the look at a slider that slips already at t = 0
    transitions = sum(a != b for a, b in zip(kinds, kinds[1:] + kinds[:1]))
    high, low = max(levels), min(levels)
    return 0.5 * (high - low), high, low, abs(first), mean, transitions, distance(omega, after, state)


NEAR = 0.1          # a periodic orbit is the neighbour of a state within this part of its size
SETTLED = 0.02      # a march has arrived when the orbit is this near


def stable_orbit(scene, omega, state, near):
    found, radius = newton(scene, omega, state, near)
    if radius > 1:
        raise NoOrbit("unstable")
    return found


def march(scene, omega, state, most):
    """Wait for the steady state, `most` e-folds of free vibration at the longest. (state, settled)."""
    per_fold = omega * scene.mass / (math.pi * scene.damping)
    done, stretch = 0, 16
    while done < most * per_fold:
        for _ in range(stretch):
            record = []
            state = period(scene, omega, state, record)
        done += stretch
        stretch = min(2 * stretch, 256)
        steady = linear_steady(scene, omega, state, SETTLED) if len(record) == 1 else None
        if steady:
            return steady, True
        try:
            return stable_orbit(scene, omega, state, SETTLED), True
        except NoOrbit:
            pass
    return state, False


def sweep(scene, omegas, substeps=32):
    """{omega: state at t = 0, or None where no orbit of one period settled}, for omegas in the order given. Starts with
    the slider at 0, where x = 0 is the equilibrium: on the orbit without transitions if there is one, else from rest.
    Where the orbit followed ends, the motion is marched one substep on, and if it settles on no period of one there, at
    the next omega asked for: from where it is, then from rest."""
    omega = omegas[0]
    state = linear_steady(scene, omega, (0.0, 0.0, 0.0), math.inf)
    settled = state is not None
    if not settled:
        state, settled = march(scene, omega, (0.0, 0.0, 0.0), 100)
    found = {omega: state if settled else None}
    for target in omegas[1:]:
        full = (target - omega) / substeps
        while settled and omega != target:
            state, omega = follow(scene, omega, state, target, full)
            if omega != target:
                omega = target if abs(target - omega) < 1.5 * abs(full) else omega + full
                state, settled = march(scene, omega, state, 20)
        if not settled and omega != target:
            state, settled = march(scene, target, state, 100)
        if not settled:
            state, settled = march(scene, target, (0.0, 0.0, 0.0), 100)
        omega = target
        found[omega] = state if settled else None
    return found


def follow(scene, omega, state, target, full):
    """(state, omega) where the stable orbit through `state` has been followed to: target, or where it ends. Steps are
    at most `full`, and not given up before a thousandth of it."""
    step = full
    while omega != target and abs(step) > abs(full) / 1000:
        to = omega + step if abs(target - omega) > 1.000001 * abs(step) else target
        try:
            state = linear_steady(scene, to, state, NEAR) or stable_orbit(scene, to, state, NEAR)
            omega, step = to, min(2 * step, full, key=abs)
        except NoOrbit:
            step *= 0.5
    return state, omega
