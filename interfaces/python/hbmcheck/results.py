"""What the library found, as tables: every column an array with one entry a row, names and rows as in the command's csv."""
from __future__ import annotations

import copy
import html
from typing import Any, Iterator, NamedTuple, Optional

import numpy as np

Array = np.ndarray

_SHOWN = 60  # rows of a notebook's table


class Table:
    """Columns of equal length. t.omega and t["omega"] are the same array; len(t) is the number of rows.

    Names are those of docs/interface.md, section 3; .units and .meanings say what each is, .notes what stands below the
    table. What is not there is NaN, or "" among texts. t[2:5], t[t.omega > 6], t[[0, 3]]: a table of these rows, without
    .contacts. Tables can be pickled; pandas.DataFrame(t.rows()) has the columns of the command's csv, then those that are
    for programs.

    .tables: all tables of the run by title, this one among them; .remarks: what the command says on standard error;
    .exit_code: what it exits with.
    """

    def __init__(self, columns: dict, responses: Optional[list] = None, title: str = "", units: Optional[dict] = None,
                 meanings: Optional[dict] = None, notes: Optional[list] = None) -> None:
        self.columns: dict[str, Array] = columns
        self.responses: list[str] = responses or []  # names of the model's responses
        self.title, self.units, self.meanings, self.notes = title, units or {}, meanings or {}, notes or []
        self.tables: dict[str, Table] = {}
        self.remarks: list[str] = []
        self.exit_code = 0

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
        return len(next(iter(self.columns.values()), ()))

    def _flat(self):
        """Columns of one value a row."""
        return {name: column for name, column in self.columns.items() if column.ndim == 1}

    def rows(self) -> Iterator[dict]:
        """Row by row, as {column: value}, in the columns and words of the command's csv, then what else there is. Series
        ([rows, n]) are not among them."""
        said = self._flat()
        for k in range(len(self)):
            yield {name: column[k].item() for name, column in said.items()}

    def of(self, response: Any) -> Table:
        """The rows of one response, by its name or its number from 0."""
        names = self.responses
        if isinstance(response, str) and response not in names:
            raise KeyError(f"no response {response}, expected one of {', '.join(names)}")
        name = response if isinstance(response, str) else names[response]
        return self._kept(self.columns["response"] == name if "response" in self.columns else np.full(len(self), True))

    def __repr__(self) -> str:
        return f"<{type(self).__name__}: {len(self)} rows of {', '.join(self.columns)}>"

    def _repr_html_(self) -> str:
        """What a notebook shows."""
        said = self._flat()
        head = "".join(f'<th title="{html.escape(self.meanings.get(name, ""))}">{html.escape(name)}</th>' for name in said)
        cells = ("".join(f"<td>{html.escape(_short(column[k].item()))}</td>" for column in said.values())
                 for k in range(min(len(self), _SHOWN)))
        body = "".join(f"<tr>{row}</tr>" for row in cells)
        more = f"<p>{len(self) - _SHOWN} more rows</p>" if len(self) > _SHOWN else ""
        return f"<table><thead><tr>{head}</tr></thead><tbody>{body}</tbody></table>{more}"


def _short(value):
    return f"{value:.7g}" if isinstance(value, float) else str(value)


class Contacts(Table):
    """What each contact does in each solution, steady state or row of a comparison, and `row`: where that stands in the
    table whose .contacts this is (its first response)."""

    names: list  # of the contacts; the column `contact` counts in them

    def of(self, contact: Any) -> Contacts:
        """The rows of one contact, by its name or its number from 0."""
        if isinstance(contact, str) and contact not in self.names:
            raise KeyError(f"no contact {contact}, expected one of {', '.join(self.names)}")
        return self._kept(self.columns["contact"] == (self.names.index(contact) if isinstance(contact, str) else int(contact)))


def place(contacts, table):
    """The column `row` of contacts: they stand in blocks, one for each of its solutions that has some, in the same order."""
    first = table.columns["response"] == table.columns["response"][0] if "response" in table.columns and len(table) else slice(None)
    rows, keys = np.arange(len(table))[first], [k for k in ("omega", "branch", "start") if k in table.columns and k in contacts.columns]
    n, at, found = len(contacts.names), 0, []
    for row in rows:
        if at < len(contacts) and all(contacts.columns[k][at] == table.columns[k][row] for k in keys):
            found += [row] * n
            at += n
    contacts.columns = {"row": np.array(found, dtype=int), **contacts.columns}


class Solutions(Table):
    """Solutions of harmonic balance; of a structure a row for each response.

    omega, amplitude, ..., stable ("yes", "no", "unknown"), as in the csv; harmonics; coefficients [rows, 2H+1] [length]:
    X0, a1, b1, a2, b2, ...
    contacts: what each does there, by the exact law, or None: not asked for.
    """

    contacts: Optional[Contacts] = None

    def wave(self, n: int = 512) -> Array:
        """[rows, n] [length]: x at i/n of a period, from the forcing's maximum on."""
        X = self.columns["coefficients"]
        angle = 2 * np.pi * np.outer(np.arange(1, X.shape[1] // 2 + 1), np.arange(n)) / n
        return X[:, :1] + X[:, 1::2] @ np.cos(angle) + X[:, 2::2] @ np.sin(angle)


class Curve(Solutions):
    """A response curve, with the means to search it again."""

    _made: tuple  # what makes its model

    def at(self, omega: Any, contacts: bool = False) -> Solutions:
        """Every solution on the curve at omega, a number or [n] [rad/time] > 0, each solved for, as Model.frf(at=omega).

        Stopped: beyond where the curve ends; .result has the solutions that are known."""
        make, given = self._made
        with make(*given) as model:
            return model.frf(at=omega, contacts=contacts)

    @property
    def special_points(self) -> Table:
        """Where the curve changes its nature: omega, omega_error [rad/time], amplitude [length], branch, kind ("turning
        point", "period doubling", "contact change", "Neimark-Sacker", "symmetry breaking"), before and after (as contact)."""
        return self.tables["Special points"]

    @property
    def summary(self) -> dict:
        """The whole curve in a few numbers: peak_omega, peak_amplitude, points, turning_points, harmonics, ..."""
        return next(self.tables["Curve"].rows(), {})

    def plot(self, axes: Any = None, response: Any = 0) -> Any:
        """Amplitude over omega, unstable parts dashed; needs matplotlib. The axes."""
        from . import plot

        return plot.curve(self.of(response), axes)


class Transient(Table):
    """Steady states by time integration; of a structure a row for each response.

    The csv's columns; status (in words, "ok": settled), without_hbm, stable, left_orbit; wave [rows, n] [length]: x at i/n
    of the last period from the forcing's maximum on, NaN where there are no measures.
    contacts: what each does, by the law that was integrated, or None: not asked for.
    """

    contacts: Optional[Contacts] = None

    def plot(self, axes: Any = None, response: Any = 0) -> Any:
        """Amplitude over omega by verdict; needs matplotlib. The axes."""
        from . import plot

        return plot.transient(self.of(response), axes)


class Comparison(Table):
    """Both sides at the same frequencies; a row for each frequency, solution of harmonic balance, and response.

    The csv's columns; stable, multiplier, period_multiple, accounted, still, family, hbm_status, ... beside.
    gate: `hbmcheck gate` in numbers, or None. contacts: what each does on both sides, or None: not asked for.
    """

    contacts: Optional[Contacts] = None

    @property
    def gate(self) -> Optional[dict]:
        return next(self.tables["Gate"].rows(), None) if "Gate" in self.tables else None

    def plot(self, axes: Any = None, response: Any = 0) -> Any:
        """Amplitudes of both sides over omega; needs matplotlib. The axes."""
        from . import plot

        return plot.comparison(self.of(response), axes)


class Verification(Table):
    """Another program's curve, point by point, and what came of it: omega, value, nearest (NaN: there is no solution),
    branch, stable, error, verdict, line (the point's number from 1).

    cause: in one word, "none" where every point is right, "unknown" where no cause is sure. guess: the nearest where
    none is sure. sentence: the cause, what fits, and the remedy. findings: counts and distances. hypotheses: the mistakes
    that were tried, the best first.
    """

    @property
    def findings(self) -> dict:
        return next(self.tables["Summary"].rows(), {}) if "Summary" in self.tables else {}

    @property
    def cause(self) -> str:
        return self.findings.get("cause", "")

    @property
    def guess(self) -> str:
        return self.findings.get("nearest_guess") or "none"

    @property
    def sentence(self) -> str:
        return self.findings.get("sentence", "")

    @property
    def hypotheses(self) -> Table:
        return self.tables.get("Hypotheses") or Table({})

    def __str__(self) -> str:
        return f"{self.cause}: {self.sentence}"

    def plot(self, axes: Any = None) -> Any:
        """The points by verdict over the nearest solutions; needs matplotlib. The axes."""
        from . import plot

        return plot.verification(self, axes)


class ContactForce(NamedTuple):
    """Fourier coefficients [2H+1] [force], X0, a1, b1, a2, b2, ...: tangential T (zeros without a tangent), normal N with
    the preload; T2 of a contact with two tangents, else None."""

    T: Array
    N: Array
    T2: Optional[Array] = None
