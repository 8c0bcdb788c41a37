"""Progress, Ctrl-C and exceptions, through the library's monitor.

The library's work is done without the interpreter's lock; each tick takes it for a moment. Nothing may be thrown through C,
and what a signal's handler raises at the entry of a callback is lost in ctypes. So while the work goes on in the main
thread, handlers of signals wait: the next tick calls them where an exception can be kept, tells the work to stop, and
check() raises it."""
import signal
import threading
from ctypes import byref

from . import _structs as structs
from ._library import check


def _handlers():
    """{signal: handler} of those that Python would call."""
    found = {number: signal.getsignal(number) for number in signal.valid_signals()}
    return {number: handler for number, handler in found.items() if callable(handler)}


class Watch:
    """What one piece of work is watched by:

        with watch:
            status = call(..., watch.monitor, ...)
        watch.check(status, ...)
    """

    def __init__(self, progress=None):
        if progress is not None and not callable(progress):
            raise TypeError(f"progress: {type(progress).__name__} is not callable, expected a function of one number")
        self._progress, self._raised = progress, None
        self._handlers, self._waiting = {}, []
        self._keep = structs.sized(structs.Monitor, structs.TICK(self._tick), None)
        self.monitor = byref(self._keep)

    def __enter__(self):
        if threading.current_thread() is threading.main_thread():
            self._handlers = _handlers()
            self._wait = lambda *signalled: self._waiting.append(signalled)
            for number in self._handlers:
                signal.signal(number, self._wait)

    def __exit__(self, *_):
        for number, handler in self._handlers.items():
            if signal.getsignal(number) is self._wait:  # not another that progress has set
                signal.signal(number, handler)

    def _handle(self):
        """What the handlers of the signals that came would have done."""
        while self._waiting:
            number, frame = self._waiting.pop(0)
            self._handlers[number](number, frame)

    def _tick(self, _, done):
        try:
            self._handle()
            go_on = self._progress(done if done >= 0 else None) if self._progress else True
            return 0 if go_on is False or self._raised else 1
        except BaseException as raised:  # KeyboardInterrupt, too: check() raises it again
            self._raised = self._raised or raised
            return 0

    def check(self, status, words="", result=None):
        """Raise what was raised while the work went on, or what its status says."""
        self._keep.tick = structs.TICK()  # no circle is left for the collector: self is freed with the call
        self._wait = None
        if self._raised is not None:
            raised, self._raised = self._raised, None
            raise raised
        self._handle()  # those that came after the last tick
        check(status, words, result)
