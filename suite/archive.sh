#!/bin/sh
# archive.sh OUT.tar.gz - the suite as an archive: the same bytes wherever it is made (GNU tar, gzip). Whoever has it needs Python alone:
#     python3 check.py certificates/*.json
set -eu
here=$(cd "$(dirname "$0")" && pwd)
version=$(sed -n 's/.*"suite": "\([^"]*\)".*/\1/p' "$here/suite.json")
tar --format=ustar --sort=name --mtime=@0 --owner=0 --group=0 --numeric-owner --mode=u=rwX,go=rX --exclude=__pycache__ \
  --transform="s,^,hbmcheck-suite-$version/," -cf - -C "$here" README.md CITATION.cff suite.json adapters cases certificates \
  -C "$here/../proof" check.py -C "$here/.." LICENSE | gzip -9n >"$1"
