"""A harmonic balance written from suite/README.md: python3 sixty_lines.py SUITE FOLDER [CASE...] writes results into FOLDER."""
import json, pathlib, sys  # noqa: E401
import numpy as np
HARMONICS, SAMPLES, STATIC, SIGN = 20, 512, True, 1.0

def contact_force(c, x, dx):  # [samples, n, columns] under motions x[samples, n, columns] with velocities dx
    along = lambda key, of: np.einsum("n,snc->sc", np.array(c[key], float), of)
    spread = lambda key, f: np.einsum("n,sc->snc", np.array(c[key], float), f)
    if c.get("law") == "polynomial":
        return spread("direction", sum(v * along("direction", x)**int(p) for p, v in c["coefficients"].items()))
    if c.get("law") == "tanh":
        return spread("tangent", c["friction"] * c["preload"] * np.tanh(along("tangent", dx) / c["epsilon"]))
    force, N = np.zeros_like(x), np.full(x[:, 0].shape, float(c.get("preload", 0)))
    if "normal" in c:
        N = np.maximum(c["normal_stiffness"] * (along("normal", x) + c["gap"]), 0)
        force += spread("normal", N - max(c["normal_stiffness"] * c["gap"], 0))
    if "tangent" in c:
        u, w, T = along("tangent", x), np.zeros(x.shape[2]), np.zeros_like(N)
        for i in [*range(SAMPLES)] * 2:  # the second period is the steady one
            limit = c["friction"] * N[i] / c["tangential_stiffness"]
            w = np.minimum(np.maximum(w, u[i] - limit), u[i] + limit)
            T[i] = SIGN * c["tangential_stiffness"] * (u[i] - w)
        force += spread("tangent", T)
    return force

def solve(m, omega):  # X[2H+1, n]: mean, cosines and sines; None where Newton does not converge
    M, C, K = (np.array(m[k], float) for k in ("mass", "damping", "stiffness"))
    n, H, h, th = len(M), HARMONICS, np.arange(1, HARMONICS + 1), 2 * np.pi * np.arange(SAMPLES) / SAMPLES
    cos, sin, A, F = np.cos(np.outer(th, h)), np.sin(np.outer(th, h)), np.zeros((2 * H + 1, n, 2 * H + 1, n)), np.zeros((2 * H + 1, n))
    E, dE = np.hstack([np.ones((SAMPLES, 1)), cos, sin]), omega * np.hstack([np.zeros((SAMPLES, 1)), -h * sin, h * cos])
    A[0, :, 0, :] = K
    for k in h:
        A[k, :, k, :] = A[H + k, :, H + k, :] = K - (k * omega)**2 * M
        A[k, :, H + k, :], A[H + k, :, k, :] = k * omega * C, -k * omega * C
    for load in m["loads"]:  # the sine of harmonic 0 is none
        F[load["harmonic"]], F[(H + load["harmonic"]) * (load["harmonic"] > 0)] = load["cos"], load["sin" if load["harmonic"] else "cos"]
    A, F, size = A.reshape(F.size, F.size), F.reshape(-1, 1), F.size
    X = np.linalg.solve(A, F)
    for _ in range(40):
        P = (X + 1e-7 * np.eye(size, size + 1, 1)).reshape(2 * H + 1, n, -1)  # X, and X with one coefficient changed
        f = sum(contact_force(c, np.einsum("sk,knc->snc", E, P), np.einsum("sk,knc->snc", dE, P)) for c in m["contacts"])
        f = np.einsum("sk,snc->knc", E * np.r_[1, 2 * np.ones(2 * H)] / SAMPLES, f)
        R = A @ P.reshape(size, -1) + f.reshape(size, -1) - F
        R[:n] = R[:n] if STATIC else P[0]
        X = X - (dX := np.linalg.solve((R[:, 1:] - R[:, :1]) / 1e-7, R[:, :1]))
        if np.abs(dX).max() < 1e-10 * np.abs(X).max():
            return X.reshape(2 * H + 1, n)

def main(suite, folder, names):
    th = np.outer(2 * np.pi * np.arange(8192) / 8192, np.arange(1, HARMONICS + 1))
    for name in names or json.loads((suite / "suite.json").read_text())["cases"]:
        case, rows = json.loads((suite / "cases" / f"{name}.json").read_text()), ["omega,amplitude,mean,a1,b1"]
        for omega in case["omega"]:
            if (X := solve(case["model"], omega)) is not None:
                motion = np.hstack([np.cos(th), np.sin(th)]) @ (y := X @ case["response"])[1:]
                rows.append(",".join(repr(float(v)) for v in (omega, np.ptp(motion) / 2, y[0], y[1], y[HARMONICS + 1])))
        (folder / f"{name}.csv").write_text("\n".join(rows) + "\n")

if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]), sys.argv[3:])
