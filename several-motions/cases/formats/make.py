#!/usr/bin/env python3
"""Writes one model in every format of matrices that is read, into files beside itself: a chain of four nodes in space
between two walls, its springs askew. Its numbers are multiples of 1/8, so that every format holds them exactly.
Units: kg, N, m, s."""
import os

NODES, K, M = (11, 12, 20, 31), {}, {}
N = 3 * len(NODES)
SPRINGS = [(None, 0), (0, 1), (1, 2), (2, 3), (3, None), (0, 3)]
ALONG = [(1, 0, 0), (1, 0.5, 0), (0.5, 1, 0.25), (0, 1, 0.5), (0.25, 0, 1), (1, 1, 1)]


def add(A, i, j, x):
    A[i, j] = A.get((i, j), 0) + x


def spring(a, b, axis, k):
    """k axis axis^T between the nodes a and b, None: a wall; and a tenth of it across, so that nothing is free."""
    for p, sign_p in ((a, 1), (b, -1)):
        for q, sign_q in ((a, 1), (b, -1)):
            if p is None or q is None:
                continue
            for d in range(3):
                for e in range(3):
                    x = axis[d] * axis[e] + (0.125 if d == e else 0)
                    if x:
                        add(K, 3 * p + d, 3 * q + e, sign_p * sign_q * k * x)


for (a, b), axis in zip(SPRINGS, ALONG):
    spring(a, b, axis, 64000)
for i in range(N):
    add(M, i, i, 0.5 + 0.125 * (i // 3))
for i in range(3):
    add(M, i, i + 3, 0.125), add(M, i + 3, i, 0.125)


def lower(A):
    return [(i, j, x) for (i, j), x in sorted(A.items()) if i >= j]


def upper_by_column(A):
    return sorted(((i, j, x) for (i, j), x in A.items() if i <= j), key=lambda e: (e[1], e[0]))


def write(name, lines):
    with open(os.path.join(here, name), "w", encoding="ascii") as f:
        f.writelines(line + "\n" for line in lines)


def element(kind, A):
    """As Abaqus does: each row of the lower triangle begins a line of at most four numbers."""
    yield f"*MATRIX,TYPE={kind}"
    for i in range(N):
        row = [f"{A.get((i, j), 0.0):.13g} " for j in range(i + 1)]
        for k in range(0, len(row), 4):
            yield " " + ", ".join(row[k:k + 4]) + ("," if k + 4 < len(row) or len(row) == 1 else "")


here = os.path.dirname(os.path.abspath(__file__))
for name, A in (("K", K), ("M", M)):
    entries = lower(A)
    write(f"{name}.mtx", [f"%%MatrixMarket matrix coordinate real symmetric", f"{N} {N} {len(entries)}"] +
          [f"{i + 1} {j + 1} {x!r}" for i, j, x in entries])
    write("chain." + {"K": "sti", "M": "mas"}[name],
          [f"{i + 1:10d} {j + 1:10d} {x:20.13e}" for i, j, x in upper_by_column(A)])
    write("chain_" + {"K": "STIF1", "M": "MASS1"}[name] + ".mtx",
          [f"{NODES[i // 3]},{i % 3 + 1}, {NODES[j // 3]},{j % 3 + 1}, {x: .15e}" for i, j, x in lower(A)])
    write("chain_" + {"K": "STIF1", "M": "MASS1"}[name] + "_coordinate.mtx",
          [f"{i + 1:8d}{j + 1:8d} {x: .15e}" for (i, j), x in sorted(A.items())])
write("chain.dof", [f"{node}.{d}" for node in NODES for d in (1, 2, 3)])
write("chain_element.mtx", ["**", "** ELEMENT NUMBER 1 STEP NUMBER 1 INCREMENT NUMBER 1", "** ELEMENT TYPE Z1",
                            f"*USER ELEMENT, NODES= {len(NODES)}, LINEAR", "** ELEMENT NODES",
                            "** " + ", ".join(map(str, NODES)), "1, 2, 3"] +
      list(element("STIFFNESS", K)) + list(element("MASS", M)))
