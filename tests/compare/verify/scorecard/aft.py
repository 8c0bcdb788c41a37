"""Harmonic balance of one mass on one contact by alternating between frequency and time (AFT), as one writes it in an
afternoon, with the mistakes that one makes at it as options. It shares nothing with hbmcheck but the equations:

    M x'' + C x' + K x + T cos(alpha) + (N - N0) sin(alpha) = F0 cos(omega t),   u = x cos(alpha), v = x sin(alpha)
    N = max(kn (v + gap), 0), N0 = max(kn gap, 0); T = kt (u - w), |T| <= mu N, and T = 0 where N = 0
    x(th) = X[0] + sum_{h=1..H} X[2h-1] cos(h th) + X[2h] sin(h th),   th = omega t

    follow      the contact over the samples of a period: force, and its derivative
    residual    Z(omega) X + F(X) - F0 e_1, and its Jacobian
    trace       the curve from one omega to another by pseudo-arclength
    solutions   of that curve at given omegas, by Newton
"""
import functools
import math
from dataclasses import dataclass, replace
from operator import mul


@dataclass(frozen=True)
class Oscillator:
    mass: float
    damping: float
    stiffness: float
    force: float
    kt: float
    kn: float
    mu: float
    angle: float  # [degree]
    gap: float


@dataclass(frozen=True)
class Code:
    """How the equations are solved; as it stands, rightly, but for 1/N^2."""
    harmonics: int = 10
    samples: int = 1024
    mean: bool = True                # harmonic 0 is kept
    even: bool = True                # so are the other even ones
    slider: str = "interpolated"     # after a separation w is u at the instant of touch; "sample": u at the last sample
                                     # before that; "zeroed": 0; "kept": what it was
    periods: int = 2                 # that the slider is followed, from w = 0; the last is kept
    separates: bool = True           # False: N = kn (v + gap) also below zero, T limited by mu max(N, 0)
    normal: str = "varies"           # "constant": N = N0 everywhere; "constant limit": in mu N alone
    preload_off: bool = True         # the mass feels N - N0; False: N
    contact_factor: float = 1.0      # of the contact force's coefficients
    mean_factor: float = 1.0         # of its harmonic 0 alone
    contact: str = "law"             # "none", or "stuck" for ever
    traction_projected: bool = True  # the mass feels T cos(alpha); False: T
    late: int = 0                    # samples by which the contact force comes late
    cubic: float = 0.0               # [force/length^3] of a spring that the case has not
    hysteretic: bool = False         # the damping force is C sqrt(K/M) times the displacement, at every frequency


class NoSolution(Exception):
    """Newton did not converge."""


@functools.lru_cache(maxsize=None)
def basis(harmonics, samples):
    """Rows of 1, cos(th_i), sin(th_i), cos(2 th_i), ... for every sample, and the same as columns."""
    rows = []
    for i in range(samples):
        row = [1.0]
        for h in range(1, harmonics + 1):
            th = 2 * math.pi * (h * i % samples) / samples
            row += [math.cos(th), math.sin(th)]
        rows.append(row)
    return rows, list(zip(*rows))


def follow(o, code, x):
    """The contact force on the mass at every sample of x, its derivative by x there, and the stretches of stick as
    (first, end, origin, by_x): w moves with by_x times what x moves by at sample `origin`."""
    n, c, s = len(x), math.cos(math.radians(o.angle)), math.sin(math.radians(o.angle))
    preload = max(o.kn * o.gap, 0.0)
    c_force = c if code.traction_projected else 1.0
    off = preload if code.preload_off else 0.0
    by_normal = 0.0 if code.normal == "constant" else o.kn
    f, k, sticks = [0.0] * n, [0.0] * n, []
    if code.contact != "law":
        stiffness = o.kt * c * c + o.kn * s * s if code.contact == "stuck" else 0.0
        return [stiffness * a for a in x], [stiffness] * n, []
    w, origin, by_x = 0.0, 0, 0.0
    apart = o.kn * (s * x[-1] + o.gap) <= 0 and code.separates and code.normal != "constant"
    for period in range(code.periods):
        keep, first = period == code.periods - 1, None
        for i, a in enumerate(x):
            normal = preload if code.normal == "constant" else o.kn * (s * a + o.gap)
            if normal <= 0 and code.separates:
                if keep:
                    f[i], k[i] = -off * s, 0.0
                    if first is not None:
                        sticks.append((first, i, origin, by_x))
                        first = None
                apart = True
                if code.slider == "zeroed":
                    w, by_x = 0.0, 0.0
                elif code.slider != "kept":
                    w, origin, by_x = c * a, i, c
                continue
            if apart and code.slider == "interpolated" and s > 0:
                w, by_x = -o.gap * c / s, 0.0
            apart = False
            limit, by_limit = (o.mu * preload, 0.0) if code.normal == "constant limit" else \
                (o.mu * max(normal, 0.0), o.mu * by_normal * s if normal > 0 else 0.0)
            traction = o.kt * (c * a - w)
            if abs(traction) <= limit:
                if keep:
                    f[i], k[i] = traction * c_force + (normal - off) * s, o.kt * c * c_force + by_normal * s * s
                    first = i if first is None else first
                continue
            if keep and first is not None:
                sticks.append((first, i, origin, by_x))
                first = None
            sign = 1.0 if traction > 0 else -1.0
            if keep:
                f[i] = sign * limit * c_force + (normal - off) * s
                k[i] = sign * by_limit * c_force + by_normal * s * s
            if o.kt > 0:
                w, origin, by_x = c * a - sign * limit / o.kt, i, c - sign * by_limit / o.kt
        if keep and first is not None:
            sticks.append((first, n, origin, by_x))
    return f, k, sticks


class Equations:
    """Of one oscillator by one code."""

    def __init__(self, oscillator, code):
        self.o, self.code = oscillator, code
        self.rows, self.columns = basis(code.harmonics, code.samples)
        self.more = basis(2 * code.harmonics, code.samples)[1]
        self.kept = [j for j in range(2 * code.harmonics + 1)
                     if (j > 0 or code.mean) and (j == 0 or code.even or (j + 1) // 2 % 2)]
        self.factor = [code.contact_factor * 2 / code.samples] * (2 * code.harmonics + 1)
        self.factor[0] = code.contact_factor * code.mean_factor / code.samples

    def contact(self, X):
        """The coefficients of the contact force, and their Jacobian."""
        size = len(X)
        x = [sum(map(mul, row, X)) for row in self.rows]
        f, k, sticks = follow(self.o, self.code, x)
        f = f[-self.code.late:] + f[:-self.code.late] if self.code.late else f
        if self.code.cubic:
            f = [a + self.code.cubic * b ** 3 for a, b in zip(f, x)]
            k = [a + 3 * self.code.cubic * b ** 2 for a, b in zip(k, x)]
        F = [a * sum(map(mul, column, f)) for a, column in zip(self.factor, self.columns)]
        if not any(k) and not sticks:
            return F, [[0.0] * size for _ in range(size)]
        K = [sum(map(mul, column, k)) for column in self.more]
        cosine = [K[0]] + K[1::2]
        sine = [0.0] + K[2::2]
        J = [[0.0] * size for _ in range(size)]
        for p in range(size):
            hp, p_sine = (p + 1) // 2, p > 0 and p % 2 == 0
            for q in range(p, size):  # products of two of the basis, as sums
                hq, q_sine = (q + 1) // 2, q > 0 and q % 2 == 0
                if p_sine and q_sine:
                    value = (cosine[hq - hp] - cosine[hp + hq]) / 2
                elif q_sine:
                    value = (sine[hp + hq] + sine[hq - hp]) / 2
                elif p_sine:
                    value = (sine[hp + hq] - sine[hq - hp]) / 2
                else:
                    value = (cosine[hq - hp] + cosine[hp + hq]) / 2
                J[p][q] = J[q][p] = value
        cos_kt = self.o.kt * (math.cos(math.radians(self.o.angle)) if self.code.traction_projected else 1.0)
        for first, end, origin, by_x in sticks:
            if by_x != 0:
                row = [cos_kt * by_x * b for b in self.rows[origin]]
                for p in range(size):
                    a = sum(self.columns[p][first:end])
                    J[p] = [value - a * b for value, b in zip(J[p], row)]
        return F, [[a * value for value in row] for a, row in zip(self.factor, J)]

    def residual(self, X, omega):
        """R[2H+1], its Jacobian, and its derivative by omega."""
        o = self.o
        R, J = self.contact(X)
        D = [0.0] * len(X)
        R[0] += o.stiffness * X[0]
        J[0][0] += o.stiffness
        for h in range(1, len(X) // 2 + 1):
            i, k = 2 * h - 1, o.stiffness - o.mass * (h * omega) ** 2
            d = o.damping * (math.sqrt(o.stiffness / o.mass) if self.code.hysteretic else h * omega)
            by_omega = 0.0 if self.code.hysteretic else o.damping * h
            R[i] += k * X[i] + d * X[i + 1]
            R[i + 1] += k * X[i + 1] - d * X[i]
            J[i][i] += k
            J[i][i + 1] += d
            J[i + 1][i + 1] += k
            J[i + 1][i] -= d
            D[i] = -2 * o.mass * h * h * omega * X[i] + by_omega * X[i + 1]
            D[i + 1] = -2 * o.mass * h * h * omega * X[i + 1] - by_omega * X[i]
        R[1] -= o.force
        return R, J, D


def eliminate(A, b):
    """A x = b by Gauss with row pivots: x, and the sign of det A. Both are overwritten."""
    n, sign = len(b), 1
    for i in range(n):
        p = max(range(i, n), key=lambda r: abs(A[r][i]))
        if A[p][i] == 0:
            raise NoSolution("singular")
        sign = sign if (p == i) == (A[p][i] > 0) else -sign
        A[i], A[p], b[i], b[p] = A[p], A[i], b[p], b[i]
        for r in range(i + 1, n):
            m = A[r][i] / A[i][i]
            if m != 0:
                A[r][i:] = [a - m * c for a, c in zip(A[r][i:], A[i][i:])]
                b[r] -= m * b[i]
    for i in reversed(range(n)):
        b[i] = (b[i] - sum(map(mul, A[i][i + 1:], b[i + 1:]))) / A[i][i]
    return b, sign


MOST_ITERATIONS = 15
CLOSED = 1e-9  # [1] residual over F0; the curves are written with 7 digits


def newton(e, X, omega, along=None, target=0.0):
    """From X at omega, to a solution there or, `along` a direction (dX..., domega), to one on the plane that the
    predictor is on: X, omega, iterations."""
    X, kept = list(X), e.kept
    for iteration in range(MOST_ITERATIONS):
        R, J, D = e.residual(X, omega)
        least = [R[i] for i in kept]
        A = [[J[i][j] for j in kept] for i in kept]
        if along is not None:
            A = [row + [D[i]] for row, i in zip(A, kept)] + [list(along)]
            least.append(sum(map(mul, along, [X[i] for i in kept] + [omega])) - target)
        if max(map(abs, least[:len(kept)])) <= CLOSED * e.o.force and abs(least[-1]) <= CLOSED * e.o.force:
            return X, omega, iteration
        step, _ = eliminate(A, least)
        for i, d in zip(kept, step):
            X[i] -= d
        if along is not None:
            omega -= step[-1]
        if not max(map(abs, X)) < 1e6:
            break
    raise NoSolution(f"at omega {omega}")


def first_solution(e, omega):
    """From the linear response of the mass alone, or with a stuck contact, or what is between; else from a small force,
    which is increased."""
    o = e.o
    c, s = math.cos(math.radians(o.angle)), math.sin(math.radians(o.angle))

    def linear(part):
        stiffness = o.stiffness + part * (o.kt * c * c + o.kn * s * s)
        a = o.force / complex(stiffness - o.mass * omega ** 2, o.damping * omega)
        return [0.0, a.real, -a.imag] + [0.0] * (2 * e.code.harmonics - 2)
    for part in (0.0, 1.0, 0.5, 0.2, 0.8):
        try:
            return newton(e, linear(part), omega)[0]
        except NoSolution:
            pass
    steps = 100
    X = [a / steps for a in linear(1.0 if o.gap > 0 else 0.0)]
    for k in range(1, steps + 1):
        X = newton(Equations(replace(o, force=o.force * k / steps), e.code), X, omega)[0]
    return X


def unit(direction):
    size = math.sqrt(sum(map(mul, direction, direction)))
    return [d / size for d in direction]


def advance(e, X, omega, direction, step):
    """The solution on the plane that is `step` ahead in that direction: X, omega, iterations, and the unit vector to it
    from here."""
    guess = list(X)
    for i, d in zip(e.kept, direction):
        guess[i] += step * d
    target = sum(map(mul, direction, [guess[i] for i in e.kept] + [omega + step * direction[-1]]))
    there, omega_there, iterations = newton(e, guess, omega + step * direction[-1], direction, target)
    moved = unit([there[i] - X[i] for i in e.kept] + [omega_there - omega])
    return there, omega_there, iterations, moved


def around_kink(e, X, omega, direction, step):
    """As advance, along the tangent that holds beyond a kink close by: of its two ways the one that keeps the sign of
    det [J D; direction], as along every curve. A coarse AFT is linear in pieces: its curve may turn back at a kink."""
    def matrix(at, omega_at, last):
        _, J, D = e.residual(at, omega_at)
        return [[J[i][j] for j in e.kept] + [D[i]] for i in e.kept] + [list(last)]
    size = len(direction)
    _, before = eliminate(matrix(X, omega, direction), [0.0] * size)
    beyond = list(X)
    for i, d in zip(e.kept, direction):
        beyond[i] += step * d
    tangent, sign = eliminate(matrix(beyond, omega + step * direction[-1], direction), [0.0] * (size - 1) + [1.0])
    tangent = unit(tangent)  # tangent . direction > 0, so that det [J D; tangent] has this sign, too
    if sign != before:
        tangent = [-d for d in tangent]
    found = advance(e, X, omega, tangent, step)
    if eliminate(matrix(found[0], found[1], found[3]), [0.0] * size)[1] != before:
        raise NoSolution("back along where it came from")
    return found


def trace(e, start, stop, longest=0.3, most=3000):
    """[(omega, X)] along the curve from `start` to beyond `stop`, or as far as it goes."""
    X = first_solution(e, start)
    path, step, shortest = [(start, X)], longest / 8, longest / 4000
    side = 1.0 if stop > start else -1.0
    direction = [0.0] * len(e.kept) + [side]
    while len(path) < most and (stop - path[-1][0]) * side > 0 and (path[-1][0] - start) * side >= 0:
        omega, X = path[-1]
        try:
            there, omega_there, iterations, moved = advance(e, X, omega, direction, step)
            if sum(map(mul, moved, direction)) < 0.8 and step > 8 * shortest:
                raise NoSolution("the curve bends too much for this step")
        except NoSolution:
            step /= 2
            if step >= shortest:
                continue
            for step in (shortest * 4 ** k for k in range(-3, 5)):
                try:
                    there, omega_there, iterations, moved = around_kink(e, X, omega, direction, step)
                    break
                except NoSolution:
                    pass
            else:
                break
        path.append((omega_there, there))
        direction = moved
        if iterations <= 4:
            step = min(1.5 * step, longest)
    return path


def solutions(e, path, omegas):
    """[(omega, branch, X)] in the order along the path: at each of the omegas that it crosses; branch: how often it
    turned back in omega before."""
    found, branch, way = [], 0, 0.0
    for (w0, X0), (w1, X1) in zip(path, path[1:]):
        if (w1 - w0) * way < 0:
            branch += 1
        way = w1 - w0
        between = [w for w in omegas if w0 <= w < w1 or w1 < w <= w0]
        for omega in sorted(between, reverse=w1 < w0):
            part = (omega - w0) / (w1 - w0)
            try:
                X = newton(e, [a + part * (b - a) for a, b in zip(X0, X1)], omega)[0]
            except NoSolution:
                continue  # a kink of a coarse code; the curve has enough other points
            found.append((omega, branch, X))
    return found
