"""What the library found, as tables: every column an array with one entry a row, rows as in the command's csv."""
from __future__ import annotations

import copy
import ctypes
import html
from typing import Any, Iterator, NamedTuple, Optional, Sequence

import numpy as np

from . import _structs as structs
from ._arrays import contact_words, omegas, rows, status_words, verdict_words
from ._library import check, lib

Array = np.ndarray


_STABLE = {1: "yes", -1: "no", 0: "unknown"}
_SHOWN = 60  # rows of a notebook's table


def _said(name, values):
    """A column in the words of the csv: flags and stability as yes and no."""
    if values.dtype == bool:
        return np.where(values, "yes", "no")
    return np.array([_STABLE[s] for s in values], dtype=str) if name == "stable" else values


class Table:
    """Columns of equal length. t.omega and t["omega"] are the same array; len(t) is the number of rows.

    t[2:5], t[t.omega > 6], t[[0, 3]]: a table of these rows (of a Curve, its Solutions), without .contacts. Tables can be
    pickled. pandas.DataFrame(t.rows()) has the columns and words of the command's csv, as has what a notebook shows.
    """

    csv: Sequence[str] = ()  # the command's columns that are first in rows(), in its order

    def __init__(self, columns: dict, responses: list) -> None:
        self.columns: dict[str, Array] = columns
        self.responses: list[str] = responses  # names of the model's responses; the column `response` counts in them

    def __getattr__(self, name: str) -> Array:
        columns = self.__dict__.get("columns", {})
        if name in columns:
            return columns[name]
        raise AttributeError(f"no column {name}, expected one of {', '.join(columns)}")

    def __getitem__(self, asked: Any) -> Any:
        return self.columns[asked] if isinstance(asked, str) else self._kept(np.arange(len(self))[asked])

    def _kept(self, rows):
        found = copy.copy(self)
        found.columns = {name: column[np.atleast_1d(rows)] for name, column in self.columns.items()}
        if found.__dict__.get("contacts") is not None:
            found.contacts = None
        return found

    def __dir__(self) -> list:
        return [*super().__dir__(), *self.columns]

    def __len__(self) -> int:
        return len(next(iter(self.columns.values())))

    def _names(self):
        """{column: its names}, of columns that count in names; no names: the csv has no such column."""
        return {"response": self.responses if self.responses != ["x"] else []}  # x: of an oscillator

    def _words(self):
        """Columns of one value a row, in the order and the words of the csv."""
        named = self._names()
        flat = [name for name, column in self.columns.items() if column.ndim == 1]
        for name in [*(n for n in self.csv if n in flat), *(n for n in flat if n not in self.csv)]:
            if named.get(name):
                yield name, np.array(named[name])[self.columns[name]]
            elif name not in named:
                yield name, _said(name, self.columns[name])

    def rows(self) -> Iterator[dict]:
        """Row by row, as {column: value}, in the columns and words of the command's csv, then what else there is: flags
        and `stable` as "yes", "no", "unknown", responses and contacts by name. Series ([rows, n]) are not among them."""
        said = dict(self._words())
        for k in range(len(self)):
            yield {name: column[k].item() for name, column in said.items()}

    def of(self, response: Any) -> Table:
        """The rows of one response, by its name or its number from 0."""
        if isinstance(response, str) and response not in self.responses:
            raise KeyError(f"no response {response}, expected one of {', '.join(self.responses)}")
        number = self.responses.index(response) if isinstance(response, str) else int(response)
        return self._kept(self.columns["response"] == number)

    def __repr__(self) -> str:
        return f"<{type(self).__name__}: {len(self)} rows of {', '.join(self.columns)}>"

    def _repr_html_(self) -> str:
        """What a notebook shows."""
        said = dict(self._words())
        head = "".join(f"<th>{html.escape(name)}</th>" for name in said)
        cells = ("".join(f"<td>{html.escape(_short(column[k].item()))}</td>" for column in said.values())
                 for k in range(min(len(self), _SHOWN)))
        body = "".join(f"<tr>{row}</tr>" for row in cells)
        more = f"<p>{len(self) - _SHOWN} more rows</p>" if len(self) > _SHOWN else ""
        return f"<table><thead><tr>{head}</tr></thead><tbody>{body}</tbody></table>{more}"


def _short(value):
    return f"{value:.7g}" if isinstance(value, float) else str(value)


class Contacts(Table):
    """What each contact does in each solution, steady state or row of a comparison.

    row (of the table whose .contacts this is, its first response's), omega [rad/time], branch (of solutions), contact (a
    number in .names), regime ("linear": never closed, "stick", "smooth", "slip", "separation"), normal_min, normal_max,
    traction_max [force], slip_distance [length], work [force length] dissipated in a period. Of a comparison the last six
    are there twice, as hbm_regime, ..., transient_regime, ..., with work_error, normal_error [1], compared, differs
    (bool), hbm_status, transient_status (words).
    """

    def __init__(self, columns: dict, names: list) -> None:
        super().__init__(columns, [])
        self.names: list[str] = names

    def _names(self):
        return {"contact": self.names}

    def of(self, contact: Any) -> Contacts:
        """The rows of one contact, by its name or its number from 0."""
        if isinstance(contact, str) and contact not in self.names:
            raise KeyError(f"no contact {contact}, expected one of {', '.join(self.names)}")
        return self._kept(self.columns["contact"] == (self.names.index(contact) if isinstance(contact, str) else int(contact)))


def _flat(found):
    """Columns of structs; those of a struct inside have its name before theirs."""
    columns = {}
    for name in found.dtype.names:
        inner = found[name].dtype.names
        columns.update({f"{name}_{n}": found[name][n] for n in inner} if inner else {name: found[name]})
    return columns


def contacts_of(kind, get, known, names):
    """Contacts of every row of the first response in `known`, its columns: get(k, cap, address, count) of row k."""
    n, count, parts, row = len(names), ctypes.c_int(), [], []
    place = (kind * max(n, 1))()
    for k in np.flatnonzero(known["response"] == 0):
        check(get(int(k), n, ctypes.addressof(place), ctypes.byref(count)))
        parts.append(np.frombuffer(bytes(place), dtype=np.dtype(kind), count=count.value))
        row += [k] * count.value
    found = _flat(np.concatenate([np.empty(0, dtype=np.dtype(kind)), *parts]))
    for name in found:
        if name.endswith("regime"):
            found[name] = contact_words(found[name])
        elif name.endswith("status"):
            found[name] = status_words(found[name])
        elif name in ("compared", "differs"):
            found[name] = found[name] != 0
    shared = {name: known[name][row] for name in ("omega", "branch") if name in known}
    at = {"row": np.array(row, dtype=int), **shared, "contact": np.tile(np.arange(n), len(row) // max(n, 1))}
    return Contacts({**at, **{name: np.ascontiguousarray(column) for name, column in found.items()}}, names)


def curve_contacts(curve, handle, found, names):
    """Of every solution of `handle`, which lie on `curve` and are the columns `found`."""
    m = max(int(found["response"].max(initial=0)) + 1, 1)
    return contacts_of(structs.ContactPeriod, lambda k, *a: lib.curve_contacts(curve, handle, k // m, *a), found, names)


def solution_columns(handle, responses):
    """Columns of a hbmcheck_solutions: its solutions, of each every response."""
    n, m = lib.solutions_count(handle), len(responses)
    found = rows(structs.Solution, n * m, lambda k, at: lib.solutions_get_response(handle, k // m, k % m, at))
    length = 2 * int(found["harmonics"].max(initial=0)) + 1
    series, count = np.zeros((n * m, length)), ctypes.c_int()
    for k in range(n * m):
        at = series.ctypes.data + k * length * series.itemsize
        check(lib.solutions_response_coefficients(handle, k // m, k % m, length, at, ctypes.byref(count)))
    found["contact"] = contact_words(found["contact"])
    found["mean_free"] = found["mean_free"] != 0
    return {**found, "response": np.tile(np.arange(m), n), "coefficients": series}


class Solutions(Table):
    """Solutions of harmonic balance, in the order of the curve they lie on; of a structure a row for each response.

    omega [rad/time], amplitude, max, min, rms, mean, harmonic_1 [length], multiplier, residual [1], stable (1, -1; 0
    unknown), branch, harmonics, iterations, contact ("linear", "stick", "smooth", "slip", "separation"), mean_free (bool),
    response (a number in .responses), coefficients [rows, 2H+1] [length]: X0, a1, b1, a2, b2, ...

    contacts: what each does there, by the exact law, or None: not asked for.
    """

    csv = "omega branch response amplitude max min rms mean harmonic_1 stable multiplier contact iterations residual mean_free".split()
    contacts: Optional[Contacts] = None


class Curve(Solutions):
    """A response curve, with the means to search it again. Copies, parts and pickles of it are Solutions."""

    def __init__(self, owner: Any, columns: dict, responses: list, names: list, contacts: bool = False) -> None:
        super().__init__(columns, responses)
        self._owner, self._contacts = owner, names  # the owner of the hbmcheck_curve, the contacts' names
        if contacts:
            with owner as curve:
                self.contacts = curve_contacts(curve, lib.curve_points(curve), columns, names)

    def __reduce__(self) -> tuple:
        return Solutions, (self.columns, self.responses), {"contacts": self.contacts}

    def at(self, omega: Any, contacts: bool = False) -> Solutions:
        """Every solution on the curve at omega, a number or [n] [rad/time] > 0, each solved for; contacts: with what each
        contact does there.

        Stopped: beyond where the curve ends; .result has the solutions that are known."""
        parts, acting, wrong, known = [], [], None, 0
        for one in omegas("omega", omega):
            with self._owner as curve:
                place = ctypes.c_void_p()
                status = lib.curve_at(curve, one, ctypes.byref(place))
                try:
                    if place:
                        parts.append(solution_columns(place, self.responses))
                        acting += [curve_contacts(curve, place, parts[-1], self._contacts)] if contacts else []
                finally:
                    lib.solutions_free(place)
            if contacts and place:
                acting[-1].columns["row"] += known
                known += len(parts[-1]["omega"])
            wrong = wrong or status
        found = Solutions(_joined(parts) if parts else _none_of(self), self.responses)
        if acting:
            found.contacts = Contacts({name: np.concatenate([a[name] for a in acting]) for name in acting[0].columns}, self._contacts)
        check(wrong or 0, result=found)
        return found

    @property
    def special_points(self) -> Table:
        """Where the curve changes its nature: omega [rad/time], amplitude [length], branch, kind ("turning point",
        "period doubling", "contact change", "Neimark-Sacker", "symmetry breaking"), before and after (as contact)."""
        n = ctypes.c_int()
        with self._owner as curve:
            check(lib.curve_specials(curve, 0, None, ctypes.byref(n)))
            table = (structs.Special * max(n.value, 1))()
            check(lib.curve_specials(curve, n.value, ctypes.addressof(table), ctypes.byref(n)))
        size = ctypes.sizeof(structs.Special)
        found = rows(structs.Special, n.value, lambda k, at: ctypes.memmove(at, ctypes.addressof(table) + k * size, size) * 0)
        kinds = np.array(["turning point", "period doubling", "contact change", "Neimark-Sacker", "symmetry breaking"])
        return Table({**found, "kind": kinds[found["kind"]], "before": contact_words(found["before"]),
                      "after": contact_words(found["after"])}, self.responses)

    @property
    def summary(self) -> dict:
        """The whole curve in a few numbers: peak_omega, peak_amplitude, points, turning_points, harmonics, ..."""
        found = structs.Summary()
        with self._owner as curve:
            check(lib.curve_summary(curve, ctypes.byref(found)))
        return {name: getattr(found, name) for name, _ in found._fields_}

    def plot(self, axes: Any = None, response: Any = 0) -> Any:
        """Amplitude over omega, unstable parts dashed; needs matplotlib. The axes."""
        from . import plot

        return plot.curve(self.of(response), axes)


def _joined(parts):
    """Tables one below another; series of fewer harmonics are filled up with zeros."""
    most = max(p["coefficients"].shape[1] for p in parts)
    for p in parts:
        p["coefficients"] = np.pad(p["coefficients"], ((0, 0), (0, most - p["coefficients"].shape[1])))
    return {name: np.concatenate([p[name] for p in parts]) for name in parts[0]}


def _none_of(table):
    return {name: column[:0] for name, column in table.columns.items()}


class Transient(Table):
    """Steady states by time integration; of a structure a row for each response.

    status (words, "ok": settled), without_hbm, omega [rad/time], amplitude, max, min, rms, mean, harmonic_1 [length],
    closure, multiplier, from_regularisation [1], stable (1, -1; 0 unknown), period_multiple, periods, steps,
    free_sliders, left_orbit (bool), response, contact; wave [rows, n] [length]: x at i/n of the last period from the
    forcing's maximum on, NaN where there are no measures.

    contacts: what each does, by the law that was integrated, or None: not asked for.
    """

    csv = ("omega response amplitude max min rms mean harmonic_1 periods closure period_multiple steps contact multiplier "
           "free_sliders from_regularisation").split()
    contacts: Optional[Contacts] = None


def transient_of(handle, responses, names):
    """names: of the contacts, None: not asked for."""
    n, count = lib.transient_count(handle), ctypes.c_int()
    found = rows(structs.Steady, n, lambda k, at: lib.transient_get(handle, k, at))
    sizes = []
    for k in range(n):
        check(lib.transient_wave(handle, k, 0, None, ctypes.byref(count)))
        sizes.append(count.value)
    wave = np.full((n, max(sizes, default=0)), np.nan)
    for k in range(n):
        at = wave.ctypes.data + k * wave.shape[1] * wave.itemsize
        check(lib.transient_wave(handle, k, sizes[k], at if sizes[k] else None, ctypes.byref(count)))
    for name in ("status", "without_hbm"):
        found[name] = status_words(found[name])
    found["contact"] = contact_words(found["contact"])
    found["left_orbit"] = found["left_orbit"] != 0
    result = Transient({**found, "wave": wave}, responses)
    if names is not None:
        result.contacts = contacts_of(structs.ContactPeriod, lambda k, *a: lib.transient_contacts(handle, k, *a), found, names)
    return result


class Comparison(Table):
    """Both sides at the same frequencies; a row for each frequency, solution of harmonic balance, and response.

    omega [rad/time], verdict ("match", "differs", "other_branch", "unstable", "period_k", "aperiodic", "not_settled",
    "solver_failed", "unbounded", "creeps", "undecided"), hbm_amplitude, transient_amplitude, orbit_amplitude [length], amplitude_error, harmonic_1_error,
    mean_error, waveform_error, orbit_error, from_aliasing, from_truncation, from_regularisation, from_integration,
    from_settling, hbm_predicted, transient_predicted [1], branch, stable, period_multiple, response, unexpected,
    mean_free, still, family, accounted (bool), hbm_status, transient_status, orbit_status (words).

    exit_code: of `hbmcheck compare`, 0: both sides agree. gate: `hbmcheck gate` in numbers, or None. contacts: what each
    does on both sides, or None: not asked for.
    """

    csv = ("omega branch response verdict hbm_amplitude transient_amplitude amplitude_error harmonic_1_error mean_error "
           "waveform_error from_aliasing from_truncation from_regularisation from_integration from_settling "
           "orbit_amplitude orbit_error hbm_predicted transient_predicted unexpected mean_free").split()
    contacts: Optional[Contacts] = None
    exit_code: int
    gate: Optional[dict]

    def plot(self, axes: Any = None, response: Any = 0) -> Any:
        """Amplitudes of both sides over omega; needs matplotlib. The axes."""
        from . import plot

        return plot.comparison(self.of(response), axes)


def comparison_of(handle, responses, names):
    """names: of the contacts, None: not asked for."""
    found = rows(structs.Row, lib.comparison_count(handle), lambda k, at: lib.comparison_get(handle, k, at))
    found["verdict"] = verdict_words(found["verdict"])
    for name in ("hbm_status", "transient_status", "orbit_status"):
        found[name] = status_words(found[name])
    for name in ("accounted", "unexpected", "mean_free", "still", "family"):
        found[name] = found[name] != 0
    result, gate = Comparison(found, responses), structs.Gate()
    if names is not None:
        result.contacts = contacts_of(structs.ContactRow, lambda k, *a: lib.comparison_contacts(handle, k, *a), found, names)
    result.exit_code = lib.comparison_exit_code(handle)
    judged = lib.comparison_gate(handle, ctypes.byref(gate)) == 0
    result.gate = {name: getattr(gate, name) for name, _ in gate._fields_} if judged else None
    return result


class Verification(Table):
    """Another program's curve, point by point, and what came of it.

    omega [rad/time], value, nearest (in the quantity's unit; NaN: there is no solution), error [1], verdict, index (in
    the arrays handed in), branch, stable, skipped (bool).

    cause: in one word, "none" where every point is right, "unknown" where no cause is sure. guess: the nearest where
    none is sure. sentence: the cause, what fits, and the remedy. exit_code: of `hbmcheck verify`. findings: counts and
    distances, as in struct hbmcheck_findings. hypotheses: the mistakes that were tried, the best first, a table of cause,
    distance, omega_factor, value_factor [1], harmonics (0: linear), keep_mean (bool), samples (0: exact forces),
    slider_restart ("", "sample", "interpolated"), quantity.
    """

    cause: str
    guess: str
    sentence: str
    exit_code: int
    findings: dict
    hypotheses: Table

    def __str__(self) -> str:
        return f"{self.cause}: {self.sentence}"

    def plot(self, axes: Any = None) -> Any:
        """The points by verdict over the nearest solutions; needs matplotlib. The axes."""
        from . import plot

        return plot.verification(self, axes)


def verification_of(handle, responses):
    found = rows(structs.Point, lib.verification_count(handle), lambda k, at: lib.verification_get(handle, k, at))
    found["verdict"] = verdict_words(found["verdict"])
    found["skipped"] = found["skipped"] != 0
    result, whole = Verification(found, responses), structs.Findings()
    check(lib.verification_findings(handle, ctypes.byref(whole)))
    result.cause = lib.verification_cause(handle).decode()
    result.guess = lib.verification_guess(handle).decode()
    result.sentence = lib.verification_sentence(handle).decode()
    result.findings = {name: getattr(whole, name) for name, _ in whole._fields_}
    result.exit_code = whole.exit_code
    result.hypotheses = hypotheses_of(handle)
    return result


def hypotheses_of(handle):
    n = lib.verification_hypotheses(handle)
    found = rows(structs.Hypothesis, n, lambda k, at: lib.verification_hypothesis(handle, k, at))
    cause, quantity, texts = ctypes.create_string_buffer(1024), ctypes.create_string_buffer(48), []
    for k in range(n):
        check(lib.verification_hypothesis_text(handle, k, cause, 1024, quantity, 48))
        texts.append((cause.value.decode(), quantity.value.decode()))
    restart = np.where(found["slider_restart"] != 0, "interpolated", "sample")
    found["slider_restart"] = np.where(found["samples"] > 0, restart, "")
    found["keep_mean"] = found["keep_mean"] != 0
    named = {"cause": np.array([t[0] for t in texts], dtype=str), "quantity": np.array([t[1] for t in texts], dtype=str)}
    return Table({**named, **found}, [])


class ContactForce(NamedTuple):
    """Fourier coefficients [2H+1] [force], X0, a1, b1, a2, b2, ...: tangential T, normal N with the preload; T2 of a
    contact with two tangents, else None."""

    T: Array
    N: Array
    T2: Optional[Array] = None
