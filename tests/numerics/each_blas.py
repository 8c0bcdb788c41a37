"""each_blas.py COMMAND CASE LIBRARIES: solutions of CASE with each BLAS in a folder of LIBRARIES are the same but for rounding.

Solutions end with a Newton step, so that they are exact to rounding times the condition of the Jacobian: 2.2e-16 times 1e6, far from the
turning points, which the frequencies below are. Skipped, exit 77, where there is one BLAS only."""
import csv
import io
import os
import subprocess
import sys

command, case, libraries = sys.argv[1:]
TOLERANCE = 2.2e-10
variants = {name: folders for name, folders in {
    "reference": ["blas", "lapack"], "openblas-serial": ["openblas-serial"], "openblas-pthread": ["openblas-pthread"]}.items()
    if all(os.path.isdir(os.path.join(libraries, folder)) for folder in folders)}
if len(variants) < 2:
    print("one BLAS only: " + ", ".join(variants))
    sys.exit(77)


def rows(folders):
    environment = dict(os.environ, LD_LIBRARY_PATH=":".join(os.path.join(libraries, folder) for folder in folders))
    done = subprocess.run([command, "frf", case, "--at", AT, "--format", "csv"], env=environment, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return list(csv.DictReader(line for line in io.StringIO(done.stdout) if not line.startswith("#")))


AT = "0.6,0.9,1.2,1.6"
results = {name: rows(folders) for name, folders in variants.items()}
first, *others = results
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
