"""test_abi.py - interfaces/library/abi.py sees what breaks programs built against the library, and what does not: the header changed in a
copy, libraries of nothing but names."""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

LIBRARY = pathlib.Path(__file__).resolve().parents[2] / "interfaces/library"
CC = os.environ.get("CC", "cc").split()


class Changes(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.folder)
        for name in ("abi.py", "abi.txt", "hbmcheck.h"):
            shutil.copy(LIBRARY / name, self.folder)
        self.record = (self.folder / "abi.txt").read_text()
        self.soname = re.search(r"^soname = (.*)$", self.record, re.MULTILINE)[1]
        self.functions = re.findall(r"^function (\w+):", self.record, re.MULTILINE)
        self.assertGreater(len(self.functions), 15)

    def change(self, said, other):
        header = self.folder / "hbmcheck.h"
        text = header.read_text()
        self.assertEqual(text.count(said), 1, said)
        header.write_text(text.replace(said, other))

    def stub(self, functions, soname=None):
        """A shared library of these names."""
        source, library = self.folder / "names.c", self.folder / "library.so"
        source.write_text("".join(f"void {name}(void);\nvoid {name}(void) {{}}\n" for name in functions))
        subprocess.run([*CC, "-shared", "-fPIC", f"-Wl,-soname,{soname or self.soname}", source, "-o", library], check=True)
        return library

    def abi(self, *options, functions=None, soname=None):
        library = self.stub(functions or self.functions, soname)
        return subprocess.run([sys.executable, self.folder / "abi.py", *options, library], capture_output=True, text=True)

    def breaks(self, *lines, **library):
        """Said with those lines; not to be written down under the same soname, but under another."""
        found = self.abi(**library)
        self.assertEqual(found.returncode, 1, found.stdout + found.stderr)
        for line in lines:
            self.assertIn(line + "\n", found.stdout)
        self.assertIn("raise hbmcheck_soname", found.stdout)
        refused = self.abi("--write", **library)
        self.assertEqual((refused.returncode, (self.folder / "abi.txt").read_text()), (1, self.record))
        raised = dict(library, soname="libhbmcheck.so.99")
        self.assertEqual(self.abi("--write", **raised).returncode, 0)
        self.assertEqual(self.abi(**raised).returncode, 0)

    def test_as_it_is(self):
        found = self.abi()
        self.assertEqual(found.returncode, 0, found.stdout + found.stderr)

    def test_a_removed_symbol(self):
        gone = "hbmcheck_table_rows"
        self.breaks(f"- function {gone}: int (const hbmcheck_table *)", functions=[f for f in self.functions if f != gone])

    def test_a_changed_argument_type(self):
        self.change("const char *hbmcheck_result_remark(const hbmcheck_result *r, int i);",
                    "const char *hbmcheck_result_remark(const hbmcheck_result *r, long i);")
        self.breaks("- function hbmcheck_result_remark: const char * (const hbmcheck_result *, int)",
                    "+ function hbmcheck_result_remark: const char * (const hbmcheck_result *, long)")

    def test_a_field_in_the_middle(self):
        self.change("  hbmcheck_kind kind;\n", "  hbmcheck_kind kind;\n  const char *symbol;\n")
        self.breaks("- field hbmcheck_column name const char * 16", "+ field hbmcheck_column name const char * 24",
                    "+ field hbmcheck_column symbol const char * 16")

    def test_a_field_of_another_type(self):
        self.change("  size_t size; /* sizeof(hbmcheck_monitor)", "  int size; /* sizeof(hbmcheck_monitor)")
        self.breaks("- field hbmcheck_monitor size size_t 0", "+ field hbmcheck_monitor size int 0")

    def test_constants_that_moved(self):
        self.change("  HBMCHECK_TEXT,\n", "  HBMCHECK_FIRST,\n  HBMCHECK_TEXT,\n")
        self.breaks("- constant hbmcheck_kind HBMCHECK_TEXT 0", "+ constant hbmcheck_kind HBMCHECK_TEXT 1")

    def test_another_soname_alone(self):
        found = self.abi(soname="libhbmcheck.so.99")
        self.assertEqual(found.returncode, 1)
        self.assertIn(f"soname {self.soname} in abi.txt, libhbmcheck.so.99 in the library", found.stdout)

    def test_a_new_function_is_no_break(self):
        """It is to be put down, with the version it came with; the others keep theirs."""
        self.change('#define HBMCHECK_VERSION       "1.0.0"', '#define HBMCHECK_VERSION       "1.1.0"')
        self.change("void hbmcheck_case_free(hbmcheck_case *c);", "void hbmcheck_case_free(hbmcheck_case *c);\nint hbmcheck_new(int a);")
        functions = [*self.functions, "hbmcheck_new"]
        found = self.abi(functions=functions)
        self.assertEqual(found.returncode, 1)
        self.assertIn("+ function hbmcheck_new: int (int)\n", found.stdout)
        self.assertIn("Programs built before keep working", found.stdout)
        self.assertEqual(self.abi("--write", functions=functions).returncode, 0)
        record = (self.folder / "abi.txt").read_text()
        self.assertIn("function hbmcheck_new: int (int) = 1.1.0\n", record)
        self.assertEqual(sorted(set(record.splitlines()) - set(self.record.splitlines())), ["function hbmcheck_new: int (int) = 1.1.0"])

    def test_names_of_arguments_are_no_part(self):
        self.change("const char *hbmcheck_result_remark(const hbmcheck_result *r, int i);",
                    "const char *hbmcheck_result_remark(const hbmcheck_result *of, int line);")
        self.assertEqual(self.abi().returncode, 0)

    def test_what_is_not_understood_is_said(self):
        self.change("void hbmcheck_case_free(hbmcheck_case *c);", "void hbmcheck_case_free(hbmcheck_case *c);\nextern int hbmcheck_global;")
        found = self.abi()
        self.assertEqual(found.returncode, 2)
        self.assertIn("hbmcheck.h: not understood: extern int hbmcheck_global", found.stderr)


if __name__ == "__main__":
    if not shutil.which(CC[0]):
        print("no C compiler here")
        sys.exit(77)
    unittest.main()
