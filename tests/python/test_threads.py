"""test_threads.py - progress, Ctrl-C, exceptions on the way through the library, and threads."""
import os
import signal
import threading
import time

from common import CASE2, Test, main, np

import hbmcheck

LONG = {"compare.omega": list(np.linspace(3, 20, 40))}  # seconds of time integration


class Progress(Test):
    def test_it_is_told_and_goes_on(self):
        heard = []
        model = hbmcheck.Model.from_yaml(CASE2)
        found = model.transient([6, 8], progress=heard.append)  # answers None: go on
        self.assertTrue(heard)
        self.assertTrue(all(done is None or 0 <= done <= 1 for done in heard))
        np.testing.assert_array_equal(found.amplitude, model.transient([6, 8]).amplitude)

    def test_false_stops_and_keeps_what_was_found(self):
        model = hbmcheck.Model.from_yaml(CASE2)
        heard = []
        for work in (model.frf, model.transient, model.compare,
                     lambda progress: model.verify([3.5, 4, 4.5], [1, 2, 3], progress=progress)):
            with self.assertRaises(hbmcheck.Interrupted) as caught:
                work(progress=lambda done: heard.append(done) or len(heard) % 5 != 0)
            self.assertIsNotNone(caught.exception.result)

    def test_what_it_raises_comes_out(self):
        def burst(done):
            raise ZeroDivisionError("mine")

        model = hbmcheck.Model.from_yaml(CASE2)
        for work in (model.frf, model.transient, model.compare):
            with self.assertRaisesRegex(ZeroDivisionError, "mine"):
                work(progress=burst)
        self.assertEqual(len(model.frf()), 71)  # unharmed

    def test_what_is_no_function(self):
        with self.assertRaises(TypeError):
            hbmcheck.Model.from_yaml(CASE2).frf(progress=3)

    def test_it_may_ask_the_same_model(self):
        model = hbmcheck.Model.from_yaml(CASE2)
        asked = []
        model.frf(progress=lambda done: asked.append(model.contact_force([0, 1, 0])) and None)
        self.assertTrue(asked)


class Interrupt(Test):
    def test_control_c_stops_the_work(self):
        """Without any progress, in a fraction of what the work would take."""
        model = hbmcheck.Model.from_yaml(CASE2, set=LONG)
        for work in (model.transient, model.compare):
            timer = threading.Timer(0.2, os.kill, (os.getpid(), signal.SIGINT))
            start = time.monotonic()
            timer.start()
            with self.assertRaises(KeyboardInterrupt):
                for _ in range(100):
                    work()
            timer.join()
            self.assertLess(time.monotonic() - start, 60)


    def test_other_handlers_are_called_on_the_way(self):
        """One that raises stops the work, one that does not only hears of it; both are as they were afterwards."""
        model, heard = hbmcheck.Model.from_yaml(CASE2, set=LONG), []

        def late(number, frame):
            heard.append(number)
            if len(heard) == 2:
                signal.setitimer(signal.ITIMER_REAL, 0)
                raise TimeoutError("late")

        before = signal.signal(signal.SIGALRM, late)
        try:
            signal.setitimer(signal.ITIMER_REAL, 0.1, 0.1)
            with self.assertRaisesRegex(TimeoutError, "late"):
                for _ in range(100):
                    model.transient()
            self.assertIs(signal.getsignal(signal.SIGALRM), late)
        finally:
            signal.setitimer(signal.ITIMER_REAL, 0)
            signal.signal(signal.SIGALRM, before)
        self.assertEqual(len(heard), 2)


class Threads(Test):
    def in_threads(self, work, arguments):
        found = [None] * len(arguments)

        def run(i):
            found[i] = work(arguments[i])

        threads = [threading.Thread(target=run, args=(i,)) for i in range(len(arguments))]
        for t in threads:
            t.start()
        for t in threads:
            t.join()
        return found

    def test_two_at_once_find_what_one_finds(self):
        omegas = [[5.0, 6.0], [7.0, 8.0]]
        alone = [hbmcheck.Model.from_yaml(CASE2).compare(w) for w in omegas]
        shared = hbmcheck.Model.from_yaml(CASE2)
        for work in (lambda w: hbmcheck.Model.from_yaml(CASE2).compare(w), shared.compare):
            for one, both in zip(alone, self.in_threads(work, omegas)):
                for name in one.columns:
                    np.testing.assert_array_equal(one[name], both[name], err_msg=name)

    def test_the_interpreter_goes_on_while_the_library_works(self):
        """Another thread waits for a call without ticks, in which others have their turn: no pause is half as long."""
        model, at = hbmcheck.Model.from_yaml(CASE2), [time.monotonic()]
        worker = threading.Thread(target=model.contact_force, args=([0, 3, 0], [0, 3, 0]), kwargs={"samples": 1 << 22})
        worker.start()
        while worker.is_alive():
            at.append(time.monotonic())
        self.assertLess(np.diff(at).max(), (at[-1] - at[0]) / 2)


if __name__ == "__main__":
    main()
