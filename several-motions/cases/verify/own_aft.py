import hbmcheck
import numpy as np

m, c, k, F0, kt, kn, mu, gap, a = 1, 0.4, 40, 100, 100, 1000, 0.3, -5, np.sqrt(0.5)
H, samples = 10, 1024
th, h = 2 * np.pi * np.arange(samples) / samples, np.arange(1, H + 1)
E = np.hstack([np.ones((samples, 1)), np.cos(np.outer(th, h)), np.sin(np.outer(th, h))])  # x = E X

def contact(x):
    u, N, T, w = a * x, np.maximum(kn * (a * x + gap), 0), np.zeros(samples), 0.0
    for i in [*range(samples)] * 2:                    # the second period is the steady one
        w = min(max(w, u[i] - mu * N[i] / kt), u[i] + mu * N[i] / kt)
        T[i] = kt * (u[i] - w)
    return a * (T + N)

def residual(X, omega):
    S, D, F = k - m * (h * omega) ** 2, c * h * omega, 2 / samples * E.T @ contact(E @ X)
    F[1] -= F0
    return np.r_[X[0], S * X[1:H + 1] + D * X[H + 1:] + F[1:H + 1], S * X[H + 1:] - D * X[1:H + 1] + F[H + 1:]]

omegas, X, amplitude = np.arange(4, 8.1, 0.25), np.zeros(2 * H + 1), []
for omega in omegas:
    for _ in range(10):                                # Newton, from the solution before
        R = residual(X, omega)
        J = np.array([(residual(X + 1e-7 * e, omega) - R) / 1e-7 for e in np.eye(2 * H + 1)]).T
        X = X - np.linalg.solve(J, R)
    amplitude.append(np.ptp(E @ X) / 2)

foot = dict(tangential_stiffness=kt, normal_stiffness=kn, friction=mu, angle_deg=45, gap=gap)
model = hbmcheck.Model(m, c, k, forcing=F0, contacts=[foot], sweep=(3, 20), hbm={"harmonics": H})
print(model.verify(omegas, amplitude))
