"""The shared library: where it is, and its functions with the types of hbmcheck.h."""
import ctypes
import ctypes.util
import os
import pathlib
from ctypes import POINTER, c_char_p, c_double, c_int, c_size_t, c_void_p

from . import _structs as structs
from ._errors import BadInput, Error, Interrupted, Stopped

SONAME = "libhbmcheck.so.1"
INTERFACE = "1.0."  # versions whose structs are those of _structs
OK, BAD_INPUT, NO_MEMORY, INTERRUPTED = 0, 1, 2, 15

_handle, _int, _text = c_void_p, c_int, c_char_p
_place, _texts = POINTER(c_void_p), POINTER(c_char_p)

# NAME: what it returns, what it takes. Arrays of double are handed over as addresses.
_FUNCTIONS = {
    "version": (_text,),
    "status_text": (_text, _int),
    "case_read": (_int, _text, _int, _texts, _text, c_size_t, _place),
    "case_parse": (_int, _text, _text, c_size_t, _int, _texts, _text, c_size_t, _place),
    "case_give": (_int, _handle, _text, _int, _int, c_void_p, _text, c_size_t),
    "case_free": (None, _handle),
    "run": (_int, _handle, _text, _int, _texts, POINTER(structs.Monitor), _place),
    "result_exit_code": (_int, _handle),
    "result_remark": (_text, _handle, _int),
    "result_table": (_handle, _handle, _int),
    "result_free": (None, _handle),
    "table_title": (_text, _handle),
    "table_remark": (_text, _handle, _int),
    "table_rows": (_int, _handle),
    "table_column": (_int, _handle, _int, POINTER(structs.Column)),
    "table_number": (c_double, _handle, _int, _text),
    "table_text": (_text, _handle, _int, _text),
    "table_numbers": (_int, _handle, _int, _text, _int, c_void_p),
}


def _candidates():
    """HBMCHECK_LIBRARY alone, if it is set; else what lies beside this file, then what the system's loader finds."""
    told = os.environ.get("HBMCHECK_LIBRARY")
    if told:
        return [told]
    beside = pathlib.Path(__file__).with_name(SONAME)
    return ([str(beside)] if beside.exists() else []) + [SONAME]


def _load():
    tried = []
    for name in _candidates():
        try:
            return ctypes.CDLL(name)
        except OSError as why:
            tried.append(str(why))
    raise ImportError(f"the library of hbmcheck is not found ({'; '.join(tried)}): install the package libhbmcheck1, or set "
                      f"HBMCHECK_LIBRARY to the path of {SONAME}")


def _bind():
    loaded, found = _load(), {}
    for name, (result, *arguments) in _FUNCTIONS.items():
        try:
            function = getattr(loaded, "hbmcheck_" + name)
        except AttributeError:
            raise ImportError(f"{loaded._name} has no hbmcheck_{name}: it is older than this package") from None
        function.restype, function.argtypes = result, arguments
        found[name] = function
    version = found["version"]().decode()
    if not version.startswith(INTERFACE):
        raise ImportError(f"{loaded._name} is version {version}; this package is for {INTERFACE}x")
    return found


class _Namespace:
    def __init__(self, functions):
        self.__dict__.update(functions)


lib = _Namespace(_bind())


def library_version() -> str:
    """The version of the library in use, "1.0.0"."""
    return lib.version().decode()


def status_text(status: int) -> str:
    return lib.status_text(status).decode()


def check(status, words="", result=None):
    """Nothing for HBMCHECK_OK, else the exception that says it, in `words` or those of the status."""
    if status == OK:
        return
    words = words or status_text(status)
    if status == BAD_INPUT:
        raise BadInput(words)
    if status == NO_MEMORY:
        raise MemoryError(words)
    raise (Interrupted if status == INTERRUPTED else Stopped)(words, result)


__all__ = ["BadInput", "Error", "check", "lib", "library_version", "status_text"]
