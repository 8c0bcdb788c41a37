#!/usr/bin/env python3
"""examples.py HBMCHECK SOURCE PAGE... - the worked examples of pages, run as they stand, print what the pages say.

A marker on a line of its own says what the fenced block after it is:
    <!-- file: NAME -->         a file of that name
    <!-- run -->                commands for bash, which must succeed;  <!-- run: exit 1 -->  which must end with 1;
                                <!-- run: with PROGRAM -->  which are left out, with their output, where there is none
    <!-- output -->             what the commands before it print: standard output, then standard error
    <!-- main-job -->           README's (.ci/run builds and runs it): here what it runs as build/release/hbmcheck
    <!-- job -->                the same of a CI job
HBMCHECK is the `hbmcheck` of all of them. Each page has a scratch folder of its own below the current folder, with a
copy of SOURCE/cases. A page of SOURCE/docs must have a `run` before its first section.

Output is compared line by line, word by word; blank lines and the widths of columns do not count. A line `...` stands
for any number of lines, a word `...` for any words. A count must be the same, another number to one unit of the last
digit that the page has of it, so that a last digit that differs between machines fails nothing; two numbers that are
both below ROUNDING are what rounding left.

exit: 0 all as printed  1 not, with both sides shown  64 wrong usage"""
import os
import pathlib
import re
import shutil
import subprocess
import sys

ROUNDING = 1e-12  # thousands of roundings of 1.1e-16 each; no page prints a result so small that is not rounding
PATIENCE = 300    # seconds for one block, under sanitizers too
MARKER = re.compile(r"<!-- (file|run|output|main-job|job)(?:: (.*?))? -->$")
COUNT = re.compile(r"[-+]?\d+")
BUILT = re.compile(r"\S*build/release/(hbmcheck [^&\n]*)")
NUMBER = re.compile(r"(?<![A-Za-z_])[-+]?\d+(?:\.\d+)?(?:[eE][-+]?\d+)?")


class Wrong(Exception):
    pass


def blocks(text):
    """(line number, kind, argument, body) of every marked block."""
    lines = text.split("\n")
    for at, line in enumerate(lines):
        marked = MARKER.match(line)
        if not marked:
            continue
        if at + 1 == len(lines) or not lines[at + 1].startswith("```"):
            raise Wrong(f"line {at + 1}: no fenced block follows {line}")
        end = lines.index("```", at + 2)
        yield at + 1, marked[1], marked[2], "\n".join(lines[at + 2 : end]) + "\n"


def unit_of_last_digit(number):
    mantissa, _, exponent = number.lower().partition("e")
    decimals = len(mantissa.partition(".")[2])
    return 10.0 ** (int(exponent or 0) - decimals)


def same_number(said, found):
    if COUNT.fullmatch(said) and COUNT.fullmatch(found):
        return int(said) == int(found)
    if abs(float(said)) < ROUNDING and abs(float(found)) < ROUNDING:
        return True
    # .001: the difference of two decimal fractions is itself rounded
    return not COUNT.fullmatch(said) and abs(float(said) - float(found)) <= 1.001 * unit_of_last_digit(said)


def same_word(said, found):
    if said == found:
        return True
    if NUMBER.sub("#", said) != NUMBER.sub("#", found):
        return False
    return all(map(same_number, NUMBER.findall(said), NUMBER.findall(found)))


def matches(said, found, same):
    """Whether the list `found` is as `said`, in which an Ellipsis stands for any number of elements."""
    if not said:
        return not found
    if said[0] is Ellipsis:
        return any(matches(said[1:], found[k:], same) for k in range(len(found) + 1))
    return bool(found) and same(said[0], found[0]) and matches(said[1:], found[1:], same)


def words(line):
    return [Ellipsis if word == "..." else word for word in line.split()]


def same_line(said, found):
    return matches(words(said), found.split(), same_word)


def same_output(said, found):
    lines = [Ellipsis if line.strip() == "..." else line for line in said.split("\n") if line.strip()]
    return matches(lines, [line for line in found.split("\n") if line.strip()], same_line)


def run(commands, folder, status):
    done = subprocess.run(["bash", "-e", "-o", "pipefail", "-c", commands], cwd=folder, stdin=subprocess.DEVNULL,
                          text=True, capture_output=True, timeout=PATIENCE)
    printed = done.stdout + done.stderr
    if done.returncode != status:
        raise Wrong(f"exit {done.returncode}, {status} was expected\n{commands}{printed}")
    return printed


def check(page, folder, must_open):
    """Runs the examples of one page, which must open with one or need not; how many outputs were compared."""
    text = page.read_text()
    found, left_out, compared = None, False, 0
    for line, kind, argument, body in blocks(text):
        try:
            if kind == "file":
                (folder / argument).parent.mkdir(parents=True, exist_ok=True)
                (folder / argument).write_text(body)
            elif kind == "run" and argument and argument.startswith("with ") and not shutil.which(argument[5:]):
                print(f"{page.name}:{line}: left out, there is no {argument[5:]}")
                left_out = True
            elif kind == "run":
                expected = argument and re.fullmatch(r"exit (\d+)", argument)
                found, left_out = run(body, folder, int(expected[1]) if expected else 0), False
            elif kind in ("main-job", "job"):
                found, left_out = run("\n".join(BUILT.findall(body)), folder, 0), False
            elif not left_out:
                if found is None:
                    raise Wrong("output of nothing")
                if not same_output(body, found):
                    raise Wrong(f"the page says\n{body}but what is printed is\n{found}")
                compared += 1
        except Wrong as wrong:
            raise Wrong(f"line {line}: {wrong}") from None
    before_sections = re.split(r"^## ", text, flags=re.MULTILINE)[0]
    if must_open and not re.search(r"^<!-- run", before_sections, re.MULTILINE):
        raise Wrong("the page does not open with a worked example")
    return compared


def main(hbmcheck, source, *pages):
    os.environ.pop("COLUMNS", None)
    documentation = pathlib.Path(source, "docs").resolve()
    status = 0
    for page in map(pathlib.Path, pages):
        folder = pathlib.Path(page.stem).absolute()
        shutil.rmtree(folder, ignore_errors=True)
        shutil.copytree(pathlib.Path(source, "cases"), folder / "cases")
        (folder / "compare").symlink_to(pathlib.Path(source, "compare").resolve())
        (folder / "bin").mkdir()
        program = pathlib.Path(hbmcheck).absolute()
        (folder / "bin" / "hbmcheck").symlink_to(program)
        (folder / "bin" / "hbmcheck-proof").symlink_to(program.with_name("hbmcheck-proof"))
        search, os.environ["PATH"] = os.environ["PATH"], f"{folder / 'bin'}{os.pathsep}{os.environ['PATH']}"
        try:
            print(f"{page.name}: {check(page, folder, page.resolve().parent == documentation)} outputs as printed")
        except Wrong as wrong:
            print(f"{page}: {wrong}", file=sys.stderr)
            status = 1
        os.environ["PATH"] = search
    return status


if __name__ == "__main__":
    if len(sys.argv) < 4:
        print(__doc__, file=sys.stderr)
        sys.exit(64)
    sys.exit(main(*sys.argv[1:]))
