#!/usr/bin/env python3
"""Writes bladed_disk.yaml, bladed_disk_M.mtx and bladed_disk_K.mtx beside itself: 24 equal sectors of a rim, a blade's
root and its tip, and a split ring whose 24 masses rub on the rim. Units: kg, N, m, s."""
import os

SECTORS, ORDER = 24, 3  # the load travels round with three waves
MASS = {"rim": 1.2, "root": 0.3, "tip": 0.15, "ring": 0.01}
GROUND = {"rim": 6.0e5, "ring": 500.0}  # the shaft's; what centres the ring
RIM, BLADE, TIP, RING = 4.0e6, 1.0e6, 2.5e5, 2.0e5  # stiffness: rim to rim, rim to root, root to tip, ring to ring
LOAD, FRICTION, PRELOAD, TANGENTIAL = 4.0, 0.3, 15.0, 4.0e5  # on each tip; at each contact
KINDS = ("rim", "root", "tip", "ring")


def dof(kind, sector):
    """From 1: three a sector, then the ring's."""
    sector %= SECTORS
    return 3 * SECTORS + sector + 1 if kind == "ring" else 3 * sector + KINDS.index(kind) + 1


def stiffness():
    K = {}

    def spring(k, a, b=None):
        for i, j, sign in [(a, a, 1)] + ([(b, b, 1), (max(a, b), min(a, b), -1)] if b else []):
            K[i, j] = K.get((i, j), 0.0) + sign * k

    for s in range(SECTORS):
        for kind, k in GROUND.items():
            spring(k, dof(kind, s))
        spring(RIM, dof("rim", s), dof("rim", s + 1))
        spring(BLADE, dof("rim", s), dof("root", s))
        spring(TIP, dof("root", s), dof("tip", s))
        spring(RING, dof("ring", s), dof("ring", s + 1))
    return K


def write_matrix(name, entries):
    with open(name, "w", encoding="ascii") as f:
        f.write("%%MatrixMarket matrix coordinate real symmetric\n")
        f.write(f"{4 * SECTORS} {4 * SECTORS} {len(entries)}\n")
        for (i, j), value in sorted(entries.items()):
            f.write(f"{i} {j} {value!r}\n")


def case():
    yield """# A bladed disk with a friction ring, lumped: 24 sectors of rim, blade root and blade tip, 72 degrees of freedom, and a
# split ring in a groove of the rim, 24 more, pressed on by its own centrifugal force. Made by bladed_disk.py, where its
# parameters are. A load of engine order 3 travels round, so that all 24 contacts do the same one after the other: at the
# resonance of the blades in three nodal diameters the ring sticks at first, then slips everywhere and takes energy out.
title: Bladed disk with a friction ring, engine order 3
structure: {mass: bladed_disk_M.mtx, stiffness: bladed_disk_K.mtx, damping: {modal: 0.003}}
forcing:"""
    for s in range(SECTORS):
        phase = -360 * ORDER * s // SECTORS % 360
        yield f"  - {{dof: {dof('tip', s)}, amplitude: {LOAD}, phase_deg: {phase}}}"
    yield "contacts:"
    for s in range(SECTORS):
        yield (f"  - {{name: ring_{s + 1}, tangential_stiffness: {TANGENTIAL}, friction: {FRICTION}, preload: {PRELOAD}, "
               f"tangent: {{{dof('rim', s)}: 1, {dof('ring', s)}: -1}}}}")
    yield f"response: [{dof('tip', 0)}, {dof('rim', 0)}]"
    yield "sweep: {omega: [940, 1040]}"
    yield "hbm: {harmonics: 5}"


if __name__ == "__main__":
    here = os.path.dirname(os.path.abspath(__file__))
    masses = {(dof(kind, s), dof(kind, s)): m for kind, m in MASS.items() for s in range(SECTORS)}
    write_matrix(os.path.join(here, "bladed_disk_M.mtx"), masses)
    write_matrix(os.path.join(here, "bladed_disk_K.mtx"), stiffness())
    with open(os.path.join(here, "bladed_disk.yaml"), "w", encoding="ascii") as f:
        f.writelines(line + "\n" for line in case())
