"""Spoiled curves of four structures: what is wrong with each, and what an expert would call it.

    SCENES     name: Scene
    MISTAKES   each with the words that are accepted; those with hidden=True were written last, and not looked at while
               `verify` was made to know the others
    make       the curve of one: omegas, and a value for each response; and by how much it is off

A curve is "off" by the difference from the right one that one point in ten exceeds, relative to the largest of the
response's amplitudes nearby; points whose equations Newton does not solve are left out."""
import dataclasses
import functools
import pathlib

import numpy as np

import balance
from balance import Code, Contact, Structure

CASES = pathlib.Path(__file__).resolve().parents[4] / "cases/structures"
HERE = pathlib.Path(__file__).resolve().parent


def unit(n, **entries):
    out = np.zeros(n)
    for key, value in entries.items():
        out[int(key[1:])] = value
    return out


@dataclasses.dataclass
class Scene:
    case: pathlib.Path
    names: list       # of the responses
    dofs: list        # which they are
    omega: np.ndarray
    structure: Structure
    how: Code = Code()
    coarse: bool = False  # its 10 harmonics are a mistake of 1 % by themselves: named beside another it is right


def chain3():
    K = np.array([[2.0, -1, 0], [-1, 2, -1], [0, -1, 2]])
    contacts = [Contact([unit(3, x0=1)], None, 20, 0, 1, 0, 1), Contact([unit(3, x1=1, x0=-1)], None, 20, 0, 1, 0, 1),
                Contact([], unit(3, x2=1), 0, 1, 0, -0.25)]
    contacts[0].load = contacts[1].load = 1.0
    omega = np.concatenate([np.arange(0.6, 1.2, 0.025), np.arange(1.2, 1.46, 0.02), np.arange(1.55, 1.96, 0.025)])
    return Scene(CASES / "chain3.yaml", ["1", "2", "3"], [0, 1, 2], omega,
                 Structure(np.eye(3), 0.02 * K, K, [(1, 1.0, 1, 0.0)], contacts), coarse=True)


def wedge():
    c, s = 0.8191520442889918, 0.573576436351046
    contacts = [Contact([np.array([-c, c, -s])], np.array([-s, s, c]), 400, 600, 0.3),
                Contact([np.array([0, c, s])], np.array([0, -s, c]), 400, 600, 0.3)]
    return Scene(CASES / "wedge_F10.yaml", ["blade", "damper_x", "damper_y"], [0, 1, 2], np.arange(33.4, 42.01, 0.25),
                 Structure(np.diag([1, 0.05, 0.05]), np.diag([0.31622776601683794, 0.2, 0.2]), np.diag([1000.0, 0, 0]),
                           [(2, 10.0, 0, 0.0), (0, 10.0, 1, 0.0)], contacts))


def tower():
    """Twelve masses one upon another; two rub, the top strikes."""
    n = 12
    K = 200.0 * (2 * np.eye(n) - np.eye(n, k=1) - np.eye(n, k=-1))
    K[n - 1, n - 1] = 200.0
    M = np.diag([1 + 0.05 * (i % 3) for i in range(n)])
    contacts = [Contact([unit(n, x5=1, x3=-1)], unit(n, x8=0.5), 150, 100, 0.4, 0.05),
                Contact([unit(n, x9=1)], None, 30, 0, 0.5, 0, 1.2), Contact([], unit(n, x11=1), 0, 40, 0, -0.3)]
    return Scene(HERE / "tower.yaml", ["top", "middle"], [11, 5], np.arange(1.3, 2.91, 0.05),
                 Structure(M, 0.03 * M + 0.0008 * K, K, [(3, 3.0, 1, 0.0), (6, 1.0, 1, 60.0)], contacts), coarse=True)


def corner():
    """Two bodies in space; one slides on a rough plane, the other strikes."""
    n = 6
    K = np.diag([100.0, 130, 180, 90, 140, 160])
    K[0, 2] = K[2, 0] = 15
    for i in range(3):
        K[i, i] += 30
        K[i + 3, i + 3] += 30
        K[i, i + 3] = K[i + 3, i] = -30
    M = np.diag([1.0, 1, 1, 0.8, 0.8, 0.8])
    contacts = [Contact([unit(n, x0=1), unit(n, x1=1)], unit(n, x2=1), 60, 80, 0.5, 0.03),
                Contact([], unit(n, x3=1), 0, 60, 0, -0.12)]
    return Scene(HERE / "corner.yaml", ["ax", "ay", "bx"], [0, 1, 3], np.arange(9.2, 14.81, 0.2),
                 Structure(M, 0.1 * M + 0.0025 * K, K, [(0, 3.0, 1, 0.0), (1, 1.8, 1, -90.0), (2, 2.4, 1, 0.0)],
                           contacts), Code(samples=2048, periods=2))  # in space the error falls with 1/N


def case2():
    """The paper's second scene, an oscillator: what another independent program got wrong at it, and no more."""
    contacts = [Contact([np.array([np.sqrt(0.5)])], np.array([np.sqrt(0.5)]), 100, 1000, 0.3, -5)]
    omega = np.concatenate([np.arange(4, 7.41, 0.1), np.arange(12.5, 16.01, 0.25)])
    return Scene(CASES.parent / "verify/case2.yaml", [""], [0], omega,
                 Structure(np.eye(1), 0.4 * np.eye(1), 40.0 * np.eye(1), [(0, 100.0, 1, 0.0)], contacts))


SCENES = {f.__name__: f() for f in (chain3, wedge, tower, corner, case2)}


@dataclasses.dataclass
class Mistake:
    scene: str
    what: str
    words: list  # each a set of causes joined by +
    change: object = None  # of (structure, code): a structure and a code
    read: object = None    # of (omega, values[response][point], X, scene): omega, values
    hidden: bool = False

    @property
    def name(self):
        return f"{self.scene} {self.what}"

    @property
    def file(self):
        return self.name.replace(" ", "_").replace(",", "")


# ---- changes ----

def code(**fields):
    return lambda s, c: (s, dataclasses.replace(c, **fields))


def of(field, factor):
    """M, C, K or all moving loads times the factor."""
    def change(s, c):
        s = s.copy()
        if field == "loads":
            s.loads = [(d, a * (factor if k else 1), k, p) for d, a, k, p in s.loads]
        else:
            setattr(s, field, getattr(s, field) * factor)
        return s, c
    return change


def contact(which, **fields):
    """Fields of a contact, or of all for None; a function is applied to what is there."""
    def change(s, c):
        s = s.copy()
        for j, a in enumerate(s.contacts):
            if which is None or j == which:
                for name, value in fields.items():
                    setattr(a, name, value(getattr(a, name)) if callable(value) else value)
        return s, c
    return change


def times(factor):
    return lambda a: a * factor


def turned(which, degrees):
    """Tangent and normal of a contact turned in the plane that they span."""
    def change(s, c):
        s = s.copy()
        a, t = s.contacts[which], np.radians(degrees)
        u, v = a.tangents[0], a.normal
        a.tangents[0], a.normal = np.cos(t) * u + np.sin(t) * v, np.cos(t) * v - np.sin(t) * u
        return s, c
    return change


def modes(s):
    L = np.linalg.cholesky(s.mass)
    values, vectors = np.linalg.eigh(np.linalg.solve(L, np.linalg.solve(L, s.stiffness).T))
    return np.sqrt(np.maximum(values, 0)), np.linalg.solve(L.T, vectors)


def damped(kind, part):
    def change(s, c):
        s = s.copy()
        w, P = modes(s)
        if kind == "modal":
            s.damping = s.mass @ P @ np.diag(2 * part * w) @ P.T @ s.mass
        if kind == "mass":
            s.damping = part * s.mass
        if kind == "stiffness":
            s.damping = part * s.stiffness
        if kind == "hysteretic":
            s.damping, s.structural = 0 * s.mass, part
        return s, c
    return change


def loads(function):
    def change(s, c):
        s = s.copy()
        s.loads = function(s.loads)
        return s, c
    return change


def exchanged_kt(i, k):
    def change(s, c):
        s = s.copy()
        s.contacts[i].kt, s.contacts[k].kt = s.contacts[k].kt, s.contacts[i].kt
        return s, c
    return change


def tangent_gone(which):
    def change(s, c):
        s = s.copy()
        s.contacts[0].tangents.pop(which)
        return s, c
    return change


# ---- readings ----

def factor(f):
    return lambda omega, values, X, scene: (omega, f * values)


def quantity(function):
    return lambda omega, values, X, scene: (omega, np.array([[function(w, x) for w, x in zip(omega, X[:, d])]
                                                            for d in scene.dofs]))


def half_range(x, order=0, omega=1.0):
    H = (len(x) - 1) // 2
    x = x.copy()
    for _ in range(order):
        y = np.zeros_like(x)
        for h in range(1, H + 1):
            y[2 * h - 1], y[2 * h] = h * omega * x[2 * h], -h * omega * x[2 * h - 1]
        x = y
    y = balance.basis(H, 720) @ x

    def top(z):
        i = int(np.argmax(z))
        a, b, c = z[i - 1], z[i], z[(i + 1) % len(z)]
        return b if a + c == 2 * b else b - (c - a) ** 2 / (8 * (a - 2 * b + c))
    return (top(y) + top(-y)) / 2


def random(seed):
    return np.random.default_rng(seed)


def spoiled_points(how_many, seed=2):
    """Newton ended early at some points: they are anywhere."""
    def read(omega, values, X, scene):
        rng = random(seed)
        values = values.copy()
        at = rng.choice(len(omega), max(2, int(how_many * len(omega))), replace=False)
        values[:, at] *= 1 + rng.uniform(0.1, 0.9, (1, len(at))) * rng.choice([-1, 1], (1, len(at)))
        return omega, values
    return read


def one_outlier(omega, values, X, scene):
    values = values.copy()
    values[0, len(omega) // 2] *= 1.4
    return omega, values


def chords(every):
    def read(omega, values, X, scene):
        kept = sorted(set(range(0, len(omega), every)) | {len(omega) - 1})
        return omega, np.array([np.interp(omega, omega[kept], v[kept]) for v in values])
    return read


def cycles(omega, values, X, scene):
    return omega / (2 * np.pi), values


def responses(*order):
    return lambda omega, values, X, scene: (omega, values[list(order)])


def relative(response, dof):
    """One response is the motion less that of a degree of freedom."""
    def read(omega, values, X, scene):
        values = values.copy()
        values[response] = [half_range(x[scene.dofs[response]] - x[dof]) for x in X]
        return omega, values
    return read


SAMPLES = ["too_few_samples"]
MISTAKES = []


def add(scene, what, words, change=None, read=None, hidden=False):
    MISTAKES.append(Mistake(scene, what, words, change, read, hidden))


def plain(scene):
    """What can be wrong with any of them."""
    few = ["too_few_harmonics"]
    add(scene, "no mean", ["no_static_harmonic"], code(mean=False))
    add(scene, "odd only", ["odd_harmonics_only", "no_static_harmonic"], code(even=False, mean=False))
    add(scene, "H 1", few, code(harmonics=1))
    add(scene, "H 3", few, code(harmonics=3))
    add(scene, "H 7 N 16", SAMPLES + ["too_few_harmonics+too_few_samples"], code(harmonics=7, samples=16))
    add(scene, "H 7 N 24", SAMPLES + ["too_few_harmonics+too_few_samples"], code(harmonics=7, samples=24))
    add(scene, "H 7 N 32", SAMPLES + ["too_few_harmonics+too_few_samples"], code(harmonics=7, samples=32))
    if scene != "wedge":  # whose damper nothing else holds
        add(scene, "no contact", ["no_contact"], code(contact="none"))
    add(scene, "stuck", ["always_stuck"], code(contact="stuck"))
    add(scene, "force twice", ["wrong_force"], of("loads", 2))
    add(scene, "force 0.93", ["wrong_force"], of("loads", 0.93))
    add(scene, "mass 1.1", ["wrong_mass"], of("mass", 1.1))
    add(scene, "stiffness 0.9", ["wrong_stiffness"], of("stiffness", 0.9))
    add(scene, "damping half", ["wrong_damping"], of("damping", 0.5))
    add(scene, "damping 5", ["wrong_damping"], of("damping", 5))
    add(scene, "mu 1.5", ["wrong_friction"], contact(None, mu=times(1.5), load=times(1.0)))
    add(scene, "kt 0.3", ["wrong_tangential_stiffness"], contact(None, kt=times(0.3)))
    add(scene, "friction sign of 1", ["friction_sign"], contact(0, sign=-1.0))
    add(scene, "contact twice", ["contact_force_factor"], code(contact_factor=2.0))
    add(scene, "peak to peak", ["peak_to_peak"], None, factor(2))
    add(scene, "rms", ["rms", "rms_without_mean"], None,
        quantity(lambda w, x: np.sqrt((x[1:] ** 2).sum() / 2)))
    add(scene, "velocity", ["velocity"], None, quantity(lambda w, x: half_range(x, 1, w)))
    add(scene, "millimetres", ["length_unit"], None, factor(1000))
    add(scene, "hertz", ["frequency_unit"], None, cycles)
    add(scene, "outlier", ["outlier"], None, one_outlier)
    add(scene, "not converged, some", ["not_converged"], None, spoiled_points(0.25))
    add(scene, "not converged, all", ["not_converged"], None, spoiled_points(1.0, 3))


for name in SCENES:
    if name != "case2":
        plain(name)

add("chain3", "slider mean", ["slider_mean"], code(slider="no mean"))
add("chain3", "friction sign of 2", ["friction_sign"], contact(1, sign=-1.0))
add("chain3", "mu of 2 half", ["wrong_friction"], contact(1, mu=times(0.5)))
add("chain3", "gap 0", ["wrong_gap"], contact(2, gap=0.0))
add("chain3", "gap 0.6", ["wrong_gap"], contact(2, gap=times(0.6)))
add("chain3", "kn 3", ["wrong_normal_stiffness"], contact(2, kn=times(3)))
add("chain3", "modal damping", ["damping_kind"], damped("modal", 0.02))
add("chain3", "hysteretic", ["damping_kind"], damped("hysteretic", 0.03))
add("chain3", "load at 1", ["load_dof"], loads(lambda l: [(0, 1.0, 1, 0.0)]))
add("chain3", "chords", ["interpolated"], None, chords(2))
add("wedge", "slider mean", ["slider_mean"], code(slider="no mean"))
add("wedge", "angle 45 of 1", ["wrong_angle"], turned(0, 10))
add("wedge", "no static load", ["no_static_load"], loads(lambda l: l[1:]))
add("wedge", "kn half", ["wrong_normal_stiffness"], contact(None, kn=times(0.5)))
add("wedge", "mass damping", ["damping_kind"], damped("mass", 2.0))
add("tower", "modal damping", ["damping_kind"], damped("modal", 0.03))
add("tower", "hysteretic", ["damping_kind"], damped("hysteretic", 0.05))
add("tower", "gap of 3 half", ["wrong_gap"], contact(2, gap=times(0.5)))
add("tower", "phase sign", ["phase_sign"], loads(lambda l: [(d, a, k, -p) for d, a, k, p in l]))
add("tower", "responses exchanged", ["other_response"], None, responses(1, 0))
add("tower", "chords", ["interpolated"], None, chords(2))
add("tower", "second load half", ["one_load"], loads(lambda l: [l[0], (l[1][0], l[1][1] / 2, *l[1][2:])]))
add("tower", "first load turned", ["one_load"], loads(lambda l: [(l[0][0], -l[0][1], *l[0][2:]), l[1]]))
add("tower", "kt of 1 and 2 exchanged", ["contacts_exchanged"], exchanged_kt(0, 1))
add("tower", "top less middle", ["relative_response"], None, relative(0, 5))
add("corner", "third load missing", ["one_load"], loads(lambda l: l[:2]))
add("corner", "ay less bx", ["relative_response"], None, relative(1, 3))
add("corner", "square", ["square_limit"], contact(0, square=True))
add("corner", "no tangent 2", ["tangent_missing"], tangent_gone(1))
add("corner", "phase sign", ["phase_sign"], loads(lambda l: [(d, a, k, -p) for d, a, k, p in l]))
add("corner", "gap of 2 zero", ["wrong_gap"], contact(1, gap=0.0))
add("corner", "modal damping", ["damping_kind"], damped("modal", 0.03))
add("case2", "gap 0", ["wrong_gap"], contact(0, gap=0.0))
add("case2", "angle 30", ["wrong_angle"], turned(0, 15))
add("case2", "mass 1.1", ["wrong_mass"], of("mass", 1.1))
add("case2", "H 7 N 20", SAMPLES + ["too_few_harmonics+too_few_samples"], code(harmonics=7, samples=20))

# Written last, when the others were known; nothing was changed after they had been asked. No words: nothing may be
# named.

def hidden(scene, what, words, change=None, read=None):
    add(scene, what, words, change, read, hidden=True)


FEW = ["too_few_harmonics"]
hidden("chain3", "kn 0.4", ["wrong_normal_stiffness"], contact(2, kn=times(0.4)))
hidden("chain3", "gap 1.5", ["wrong_gap"], contact(2, gap=times(1.5)))
hidden("chain3", "mass 0.85", ["wrong_mass"], of("mass", 0.85))
hidden("chain3", "H 5", FEW, code(harmonics=5))
hidden("chain3", "H 9 N 22", SAMPLES + FEW, code(harmonics=9, samples=22))
hidden("chain3", "mu of 1 0.6", ["wrong_friction"], contact(0, mu=times(0.6)))
hidden("chain3", "contact half", ["contact_force_factor"], code(contact_factor=0.5))
hidden("chain3", "norm over root 2", ["norm_over_root_2"], None, quantity(lambda w, x: np.sqrt((x ** 2).sum() / 2)))
hidden("chain3", "cubic spring", [], lambda s, c: (dataclasses.replace(s.copy(), cubic=1.0), c))
hidden("wedge", "angle 8 less of 2", ["wrong_angle"], turned(1, -8))
hidden("wedge", "kn 1.6", ["wrong_normal_stiffness"], contact(None, kn=times(1.6)))
hidden("wedge", "static load half", [], loads(lambda l: [(2, 5.0, 0, 0.0), l[1]]))
hidden("wedge", "H 5 N 12", SAMPLES + FEW + ["too_few_harmonics+too_few_samples"], code(harmonics=5, samples=12))
hidden("wedge", "force 1.4", ["wrong_force"], of("loads", 1.4))
hidden("wedge", "damping quarter", ["wrong_damping"], of("damping", 0.25))
hidden("wedge", "friction sign of 2", ["friction_sign"], contact(1, sign=-1.0))
hidden("wedge", "single pass", ["single_pass"], code(periods=1))
hidden("wedge", "kt of 1 2.2", ["wrong_tangential_stiffness"], contact(0, kt=times(2.2)))
hidden("tower", "gap of 1 1.8", ["wrong_gap"], contact(0, gap=times(1.8)))
hidden("tower", "stiffness 1.15", ["wrong_stiffness"], of("stiffness", 1.15))
hidden("tower", "mu of 2 0.6", ["wrong_friction"], contact(1, mu=times(0.6)))
hidden("tower", "H 2", FEW, code(harmonics=2))
hidden("tower", "H 9 N 20", SAMPLES + FEW + ["too_few_harmonics+too_few_samples"], code(harmonics=9, samples=20))
hidden("tower", "no mean, peak to peak", ["no_static_harmonic+peak_to_peak"], code(mean=False), factor(2))
hidden("tower", "late", [], contact(0, late=8))
hidden("tower", "load at d8", ["load_dof"], loads(lambda l: [(7, 3.0, 1, 0.0), l[1]]))
hidden("corner", "kt 1.7", ["wrong_tangential_stiffness"], contact(0, kt=times(1.7)))
hidden("corner", "gap of 1 half", ["wrong_gap"], contact(0, gap=times(0.5)))
hidden("corner", "mu 0.7", ["wrong_friction"], contact(0, mu=times(0.7)))
hidden("corner", "stiffness 1.05", ["wrong_stiffness"], of("stiffness", 1.05))
hidden("corner", "hysteretic", ["damping_kind"], damped("hysteretic", 0.04))
hidden("corner", "H 2", FEW, code(harmonics=2))
hidden("corner", "metres and mass 0.85", ["length_unit+wrong_mass"], of("mass", 0.85), factor(0.001))
hidden("corner", "kt and mu", [], contact(0, kt=times(1.5), mu=times(0.6)))


# ---- curves ----

@functools.lru_cache(maxsize=None)
def right(scene):
    s = SCENES[scene]
    rough = balance.solve(s.structure, Code(samples=256), s.omega, balance.first_guess(s.structure, Code(), s.omega))
    return balance.solve(s.structure, s.how, s.omega, rough)


def amplitudes(scene, X):
    return np.array([[half_range(x) for x in X[:, d]] for d in SCENES[scene].dofs])


def make(m):
    """omega, values[response][point], and how far off they are."""
    s = SCENES[m.scene]
    good = X = right(m.scene)
    omega = s.omega
    if m.change:
        structure, how = m.change(s.structure, s.how)
        start = np.where(np.isnan(good), 0, good)
        X = balance.solve(structure, how, omega, start)
    there = ~np.isnan(X).any(axis=(1, 2))
    omega, X = omega[there], X[there]
    values = amplitudes(m.scene, X)
    if m.read:
        omega, values = m.read(omega, values, X, s)
    truth = amplitudes(m.scene, good[there])
    with np.errstate(invalid="ignore", divide="ignore"):
        apart = np.abs(values - truth) / np.maximum(np.abs(values), np.abs(truth))
    apart = np.nan_to_num(apart, nan=1.0)
    off = max(np.quantile(a, 0.9) for a in apart) if omega is not None and len(omega) else 0.0
    if m.read is cycles:
        off = 1.0
    return omega, values, min(1.0, off)


def text(m):
    omega, values, off = make(m)
    names = SCENES[m.scene].names
    lines = [f"# off by {100 * off:.2g} %", "omega," + ",".join("of_" + name for name in names)]
    lines += [",".join(f"{x:.7g}" for x in (w, *row)) for w, row in zip(omega, values.T)]
    return "\n".join(lines) + "\n"
