#!/usr/bin/env python3
"""From a mesh to a verified curve: cases/meshes/blade.yaml through modes, frf, compare and verify.

    mesh.py HBMCHECK ROOT

make.py writes the files that are stored. The whole model (1044 degrees of freedom) gives its natural frequencies; for the
curve `reduce` makes it small. Pairs come
from the sets of the mesh in both, and are the same."""
import csv
import os
import shutil
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
HBMCHECK, ROOT = sys.argv[1:3]
MESHES = os.path.join(ROOT, "cases", "meshes")
try:
    import numpy as np
except ImportError:
    print("NumPy is not there")
    sys.exit(77)
sys.path[:0] = [MESHES, os.path.join(ROOT, "cases", "structures")]
import make
import solid_elements


def run(*words, code=0):
    p = subprocess.run([HBMCHECK, *words], capture_output=True, text=True, check=False)
    assert p.returncode == code, f"{words} gave {p.returncode}: {p.stdout[-400:]} {p.stderr[-400:]}"
    return p


def rows(*words, code=0):
    text = run(*words, "--format", "csv", code=code).stdout
    return list(csv.DictReader(line for line in text.splitlines() if line and line[0] != "#"))


def triangle(path, n):
    i, j, v = np.loadtxt(path).T
    A = np.zeros((n, n))
    A[i.astype(int) - 1, j.astype(int) - 1] = v
    return A + np.tril(A, -1).T


def stored_is_made(folder):
    """To the rounding of sums of element matrices, in any BLAS."""
    make.main("small", folder)
    for name in os.listdir(folder):
        a, b = (open(os.path.join(f, name), encoding="ascii").read() for f in (folder, os.path.join(MESHES, "blade")))
        if not name.endswith((".sti", ".mas")):
            assert a == b, name
            continue
        p, q = (np.array(text.split(), float).reshape(-1, 3) for text in (a, b))
        assert (p[:, :2] == q[:, :2]).all() and abs(p - q).max() <= 1e-13 * abs(q).max(), name


def whole_frequencies():
    """Natural frequencies of the whole mesh, by NumPy."""
    with open(os.path.join(MESHES, "blade", "blade.dof"), encoding="ascii") as f:
        n = len(f.read().split())
    return solid_elements.frequencies(*(triangle(os.path.join(MESHES, "blade", "blade" + end), n) for end in (".sti", ".mas")))


def main(folder):
    whole = os.path.join(MESHES, "blade.yaml")
    stored_is_made(os.path.join(folder, "made"))
    run("reduce", whole, "-o", os.path.join(folder, "reduced"))
    case, frequencies = os.path.join(folder, "reduced", "blade.yaml"), whole_frequencies()

    said = run("describe", "--case", whole, "contacts")
    assert "6 pairs between PLATFORM and ARM, up to 0 apart" in said.stderr and "normals and areas from the faces of PLATFORM" in said.stderr
    assert run("describe", "--case", whole, "contacts", "--quiet").stderr == ""
    of_whole, of_reduced = ({r["field"]: r["value"] for r in rows("describe", "--case", c, "contacts")} for c in (whole, case))
    stiffness = [f"contacts[{j}].normal_stiffness" for j in range(6)]
    assert all(of_whole[f] == of_reduced[f] for f in stiffness)
    area = sum(float(of_whole[f]) for f in stiffness) / 5e10
    assert f"area {area:.6g} in all" in said.stderr

    # A mesh in two files is one in the folder, so that it is found from anywhere.
    parted = os.path.join(folder, "parted")
    shutil.copytree(MESHES, parted)
    with open(os.path.join(parted, "blade", "mesh.inp"), encoding="ascii") as f:
        lines = f.readlines()
    half = next(k for k in range(len(lines) // 2, len(lines)) if lines[k].startswith("*"))
    for name, part in (("mesh.inp", [*lines[:half], "*Include, Input=rest.inc\n"]), ("rest.inc", lines[half:])):
        with open(os.path.join(parted, "blade", name), "w", encoding="ascii") as f:
            f.write("".join(part).rstrip("\n") if name == "rest.inc" else "".join(part))
    run("reduce", os.path.join(parted, "blade.yaml"), "-o", os.path.join(folder, "of_parts"))
    for name in ("mesh.inp", "stiffness.mtx", "blade.yaml"):
        with open(os.path.join(folder, "reduced", name), "rb") as a, open(os.path.join(folder, "of_parts", name), "rb") as b:
            assert a.read() == b.read(), name

    # Fixed-interface modes raise frequencies; the first ones by less than 0.5 %.
    for r, f in zip(rows("modes", case), frequencies[:3]):
        assert f * (1 - 1e-6) <= float(r["frequency_open"]) <= f * 1.005, (r, f)

    # Responses are named by node in every command, and asked for so.
    curve = os.path.join(folder, "curve.csv")
    run("frf", case, "--format", "csv", "--output", curve)
    points = rows("frf", case, "--at", "745", "--response", "56 x")
    assert [r["response"] for r in points] == ["56 x"]
    both = rows("compare", case, "--at", "745")
    assert [(r["response"], r["verdict"]) for r in both] == [("56 x", "match")]
    assert both[0]["hbm_amplitude"] == points[0]["amplitude"]
    slippery = rows("frf", case, "--at", "745", "--set", "contacts[plat].friction=0.1")
    assert float(slippery[0]["amplitude"]) != float(points[0]["amplitude"])
    with open(curve, encoding="ascii") as f:
        lines = [line for line in f if line[0] != "#"]
    few = os.path.join(folder, "few.csv")
    solid_elements.write(few, [lines[0].strip()] + [line.strip() for line in lines[1:] if float(line.split(",")[1]) > 745][:3])
    verified = rows("verify", case, "--against", few, "--quantity", "amplitude")
    assert verified and all(r["verdict"] == "match" for r in verified), verified


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as own:
        main(own)
