"""each_blas.py COMMAND CASE LIBRARIES: solutions of CASE with each BLAS in a folder of LIBRARIES are the same but for rounding, and none keeps
threads that idle.

Solutions end with a Newton step, so that they are exact to rounding times the condition of the Jacobian: 2.2e-16 times 1e6, far from the
turning points, which the frequencies below are. Skipped, exit 77, where there is one BLAS only."""
import csv
import io
import os
import subprocess
import sys
import tempfile

command, case, libraries = sys.argv[1:]
TOLERANCE = 2.2e-10
variants = {name: folders for name, folders in {
    "reference": ["blas", "lapack"], "openblas-serial": ["openblas-serial"], "openblas-pthread": ["openblas-pthread"]}.items()
    if all(os.path.isdir(os.path.join(libraries, folder)) for folder in folders)}
if len(variants) < 2:
    print("one BLAS only: " + ", ".join(variants))
    sys.exit(77)


def with_blas(folders):
    return dict(os.environ, LD_LIBRARY_PATH=":".join(os.path.join(libraries, folder) for folder in folders))


def threads(folders):
    """Those of a process that waits for its case file, a pipe: opened here, it has opened its end and so has begun."""
    with tempfile.TemporaryDirectory() as own:
        pipe = os.path.join(own, "case.yaml")
        os.mkfifo(pipe)
        waits = subprocess.Popen([command, "modes", pipe], env=with_blas(folders), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        with open(pipe, "w", encoding="ascii"):
            n = len(os.listdir(f"/proc/{waits.pid}/task"))
        waits.wait()
    return n


def rows(folders):
    environment = with_blas(folders)
    done = subprocess.run([command, "frf", case, "--at", AT, "--format", "csv"], env=environment, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return list(csv.DictReader(line for line in io.StringIO(done.stdout) if not line.startswith("#")))


AT = "0.6,0.9,1.2,1.6"
results = {name: rows(folders) for name, folders in variants.items()}
first, *others = results
if os.path.isdir("/proc/self/task"):  # a chroot may be without
    counts = {name: threads(folders) for name, folders in variants.items()}
    assert len(set(counts.values())) == 1, f"threads: {counts}"
assert results[first]
for name in others:
    assert len(results[name]) == len(results[first]), name
    for row, expected in zip(results[name], results[first]):
        for column, value in expected.items():
            if column in ("iterations", "residual"):
                continue  # of the way there, and rounding itself
            try:
                off = abs(float(row[column]) - float(value))
            except ValueError:
                assert row[column] == value, f"{name}: {column} {row[column]}, with {first} {value}"
                continue
            assert off <= TOLERANCE * max(1, abs(float(value))) or row[column] == value, f"{name}: {column} {row[column]}, with {first} {value}"
print(", ".join(variants))
