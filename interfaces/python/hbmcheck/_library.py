"""The shared library: where it is, and its functions with the types of hbmcheck.h."""
import ctypes
import ctypes.util
import os
import pathlib
from ctypes import POINTER, c_char_p, c_double, c_int, c_size_t, c_void_p

from . import _structs as structs
from ._errors import BadInput, Error, Interrupted, Stopped

SONAME = "libhbmcheck.so.0"
INTERFACE = "1.0."  # versions whose structs are those of _structs
OK, BAD_INPUT, NO_MEMORY, INTERRUPTED = 0, 1, 2, 15

_handle, _int, _text = c_void_p, c_int, c_char_p
_place, _doubles, _count = POINTER(c_void_p), POINTER(c_double), POINTER(c_int)
_monitor = POINTER(structs.Monitor)

# NAME: what it returns, what it takes. Structs to be filled and series are handed over as addresses.
_FUNCTIONS = {
    "version": (_text,),
    "status_text": (_text, _int),
    "contact_name": (_text, _int),
    "verdict_name": (_text, _int),
    "case_read": (_int, _text, _int, POINTER(_text), _text, c_size_t, _place),
    "case_parse": (_int, _text, _text, c_size_t, _int, POINTER(_text), _text, c_size_t, _place),
    "case_free": (None, _handle),
    "case_responses": (_int, _handle),
    "case_response_name": (_int, _handle, _int, _text, c_size_t),
    "case_contacts": (_int, _handle),
    "case_contact_name": (_int, _handle, _int, _text, c_size_t),
    "case_contact_tangents": (_int, _handle, _int),
    "case_watch_contacts": (None, _handle, _int),
    "curve_trace": (_int, _handle, _monitor, _place),
    "curve_points": (_handle, _handle),
    "curve_at": (_int, _handle, c_double, _place),
    "curve_specials": (_int, _handle, _int, c_void_p, _count),
    "curve_summary": (_int, _handle, POINTER(structs.Summary)),
    "curve_contacts": (_int, _handle, _handle, _int, _int, c_void_p, _count),
    "curve_free": (None, _handle),
    "solutions_count": (_int, _handle),
    "solutions_get_response": (_int, _handle, _int, _int, c_void_p),
    "solutions_response_coefficients": (_int, _handle, _int, _int, _int, c_void_p, _count),
    "solutions_free": (None, _handle),
    "transient_run": (_int, _handle, _int, _doubles, _monitor, _place),
    "transient_count": (_int, _handle),
    "transient_get": (_int, _handle, _int, c_void_p),
    "transient_wave": (_int, _handle, _int, _int, c_void_p, _count),
    "transient_contacts": (_int, _handle, _int, _int, c_void_p, _count),
    "transient_free": (None, _handle),
    "comparison_run": (_int, _handle, _int, _doubles, _monitor, _place),
    "comparison_count": (_int, _handle),
    "comparison_get": (_int, _handle, _int, c_void_p),
    "comparison_contacts": (_int, _handle, _int, _int, c_void_p, _count),
    "comparison_exit_code": (_int, _handle),
    "comparison_gate": (_int, _handle, POINTER(structs.Gate)),
    "comparison_free": (None, _handle),
    "verification_run": (_int, _handle, POINTER(structs.Foreign), _monitor, _text, c_size_t, _place),
    "verification_count": (_int, _handle),
    "verification_get": (_int, _handle, _int, c_void_p),
    "verification_findings": (_int, _handle, POINTER(structs.Findings)),
    "verification_cause": (_text, _handle),
    "verification_guess": (_text, _handle),
    "verification_sentence": (_text, _handle),
    "verification_hypotheses": (_int, _handle),
    "verification_hypothesis": (_int, _handle, _int, c_void_p),
    "verification_hypothesis_text": (_int, _handle, _int, _text, c_size_t, _text, c_size_t),
    "verification_free": (None, _handle),
    "contact_force": (_int, _handle, _int, _int, _doubles, _doubles, _doubles, _int, _doubles, _doubles, _doubles),
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
    raise ImportError(f"the library of hbmcheck is not found ({'; '.join(tried)}): install the package libhbmcheck0, or set "
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
