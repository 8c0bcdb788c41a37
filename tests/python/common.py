"""What the tests of interfaces/python/ share: the command's csv, and a scene or two. Exit 77 where NumPy is missing: a skip."""
import csv
import os
import pathlib
import subprocess
import sys
import unittest

try:
    import numpy as np
except ImportError:
    print("no NumPy here")
    sys.exit(77)

SOURCE = pathlib.Path(__file__).resolve().parents[2]
COMMAND = os.environ["HBMCHECK_COMMAND"]
CASE2 = str(SOURCE / "cases/paper/case2.yaml")
CHAIN = str(SOURCE / "cases/structures/chain3.yaml")
SPACE = str(SOURCE / "cases/structures/space.yaml")
sys.path.insert(0, os.environ.get("HBMCHECK_PACKAGE", str(SOURCE / "interfaces/python")))


def main():
    """Runs the tests of the script. Exit 77 where none failed and one was skipped, so that the test runner says so."""
    result = unittest.main(exit=False).result
    sys.exit(1 if not result.wasSuccessful() else 77 if result.skipped else 0)


def tables_of(text):
    return [part.splitlines() for part in text.strip("\n").split("\n\n")]


def table(*arguments, which=0):
    """Columns of the csv that the command prints; of several tables, one after another, the one of that number."""
    done = subprocess.run([COMMAND, *map(str, arguments), "--format", "csv", "--quiet"], capture_output=True, text=True)
    lines = [line for line in tables_of(done.stdout)[which] if not line.startswith("#")]
    if not lines:
        raise AssertionError(done.stderr)
    rows = list(csv.DictReader(lines))
    return {name: [row[name] for row in rows] for name in rows[0]}


class Test(unittest.TestCase):
    def same(self, found, said, what):
        """Numbers of the library and their decimals in csv: to the last digit; an empty field is NaN."""
        said = [float(s) if s else np.nan for s in said]
        self.assertEqual(len(found), len(said), what)
        np.testing.assert_array_equal(np.asarray(found, dtype=float), said, err_msg=what)

    def same_columns(self, found, said, names):
        for name in names:
            self.same(found[name], said[name], name)
