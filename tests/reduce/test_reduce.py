"""`reduce` and what comes of it, against the whole structure solved densely: python3 test_reduce.py HBMCHECK"""
import csv
import io
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

try:
    import numpy as np
except ImportError:
    print("no NumPy")
    sys.exit(77)

from box import Box

PROGRAM = os.path.abspath(sys.argv[1])
RATIO = 0.005  # of damping
HEAD = """title: a box
structure: {{mass: b.mas, stiffness: b.sti, nodes: b.dof, damping: {damping}}}
forcing: [{{node: {tip}, direction: z, amplitude: {force}}}]   # the tip
response: [{{node: {tip}, direction: z}}]
contacts:
  - {{pairs: pairs.csv, axes: {{normal: [0, 0, -1], tangent: [1, 0, 0]}}, tangential_stiffness: {kt}, normal_stiffness: {kn}, friction: 0.3, preload: 30}}
sweep: {{frequency: {sweep}}}
hbm: {{harmonics: 3}}
"""


def run(*words, expect=0):
    r = subprocess.run([PROGRAM, *map(str, words)], capture_output=True, text=True)
    assert expect is None or r.returncode == expect, f"{words}: exit {r.returncode}, expected {expect}\n{r.stdout}{r.stderr}"
    return r


def rows(text):
    return list(csv.DictReader(io.StringIO("".join(l for l in text.splitlines(True) if not l.startswith("#")))))


def modes(case, column, *more):
    text = run("modes", case, "--format", "json", "-q", *more).stdout
    table = json.loads(text)
    table = table.get("Modes", table.get("rows")) if isinstance(table, dict) else table
    return np.array([r[column] if r[column] is not None else 0 for r in table], float)


def write(folder, box, damping="{modal: 0.005}", ends=None, sweep="[500, 1500]", force=300, kt=2e6, kn=2.5e6):
    folder.mkdir(parents=True, exist_ok=True)
    box.write(str(folder / "b"))
    nx, ny, nz = box.cells
    ends = ends or [(nx // 2, 0, 0), (nx // 2, ny, 0)]
    (folder / "pairs.csv").write_text("node_a,node_b\n" + "".join(f"{box.node(*e)},ground\n" for e in ends))
    case = folder / "case.yaml"
    case.write_text(HEAD.format(tip=box.node(nx, ny, nz), damping=damping, sweep=sweep, force=force, kt=kt, kn=kn))
    return case


def stated(case):
    return float(re.search(r"reduction: \{error: ([^,]*),", case.read_text()).group(1))


def reduce(case, name="out", *more, expect=0):
    run("reduce", case, "-o", case.parent / name, *more, expect=expect)
    return case.parent / name / case.name


def near(a, b, bound, what):
    a, b = np.asarray(a, float), np.asarray(b, float)
    off = np.max(np.abs(a - b))
    assert off <= bound, f"{what}: {off} > {bound}"


# ---- the tests: each gets a folder ----


def test_all_modes_are_exact(folder):
    """Kept whole, the model is the structure in other coordinates: rounding of the largest eigenvalue, n eps, is all there is."""
    box = Box(3, 1, 1)
    case = write(folder, box)
    small = reduce(case, "out", "--modes", 1500)
    for column in ("omega_open", "omega_stuck"):
        whole, ours = modes(case, column), modes(small, column)
        assert len(whole) == len(ours) == box.n
        near(ours**2, whole**2, 100 * box.n * 2.2e-16 * whole[-1] ** 2, column)
    assert stated(small) == 0


def test_written_matrices(folder):
    """Matrices written in the case serve like those of files: kept whole, three masses have the modes they had."""
    folder.mkdir(exist_ok=True)
    case = pathlib.Path(shutil.copy(pathlib.Path(__file__).parents[2] / "cases/structures/chain3.yaml", folder))
    small = reduce(case)
    for column in ("omega_open", "omega_stuck"):
        whole, ours = modes(case, column), modes(small, column)
        near(ours**2, whole**2, 300 * 2.2e-16 * whole[-1] ** 2, column)


def test_frequencies(folder):
    """A relative error e of the receptance at a resonance is a shift of 2 d_omega/omega over twice the damping ratio; 3: several modes answer there."""
    case = write(folder, Box(12, 4, 2))
    small = reduce(case)
    error = stated(small)
    assert 0 < error <= 1e-3
    for column in ("omega_open", "omega_stuck"):
        whole, ours = modes(case, column, "--count", 2), modes(small, column, "--count", 2)
        assert np.all(ours >= whole * (1 - 1e-12)), "Ritz values lie above"
        near(ours / whole, 1, 3 * RATIO * 1e-3, column)
    fine = reduce(case, "fine", "--error", "1e-6")
    near(modes(fine, "omega_open", "--count", 2) / modes(case, "omega_open", "--count", 2), 1, 3 * RATIO * 1e-6 + 1e-11, "finer")


def test_floating_and_lumped(folder):
    """A body that its contacts alone hold: by its corners; by one corner it is refused."""
    box = Box(8, 3, 2, free=True, lumped=True)
    corners = [(0, 0, 0), (8, 0, 0), (8, 3, 0), (0, 3, 0)]
    case = write(folder, box, ends=corners, sweep="[3000, 9000]")
    text = case.read_text()
    case.write_text(text.replace("tangent: [1, 0, 0]", "tangent: [1, 0, 0], tangent_2: [0, 1, 0]"))
    small = reduce(case)
    whole, ours = modes(case, "omega_stuck", "--count", 9), modes(small, "omega_stuck", "--count", 9)
    near(ours[:6] / whole[:6], 1, 1e-5, "held by contacts")
    (folder / "pairs.csv").write_text(f"node_a,node_b\n{box.node(*corners[0])},ground\n")
    # one corner leaves three turns that nothing holds, inside and as a whole
    error = run("reduce", case, "-o", folder / "free", expect=2).stderr
    assert re.search(r"case\.yaml:2:\d+: structure\.stiffness does not hold a motion", error), error
    assert not (folder / "free").exists() and not (folder / "free.part").exists()


def test_rows_without_mass_or_anything(folder):
    """A row of zeros changes nothing; one of stiffness without mass is condensed statically, as by hand."""
    box = Box(6, 2, 1)
    n = box.n
    case = write(folder, box)
    plain = reduce(case, "plain").parent
    end = box.row_of[3 * (box.node(6, 2, 1) - 1)]  # a spring at the tip, in series with the massless row, to ground
    k1, k2 = 3e5, 5e5
    lines = [f"{end + 1} {end + 1} {dict(((r, c), v) for r, c, v in zip(*box.K))[(end, end)] + k1:.15e}", f"{n + 1} {end + 1} {-k1}", f"{n + 1} {n + 1} {k1 + k2}", f"{n + 2} {n + 2} 0"]
    stiff = [l for l in (folder / "b.sti").read_text().splitlines() if l.split()[:2] != [str(end + 1)] * 2]
    (folder / "b.sti").write_text("\n".join(stiff + lines) + "\n")
    with open(folder / "b.mas", "a") as f:
        f.write(f"{n + 1} {n + 1} 0\n{n + 2} {n + 2} 0\n")
    with open(folder / "b.dof", "a") as f:
        f.write("9001.1\n9002.1\n")
    ours = modes(reduce(case, "massless", "--error", "1e-6"), "omega_open", "--count", 2)
    K, M = box.dense(box.K), box.dense(box.M)
    K[end, end] += k1 * k2 / (k1 + k2)
    L = np.linalg.inv(np.linalg.cholesky(M))
    near(ours**2 / np.linalg.eigvalsh(L @ K @ L.T)[:2], 1, 1e-6, "massless")
    assert plain.exists()


def test_triangles(folder):
    """One triangle, the other, or both: the same bytes; and twice the same."""
    box = Box(5, 2, 1)
    case = write(folder, box)
    reduce(case, "a")
    reduce(case, "a2")
    for ending in ("sti", "mas"):
        entries = [l.split() for l in (folder / f"b.{ending}").read_text().splitlines()]
        (folder / f"b.{ending}").write_text("\n".join(f"{c} {r} {v}" for r, c, v in entries) + "\n")
    reduce(case, "b")
    for ending in ("sti", "mas"):
        entries = [l.split() for l in (folder / f"b.{ending}").read_text().splitlines()]
        (folder / f"b.{ending}").write_text("\n".join(f"{r} {c} {v}" for r, c, v in entries + [[c, r, v] for r, c, v in entries if r != c]) + "\n")
    reduce(case, "c")
    for f in ("case.yaml", "mass.mtx", "stiffness.mtx", "nodes.csv", "pairs.csv"):
        first = (folder / "a" / f).read_bytes()
        assert all((folder / other / f).read_bytes() == first for other in ("a2", "b", "c")), f
    assert sorted(p.name for p in (folder / "a").iterdir()) == ["case.yaml", "mass.mtx", "nodes.csv", "pairs.csv", "stiffness.mtx"]
    shutil.move(folder / "a", folder / "elsewhere")
    assert len(modes(folder / "elsewhere" / "case.yaml", "omega_open")) > 7
    reduce(case, "b", "--modes", 3)  # over one of its own
    (folder / "b" / "mine.txt").write_text("keep me")
    assert "exists" in run("reduce", case, "-o", folder / "b", expect=3).stderr
    assert (folder / "b" / "mine.txt").read_text() == "keep me" and not (folder / "b.part").exists()


def test_text_is_kept(folder):
    """All but the structure, numbers of DOFs and files: byte for byte; names, comments and characters of several bytes."""
    folder.mkdir()
    n = 30
    spring = [f"{i + 1} {i + 1} 2.1" for i in range(n)] + [f"{i + 2} {i + 1} -1" for i in range(n - 1)]
    (folder / "k.txt").write_text("\n".join(spring) + "\n")
    (folder / "m.txt").write_text("\n".join(f"{i + 1} {i + 1} 1" for i in range(n)) + "\n")
    before = "# \u00e4\u20ac\ntitle: \u00fc\ncontacts: [{tangential_stiffness: 2, friction: 0.3, preload: 1, tangent: {17: 1, 21: -1}}]\nstructure:   # \u00df\n"
    after = "   # behind\nforcing: [{dof: 30, amplitude: 1}]  # \u00e9\nresponse: [30, {17: 1}]\nsweep: {omega: [0.2, 0.9]}\n"
    (folder / "case.yaml").write_text(before + "  mass: m.txt\n  stiffness: k.txt\n  damping: {rayleigh: [0.01, 0.002]}" + after)
    small = reduce(folder / "case.yaml")
    text = small.read_text()
    assert text.startswith(before.replace("17: 1, 21: -1", "1: 1, 2: -1") + "  {mass: mass.mtx, stiffness: stiffness.mtx, damping: {rayleigh: [0.01, 0.002]}, reduction: "), text
    assert text.endswith(after.replace("dof: 30", "dof: 3").replace("[30, {17: 1}]", "[3, {1: 1}]")), text
    whole, ours = (rows(run("frf", c, "--at", "0.4,0.7", "--format", "csv", "-q").stdout) for c in (folder / "case.yaml", small))
    assert [r["response"] for r in whole] == ["30", "17"] * 2 and [r["response"] for r in ours] == ["3", "1"] * 2
    for a, b in zip(whole, ours):
        near(float(b["amplitude"]) / float(a["amplitude"]), 1, 3 * stated(small) + 1e-9, "amplitude")


def observed(case, small, at):
    """Largest relative error of an amplitude at these frequencies."""
    most = 0
    both = [rows(run("frf", c, "--at", at, "--format", "csv", "-q").stdout) for c in (case, small)]
    assert len(both[0]) == len(both[1])
    for a, b in zip(*both):
        most = max(most, abs(float(b["amplitude"]) / float(a["amplitude"]) - 1))
    return most


def test_stated_error(folder):
    """Five structures, few modes: the stated error is at least a third of the observed one, and not 30 times as large."""
    box = Box(6, 2, 1)
    damped = {"modal": "{modal: 0.005}", "rayleigh": "{rayleigh: [10, 2e-7]}", "matrix": "c.txt", "few": "{modal: 0.02}"}
    found = []
    for name, damping in damped.items():
        sub = folder / name
        case = write(sub, box, damping, sweep="[600, 1700]")
        if name == "matrix":  # dashpots to ground everywhere, and a share of K
            r, c, v = box.K
            lines = [f"{i + 1} {j + 1} {2e-7 * x + (0.3 if i == j else 0):.15e}" for i, j, x in zip(r, c, v)]
            (sub / "c.txt").write_text("\n".join(lines) + "\n")
        small = reduce(case, "out", "--modes", 1 if name == "few" else 4)
        at = "650,900,1000,1220,1300,1650"
        found.append((name, stated(small), observed(case, small, at)))
    free = Box(4, 2, 1, free=True, lumped=True)
    case = write(folder / "free", free, "{rayleigh: [60, 1e-7]}", ends=[(0, 0, 0), (4, 0, 0), (4, 2, 0)], sweep="[600, 1500]", force=0.5)
    case.write_text(case.read_text().replace("tangent: [1, 0, 0]", "tangent: [1, 0, 0], tangent_2: [0, 1, 0]"))
    small = reduce(case, "out", "--modes", 3)
    found.append(("free", stated(small), observed(case, small, "700,900,1000,1300")))
    for name, said, seen in found:
        print(f"       {name}: stated {said:.2e}, observed {seen:.2e}")
    for name, said, seen in found:
        assert seen / 3 <= said <= 30 * seen, f"{name}: stated {said}, observed {seen}"


def refuse(case, words, *more):
    error = run("reduce", case, "-o", case.parent / "no", *more, expect=2).stderr
    assert re.search(words, error), f"{error} is not {words}"
    assert not (case.parent / "no").exists() and not (case.parent / "no.part").exists()


def test_mistakes(folder):
    box = Box(3, 1, 1)
    case = write(folder, box)
    good = (folder / "b.sti").read_text()
    lines = good.splitlines()
    (folder / "b.sti").write_text("\n".join(lines[:-1]) + "\n" + lines[-1].split()[0] + " ")
    refuse(case, rf"b\.sti:{len(lines)}:1: ")
    both = [l.split() for l in lines] + [l.split()[1::-1] + l.split()[2:] for l in lines if l.split()[0] != l.split()[1]]
    wrong = next(k for k in range(len(lines)) if both[k][0] != both[k][1] and abs(float(both[k][2])) > 1)
    both[wrong][2] = "17"
    (folder / "b.sti").write_text("\n".join(" ".join(w) for w in both) + "\n")
    refuse(case, r"b\.sti:\d+:1: structure\.stiffness is not symmetric")
    (folder / "b.sti").write_text(good)
    text = case.read_text()
    case.write_text(text.replace(f"node: {box.node(3, 1, 1)}, direction: z, amp", "node: 77777, direction: z, amp"))
    refuse(case, r"case\.yaml:3:18: no DOF of node 77777")
    case.write_text(text)
    dofs = (folder / "b.dof").read_text()
    (folder / "b.dof").write_text(dofs.rsplit("\n", 2)[0] + "\n")
    refuse(case, r"b\.dof:\d+:1: the file ends after \d+ lines, expected \d+")
    (folder / "b.dof").write_text(dofs)
    run("reduce", case, expect=64)
    run("reduce", case, "-o", folder / "no", "--set", "hbm.harmonics=5", expect=64)
    (folder / "plain.yaml").write_text("oscillator: {mass: 1, damping: 1, stiffness: 1}\nforcing: {amplitude: 1}\nsweep: {omega: [1, 2]}\n")
    refuse(folder / "plain.yaml", "an oscillator, expected `structure`")


def test_large(folder):
    """2500 rows: refused where they would be dense, with what to do; `modes` has the lowest, here sqrt of known eigenvalues."""
    folder.mkdir()
    n = 2500
    (folder / "k.txt").write_text("\n".join([f"{i + 1} {i + 1} 2" for i in range(n)] + [f"{i + 2} {i + 1} -1" for i in range(n - 1)]) + "\n")
    (folder / "m.txt").write_text("\n".join(f"{i + 1} {i + 1} 1" for i in range(n)) + "\n")
    case = folder / "case.yaml"
    case.write_text("structure: {mass: m.txt, stiffness: k.txt, damping: {rayleigh: [0.01, 0]}}\nforcing: [{dof: 2500, amplitude: 1}]\ncontacts: [{normal: 2500, normal_stiffness: 1, preload: 1}]\nsweep: {omega: [0.2, 0.9]}\n")
    for command in ("frf", "transient", "compare"):
        error = run(command, case, expect=2).stderr
        assert re.search(r"case\.yaml:1:19: structure\.mass has 2500 rows, .* about 4 GB, expected at most 2000: `hbmcheck reduce", error), error
    k = np.arange(1, 6)
    near(modes(case, "omega_open", "--count", 5), 2 * np.sin(np.pi * k / 2 / (n + 1)), 1e-11, "chain")
    near(modes(case, "damping_open", "--count", 5) * 2 * modes(case, "omega_open", "--count", 5), 0.01, 1e-8, "damping")
    # a spring of 1 at the free end of n masses: its last mass is held as by n + 1 of them
    K = np.diag(np.full(n, 2.0)) + np.diag(np.full(n - 1, -1.0), 1) + np.diag(np.full(n - 1, -1.0), -1)
    K[-1, -1] += 1
    near(modes(case, "omega_stuck", "--count", 5), np.sqrt(np.linalg.eigvalsh(K)[:5]), 1e-9, "stuck")
    # nothing holds it: a motion at omega = 0 to the root of rounding, the others 2 sin(pi k/2/n)
    lines = (folder / "k.txt").read_text().split("\n")
    lines[0], lines[n - 1] = "1 1 1", f"{n} {n} 1"
    (folder / "k.txt").write_text("\n".join(lines))
    near(modes(case, "omega_open", "--count", 4), 2 * np.sin(np.pi * np.arange(4) / 2 / n), 1e-7, "free chain")


def test_from_reduction(folder):
    """compare moves the amplitude by the stated error: of a linear structure off its resonances by about as much, and the column says nothing without one."""
    case = write(folder, Box(4, 2, 1), sweep="[300, 600]")
    small = reduce(case, "out", "--modes", 6)
    linear = run("compare", small, "--at", "400", "--set", "contacts=[]", "--format", "csv", "-q").stdout
    near(float(rows(linear)[0]["from_reduction"]) / stated(small), 1, 1e-3, "linear: x = H p")
    assert rows(run("compare", case, "--at", "400", "--set", "contacts=[]", "--format", "csv", "-q").stdout)[0]["from_reduction"] == ""
    # nonlinear: a receptance larger by 1 + e everywhere is that of matrices smaller by it; e is small beside 1, and 2 % is what e^2 and Newton leave
    e = 1e-4
    text = "structure: {{mass: [{m}, {m}], stiffness: [[{a}, {b}], [{b}, {c}]], damping: {{rayleigh: [0.5, 1e-5]}}{more}}}\nforcing: [{{dof: 1, amplitude: 20}}]\ncontacts: [{{tangential_stiffness: 200, friction: 0.3, preload: 20, tangent: 2}}]\nsweep: {{omega: [2, 30]}}\nhbm: {{harmonics: 9}}\n"
    amplitude = []
    for k in (1, 1 / (1 + e)):
        (folder / "two.yaml").write_text(text.format(m=k, a=680 * k, b=-400 * k, c=440 * k, more=f", reduction: {{error: {e}, at: 1}}"))
        row = rows(run("compare", folder / "two.yaml", "--at", "12", "--format", "csv", "-q", expect=None).stdout)[0]
        amplitude.append(float(row["hbm_amplitude"]))
    moved, said = abs(amplitude[1] / amplitude[0] - 1), float(row["from_reduction"])
    assert moved <= 1.02 * said and said <= 2 * moved, f"moved {moved}, said {said}"
    said = run("compare", small, "--at", "400", "--set", "contacts=[]", "-q").stdout
    assert "a reduced model: the error of" in said, said


if __name__ == "__main__":
    failed = 0
    chosen = sys.argv[2:]
    for name, test in list(globals().items()):
        if not name.startswith("test_") or (chosen and name not in chosen):
            continue
        with tempfile.TemporaryDirectory() as top:
            try:
                test(pathlib.Path(top) / "t")
                print("ok    ", name)
            except Exception as e:
                failed += 1
                print("FAILED", name, "-", type(e).__name__, e)
    sys.exit(failed > 0)
