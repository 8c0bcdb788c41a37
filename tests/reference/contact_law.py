"""The eight reference scenes and their contact law, docs/theory.md sections 1 and 2: phases, and what ends each.

    M x'' + C x' + K x + f = F0 cos(omega t),    u = x cos(alpha),  v = x sin(alpha),  N = max(kn (v + gap), 0)

In each phase the contact's force on the mass is f = k x + f0. A phase ends where x passes a level or turns back, so it
is enough to know x piece by monotone piece. 0 < alpha < 90 degrees.
"""
import math
from collections import namedtuple

# A phase of the contact. kind: "separated", "stick" or "slip". w: the slider's place in stick. sign: the traction's in
# slip, and in the stick that follows it. turned: stick began where x turned back in slip; turn: at what angle.
Phase = namedtuple("Phase", "kind w sign turned turn", defaults=(0.0, 0, False, None))
SEPARATED = Phase("separated")


class Scene:
    """One mass, one contact. Numbers in any consistent units; omega_from, omega_to bound the HBM curve."""

    def __init__(self, name, mass, damping, stiffness, force, kt, kn, gap, omega_from, omega_to, friction=0.3,
                 angle=45):
        self.name, self.mass, self.damping, self.stiffness, self.force = name, mass, damping, stiffness, force
        self.kt, self.kn, self.gap, self.friction = kt, kn, gap, friction
        self.omega_from, self.omega_to = omega_from, omega_to
        self.cos, self.sin = math.cos(math.radians(angle)), math.sin(math.radians(angle))
        self.preload = max(kn * gap, 0.0)
        self.touch = -gap / self.sin                        # contact where x is above
        self.grip = friction * kn * self.sin                # d(mu N)/dx
        self.pull = kt * self.cos                           # dT/dx in stick
        self.limit = friction * kn * gap                    # mu N at x = 0, extended linearly

    def line(self, phase):
        """k, f0 of the force k x + f0 on the mass."""
        normal = (self.kn * self.gap - self.preload) * self.sin
        if phase.kind == "separated":
            return 0.0, -self.preload * self.sin
        if phase.kind == "stick":
            return self.pull * self.cos + self.kn * self.sin ** 2, normal - self.pull * phase.w
        return (phase.sign * self.grip * self.cos + self.kn * self.sin ** 2,
                normal + phase.sign * self.limit * self.cos)

    def holds(self, x, w):
        """w moved just so far that |kt (u - w)| <= mu N at x."""
        room = max(self.grip * x + self.limit, 0.0) / self.kt
        return min(max(w, self.cos * x - room), self.cos * x + room)

    def slip_direction(self, sign):
        """The sign of x' with which slip(sign) goes on: sign kt u' > mu kn v'."""
        return 1 if sign * self.pull > self.grip else -1

    def stick_range(self, w):
        """(low, what follows below), (high, what follows above): x between which a slider at w sticks."""
        low, below, high, above = self.touch, SEPARATED, math.inf, None
        bounds = [(-1, (self.kt * w - self.limit) / (self.grip + self.pull))]
        if self.pull > self.grip:
            high, above = (self.limit + self.kt * w) / (self.pull - self.grip), Phase("slip", sign=1)
        elif self.pull < self.grip:
            bounds.append((1, (self.limit + self.kt * w) / (self.pull - self.grip)))
        for sign, level in bounds:
            # A slider that has stuck since it touched reaches both limits where N vanishes: that is a separation.
            if level > low + 1e-12 * (abs(low) + abs(level)):
                low, below = level, Phase("slip", sign=sign)
        return (low, below), (high, above)

    def event(self, phase, x_from, x_to):
        """The first change of phase as x goes monotonically from x_from to x_to: (level of x, next phase), or None.
        Slip that x runs against ends at x_from itself, where x turned."""
        rising = x_to > x_from
        if phase.kind == "separated":
            if not rising or x_to <= self.touch:
                return None
            w = self.cos * self.touch                      # T = N = 0
            return self.touch, Phase("slip", sign=1) if self.pull > self.grip else Phase("stick", w)
        if phase.kind == "slip":
            if rising != (self.slip_direction(phase.sign) > 0):
                traction = phase.sign * (self.grip * x_from + self.limit)
                return x_from, Phase("stick", self.cos * x_from - traction / self.kt, phase.sign, True)
            return (self.touch, SEPARATED) if not rising and x_to < self.touch else None
        (low, below), (high, above) = self.stick_range(phase.w)
        if rising:
            return (max(high, x_from), above) if x_to > high else None
        return (min(low, x_from), below) if x_to < low else None


SCENES = {s.name: s for s in (
    Scene("a10", 1, 0.4, 40, 10, 100, 200, 0.5, 3, 20),
    Scene("b10", 1, 0.4, 40, 10, 100, 200, -0.5, 3, 20),
    Scene("c2", 1, 0.4, 40, 100, 100, 1000, -5, 3, 20),
    Scene("c2kn1e4", 1, 0.4, 40, 100, 100, 1e4, -5, 3, 20),
    Scene("c2kt1e4", 1, 0.4, 40, 100, 1e4, 1000, -5, 3, 20),
    Scene("gap1", 1, 0.4, 40, 100, 100, 1000, 1, 3, 30),
    Scene("r1", 1.6, 0.4, 8e5, 100, 5e5, 7e5, 0.3, 750, 1050),
    Scene("r2", 1.6, 0.4, 8e5, 100, 5e5, 7e5, -0.2, 600, 850),
)}


def bisect(f, a, b):
    """A root of f in [a, b], to rounding: f(a) and f(b) are of different signs, or one is 0."""
    at_a = f(a)
    if at_a == 0:
        return a
    while True:
        middle = 0.5 * (a + b)
        if middle in (a, b):
            return b
        if (f(middle) > 0) == (at_a > 0):
            a = middle
        else:
            b = middle


def turns(slope, curvature, a, b, slope_a, slope_b, curvature_a, curvature_b):
    """Where x' changes its sign in the short interval [a, b]: none, one or two places. x' of equal signs at both ends
    may pass zero twice: then x'' changes its sign between, and x' is looked at there, so that no graze is missed."""
    if (slope_a > 0) != (slope_b > 0):
        return [bisect(slope, a, b)]
    if (curvature_a > 0) != (curvature_b > 0):
        extreme = bisect(curvature, a, b)
        if (slope(extreme) > 0) != (slope_a > 0):
            return [bisect(slope, a, extreme), bisect(slope, extreme, b)]
    return []


def solve(matrix, right):
    """x of matrix x = right by Gaussian elimination with row exchange, in place. ZeroDivisionError if singular."""
    n = len(right)
    for i in range(n):
        p = max(range(i, n), key=lambda r: abs(matrix[r][i]))
        matrix[i], matrix[p], right[i], right[p] = matrix[p], matrix[i], right[p], right[i]
        pivot_row, pivot = matrix[i], matrix[i][i]
        for r in range(i + 1, n):
            row = matrix[r]
            if row[i]:
                m = row[i] / pivot
                row[i + 1:] = [p - m * q for p, q in zip(row[i + 1:], pivot_row[i + 1:])]
                right[r] -= m * right[i]
    for i in range(n - 1, -1, -1):
        right[i] = (right[i] - sum(p * q for p, q in zip(matrix[i][i + 1:], right[i + 1:]))) / matrix[i][i]
    return right
