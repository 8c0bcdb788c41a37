#!/usr/bin/env python3
"""How long hbmcheck takes with finite-element models: the table of large_models.md, on standard output.

    docs/measurements/large_models.py HBMCHECK [ROW...]     the program; numbers of rows, all where none is given

Processor time of one process on one core (BLAS kept to one thread), the first row of csv after how much of it, the
largest resident set, and what the command itself said beforehand it would take ("takes about"). One run a row.
"""
import os
import subprocess
import sys
import tempfile

CASES = os.path.join(os.path.dirname(__file__), "..", "..", "cases", "structures")
PLATES, BLADE, DISK = "plates.yaml", "blade_damper.yaml", "bladed_disk.yaml"
CURVE = "curve"  # a file of what `frf` said of the plates
POINTS = "frequency,amplitude\n135,1.00163e-4\n138,4.605319e-4\n140,3.419049e-4\n"
ROWS = [  # what, arguments
    ("plates, 84 coordinates, 12 pairs", ["frf", PLATES]),
    ("", ["compare", PLATES, "--at", "135,138,140"]),
    ("", ["transient", PLATES, "--at", "138"]),
    ("", ["report", PLATES, "-o", os.devnull]),
    ("blade_damper, 231 coordinates, 36 pairs", ["frf", BLADE]),
    ("", ["compare", BLADE, "--at", "280,290,300"]),
    ("blade_damper_reduced, 30 coordinates, 36 pairs", ["compare", "blade_damper_reduced.yaml", "--at", "280,290,300"]),
    ("bladed_disk, 24 contacts", ["compare", DISK, "--at", "960,1000,1020"]),
    ("plates", ["gate", PLATES]),
    ("", ["verify", PLATES, "--against", CURVE]),
    ("beam_pairs", ["compare", "beam_pairs.yaml"]),
]


def run(program, arguments):
    """(processor time [s], the same when the first row came or None, memory [MB], what stderr foretold, exit code)"""
    rows = arguments[0] in ("compare", "transient", "frf")
    command = [program, arguments[0], os.path.join(CASES, arguments[1]), *arguments[2:]] + rows * ["--format", "csv"]
    environment = dict(os.environ, OPENBLAS_NUM_THREADS="1", OMP_NUM_THREADS="1")
    process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, env=environment)
    first, lines = None, 0
    for line in process.stdout:
        lines += not line.startswith("#")
        if lines == 2 and first is None:
            with open(f"/proc/{process.pid}/stat") as file:
                ticks = file.read().rsplit(")", 1)[1].split()
            first = (int(ticks[11]) + int(ticks[12])) / os.sysconf("SC_CLK_TCK")
    said = [line.split("takes about ")[1].split(" of processor")[0] for line in process.stderr if "of processor time" in line]
    _, status, used = os.wait4(process.pid, 0)
    return used.ru_utime + used.ru_stime, first, used.ru_maxrss / 1024, said[0] if said else "", os.waitstatus_to_exitcode(status)


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    chosen = [int(number) for number in sys.argv[2:]] or range(len(ROWS))
    print("| model | command | processor time [s] | first row after [s] | said beforehand | memory [MB] | exit |")
    print("|---|---|---|---|---|---|---|")
    for number in chosen:
        model, arguments = ROWS[number]
        shown = " ".join([arguments[0], *(a for a in arguments[2:] if a not in ("-o", os.devnull))])
        with tempfile.NamedTemporaryFile("w", suffix=".csv") as curve:
            curve.write(POINTS)
            curve.flush()
            arguments = [curve.name if a == CURVE else a for a in arguments]
            took, first, memory, said, code = run(sys.argv[1], arguments)
        print(f"| {model} | `{shown}` | {took:.1f} | {'' if first is None else f'{first:.1f}'} | {said} | {memory:.0f} | {code} |",
              flush=True)


main()
