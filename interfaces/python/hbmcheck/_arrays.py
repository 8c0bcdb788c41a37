"""Between NumPy and the library: what callers hand in as arrays of double, rows of structs as columns."""
import ctypes

import numpy as np

from ._library import BadInput, check, lib


def real(name, values):
    """`values` as a new array of double of any shape. BadInput: something else."""
    if np.iscomplexobj(values):
        raise BadInput(f"{name}: complex, expected real numbers")
    try:
        return np.array(values, dtype=float)
    except (TypeError, ValueError):
        raise BadInput(f"{name}: not an array of real numbers") from None


def vector(name, values):
    """`values` as [n] contiguous double. BadInput: something else."""
    found = real(name, values)
    if found.ndim != 1:
        raise BadInput(f"{name}: shape {found.shape}, expected one dimension")
    return np.ascontiguousarray(found)


def finite(name, values):
    """The same, all of it finite."""
    found = vector(name, values)
    if not np.isfinite(found).all():
        at = int(np.flatnonzero(~np.isfinite(found))[0])
        raise BadInput(f"{name}[{at}] = {found[at]} is not finite")
    return found


def omegas(name, values):
    """Frequencies [n] > 0; one number is a list of one."""
    found = finite(name, np.atleast_1d(values) if np.ndim(values) == 0 else values)
    if len(found) and not found.min() > 0:
        at = int(found.argmin())
        raise BadInput(f"{name}[{at}] = {found[at]}, expected omega > 0")
    return found


def pointer(values):
    """Of a contiguous array of double; NULL for None."""
    return None if values is None else values.ctypes.data_as(ctypes.POINTER(ctypes.c_double))


def rows(kind, n, get):
    """n structs of that kind, each filled by get(k, address), as {field: array [n]}."""
    table = (kind * n)()
    start, size = ctypes.addressof(table), ctypes.sizeof(kind)
    for k in range(n):
        check(get(k, start + k * size))
    found = np.frombuffer(table, dtype=np.dtype(kind), count=n) if n else np.empty(0, dtype=np.dtype(kind))
    return {name: np.ascontiguousarray(found[name]) for name in found.dtype.names}


def words(codes, name_of):
    """Codes as an array of their words, str."""
    known = {int(c): name_of(int(c)).decode() for c in np.unique(codes)}
    return np.array([known[int(c)] for c in codes], dtype=str)


def contact_words(codes):
    return words(codes, lib.contact_name)


def verdict_words(codes):
    return words(codes, lib.verdict_name)


def status_words(codes):
    return words(codes, lib.status_text)
