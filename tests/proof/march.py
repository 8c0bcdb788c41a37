"""march.py - the exact contact law integrated in time in floats: closed form on each step (power series), transitions located by bisection.

Shares nothing with proof/check.py. The law is stated by forces and by which letter may follow which, not by conditions on segments:
    open -> closed where n.x + gap rises through 0, in slip s if s kt u' > mu kn v', else in stick with w = u;   closed -> open where it falls
    stick -> slip s where s kt (u - w) exceeds mu N;   slip s -> stick where s kt u' - mu kn v' falls through 0, with w = u - s mu N / kt
"""
import math

ORDER = 14  # of the series on a step: |A| h < 1 leaves 1e-12 of one step; steps are a small part of that


class Law:
    def __init__(self, data):
        """data: a certificate's JSON."""
        model = data["model"]
        number = lambda rows: [[float(v) for v in row] for row in rows]
        self.mass, self.damping, self.stiffness = (number(model[k]) for k in ("mass", "damping", "stiffness"))
        self.n, self.omega = len(self.mass), float(data["omega"])
        self.forcing = [(f["harmonic"], [float(v) for v in f["cos"]], [float(v) for v in f["sin"]]) for f in model["forcing"]]
        self.inverse = inverse(self.mass)
        self.contacts = []
        for c in model["contacts"]:
            get = lambda key: float(c.get(key, "0"))
            t, n = c.get("tangent"), c.get("normal")
            t, n = ([float(v) for v in row] if row else None for row in (t, n))
            if "direction" in c:
                a = math.radians(float(c["angle_deg"]))
                t, n = [math.cos(a) * float(v) for v in c["direction"]], [math.sin(a) * float(v) for v in c["direction"]]
            kt, mu, kn, gap, load = map(get, ("tangential_stiffness", "friction", "normal_stiffness", "gap", "preload"))
            rubs = bool(t and kt and mu and (n or load))
            k = next((j for j, v in enumerate(n or []) if v), None)
            parallel = rubs and n and all(abs(a * n[k] - b * t[k]) < 1e-12 * abs(t[k] * n[k] or 1) for a, b in zip(t, n))
            self.contacts.append(dict(t=t if rubs else None, n=n, kt=kt, mu=mu, kn=kn, gap=gap, load=load, parallel=parallel))
        self.series_of = {}

    def normal(self, c, x):
        return c["kn"] * (dot(c["n"], x) + c["gap"]) if c["n"] else c["load"]

    def matrix(self, letters):
        """x'' = P + Q x + R v + sum of w terms as rows: coefficients of x, v, one, w of each contact; the load is added apart."""
        n, rows = self.n, []
        for j in range(self.n):
            row = dict(x=[-v for v in self.stiffness[j]], v=[-v for v in self.damping[j]], one=0.0, w=[0.0] * len(letters))
            for i, (c, letter) in enumerate(zip(self.contacts, letters)):
                if c["n"]:
                    row["one"] += c["n"][j] * max(c["kn"] * c["gap"], 0)
                force = [0.0] * n, 0.0  # N as a row on x, and a constant
                if letter != "O":
                    force = ([c["kn"] * v for v in c["n"]], c["kn"] * c["gap"]) if c["n"] else (force[0], c["load"])
                if letter != "O" and c["n"]:
                    row["x"] = [a - c["n"][j] * b for a, b in zip(row["x"], force[0])]
                    row["one"] -= c["n"][j] * force[1]
                if letter in "+-":
                    s = c["mu"] * (1 if letter == "+" else -1) * c["t"][j]
                    row["x"] = [a - s * b for a, b in zip(row["x"], force[0])]
                    row["one"] -= s * force[1]
                if letter == "S":
                    row["x"] = [a - c["t"][j] * c["kt"] * b for a, b in zip(row["x"], c["t"])]
                    row["w"][i] += c["t"][j] * c["kt"]
            rows.append(row)
        mix = lambda key, k: [[sum(self.inverse[j][i] * rows[i][key][l] for i in range(n)) for l in range(k)] for j in range(n)]
        one = [sum(self.inverse[j][i] * rows[i]["one"] for i in range(n)) for j in range(n)]
        return mix("x", n), mix("v", n), one, mix("w", len(letters))

    def series(self, t, x, v, w, letters):
        """Taylor coefficients of x in time from t, with constant letters: x'' = Q x + R v + constant + load(t)."""
        if letters not in self.series_of:
            self.series_of[letters] = self.matrix(letters)
        Q, R, one, W = self.series_of[letters]
        n = self.n
        constant = [a + dot(row, w) for a, row in zip(one, W)]
        loads = []
        for h, cosine, sine in self.forcing:
            force = [dot(self.inverse[j], cosine) for j in range(n)], [dot(self.inverse[j], sine) for j in range(n)]
            loads.append((h * self.omega, math.cos(h * self.omega * t), math.sin(h * self.omega * t), force))
        out = [x, v]
        factor = [1.0] * len(loads)
        for k in range(ORDER - 1):
            at, speed = out[k], [(k + 1) * a for a in out[k + 1]]
            new = []
            for j in range(n):
                a = dot(Q[j], at) + dot(R[j], speed) + (constant[j] if k == 0 else 0.0)
                for (rate, c, s, (fc, fs)), f in zip(loads, factor):
                    # k-th derivatives over k! of cos and sin at t
                    dc, ds = ((c, s), (-s, c), (-c, -s), (s, -c))[k % 4]
                    a += f * (fc[j] * dc + fs[j] * ds)
                new.append(a / ((k + 1) * (k + 2)))
            factor = [f * l[0] / (k + 1) for f, l in zip(factor, loads)]
            out.append(new)
        return out


def dot(a, b):
    return sum(map(float.__mul__, a, b))


def inverse(m):
    n = len(m)
    rows = [list(r) + [float(i == j) for j in range(n)] for i, r in enumerate(m)]
    for k in range(n):
        p = max(range(k, n), key=lambda i: abs(rows[i][k]))
        rows[k], rows[p] = rows[p], rows[k]
        rows[k] = [v / rows[k][k] for v in rows[k]]
        for i in range(n):
            if i != k:
                rows[i] = [a - rows[i][k] * b for a, b in zip(rows[i], rows[k])]
    return [r[n:] for r in rows]


class March:
    """State at time t: x, v, letters, w (of stick), and whether a stick began by touching."""

    def __init__(self, law, t, x, v, letters, w, steps=256, touched=()):
        self.law, self.t, self.x, self.v, self.letters, self.w = law, t, list(x), list(v), letters, list(w)
        self.h, self.touched, self.events = 2 * math.pi / law.omega / steps, set(touched), []

    def violations(self, x, v, slack=0.0):
        """{contact: its next letter} where the present letter's condition fails at x, v."""
        out = {}
        for i, c in enumerate(self.law.contacts):
            letter = self.letters[i]
            if c["n"]:
                gap = dot(c["n"], x) + c["gap"]
                if letter == "O":
                    if gap > slack:
                        out[i] = "touch"
                    continue
                if gap < -slack:
                    out[i] = "O"
                    continue
            if letter == "S" and not (c["parallel"] and i in self.touched):
                force, limit = c["kt"] * (dot(c["t"], x) - self.w[i]), c["mu"] * self.law.normal(c, x)
                if abs(force) > limit + 1e-11 * (limit + abs(force)) + slack * c["kt"]:  # stick begins at the limit, but for rounding
                    out[i] = "+" if force > 0 else "-"
            elif letter in "+-" and c["t"]:
                s = 1 if letter == "+" else -1
                if s * c["kt"] * dot(c["t"], v) - c["mu"] * c["kn"] * (dot(c["n"], v) if c["n"] else 0.0) < 0:
                    out[i] = "S"
        return out

    def change(self, found):
        letters = list(self.letters)
        for i, new in found.items():
            c = self.law.contacts[i]
            if new == "touch":
                new = "N"
                if c["t"]:
                    u, v = c["kt"] * dot(c["t"], self.v), c["mu"] * c["kn"] * dot(c["n"], self.v)
                    new = "S" if abs(u) <= v else "+" if u > 0 else "-"
                    self.w[i] = dot(c["t"], self.x)
                    self.touched.add(i)
            elif new == "S":
                self.w[i] = dot(c["t"], self.x) - (1 if letters[i] == "+" else -1) * c["mu"] * self.law.normal(c, self.x) / c["kt"]
                self.touched.discard(i)
            letters[i] = new
        self.letters = "".join(letters)
        self.events.append((self.t, list(self.x), list(self.v), self.letters, list(self.w)))

    def at(self, series, s):
        x, v = [0.0] * self.law.n, [0.0] * self.law.n
        for k in range(len(series) - 1, -1, -1):
            v = [a * s + b for a, b in zip(v, x)]
            x = [a * s + b for a, b in zip(x, series[k])]
        return x, v

    def run(self, end, most=100000):
        """To time end; True if fewer than `most` transitions came."""
        while self.t < end:
            h = min(self.h, end - self.t)
            series = self.law.series(self.t, self.x, self.v, self.w, self.letters)
            x, v = self.at(series, h)
            found = self.violations(x, v)
            at_start = self.violations(self.x, self.v, 1e-13) if found else {}
            if not found:
                self.t, self.x, self.v = self.t + h, x, v
                continue
            low, high = 0.0, h
            for _ in range(60):
                middle = (low + high) / 2
                x, v = self.at(series, middle)
                if self.violations(x, v):
                    high = middle
                else:
                    low = middle
            x, v = self.at(series, high)
            self.t, self.x, self.v = self.t + high, x, v
            self.change(self.violations(x, v) or at_start)
            if len(self.events) > most:
                return False
        return True
