"""test_cost.py - what a call costs beside the library's work, and that it keeps nothing."""
import ctypes
import gc
import resource
import time

from common import CASE2, Test, main, np

import hbmcheck
from hbmcheck._library import lib

MOST = 1e-3   # [s] processor time of a call over that of the library
MANY = 20000
ALLOWED = 1 << 20  # bytes: 52 a call; a forgotten struct or array of the smallest size here would be 100


def seconds_each(work, n):
    """Processor time of this thread a call: the best of five, for nobody else's part is in it."""
    best = np.inf
    for _ in range(5):
        start = time.thread_time()
        for _ in range(n):
            work()
        best = min(best, (time.thread_time() - start) / n)
    return best


def resident():
    with open("/proc/self/statm", encoding="ascii") as statm:
        return int(statm.read().split()[1]) * resource.getpagesize()


class Cost(Test):
    def bare(self, model, command, *options):
        """The library's part: a run whose tables are not read."""
        def run():
            place = ctypes.c_void_p()
            given = [o.encode() for o in options]
            with model._owner as case:
                lib.run(case, command.encode(), len(given), (ctypes.c_char_p * max(len(given), 1))(*given), None, ctypes.byref(place))
            lib.result_free(place)

        return run

    def test_a_contact_force(self):
        model, u, v = hbmcheck.Model.from_yaml(CASE2), np.array([0, 8.0, 0]), np.zeros(3)
        bare = seconds_each(self.bare(model, "contact", "--contact=0", "--motion-u=0,8,0", "--motion-v=0,0,0", "--set=hbm.harmonics=1"), 200)
        cost = seconds_each(lambda: model.contact_force(u, v), 200) - bare
        print(f"contact_force: {cost * 1e6:.0f} us beside the library's {bare * 1e6:.0f}")
        self.assertLess(cost, MOST)

    def test_a_curve(self):
        model = hbmcheck.Model.from_yaml(CASE2, set={"sweep.omega": [3, 4], "hbm.harmonics": 1})
        bare = seconds_each(self.bare(model, "frf"), 20)
        cost = seconds_each(model.frf, 20) - bare
        print(f"frf of {len(model.frf())} points: {cost * 1e6:.0f} us beside the library's {bare * 1e6:.0f}")
        self.assertLess(cost, MOST)

    def test_nothing_is_kept(self):
        model, u, v = hbmcheck.Model.from_yaml(CASE2), [0, 8.0, 0], [0, 0, 0]

        def repeat(n):
            for i in range(n):
                model.contact_force(u, v)
                if i % 100 == 0:
                    self.assertRaises(hbmcheck.BadInput, model.contact_force, [1, 2])
                    hbmcheck.Model.from_yaml(CASE2)
            gc.collect()

        repeat(2000)  # what is made once is made
        before = resident()
        repeat(MANY)
        grown = resident() - before
        print(f"{MANY} calls: {grown} bytes")
        self.assertLess(grown, ALLOWED)

    def test_no_result_is_kept(self):
        model = hbmcheck.Model.from_yaml(CASE2, set={"sweep.omega": [3, 3.2], "hbm.harmonics": 1})

        def repeat(n):
            for _ in range(n):
                model.frf()
                model.frf(progress=lambda done: None, at=3.1)
            gc.collect()

        repeat(200)
        before = resident()
        repeat(3000)
        grown = resident() - before
        print(f"6000 curves: {grown} bytes")
        self.assertLess(grown, ALLOWED)


if __name__ == "__main__":
    main()
