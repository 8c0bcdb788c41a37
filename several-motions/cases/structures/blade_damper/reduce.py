#!/usr/bin/env python3
"""Writes ../blade_damper_reduced.yaml, 36_reduced_M.mtx and 36_reduced_K.mtx from make.py's files of 36 pairs: the model in
few coordinates, the tip's x and modes with that held. Needs NumPy; `reduce.py 40` keeps 40 instead of 30.

Modes of what the contacts leave open alone would make them far too stiff, those with all stuck too soft: the basis is half of
each. In it the motion of a pair is no node's any more, but a direction of all coordinates, which the case spells out."""
import csv
import os
import sys

import numpy as np

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
from solid_elements import write, write_matrix

HERE = os.path.dirname(os.path.abspath(__file__))
TANGENTIAL, NORMAL, FRICTION = 2.0e10, 2.5e10, 0.3  # per area, as in ../blade_damper.yaml
PRESS = 8.333333333333334  # on a node of the strip [N]
AXES = "xyz"  # tangent, tangent_2 and normal of a pair; the blade's plate stands across x


def read_matrix(name):
    with open(os.path.join(HERE, name), encoding="ascii") as f:
        rows = [line.split() for line in f if not line.startswith("%")]
    A = np.zeros((int(rows[0][0]),) * 2)
    for i, j, a in rows[1:]:
        A[int(i) - 1, int(j) - 1] = A[int(j) - 1, int(i) - 1] = float(a)
    return A


def read_rows(name):
    with open(os.path.join(HERE, name), encoding="ascii") as f:
        return list(csv.DictReader(f))


def modes(K, M):
    """Frequencies squared and shapes of mass 1."""
    L = np.linalg.cholesky(M)
    A = np.linalg.solve(L, np.linalg.solve(L, K).T)
    squares, shapes = np.linalg.eigh((A + A.T) / 2)
    return squares, np.linalg.solve(L.T, shapes)


def craig_bampton_of_one(K, M, held):
    """Shapes of `held` . x = 1 as the stiffness would have it, and modes where that is 0."""
    static = np.linalg.solve(K, held)
    free = np.linalg.svd(held[None, :])[2][1:].T
    shapes = free @ modes(free.T @ K @ free, free.T @ M @ free)[1]
    return np.column_stack([static / (held @ static), shapes])


def mapping(row):
    kept = [(i + 1, a) for i, a in enumerate(row) if abs(a) > 1e-10 * abs(row).max()]  # the rest is rounding
    return "{" + ", ".join(f"{i}: {a:.12g}" for i, a in kept) + "}"


def main(count):
    K, M = read_matrix("36_K.mtx"), read_matrix("36_M.mtx")
    dof = {(int(r["node"]), r["direction"]): int(r["dof"]) - 1 for r in read_rows("36_nodes.csv")}
    unit, pairs, stuck = np.eye(len(K)), [], K.copy()
    for r in read_rows("36_pairs.csv"):
        rows = [unit[dof[int(r["node_a"]), a]] - unit[dof[int(r["node_b"]), a]] for a in AXES]
        pairs.append((float(r["area"]), rows))
        for k, row in zip((TANGENTIAL, TANGENTIAL, NORMAL), rows):
            stuck += k * float(r["area"]) * np.outer(row, row)
    half = np.hstack([modes(K, M)[1][:, :count // 2], modes(stuck, M)[1][:, :count - count // 2]])
    basis = np.linalg.qr(half)[0]
    T = basis @ craig_bampton_of_one(basis.T @ K @ basis, basis.T @ M @ basis, basis[dof[1, "x"]])
    for name, A in (("M", M), ("K", K)):
        reduced = T.T @ A @ T
        reduced[abs(reduced) < 1e-10 * abs(reduced).max(axis=0)[:, None]] = 0  # rounding: both are known to vanish there
        write_matrix(os.path.join(HERE, f"36_reduced_{name}.mtx"), (reduced + reduced.T) / 2)
    press = PRESS * sum(T[dof[node, "z"]] for node in sorted({n for n, _ in dof}) if node > 1000)
    write(os.path.join(HERE, "..", "blade_damper_reduced.yaml"), case(count, T, pairs, press))
    for name, A in (("open", K), ("stuck", stuck)):
        for what, B in (("whole", np.eye(len(K))), ("reduced", T)):
            hertz = np.sqrt(modes(B.T @ A @ B, B.T @ M @ B)[0]) / (2 * np.pi)
            print(name, what, hertz[:3].round(2), "highest", hertz[-1].round())


def case(count, T, pairs, press):
    lines = [f"# blade_damper.yaml in {count} coordinates, the tip's x and {count - 1} modes; written by blade_damper/reduce.py,",
             "# which says how. Small enough to be integrated in time as well: compare takes minutes.",
             f"title: Blade with an under-platform damper, 36 node pairs, {count} coordinates",
             "structure: {mass: blade_damper/36_reduced_M.mtx, stiffness: blade_damper/36_reduced_K.mtx, damping: {modal: 0.002},",
             "            names: [tip, " + ", ".join(f"q{i + 1}" for i in range(1, count)) + "]}",
             "forcing:", "  - {dof: tip, amplitude: 3}",
             "  - {harmonic: 0, amplitude: 1, direction: " + mapping(press) + "}", "contacts:"]
    for area, rows in pairs:
        lines.append(f"  - {{tangential_stiffness: {TANGENTIAL * area:.9g}, normal_stiffness: {NORMAL * area:.9g}, "
                     f"friction: {FRICTION},")
        lines += [f"     {name}: {mapping(row @ T)}{end}" for name, row, end in
                  zip(("tangent", "tangent_2", "normal"), rows, (",", ",", "}"))]
    return lines + ["response: [tip]", "sweep: {frequency: [255, 330]}", "hbm: {harmonics: 7}",
                    "transient: {law: exact, method: closed_form}", "compare: {frequency: [300, 318, 325]}",
                    "# Six pairs lift off and meet again: seven harmonics leave 2.4 % of the amplitude, fifteen 0.8 %.",
                    "gate: {amplitude: 0.03, harmonic_1: 0.03, mean: 0.01, waveform: 0.08}"]


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 30)
