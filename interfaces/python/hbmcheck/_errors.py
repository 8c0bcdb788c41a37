"""What goes wrong, as exceptions with the library's words."""
from typing import Any


class Error(Exception):
    """Something went wrong; its text is the library's. The base of all others here."""


class BadInput(Error, ValueError):
    """A case file or an argument is wrong: FILE:LINE:COLUMN, what is wrong, and what was expected."""


class MissingFile(Error, FileNotFoundError):
    """There is no such file."""


class Stopped(Error, RuntimeError):
    """The work could not be finished.

    result: what was found until then, of the type that the method returns, or None.
    """

    def __init__(self, words: str, result: Any = None) -> None:
        super().__init__(words)
        self.result = result


class Interrupted(Stopped):
    """progress answered False. (Ctrl-C is KeyboardInterrupt, and an exception in progress is that exception.)"""
