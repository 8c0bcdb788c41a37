"""Solutions of the harmonic-balance equations without aliasing, and the branch they lie on.

    x(th) = X[0] + sum_{h=1..H} X[2h-1] cos(h th) + X[2h] sin(h th),      Z(omega) X + F(X) = F0 e_1

F(X): the turns of x are found by scanning and bisection; between them x is monotone, so that every transition of the
contact is one bisection; on each smooth piece the force is integrated by Gauss and Legendre's rule, whose error is
below rounding there. Newton on all unknowns; the branch by pseudo-arclength from the low end of the range.
"""
import cmath
import functools
import math

from contact_law import SEPARATED, Phase, bisect, solve, turns

TWO_PI = 2 * math.pi
MAX_PASSES = 50


class NoSolution(Exception):
    """Newton did not converge, or the contact did not settle."""


@functools.lru_cache(maxsize=None)
def gauss_legendre(n):
    """Nodes and weights on [-1, 1]."""
    rule = []
    for i in range(n):
        x = math.cos(math.pi * (i + 0.75) / (n + 0.5))
        for _ in range(100):
            p, before = x, 1.0
            for j in range(2, n + 1):
                p, before = ((2 * j - 1) * x * p - (j - 1) * before) / j, p
            slope = n * (x * p - before) / (x * x - 1)
            step = p / slope
            x -= step
            if abs(step) < 1e-15:
                break
        rule.append((x, 2 / ((1 - x * x) * slope * slope)))
    return rule


class Motion:
    """x(th) of real coefficients X[2H+1], with its turns."""

    def __init__(self, X):
        self.n = len(X) // 2
        self.mean = X[0]
        c = [complex(X[2 * h - 1], -X[2 * h]) for h in range(1, self.n + 1)]
        self.c0 = c[::-1]
        self.c1 = [1j * h * a for h, a in enumerate(c, 1)][::-1]
        self.c2 = [-h * h * a for h, a in enumerate(c, 1)][::-1]

    @staticmethod
    def _sum(c, th):
        z = cmath.rect(1.0, th)
        s = 0j
        for a in c:
            s = (s + a) * z
        return s.real

    def x(self, th):
        return self.mean + self._sum(self.c0, th)

    def slope(self, th):
        return self._sum(self.c1, th)

    def curvature(self, th):
        return self._sum(self.c2, th)

    def turns(self):
        """All th in (0, 2 pi) where x turns back."""
        n = 16 * self.n + 16
        at = [i * TWO_PI / n for i in range(n + 1)]
        s, c = [self.slope(th) for th in at], [self.curvature(th) for th in at]
        return [t for i in range(n)
                for t in turns(self.slope, self.curvature, at[i], at[i + 1], s[i], s[i + 1], c[i], c[i + 1])]


def contact_pieces(scene, motion):
    """[(from, to, phase)] over the period, and x at its turns. The slider starts at w = 0, moved as far as friction
    cannot hold it, and passes over the period until a pass ends as it began."""
    ends = [0.0] + motion.turns() + [TWO_PI]
    levels = [motion.x(th) for th in ends]
    x0 = levels[0]
    phase = Phase("stick", scene.holds(x0, 0.0)) if x0 > scene.touch else SEPARATED
    for _ in range(MAX_PASSES):
        began, pieces = phase, []
        for a, b, x_a, x_b in zip(ends, ends[1:], levels, levels[1:]):
            while True:
                event = scene.event(phase, x_a, x_b)
                if not event:
                    pieces.append((a, b, phase))
                    break
                level, after = event
                at = a if level == x_a else bisect(lambda th: motion.x(th) - level, a, b)
                pieces.append((a, at, phase))
                phase = after._replace(turn=at) if after.turned else after
                a, x_a = at, level
        same = (phase.kind, phase.sign) == (began.kind, began.sign)
        if same and abs(phase.w - began.w) <= 1e-14 * max(map(abs, levels)):
            return pieces, levels
    raise NoSolution("the slider does not settle")


def contact_force(scene, X):
    """F [2H+1], dF/dX [2H+1][2H+1], and the extreme values of x."""
    H = len(X) // 2
    motion = Motion(X)
    pieces, levels = contact_pieces(scene, motion)
    force = [0j] * (H + 1)                       # integral of f exp(-i h th)
    stiffness = [0j] * (2 * H + 1)               # integral of k exp(-i h th)
    jacobian = [[0.0] * (2 * H + 1) for _ in X]
    for a, b, phase in pieces:
        if b <= a:
            continue
        k, f0 = scene.line(phase)
        middle, half = 0.5 * (a + b), 0.5 * (b - a)
        for node, weight in gauss_legendre(math.ceil(H * half) + 16):
            th = middle + half * node
            back = cmath.rect(1.0, -th)
            term = complex(weight * half * (k * motion.x(th) + f0))
            for h in range(H + 1):
                force[h] += term
                term *= back
        stiffness[0] += k * (b - a)
        for h in range(1, 2 * H + 1):
            stiffness[h] += k * 1j / h * (cmath.rect(1.0, -h * b) - cmath.rect(1.0, -h * a))
        if phase.kind == "stick" and phase.turn is not None:
            slider_moves(scene, phase, a, b, jacobian)
    F = [force[0].real / TWO_PI]
    for h in range(1, H + 1):
        F += [force[h].real / math.pi, -force[h].imag / math.pi]
    add_stiffness(H, stiffness, jacobian)
    return F, jacobian, levels


def slider_moves(scene, phase, a, b, jacobian):
    """Add what the slider's place adds to dF/dX on the piece [a, b]: w = u - sign mu N/kt at the turn, where x' = 0, so
    that only x itself counts there. A slider that sticks since it touched lies at a place that does not depend on X."""
    size = len(jacobian)
    rate = scene.cos - phase.sign * scene.grip / scene.kt
    at_turn, integral = [1.0], [(b - a) / TWO_PI]
    for h in range(1, size // 2 + 1):
        at_turn += [math.cos(h * phase.turn), math.sin(h * phase.turn)]
        integral += [(math.sin(h * b) - math.sin(h * a)) / (h * math.pi),
                     (math.cos(h * a) - math.cos(h * b)) / (h * math.pi)]
    for row, i in zip(jacobian, integral):
        for q in range(size):
            row[q] -= scene.pull * rate * i * at_turn[q]


def add_stiffness(H, stiffness, jacobian):
    """Add the integral of k(th) times two basis functions to dF/dX: products of cosines and sines become sums."""
    C = [s.real / math.pi for s in stiffness]
    S = [-s.imag / math.pi for s in stiffness]
    sine = lambda n: S[n] if n >= 0 else -S[-n]
    for p in range(H + 1):
        for q in range(H + 1):
            half = 0.25 if p == 0 else 0.5        # the mean's row carries 1/(2 pi)
            d, s = abs(p - q), p + q
            if p == 0 and q == 0:
                jacobian[0][0] += 0.5 * C[0]
            elif q == 0:
                jacobian[2 * p - 1][0] += C[p]
                jacobian[2 * p][0] += S[p]
            else:
                row = max(2 * p - 1, 0)
                jacobian[row][2 * q - 1] += half * (C[d] + C[s])
                jacobian[row][2 * q] += half * (sine(q - p) + S[s])
                if p:
                    jacobian[2 * p][2 * q - 1] += half * (sine(p - q) + S[s])
                    jacobian[2 * p][2 * q] += half * (C[d] - C[s])


class Balance:
    """The equations of one scene: y = the unknowns of X (without X[0] if not keep_mean), then omega."""

    def __init__(self, scene, harmonics, keep_mean):
        self.scene, self.harmonics, self.first = scene, harmonics, 0 if keep_mean else 1
        self.size = 2 * harmonics + 1 - self.first

    def motion(self, y):
        return [0.0] * self.first + y[:self.size]

    def residual(self, y):
        """R [size], dR/dy [size][size+1], extreme values of x."""
        s, X, omega = self.scene, self.motion(y), y[-1]
        F, J, levels = contact_force(s, X)
        R = F[:]
        R[0] += s.stiffness * X[0]
        J[0][0] += s.stiffness
        R[1] -= s.force
        by_omega = [0.0] * len(X)
        for h in range(1, self.harmonics + 1):
            c, b = 2 * h - 1, 2 * h
            dynamic, damping = s.stiffness - s.mass * (h * omega) ** 2, s.damping * h * omega
            R[c] += dynamic * X[c] + damping * X[b]
            R[b] += dynamic * X[b] - damping * X[c]
            J[c][c] += dynamic
            J[b][b] += dynamic
            J[c][b] += damping
            J[b][c] -= damping
            by_omega[c] = -2 * s.mass * h * h * omega * X[c] + s.damping * h * X[b]
            by_omega[b] = -2 * s.mass * h * h * omega * X[b] - s.damping * h * X[c]
        rows = [J[i][self.first:] + [by_omega[i]] for i in range(self.first, len(X))]
        return R[self.first:], rows, levels

    def newton(self, y, row, level, most=12):
        """y with R(y) = 0 and row . y = level, by steps until they stop shrinking: (y, rows, levels, steps)."""
        best = math.inf
        for steps in range(most):
            R, rows, levels = self.residual(y)
            off = sum(p * q for p, q in zip(row, y)) - level
            try:
                step = solve([r[:] for r in rows] + [list(row)], [-r for r in R] + [-off])
            except ZeroDivisionError:
                raise NoSolution("singular") from None
            size = max(abs(d) for d in step[:-1]) / max(max(abs(x) for x in y[:-1]), 1e-300)
            size = max(size, abs(step[-1]) / abs(y[-1]))
            if not size < 1e3:
                raise NoSolution("diverged")
            if size < 1e-10 and size >= 0.5 * best or size < 1e-15:
                return y, rows, levels, steps
            best = min(best, size)
            y = [p + d for p, d in zip(y, step)]
        raise NoSolution("not converged")

    def at(self, guess, omega):
        """The solution at this omega next to `guess`: (y, levels)."""
        y, _, levels, _ = self.newton(guess[:-1] + [omega], [0.0] * self.size + [1.0], omega)
        return y, levels


def tangent(rows, weights, along):
    """The unit tangent (in the weighted norm) of the solutions, to the side of `along`."""
    t = solve([r[:] for r in rows] + [[w * a for w, a in zip(weights, along)]], [0.0] * len(rows) + [1.0])
    length = math.sqrt(sum(w * v * v for w, v in zip(weights, t)))
    return [v / length for v in t]


def dot(weights, a, b):
    return sum(w * p * q for w, p, q in zip(weights, a, b))


class Branch:
    """The branch that starts at the low end of the range: points one by one, each with its tangent.

    Arc length is measured by weights: omega by the range, X by its own size at the point, so that a step is the same
    part of the motion on a flank as on a summit. A step is halved when Newton needs many steps or the tangent turns by
    much, and where omega turns back until it is short: two solutions of one step beside a fold are not missed."""
    LONGEST, SHORTEST, AT_FOLD = 0.08, 1e-9, 2e-3

    def __init__(self, balance):
        self.balance = balance
        scene = balance.scene
        self.span = scene.omega_to - scene.omega_from
        omega = scene.omega_from
        # Far from resonance the contact hardly matters: the linear answer, stuck and separated, starts Newton.
        for k in (0.0, scene.line(Phase("stick"))[0]):
            a = scene.force / complex(scene.stiffness + k - scene.mass * omega ** 2, scene.damping * omega)
            y = [0.0] * (balance.size + 1)
            y[1 - balance.first], y[2 - balance.first], y[-1] = a.real, -a.imag, omega
            try:
                y, rows, self.levels, _ = balance.newton(y, [0.0] * balance.size + [1.0], omega)
                break
            except NoSolution:
                continue
        else:
            raise NoSolution("no first point")
        self.y, self.step = y, 1e-3
        self.t = tangent(rows, self.weights(y), [0.0] * balance.size + [1.0])

    def weights(self, y):
        size = sum(v * v for v in y[:-1])
        return [1 / size] * self.balance.size + [1 / self.span ** 2]

    def ahead(self, length, most=12):
        """The point at this arc length from self.y along self.t: (y, rows, levels, Newton steps)."""
        w = self.weights(self.y)
        row = [a * b for a, b in zip(w, self.t)]
        guess = [p + length * d for p, d in zip(self.y, self.t)]
        return self.balance.newton(guess, row, sum(p * q for p, q in zip(row, guess)), most)

    def advance(self):
        """Go to the next point."""
        while True:
            try:
                y, rows, levels, steps = self.ahead(self.step)
                w = self.weights(y)
                t = tangent(rows, w, self.t)
                old = [v / math.sqrt(dot(w, self.t, self.t)) for v in self.t]
                bend, fold = dot(w, t, old), t[-1] * self.t[-1] < 0
                if self.step < 1e-6 or bend > 0.95 and not (fold and self.step > self.AT_FOLD):
                    break
            except NoSolution:
                pass
            except ZeroDivisionError:
                pass
            self.step *= 0.5
            if self.step < self.SHORTEST:
                raise NoSolution("the branch cannot be followed at omega = %r" % self.y[-1])
        self.y, self.t, self.levels = y, t, levels
        if steps <= 6 and bend > 0.99:
            self.step = min(1.5 * self.step, self.LONGEST)


def half_range(levels):
    return 0.5 * (max(levels) - min(levels))


def response(balance, y, levels):
    """amplitude, max, min, harmonic_1, mean."""
    X = balance.motion(y)
    return half_range(levels), max(levels), min(levels), math.hypot(X[1], X[2]), X[0]


def highest(branch, before, after):
    """The largest amplitude near the branch's point `before`, up to arc length `after` from it: golden section."""
    keep = branch.y, branch.t
    branch.y, branch.t = before[:2]
    ratio = 0.5 * (math.sqrt(5) - 1)
    a, b = 0.0, after
    value = lambda s: half_range(branch.ahead(s)[2])
    c, d = b - ratio * (b - a), a + ratio * (b - a)
    at_c, at_d = value(c), value(d)
    while b - a > 1e-6:
        if at_c > at_d:
            b, d, at_d = d, c, at_c
            c = b - ratio * (b - a)
            at_c = value(c)
        else:
            a, c, at_c = c, d, at_d
            d = a + ratio * (b - a)
            at_d = value(d)
    y, _, levels, _ = branch.ahead(0.5 * (a + b))
    branch.y, branch.t = keep
    return y, levels


def crossing(branch, before, to, omega):
    """The solution at omega on the branch's step from the point `before` to `to`: Newton from between the two, or,
    where a corner of the curve lies between and Newton fails, from the step cut in halves until it is short."""
    y = before[0]
    part = (omega - y[-1]) / (to[-1] - y[-1])
    try:
        return branch.balance.at([p + part * (q - p) for p, q in zip(y, to)], omega)
    except NoSolution:
        pass
    keep = branch.y, branch.t
    branch.y, branch.t = before[:2]
    a, b = 0.0, dot(branch.weights(y), before[1], [p - q for p, q in zip(to, y)])
    while b - a > 1e-7:
        middle = 0.5 * (a + b)
        at_middle = branch.ahead(middle)[0]
        if (at_middle[-1] < omega) == (y[-1] < omega):
            a = middle
        else:
            b = middle
    branch.y, branch.t = keep
    return branch.balance.at(at_middle, omega)


class Curve:
    """What the branch comes by: rows [(turning points passed, omega, response)] in the order met, one at each crossing
    of an omega asked for; top = (omega, response) of the largest amplitude; at_end if that is where the range ends."""

    def __init__(self, scene, harmonics, keep_mean, omegas):
        self.balance = Balance(scene, harmonics, keep_mean)
        self.branch = Branch(self.balance)
        self.rows = []
        path, turned = [self._point()], 0
        while scene.omega_from <= self.branch.y[-1] <= scene.omega_to:
            self.branch.advance()
            path.append(self._point())
            before, after = path[-2], path[-1]
            going = turned + (before[1][-1] * after[1][-1] < 0)
            self._cross(before, after, omegas, turned, going)
            turned = going
        self._find_top(path, scene.omega_to)

    def _point(self):
        return self.branch.y, self.branch.t, half_range(self.branch.levels)

    def _cross(self, before, after, omegas, turned, going):
        a, b = before[0][-1], after[0][-1]
        for omega in sorted((w for w in omegas if min(a, b) < w <= max(a, b)), reverse=b < a):
            y, levels = crossing(self.branch, before, after[0], omega)
            # A step over a fold is short: the side of it that the crossing is on is the one it is nearer to.
            side = turned if abs(omega - a) < abs(omega - b) else going
            self.rows.append((side, omega, response(self.balance, y, levels)))

    def _find_top(self, path, omega_to):
        top = max(range(len(path)), key=lambda i: path[i][2])
        self.at_end = top >= len(path) - 2
        if self.at_end:
            y, levels = crossing(self.branch, path[-2], path[-1][0], omega_to)
        else:
            start = path[top - 1]
            ahead = [p - q for p, q in zip(path[top + 1][0], start[0])]
            y, levels = highest(self.branch, start, dot(self.branch.weights(start[0]), start[1], ahead))
        self.top = y[-1], response(self.balance, y, levels)
