#!/usr/bin/env python3
"""archive.py OUT.tar.gz - the suite as an archive: the same bytes wherever it is made. Whoever has it needs Python alone:
    python3 check.py certificates/*.json"""
import gzip, io, json, pathlib, sys, tarfile

HERE = pathlib.Path(__file__).resolve().parent
PARTS = ["README.md", "CITATION.cff", "suite.json", "adapters", "cases", "certificates", "../../proof/check.py", "../../LICENSE"]


def main(out):
    folder = f"hbmcheck-suite-{json.loads((HERE / 'suite.json').read_text())['suite']}"
    with open(out, "wb") as to, gzip.GzipFile("", "wb", 9, to, mtime=0) as packed, \
            tarfile.open(fileobj=packed, mode="w", format=tarfile.USTAR_FORMAT) as archive:
        for part in PARTS:
            path = HERE / part
            for file in sorted(path.iterdir()) if path.is_dir() else [path]:
                if file.name == "__pycache__": continue
                entry = tarfile.TarInfo(f"{folder}/{file.relative_to(HERE) if path.is_dir() else file.name}")
                entry.size, entry.mode = file.stat().st_size, 0o644
                archive.addfile(entry, io.BytesIO(file.read_bytes()))


main(sys.argv[1])
