"""A model: an oscillator or a structure on contacts, with its loads, sweep and settings, and what can be asked of it."""
from __future__ import annotations

import ctypes
import difflib
import os
from typing import Any, Callable, Mapping, Optional, Sequence, Union

import numpy as np

from ._arrays import finite, omegas
from ._compose import case_text
from ._errors import MissingFile
from ._library import BAD_INPUT, BadInput, check, lib
from ._monitor import Watch
from ._owner import Owner
from ._tables import ask, run
from .results import Comparison, ContactForce, Contacts, Curve, Solutions, Table, Transient, Verification, place

Progress = Callable[[Optional[float]], Any]
MESSAGE = 2048  # holds any
SHOWN = 6  # names in repr()
SECTIONS = ("title", "units", "hbm", "transient", "compare", "gate")  # of a case file, beside those that have a name here


def _value(v):
    """As on the command line: the shortest decimal that reads as the same double."""
    if isinstance(v, (bool, np.bool_)):
        return "true" if v else "false"
    if isinstance(v, (float, np.floating)):
        return repr(float(v))
    return ",".join(map(_value, v)) if isinstance(v, (list, tuple, np.ndarray)) else str(v)


def _pairs(columns, of, n):
    """Cosines and sines of the harmonics 1..n in these rows; zeros without rows."""
    return [columns[part][of][1:n + 1] if of.any() else np.zeros(n) for part in ("cos", "sin")]


def _assignments(settings):
    """{"hbm.harmonics": 10, "hbm.static": False} as PATH=VALUE."""
    listed = [f"{path}={_value(v)}".encode() for path, v in (settings or {}).items()]
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
        tables = {title: columns for title, columns, *_ in ask(case, "names").tables}
        self.responses: list[str] = tables["Responses"]["response"].tolist()
        self.contacts: list[str] = tables["Contacts"]["name"].tolist()
        self._in_cycles = bool(tables["Case"]["in_cycles"][0])

    def close(self) -> None:
        """Free it now; ValueError of every use afterwards. Without, it is freed with the last reference."""
        self._owner.close()

    def __reduce__(self) -> tuple:
        return self._made

    def __enter__(self) -> Model:
        return self

    def __exit__(self, *_: Any) -> None:
        self.close()

    def replace(self, set: Optional[Mapping[str, Any]] = None, *, sweep: Optional[Sequence[float]] = None, **sections: Any) -> Model:
        """A model that differs from this one in these fields: replace({"hbm.harmonics": 20}), or by sections, as of a
        case file: replace(hbm={"harmonics": 20}, sweep=(3, 9)). Fields that are lists are replaced whole."""
        changed = dict(set or {})
        if sweep is not None:
            changed["sweep.omega"] = [float(w) for w in sweep]
        for section, fields in sections.items():
            if not hasattr(fields, "items"):
                raise BadInput(f"{section}: {type(fields).__name__}, expected a dictionary of the case file's fields")
            changed.update({f"{section}.{field}": value for field, value in fields.items()})
        make, (of, before, *name) = self._made
        return make(of, {**(before or {}), **changed}, *name)

    # ---- commands ----

    def run(self, command: str, progress: Optional[Progress] = None, **options: Any) -> Table:
        """Any command of `hbmcheck` on a case, by name, with its options, contacts=True, at=[6, 8], error=1e-3 (with _ for
        -): the first table that it writes; the others are its .tables. None and False: not given.

        progress: called with the fraction done, 0..1, or None; its answer False stops. Stopped (KeyboardInterrupt): the
        work ended early; .result is what was found."""
        return self._run(command, Table, options, progress)

    def _run(self, command, kind, options, progress, contacts=False, arrays=None):
        listed, watch, message = self._options({**options, "contacts": contacts}), Watch(progress), ctypes.create_string_buffer(MESSAGE)
        with self._owner as case, watch:
            status = lib.case_give(case, b"against", *arrays.shape, arrays.ctypes.data, message, MESSAGE) if arrays is not None else 0
            check(status, message.value.decode(errors="replace"))
            found = run(case, command, listed, watch.monitor)
        made = [kind({}, self.responses)] if not found.tables else []
        for title, columns, units, meanings, notes in found.tables:
            of = kind if not made else Contacts if title == "Contacts" else Table
            made.append(of(columns, self.responses, title, units, meanings, notes))
        result = made[0]
        tables = {t.title: t for t in made if t.title}
        for table in made:
            table.tables, table.remarks, table.exit_code = tables, found.remarks, found.exit_code
        if contacts and len(made) > 1:
            result.contacts = tables["Contacts"]
            result.contacts.names = self.contacts
            place(result.contacts, result)
        if isinstance(result, Curve):
            result._made = self._made
        watch.check(found.status, found.words(), result if found.status != BAD_INPUT else None)
        return result

    def _options(self, options):
        """As on the command line. Frequencies in rad per unit time become those of the case."""
        listed = []
        for name, value in options.items():
            if value is None or value is False:
                continue
            if name == "at":
                value = omegas("omega", value)
                if len(value) == 0:
                    raise BadInput("omega: empty, expected at least one")
                value = value / (2 * np.pi) if self._in_cycles else value
            text = "" if value is True else "=" + _value(value)
            listed.append(f"--{name.replace('_', '-')}{text}")
        return listed

    def frf(self, at: Any = None, progress: Optional[Progress] = None, contacts: bool = False, **options: Any) -> Solutions:
        """Response curve of harmonic balance over the sweep, past turning points, with stability; or, at: a number or
        [n] [rad/time], every solution on it there; outside the sweep as the command does it.

        contacts: with a table of what each contact does in each solution, .contacts. progress and further options: run."""
        kind = Curve if at is None else Solutions
        return self._run("frf", kind, {"at": at, **options}, progress, contacts)

    def transient(self, omega: Any = None, progress: Optional[Progress] = None, contacts: bool = False, **options: Any) -> Transient:
        """Steady states by time integration at omega, a number or [n] [rad/time]; None: at the case's compare.omega.

        Rows that failed say so in `status`. progress and contacts as of frf; contacts may take as long again."""
        return self._run("transient", Transient, {"at": omega, **options}, progress, contacts)

    def survey(self, at: Any = None, starts: int = 200, progress: Optional[Progress] = None, **options: Any) -> Table:
        """The motions that so many drawn starts come to, with their shares, and the HBM solution of each."""
        return self._run("survey", Table, {"at": at, "starts": int(starts), **options}, progress)

    def compare(self, omega: Any = None, progress: Optional[Progress] = None, contacts: bool = False, **options: Any) -> Comparison:
        """Harmonic balance and time integration at omega, a number or [n] [rad/time]; None: at the case's compare.omega
        or compare.points. A verdict for each row. progress and contacts as of transient."""
        return self._run("compare", Comparison, {"at": omega, **options}, progress, contacts)

    def verify(self, omega: Any, amplitude: Any, quantity: str = "amplitude", response: Union[int, str] = 0,
               noise: float = 0.0, progress: Optional[Progress] = None, **options: Any) -> Verification:
        """A curve of your own, point by point, and the likely cause where it is off.

        omega [n] [rad/time] in any order, several branches if there are; amplitude [n]: values of `quantity`, which is
        "amplitude" = (max - min)/2, "harmonic_1" = |a1 + i b1|, "rms", "dB_harmonic_1", ... (docs/verify.md), of that
        response, by name or number; noise: their standard deviation relative to the amplitude, as of a measurement.
        progress as of frf."""
        at, values = finite("omega", omega), finite("amplitude", amplitude)
        if at.shape != values.shape:
            raise BadInput(f"amplitude: shape {values.shape}, expected {at.shape} as omega has")
        if len(at) == 0:
            raise BadInput("0 points, expected at least 3")
        name = self.responses[self._numbered("response", response, self.responses)]
        asked = {"quantity": str(quantity), "response": name, "noise": float(noise), **options}
        return self._run("verify", Verification, asked, progress, arrays=np.ascontiguousarray([at, values]))

    def modes(self, count: Optional[int] = None, **options: Any) -> Table:
        """Natural frequencies and damping, contacts open and stuck; .tables["Contacts at rest"]."""
        return self._run("modes", Table, {"count": count, **options}, None)

    def advise(self, error: float = 1e-3, at: Any = None, progress: Optional[Progress] = None, **options: Any) -> Table:
        """The fewest harmonics and samples that keep an error, along the curve or at frequencies."""
        return self._run("advise", Table, {"error": float(error), "at": at, **options}, progress)

    def prove(self, at: Any = None, progress: Optional[Progress] = None, **options: Any) -> Table:
        """Certain bounds of the error of harmonic balance; needs hbmcheck-proof."""
        return self._run("prove", Table, {"at": at, **options}, progress)

    def gate(self, at: Any = None, progress: Optional[Progress] = None, **options: Any) -> Table:
        """Every check against the limits of the case; .exit_code 0: all within."""
        return self._run("gate", Table, {"at": at, **options}, progress)

    def reduce(self, folder: Union[str, os.PathLike], **options: Any) -> Table:
        """A small model of large sparse matrices, written to the folder, and its error; of a case file."""
        return self._run("reduce", Table, {"output": os.fspath(folder), **options}, None)

    def contact_force(self, u: Any = None, v: Any = None, u2: Any = None, *, contact: Union[int, str] = 0,
                      samples: Optional[int] = None, harmonics: int = 1) -> ContactForce:
        """Fourier coefficients of the forces of one contact, by name or number, under its own motion.

        u, v [2H+1] [length]: its tangential and normal motion, X0, a1, b1, a2, b2, ...; None: none; u2: the same along
        the second of two tangents. samples: per period, as an AFT takes them, >= 2H+1; None: exact. H is what the
        longest has, at least `harmonics`; shorter ones are filled up with zeros."""
        number = self._numbered("contact", contact, self.contacts)
        given = {name: finite(name, m) for name, m in (("u", u), ("u2", u2), ("v", v)) if m is not None}
        for name, m in given.items():
            if len(m) % 2 == 0:
                raise BadInput(f"{name}: {len(m)} coefficients, expected an odd number: X0, a1, b1, a2, b2, ...")
        longest = max([2 * int(harmonics) + 1, 3, *(len(m) for m in given.values())])
        if longest > 401:
            raise BadInput(f"{longest // 2} harmonics, expected at most 200")
        if samples is not None and not longest <= samples <= 1 << 24:
            raise BadInput(f"samples: {samples} for {longest // 2} harmonics, expected {longest} to {1 << 24}")
        options = [f"--contact={number}", *(f"--motion-{name}={_value(m)}" for name, m in given.items()),
                   f"--set=hbm.harmonics={longest // 2}", f"--set=hbm.force={'sampled' if samples else 'exact'}",
                   f"--set=hbm.samples={samples or 2 * longest}"]
        with self._owner as case:
            _, columns, *_ = ask(case, "contact", *options).tables[0]
        forces = {}
        for force in ("tangential", "tangential_2", "normal"):
            of = columns["force"] == force
            forces[force] = np.zeros(longest)
            forces[force][0], forces[force][1::2], forces[force][2::2] = columns["cos"][of][:1].sum(), *_pairs(columns, of, longest // 2)
        return ContactForce(forces["tangential"], forces["normal"], forces["tangential_2"] if "tangential_2" in columns["force"] else None)

    def _numbered(self, what, asked, names):
        """A part of the case by its name, or its number from 0."""
        if isinstance(asked, str) and asked in names:
            return names.index(asked)
        if not isinstance(asked, str) and 0 <= asked < len(names):
            return int(asked)
        raise BadInput(f"{what}: the case has no {asked!r}, expected one of {', '.join(names) or 'none'}")

    def __repr__(self) -> str:
        return f"<Model: {_listed('response', self.responses)}; {_listed('contact', self.contacts)}>"
