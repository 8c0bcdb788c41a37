#!/usr/bin/env python3
"""abi.py [--write [--unreleased]] LIBRARY - the binary interface of the shared library, held against abi.txt beside this file.

abi.txt has a line for everything that a program built against the library relies on: the soname; every function, with its types and
the version it came with; every enumeration constant with its value; every struct with its size, its fields with type and offset
[bytes] where long and pointers have 64 bits. Declarations are hbmcheck.h's, values are the C compiler's (CC, or cc), soname and
symbols are LIBRARY's.

    check     what differs from abi.txt is shown, with what to do
    --write   write abi.txt. Something removed or changed is refused under the same soname; with --unreleased it is taken: no
              version of this soname is out yet

exit: 0 as it stands there  1 not  2 the header is not understood  64 wrong usage  77 no C compiler, or not 64 bits"""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
HEADER, RECORD = HERE / "hbmcheck.h", HERE / "abi.txt"
FUNCTION = re.compile(r"(?P<result>[\w ]+[ *])(?P<name>hbmcheck_\w+) ?\((?P<arguments>.*)\)")
MEMBER = re.compile(r"(?P<type>(?:const |struct |unsigned )*\w+) (?P<names>.*)")
CALLBACK = re.compile(r"(?P<result>.*)\(\*(?P<name>\w+)\) ?\((?P<arguments>.*)\)")


class Unknown(Exception):
    pass


def statements(text):
    """Its declarations one by one, in one line each; braces stay whole."""
    text = re.sub(r"/\*.*?\*/", " ", text, flags=re.DOTALL)
    text = re.sub(r"^ *#(?:.*\\\n)*.*$", "", text, flags=re.MULTILINE)
    text = " ".join(re.sub(r'extern "C" \{', "", text).split())
    depth, start = 0, 0
    for at, letter in enumerate(text):
        depth += (letter == "{") - (letter == "}")
        if letter == ";" and depth == 0:
            yield text[start:at].strip()
            start = at + 1


def argument_type(said):
    """Of "const double *u": "const double *". Names are no part of the interface; each argument has one."""
    found = re.fullmatch(r"(.*[ *])\w+(\[\])?", said.strip())
    if not found and said.strip() != "void":
        raise Unknown(f"argument without a name: {said}")
    return (found[1].strip() + (" *" if found[2] else "")) if found else "void"


def fields(body):
    """(name, type) of a struct's members: "double a, *b; int (*f)(int)"."""
    for member in filter(None, (m.strip() for m in body.split(";"))):
        callback = CALLBACK.fullmatch(member)
        if callback:
            arguments = ", ".join(map(argument_type, callback["arguments"].split(",")))
            yield callback["name"], f"{callback['result'].strip()} (*)({arguments})"
            continue
        found = MEMBER.fullmatch(member)
        if not found:
            raise Unknown(f"member {member}")
        for name in found["names"].split(","):
            stars = name.count("*")
            yield name.replace("*", "").strip(), found["type"] + (" " + "*" * stars if stars else "")


def declared(text):
    """{fact without its numbers: C expressions of those numbers}, as {"field hbmcheck_column name const char *": ["offsetof(...)"]}."""
    found = {}
    for statement in statements(text):
        block = re.fullmatch(r"(?:typedef )?(enum|struct)(?: (\w+))? ?\{(.*)\}(?: (\w+))?", statement)
        opaque = re.fullmatch(r"typedef struct (\w+) \1", statement)
        function = FUNCTION.fullmatch(statement)
        if block and block[1] == "enum":
            for constant in filter(None, block[3].split(",")):
                name = constant.split("=")[0].strip()
                found[f"constant {block[2] or 'int'} {name}"] = [name]
        elif block:
            found[f"struct {block[2]}"] = [f"sizeof(struct {block[2]})"]
            for name, kind in fields(block[3]):
                found[f"field {block[2]} {name} {kind}"] = [f"offsetof(struct {block[2]}, {name})"]
        elif opaque:
            found[f"handle {opaque[1]}"] = []
        elif function:
            arguments = ", ".join(map(argument_type, function["arguments"].split(",")))
            found[f"function {function['name']}: {function['result'].strip()} ({arguments})"] = []
        elif statement:
            raise Unknown(statement)
    return found


def compiled(expressions):
    """Their values, by the C compiler."""
    program = "#include <stdio.h>\n#include <hbmcheck.h>\nint main(void) {\n"
    program += "".join(f'printf("%ld\\n", (long)({e}));\n' for e in expressions) + "return 0; }\n"
    with tempfile.TemporaryDirectory() as folder:
        source, probe = pathlib.Path(folder, "probe.c"), pathlib.Path(folder, "probe")
        source.write_text(program)
        subprocess.run([*os.environ.get("CC", "cc").split(), "-I", HEADER.parent, source, "-o", probe], check=True)
        return subprocess.run([probe], capture_output=True, text=True, check=True).stdout.split()


def facts(library):
    """What is so now: {fact: its numbers in words}."""
    said = declared(HEADER.read_text())
    values = iter(compiled([e for expressions in said.values() for e in expressions]))
    found = {fact: " ".join(next(values) for _ in expressions) for fact, expressions in said.items()}
    dynamic = subprocess.run(["readelf", "-d", library], capture_output=True, text=True, check=True).stdout
    found = {"soname": re.search(r"SONAME.*\[(.*)\]", dynamic)[1], **found}
    symbols = subprocess.run(["nm", "-D", "--defined-only", library], capture_output=True, text=True, check=True).stdout
    exported = {re.sub("@.*", "", line.split()[-1]) for line in symbols.splitlines()}
    for fact in list(found):
        name = re.match(r"function (\w+):", fact)
        if name and name[1] not in exported:  # declared, not there: for a program it is gone
            del found[fact]
    return found


def version():
    return re.search(r'^#define HBMCHECK_VERSION +"(.*)"', HEADER.read_text(), re.MULTILINE)[1]


def recorded():
    """The same as abi.txt has it, and {function's fact: the version it came with}."""
    said, since = {}, {}
    for line in RECORD.read_text().splitlines() if RECORD.exists() else []:
        if line.startswith("#"):
            continue
        fact, _, numbers = line.partition(" = ")
        if fact.startswith("function"):
            since[fact], numbers = numbers, ""
        said[fact] = numbers
    return said, since


def written(found, since):
    head = f"# {RECORD.name}: the binary interface; {pathlib.Path(__file__).name} holds the library against it and writes it.\n"
    numbers = {fact: since.get(fact, version()) if fact.startswith("function") else n for fact, n in found.items()}
    return head + "".join(f"{fact} = {n}\n" if n else f"{fact}\n" for fact, n in numbers.items())


def difference(said, found):
    """Lines that are there no longer or otherwise, lines that are new."""
    gone = [f"- {fact} {n}".rstrip() for fact, n in said.items() if fact != "soname" and found.get(fact) != n]
    new = [f"+ {fact} {n}".rstrip() for fact, n in found.items() if fact != "soname" and said.get(fact) != n]
    return gone, new


def main(*arguments):
    options, names = [a for a in arguments if a.startswith("--")], [a for a in arguments if not a.startswith("--")]
    if len(names) != 1 or not {*options} <= {"--write", "--unreleased"}:
        print(__doc__, file=sys.stderr)
        return 64
    if not shutil.which(os.environ.get("CC", "cc").split()[0]) or sys.maxsize < 1 << 62:
        return 77
    found, (said, since) = facts(names[0]), recorded()
    gone, new = difference(said, found)
    if "--write" in options:
        if gone and said["soname"] == found["soname"] and "--unreleased" not in options:
            print(*gone, *new, f"refused: raise hbmcheck_soname in interfaces/library/CMakeLists.txt first ({said['soname']} is taken)", sep="\n")
            return 1
        RECORD.write_text(written(found, since))
        return 0
    if not gone and not new and said.get("soname") == found["soname"]:
        print(f"{found['soname']}: {sum(f.startswith('function') for f in found)} functions as in {RECORD.name}")
        return 0
    print(*gone, *new, f"soname {said.get('soname')} in {RECORD.name}, {found['soname']} in the library", sep="\n")
    if gone and said["soname"] == found["soname"]:
        print("Programs built against this soname break: raise hbmcheck_soname in interfaces/library/CMakeLists.txt and interfaces/python/hbmcheck/_library.py,")
        print("or take it back. Then: interfaces/library/abi.py --write LIBRARY (--unreleased: no version of this soname is out yet)")
    else:
        print("Programs built before keep working. Put it down: interfaces/library/abi.py --write LIBRARY")
    return 1


if __name__ == "__main__":
    try:
        sys.exit(main(*sys.argv[1:]))
    except Unknown as what:
        print(f"{HEADER.name}: not understood: {what}", file=sys.stderr)
        sys.exit(2)
