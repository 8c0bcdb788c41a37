#!/usr/bin/env python3
"""Writes the models of blade_damper.yaml (36 pairs) and blade_damper_120.yaml beside itself; needs NumPy. Units: kg, N, m, s.

A blade, a plate clamped at its foot, carries a platform on one side; a thin strip under the platform (of 120 pairs a
second one on top) is pressed on by its centrifugal force and rubs. The blade is of solid elements
(../solid_elements.py) and reduced by Craig and Bampton to the nodes of the platform's lower face, a node at the
tip and the fixed-interface modes below; the strip is a lattice of springs on an elastic bed, the neighbour's platform.
A pair is a node of the platform and the node of a strip that touches it: x and y along the face, z across it."""
import os
import sys

import numpy as np

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
from solid_elements import assemble, craig_bampton, frequencies, write, write_matrix

HEIGHT, WIDTH, THICK, PLATFORM, PLATE, LEVEL = 0.16, 0.05, 0.008, 0.036, 0.006, 0.060  # of blade and platform [m]
MODES = 12  # with the platform held
STRIP, LATTICE, BED = 0.02, 4.0e7, (4.0e6, 4.0e6, 1.0e6)  # strip: mass [kg], springs of its lattice, bed in all [N/m]
PRESS = 300.0  # on a strip in all [N]


def blade(n_y, n_x):
    """K, M and nodes {(i, j, k): number} of the blade, its foot left out. i counts along x: 0 and 1 are the blade's two
    faces, the platform goes on to 1 + n_x; j along y, 0..n_y; k along z."""
    low, n_z = 6, 16  # the platform is the layer above level `low` of n_z
    x = np.concatenate([[0, THICK], THICK + PLATFORM * np.arange(1, n_x + 1) / n_x])
    z = np.concatenate([np.linspace(0, LEVEL, low + 1), np.linspace(LEVEL + PLATE, HEIGHT, n_z - low)])
    bricks = [(0, j, k) for k in range(n_z) for j in range(n_y)]
    bricks += [(i, j, low) for i in range(1, n_x + 1) for j in range(n_y)]
    sized = [((i, j, k), (x[i + 1] - x[i], WIDTH / n_y, z[k + 1] - z[k])) for i, j, k in bricks]
    K, M, nodes = assemble(sized, lambda i, j, k: k == 0)
    face = [nodes[i, j, low] for i in range(2, n_x + 2) for j in range(n_y + 1)]
    return K, M, face, nodes[1, n_y // 2, n_z]


def strip(n_i, n_j, dx, dy):
    """K and M of a strip of n_i times n_j nodes: springs to the neighbours along x and y, in bending, and diagonally."""
    n = n_i * n_j
    K = np.diag(np.tile(np.array(BED) / n, n))
    for i in range(n_i):
        for j in range(n_j):
            for a, b in ((i + 1, j), (i, j + 1), (i + 1, j + 1), (i + 1, j - 1)):
                if not (a < n_i and 0 <= b < n_j):
                    continue
                along = np.array([(a - i) * dx, (b - j) * dy, 0])
                along /= np.linalg.norm(along)
                k = LATTICE * np.outer(along, along) + np.diag([0, 0, LATTICE / 100])
                p, q = 3 * (i * n_j + j), 3 * (a * n_j + b)
                for r, s, sign in ((p, p, 1), (q, q, 1), (p, q, -1), (q, p, -1)):
                    K[r:r + 3, s:s + 3] += sign * k
    return K, np.diag(np.full(3 * n, STRIP / n))


def model(name, n_x, n_y, strips):
    """NAME_M.mtx, NAME_K.mtx, NAME_nodes.csv, NAME_pairs.csv; returns frequencies [Hz] open, and with contacts welded."""
    K, M, face, tip = blade(n_y, n_x)
    kept = np.array([3 * p + d for p in face + [tip] for d in range(3)])
    Kr, Mr = craig_bampton(K, M, kept, MODES)
    n_j, area = n_y + 1, PLATFORM * WIDTH / (n_x * n_y)
    Ks, Ms = strip(n_x, n_j, PLATFORM / n_x, WIDTH / n_y)
    n, b, s = len(Kr) + strips * len(Ks), len(Kr), len(Ks)
    A, B = np.zeros((n, n)), np.zeros((n, n))
    A[:b, :b], B[:b, :b] = (Kr + Kr.T) / 2, (Mr + Mr.T) / 2
    for k in range(strips):
        A[b + k * s:b + (k + 1) * s, b + k * s:b + (k + 1) * s] = Ks
        B[b + k * s:b + (k + 1) * s, b + k * s:b + (k + 1) * s] = Ms
    write_matrix(name + "_K.mtx", A)
    write_matrix(name + "_M.mtx", B)
    rows = [(3 * p + d + 1, 101 + p, "xyz"[d]) for p in range(len(face)) for d in range(3)]
    rows += [(3 * len(face) + d + 1, 1, "xyz"[d]) for d in range(3)]
    rows += [(b + k * s + 3 * p + d + 1, 1001 + 1000 * k + p, "xyz"[d])
             for k in range(strips) for p in range(len(face)) for d in range(3)]
    write(name + "_nodes.csv", ["dof,node,direction"] + [",".join(map(str, r)) for r in rows])
    share = [area * (0.5 if p % n_j in (0, n_y) else 1) * (0.5 if p // n_j == n_x - 1 else 1) for p in range(len(face))]
    for k in range(strips):
        ending = "_pairs.csv" if k == 0 else "_pairs_top.csv"
        write(name + ending, ["node_a,node_b,area"] +
              [f"{1001 + 1000 * k + p},{101 + p},{share[p]:.9g}" for p in range(len(face))])
    for k in range(strips):
        for p in range(3 * len(face)):
            q = b + k * s + p
            A[p, p] += 1e9
            A[q, q] += 1e9
            A[p, q] -= 1e9
            A[q, p] -= 1e9
    return [frequencies(Kr, Mr)[:4], frequencies(A, B)[:4]], n, share


if __name__ == "__main__":
    here = os.path.dirname(os.path.abspath(__file__))
    for name, n_x, n_y, strips in (("36", 6, 5, 1), ("120", 6, 9, 2)):
        (free, stuck), n, share = model(os.path.join(here, name), n_x, n_y, strips)
        print(name, "DOFs", n, "blade [Hz]", free.round(2), "welded [Hz]", stuck.round(2), "area", sum(share))
