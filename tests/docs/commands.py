#!/usr/bin/env python3
"""commands.py HBMCHECK PAGE... - a page's list of commands is the one that `hbmcheck --help` prints.

The list is the table or bullet list of the page in which most rows begin with `hbmcheck NAME` or `NAME`: a row may name
several, each in backquotes. Every command must stand in it, once, and nothing else; the order is the page's own.

exit: 0 all pages do  1 one does not, and what is missing or too much  64 wrong usage"""
import re
import subprocess
import sys

BLOCK = re.compile(r"(?:^[ \t]*(?:\||[-*] ).*\n)+", re.MULTILINE)
CODE = re.compile(r"`(?:hbmcheck )?([a-z]+)\b[^`]*`")


def commands_of(help_text):
    return re.findall(r"^  ([a-z]+)  ", help_text, re.MULTILINE)


def first_cell(row):
    cell = row.strip().strip("|").split("|")[0]
    return re.split(r": | - | – ", cell)[0] if not row.strip().startswith("|") else cell


def names_in(block):
    return [name for row in block.splitlines() for name in CODE.findall(first_cell(row))]


def list_of(page, commands):
    lists = [names_in(block) for block in BLOCK.findall(page)]
    return max(lists, key=lambda names: len(set(names) & set(commands)), default=[])


def faults(page, commands):
    listed = list_of(page, commands)
    yield from (f"{name} is missing" for name in commands if name not in listed)
    yield from (f"{name} is no command" for name in listed if name not in commands)
    yield from (f"{name} stands there twice" for name in sorted(set(listed)) if listed.count(name) > 1)


def main(arguments):
    if len(arguments) < 2:
        print(__doc__, file=sys.stderr)
        return 64
    answer = subprocess.run([arguments[0], "--help"], capture_output=True, text=True, check=True)
    commands = commands_of(answer.stdout)
    wrong = [f"{path}: {fault}" for path in arguments[1:] for fault in faults(open(path).read() + "\n", commands)]
    if not commands:
        wrong.append("hbmcheck --help lists no commands")
    print("\n".join(wrong))
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
