"""One mass on one inclined contact that never slips, between its events in closed form: orbits in double precision, as candidates of
`hbmcheck-proof complete`. Law: touching begins stick with w = -gap cot(angle), so that the letter follows from x alone."""
import cmath
import math


class Oscillator:
    def __init__(self, omega, mass=1.0, damping=0.4, stiffness=40.0, force=100.0, angle=45.0, kt=100.0, kn=1000.0, mu=0.3, gap=-5.0):
        """Case 2 of the paper, but for omega."""
        self.model = {
            "mass": [[repr(mass)]], "damping": [[repr(damping)]], "stiffness": [[repr(stiffness)]],
            "forcing": [{"harmonic": 1, "cos": [repr(force)], "sin": ["0"]}],
            "contacts": [{"direction": ["1"], "angle_deg": repr(angle), "tangential_stiffness": repr(kt), "normal_stiffness": repr(kn),
                          "friction": repr(mu), "gap": repr(gap)}]}
        sine, cosine = math.sin(math.radians(angle)), math.cos(math.radians(angle))
        self.omega, self.period, self.edge = omega, 2 * math.pi / omega, -gap / sine
        self.decay, self.forced = damping / (2 * mass), force / complex(stiffness - mass * omega ** 2, damping * omega)
        closed = stiffness + kt * cosine ** 2 + kn * sine ** 2
        self.forced_by = {"O": self.forced, "S": force / complex(closed - mass * omega ** 2, damping * omega)}
        self.rest = {"O": 0.0, "S": self.edge * (closed - stiffness) / closed}
        self.frequency = {"O": math.sqrt(stiffness / mass - self.decay ** 2), "S": math.sqrt(closed / mass - self.decay ** 2)}

    def at(self, letter, start, x, v, t):
        """x, v at t of the motion through (x, v) at `start` that stays in the letter's state."""
        forced = [self.forced_by[letter] * cmath.exp(1j * self.omega * s) for s in (start, t)]
        a, b = x - forced[0].real - self.rest[letter], v - (1j * self.omega * forced[0]).real
        w, u = self.frequency[letter], t - start
        b = (b + self.decay * a) / w
        e, c, s = math.exp(-self.decay * u), math.cos(w * u), math.sin(w * u)
        free = e * (a * c + b * s)
        return forced[1].real + self.rest[letter] + free, (1j * self.omega * forced[1]).real - self.decay * free + e * w * (b * c - a * s)

    def period_map(self, x, v, steps=256):
        """The state a period after (x, v) at t = 0, and the events (t, x, v, letter after it) on the way."""
        t, letter, events = 0.0, "S" if x > self.edge else "O", []
        while t < self.period:
            start, sign, low = t, 1 if letter == "S" else -1, t
            for k in range(1, steps + 1):
                high = min(start + self.period * k / steps, self.period)
                if sign * (self.at(letter, start, x, v, high)[0] - self.edge) < 0 or high == self.period:
                    break
                low = high
            crossed = sign * (self.at(letter, start, x, v, high)[0] - self.edge) < 0
            for _ in range(60 if crossed else 0):
                middle = 0.5 * (low + high)
                inside = sign * (self.at(letter, start, x, v, middle)[0] - self.edge) >= 0
                low, high = (middle, high) if inside else (low, middle)
            t, (x, v) = high, self.at(letter, start, x, v, high)
            if crossed:
                letter = "O" if letter == "S" else "S"
                events.append((t, x, v, letter))
        return x, v, events

    def orbit(self, x, v):
        """A fixed point of the period map from (x, v) by Newton, as (x, v, events); None if it leads nowhere."""
        for _ in range(20):
            h = 1e-6
            f, right, up = self.period_map(x, v), self.period_map(x + h, v), self.period_map(x, v + h)
            a, b, c, d = (right[0] - f[0]) / h - 1, (up[0] - f[0]) / h, (right[1] - f[1]) / h, (up[1] - f[1]) / h - 1
            r, s, det = x - f[0], v - f[1], a * d - b * c
            if det == 0 or abs(x) > 1e3:
                return None
            dx, dv = (r * d - s * b) / det, (s * a - r * c) / det
            x, v = x + dx, v + dv
            if abs(dx) + abs(dv) / self.omega < 1e-7:
                return (x, v, self.period_map(x, v)[2])
        return None

    def orbits(self, tries=24):
        """All that Newton finds from states on rings around 0."""
        found = []
        for k in range(tries):
            size, angle = 2.5 + 1.5 * k, 2.4 * k  # the golden angle
            orbit = self.orbit(size * math.cos(angle), size * self.omega * math.sin(angle))
            if orbit and all(abs(orbit[0] - other[0]) > 1e-5 for other in found):
                found.append(orbit)
        return found

    def candidate(self, orbit):
        x, v, events = orbit
        listed = [{"t": t, "x": [x], "v": [v], "state": letter} for t, x, v, letter in events]
        return {"model": self.model, "omega": repr(self.omega), "response": ["1"], "rest": {},
                "events": listed or [{"section": 1, "t": 0, "x": [x], "v": [v], "state": "O"}]}
