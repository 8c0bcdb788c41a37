"""The text of a case from matrices and dictionaries: the one form in which the library takes a model. The shortest decimal
number that reads as the same double stands for each, so nothing is lost on the way."""
import json

import numpy as np

from ._arrays import real
from ._library import BadInput

DIRECTIONS = ("tangent", "tangent_2", "normal", "direction")


def _plain(value):
    if isinstance(value, np.generic):
        return value.item()
    if isinstance(value, np.ndarray):
        return value.tolist()
    raise TypeError(f"{type(value).__name__} is neither a number, a text, a list nor a dictionary")


def _text(value):
    """JSON, which is YAML; what is not finite is for the library to refuse, as it stands."""
    try:
        return json.dumps(value, default=_plain)
    except TypeError as why:
        raise BadInput(str(why)) from None


def matrix(name, values):
    """Rows of a square matrix [n][n], or [n] for a diagonal; a sparse one is filled up."""
    found = real(name, values.toarray() if hasattr(values, "toarray") else values)
    if found.ndim not in (0, 1, 2) or (found.ndim == 2 and found.shape[0] != found.shape[1]) or found.size == 0:
        raise BadInput(f"{name}: shape {found.shape}, expected a number, [n] or [n][n]")
    if not np.isfinite(found).all():
        raise BadInput(f"{name}: not all of it is finite")
    return found


def _direction(value, n, what):
    """{DOF: factor} of a vector [n]; names and dictionaries as they are."""
    if isinstance(value, (str, int, dict)) or value is None:
        return value
    found = np.asarray(value, dtype=float)
    if found.shape != (n,):
        raise BadInput(f"{what}: shape {found.shape}, expected ({n},)")
    return {str(i + 1): float(c) for i, c in enumerate(found) if c != 0}


def _with_directions(entries, n, what):
    for i, entry in enumerate(entries):
        if not hasattr(entry, "items"):
            raise BadInput(f"{what}[{i}]: {type(entry).__name__}, expected a dictionary of the case file's fields")
        yield {k: _direction(v, n, f"{what}[{i}].{k}") if k in DIRECTIONS else v for k, v in entry.items()}


def _lines(name, entries):
    listed = [f"  - {_text(entry)}\n" for entry in entries]
    return f"{name}:\n{''.join(listed)}" if listed else f"{name}: []\n"


def _damping(C, n):
    if C is None:
        return matrix("C", np.zeros(n))
    if hasattr(C, "items"):
        return C
    found = matrix("C", C)
    if found.shape[:1] != (n,):
        raise BadInput(f"C: shape {found.shape}, expected [{n}] or [{n}][{n}] as M has")
    return found


def _structure(M, C, K, names):
    n = M.shape[0]
    if K.shape[:1] != (n,):
        raise BadInput(f"K: shape {K.shape}, expected [{n}] or [{n}][{n}] as M has")
    parts = [f"  mass: {_text(M)}\n", f"  damping: {_text(_damping(C, n))}\n", f"  stiffness: {_text(K)}\n"]
    return "structure:\n" + "".join(parts) + (f"  names: {_text(list(names))}\n" if names else "")


def case_text(M, C, K, contacts, forcing, response, names, sections):
    """The case as a file would have it."""
    M, K = matrix("M", M), matrix("K", K)
    if M.ndim == 0:
        if names or response is not None:
            raise BadInput("names, response: an oscillator has one degree of freedom, x; expected matrices M, C, K")
        C = matrix("C", 0 if C is None else C)
        if K.ndim or C.ndim:
            raise BadInput("M is a number, and K or C is not")
        amplitude = forcing if hasattr(forcing, "items") else {"amplitude": forcing}
        body = f"oscillator: {_text({'mass': M, 'damping': C, 'stiffness': K})}\nforcing: {_text(amplitude)}\n"
        body += _lines("contacts", _with_directions(contacts, 1, "contacts"))
    else:
        n = M.shape[0]
        loads = [forcing] if hasattr(forcing, "items") else forcing
        if np.ndim(loads) == 0:
            raise BadInput("forcing: a number, expected a list of loads such as {'dof': 1, 'amplitude': 3}")
        body = _structure(M, C, K, names) + _lines("forcing", _with_directions(loads, n, "forcing"))
        body += _lines("contacts", _with_directions(contacts, n, "contacts"))
        if response is not None:
            body += f"response: {_text([_direction(r, n, 'response') for r in response])}\n"
    return body + "".join(f"{name}: {_text(section)}\n" for name, section in sections.items() if section is not None)
