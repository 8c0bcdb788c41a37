#!/usr/bin/env python3
"""Writes beam_pairs_M.mtx, beam_pairs_K.mtx and beam_pairs_nodes.csv beside itself: a beam of 16 nodes, free but for a soft
bed, each node moving along the beam (x) and across it (z). Mass 1 kg, length 1 m; bending by springs between the slopes
of neighbouring pieces, first free bending mode at about 150 rad/s; stiff along its length. Units: kg, N, m, s."""
import os

N, EI, EA, BED = 16, 45.0, 1.0e5, 100.0
H = 1.0 / (N - 1)
K = {}


def add(rows, factors, k):
    for i, a in zip(rows, factors):
        for j, b in zip(rows, factors):
            if i >= j:
                K[i, j] = K.get((i, j), 0.0) + k * a * b


for p in range(N):
    add([2 * p + 1], [1], BED / N)
    add([2 * p + 2], [1], BED / N)
    if p + 1 < N:
        add([2 * p + 1, 2 * p + 3], [-1, 1], EA / H)
    if 0 < p < N - 1:
        add([2 * p, 2 * p + 2, 2 * p + 4], [1, -2, 1], EI / H**3)

here = os.path.dirname(os.path.abspath(__file__))
for name, A in (("K", K), ("M", {(i, i): 1.0 / N for i in range(1, 2 * N + 1)})):
    with open(os.path.join(here, f"beam_pairs_{name}.mtx"), "w", encoding="ascii") as f:
        f.write(f"%%MatrixMarket matrix coordinate real symmetric\n{2 * N} {2 * N} {len(A)}\n")
        f.writelines(f"{i} {j} {x!r}\n" for (i, j), x in sorted(A.items()))
with open(os.path.join(here, "beam_pairs_nodes.csv"), "w", encoding="ascii") as f:
    f.write("dof,node,direction\n")
    f.writelines(f"{2 * p + d + 1},{p + 1},{'xz'[d]}\n" for p in range(N) for d in range(2))
