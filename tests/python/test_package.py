"""test_package.py - the package as a stranger gets it: a wheel without a build system or an index, the library found where it
may be, what is missing said in words; figures where matplotlib is."""
import base64
import hashlib
import importlib.util
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import zipfile

from common import CASE2, SOURCE, Test, main, np, unittest

import hbmcheck
from hbmcheck import _library

LIBRARY = os.environ["HBMCHECK_LIBRARY"]
CC = os.environ.get("CC", "cc")
PYTHON = SOURCE / "interfaces/python"
USE = f"import hbmcheck; print(hbmcheck.Model.from_yaml({CASE2!r}).frf(at=8).branch.tolist())"


def run(package, code=USE, **environment):
    """The code in a new interpreter with that folder's package."""
    kept = {k: v for k, v in os.environ.items() if k not in ("HBMCHECK_LIBRARY", "PYTHONPATH")}
    return subprocess.run([sys.executable, "-c", code], capture_output=True, text=True,
                          env={**kept, "PYTHONPATH": str(package), **environment})


def make_wheel():
    spec = importlib.util.spec_from_file_location("make_wheel", PYTHON / "make_wheel.py")
    backend = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(backend)
    return backend


class Package(Test):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.folder)

    def test_the_wheel_lists_what_it_holds(self):
        backend = make_wheel()
        with zipfile.ZipFile(self.folder / backend.build_wheel(self.folder)) as wheel:
            info = f"hbmcheck-{hbmcheck.__version__}.dist-info"
            listed = dict(line.split(",", 1) for line in wheel.read(f"{info}/RECORD").decode().splitlines())
            self.assertEqual(sorted(listed), sorted(wheel.namelist()))
            for name, said in listed.items():
                digest = base64.urlsafe_b64encode(hashlib.sha256(wheel.read(name)).digest()).rstrip(b"=").decode()
                if not name.endswith("RECORD"):
                    self.assertEqual(said, f"sha256={digest},{wheel.getinfo(name).file_size}")
            self.assertIn("hbmcheck/py.typed", listed)
            wheel.extractall(self.folder / "there")
        self.assertIn(f"hbmcheck-{hbmcheck.__version__}/make_wheel.py", self.source_names(backend))
        found = run(self.folder / "there", HBMCHECK_LIBRARY=LIBRARY)
        self.assertEqual(found.stdout, "[0, 1, 2]\n", found.stderr)

    def source_names(self, backend):
        shutil.unpack_archive(self.folder / backend.build_sdist(self.folder), self.folder / "sdist")
        return [str(p.relative_to(self.folder / "sdist")) for p in (self.folder / "sdist").rglob("*")]

    def test_pip_needs_no_index(self):
        if subprocess.run([sys.executable, "-m", "pip", "--version"], capture_output=True).returncode:
            self.skipTest("no pip here")
        there = self.folder / "there"
        done = subprocess.run([sys.executable, "-m", "pip", "install", "--no-index", "--no-deps", "--target", there, PYTHON],
                              capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        found = run(there, HBMCHECK_LIBRARY=LIBRARY)
        self.assertEqual(found.stdout, "[0, 1, 2]\n", found.stderr)

    def test_where_the_library_may_be(self):
        shutil.copytree(PYTHON / "hbmcheck", self.folder / "hbmcheck", ignore=shutil.ignore_patterns("__pycache__"))
        by_loader = run(self.folder, LD_LIBRARY_PATH=os.path.dirname(LIBRARY))
        self.assertEqual(by_loader.stdout, "[0, 1, 2]\n", by_loader.stderr)
        shutil.copy(LIBRARY, self.folder / "hbmcheck" / _library.SONAME)
        beside = run(self.folder, LD_LIBRARY_PATH="")
        self.assertEqual(beside.stdout, "[0, 1, 2]\n", beside.stderr)
        told = run(self.folder, HBMCHECK_LIBRARY="/no/such/library")
        self.assertIn("ImportError: the library of hbmcheck is not found (/no/such/library", told.stderr)
        other = run(self.folder, HBMCHECK_LIBRARY="libm.so.6")
        self.assertIn("ImportError: libm.so.6 has no hbmcheck_version", other.stderr)

    def test_what_pip_is_told_before_the_wheel(self):
        """The Debian package installs it, so that pip knows of hbmcheck there."""
        name = make_wheel().prepare_metadata_for_build_wheel(self.folder)
        self.assertEqual(name, f"hbmcheck-{hbmcheck.__version__}.dist-info")
        self.assertIn(f"Name: hbmcheck\nVersion: {hbmcheck.__version__}\n", (self.folder / name / "METADATA").read_text())

    @unittest.skipUnless(shutil.which(CC), "no C compiler here")
    def test_openblas_is_asked_for_one_thread(self):
        """When the library is loaded, whatever the environment says; by a BLAS that only notes what it is told."""
        source, blas = self.folder / "blas.c", self.folder / "blas.so"
        source.write_text("int told = 0; void openblas_set_num_threads(int n) { told = n; }\n")
        subprocess.run([CC, "-shared", "-fPIC", source, "-o", blas], check=True)
        code = "import ctypes; told = ctypes.c_int.in_dll(ctypes.CDLL(None), 'told'); print(told.value); import hbmcheck; print(told.value)"
        found = run(PYTHON, code, LD_PRELOAD=str(blas), HBMCHECK_LIBRARY=LIBRARY)
        self.assertEqual(found.stdout, "0\n1\n", found.stderr)


@unittest.skipUnless(importlib.util.find_spec("matplotlib"), "no matplotlib here")
class Figures(Test):
    def test_each_result_draws_itself(self):
        import matplotlib

        matplotlib.use("Agg")
        model = hbmcheck.Model.from_yaml(CASE2)
        curve = model.frf()
        axes = curve.plot()
        drawn = np.hstack([line.get_ydata() for line in axes.get_lines()])
        self.assertEqual(set(drawn[np.isfinite(drawn)]), set(curve.amplitude))
        self.assertEqual(len(axes.get_lines()), 2)  # stable and unstable
        axes = model.compare([6, 8]).plot()
        self.assertEqual(len(axes.get_lines()[0].get_xdata()), 4)
        axes = model.transient([6, 8]).plot()
        self.assertEqual(sorted(w for line in axes.get_lines() for w in line.get_xdata()), [6, 8, 8, 8])
        three = model.verify([3.5, 4, 4.5], [1, 2, 3])
        self.assertIs(three.plot(axes), axes)
        self.assertEqual(axes.get_title(), three.cause)


if __name__ == "__main__":
    main()
