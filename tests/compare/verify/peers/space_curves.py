#!/usr/bin/env python3
"""Response curves of cases/structures/space.yaml with contacts[0].gap = 0.1, for ../../../../cases/verify/: by
tmdsimpy's elastic dry friction in three dimensions, which limits each of the two tangential forces by itself, and by
the radial return of the law of the circle, as most programs have it, written here.

    space_curves.py TMDSIMPY COMMIT TARGET
      TMDSIMPY  a checkout of https://github.com/tmd-lab/tmdsimpy; needs numpy
      COMMIT    what it is a checkout of, for the files' remarks
      TARGET    the folder to write into

It takes a minute for the one and some ten for the other, whose element goes from sample to sample. tmdsimpy's element needs JAX; what of JAX it calls for its forces is done here by numpy, arrays with .at[...].set(...)
included. Its derivatives are not: the Jacobian is by differences. The equations are the same for both: M x'' + C x' +
K x + forces of the contact = the load, H harmonics and harmonic 0, N samples a period, Newton from omega to omega.
"""
import datetime
import importlib
import os
import sys
import types

import numpy as np

M = np.eye(3)
C = np.array([[0.29938196180258764, 0, 0.019246842526345592], [0, 0.34205262752974136, 0],
              [0.019246842526345592, 0, 0.4020317886097642]])
K = np.array([[100.0, 0, 15], [0, 130, 0], [15, 0, 180]])
COSINE, SINE = np.array([3.0, 0, 2.4]), np.array([0, 1.8, 0])
KT, KN, MU, GAP = 60.0, 80.0, 0.5, 0.1
H, N = 7, 1024
OMEGAS = np.round(np.linspace(9.5, 15.2, 39), 10)
WRITTEN_FROM = 11  # below, the foot sticks all period, and where it does so depends on the start
LENGTH = 2 * H + 1
ANGLES = 2 * np.pi * np.arange(N) / N
BASIS = np.column_stack([np.ones(N)] + [f(h * ANGLES) for h in range(1, H + 1) for f in (np.cos, np.sin)])


def samples(X):
    """x(th_i) of X[LENGTH, 3]."""
    return BASIS @ X


def harmonics(f):
    """[LENGTH, 3] of f(th_i)."""
    F = 2 * BASIS.T @ f / N
    F[0] /= 2
    return F


# ---- the law of the circle, by radial return at each sample -------------------------------------------------------

def circle_forces(X):
    """T_1, T_2, N - N0 by 4 periods from w = 0 at the first sample; after a separation w is u where it ended."""
    x = samples(X)
    normal = np.maximum(KN * (x[:, 2] + GAP), 0)
    f = np.empty_like(x)
    f[:, 2] = normal - KN * GAP
    u, limit = x[:, :2].tolist(), (MU * normal).tolist()
    w1 = w2 = 0.0
    for i in range(4 * N):
        k = i % N
        a, b = u[k]
        t1, t2 = KT * (a - w1), KT * (b - w2)
        size = (t1 * t1 + t2 * t2)**0.5
        if limit[k] <= 0:
            t1 = t2 = 0.0
            w1, w2 = a, b
        elif size > limit[k]:
            t1, t2 = t1 * limit[k] / size, t2 * limit[k] / size
            w1, w2 = a - t1 / KT, b - t2 / KT
        f[k, 0], f[k, 1] = t1, t2
    return harmonics(f)


# ---- tmdsimpy's element ----------------------------------------------------------------------------------------------

class Array(np.ndarray):
    """A numpy array with JAX's .at[where].set(what); it changes the array itself, which the element lets go of."""

    @property
    def at(self):
        class Setter:
            def __getitem__(_, where):
                def put(what):
                    self[where] = what
                    return self
                return types.SimpleNamespace(set=put)
        return Setter()


def loop(first, last, body, value):
    for i in range(first, last):
        value = body(i, value)
    return value


def jax_by_numpy():
    """The modules jax and jax.numpy as far as elastic_dry_fric_3d.py calls them for its forces."""
    jax, jnp = types.ModuleType("jax"), types.ModuleType("jax.numpy")
    jax.__dict__.update(numpy=jnp, jit=lambda f, **_: f, lax=types.SimpleNamespace(fori_loop=loop))
    for name in ("maximum", "minimum", "where", "reshape", "vstack", "real", "fft", "array"):
        setattr(jnp, name, getattr(np, name))
    jnp.zeros = lambda *a: np.zeros(*a).view(Array)
    jnp.zeros_like = lambda a: np.zeros_like(a).view(Array)
    jnp.ones_like = np.ones_like
    return {"jax": jax, "jax.numpy": jnp}


def tmdsimpy_forces(folder):
    """Of X: T_1, T_2, N - N0 by its local_force_history, two periods from the slider at 0."""
    sys.path.insert(0, folder)
    sys.modules.update(jax_by_numpy())
    importlib.import_module("tmdsimpy.utils.harmonic")
    for name in ("tmdsimpy.jax", "tmdsimpy.jax.nlforces"):  # not what else they would import
        sys.modules[name] = types.ModuleType(name)
        sys.modules[name].__path__ = [os.path.join(folder, *name.split("."))]
    module = importlib.import_module("tmdsimpy.jax.nlforces.elastic_dry_fric_3d")
    element = module.ElasticDryFriction3D(np.eye(3), np.eye(3), KT, KN, MU, u0=np.zeros(3), meso_gap=-GAP)

    def forces(X):
        f, = element.local_force_history(samples(X), None, None, None, X[0])
        F = harmonics(np.asarray(f))
        F[0, 2] -= KN * GAP
        return F
    return forces


# ---- harmonic balance ---------------------------------------------------------------------------------------------------

def residual(forces, omega, X):
    R = forces(X)
    R[0] += K @ X[0]
    for h in range(1, H + 1):
        a, b = X[2 * h - 1], X[2 * h]
        Z, D = K - (h * omega)**2 * M, h * omega * C
        R[2 * h - 1] += Z @ a + D @ b
        R[2 * h] += Z @ b - D @ a
    R[1] -= COSINE
    R[2] -= SINE
    return R.ravel()


def jacobian(forces, omega, X, R, step=1e-7):
    J = np.empty((X.size, X.size))
    for q in range(X.size):
        Y = X.ravel().copy()
        Y[q] += step
        J[:, q] = (residual(forces, omega, Y.reshape(X.shape)) - R) / step
    return J


def newton(forces, omega, X):
    """The solution next to X; the Jacobian is made again where a step does not halve the residual."""
    J, last = None, np.inf
    for _ in range(60):
        R = residual(forces, omega, X)
        size = np.linalg.norm(R)
        if size < 1e-10:
            return X
        if J is None or size > 0.5 * last:
            J = jacobian(forces, omega, X, R)
        last = size
        X = X - np.linalg.solve(J, R).reshape(X.shape)
    raise RuntimeError(f"no solution at omega = {omega:g}: residual {size:g}")


def curve(forces):
    stuck = np.diag([KT, KT, KN])
    X = np.zeros((LENGTH, 3))
    x1 = np.linalg.solve(K + stuck - OMEGAS[0]**2 * M + 1j * OMEGAS[0] * C, COSINE - 1j * SINE)
    X[1], X[2] = x1.real, -x1.imag
    for omega in OMEGAS:
        X = newton(forces, omega, X)
        if omega >= WRITTEN_FROM:
            yield omega, X


FINE = np.column_stack([f(h * 2 * np.pi * np.arange(8192) / 8192) for h in range(1, H + 1) for f in (np.cos, np.sin)])


def write(path, remarks, forces):
    with open(path, "w", encoding="ascii") as file:
        print(f"# cases/structures/space.yaml with contacts[0].gap=0.1, {remarks}, numpy {np.__version__}, "
              f"{datetime.date.today()}.", file=file)
        print(f"# Made by tests/compare/verify/peers/space_curves.py, H = {H}, N = {N}; only what is "
              f"below omega = {WRITTEN_FROM} was left out: there it sticks.", file=file)
        print("omega,amplitude@x,amplitude@y,amplitude@z,harmonic_1@x,harmonic_1@y,harmonic_1@z", file=file)
        for omega, X in curve(forces):
            x = FINE @ X[1:]
            amplitude = (x.max(axis=0) - x.min(axis=0)) / 2
            print(f"{omega:.10g}," + ",".join(f"{v:.10g}" for v in (*amplitude, *np.hypot(X[1], X[2]))), file=file)
            file.flush()


def main():
    folder, commit, target = sys.argv[1:]
    write(os.path.join(target, "radial_space.csv"), "by radial return of the law of the circle", circle_forces)
    write(os.path.join(target, "tmdsimpy_space.csv"),
          f"by tmdsimpy's ElasticDryFriction3D (commit {commit}), numpy in the place of JAX", tmdsimpy_forces(folder))


main()
