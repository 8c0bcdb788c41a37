"""make_wheel.py - the build backend of pyproject.toml (PEP 517): a wheel of hbmcheck/ as it stands, by the standard library alone."""
import base64
import hashlib
import io
import pathlib
import re
import tarfile
import zipfile

HERE = pathlib.Path(__file__).resolve().parent
PROJECT = (HERE / "pyproject.toml").read_text()
NAME = "hbmcheck"
VERSION = re.search(r'^version = "(.*)"$', PROJECT, re.MULTILINE)[1]
DATE = (2020, 1, 1, 0, 0, 0)  # of every file inside: the same source gives the same wheel


def said(key):
    """What pyproject.toml says there, in one line."""
    return re.search(rf'^{key} = (.*)$', PROJECT, re.MULTILINE)[1].strip('"')


METADATA = f"""Metadata-Version: 2.1
Name: {NAME}
Version: {VERSION}
Summary: {said("description")}
License: GPL-3.0-or-later
Requires-Python: {said("requires-python")}
Requires-Dist: {", ".join(re.findall(r'"(.*?)"', said("dependencies")))}
Provides-Extra: plot
Requires-Dist: {", ".join(re.findall(r'"(.*?)"', said("plot")))}; extra == "plot"
"""
WHEEL = "Wheel-Version: 1.0\nGenerator: hbmcheck\nRoot-Is-Purelib: true\nTag: py3-none-any\n"


def sources():
    """The files of the package, those that Python makes left out."""
    return sorted(p for p in (HERE / NAME).rglob("*") if p.is_file() and p.suffix in (".py", ".typed"))


def record(name, data):
    digest = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
    return f"{name},sha256={digest},{len(data)}\n"


def prepare_metadata_for_build_wheel(metadata_directory, config_settings=None):
    folder = pathlib.Path(metadata_directory, f"{NAME}-{VERSION}.dist-info")
    folder.mkdir(exist_ok=True)
    (folder / "METADATA").write_text(METADATA)
    (folder / "WHEEL").write_text(WHEEL)
    return folder.name


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    folder = f"{NAME}-{VERSION}.dist-info"
    files = [(str(p.relative_to(HERE)), p.read_bytes()) for p in sources()]
    files += [(f"{folder}/METADATA", METADATA.encode()), (f"{folder}/WHEEL", WHEEL.encode())]
    listed = "".join(record(*f) for f in files) + f"{folder}/RECORD,,\n"
    name = f"{NAME}-{VERSION}-py3-none-any.whl"
    with zipfile.ZipFile(pathlib.Path(wheel_directory, name), "w", zipfile.ZIP_DEFLATED) as out:
        for path, data in files + [(f"{folder}/RECORD", listed.encode())]:
            entry = zipfile.ZipInfo(path, DATE)
            entry.external_attr = 0o644 << 16
            out.writestr(entry, data)
    return name


def build_sdist(sdist_directory, config_settings=None):
    name = f"{NAME}-{VERSION}"
    with tarfile.open(pathlib.Path(sdist_directory, f"{name}.tar.gz"), "w:gz") as out:
        information = tarfile.TarInfo(f"{name}/PKG-INFO")
        information.size = len(METADATA.encode())
        out.addfile(information, io.BytesIO(METADATA.encode()))
        for path in [HERE / "pyproject.toml", HERE / "make_wheel.py", HERE / "README.md", *sources()]:
            out.add(path, f"{name}/{path.relative_to(HERE)}")
    return f"{name}.tar.gz"
