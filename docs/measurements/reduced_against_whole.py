"""What `reduce` costs: amplitudes and the peak of five reduced structures of 1000 to 2000 degrees of freedom against the same solved whole.
    python3 docs/measurements/reduced_against_whole.py HBMCHECK [CASE...]      (NumPy; ten minutes to half an hour of one core)
Prints a row a case: the stated error, the largest relative error of the amplitude at nine frequencies, and that of the peak (height, frequency)."""
import csv
import io
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests" / "reduce"))
from box import Box  # noqa: E402

HEAD = """structure: {{mass: b.mas, stiffness: b.sti, nodes: b.dof, damping: {damping}}}
forcing: [{{node: {tip}, direction: z, amplitude: {force}}}]
response: [{{node: {tip}, direction: z}}]
contacts:
  - {{pairs: pairs.csv, axes: {{normal: [0, 0, -1], tangent: [1, 0, 0]}}, tangential_stiffness: 2e6, normal_stiffness: 2.5e6, friction: 0.3, preload: 30}}
sweep: {{frequency: {sweep}}}
hbm: {{harmonics: 3}}
"""
OF_BOXES = {  # cells, free?, lumped?, damping, corners in contact (fractions of the length, y), force, sweep
    "clamped, proportional": ((17, 4, 3), False, False, "{rayleigh: [10, 2e-7]}", [(0.5, 0), (0.5, 1)], 300, (500, 1500)),
    "clamped, lumped masses": ((17, 4, 3), False, True, "{rayleigh: [20, 1e-7]}", [(0.5, 0), (0.5, 1)], 200, (500, 1500)),
    "clamped, modal damping": ((17, 4, 3), False, False, "{modal: 0.03}", [(0.3, 0), (0.3, 1)], 300, (400, 1200)),
    "held by its contacts": ((16, 4, 3), True, True, "{rayleigh: [60, 1e-7]}", [(0, 0), (0, 1), (1, 0.5)], 0.2, (600, 1500)),
}


def run(program, *words):
    return subprocess.run([program, *map(str, words)], capture_output=True, text=True, check=True, env=dict(os.environ, OPENBLAS_NUM_THREADS="1")).stdout


def amplitudes(program, case, at):
    lines = run(program, "frf", case, "--at", ",".join(f"{f:.9g}" for f in at), "--format", "csv", "-q").splitlines(True)
    rows = list(csv.DictReader(io.StringIO("".join(l for l in lines if not l.startswith("#")))))
    return np.array([max(float(r["amplitude"]) for r in rows if abs(float(r["frequency"]) / f - 1) < 1e-6) for f in at])


def peak(program, case, near):
    """By a parabola through five points, of which the middle one is `near`."""
    at = near * (1 + np.array([-2, -1, 0, 1, 2]) * 5e-4)
    a, b, c = np.polyfit((at - near) / near, amplitudes(program, case, at), 2)
    return c - b * b / 4 / a, near * (1 - b / 2 / a)


def make(name, folder):
    if name == "blade with a platform":
        shutil.copytree(ROOT / "cases" / "meshes", folder)
        case = folder / "blade.yaml"
        case.write_text(case.read_text().replace("{modal: 0.002}", "{rayleigh: [10, 4e-8]}"))
        return case, 1044, (720, 850)
    cells, free, lumped, damping, corners, force, sweep = OF_BOXES[name]
    box, case = Box(*cells, free=free, lumped=lumped), folder / "case.yaml"
    folder.mkdir()
    box.write(str(folder / "b"))
    nodes = [box.node(round(x * cells[0]), round(y * cells[1]), 0) for x, y in corners]
    (folder / "pairs.csv").write_text("node_a,node_b\n" + "".join(f"{n},ground\n" for n in nodes))
    case.write_text(HEAD.format(damping=damping, tip=box.node(*cells), force=force, sweep=list(sweep)))
    return case, box.n, sweep


def main():
    program, chosen = os.path.abspath(sys.argv[1]), sys.argv[2:]
    print("case | rows | kept | stated | amplitude | peak | its frequency")
    for name in [*OF_BOXES, "blade with a platform"]:
        if chosen and name not in chosen:
            continue
        with tempfile.TemporaryDirectory() as top:
            case, n, sweep = make(name, pathlib.Path(top) / "whole")
            run(program, "reduce", case, "-o", case.parent.parent / "small", "-q")
            small = case.parent.parent / "small" / case.name
            stated = float(re.search(r"reduction: \{error: ([^,]*),", small.read_text()).group(1))
            kept = int((small.parent / "mass.mtx").read_text().split("\n")[1].split()[0])
            scan = np.linspace(*sweep, 101)[1:-1]
            near = scan[np.argmax(amplitudes(program, small, scan))]
            _, near = peak(program, small, near)
            at = np.linspace(*sweep, 11)[1:-1]
            off = np.max(np.abs(amplitudes(program, small, at) / amplitudes(program, case, at) - 1))
            ours, whole = peak(program, small, near), peak(program, case, near)
            print(f"{name} | {n} | {kept} | {stated:.2e} | {off:.2e} | {abs(ours[0] / whole[0] - 1):.2e} | {abs(ours[1] / whole[1] - 1):.2e}", flush=True)


if __name__ == "__main__":
    main()
