#!/usr/bin/env python3
"""check.py - decides whether a certificate of a periodic orbit under the exact contact law is true.

    python3 check.py CERTIFICATE... [--format text|json]      exit 0 all accepted, 1 one rejected, 2 a file is wrong, 64 usage

`-` is standard input, a certificate a line; there, and with --format json, an answer is a line of JSON. README.md has the format and the keys of answers.


Between two transitions of contacts the law is linear: Z' = A Z with Z = (x, v, 1, cos k omega t, sin k omega t, w of every
sticking slider), so the flow is exp(A tau) and an orbit is finitely many numbers: time and state at each transition. The certificate
holds these to some 25 digits. Checked, all in ball arithmetic on integers of fixed point (class Ball):
    existence    Krawczyk's test: exactly one zero of the shooting equations within `radius` (and within `uniqueness_radius`)
    law          on every segment each contact satisfies the conditions of its letter: O open, N closed without tangent, S stick, + - slip
    stability    Gershgorin's discs of the monodromy in the certificate's approximate eigenvectors
    claims       bounds on max, min, amplitude, mean and harmonic 1 contain those found here
Nothing that made the certificate is trusted; the float inverse in Krawczyk's test and the eigenvectors may be anything.
Standard library only. The checker in C beside it shares no code with this one; both give the same verdicts.
"""
import heapq
import json
import math
import re
import sys
from fractions import Fraction

MOST_BYTES, MOST_CHARACTERS, MOST_EXPONENT = 1 << 23, 120, 400
MOST_DOFS, MOST_CONTACTS, MOST_HARMONICS, MOST_UNKNOWNS, MOST_BITS, MOST_SPREAD = 64, 64, 16, 2048, 1024, 1500
MOST_WORK, MOST_DEPTH, MOST_PARTS = 1 << 22, 120, 20000  # work: substeps times the square of Z's size


class Wrong(Exception):
    """The file is not a certificate: exit 2."""


class Unproven(Exception):
    """The certificate is rejected: exit 1. Says nothing about other orbits."""

    def __init__(self, reason, segment=None, time=None, contact=None):
        super().__init__(reason)
        self.segment, self.time, self.contact = segment, time, contact


# ---- balls -------------------------------------------------------------------------------------------------------------------------
class Ball:
    """A real number within r 2^-bits of m 2^-bits; m and r are integers, bits is one for all. Every operation rounds r up."""
    __slots__ = ("m", "r")
    bits = 192

    def __init__(self, m, r=0):
        self.m, self.r = m, r

    @staticmethod
    def of(value):
        """The ball of an exact number: int, Fraction, float or decimal string. Rounded down by less than one unit."""
        top, bottom = Fraction(value).as_integer_ratio()
        m, rest = divmod(top << Ball.bits, bottom)
        return Ball(m, 1 if rest else 0)

    @property
    def lo(self):
        return self.m - self.r

    @property
    def hi(self):
        return self.m + self.r

    @property
    def size(self):
        """The largest absolute value, in units."""
        return abs(self.m) + self.r

    def __neg__(self):
        return Ball(-self.m, self.r)

    def __add__(self, other):
        return Ball(self.m + other.m, self.r + other.r)

    def __sub__(self, other):
        return Ball(self.m - other.m, self.r + other.r)

    def __mul__(self, other):
        return rounded(self.m * other.m, abs(self.m) * other.r + self.r * other.size)

    def __truediv__(self, other):
        """x/y - xm/ym is at most (|xm| ry + |ym| rx) / (|ym| (|ym| - ry))."""
        a, b = abs(self.m), abs(other.m)
        if b <= other.r:
            raise Unproven("division by a number that may be 0")
        return Ball((self.m << Ball.bits) // other.m, ((a * other.r + b * self.r) << Ball.bits) // (b * (b - other.r)) + 2)

    def over(self, k):
        """Divided by the integer k > 0."""
        return Ball(self.m // k, self.r // k + 2)

    def times(self, k):
        return Ball(self.m * k, self.r * abs(k))

    def root(self):
        lo, hi = max(self.lo, 0) << Ball.bits, max(self.hi, 0) << Ball.bits
        return between(math.isqrt(lo), math.isqrt(hi) + 1)

    def __float__(self):
        return self.m / (1 << Ball.bits)

    def __repr__(self):
        return f"{float(self):.17g} +- {self.r / (1 << Ball.bits):.3g}"


def rounded(m, r):
    """A ball from a product's middle and radius in units 2^-2 bits: both are cut, by less than one unit each."""
    return Ball(m >> Ball.bits, (r >> Ball.bits) + 2) if m or r else Ball(0)


def between(lo, hi):
    m = (lo + hi) >> 1
    return Ball(m, hi - m)


def pi():
    """Machin: pi = 16 arctan(1/5) - 4 arctan(1/239), alternating series, 32 more bits than asked."""
    one = 1 << (Ball.bits + 32)

    def arctan_of_inverse(k):
        total, power, j = 0, one // k, 1
        while power:
            total += power // j if j % 4 == 1 else -(power // j)
            power //= k * k
            j += 2
        return total  # each of j/2 terms was cut by less than 2 units, the rest is less than 1
    return Ball((16 * arctan_of_inverse(5) - 4 * arctan_of_inverse(239)) >> 32, 2)


def cos_sin(angle):
    """Taylor series at the middle less a multiple of 2 pi, with 24 more bits; the radius carries over since both slopes are within 1."""
    turn = pi().times(2)
    reduced = angle - turn.times((angle.m + turn.m // 2) // turn.m)  # |middle| <= pi + its radius < 4
    x, one = reduced.m << 24, 1 << (Ball.bits + 24)
    square, sums, term, j = (x * x) >> (Ball.bits + 24), [0, 0], [one, x], 0
    while any(term):
        for i in (0, 1):
            sums[i] += term[i]
            term[i] = -((term[i] * square) >> (Ball.bits + 24)) // ((j + i + 1) * (j + i + 2))
        if all(-2 <= t <= 2 for t in term):  # floors may leave -1 for ever; what follows is smaller than what is cut below
            break
        j += 2
    # At most bits terms, each wrong by less than 2 units grown by less than exp(4): under 2^24 units of 2^-(bits + 24).
    return tuple(Ball(s >> 24, reduced.r + 2) for s in sums)


# ---- rows, matrices: a row is {column: Ball}, a matrix a list of rows, a dense row a list of Balls -----------------------------------
def combine(*parts):
    """The row of sum coefficient * row."""
    out = {}
    for coefficient, row in parts:
        for c, value in row.items():
            out[c] = out[c] + coefficient * value if c in out else coefficient * value
    return out


def apply_row(row, vector):
    m = r = 0
    for c, a in row.items():
        b = vector[c]
        m += a.m * b.m
        r += abs(a.m) * b.r + a.r * b.size
    return rounded(m, r)


def row_times(row, matrix):
    """Row times a matrix of sparse rows."""
    sums = {}
    for k, a in row.items():
        size = abs(a.m)
        for c, b in matrix[k].items():
            m, r = sums.get(c, (0, 0))
            sums[c] = m + a.m * b.m, r + size * b.r + a.r * (abs(b.m) + b.r)
    return {c: rounded(m, r) for c, (m, r) in sums.items()}


def dot(a, b):
    m = r = 0
    for p, q in zip(a, b):
        pm, qm = p.m, q.m
        m += pm * qm
        if p.r or q.r:
            r += abs(pm) * q.r + p.r * (abs(qm) + q.r)
    return rounded(m, r)


def matmul(a, b):
    columns = list(zip(*b))
    return [[dot(row, column) for column in columns] for row in a]


def inverse_in_floats(matrix):
    """Gauss-Jordan with equilibrated rows and partial pivoting; None if it fails. Nobody relies on its accuracy."""
    n, rows = len(matrix), []
    for i, row in enumerate(matrix):
        size = max(map(abs, row))
        if not 0 < size < math.inf:
            return None
        rows.append([v / size for v in row] + [0.0] * i + [1 / size] + [0.0] * (n - 1 - i))
    for k in range(n):
        p = max(range(k, n), key=lambda i: abs(rows[i][k]))
        if not abs(rows[p][k]) > 1e-280:
            return None
        rows[k], rows[p] = rows[p], rows[k]
        pivot = [v / rows[k][k] for v in rows[k]]
        rows[k] = pivot
        for i in range(n):
            f = rows[i][k]
            if i != k and f:
                rows[i] = [a - f * b for a, b in zip(rows[i], pivot)]
    inverse = [row[n:] for row in rows]
    return inverse if all(map(math.isfinite, (v for row in inverse for v in row))) else None


# ---- the file ----------------------------------------------------------------------------------------------------------------------
NUMBER = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d{1,4})?\Z", re.ASCII)


def decimal(value, where):
    """A decimal string as an exact fraction. Size and exponent are limited."""
    if not isinstance(value, str) or len(value) > MOST_CHARACTERS or not NUMBER.match(value):
        raise Wrong(f"{where}: a number as a decimal string is expected")
    exponent = re.split("[eE]", value)
    if len(exponent) > 1 and abs(int(exponent[1])) > MOST_EXPONENT:
        raise Wrong(f"{where}: the exponent is beyond {MOST_EXPONENT}")
    return Fraction(value)


def whole(value, where, least, most):
    if not isinstance(value, int) or isinstance(value, bool) or not least <= value <= most:
        raise Wrong(f"{where}: a whole number from {least} to {most} is expected")
    return value


def fields(value, where, needed, others=()):
    if not isinstance(value, dict):
        raise Wrong(f"{where}: an object is expected")
    for name in needed:
        if name not in value:
            raise Wrong(f"{where}: `{name}` is missing")
    for name in value:  # others may be the object itself: any names are allowed
        if name not in needed and name not in others:
            raise Wrong(f"{where}: `{name}` is not known")
    return value


def items(value, where, least, most):
    if not isinstance(value, list) or not least <= len(value) <= most:
        raise Wrong(f"{where}: a list of {least} to {most} items is expected" if least != most else f"{where}: a list of {least} is expected")
    return value


def vector(value, where, n):
    return [decimal(v, f"{where}[{i}]") for i, v in enumerate(items(value, where, n, n))]


def square_matrix(value, where, n):
    return [vector(row, f"{where}[{i}]", n) for i, row in enumerate(items(value, where, n, n))]


def positive(value, where, zero=False):
    number = decimal(value, where)
    if number < 0 or not number and not zero:
        raise Wrong(f"{where}: a number {'>=' if zero else '>'} 0 is expected")
    return number


BOUNDS = ("max", "min", "amplitude", "mean", "a1", "b1", "harmonic_1")
TOP = ("model", "omega", "multiple", "precision_bits", "response", "rest", "scales", "events", "claims")


class Contact:
    """Exact numbers of one contact. Directions are sums of a symbol times a vector of fractions: {"": t} where the vector is given, {"cos 45": d}
    where it is made by an angle, so that what is proportional by construction is seen to be."""

    def __init__(self, c, where, n):
        angled, normal = "direction" in c if isinstance(c, dict) else False, "normal" in c if isinstance(c, dict) else False
        tangent = angled or isinstance(c, dict) and "tangent" in c
        if not tangent and not normal:
            raise Wrong(f"{where}: a contact without directions")
        needed = ("direction", "angle_deg") if angled else ("tangent",) * tangent + ("normal",) * normal
        needed += ("tangential_stiffness", "friction") * tangent + (("normal_stiffness", "gap") if angled or normal else ("preload",))
        fields(c, where, needed)
        get = lambda name, zero=False: positive(c[name], f"{where}.{name}", zero) if name in c else Fraction(0)
        self.kt, self.mu, self.kn, self.preload = get("tangential_stiffness", True), get("friction", True), get("normal_stiffness"), get("preload", True)
        self.gap = decimal(c["gap"], where + ".gap") if "gap" in c else Fraction(0)
        self.t = self.n = self.ratio = None
        if angled:
            direction, self.angle = vector(c["direction"], where + ".direction", n), decimal(c["angle_deg"], where + ".angle_deg")
            if self.angle % 90 == 0:
                raise Wrong(f"{where}.angle_deg: at a multiple of 90 the contact is written with `preload`, or with `normal` only")
            self.t, self.n = {f"cos {self.angle}": direction}, {f"sin {self.angle}": direction}
        else:
            self.t = {"": vector(c["tangent"], where + ".tangent", n)} if tangent else None
            self.n = {"": vector(c["normal"], where + ".normal", n)} if normal else None
        for row in filter(None, (self.t, self.n)):
            if not any(map(any, row.values())):
                raise Wrong(f"{where}: a direction is 0")
        self.rubs = bool(tangent and self.kt and self.mu and (self.n or self.preload))  # else: no tangent
        self.letters = ("O" if self.n else "") + ("S+-" if self.rubs else "N")

    def prepare(self):
        """Numbers as balls; ratio: u / v where they are proportional by construction."""
        value = {"": Ball.of(1)}
        if self.t and "" not in self.t:
            cosine, sine = cos_sin(pi() * Ball.of(self.angle / 180))
            value[f"cos {self.angle}"], value[f"sin {self.angle}"], self.ratio = cosine, sine, cosine / sine
        elif self.t and self.n:
            t, n = self.t[""], self.n[""]
            k = next(i for i, v in enumerate(n) if v)
            if all(a * n[k] == b * t[k] for a, b in zip(t, n)):
                self.ratio = Ball.of(t[k] / n[k])
        self.row_t, self.row_n = ({j: value[s] * Ball.of(v) for s, d in row.items() for j, v in enumerate(d) if v} if row else {} for row in (self.t, self.n))
        self.ball = {name: Ball.of(getattr(self, name)) for name in ("kt", "mu", "kn", "gap", "preload")}


class Certificate:
    """What the file says, as exact numbers."""

    def __init__(self, data):
        fields(data, "certificate", TOP, data)
        model = fields(data["model"], "model", ("mass", "damping", "stiffness", "forcing", "contacts"))
        self.n = n = len(items(model["mass"], "model.mass", 1, MOST_DOFS))
        self.mass, self.damping, self.stiffness = (square_matrix(model[k], f"model.{k}", n) for k in ("mass", "damping", "stiffness"))
        self.omega = positive(data["omega"], "omega")
        self.multiple = whole(data["multiple"], "multiple", 1, 1000)
        self.precision = whole(data["precision_bits"], "precision_bits", 32, MOST_BITS)
        self.response = vector(data["response"], "response", n)
        self.forcing = []
        for i, f in enumerate(items(model["forcing"], "model.forcing", 0, MOST_HARMONICS)):
            where = f"model.forcing[{i}]"
            fields(f, where, ("harmonic", "cos", "sin"))
            self.forcing.append((whole(f["harmonic"], where + ".harmonic", 0, 1000), vector(f["cos"], where + ".cos", n), vector(f["sin"], where + ".sin", n)))
            if self.forcing[-1][0] == 0 and any(self.forcing[-1][2]):
                raise Wrong(f"{where}: harmonic 0 has no sine")
        if len({h for h, _, _ in self.forcing}) < len(self.forcing):
            raise Wrong("model.forcing: a harmonic is there twice")
        contacts = items(model["contacts"], "model.contacts", 0, MOST_CONTACTS)
        self.contacts = [Contact(c, f"model.contacts[{i}]", n) for i, c in enumerate(contacts)]
        scales = fields(data["scales"], "scales", ("x", "v", "t"), data["scales"])
        self.scales = [positive(scales[k], f"scales.{k}") for k in ("x", "v", "t")]
        self.rest = {}
        for key, value in fields(data["rest"], "rest", (), data["rest"]).items():
            if not key.isdecimal() or not key.isascii() or len(key) > 3 or int(key) >= len(contacts) or key != str(int(key)):
                raise Wrong(f"rest: `{key[:20]}` is not the number of a contact")
            self.rest[int(key)] = decimal(value, f"rest.{key}")
        self.read_events(data["events"])
        claims = fields(data["claims"], "claims", ("radius", "uniqueness_radius"), data["claims"])
        claims = {name: value for name, value in claims.items() if value is not None}  # what is not claimed, or null, is not checked
        self.radius, self.uniqueness = (positive(claims.get(k), f"claims.{k}") for k in ("radius", "uniqueness_radius"))
        self.stability = claims.get("stability", "unproven")
        if self.stability not in ("stable", "unstable", "unproven"):
            raise Wrong("claims.stability: stable, unstable or unproven is expected")
        self.bounds = {name: vector(claims[name], f"claims.{name}", 2) for name in BOUNDS + ("multiplier",) if name in claims}
        self.vectors = data.get("vectors")
        if self.vectors is not None:
            size = len(items(self.vectors, "vectors", 2 * n, 2 * n + len(contacts)))
            self.vectors = [[vector(v, f"vectors[{i}][{j}]", 2) for j, v in enumerate(items(row, f"vectors[{i}]", size, size))] for i, row in enumerate(self.vectors)]

    def read_events(self, events):
        n, self.events = self.n, []
        items(events, "events", 1, max(MOST_UNKNOWNS // (2 * n + 1), 1))
        self.section = isinstance(events[0], dict) and "section" in events[0]
        if len(events) > 1 and any(isinstance(e, dict) and "section" in e for e in events):
            raise Wrong("events: a section stands alone")
        for i, e in enumerate(events):
            where = f"events[{i}]"
            fields(e, where, ("t", "x", "v", "state"), e)
            letters = e["state"]
            if not isinstance(letters, str) or len(letters) != len(self.contacts):
                raise Wrong(f"{where}.state: a letter for each of {len(self.contacts)} contacts is expected")
            for c, letter in enumerate(letters):
                if letter not in self.contacts[c].letters:
                    raise Wrong(f"{where}.state: contact {c} is one of {self.contacts[c].letters}")
            self.events.append((decimal(e["t"], where + ".t"), vector(e["x"], where + ".x", n), vector(e["v"], where + ".v", n), letters))
        self.letters = [e[3] for e in self.events]
        if self.section:
            whole(events[0]["section"], "events[0].section", 1, 1)
        for i, letters in enumerate(self.letters):
            if not self.section and letters == self.letters[i - 1]:
                raise Wrong(f"events: at number {i} no letter changes")
        for c in range(len(self.contacts)):
            if all(s[c] == "S" for s in self.letters) != (c in self.rest):
                raise Wrong(f"rest: contact {c} " + ("does not stick all period" if c in self.rest else "sticks all period: where it rests is missing"))


def read(path):
    try:
        with open(path, "rb") as file:
            return file.read(MOST_BYTES + 1)
    except (OSError, ValueError) as error:
        raise Wrong(getattr(error, "strerror", None) or "cannot be read") from None


def parse(text):
    if len(text) > MOST_BYTES:
        raise Wrong(f"it is longer than {MOST_BYTES} bytes")

    def once(pairs):
        names = dict(pairs)
        if len(names) != len(pairs):
            raise ValueError("a name stands twice in an object")
        return names

    def constant(name):
        raise ValueError(f"{name[:40]} is no number")

    def within(kind, most):
        return lambda digits: value if abs(value := kind(digits[:400])) < most else constant(digits)
    try:
        return Certificate(json.loads(text.decode("utf-8"), object_pairs_hook=once, parse_constant=constant,
                                      parse_int=within(int, 1 << 63), parse_float=within(float, math.inf)))
    except RecursionError:
        raise Wrong("nested too deeply") from None
    except ValueError as error:
        raise Wrong(f"not JSON: {error}"[:200]) from None


# ---- the equations -----------------------------------------------------------------------------------------------------------------
def inverse_exactly(matrix):
    n = len(matrix)
    rows = [list(row) + [Fraction(i == j) for j in range(n)] for i, row in enumerate(matrix)]
    for k in range(n):
        p = next((i for i in range(k, n) if rows[i][k]), None)
        if p is None:
            raise Unproven("the mass matrix is singular")
        rows[k], rows[p] = rows[p], rows[k]
        rows[k] = [v / rows[k][k] for v in rows[k]]
        for i in range(n):
            if i != k and rows[i][k]:
                f = rows[i][k]
                rows[i] = [a - f * b for a, b in zip(rows[i], rows[k])]
    return [row[n:] for row in rows]


class Segment:
    """The motion from event i to i + 1: Z' = A Z. Columns of Z: x 0..n-1, v n..2n-1, one 2n, cosine and sine of each harmonic, w of each sticking contact."""

    def __init__(self, orbit, i):
        cert, n = orbit.cert, orbit.cert.n
        self.i, self.letters = i, cert.letters[i]
        self.sticks = [c for c, letter in enumerate(self.letters) if letter == "S"]
        first = 2 * n + 1 + 2 * len(orbit.harmonics)
        self.w = {c: first + k for k, c in enumerate(self.sticks)}
        self.size = first + len(self.sticks)
        one = self.one = 2 * n
        ball_one = Ball.of(1)
        A = [{n + j: ball_one} for j in range(n)]
        force = [combine((ball_one, {k: v for k, v in enumerate(map(Ball.of, cert.stiffness[j])) if v.size}),
                         (ball_one, {n + k: v for k, v in enumerate(map(Ball.of, cert.damping[j])) if v.size}),
                         (Ball.of(-1), orbit.load[j])) for j in range(n)]
        for c, contact in enumerate(cert.contacts):
            b, letter = contact.ball, self.letters[c]
            normal = self.normal_force(contact) if letter != "O" else {}
            if contact.n:
                rest_force = Ball.of(max(contact.kn * contact.gap, 0))
                change = combine((ball_one, normal), (-rest_force, {one: ball_one}))  # N - N0
                for j, v in contact.row_n.items():
                    force[j] = combine((ball_one, force[j]), (v, change))
            if letter in "S+-":
                sign = Ball.of({"S": 0, "+": 1, "-": -1}[letter])
                friction = combine((b["kt"], contact.row_t), (-b["kt"], {self.w[c]: ball_one})) if letter == "S" else combine((sign * b["mu"], normal))
                for j, v in contact.row_t.items():
                    force[j] = combine((ball_one, force[j]), (v, friction))
        A += [combine(*((Ball.of(-v), force[k]) for k, v in enumerate(orbit.mass_inverse[j]) if v)) for j in range(n)]
        A.append({})
        for k, h in enumerate(orbit.harmonics):
            cosine, rate = one + 1 + 2 * k, orbit.omega.times(h)
            A += [{cosine + 1: -rate}, {cosine: rate}]
        self.A = A + [{}] * len(self.sticks)
        self.choose_weights(n)

    def normal_force(self, contact):
        b = contact.ball
        return combine((b["kn"], contact.row_n), (b["kn"], {self.one: b["gap"]})) if contact.n else {self.one: b["preload"]}

    def choose_weights(self, n):
        """Weighted max norm |Z| = max |Z_j| 2^-e_j: e = 0 for x and w, Omega for v, Omega^2 / |f| for one, cosines and sines. Any weights are right."""
        sliders = self.size - len(self.sticks)
        stiff = max(sum(v.size for c, v in row.items() if c < n or c >= sliders) for row in self.A[n:2 * n])
        load = max(sum(v.size for c, v in row.items() if 2 * n <= c < sliders) for row in self.A[n:2 * n])
        log2 = lambda size: size.bit_length() - Ball.bits
        omega = (log2(stiff) + 1) // 2 if stiff else 0
        given = 2 * omega - log2(load) if load else 0
        self.e = [0] * n + [omega] * n + [given] * (self.size - 2 * n - len(self.sticks)) + [0] * len(self.sticks)
        self.norm = max(sum(shift(v.size, self.e[c] - self.e[j]) for c, v in row.items()) for j, row in enumerate(self.A))

    def terms(self, h):
        """How many Taylor terms exp(A s), |s| <= |h| needs, and the bound of those left out, relative to |Z|, in units."""
        nu = (self.norm * h.size >> Ball.bits) + 1
        rest, q = nu, 0  # nu^(q + 1) / (q + 1)!
        while rest > 1 and q < 400:
            q += 1
            rest = (rest * nu >> Ball.bits) // (q + 1) + 1
        if nu >= (q + 2) << (Ball.bits - 1):
            raise Unproven("the box is too wide in time")
        return q, 2 * rest  # the tail is geometric with a ratio of nu / (q + 2) < 1/2

    def exponential(self, h):
        """exp(A h) by Taylor's series, row by row. h: |A| h of some units at most."""
        q, rest = self.terms(h)
        Ah = [{c: v * h for c, v in row.items()} for row in self.A]
        out = []
        for i in range(self.size):
            total, term = [Ball(0)] * self.size, {i: Ball.of(1)}
            for j in range(q + 1):
                for c, v in term.items():
                    total[c] = total[c] + v
                if not (term := {c: v.over(j + 1) for c, v in row_times(term, Ah).items()}):
                    break  # a row of constants: nothing is left out
            else:
                total = [Ball(v.m, v.r + shift(rest, self.e[i] - self.e[c])) for c, v in enumerate(total)]
            out.append(total)
        return out

    def carried(self, columns, h):
        """exp(A h) times a matrix, by Taylor's series on its columns: of an h = 0 +- r, r |A columns| is added, not r |A| |columns|."""
        (q, rest), width, out, term = self.terms(h), range(len(columns[0])), columns, columns
        for j in range(1, q + 1):
            by = h.over(j)
            term = [[dot(row.values(), [term[c][k] for c in row]) * by for k in width] for row in self.A]
            out = [[a + b for a, b in zip(*rows)] for rows in zip(out, term)]
        left_out = [(max(shift(row[k].size, -e) for row, e in zip(columns, self.e)) * rest >> Ball.bits) + 1 for k in width]
        return [[Ball(v.m, v.r + shift(left_out[k], e)) for k, v in enumerate(row)] if a else row for row, a, e in zip(out, self.A, self.e)]

    def powers(self, tau):
        """exp(A h)^(2^b), b = 0..p, with 2^p substeps h = tau / 2^p, |A| h <= 2. The last is exp(A tau)."""
        nu, p = self.norm * tau.size >> Ball.bits, 0
        while nu >> p > 2 << Ball.bits and p < 64:
            p += 1
        if self.size ** 2 << p > MOST_WORK:
            raise Unproven(f"segment {self.i}: too stiff, {1 << p} substeps", self.i)
        out = [self.exponential(Ball(tau.m >> p, (tau.r >> p) + 2))]
        for _ in range(p):
            out.append(matmul(out[-1], out[-1]))
        return out


def shift(value, bits):
    """value 2^bits, rounded up."""
    return value << bits if bits >= 0 else -(-value >> -bits)


class Orbit:
    """The shooting equations. Unknowns: x, v, t of every event (x, v alone without any transition)."""

    def __init__(self, cert):
        self.cert, n, self.m = cert, cert.n, len(cert.events)
        Ball.bits = cert.precision + 64 + self.spread()
        for contact in cert.contacts:
            contact.prepare()
        self.omega, self.mass_inverse = Ball.of(cert.omega), inverse_exactly(cert.mass)
        self.harmonics = sorted({1} | {h for h, _, _ in cert.forcing if h})
        self.load = [{} for _ in range(n)]
        for h, cosine, sine in cert.forcing:
            column = 2 * n + 1 + 2 * self.harmonics.index(h) if h else 2 * n
            for j in range(n):
                self.load[j] = combine((Ball.of(1), self.load[j]), (Ball.of(cosine[j]), {column: Ball.of(1)}), *[(Ball.of(sine[j]), {column + 1: Ball.of(1)})] * (h > 0))
        self.period = (pi().times(2 * cert.multiple)) / self.omega
        self.width = 2 * n + (not cert.section)
        self.scale = ([Ball.of(cert.scales[0])] * n + [Ball.of(cert.scales[1])] * n + [Ball.of(cert.scales[2])] * (not cert.section)) * self.m
        self.segments = [Segment(self, i) for i in range(self.m)]
        self.rests = [{c: self.rest_position(c, i) for c in s.sticks} for i, s in enumerate(self.segments)]
        self.guards = [] if cert.section else [self.guard(i) for i in range(self.m)]

    def spread(self):
        """Bits between the largest and the smallest of what enters A and the scales: the balls' point is fixed."""
        cert = self.cert
        numbers = [v for matrix in (cert.mass, cert.damping, cert.stiffness) for row in matrix for v in row] + cert.scales + [cert.omega]
        numbers += [v for c in cert.contacts for v in (c.kt, c.kn)]
        logs = [v.numerator.bit_length() - v.denominator.bit_length() for v in numbers if v]
        if max(logs) - min(logs) > MOST_SPREAD:
            raise Unproven("existence: the numbers of the model are too far apart")
        return 2 * (max(logs) - min(logs))

    def rest_position(self, c, i):
        """w of contact c that sticks in segment i, as (event where the stick began, row on its x, constant, letter before):
        t.x where it touched, t.x - s mu N / kt where it slipped; where it sticks all period the number `rest`."""
        contact, letters = self.cert.contacts[c], self.cert.letters
        b = contact.ball
        if c in self.cert.rest:
            return None, {}, Ball.of(self.cert.rest[c]), "S"
        while letters[i - 1][c] == "S":
            i = (i - 1) % self.m
        before = letters[i - 1][c]
        if before == "O":
            return i, contact.row_t, Ball(0), before
        lever = -Ball.of(contact.mu / contact.kt).times(1 if before == "+" else -1)
        row = combine((Ball.of(1), contact.row_t), (lever * b["kn"], contact.row_n))
        return i, row, lever * (b["kn"] * b["gap"] if contact.n else b["preload"]), before

    def rest_value(self, y, entry):
        event, row, constant, _ = entry
        return apply_row(row, y[event * self.width:]) + constant if row else constant

    def guard(self, i):
        """The equation of event i: (row on x, v of the event, constant, contact whose w enters or None, its coefficient)."""
        cert, n, before, after = self.cert, self.cert.n, self.cert.letters[i - 1], self.cert.letters[i]
        changed = [c for c in range(len(before)) if before[c] != after[c]]
        out, forms = None, []
        for c in changed:
            contact, change = cert.contacts[c], before[c] + after[c]
            b, at, one = contact.ball, {}, Ball.of(1)
            if "O" in change:
                if change == "SO" and not self.touched_in_proportion(c, i - 1):
                    raise Unproven(f"segment {i}, contact {c}: stick to open, where N = 0 would mean slip before", i, None, c)
                row = combine((one, contact.row_n)), b["gap"], None, None  # n.x + gap = 0
                at = exact([(1, contact.n, "x")], contact.gap)
            elif change in ("S+", "S-"):
                s = 1 if change == "S+" else -1
                normal = combine((b["mu"] * b["kn"], contact.row_n)), b["mu"] * (b["kn"] * b["gap"] if contact.n else b["preload"])
                row = combine((one, normal[0]), (-b["kt"].times(s), contact.row_t)), normal[1], c, b["kt"].times(s)  # mu N - s kt (t.x - w) = 0
                at = self.exact_limit(c, i, s)
            elif change in ("+S", "-S"):
                s = 1 if change == "+S" else -1
                rate = combine((b["kt"].times(s), contact.row_t), (-(b["mu"] * b["kn"]), contact.row_n))
                row = {n + j: v for j, v in rate.items()}, Ball(0), None, None  # s kt t.v - mu kn n.v = 0
                at = exact([(s * contact.kt, contact.t, "v"), (-contact.mu * contact.kn, contact.n, "v")], 0)
            else:
                raise Unproven(f"segment {i}, contact {c}: {change[0]} to {change[1]} directly", i, None, c)
            out = out or row
            forms.append(at)
        # Several contacts at one event: only if all their guards are proportional, so that the first one's zero is a zero of all;
        # a limit, which has a history, only that of equal contacts with equal histories.
        first, slips = changed[0], before[changed[0]] == "S" and after[changed[0]] != "O"
        for c, form in zip(changed[1:], forms[1:]):
            if not proportional(forms[0], form) or slips and not self.twins(first, c):
                raise Unproven(f"two independent transitions at once: event {i}, contacts {changed[0]} and {c}", i, None, c)
        return out

    def twins(self, a, b):
        """Are two contacts equal, with equal histories?"""
        numbers = [(c.kt, c.mu, c.kn, c.preload, c.gap, c.t, c.n) for c in (self.cert.contacts[a], self.cert.contacts[b])]
        return numbers[0] == numbers[1] and self.cert.rest.get(a) == self.cert.rest.get(b) and all(s[a] == s[b] for s in self.cert.letters)

    def touched_in_proportion(self, c, i):
        return self.cert.contacts[c].ratio is not None and self.rests[i][c][3] == "O"

    def exact_limit(self, c, i, s):
        """mu N - s kt (t.x - w) as an exact form in x of this event and x of the event where the stick began."""
        contact = self.cert.contacts[c]
        event, _, _, before = self.rests[i - 1][c]
        push, shear = contact.mu * contact.kn, s * contact.kt
        constant = push * contact.gap + contact.mu * contact.preload
        parts = [(push, contact.n, "x"), (-shear, contact.t, "x")]
        if event is None:
            return exact(parts, constant + shear * self.cert.rest[c])
        parts.append((shear, contact.t, event))
        if before != "O":
            lever = -s * (1 if before == "+" else -1)  # shear (- s0 mu / kt)
            parts.append((lever * push, contact.n, event))
            constant += lever * (push * contact.gap + contact.mu * contact.preload)
        return exact(parts, constant)

    def state(self, i, y):
        """Z just after event i."""
        n, at = self.cert.n, i * self.width
        t = Ball.of(self.cert.events[0][0]) if self.cert.section else y[at + 2 * n]
        z = list(y[at:at + 2 * n]) + [Ball.of(1)]
        for h in self.harmonics:
            z += cos_sin(self.omega.times(h) * t)
        return z + [self.rest_value(y, self.rests[i][c]) for c in self.segments[i].sticks]

    def times(self, y):
        """The segments' lengths. PROOF: the events are in order, and within one period."""
        if self.cert.section:
            return [self.period]
        t = y[2 * self.cert.n::self.width]
        taus = [b - a for a, b in zip(t, t[1:] + [t[0] + self.period])]
        for i, tau in enumerate(taus):
            if tau.lo <= 0:
                raise Unproven(f"times not in order: segment {i} takes {float(tau):.6g}")
        return taus

    def shoot(self, y, flows, middles):
        """F(y) and the rows of DF(y): the flow of event i less event i + 1 (2n rows), the guard of event i. flows: exp(A middle) of each segment."""
        n, width, values, rows = self.cert.n, self.width, [], []
        for i, (segment, tau, middle) in enumerate(zip(self.segments, self.times(y), middles)):
            z, at, to = self.state(i, y), i * width, (i + 1) % self.m * width
            E = segment.carried([row + [dot(row, z)] for row in flows[i]], tau - middle)
            end = [row[-1] for row in E]
            start_rate, rate = ([apply_row(row, at_z) for row in segment.A[:2 * n]] for at_z in (z, end))
            for r in range(2 * n):
                row = dict(enumerate(E[r][:2 * n], at))
                row[to + r] = row.get(to + r, Ball(0)) - Ball.of(1)
                for c in segment.sticks:
                    event, lever, _, _ = self.rests[i][c]
                    for j, v in lever.items():
                        k = event * width + j
                        row[k] = row.get(k, Ball(0)) + E[r][segment.w[c]] * v
                if not self.cert.section:
                    row[at + 2 * n] = -dot(E[r][:2 * n], start_rate)  # dZ/dt of the event, the load's phase, less A Z
                    row[to + 2 * n] = row.get(to + 2 * n, Ball(0)) + rate[r]
                values.append(end[r] - y[to + r])
                rows.append(row)
        for i, (guard, constant, c, lever) in enumerate(self.guards):
            row = {i * width + j: v for j, v in guard.items()}
            value = apply_row(guard, y[i * width:]) + constant
            if c is not None:
                entry = self.rests[i - 1][c]
                value = value + lever * self.rest_value(y, entry)
                for j, v in entry[1].items():
                    k = entry[0] * width + j
                    row[k] = row.get(k, Ball(0)) + lever * v
            values.append(value)
            rows.append(row)
        return values, rows


def exact(parts, constant):
    """An affine form as {symbol: {unknown: fraction}} without zeros, from (factor, direction, which of the unknowns)."""
    form = {}
    for factor, direction, which in parts:
        for symbol, values in (direction or {}).items():
            for j, v in enumerate(values):
                entries = form.setdefault(symbol, {})
                entries[which, j] = entries.get((which, j), 0) + factor * v
    form.setdefault("", {})["one"] = Fraction(constant)
    form = {symbol: {k: v for k, v in entries.items() if v} for symbol, entries in form.items()}
    return {symbol: entries for symbol, entries in form.items() if entries}


def proportional(f, g):
    """Whatever the symbols' values: one factor for all entries, or every symbol's vector parallel to one vector."""
    def parallel(a, b):
        return a.keys() == b.keys() and len({b[k] / a[k] for k in a}) == 1
    flat = [{(s, k): v for s, entries in form.items() for k, v in entries.items()} for form in (f, g)]
    if not flat[0] or not flat[1]:
        return False
    vectors = list(f.values()) + list(g.values())
    return parallel(*flat) or all(parallel(vectors[0], v) for v in vectors[1:])


# ---- existence ---------------------------------------------------------------------------------------------------------------------
class Krawczyk:
    """Y = y0 +- rho scale. If |B F(y0)| + |I - B DF(Y)| rho scale < rho scale in every component, F has exactly one zero in Y."""

    def __init__(self, orbit):
        self.orbit, cert = orbit, orbit.cert
        self.y = [Ball.of(v) for t, x, v, _ in cert.events for v in x + v + ([] if cert.section else [t])]
        self.taus = [Ball(tau.m) for tau in orbit.times(self.y)]
        self.flows = [s.powers(tau)[-1] for s, tau in zip(orbit.segments, self.taus)]  # exp(A mid)
        values, rows = orbit.shoot(self.y, self.flows, self.taus)
        size = len(self.y)
        try:
            floats = [[float(row[k] * orbit.scale[k]) if k in row else 0.0 for k in range(size)] for row in rows]
        except OverflowError:
            floats = [[0.0]]
        inverse = inverse_in_floats(floats)
        if inverse is None:
            raise Unproven("the shooting equations are singular")
        self.B = [[Ball.of(v).m for v in row] for row in inverse]
        self.step = [rounded(sum(b * f.m for b, f in zip(row, values)), sum(abs(b) * f.r for b, f in zip(row, values))).size for row in self.B]

    def image(self, rho, name="radius"):
        """The half widths |B F(y0)| + |I - B DF(Y)| rho in scaled unknowns, in units; an error if they are not within rho."""
        wide = Ball.of(rho)
        y = [Ball(v.m, v.r + (s * wide).size) for v, s in zip(self.y, self.orbit.scale)]
        try:
            _, rows = self.orbit.shoot(y, self.flows, self.taus)
        except Unproven:  # the box is so wide that times may be in another order
            raise Unproven(f"Krawczyk gives inf of the {name}") from None
        rows = [{k: v * self.orbit.scale[k] for k, v in row.items()} for row in rows]
        widths = []
        for i, b in enumerate(self.B):
            sums = [[0, 0] for _ in b]
            for factor, row in zip(b, rows):
                if factor:
                    for k, v in row.items():
                        entry = sums[k]
                        entry[0] -= factor * v.m
                        entry[1] += abs(factor) * v.r
            sums[i][0] += 1 << (2 * Ball.bits)
            contraction = sum((abs(m) + r >> Ball.bits) + 1 for m, r in sums)
            widths.append(self.step[i] + (contraction * wide.hi >> Ball.bits) + 1)
        # Strictly inside, in every component.
        if not max(widths) < wide.lo:
            raise Unproven(f"Krawczyk gives {float(min(Fraction(max(widths), max(wide.lo, 1)), Fraction(10 ** 99))):.2g} of the {name}")
        return widths

    def box(self, rho):
        """The image of the box at rho: the orbit is in it, and it is smaller."""
        widths = self.image(rho)
        return [Ball(v.m, v.r + (s.size * w >> Ball.bits) + 1) for v, s, w in zip(self.y, self.orbit.scale, widths)]


# ---- functions over a segment ------------------------------------------------------------------------------------------------------
class Polynomial:
    """On [0, 1] within r of the polynomial with these Bernstein coefficients (units): its range is within theirs, and the ends are exact."""
    tables = {}

    def __init__(self, b, r):
        self.b, self.r = b, r

    @staticmethod
    def of(balls):
        """From Taylor coefficients: b_i = sum_j<=i C(i, j) / C(d, j) a_j."""
        d = len(balls) - 1
        if d not in Polynomial.tables:
            common = math.lcm(*(math.comb(d, j) for j in range(d + 1)))
            Polynomial.tables[d] = common, [[math.comb(i, j) * common // math.comb(d, j) for j in range(i + 1)] for i in range(d + 1)]
        common, table = Polynomial.tables[d]
        middles = [a.m for a in balls]
        return Polynomial([sum(map(int.__mul__, row, middles)) // common for row in table], sum(a.r for a in balls) + 1)

    def halves(self):
        """De Casteljau; each of d rounds cuts less than one unit."""
        left, right, b = [self.b[0]], [self.b[-1]], self.b
        while len(b) > 1:
            b = [(p + q) >> 1 for p, q in zip(b, b[1:])]
            left.append(b[0])
            right.append(b[-1])
        r = self.r + len(left)
        return Polynomial(left, r), Polynomial(right[::-1], r)

    def sign(self):
        """1 or -1 if it has this sign all over [0, 1], 0 if that is not seen."""
        return 1 if min(self.b) > self.r else -1 if max(self.b) < -self.r else 0


class Motion:
    """The motion on one segment over the whole box, in 2^p substeps of the duration's middle; the last ends where the segment does, for every tau of the box."""

    def __init__(self, orbit, i, y, tau):
        self.segment = s = orbit.segments[i]
        middle, spread = Ball(tau.m), Ball(0, tau.r)
        powers = s.powers(middle)
        p = len(powers) - 1
        self.flow, self.steps = s.carried(powers[-1], spread), 1 << p
        self.h = Ball(tau.m >> p, 2)
        self.last = self.h + spread
        self.states = [orbit.state(i, y)]
        for k in range(1, self.steps):
            b = (k & -k).bit_length() - 1  # Z at k from Z at k less its lowest bit: few products in a row
            self.states.append([dot(row, self.states[k - (1 << b)]) for row in powers[b]])
        self.terms, self.left_out = s.terms(self.last)
        self.Ah = [[{c: v * h for c, v in row.items()} for row in s.A] for h in (self.h, self.last)]

    def length(self, k):
        return self.last if k == self.steps - 1 else self.h

    def series(self, k):
        """Taylor's series of Z on substep k, s = 0..1; what it leaves out is in the radius of the first coefficients."""
        z, e = self.states[k], self.segment.e
        left_out = (max(shift(v.size, -w) for v, w in zip(z, e)) * self.left_out >> Ball.bits) + 1
        out = [[Ball(v.m, v.r + shift(left_out, w)) for v, w in zip(z, e)]]
        for j in range(1, self.terms + 1):
            z = [apply_row(row, z).over(j) if row else Ball(0) for row in self.Ah[k == self.steps - 1]]
            out.append(z)
        return out


# ---- the law -----------------------------------------------------------------------------------------------------------------------
def conditions(orbit, i, c):
    """What the letter of contact c in segment i asks: (words, row G of Z, order of the exact zero at the start, at the end); G > 0 between."""
    cert, segment, contact = orbit.cert, orbit.segments[i], orbit.cert.contacts[c]
    before, letter, after = cert.letters[i - 1][c], cert.letters[i][c], cert.letters[(i + 1) % orbit.m][c]
    b, one = contact.ball, Ball.of(1)
    gap = combine((one, contact.row_n), (b["gap"], {segment.one: one}))
    if letter == "O":
        # O: -(n.x + gap) > 0. At the start a simple zero if it was closed, at the end a simple zero if it closes.
        yield "open", combine((-one, gap)), int(before != "O"), int(after != "O")
        return
    if contact.n:
        # N, S, +, - with a normal: n.x + gap > 0. Simple zeros: at the start from O, at the end to O.
        yield "closed", gap, int(before == "O"), int(after == "O")
    if letter == "S":
        if orbit.touched_in_proportion(c, i):
            # PROOF section 4: u and v proportional, stick begun by touching: both limits are (mu kn -+ kt t/n)(v + gap), whose factor has one sign.
            for s in (1, -1):
                factor = b["mu"] * b["kn"] - b["kt"].times(s) * contact.ratio
                if factor.hi < 0:
                    raise Unproven(f"segment {i}, contact {c}: stick within the limit {'+' if s > 0 else '-'}: it is negative", i, None, c)
                if factor.lo <= 0:
                    raise Unproven(f"edge of the cone: segment {i}, contact {c}", i, None, c)
            return
        normal = segment.normal_force(contact)
        for s, name in ((1, "+"), (-1, "-")):
            # S: mu N -+ kt (t.x - w) > 0, both. At the start, from O: simple, both; from slip s: double for s, none for -s. At the end, to slip s: simple for s.
            row = combine((b["mu"], normal), (-b["kt"].times(s), contact.row_t), (b["kt"].times(s), {segment.w[c]: one}))
            yield f"stick within the limit {name}", row, 0 if before == "S" else 1 if before == "O" else 2 if before == name else 0, int(after == name)
    if letter in "+-":
        # Slip s: s kt t.v - mu kn n.v > 0. No zero at the start, not even from S or O; at the end a simple one if to S.
        rate = combine((b["kt"].times(1 if letter == "+" else -1), contact.row_t), (-(b["mu"] * b["kn"]), contact.row_n))
        yield f"slip in direction {letter}", {cert.n + j: v for j, v in rate.items()}, 0, int(after == "S")


def check_condition(motion, series, k, begin, c, words, rows, start, end):
    """G > 0 on substep k. Next to an exact zero of order p at the segment's start it is enough that G^(p) > 0 on all of a part [0, b], next to one
    at its end that G' < 0 on all of [a, end]; everywhere else G > 0. Parts are halved until each satisfies the one that applies to it. rows: G, G', G''."""
    at_start, at_end = start > 0 and k == 0, end > 0 and k == motion.steps - 1
    needed = {0} | ({start} if at_start else set()) | ({1} if at_end else set())
    parts = [(0.0, 1.0, at_start, at_end, {p: Polynomial.of([apply_row(rows[p], z) for z in series]) for p in needed}, 0)]
    while parts:
        a, b, first, last, functions, depth = parts.pop()
        seen = 0 if first and last else functions[start].sign() if first else -functions[1].sign() if last else functions[0].sign()
        if seen > 0:
            continue
        if not (first or last) and min(functions[0].b[0], functions[0].b[-1]) < -functions[0].r:
            seen = -1  # G has a value below 0 at an end of this part
        if seen < 0 or depth == MOST_DEPTH or not (first or last) and all(abs(v) <= functions[0].r for v in functions[0].b):
            i, (low, high) = motion.segment.i, (begin + (k + s) * float(motion.h) for s in (a, b))
            raise Unproven(f"segment {i}, t = {low:.6g} to {high:.6g}, contact {c}: {words}: " + ("it is negative" if seen < 0 else "sign not decided"),
                           i, [low, high], c)
        halves = {p: f.halves() for p, f in functions.items()}
        middle = (a + b) / 2
        parts.append((middle, b, False, last, {p: f[1] for p, f in halves.items()}, depth + 1))
        parts.append((a, middle, first, False, {p: f[0] for p, f in halves.items()}, depth + 1))


# ---- stability ---------------------------------------------------------------------------------------------------------------------
def monodromy(orbit, y, flows):
    """Derivative of the period map over the box, in (x, v, w of sticking sliders that neither rest all period nor are fixed by geometry)."""
    cert, n = orbit.cert, orbit.cert.n
    free = [[c for c in s.sticks if c not in cert.rest and not orbit.touched_in_proportion(c, i)] for i, s in enumerate(orbit.segments)]
    first = min(range(orbit.m), key=lambda i: len(free[i]))  # fewest sliders: no multiplier is a spurious 0
    size = 2 * n + len(free[first])
    product = [[Ball.of(int(j == k)) for k in range(size)] for j in range(size)]
    for i in (list(range(first, orbit.m)) + list(range(first)))[:orbit.m]:
        columns = list(range(2 * n)) + [orbit.segments[i].w[c] for c in free[i]]
        flow = [[flows[i][r][c] for c in columns] for r in range(2 * n)]
        moved = matmul(flow, product)
        to = (i + 1) % orbit.m
        for c in free[to]:
            if c in free[i]:
                moved.append(product[2 * n + free[i].index(c)])  # w stays
                continue
            event, row, _, before = orbit.rests[to][c]
            if before == "O":  # w = t.x where n.x + gap = 0: dw = (t - (u'/v') n).dx
                contact, v = cert.contacts[c], y[event * orbit.width + n:]
                slope = apply_row(contact.row_t, v) / apply_row(contact.row_n, v)
                row = combine((Ball.of(1), contact.row_t), (-slope, contact.row_n))
            moved.append([apply_row(row, column) for column in zip(*moved[:n])])  # from slip: the gradient of t.x - s mu N / kt
        product = moved
    return product


def multipliers(matrix, vectors):
    """Lower and upper bound (units) of the largest modulus of an eigenvalue, and of any: Gershgorin on V^-1 M V, by rows.
    Complex matrices stand as real ones of twice the size, [[Re, -Im], [Im, Re]]. W is V's inverse in floats, bettered twice;
    with E = I - W V it is V^-1 M V = (I - E)^-1 W M V, which differs from W M V by at most |E| / (1 - |E|) times its columns' largest entry."""
    n = len(matrix)
    if len(vectors) != n:
        raise Unproven(f"stability unproven: {len(vectors)} vectors for {n} multipliers")
    re, im = ([[Ball.of(v[k]) for v in row] for row in vectors] for k in (0, 1))
    V = [a + [-v for v in b] for a, b in zip(re, im)] + [b + a for a, b in zip(re, im)]
    inverse = inverse_in_floats([[float(v) for v in row] for row in V])
    if inverse is None:
        raise Unproven("stability unproven: the vectors are dependent")
    W, identity = [[Ball.of(v) for v in row] for row in inverse], [[Ball.of(int(j == k)) for k in range(2 * n)] for j in range(2 * n)]
    less = lambda a, b: [[p - q for p, q in zip(x, y)] for x, y in zip(a, b)]
    for _ in range(2):
        W = [[Ball((w + d).m) for w, d in zip(x, y)] for x, y in zip(W, matmul(less(identity, matmul(W, V)), W))]
    worst = max(sum(v.size for v in row) for row in less(identity, matmul(W, V)))
    if worst >= 1 << (Ball.bits - 1):
        raise Unproven("stability unproven: the vectors are nearly dependent")
    MV = [[dot(row, column) for column in zip(*part)] for part in (re, im) for row in matrix]
    X = [[dot(row, column) for column in zip(*MV)] for row in W]
    top = [max(abs(X[j][k].m) + X[j][k].r + abs(X[j + n][k].m) + X[j + n][k].r for j in range(n)) for k in range(n)]
    extra = [(2 * worst * t >> Ball.bits) + 1 for t in top]  # 1 / (1 - |E|) <= 2
    entry = [[(Ball(X[j][k].m, X[j][k].r + extra[k]), Ball(X[j + n][k].m, X[j + n][k].r + extra[k])) for k in range(n)] for j in range(n)]
    size = lambda z: (z[0] * z[0] + z[1] * z[1]).root()
    radius = [sum(size(entry[j][k]).hi for k in range(n) if k != j) for j in range(n)]
    inner, outer = ([size(entry[j][j]).lo - radius[j] for j in range(n)], [size(entry[j][j]).hi + radius[j] for j in range(n)])
    group = list(range(n))  # a connected group of k discs holds k multipliers
    for j in range(n):
        for k in range(j):
            if size([a - b for a, b in zip(entry[j][j], entry[k][k])]).lo <= radius[j] + radius[k]:
                group = [group[k] if g == group[j] else g for g in group]
    low, high = max([0] + [min(inner[j] for j in range(n) if group[j] == g) for g in set(group)]), max(outer)
    return between(low, high)


# ---- amplitude, mean, harmonic 1 ---------------------------------------------------------------------------------------------------
def largest(polynomials):
    """Enclosure of the largest value of all: branch and bound on Bernstein coefficients; values at the parts' ends are values of the orbit."""
    low = max(max(p.b[0], p.b[-1]) - p.r for p in polynomials)
    heap = [(-max(p.b) - p.r, k, p) for k, p in enumerate(polynomials)]
    heapq.heapify(heap)
    for count in range(MOST_PARTS):
        p = heap[0][2]
        if -heap[0][0] - low <= 4 * p.r:
            break
        heapq.heappop(heap)
        for k, half in enumerate(p.halves()):
            low = max(low, max(half.b[0], half.b[-1]) - half.r)
            heapq.heappush(heap, (-max(half.b) - half.r, len(polynomials) + 2 * count + k, half))
    return between(low, -heap[0][0])


class Measures:
    """Max, min and integrals of the response, substep by substep."""

    def __init__(self, orbit):
        self.orbit, self.up, self.integrals = orbit, [], [Ball(0)] * 3
        self.row, self.cosine = {j: Ball.of(v) for j, v in enumerate(orbit.cert.response) if v}, 2 * orbit.cert.n + 1

    def add(self, h, series):
        """Integrals over s = 0..1: s^j gives 1 / (j + 1), x_j s^j times wave_k s^k x_j wave_k / (j + k + 1); remainders are in first coefficients."""
        x = [apply_row(self.row, z) for z in series]
        self.up.append(Polynomial.of(x))
        for i, wave in enumerate(([Ball.of(1)], [z[self.cosine] for z in series], [z[self.cosine + 1] for z in series])):
            spread = sum(w.r for w in wave) + len(wave)
            moments = [Ball(sum(w.m // (j + k + 1) for k, w in enumerate(wave)), spread) for j in range(len(x))]
            self.integrals[i] = self.integrals[i] + h * dot(x, moments)

    def found(self):
        top, bottom = largest(self.up), -largest([Polynomial([-b for b in p.b], p.r) for p in self.up])
        mean, a1, b1 = (v / self.orbit.period for v in self.integrals)
        a1, b1 = a1.times(2), b1.times(2)
        return {"max": top, "min": bottom, "amplitude": (top - bottom).over(2), "mean": mean, "a1": a1, "b1": b1, "harmonic_1": (a1 * a1 + b1 * b1).root()}


def check_claim(name, found, claimed, unit):
    """The claimed interval contains the one found."""
    lo, hi = (v * unit for v in claimed)
    if hi < found.lo or found.hi < lo:
        raise Unproven(f"claim is false: {name}")
    if not (lo <= found.lo and found.hi <= hi):
        raise Unproven(f"claim is too narrow: {name}")


# ---- the decision ------------------------------------------------------------------------------------------------------------------
def decide(cert, answer):
    """Everything in order; fills answer with what is known, raises Unproven where it ends."""
    answer.update(states=cert.letters, transitions=0 if cert.section else len(cert.letters))
    orbit = Orbit(cert)
    test = Krawczyk(orbit)
    try:
        test.image(cert.uniqueness, "uniqueness radius")
        y = test.box(cert.radius)
        answer.update(radius=decimal_text(cert.radius), uniqueness_radius=decimal_text(cert.uniqueness))
    except Unproven as error:
        raise Unproven(f"existence: {error}") from None
    flows, measures, unit = [], Measures(orbit), 1 << Ball.bits
    for i, tau in enumerate(orbit.times(y)):
        motion, asked = Motion(orbit, i, y, tau), []
        for c in range(len(cert.contacts)):
            for words, row, start, end in conditions(orbit, i, c):
                rows = [row]
                for _ in range(max(start, end)):
                    rows.append(row_times(rows[-1], motion.segment.A))
                asked.append((c, words, rows, start, end))
        for k in range(motion.steps):
            series = motion.series(k)
            for condition in asked:
                check_condition(motion, series, k, float(cert.events[i][0]), *condition)
            measures.add(motion.length(k), series)
        flows.append(motion.flow)
    found = measures.found()
    answer.update({name: outward(value) for name, value in found.items()})
    answer["stability"] = "unproven"
    if cert.stability != "unproven" or "multiplier" in cert.bounds:
        if not cert.vectors:
            raise Unproven("stability unproven: no vectors")
        found["multiplier"] = largest_modulus = multipliers(monodromy(orbit, y, flows), cert.vectors)
        answer["multiplier"] = outward(largest_modulus)
        # All discs inside the unit circle; or a connected group of discs outside.
        answer["stability"] = "stable" if largest_modulus.hi < unit else "unstable" if largest_modulus.lo > unit else "unproven"
        if cert.stability != "unproven" and answer["stability"] == "unproven":
            raise Unproven("stability unproven: the largest multiplier may have modulus 1")
        if cert.stability not in ("unproven", answer["stability"]):
            raise Unproven("claim is false: stability")
    for name, claimed in cert.bounds.items():
        check_claim(name, found[name], claimed, unit)


def decimal_text(value):
    """A fraction that was read from a decimal string."""
    return f"{float(value):.17g}"


def outward(ball):
    """[low, high] with 30 digits, and 30 behind the point at least, rounded outward."""
    digits = 30 + max(0, (Ball.bits - ball.size.bit_length()) * 3 // 10)
    ten = 10 ** digits
    lo, hi = ball.lo * ten >> Ball.bits, -(-ball.hi * ten >> Ball.bits)
    return [f"{'-' if v < 0 else ''}{abs(v) // ten}.{abs(v) % ten:0{digits}d}" for v in (lo, hi)]


KEYS = ("verdict", "reason", "segment", "time", "contact", "radius", "uniqueness_radius", "stability", "multiplier") + BOUNDS + ("states", "transitions")


def examine(path, text=None):
    """The answer on a file, or on the bytes given."""
    answer = dict.fromkeys(KEYS)
    answer["file"] = path
    try:
        decide(parse(read(path) if text is None else text), answer)
        answer["verdict"] = "accepted"
    except Wrong as error:
        answer.update(verdict="wrong", reason=str(error))
    except Unproven as error:
        answer.update(verdict="rejected", reason=str(error), segment=error.segment, time=error.time, contact=error.contact)
    except OverflowError:
        answer.update(verdict="rejected", reason="existence: a number is too large")
    return answer


def lines_of(file):
    while line := file.readline(MOST_BYTES + 2):
        if line.strip():
            yield line


def main(arguments):
    paths, as_json, rest = [], False, iter(arguments)
    for argument in rest:
        name, equals, value = argument.partition("=")
        if name == "--format":
            value = value if equals else next(rest, "")
            if value not in ("text", "json"):
                print("check.py: --format is text or json", file=sys.stderr)
                return 64
            as_json = value == "json"
        elif argument.startswith("-") and argument != "-":
            print(__doc__ if argument == "--help" else f"check.py: {argument} is not known", file=sys.stderr)
            return 64
        else:
            paths.append(argument)
    if not paths:
        print("usage: check.py CERTIFICATE... [--format text|json]", file=sys.stderr)
        return 64
    worst = 0
    for path, answer in ((p, a) for p in paths for a in ([examine(p)] if p != "-" else (examine(p, line) for line in lines_of(sys.stdin.buffer)))):
        worst = max(worst, {"accepted": 0, "rejected": 1, "wrong": 2}[answer["verdict"]])
        if as_json or path == "-":
            print(json.dumps(answer), flush=True)
        else:
            bounds = "; ".join(f"{name} {' to '.join(answer[name])}" for name in ("amplitude", "mean", "harmonic_1", "multiplier") if answer[name])
            radii = f"radius {answer['radius']}, alone within {answer['uniqueness_radius']}"
            print(f"{path}: {answer['verdict']}" + (f": {answer['reason']}" if answer["reason"] else f", {answer['stability']}; {bounds}; {radii}"), flush=True)
    return worst


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
