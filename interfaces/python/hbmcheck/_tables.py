"""Tables of the library as columns, and runs of its commands."""
import ctypes

import numpy as np

from . import _structs as structs
from ._library import check, lib, status_text

FILLED_UP = {"coefficients": 0.0}  # series that end early; others: NaN


def _listed(ask, handle):
    """Texts that the library has one after another."""
    found = []
    while (text := ask(handle, len(found))) is not None:
        found.append(text.decode(errors="replace"))
    return found


def _numbers(table, name, n, kind):
    column = np.empty(n)
    lib.table_numbers(table, -1, name, n, column.ctypes.data)
    return column.astype(int) if kind == structs.INTEGER and not np.isnan(column).any() else column


def _texts(table, name, n):
    return np.array([(lib.table_text(table, k, name) or b"").decode() for k in range(n)], dtype=str)


def _series(table, name, n):
    sizes = [lib.table_numbers(table, k, name, 0, None) for k in range(n)]
    found = np.full((n, max(sizes, default=0)), FILLED_UP.get(name.decode(), np.nan))
    for k, size in enumerate(sizes):
        lib.table_numbers(table, k, name, size, found[k:].ctypes.data)
    return found


def read(table):
    """(title, columns {name: array}, units, meanings, remarks) of a table of the library."""
    n, columns, units, meanings = lib.table_rows(table), {}, {}, {}
    column = structs.sized(structs.Column)
    while lib.table_column(table, len(columns), ctypes.byref(column)) == 0:
        kind, key = column.kind, column.name
        name = key.decode()
        columns[name] = (_texts(table, key, n) if kind == structs.TEXT else
                         _series(table, key, n) if kind == structs.SERIES else _numbers(table, key, n, kind))
        units[name], meanings[name] = column.unit.decode(), column.meaning.decode()
    return lib.table_title(table).decode(), columns, units, meanings, _listed(lib.table_remark, table)


class Found:
    """What a run found: tables as read() has them, remarks, exit_code, status and why the work ended early."""

    def __init__(self, status, result):
        self.status, self.tables, self.remarks, self.exit_code = status, [], [], 3
        if result:
            self.exit_code, self.remarks = lib.result_exit_code(result), _listed(lib.result_remark, result)
            while table := lib.result_table(result, len(self.tables)):
                self.tables.append(read(table))

    def words(self):
        return "\n".join(self.remarks) or status_text(self.status)


def run(case, command, options, monitor):
    """The Found of that command with options, texts."""
    place = ctypes.c_void_p()
    given = [o.encode(errors="surrogateescape") for o in options]
    status = lib.run(case, command.encode(), len(given), (ctypes.c_char_p * max(len(given), 1))(*given), monitor, ctypes.byref(place))
    try:
        return Found(status, place)
    finally:
        lib.result_free(place)


def ask(case, command, *options):
    """A run that nobody watches; its Found, or what it says as an exception."""
    found = run(case, command, options, None)
    check(found.status, found.words())
    return found
