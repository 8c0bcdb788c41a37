"""What the library found, as tables: every column an array with one entry a row, rows as in the command's csv."""
from __future__ import annotations

import ctypes
from typing import Any, Iterator, NamedTuple, Optional

import numpy as np

from . import _structs as structs
from ._arrays import contact_words, omegas, rows, status_words, verdict_words
from ._library import check, lib

Array = np.ndarray


class Table:
    """Columns of equal length. t.omega and t["omega"] are the same array; len(t) is the number of rows."""

    def __init__(self, columns: dict, responses: list) -> None:
        self.columns: dict[str, Array] = columns
        self.responses: list[str] = responses  # names of the model's responses; the column `response` counts in them

    def __getattr__(self, name: str) -> Array:
        columns = self.__dict__.get("columns", {})
        if name in columns:
            return columns[name]
        raise AttributeError(f"no column {name}, expected one of {', '.join(columns)}")

    def __getitem__(self, name: str) -> Array:
        return self.columns[name]

    def __dir__(self) -> list:
        return [*super().__dir__(), *self.columns]

    def __len__(self) -> int:
        return len(next(iter(self.columns.values())))

    def rows(self) -> Iterator[dict]:
        """Row by row, as {column: value}."""
        for k in range(len(self)):
            yield {name: column[k] for name, column in self.columns.items()}

    def of(self, response: Any) -> Table:
        """The rows of one response, by its name or its number from 0."""
        if isinstance(response, str) and response not in self.responses:
            raise KeyError(f"no response {response}, expected one of {', '.join(self.responses)}")
        number = self.responses.index(response) if isinstance(response, str) else int(response)
        kept = self.columns["response"] == number
        return Table({name: column[kept] for name, column in self.columns.items()}, self.responses)

    def __repr__(self) -> str:
        return f"<{type(self).__name__}: {len(self)} rows of {', '.join(self.columns)}>"


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
    unknown), branch, harmonics, iterations, contact ("linear", "stick", "slip", "separation"), mean_free (bool),
    response (a number in .responses), coefficients [rows, 2H+1] [length]: X0, a1, b1, a2, b2, ...
    """


class Curve(Solutions):
    """A response curve, with the means to search it again."""

    def __init__(self, owner: Any, columns: dict, responses: list) -> None:
        super().__init__(columns, responses)
        self._owner = owner  # of the hbmcheck_curve

    def at(self, omega: Any) -> Solutions:
        """Every solution on the curve at omega, a number or [n] [rad/time] > 0, each solved for.

        Stopped: beyond where the curve ends; .result has the solutions that are known."""
        parts, wrong = [], None
        for one in omegas("omega", omega):
            with self._owner as curve:
                place = ctypes.c_void_p()
                status = lib.curve_at(curve, one, ctypes.byref(place))
                parts.append(solution_columns(place, self.responses) if place else None)
                lib.solutions_free(place)
            wrong = wrong or status
        found = Solutions(_joined([p for p in parts if p]) if any(parts) else _none_of(self), self.responses)
        check(wrong or 0, result=found)
        return found

    @property
    def special_points(self) -> Table:
        """Where the curve changes its nature: omega [rad/time], amplitude [length], branch, kind ("turning point",
        "period doubling", "contact change", "Neimark-Sacker"), before and after (as contact)."""
        n = ctypes.c_int()
        with self._owner as curve:
            check(lib.curve_specials(curve, 0, None, ctypes.byref(n)))
            table = (structs.Special * max(n.value, 1))()
            check(lib.curve_specials(curve, n.value, ctypes.addressof(table), ctypes.byref(n)))
        size = ctypes.sizeof(structs.Special)
        found = rows(structs.Special, n.value, lambda k, at: ctypes.memmove(at, ctypes.addressof(table) + k * size, size) * 0)
        kinds = np.array(["turning point", "period doubling", "contact change", "Neimark-Sacker"])
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
    """


def transient_of(handle, responses):
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
    return Transient({**found, "wave": wave}, responses)


class Comparison(Table):
    """Both sides at the same frequencies; a row for each frequency, solution of harmonic balance, and response.

    omega [rad/time], verdict ("match", "differs", "other_branch", "unstable", "period_k", "aperiodic", "not_settled",
    "solver_failed"), hbm_amplitude, transient_amplitude, orbit_amplitude [length], amplitude_error, harmonic_1_error,
    mean_error, waveform_error, orbit_error, from_aliasing, from_truncation, from_regularisation, from_integration,
    from_settling, hbm_predicted, transient_predicted [1], branch, stable, period_multiple, response, unexpected,
    mean_free, still, family, accounted (bool), hbm_status, transient_status, orbit_status (words).

    exit_code: of `hbmcheck compare`, 0: both sides agree. gate: `hbmcheck gate` in numbers, or None.
    """

    exit_code: int
    gate: Optional[dict]

    def plot(self, axes: Any = None, response: Any = 0) -> Any:
        """Amplitudes of both sides over omega; needs matplotlib. The axes."""
        from . import plot

        return plot.comparison(self.of(response), axes)


def comparison_of(handle, responses):
    found = rows(structs.Row, lib.comparison_count(handle), lambda k, at: lib.comparison_get(handle, k, at))
    found["verdict"] = verdict_words(found["verdict"])
    for name in ("hbm_status", "transient_status", "orbit_status"):
        found[name] = status_words(found[name])
    for name in ("accounted", "unexpected", "mean_free", "still", "family"):
        found[name] = found[name] != 0
    result, gate = Comparison(found, responses), structs.Gate()
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
    distances, as in struct hbmcheck_findings.
    """

    cause: str
    guess: str
    sentence: str
    exit_code: int
    findings: dict

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
    return result


class ContactForce(NamedTuple):
    """Fourier coefficients [2H+1] [force], X0, a1, b1, a2, b2, ...: tangential T, normal N with the preload; T2 of a
    contact with two tangents, else None."""

    T: Array
    N: Array
    T2: Optional[Array] = None
