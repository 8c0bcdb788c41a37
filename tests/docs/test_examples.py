#!/usr/bin/env python3
"""What examples.py lets pass and what it does not: on pages written here, with /bin/echo for hbmcheck."""
import pathlib
import subprocess
import sys
import tempfile
import unittest

EXAMPLES = pathlib.Path(__file__).with_name("examples.py")


def status(page, name="docs/page.md"):
    """The exit code for this page."""
    with tempfile.TemporaryDirectory() as scratch:
        path = pathlib.Path(scratch, name)
        path.parent.mkdir(exist_ok=True)
        path.write_text(page)
        pathlib.Path(scratch, "cases").mkdir()
        command = [sys.executable, EXAMPLES, "/bin/echo", scratch, path]
        return subprocess.run(command, cwd=scratch, capture_output=True).returncode


def fenced(marker, body):
    return f"<!-- {marker} -->\n```text\n{body}\n```\n"


def printing(printed, said):
    return status(fenced("run", f"hbmcheck '{printed}'") + fenced("output", said))


class Output(unittest.TestCase):
    def test_as_printed(self):
        self.assertEqual(printing("omega  8.0  match", "omega 8.0 match"), 0)

    def test_word(self):
        self.assertEqual(printing("omega 8.0 match", "omega 8.0 differs"), 1)

    def test_last_digit_may_differ_by_one(self):
        self.assertEqual(printing("error 3.826e-04", "error 3.827e-04"), 0)
        self.assertEqual(printing("error 3.826e-04", "error 3.828e-04"), 1)
        self.assertEqual(printing("error 3.826e-04", "error 3.826e-05"), 1)

    def test_fewer_digits(self):
        self.assertEqual(printing("error 3.826229e-04", "error 3.83e-04"), 0)
        self.assertEqual(printing("error 3.826229e-04", "error 3.85e-04"), 1)
        self.assertEqual(printing("error 5.6", "error 5"), 1)

    def test_counts(self):
        self.assertEqual(printing("73 points", "74 points"), 1)

    def test_rounding(self):
        self.assertEqual(printing("6.6 2.7e-16", "6.6 0"), 0)
        self.assertEqual(printing("6.6 2.7e-11", "6.6 0"), 1)
        self.assertEqual(printing("6.6 2.7e-16", "6.6 0.5"), 1)

    def test_left_out(self):
        self.assertEqual(printing("a\nb 1\nc 2 3 4", "...\nc 2 ... 4"), 0)
        self.assertEqual(printing("a\nb 1\nc 2 3 4", "...\nc 2 ... 5"), 1)
        self.assertEqual(printing("a\nb", "a"), 1)
        self.assertEqual(printing("a", "a\nb"), 1)


class Pages(unittest.TestCase):
    def test_with_a_program(self):
        """Where there is none, neither run nor compared; the next run is."""
        self.assertEqual(status(fenced("run: with no-such-program", "exit 5") + fenced("output", "other")), 0)
        self.assertEqual(status(fenced("run: with sh", "exit 5")), 1)
        self.assertEqual(status(fenced("run: with sh", "echo a") + fenced("output", "other")), 1)
        left_out = fenced("run: with no-such-program", "exit 5") + fenced("output", "other")
        self.assertEqual(status(left_out + fenced("run", "echo a") + fenced("output", "other")), 1)
        self.assertEqual(status(left_out + fenced("run", "echo a") + fenced("output", "a")), 0)

    def test_exit_code(self):
        self.assertEqual(status(fenced("run", "false")), 1)
        self.assertEqual(status(fenced("run: exit 1", "false")), 0)
        self.assertEqual(status(fenced("run: exit 1", "true")), 1)

    def test_first_command_that_fails(self):
        self.assertEqual(status(fenced("run", "false\ntrue")), 1)

    def test_file(self):
        self.assertEqual(status(fenced("file: a.txt", "said") + fenced("run", "grep said a.txt")), 0)

    def test_page_without_example(self):
        self.assertEqual(status("# Page\n"), 1)
        self.assertEqual(status("# Page\n## Section\n" + fenced("run", "true")), 1)
        self.assertEqual(status("# Page\n", "README.md"), 0)

    def test_main_job(self):
        main_job = fenced("main-job", "false && build/release/hbmcheck compare")
        self.assertEqual(status(main_job + fenced("output", "compare"), "README.md"), 0)
        self.assertEqual(status(main_job + fenced("output", "compared"), "README.md"), 1)

    def test_job(self):
        job = fenced("job", "- run: false\n- run: a/build/release/hbmcheck gate")
        self.assertEqual(status(job + fenced("output", "gate"), "README.md"), 0)
        self.assertEqual(status(job + fenced("output", "compare"), "README.md"), 1)

    def test_marker_without_block(self):
        self.assertEqual(status("<!-- run -->\n\n```sh\ntrue\n```\n"), 1)


if __name__ == "__main__":
    unittest.main()
