"""Harmonic balance of a structure on contacts by alternating between frequency and time (AFT), at many frequencies at
once, with the mistakes that one makes at it as options. It shares nothing with hbmcheck but the equations:

    M x'' + C x' + K x + sum_j [ t_j T_j + n_j (N_j - N0_j) ] = sum_k p_k cos(k omega t) + q_k sin(k omega t)
    u_j = t_j . x,  v_j = n_j . x,  N = max(kn (v + gap), 0) + load,  N0 = max(kn gap, 0)
    T = kt (u - w), |T| <= mu N; T = 0 and w = u where N = 0; with two tangents T, u, w are vectors in their plane

    Structure   what is simulated: plain numbers that a mistake may change
    Code        how it is solved
    solve       X[omega][dof][2H+1] by Newton from a guess; NaN where it does not converge
"""
import copy
import dataclasses

import numpy as np


@dataclasses.dataclass
class Contact:
    tangents: list  # of directions in x: none, one, or two
    normal: object  # or None
    kt: float = 0.0
    kn: float = 0.0
    mu: float = 0.0
    gap: float = 0.0
    load: float = 0.0
    square: bool = False  # of two tangents: each has its own limit
    sign: float = 1.0     # of the friction force on the structure
    late: int = 0         # samples by which its force comes late


@dataclasses.dataclass
class Structure:
    mass: np.ndarray
    damping: np.ndarray
    stiffness: np.ndarray
    loads: list  # (dof, amplitude, harmonic, phase [degree]): amplitude cos(k omega t + phase)
    contacts: list
    structural: float = 0.0  # damping force i structural K x, at every frequency
    cubic: float = 0.0       # stiffness of a spring on the first degree of freedom that the case has not

    def copy(self):
        return copy.deepcopy(self)


@dataclasses.dataclass(frozen=True)
class Code:
    """As it stands, rightly, but for 1/N^2."""
    harmonics: int = 10
    samples: int = 512
    mean: bool = True
    even: bool = True
    periods: int = 3                 # that sliders are followed, from w = 0; the last is kept
    restart: str = "interpolated"    # after a separation; "sample", "zeroed" or "kept"
    slider: str = "whole"            # "no mean": the slider's mean is left out of T; "no mean of T": T has none
    separates: bool = True
    constant_limit: bool = False     # |T| <= mu N0
    constant_normal: bool = False    # N = N0, T with mu N0
    contact_factor: float = 1.0
    mean_factor: float = 1.0
    contact: str = "law"             # "none", or "stuck" for ever
    preload_off: bool = True


def basis(harmonics, samples):
    th = 2 * np.pi * np.arange(samples) / samples
    rows = np.ones((samples, 2 * harmonics + 1))
    for h in range(1, harmonics + 1):
        rows[:, 2 * h - 1], rows[:, 2 * h] = np.cos(h * th), np.sin(h * th)
    return rows


def follow(c, code, q, rows):
    """T[batch][sample][tangent], N - N0, and their derivatives by the coefficients of the relative motion:
    [batch][sample][force][coordinate][2H+1]. q[batch][sample][coordinate]: the tangents' u, then v."""
    batch, samples, size = q.shape
    n_tangents, n_coef = len(c.tangents), rows.shape[1]
    limit_by_v = 0.0 if (code.constant_limit or code.constant_normal) else c.mu * c.kn
    preload = max(c.kn * c.gap, 0.0)
    force = np.zeros((batch, samples, size))
    slope = np.zeros((batch, samples, size, size, n_coef))
    v = q[:, :, n_tangents] if c.normal is not None else np.zeros((batch, samples))
    gap = v + c.gap
    if c.normal is not None:
        touching = gap > 0 if code.separates else np.ones_like(gap, bool)
        off = preload if code.preload_off else 0.0
        if code.constant_normal:
            touching = np.ones_like(gap, bool)
        else:
            force[:, :, n_tangents] = np.where(touching, c.kn * gap, 0.0) - off
            slope[:, :, n_tangents, n_tangents] = np.where(touching, c.kn, 0.0)[..., None] * rows[None]
    if not n_tangents or not c.kt or not c.mu:
        return force, slope
    fixed = c.load + (preload if code.constant_limit or code.constant_normal else 0.0)
    normal = fixed + (0.0 if code.constant_limit or code.constant_normal else c.kn * np.maximum(gap, 0.0))
    contact_on = (c.load > 0) | (gap > 0) | code.constant_normal | (not code.separates)
    w = np.zeros((batch, n_tangents))
    dw = np.zeros((batch, n_tangents, size, n_coef))
    slider = np.zeros((batch, samples, n_tangents))
    d_slider = np.zeros((batch, samples, n_tangents, size, n_coef)) if code.slider == "no mean" else None
    index = range(n_tangents)
    for period in range(code.periods):
        keep = period == code.periods - 1
        for i in range(samples):
            on, was = contact_on[:, i], contact_on[:, i - 1]
            if code.restart != "kept" or on.all():
                if (on & ~was).any() and code.restart == "interpolated":
                    g0, g1 = gap[:, i - 1], gap[:, i]
                    width = np.where(on & ~was, g0 - g1, 1.0)
                    part = g0 / width
                    by_part = (-g1[:, None] * rows[i - 1] + g0[:, None] * rows[i]) / width[:, None] ** 2
                    for k in index:
                        step = q[:, i, k] - q[:, i - 1, k]
                        w[:, k] = np.where(on & ~was, q[:, i - 1, k] + part * step, w[:, k])
                        new = np.zeros((batch, size, n_coef))
                        new[:, k] = rows[i - 1] + part[:, None] * (rows[i] - rows[i - 1])
                        new[:, n_tangents] += step[:, None] * by_part
                        dw[:, k] = np.where((on & ~was)[:, None, None], new, dw[:, k])
            trial = c.kt * (q[:, i, :n_tangents] - w)
            d_trial = -c.kt * dw
            for k in index:
                d_trial[:, k, k] += c.kt * rows[i]
            bound = c.mu * normal[:, i]
            by_bound = np.where(gap[:, i] > 0, limit_by_v, 0.0)[:, None] * rows[i]
            if n_tangents == 1 or c.square:
                for k in index:
                    slips = np.abs(trial[:, k]) > bound
                    if slips.any():
                        sign = np.sign(trial[:, k])
                        trial[:, k] = np.where(slips, sign * bound, trial[:, k])
                        d_trial[slips, k] = 0.0
                        if c.normal is not None:
                            d_trial[slips, k, n_tangents] = (sign[:, None] * by_bound)[slips]
            else:
                size_of = np.hypot(trial[:, 0], trial[:, 1])
                slips = size_of > bound
                if slips.any():
                    safe = np.where(size_of > 0, size_of, 1.0)
                    e = trial / safe[:, None]
                    along = np.einsum("bk,bksn->bsn", e, d_trial)
                    new = (bound / safe)[:, None, None, None] * (d_trial - e[:, :, None, None] * along[:, None])
                    if c.normal is not None:
                        new[:, :, n_tangents] += e[:, :, None] * by_bound[:, None]
                    trial = np.where(slips[:, None], bound[:, None] * e, trial)
                    d_trial = np.where(slips[:, None, None, None], new, d_trial)
            if not on.all():
                trial[~on] = 0.0
                d_trial[~on] = 0.0
            held = w.copy(), dw.copy()
            w = q[:, i, :n_tangents] - trial / c.kt
            dw = -d_trial / c.kt
            for k in index:
                dw[:, k, k] += rows[i]
            if not on.all() and code.restart in ("zeroed", "kept"):
                w[~on] = 0.0 if code.restart == "zeroed" else held[0][~on]
                dw[~on] = 0.0 if code.restart == "zeroed" else held[1][~on]
            if keep:
                force[:, i, :n_tangents] = c.sign * trial
                slope[:, i, :n_tangents] = c.sign * d_trial
                slider[:, i] = w
                if d_slider is not None:
                    d_slider[:, i] = dw
    if code.slider == "no mean":
        force[:, :, :n_tangents] += c.sign * c.kt * slider.mean(axis=1)[:, None]
        slope[:, :, :n_tangents] += c.sign * c.kt * d_slider.mean(axis=1)[:, None]
    if code.slider == "no mean of T":
        force[:, :, :n_tangents] -= force[:, :, :n_tangents].mean(axis=1)[:, None]
        slope[:, :, :n_tangents] -= slope[:, :, :n_tangents].mean(axis=1)[:, None]
    return force, slope


def residual(s, code, omega, X):
    """R[batch][n (2H+1)] and its Jacobian, X[batch][n][2H+1]."""
    batch, n, n_coef = X.shape
    H = code.harmonics
    rows = basis(H, code.samples)
    weights = 2 * rows.T / code.samples
    weights[0] /= 2
    weights = weights * code.contact_factor
    weights[0] *= code.mean_factor
    R = np.zeros((batch, n, n_coef))
    J = np.zeros((batch, n, n_coef, n, n_coef))
    R[:, :, 0] = X[:, :, 0] @ s.stiffness.T
    J[:, :, 0, :, 0] = s.stiffness
    for h in range(1, H + 1):
        a, b = 2 * h - 1, 2 * h
        Z = s.stiffness[None] - (h * omega[:, None, None]) ** 2 * s.mass
        D = h * omega[:, None, None] * s.damping + s.structural * s.stiffness
        R[:, :, a] = np.einsum("bij,bj->bi", Z, X[:, :, a]) + np.einsum("bij,bj->bi", D, X[:, :, b])
        R[:, :, b] = np.einsum("bij,bj->bi", Z, X[:, :, b]) - np.einsum("bij,bj->bi", D, X[:, :, a])
        J[:, :, a, :, a] = J[:, :, b, :, b] = Z
        J[:, :, a, :, b], J[:, :, b, :, a] = D, -D
    for dof, amplitude, k, phase in s.loads:
        if k == 0:
            R[:, dof, 0] -= amplitude
        elif k <= H:
            R[:, dof, 2 * k - 1] -= amplitude * np.cos(np.radians(phase))
            R[:, dof, 2 * k] += amplitude * np.sin(np.radians(phase))
    for c in s.contacts if code.contact != "none" else []:
        directions = np.array(list(c.tangents) + ([c.normal] if c.normal is not None else []))
        if code.contact == "stuck":
            k = np.diag([c.kt] * len(c.tangents) + [c.kn] * (c.normal is not None))
            more = directions.T @ k @ directions
            R += np.einsum("ij,bjn->bin", more, X)
            J += np.einsum("ij,nm->injm", more, np.eye(n_coef))[None]
            continue
        q = np.einsum("ci,bin,tn->btc", directions, X, rows)
        force, slope = follow(c, code, q, rows)
        if c.late:
            force, slope = np.roll(force, c.late, axis=1), np.roll(slope, c.late, axis=1)
        F = np.einsum("nt,btc->bcn", weights, force)
        dF = np.tensordot(slope, weights, axes=([1], [1]))  # b c d m n
        R += np.einsum("ci,bcn->bin", directions, F)
        J += np.einsum("ci,bcdmn,dj->binjm", directions, dF, directions, optimize=True)
    if s.cubic:
        x = X[:, 0] @ rows.T
        R[:, 0] += s.cubic * x ** 3 @ weights.T
        J[:, 0, :, 0] += np.einsum("nt,bt,tm->bnm", weights, 3 * s.cubic * x ** 2, rows)
    return R.reshape(batch, -1), J.reshape(batch, n * n_coef, n * n_coef)


def newton(s, code, omega, X, most=30):
    """X and which of them converged."""
    X = X.copy()
    batch, n, n_coef = X.shape
    kept = [i for i in range(n_coef) if (i > 0 or code.mean) and (i == 0 and code.even or (i + 1) // 2 % 2 or code.even)]
    mask = np.zeros((n, n_coef), bool)
    mask[:, kept] = True
    mask = mask.ravel()
    X.reshape(batch, -1)[:, ~mask] = 0
    scale = max(abs(load[1]) for load in s.loads)
    done = np.zeros(batch, bool)
    size = np.full(batch, np.inf)
    step = np.zeros((batch, n * n_coef))
    part = np.ones(batch)
    last = X.reshape(batch, -1).copy()
    for _ in range(most):
        todo = np.flatnonzero(~done)
        if not len(todo):
            break
        R, J = residual(s, code, omega[todo], X[todo])
        now = np.abs(R[:, mask]).max(axis=1)
        done[todo[now <= 1e-10 * scale]] = True
        J = J[:, mask][:, :, mask]
        J[:, range(mask.sum()), range(mask.sum())] += 1e-300
        for b, i in enumerate(todo):
            if done[i]:
                continue
            if now[b] > 3 * size[i] and part[i] > 0.1:  # back, and a shorter step
                part[i] *= 0.4
            else:
                last[i] = X[i].ravel()
                try:
                    step[i, mask] = np.linalg.solve(J[b], R[b, mask])
                except np.linalg.LinAlgError:
                    step[i] = 0
                size[i], part[i] = now[b], min(1.0, 2 * part[i])
            X[i] = (last[i] - part[i] * step[i]).reshape(n, n_coef)
    return X, done


def fit(X, harmonics):
    out = np.zeros(X.shape[:2] + (2 * harmonics + 1,))
    both = min(out.shape[2], X.shape[2])
    out[:, :, :both] = X[:, :, :both]
    return out


def solve(s, code, omega, guess):
    """From guesses[omega][dof][any number of coefficients]; where Newton fails, from the neighbours' solutions."""
    X, done = newton(s, code, omega, fit(guess, code.harmonics))
    for _ in range(10):
        fails = np.flatnonzero(~done)
        tried = False
        for side in (-1, 1):
            at = [i for i in fails if not done[i] and 0 <= i + side < len(omega) and done[i + side]]
            if at:
                Y, ok = newton(s, code, omega[at], X[[i + side for i in at]], 12)
                for k, i in enumerate(at):
                    if ok[k]:
                        X[i], done[i], tried = Y[k], True, True
        if not tried:
            break
    X[~done] = np.nan
    return X


def first_guess(s, code, omega):
    """The linear response with contacts stuck, under static loads too."""
    zero = np.zeros((len(omega), s.mass.shape[0], 2 * code.harmonics + 1))
    return newton(s, dataclasses.replace(code, contact="stuck"), omega, zero)[0]
