"""test_structs.py - the structs of the package are those of hbmcheck.h: a C program tells sizes and offsets, and the order of
what the package takes for granted."""
import ctypes
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

from common import SOURCE, Test, main

import hbmcheck
from hbmcheck import _library, _structs, library_version

HEADER = (SOURCE / "interfaces/library/hbmcheck.h").read_text()
CC = os.environ.get("CC") or shutil.which("cc")
STRUCTS = {name: kind for name, kind in vars(_structs).items()
           if isinstance(kind, type) and issubclass(kind, ctypes.Structure) and kind is not ctypes.Structure}


def by_the_compiler(expressions):
    program = "#include <stdio.h>\n#include <hbmcheck.h>\nint main(void) {\n"
    program += "".join(f'printf("%zu\\n", (size_t)({e}));\n' for e in expressions) + "return 0; }\n"
    with tempfile.TemporaryDirectory() as folder:
        source, probe = pathlib.Path(folder, "probe.c"), pathlib.Path(folder, "probe")
        source.write_text(program)
        subprocess.run([CC, "-I", str(SOURCE / "interfaces/library"), str(source), "-o", str(probe)], check=True)
        return list(map(int, subprocess.run([probe], capture_output=True, text=True, check=True).stdout.split()))


class Structs(Test):
    def test_sizes_and_offsets(self):
        asked = {}
        for name, kind in STRUCTS.items():
            c = "struct hbmcheck" + re.sub("[A-Z]", lambda letter: "_" + letter[0].lower(), name)
            asked[f"sizeof({c})"] = ctypes.sizeof(kind)
            for field, _ in kind._fields_:
                asked[f"offsetof({c}, {field})"] = getattr(kind, field).offset
                asked[f"sizeof((({c} *)0)->{field})"] = getattr(kind, field).size
        self.assertGreater(len(asked), 15)
        self.assertEqual(dict(zip(asked, by_the_compiler(asked))), asked)

    def test_codes(self):
        names = "OK BAD_INPUT NO_MEMORY INTERRUPTED".split()
        self.assertEqual(by_the_compiler([f"HBMCHECK_{n}" for n in names]), [getattr(_library, n) for n in names])
        kinds = "TEXT INTEGER REAL SERIES".split()
        self.assertEqual(by_the_compiler([f"HBMCHECK_{k}" for k in kinds]), [getattr(_structs, k) for k in kinds])

    def test_functions_take_what_the_header_says(self):
        """As many arguments as there."""
        plain = re.sub(r"/\*.*?\*/", "", HEADER, flags=re.DOTALL)
        for name, (_, *arguments) in _library._FUNCTIONS.items():
            said = re.search(rf"\bhbmcheck_{name}\(([^)]*)\)", plain)
            self.assertIsNotNone(said, name)
            self.assertEqual(len(arguments), 0 if said[1] == "void" else said[1].count(",") + 1, name)

    def test_versions(self):
        said = re.search(r'HBMCHECK_VERSION +"(.*)"', HEADER)[1]
        project = (SOURCE / "interfaces/python/pyproject.toml").read_text()
        self.assertEqual(hbmcheck.__version__, said)
        self.assertEqual(library_version(), said)
        self.assertIn(f'version = "{said}"', project)
        self.assertIn(f"soname = {_library.SONAME}\n", (SOURCE / "interfaces/library/abi.txt").read_text())


if __name__ == "__main__":
    if not CC:
        print("no C compiler here")
        sys.exit(77)
    main()
