#!/usr/bin/env python3
"""make.py FOLDER [--only TEXT] - every curve of curves.py whose name contains TEXT, into FOLDER/NAME.csv, if it is not
there. Half an hour for all of them; numpy is needed."""
import pathlib
import sys

import curves


def main(arguments):
    if len(arguments) not in (1, 3) or (len(arguments) == 3 and arguments[1] != "--only"):
        print(__doc__, file=sys.stderr)
        return 64
    folder, only = pathlib.Path(arguments[0]), arguments[2] if len(arguments) == 3 else ""
    folder.mkdir(exist_ok=True)
    for m in curves.MISTAKES:
        to = folder / f"{m.file}.csv"
        if only in m.name and not to.exists():
            to.write_text(curves.text(m))
            print(m.name, to.read_text().split("\n", 1)[0], flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
