#!/usr/bin/env python3
"""damage.py - damaged certificates: the checker answers each, in bounded time and memory.

    python3 damage.py FOLDER COUNT SEED [--other COMMAND]     exit 1 if one took over 60 s, over 1 GB, or raised an error; COMMAND: falsify.py
"""
import copy
import json
import random
import resource
import shlex
import signal
import subprocess
import sys
import tempfile
import time
from collections import Counter
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from find import check  # noqa: E402

NUMBERS = ("0", "-0", "1e400", "-1e400", "1e-400", "1e401", "1e99999999999", "9" * 120, "0." + "0" * 100 + "1", "-1", "1e20", "1e-20", "nan", "inf", "", " 1", "0x1",
           "1_0", "\u0661", "1e", ".", "1.", ".5", "+5", "--5")
VALUES = (None, True, False, 0, 1, -1, 2 ** 31, 2 ** 63, 2 ** 64, 10 ** 30, 1.5, 1e308, "", "O", "S", [], {}, [[]], [None] * 1000, ["0"] * 41, "x" * 10000, {"a": 1})


def nodes(value, out):
    for key in list(value) if isinstance(value, dict) else range(len(value)):
        out.append((value, key))
        if isinstance(value[key], (dict, list)):
            nodes(value[key], out)
    return out


def damaged(text, rng):
    """Bytes of a file: bytes changed, or values of the JSON replaced, moved, repeated, dropped."""
    if rng.random() < 0.3:
        data = bytearray(text.encode())
        for _ in range(rng.choice((1, 1, 3, 20))):
            at = rng.randrange(len(data))
            end = min(len(data), at + rng.choice((1, 10, 200)))
            how = rng.randrange(4)
            data[at:end] = (b"", bytes([rng.randrange(256)]), data[at:end] * 2, rng.choice((b"[" * 3000, b"{", b"}", b'"', b"\\", b"\\ud800", b"9" * 300, b"e9", b"\0")))[how]
        return bytes(data)
    data = json.loads(text)
    sys.setrecursionlimit(20000)  # for nodes(); the checker is given the usual one
    for _ in range(rng.choice((1, 1, 1, 2, 5))):
        every = nodes(data, [])
        holder, key = rng.choice(every)
        how = rng.randrange(6)
        if how < 3 and isinstance(holder[key], str):
            holder[key] = rng.choice(NUMBERS)
        elif how == 3:
            del holder[key]
        elif how == 4:
            other, place = rng.choice(every)
            try:
                holder[key] = json.loads(json.dumps(other[place]))
            except (KeyError, IndexError):
                pass
        elif how == 5 and isinstance(holder[key], list):
            holder[key] = holder[key] * rng.choice((2, 3, 50))
        else:
            holder[key] = copy.deepcopy(rng.choice(VALUES))
    out = json.dumps(data).encode()
    sys.setrecursionlimit(1000)
    return out


def main():
    arguments = sys.argv[1:]
    other = arguments[arguments.index("--other") + 1] if "--other" in arguments else None
    files, count, rng = sorted(Path(arguments[0]).glob("*.json")), int(arguments[1]), random.Random(int(arguments[2]))
    resource.setrlimit(resource.RLIMIT_AS, (1 << 30, 1 << 30))
    tally, bad, longest = Counter(), 0, 0.0
    signal.signal(signal.SIGALRM, lambda *_: (_ for _ in ()).throw(TimeoutError("over 60 s")))
    folder = Path(tempfile.mkdtemp())
    for k in range(count):
        path = folder / "damaged.json"
        path.write_bytes(damaged(rng.choice(files).read_text(), rng))
        began = time.process_time()
        signal.alarm(300)
        try:
            answer = check.examine(str(path))
        except BaseException as error:  # whatever it is, it is a fault
            answer = {"verdict": f"{type(error).__name__}: {error}"[:80]}
        signal.alarm(0)
        took = time.process_time() - began
        longest = max(longest, took)
        verdicts = [answer["verdict"]]
        if other:
            run = subprocess.run(shlex.split(other) + [str(path), "--format", "json"], capture_output=True, timeout=600)
            try:
                verdicts.append(json.loads(run.stdout.splitlines()[0])["verdict"])
            except (ValueError, IndexError, KeyError):
                verdicts.append(f"exit {run.returncode}")
        tally[tuple(verdicts)] += 1
        if verdicts[0] not in ("accepted", "rejected", "wrong") or took > 60 or len(set(verdicts)) > 1:
            bad += 1
            path.rename(folder / f"{k}.json")
            print(folder / f"{k}.json", *verdicts, answer.get("reason"), f"{took:.1f} s", flush=True)
    for key, value in tally.items():
        print(f"{value:6d} {', '.join(key)}")
    print(f"longest {longest:.1f} s, largest {resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024:.0f} MB, {bad} bad")
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
