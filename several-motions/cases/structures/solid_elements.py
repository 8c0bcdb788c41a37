"""Solid finite elements of steel and their reduction by Craig and Bampton, for the scripts that write blade_damper/ and
plates/; needs NumPy. Units: kg, N, m, s.

The element is a brick of eight nodes with Wilson's incompatible modes, condensed: one through the thickness bends.
A node is three indices (i, j, k) of a grid along x, y and z; its DOFs are numbered x, y, z."""
import numpy as np

E, NU, RHO = 2.1e11, 0.3, 7850.0


def element(size):
    """Stiffness and mass of a brick, 24 DOFs; corners in the order of signs below."""
    signs = np.array([[i, j, k] for k in (-1, 1) for j in (-1, 1) for i in (-1, 1)], float)
    D = np.zeros((6, 6))
    D[:3, :3] = NU
    D[range(3), range(3)] = 1 - NU
    D[range(3, 6), range(3, 6)] = (1 - 2 * NU) / 2
    D *= E / ((1 + NU) * (1 - 2 * NU))
    K, M, volume = np.zeros((33, 33)), np.zeros((24, 24)), np.prod(size) / 8
    for point in signs / np.sqrt(3):
        N = np.prod(1 + signs * point, axis=1) / 8
        dN = np.stack([signs[:, a] / 8 * np.prod(np.delete(1 + signs * point, a, 1), axis=1) for a in range(3)])
        grad = np.hstack([dN, np.diag(-2 * point)]) * (2 / np.array(size))[:, None]  # eight corners, three bubbles
        B = np.zeros((6, 33))
        for c in range(11):
            x, y, z = grad[:, c]
            B[:, 3 * c:3 * c + 3] = [[x, 0, 0], [0, y, 0], [0, 0, z], [y, x, 0], [0, z, y], [z, 0, x]]
        K += B.T @ D @ B * volume
        M += np.kron(np.outer(N, N), np.eye(3)) * RHO * volume
    condensed = K[:24, :24] - K[:24, 24:] @ np.linalg.solve(K[24:, 24:], K[24:, :24])
    return condensed, M


def assemble(bricks, clamped):
    """K, M and nodes {(i, j, k): number} of bricks [((i, j, k) of the corner of least indices, size)]; nodes for which
    clamped(i, j, k) is true are left out."""
    corners = [[(i + a, j + b, k + c) for c in (0, 1) for b in (0, 1) for a in (0, 1)] for (i, j, k), _ in bricks]
    free = {c for cs in corners for c in cs if not clamped(*c)}
    nodes = {p: q for q, p in enumerate(sorted(free, key=lambda p: p[::-1]))}
    K, M = np.zeros((3 * len(nodes),) * 2), np.zeros((3 * len(nodes),) * 2)
    for (_, size), cs in zip(bricks, corners):
        ke, me = element(size)
        kept = [c for c in range(8) if cs[c] in nodes]
        local = [3 * c + d for c in kept for d in range(3)]
        rows = [3 * nodes[cs[c]] + d for c in kept for d in range(3)]
        K[np.ix_(rows, rows)] += ke[np.ix_(local, local)]
        M[np.ix_(rows, rows)] += me[np.ix_(local, local)]
    return K, M, nodes


def craig_bampton(K, M, kept, modes):
    """Both on the DOFs `kept` and the first modes with these held, of mass 1."""
    inner = np.setdiff1d(np.arange(len(K)), kept)
    L = np.linalg.cholesky(M[np.ix_(inner, inner)])
    scaled = np.linalg.solve(L, np.linalg.solve(L, K[np.ix_(inner, inner)]).T)
    shapes = np.linalg.solve(L.T, np.linalg.eigh((scaled + scaled.T) / 2)[1][:, :modes])
    T = np.zeros((len(K), len(kept) + modes))
    T[kept, range(len(kept))] = 1
    T[np.ix_(inner, range(len(kept)))] = -np.linalg.solve(K[np.ix_(inner, inner)], K[np.ix_(inner, kept)])
    T[np.ix_(inner, range(len(kept), len(kept) + modes))] = shapes
    return T.T @ K @ T, T.T @ M @ T


def frequencies(K, M):
    """All natural frequencies [Hz], the lowest first."""
    L = np.linalg.cholesky(M)
    return np.sqrt(np.linalg.eigvalsh(np.linalg.solve(L, np.linalg.solve(L, K).T))) / (2 * np.pi)


def write(path, lines):
    with open(path, "w", encoding="ascii") as f:
        f.writelines(line + "\n" for line in lines)


def write_matrix(path, A):
    i, j = np.nonzero(np.tril(A))
    write(path, ["%%MatrixMarket matrix coordinate real symmetric", f"{len(A)} {len(A)} {len(i)}"] +
          [f"{r + 1} {c + 1} {A[r, c]!r}" for r, c in zip(i.tolist(), j.tolist())])
