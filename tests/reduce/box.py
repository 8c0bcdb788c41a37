"""A box of 8-node bricks as CalculiX writes it: NAME.sti, NAME.mas (one triangle) and NAME.dof, the face x = 0 clamped or not.
    python3 box.py FOLDER/NAME NX NY NZ [--free] [--lumped]"""
import sys

import numpy as np


def brick(h, young=2e11, poisson=0.3, density=7800.0):
    """Stiffness and mass [24][24] of a brick with edges h, node order x fastest."""
    corners = np.array([[i, j, k] for k in (0, 1) for j in (0, 1) for i in (0, 1)], float)
    g = 1 / np.sqrt(3)
    lam, mu = young * poisson / (1 + poisson) / (1 - 2 * poisson), young / 2 / (1 + poisson)
    D = np.diag([2 * mu] * 3 + [mu] * 3)
    D[:3, :3] += lam
    K, M = np.zeros((24, 24)), np.zeros((24, 24))
    volume = np.prod(h) / 8
    for point in (2 * corners - 1) * g:
        factors = (1 + (2 * corners - 1) * point) / 2
        N = factors.prod(1)
        d = np.array([(2 * corners[:, a] - 1) / h[a] * np.delete(factors, a, 1).prod(1) for a in range(3)])
        B = np.zeros((6, 24))
        for a in range(3):
            B[a, a::3] = d[a]
        for row, (a, b) in enumerate(((0, 1), (1, 2), (0, 2)), 3):
            B[row, a::3], B[row, b::3] = d[b], d[a]
        K += B.T @ D @ B * volume
        M += density * np.kron(np.outer(N, N), np.eye(3)) * volume
    return K, M


class Box:
    """K and M as lists (row, column, value) of the lower triangle, from 0; node(i, j, k) counts from 1; dofs[row] = (node, direction)."""

    def __init__(self, nx, ny, nz, size=(0.1, 0.02, 0.01), free=False, lumped=False):
        self.shape = np.array((nx, ny, nz)) + 1
        self.size, self.cells = np.array(size, float), (nx, ny, nz)
        k, m = brick(self.size / self.cells)
        if lumped:
            m = np.diag(m.sum(1))
        i, j, l = np.meshgrid(*map(np.arange, self.cells), indexing="ij")
        first = (i + self.shape[0] * (j + self.shape[1] * l)).ravel()
        steps = [a + self.shape[0] * (b + self.shape[1] * c) for c in (0, 1) for b in (0, 1) for a in (0, 1)]
        dofs = (3 * (first[:, None] + np.array(steps))[:, :, None] + np.arange(3)).reshape(len(first), 24)
        nodes = np.arange(np.prod(self.shape))
        clamped = np.zeros(len(nodes), bool) if free else nodes % self.shape[0] == 0
        self.row_of = np.where(np.repeat(clamped, 3), -1, 0)
        self.row_of[self.row_of == 0] = np.arange((self.row_of == 0).sum())
        self.n = int(self.row_of.max()) + 1
        kept = np.flatnonzero(self.row_of >= 0)
        self.dofs = np.column_stack((kept // 3 + 1, kept % 3 + 1))
        rows = self.row_of[dofs]
        self.K, self.M = self.sum_up(rows, k), self.sum_up(rows, m)

    def sum_up(self, rows, element):
        a, b = np.nonzero(element)
        r, c = rows[:, a].ravel(), rows[:, b].ravel()
        v = np.broadcast_to(element[a, b], (len(rows), len(a))).ravel()
        lower = (r >= c) & (c >= 0)
        key, where = np.unique(r[lower].astype(np.int64) * self.n + c[lower], return_inverse=True)
        return key // self.n, key % self.n, np.bincount(where, v[lower])

    def node(self, i, j, k):
        return 1 + i + self.shape[0] * (j + self.shape[1] * k)

    def dense(self, which):
        r, c, v = which
        A = np.zeros((self.n, self.n))
        A[r, c] = A[c, r] = v
        return A

    def write(self, name):
        for ending, (r, c, v) in ((".sti", self.K), (".mas", self.M)):
            np.savetxt(name + ending, np.column_stack((r + 1, c + 1, v)), fmt="%d %d %.15e")
        np.savetxt(name + ".dof", self.dofs, fmt="%d", delimiter=".")


if __name__ == "__main__":
    sizes = [int(a) for a in sys.argv[2:5]]
    box = Box(*sizes, free="--free" in sys.argv, lumped="--lumped" in sys.argv)
    box.write(sys.argv[1])
    print(box.n)
