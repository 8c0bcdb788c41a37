#!/usr/bin/env python3
"""interface.py HBMCHECK [--check] - the tables of docs/interface.md, docs/fields.txt and docs/columns.txt.

Fields and columns as the commands print them; what rows.c says of its columns. Between `<!-- table: NAME -->` and `<!-- end -->`: verdicts and reasons
from the lists that name them in the sources. Section 3 must say what each other column means, docs/verify.md what each cause
of verify is, and neither of others.
--check: nothing is written; exit 1 if a table is not what it should be, or a column has no meaning."""
import csv, pathlib, re, subprocess, sys, tempfile, textwrap

ROOT = pathlib.Path(__file__).resolve().parent.parent
CHAIN, CASE2 = "cases/structures/chain3.yaml", "cases/paper/case2.yaml"
COMMANDS = {  # what is run for the columns of each command: one degree of freedom where a structure has no more
    "frf": ["frf", CHAIN, "--at", "1.485", "--contacts"],
    "transient": ["transient", CHAIN, "--at", "1.485", "--contacts"],
    "survey": ["survey", CHAIN, "--at", "1.485", "--starts", "8"],
    "compare": ["compare", CHAIN, "--at", "1.485", "--contacts"],
    "compare --tables": ["compare", CASE2, "--harmonics", "3", "--samples", "32"],
    "modes": ["modes", CHAIN],
    "reduce": ["reduce", "cases/meshes/blade.yaml", "-o", "reduced"],
    "prove": ["prove", CASE2, "--at", "9"],
    "advise": ["advise", CASE2],
    "contact": ["contact", CASE2, "--motion", "0,8,0", "--samples", "64"],
    "gate": ["gate", "cases/structures/jenkins2.yaml"],
    "verify": ["verify", "cases/verify/case2.yaml", "--against", "cases/verify/no_static.csv",
               "--columns", "omega=1,harmonic_1=2"],
    "bench": ["bench", CASE2, "--at", "9", "--alone", "--repeats", "1"],
    "suite": ["suite", str(ROOT / "compare" / "suite"), "--results", "results", "--all"],
    "stress": ["stress", "--scenes", "1"],
    "describe": ["describe"],
    "describe --case": ["describe", "--case", CASE2],
    "describe --columns": ["describe", "--columns"],
}
LISTS = {"verdicts": ("compare/comparison.h", "VERDICT_LIST"), "reasons": ("proof/prove/prove.h", "PROOF_REASONS")}
CAUSES = ("compare/verify/equations/causes.h", "VERIFY_CAUSE_LIST")


def run(*arguments):
    done = subprocess.run([HBMCHECK, *arguments], cwd=WORK, capture_output=True, text=True)
    if done.returncode not in (0, 1): sys.exit(f"hbmcheck {' '.join(arguments)}: exit {done.returncode}\n{done.stderr}")
    return done.stdout


def headers(arguments):
    lines = [line for line in run(*arguments, "--format", "csv", "--quiet").split("\n") if not line.startswith("#")]
    return [line.split(",") for before, line in zip([""] + lines, lines) if line and not before]


def said(row): return f"{row['column']}{' [' + row['unit'] + ']' if row['unit'] else ''}: {row['meaning']}"


def fill(text, first, rest): return "\n".join(textwrap.wrap(text, 116, initial_indent=first, subsequent_indent=rest))


def of_list(path, name):
    """The strings of each row of an X-list: word, meaning, ..."""
    text = re.search(rf"#define {name}\(X\)((?:.*\\\n)*.*\n)", (ROOT / path).read_text())[1]
    rows = [re.findall(r'"((?:[^"\\]|\\.)*)"', entry) for entry in re.split(r"\bX\(", text)[1:]]
    return [row for row in rows if row[0]]


def main(check):
    columns = {name: headers(arguments) for name, arguments in COMMANDS.items()}
    columns["compare --tables"] = columns["compare --tables"][1:]  # its first table is that of compare
    tables = {name: "\n".join(fill(row[1], f"- `{row[0]}`: ", "  ") for row in of_list(*where))
              for name, where in LISTS.items()}
    printed = "\n".join(fill("; then ".join(" ".join(table) for table in found), f"{name}: ", "  ")
                        for name, found in columns.items()) + "\n"
    rows = list(csv.DictReader(run("describe", "--columns", "--format", "csv").split("\n")))
    for name in dict.fromkeys(row["table"] for row in rows):
        printed += f"\n{name}\n" + "".join(f"{fill(said(row), '  ', '      ')}\n" for row in rows if row["table"] == name)
    page = old = (ROOT / "docs/interface.md").read_text()
    for name, table in tables.items():
        place = f"(<!-- table: {name} -->\n).*?(<!-- end -->)"
        page = re.sub(place, lambda m: f"{m[1]}\n{table}\n\n{m[2]}", page, flags=re.S)
    meant = re.search(r"<!-- meanings -->(.*?)<!-- end -->", page, re.S)[1]
    meant = " ".join(re.findall(r"^- (.*?):(?: |\n)", meant, re.M | re.S))
    meant = set(meant.replace("`", "").replace(",", " ").split())
    all_columns = {column for found in columns.values() for table in found for column in table}
    known = {row["column"] for row in rows}
    wrong = [f"column {name} has no meaning" for name in sorted(all_columns - meant - known)]
    wrong += [f"{name} is no column" for name in sorted(meant - all_columns)]
    tried = re.search(r"<!-- causes -->(.*?)<!-- end -->", (ROOT / "docs/verify.md").read_text(), re.S)[1]
    tried = set(re.findall(r"`(\w+)`", " ".join(re.findall(r"^\|(.*?)\|", tried, re.M))))
    wrong += [f"docs/verify.md: cause {name}" for name in sorted(tried ^ {row[0] for row in of_list(*CAUSES)})]
    txt = {"docs/fields.txt": run("describe"), "docs/columns.txt": printed}
    texts = [(path, text, (ROOT / path).read_text() if (ROOT / path).exists() else "") for path, text in txt.items()]
    for path, text, was in [("docs/interface.md", page, old), *texts]:
        if text != was and check: wrong.append(f"{path} is not what the program says: run docs/interface.py HBMCHECK")
        if text != was and not check: (ROOT / path).write_text(text)
    print("\n".join(wrong))
    return 1 if wrong else 0


if __name__ == "__main__":
    HBMCHECK = pathlib.Path(sys.argv[1]).resolve()
    with tempfile.TemporaryDirectory() as WORK:
        pathlib.Path(WORK, "cases").symlink_to(ROOT / "cases")
        pathlib.Path(WORK, "results").mkdir()
        pathlib.Path(WORK, "results", "open.csv").write_text("omega,mean\n4,0\n")
        sys.exit(main("--check" in sys.argv))
