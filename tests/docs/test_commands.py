#!/usr/bin/env python3
"""test_commands.py - commands.py finds what is missing from a page's list, what is too much, and what stands twice."""
import unittest

from commands import commands_of, faults

HELP = """usage: hbmcheck COMMAND [OPTION...] CASE

  frf        the curve
  gate       the gate

hbmcheck COMMAND --help tells more. Start with: hbmcheck frf case.yaml
"""
TABLE = "| command | does |\n|---|---|\n| `hbmcheck frf CASE` | the curve |\n| `gate` | the `gate` |\n"


class Commands(unittest.TestCase):
    def faults(self, page):
        return list(faults(page, commands_of(HELP)))

    def test_help(self):
        self.assertEqual(commands_of(HELP), ["frf", "gate"])

    def test_complete(self):
        self.assertEqual(self.faults("# A page\n\n" + TABLE), [])
        self.assertEqual(self.faults("- `hbmcheck frf`, `gate`: as in `describe`\n"), [])

    def test_another_list(self):
        self.assertEqual(self.faults("- `frf` alone\n\nand\n\n" + TABLE), [])

    def test_missing(self):
        self.assertEqual(self.faults(TABLE.replace("`gate` | the", "the | ")), ["gate is missing"])
        self.assertEqual(self.faults("no list at all\n"), ["frf is missing", "gate is missing"])

    def test_too_much(self):
        self.assertEqual(self.faults(TABLE + "| `hbmcheck fry CASE` | |\n"), ["fry is no command"])
        self.assertEqual(self.faults(TABLE + "| `hbmcheck frf` | |\n"), ["frf stands there twice"])


if __name__ == "__main__":
    unittest.main()
