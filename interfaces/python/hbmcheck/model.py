"""A model: an oscillator or a structure on contacts, with its loads, sweep and settings, and what can be asked of it."""
from __future__ import annotations

import ctypes
import difflib
import os
from typing import Any, Callable, Mapping, Optional, Sequence, Union

import numpy as np

from . import _structs as structs
from ._arrays import finite, omegas, pointer
from ._compose import case_text
from ._errors import MissingFile
from ._library import BAD_INPUT, BadInput, check, lib
from ._monitor import Watch
from ._owner import Owner
from .results import (Comparison, ContactForce, Curve, Solutions, Transient, Verification, comparison_of, solution_columns,
                      transient_of, verification_of)

Progress = Callable[[Optional[float]], Any]
MESSAGE = 2048  # holds any
SHOWN = 6  # names in repr()
SECTIONS = ("title", "units", "hbm", "transient", "compare", "gate")  # of a case file, beside those that have a name here


def _assignments(settings):
    """{"hbm.harmonics": 10, "hbm.static": False} as PATH=VALUE."""
    def value(v):
        if isinstance(v, (bool, np.bool_)):
            return "true" if v else "false"
        if isinstance(v, (float, np.floating)):
            return repr(float(v))
        return ",".join(map(value, v)) if isinstance(v, (list, tuple, np.ndarray)) else str(v)

    listed = [f"{path}={value(v)}".encode() for path, v in (settings or {}).items()]
    return len(listed), (ctypes.c_char_p * max(len(listed), 1))(*listed)


def _case(call, settings, file=None):
    """A case by call(n_set, set, message, size, place), from that file if it is one's."""
    place, message = ctypes.c_void_p(), ctypes.create_string_buffer(MESSAGE)
    n, listed = _assignments(settings)
    status = call(n, listed, message, MESSAGE, ctypes.byref(place))
    if file is not None and status not in (0, BAD_INPUT) and not os.path.exists(file):
        raise MissingFile(message.value.decode(errors="replace"))
    check(status, message.value.decode(errors="replace"))
    return place.value


def _listed(what, names):
    """3 contacts (a, b, c)."""
    shown = ", ".join(names[:SHOWN]) + (", ..." if len(names) > SHOWN else "")
    return f"{len(names)} {what}{'' if len(names) == 1 else 's'}" + (f" ({shown})" if names else "")


def _name(call, case, number):
    text = ctypes.create_string_buffer(512)
    check(call(case, number, text, 512))
    return text.value.decode()


class Model:
    """An oscillator or a structure on friction and gap contacts.

    M, C, K   mass, damping, stiffness: numbers for an oscillator; [n][n], or [n] for a diagonal, for a structure, in any
              consistent units (SciPy's sparse matrices, too). C may also be {"rayleigh": [alpha, beta]} or
              {"modal": ratio}; None: no damping.
    contacts  dictionaries of the case file's fields: tangential_stiffness, normal_stiffness, friction, gap, preload,
              name, limit; of an oscillator angle_deg; of a structure tangent, tangent_2, normal: a DOF by name or
              number from 1, {DOF: factor}, or a vector [n]
    forcing   of an oscillator F0 [force]; of a structure loads {"dof" or "direction": ..., "amplitude": ...,
              "phase_deg": ..., "harmonic": ...}
    response  of a structure: what is reported, a list of DOFs, {DOF: factor} or vectors [n]
    names     of a structure: its DOFs'
    sweep     (from, to) [rad/time] > 0
    sections  others of a case file: title="...", hbm={"harmonics": 20}, transient={...}, compare={...}, gate={...}

    BadInput: something is wrong, in words; .text of a model is the case file that stands for it.
    A model may be used by several threads, one at a time; to work at the same time each takes a model of its own. A pickle
    of it holds its text, or the name of its file, which is read again.
    """

    text: Optional[str]

    def __init__(self, M: Any, C: Any, K: Any, *, contacts: Sequence[Mapping] = (), forcing: Any = (),
                 response: Optional[Sequence] = None, names: Optional[Sequence[str]] = None,
                 sweep: Optional[Sequence[float]] = None, **sections: Any) -> None:
        for name in sections:
            if name not in SECTIONS:
                near = difflib.get_close_matches(name, ["contacts", "forcing", "response", "names", "sweep", *SECTIONS], 1, 0.5)
                raise BadInput(f"{name}: unknown argument" + (f", did you mean `{near[0]}`?" if near else ""))
        if sweep is not None:
            sections["sweep"] = {"omega": [float(w) for w in sweep]}
        text = case_text(M, C, K, contacts, forcing, response, names, sections)
        self._adopt("Model", text, None)

    @classmethod
    def from_yaml(cls, path: Union[str, os.PathLike], set: Optional[Mapping[str, Any]] = None) -> Model:
        """The case file at path; set: fields that are other than there, {"hbm.harmonics": 10, "contacts[0].gap": -1}."""
        model = cls.__new__(cls)
        model._made = (cls.from_yaml, (os.fspath(path), set))
        name = os.fsencode(path)
        model.text = None
        model._own(_case(lambda *a: lib.case_read(name, *a), set, name))
        return model

    @classmethod
    def from_text(cls, text: str, set: Optional[Mapping[str, Any]] = None, name: str = "case") -> Model:
        """The same of the text of a case file, called `name` in messages."""
        model = cls.__new__(cls)
        model._adopt(name, text, set)
        return model

    def _adopt(self, name, text, settings):
        self._made = (Model.from_text, (text, settings, name))
        self.text, data = text, text.encode()
        self._own(_case(lambda *a: lib.case_parse(name.encode(), data, len(data), *a), settings))

    def _own(self, case):
        self._owner = Owner(case, lib.case_free, "the model")
        self.responses: list[str] = [_name(lib.case_response_name, case, r) for r in range(lib.case_responses(case))]
        self.contacts: list[str] = [_name(lib.case_contact_name, case, j) for j in range(lib.case_contacts(case))]

    def close(self) -> None:
        """Free it now; ValueError of every use afterwards. Without, it is freed with the last reference."""
        self._owner.close()

    def __reduce__(self) -> tuple:
        return self._made

    def __enter__(self) -> Model:
        return self

    def __exit__(self, *_: Any) -> None:
        self.close()

    def frf(self, at: Any = None, progress: Optional[Progress] = None, contacts: bool = False) -> Union[Curve, Solutions]:
        """Response curve of harmonic balance over the sweep, past turning points, with stability; or, at: a number or
        [n] [rad/time], every solution on it there. Curve.at asks for more of them without following the curve again.

        contacts: with a table of what each contact does in each solution, .contacts.
        progress: called with the fraction done, 0..1, or None; its answer False stops. Stopped (KeyboardInterrupt): the
        curve ends before the sweep does; .result is what was found."""
        watch, place = Watch(progress), ctypes.c_void_p()
        with self._owner as case, watch:
            status = lib.curve_trace(case, watch.monitor, ctypes.byref(place))
        curve = None
        if place:
            owner = Owner(place.value, lib.curve_free, "the curve")
            curve = Curve(owner, solution_columns(lib.curve_points(place), self.responses), self.responses, self.contacts,
                          contacts and at is None)
        watch.check(status, result=curve)
        return curve if at is None else curve.at(at, contacts)

    def _run(self, start, read, free, omega, contacts, progress):
        """A run of the library at omega [n], None: those of the case; its result by read(handle, responses, contacts)."""
        at = None if omega is None else omegas("omega", omega)
        if at is not None and len(at) == 0:
            raise BadInput("omega: empty, expected at least one")
        watch, place = Watch(progress), ctypes.c_void_p()
        with self._owner as case, watch:
            lib.case_watch_contacts(case, bool(contacts))
            status = start(case, 0 if at is None else len(at), pointer(at), watch.monitor, ctypes.byref(place))
        try:
            result = read(place, self.responses, self.contacts if contacts else None) if place else None
        finally:
            free(place)
        words = ""
        if status == BAD_INPUT:
            words = f"omega: {'the case has no compare.omega' if at is None else f'{len(at)} of them'}, expected 1 to 1024"
        watch.check(status, words, result)
        return result

    def transient(self, omega: Any = None, progress: Optional[Progress] = None, contacts: bool = False) -> Transient:
        """Steady states by time integration at omega, a number or [n] [rad/time]; None: at the case's compare.omega.

        Rows that failed say so in `status`. progress and contacts as of frf; contacts may take as long again."""
        return self._run(lib.transient_run, transient_of, lib.transient_free, omega, contacts, progress)

    def compare(self, omega: Any = None, progress: Optional[Progress] = None, contacts: bool = False) -> Comparison:
        """Harmonic balance and time integration at omega, a number or [n] [rad/time]; None: at the case's compare.omega
        or compare.points. A verdict for each row. progress and contacts as of transient."""
        return self._run(lib.comparison_run, comparison_of, lib.comparison_free, omega, contacts, progress)

    def verify(self, omega: Any, amplitude: Any, quantity: str = "amplitude", response: Union[int, str] = 0,
               noise: float = 0.0, progress: Optional[Progress] = None) -> Verification:
        """A curve of your own, point by point, and the likely cause where it is off.

        omega [n] [rad/time] in any order, several branches if there are; amplitude [n]: values of `quantity`, which is
        "amplitude" = (max - min)/2, "harmonic_1" = |a1 + i b1|, "rms", "dB_harmonic_1", ... (docs/verify.md), of that
        response, by name or number; noise: their standard deviation relative to the amplitude, as of a measurement.
        progress as of frf."""
        at, values = finite("omega", omega), finite("amplitude", amplitude)
        if at.shape != values.shape:
            raise BadInput(f"amplitude: shape {values.shape}, expected {at.shape} as omega has")
        number = self._numbered("response", response, self.responses)
        curve = structs.Foreign(number, str(quantity).encode(), len(at), pointer(at), pointer(values), noise)
        watch, place, message = Watch(progress), ctypes.c_void_p(), ctypes.create_string_buffer(MESSAGE)
        with self._owner as case, watch:
            status = lib.verification_run(case, ctypes.byref(curve), watch.monitor, message, MESSAGE, ctypes.byref(place))
        try:
            result = verification_of(place, self.responses) if place else None
        finally:
            lib.verification_free(place)
        watch.check(status, message.value.decode(errors="replace"), result)
        return result

    def contact_force(self, u: Any = None, v: Any = None, u2: Any = None, *, contact: Union[int, str] = 0,
                      samples: Optional[int] = None, harmonics: int = 1) -> ContactForce:
        """Fourier coefficients of the forces of one contact, by name or number, under its own motion.

        u, v [2H+1] [length]: its tangential and normal motion, X0, a1, b1, a2, b2, ...; None: none; u2: the same along
        the second of two tangents. samples: per period, as an AFT takes them, >= 2H+1; None: exact. H is what the
        longest has, at least `harmonics`; shorter ones are filled up with zeros."""
        number = self._numbered("contact", contact, self.contacts)
        given = [None if m is None else finite(name, m) for name, m in (("u", u), ("u2", u2), ("v", v))]
        for name, m in zip(("u", "u2", "v"), given):
            if m is not None and len(m) % 2 == 0:
                raise BadInput(f"{name}: {len(m)} coefficients, expected an odd number: X0, a1, b1, a2, b2, ...")
        longest = max([2 * int(harmonics) + 1, 3, *(len(m) for m in given if m is not None)])
        if longest > 401:
            raise BadInput(f"{longest // 2} harmonics, expected at most 200")
        if samples is not None and not longest <= samples <= 1 << 24:
            raise BadInput(f"samples: {samples} for {longest // 2} harmonics, expected {longest} to {1 << 24}")
        u, u2, v = (None if m is None else np.pad(m, (0, longest - len(m))) for m in given)
        T, N = np.empty(longest), np.empty(longest)
        with self._owner as case:
            T2 = np.empty(longest) if lib.case_contact_tangents(case, number) == 2 else None
            status = lib.contact_force(case, number, longest // 2, pointer(u), pointer(u2), pointer(v), samples or 0,
                                       pointer(T), pointer(T2), pointer(N))
        check(status, f"contact {self.contacts[number]} does not move along one of u, u2, v that are given"
              if status == BAD_INPUT else "")
        return ContactForce(T, N, T2)

    def _numbered(self, what, asked, names):
        """A part of the case by its name, or its number from 0."""
        if isinstance(asked, str) and asked in names:
            return names.index(asked)
        if not isinstance(asked, str) and 0 <= asked < len(names):
            return int(asked)
        raise BadInput(f"{what}: the case has no {asked!r}, expected one of {', '.join(names) or 'none'}")

    def __repr__(self) -> str:
        return f"<Model: {_listed('response', self.responses)}; {_listed('contact', self.contacts)}>"
