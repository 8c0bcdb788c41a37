#!/usr/bin/env python3
"""Writes the models of plates.yaml (12 pairs) and plates_36.yaml beside itself; needs NumPy. Units: kg, N, m, s.

Two steel plates, one above the other, are clamped at x = 0 and touch over a patch at the end of the lower one; the
upper one is longer and is loaded at a corner of its tip. Each is one layer of solid elements and is reduced by Craig and
Bampton on its own: to the nodes of its face in the patch, the upper one to the loaded node as well, and to its first
modes with these held. x is along the plates, y across, z up. A pair is a node of the upper plate's lower face and the
node of the lower plate's upper face below it: the meshes match. The patch is crowned: its ends have a clearance. The
cases press it together by a static load."""
import os
import sys

import numpy as np

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
from solid_elements import assemble, craig_bampton, frequencies, write, write_matrix

WIDTH, UPPER, LOWER = 0.04, (0.20, 0.005), (0.11, 0.005)  # [m] of both; length and thickness of each
PATCH = (0.0825, 0.10)  # from x to x [m]
STEP = 0.01  # of the mesh along x outside the patch [m]
CROWN = 2.0e-6  # [m] clearance at the ends of the patch, none in its middle
MODES = (5, 4)  # of the upper and the lower plate
STUCK = (2.0e10, 2.0e10, 2.5e10)  # stiffnesses per area, as in the cases: for the frequencies that are printed


def plate(length, thick, n_y, patch):
    """K, M and nodes {(i, j, k): number} of a plate, its clamped end left out; then i of the patch's first grid line and
    of the plate's end. The grid lines along x are those of `patch` and others about STEP apart."""
    before = np.linspace(0, patch[0], round(patch[0] / STEP) + 1)
    behind = np.linspace(patch[-1], length, round((length - patch[-1]) / STEP) + 1)
    x = np.concatenate([before[:-1], patch, behind[1:]])
    bricks = [((i, j, 0), (x[i + 1] - x[i], WIDTH / n_y, thick)) for i in range(len(x) - 1) for j in range(n_y)]
    return assemble(bricks, lambda i, j, k: i == 0) + (len(before) - 1, len(x) - 1)


def model(name, n_x, n_y):
    """NAME_M.mtx, NAME_K.mtx, NAME_nodes.csv, NAME_pairs.csv of n_x times n_y + 1 pairs; returns natural frequencies
    [Hz] with the contacts open and with all of them stuck."""
    patch = np.linspace(*PATCH, n_x)
    blocks, rows, start = [], [], 0
    for (length, thick), side, level, number in ((UPPER, 0, 0, 101), (LOWER, 1, 1, 1001)):
        K, M, nodes, first, last = plate(length, thick, n_y, patch)
        face = [nodes[first + i, j, level] for i in range(n_x) for j in range(n_y + 1)]
        names = [number + p for p in range(len(face))]
        if side == 0:
            face, names = face + [nodes[last, n_y, 1]], names + [1]
        kept = np.array([3 * p + d for p in face for d in range(3)])
        blocks.append(craig_bampton(K, M, kept, MODES[side]))
        rows += [(start + 3 * p + d + 1, node, "xyz"[d]) for p, node in enumerate(names) for d in range(3)]
        start += len(kept) + MODES[side]
    n, b = start, len(blocks[0][0])
    K, M = np.zeros((n, n)), np.zeros((n, n))
    for A, k in ((K, 0), (M, 1)):
        A[:b, :b], A[b:, b:] = [(B[k] + B[k].T) / 2 for B in blocks]
    write_matrix(name + "_K.mtx", K)
    write_matrix(name + "_M.mtx", M)
    write(name + "_nodes.csv", ["dof,node,direction"] + [",".join(map(str, r)) for r in rows])
    lines, stuck = ["node_a,node_b,gap,area"], K.copy()
    for p in range(n_x * (n_y + 1)):
        i, j = divmod(p, n_y + 1)
        area = (PATCH[1] - PATCH[0]) * WIDTH / ((n_x - 1) * n_y) * (0.5 if i in (0, n_x - 1) else 1) * \
            (0.5 if j in (0, n_y) else 1)
        gap = -CROWN * (2 * i / (n_x - 1) - 1) ** 2
        lines.append(f"{1001 + p},{101 + p},{gap:.6g},{area:.9g}")
        for d in range(3):
            pair = np.ix_(*[[3 * p + d, b + 3 * p + d]] * 2)
            stuck[pair] += STUCK[d] * area * np.array([[1, -1], [-1, 1]])
    write(name + "_pairs.csv", lines)
    return frequencies(K, M), frequencies(stuck, M)


if __name__ == "__main__":
    here = os.path.dirname(os.path.abspath(__file__))
    for name, n_x, n_y in (("12", 4, 2), ("36", 4, 8)):
        free, stuck = model(os.path.join(here, name), n_x, n_y)
        print(name, "pairs, DOFs", len(free), "open [Hz]", free[:4].round(2), "stuck [Hz]", stuck[:4].round(2),
              "highest", free[-1].round(), stuck[-1].round())
