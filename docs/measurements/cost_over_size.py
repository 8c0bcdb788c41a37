#!/usr/bin/env python3
"""What one steady state costs over the number of coordinates and of contacts, on standard output; needs NumPy.

    docs/measurements/cost_over_size.py HBMCHECK [coordinates[=N,...]] [pairs] [COMMAND...]     all where none is named

The two plates of cases/structures/plates/ with a finer mesh, in the first modes of the whole with all contacts stuck:
12 pairs in 20 to 2000 modes, 4 to 120 pairs in 60 modes. COMMAND: `frf` (H = 3, with stability), `closed_form` and
`cvode`, `transient` with the exact law in closed form and with the regularised law by CVODE, which begin with the same
harmonic balance. Each is run at 138 Hz, and at 138 and 138.01 Hz: the difference is one steady state, and what is left
of the first run is what comes once, mostly eigenvectors of the structure and reading its matrices. Processor time of one
process (BLAS kept to one thread), one run an entry. The exponent of a column is the slope of a straight line through the
logarithms of all its entries."""
import os
import subprocess
import sys
import tempfile

import numpy as np

CASES = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "cases", "structures")
sys.path.insert(0, os.path.join(CASES, "plates"))
sys.path.insert(0, CASES)
import make  # noqa: E402
from solid_elements import write_matrix  # noqa: E402

TANGENTIAL, NORMAL, PRESS = 2.0e10, 2.5e10, 100.0  # as plates.yaml
COMMANDS = {"frf": ["frf"],
            "closed_form": ["transient", "--set", "transient.law=exact", "--set", "transient.method=closed_form"],
            "cvode": ["transient", "--set", "transient.law=regularised"]}


def plates(n_x, n_y):
    """K, M of both plates; (area, gap, rows x, y, z) of each pair; the rows of the load at the tip: y, z."""
    patch = np.linspace(*make.PATCH, n_x)
    parts, tip = [], None
    for (length, thick), side, level in ((make.UPPER, 0, 0), (make.LOWER, 1, 1)):
        K, M, nodes, first, last = make.plate(length, thick, n_y, patch)
        parts.append((K, M, [nodes[first + i, j, level] for i in range(n_x) for j in range(n_y + 1)]))
        tip = nodes[last, n_y, 1] if side == 0 else tip
    sizes = [len(part[0]) for part in parts]
    K, M = np.zeros((sum(sizes),) * 2), np.zeros((sum(sizes),) * 2)
    for (k, m, _), at in zip(parts, (0, sizes[0])):
        K[at:at + len(k), at:at + len(k)], M[at:at + len(k), at:at + len(k)] = k, m
    pairs = []
    for p, (upper, lower) in enumerate(zip(parts[0][2], parts[1][2])):
        i, j = divmod(p, n_y + 1)
        area = (make.PATCH[1] - make.PATCH[0]) * make.WIDTH / ((n_x - 1) * n_y) * (0.5 if i in (0, n_x - 1) else 1) * \
            (0.5 if j in (0, n_y) else 1)
        rows = np.zeros((3, len(K)))
        for d in range(3):
            rows[d, 3 * upper + d], rows[d, sizes[0] + 3 * lower + d] = -1, 1
        pairs.append((area, -make.CROWN * (2 * i / (n_x - 1) - 1) ** 2, rows))
    return K, M, pairs, (3 * tip + 1, 3 * tip + 2)


def in_modes(K, M, pairs):
    """All frequencies^2 and modes with every contact stuck, of mass 1."""
    stuck = K.copy()
    for area, _, rows in pairs:
        stuck += rows.T @ (np.array([TANGENTIAL, TANGENTIAL, NORMAL]) * area * rows.T).T
    L = np.linalg.cholesky(M)
    scaled = np.linalg.solve(L, np.linalg.solve(L, stuck).T)
    return np.linalg.solve(L.T, np.linalg.eigh((scaled + scaled.T) / 2)[1])


def mapping(row):
    return "{" + ", ".join(f"{i + 1}: {v:.12g}" for i, v in enumerate(row) if v) + "}"


def write_case(folder, K, pairs, tip, modes):
    name = os.path.join(folder, f"{len(pairs)}_{modes.shape[1]}")
    reduced = modes.T @ K @ modes
    write_matrix(name + "_K.mtx", (reduced + reduced.T) / 2)
    write_matrix(name + "_M.mtx", np.eye(len(reduced)))
    area = sum(pair[0] for pair in pairs)
    press = sum(PRESS * pair[0] / area * pair[2][2] for pair in pairs) @ modes
    lines = [f"structure: {{mass: {name}_M.mtx, stiffness: {name}_K.mtx, damping: {{modal: 0.003}}}}", "forcing:",
             f"  - {{amplitude: 0.8, direction: {mapping(modes[tip[1]])}}}",
             f"  - {{amplitude: 10, phase_deg: -90, direction: {mapping(modes[tip[0]])}}}",
             f"  - {{harmonic: 0, amplitude: 1, direction: {mapping(press)}}}", "contacts:"]
    for area, gap, rows in pairs:
        x, y, z = (mapping(row @ modes) for row in rows)
        lines.append(f"  - {{tangential_stiffness: {TANGENTIAL * area:.9g}, normal_stiffness: {NORMAL * area:.9g}, friction: 0.3, "
                     f"gap: {gap:.6g}, tangent: {x}, tangent_2: {y}, normal: {z}}}")
    lines += [f"response: [{mapping(modes[tip[1]])}]", "sweep: {frequency: [134, 142]}", "hbm: {harmonics: 3}"]
    with open(name + ".yaml", "w") as out:
        out.write("\n".join(lines) + "\n")
    return name + ".yaml"


def took(program, case, arguments, at):
    """[s] of processor time; NaN where the command fails."""
    environment = dict(os.environ, OPENBLAS_NUM_THREADS="1", OMP_NUM_THREADS="1")
    command = [program, arguments[0], case, *arguments[1:], "--at", at, "--quiet"]
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, env=environment)
    _, status, used = os.wait4(process.pid, 0)
    return used.ru_utime + used.ru_stime if os.waitstatus_to_exitcode(status) == 0 else np.nan


def table(program, what, cases, commands):
    """`cases`: (size, path) of a case each."""
    print(f"| {what} | " + " | ".join(f"{name}: once [s] | one steady state [s]" for name in commands) + " |")
    print("|---" * (2 * len(commands) + 1) + "|", flush=True)
    times = []
    for size, path in cases:
        row = [size]
        for name in commands:
            first, both = (took(program, path, COMMANDS[name], at) for at in ("138", "138,138.01"))
            row += [2 * first - both, both - first]
        times.append(row)
        print(f"| {size} | " + " | ".join("-" if np.isnan(run) else f"{run:.2f}" for run in row[1:]) + " |", flush=True)
    logs = np.log(np.maximum(np.array(times), 1e-2))
    slopes = [np.polyfit(logs[there, 0], logs[there, k], 1)[0] if there.sum() > 1 else np.nan
              for k in range(1, logs.shape[1]) for there in [np.isfinite(logs[:, k])]]
    print("| exponent | " + " | ".join(f"{slope:.2f}" for slope in slopes) + " |\n", flush=True)


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    tables = [word for word in sys.argv[2:] if word not in COMMANDS] or ["coordinates", "pairs"]
    commands = [word for word in sys.argv[2:] if word in COMMANDS] or list(COMMANDS)
    with tempfile.TemporaryDirectory() as folder:
        for word in tables:
            name, _, sizes = word.partition("=")
            if name == "coordinates":
                make.STEP = 0.002
                K, M, pairs, tip = plates(4, 2)
                modes = in_modes(K, M, pairs)
                table(sys.argv[1], "coordinates, 12 pairs",
                      ((n, write_case(folder, K, pairs, tip, modes[:, :n]))
                       for n in map(int, (sizes or "20,80,320,640,1280,2000").split(","))), commands)
            else:
                make.STEP = 0.01

                def case(n_x, n_y):
                    K, M, pairs, tip = plates(n_x, n_y)
                    return len(pairs), write_case(folder, K, pairs, tip, in_modes(K, M, pairs)[:, :60])
                table(sys.argv[1], "pairs, 60 coordinates",
                      (case(*mesh) for mesh in ((2, 1), (4, 2), (4, 8), (8, 14))), commands)


if __name__ == "__main__":
    main()
