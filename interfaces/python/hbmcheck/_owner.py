"""A handle of the library with one user at a time, freed once."""
import threading
import weakref


def _free_if_any(box, free):
    handle, box[0] = box[0], None
    if handle is not None:
        free(handle)


class Owner:
    """`with owner as handle:` - the handle, alone in this thread until the end. ValueError after close()."""

    def __init__(self, handle, free, what):
        self._box, self._what, self._lock = [handle], what, threading.RLock()
        self._finalize = weakref.finalize(self, _free_if_any, self._box, free)
        self._users = 0

    def __enter__(self):
        self._lock.acquire()
        if self._box[0] is None:
            self._lock.release()
            raise ValueError(f"{self._what} is closed")
        self._users += 1
        return self._box[0]

    def __exit__(self, *_):
        self._users -= 1
        self._lock.release()

    def close(self):
        """Free it, after those who use it. Not from inside their progress."""
        with self._lock:
            if self._users:
                raise ValueError(f"{self._what} is in use")
            self._finalize()
