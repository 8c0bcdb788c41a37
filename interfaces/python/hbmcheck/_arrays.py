"""What callers hand in, as arrays of double."""
import numpy as np

from ._errors import BadInput


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
