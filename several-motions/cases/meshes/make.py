#!/usr/bin/env python3
"""A blade with a platform that rubs on an arm beside it: mesh (CalculiX .inp), stiffness and mass, sparse.

    make.py small FOLDER     1044 degrees of freedom, 6 contact nodes a side, lumped mass: what stands in blade/
    make.py large FOLDER     57 870, 36 a side, consistent mass

FOLDER gets mesh.inp (nodes, elements C3D8, sets CLAMPED, PLATFORM, ARM, TIP), job.inp (for `ccx job`, which writes the
same matrices), blade.sti and blade.mas (lower triangle, row column value), blade.dof (NODE.DIRECTION a row). Units: kg, N,
m, s; needs NumPy. The contact face is curved: its normals differ from pair to pair."""
import os
import sys
import numpy as np

E, NU, RHO = 2.1e11, 0.3, 7850.0
#        cells along x: to the airfoil, across it, to the shank's end, to the contact, over it, to the arm's end; along y;
#        along z: shank, platform, airfoil; arm
SIZES = {"small": ((1, 2, 1, 3, 1, 5), 2, (8, 2, 12), 2), "large": ((4, 8, 4, 9, 5, 24), 5, (60, 8, 160), 16)}


def lines(ends, cells):
    """Coordinates from end to end, each stretch in equal cells; and where the ends stand among them."""
    parts = [np.linspace(a, b, n, endpoint=False) for a, b, n in zip(ends, ends[1:], cells)]
    return np.append(np.concatenate(parts), ends[-1]), np.cumsum([0, *cells])


def shape_of(p):
    """The straight blocks bent: platform and arm dip where they touch, the airfoil tapers and twists."""
    x, y, z = p.T
    dip = np.where(x > 0.015, 0.0015 * (1 - np.cos(2 * np.pi * (x - 0.015) / 0.045)), 0)
    s = np.clip((z - 0.051) / 0.084, 0, None)
    turn, u, v = 0.6 * s, (x - 0.009) * (1 - 0.4 * s), y - 0.015
    return np.stack([0.009 + u * np.cos(turn) - v * np.sin(turn), 0.015 + u * np.sin(turn) + v * np.cos(turn), z - dip], 1)


def mesh(size):
    """Nodes [n][3] and elements [m][8], both from 0, and sets of nodes."""
    along, across, up, thick = SIZES[size]
    x, ex = lines([0.003, 0.006, 0.012, 0.015, 0.024, 0.036, 0.060], along)
    y, _ = lines([0, 0.03], [across])
    z, ez = lines([0, 0.045, 0.051, 0.135], up)
    za, _ = lines([0.039, 0.045], [thick])
    blade = [(0, i, j, k) for k in range(ez[3]) for j in range(across) for i in range(ex[5])
             if (i < ex[3] if k < ez[1] else True if k < ez[2] else ex[1] <= i < ex[2])]
    arm = [(1, i, j, k) for k in range(thick) for j in range(across) for i in range(ex[4], ex[6])]
    corners = ((0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1))
    cells = [[(b, i + a, j + c, k + d) for a, c, d in corners] for b, i, j, k in blade + arm]
    nodes = {p: q for q, p in enumerate(sorted({p for c in cells for p in c}))}
    at = shape_of(np.array([(x[i], y[j], (za if b else z)[k]) for b, i, j, k in nodes]))
    touching = [p for p in nodes if ex[4] <= p[1] <= ex[5]]
    sets = {"CLAMPED": [p for p in nodes if (p[1] == ex[6] if p[0] else p[3] == 0)],
            "PLATFORM": [p for p in touching if p[0] == 0 and p[3] == ez[1]],
            "ARM": [p for p in touching if p[0] == 1 and p[3] == thick],
            "TIP": [(0, ex[1], 0, ez[3])]}
    return at, np.array([[nodes[p] for p in c] for c in cells]), {k: [nodes[p] for p in v] for k, v in sets.items()}


def element_matrices(x):
    """Stiffness [m][24][24] and mass [m][8][8] of bricks at x [m][8][3], 2 x 2 x 2 points of Gauss: CalculiX' C3D8."""
    signs = np.array([[-1, -1, -1], [1, -1, -1], [1, 1, -1], [-1, 1, -1], [-1, -1, 1], [1, -1, 1], [1, 1, 1], [-1, 1, 1]], float)
    D = np.zeros((6, 6))
    D[:3, :3] = NU
    D[range(3), range(3)] = 1 - NU
    D[range(3, 6), range(3, 6)] = (1 - 2 * NU) / 2
    D *= E / ((1 + NU) * (1 - 2 * NU))
    K, M = np.zeros((len(x), 24, 24)), np.zeros((len(x), 8, 8))
    for p in signs / np.sqrt(3):
        dN = np.stack([signs[:, a] / 8 * np.prod(np.delete(1 + signs * p, a, 1), axis=1) for a in range(3)])
        J = np.einsum("ac,mcd->mad", dN, x)
        det, grad = np.linalg.det(J), np.einsum("mda,ac->mdc", np.linalg.inv(J), dN)
        B = np.zeros((len(x), 6, 8, 3))
        for row, terms in enumerate((((0, 0),), ((1, 1),), ((2, 2),), ((0, 1), (1, 0)), ((1, 2), (2, 1)), ((2, 0), (0, 2)))):
            for along, of in terms:
                B[:, row, :, of] = grad[:, along]
        B = B.reshape(len(x), 6, 24)
        K += np.einsum("mia,ij,mjb,m->mab", B, D, B, det, optimize=True)
        N = np.prod(1 + signs * p, axis=1) / 8
        M += np.outer(N, N) * (RHO * det)[:, None, None]
    return K, M


def assemble(i, j, values, n):
    """Rows, columns and values of the lower triangle of n rows, from values at (i, j); -1: left out."""
    i, j = np.broadcast_arrays(i, j)
    kept = (j >= 0) & (i >= j)
    place, v = i[kept] * n + j[kept], values[kept]
    order = np.argsort(place, kind="stable")
    place, v = place[order], v[order]
    first = np.flatnonzero(np.diff(place, prepend=-1))
    return place[first] // n, place[first] % n, np.add.reduceat(v, first)


def matrices(at, elements, clamped, lumped):
    """K and M as lower triangles, and the node and direction (from 0) of each row."""
    rows = np.full((len(at), 3), -1)
    free = np.setdiff1d(np.arange(len(at)), clamped)
    rows[free] = np.arange(3 * len(free)).reshape(-1, 3)
    of = rows[elements].reshape(len(elements), 24)
    k, m = element_matrices(at[elements])
    if lumped:
        m = np.eye(8) * m.sum(axis=2)[:, :, None]
    i, j = np.nonzero(np.eye(8) if lumped else np.ones((8, 8)))  # the mass couples equal directions alone
    K = assemble(of[:, :, None], of[:, None, :], k, 3 * len(free))
    M = assemble(*(rows[elements[:, c]] for c in (i, j)), np.repeat(m[:, i, j, None], 3, 2), 3 * len(free))
    return K, M, [(q, d) for q in free for d in range(3)]


def write(path, text):
    with open(path, "w", encoding="ascii") as f:
        f.writelines(line + "\n" for line in text)


def numbers(ids):
    return [", ".join(str(q + 1) for q in ids[i:i + 16]) for i in range(0, len(ids), 16)]


def main(size, folder):
    at, elements, sets = mesh(size)
    K, M, dofs = matrices(at, elements, sets["CLAMPED"], size == "small")
    os.makedirs(folder, exist_ok=True)
    write(os.path.join(folder, "mesh.inp"),
          ["** made by make.py", "*NODE, NSET=ALL", *(f"{q + 1}, {x:.12g}, {y:.12g}, {z:.12g}" for q, (x, y, z) in enumerate(at)),
           "*ELEMENT, TYPE=C3D8, ELSET=STEEL", *(f"{e + 1}, " + ", ".join(str(q + 1) for q in c) for e, c in enumerate(elements)),
           *(line for name, ids in sets.items() for line in [f"*NSET, NSET={name}", *numbers(ids)])])
    write(os.path.join(folder, "job.inp"),
          ["*INCLUDE, INPUT=mesh.inp", "*MATERIAL, NAME=STEEL", "*ELASTIC", f"{E:g}, {NU:g}", "*DENSITY", f"{RHO:g}",
           "*SOLID SECTION, ELSET=STEEL, MATERIAL=STEEL", "*BOUNDARY", "CLAMPED, 1, 3", "*STEP",
           "*FREQUENCY, SOLVER=MATRIXSTORAGE", "10", "*END STEP"])
    for name, (i, j, v) in (("sti", K), ("mas", M)):
        write(os.path.join(folder, "blade." + name), (f"{a + 1} {b + 1} {c:.15g}" for a, b, c in zip(i.tolist(), j.tolist(), v.tolist())))
    write(os.path.join(folder, "blade.dof"), (f"{q + 1}.{d + 1}" for q, d in dofs))
    print(f"{len(dofs)} degrees of freedom, {len(elements)} elements, {len(sets['PLATFORM'])} contact nodes a side, tip: node "
          f"{sets['TIP'][0] + 1}")


if __name__ == "__main__":
    main(*sys.argv[1:])
