# SPDX-License-Identifier: Apache-2.0
"""The tests' own patience: with a given clock, and with processes that stand still, end or work."""
import contextlib
import io
import subprocess
import sys
import unittest
import unittest.mock

import patience
from patience import Counters, Patience, Wait, WaitedInVain


class Time:
    def __init__(self):
        self.now = 0.0

    def __call__(self):
        return self.now


def spends(steps, ceiling=1e9):
    """When and why somebody gives up who looks once a second; steps(now) are the counters then. None: within an hour never."""
    time = Time()
    one = Patience(time, lambda: steps(time.now), ceiling)
    while time.now < 3600:
        if why := one.spent():
            return time.now, why
        time.now += 1
    return None


class GivesUp(unittest.TestCase):
    def test_when_nothing_moves_for_a_minute(self):
        when, why = spends(lambda now: Counters((5,), min(now, 10) * 0.001))
        self.assertEqual(when, patience.QUIET_S)
        self.assertIn("counted", why)

    def test_a_minute_after_the_last_movement(self):
        self.assertEqual(spends(lambda now: Counters((min(now, 200),), 0))[0], 200 + patience.QUIET_S)
        self.assertEqual(spends(lambda now: Counters((), min(now, 300)))[0], 300 + patience.QUIET_S)

    def test_not_while_frames_are_counted_or_work_is_done_however_slowly(self):
        self.assertIsNone(spends(lambda now: Counters((now // 59,), 0)))
        self.assertIsNone(spends(lambda now: Counters((3,), now * 1.02 * patience.MOVES_S / patience.QUIET_S)))

    def test_a_timer_of_an_idle_process_is_no_movement(self):
        self.assertIsNotNone(spends(lambda now: Counters((3,), now * 0.5 * patience.MOVES_S / patience.QUIET_S)))

    def test_at_the_ceiling_also_while_a_process_spins(self):
        self.assertEqual(spends(lambda now: Counters((), now), ceiling=870)[0], 870)

    def test_a_process_that_ends_is_a_movement(self):
        self.assertEqual(spends(lambda now: Counters((1, 1) if now < 30 else (1,), 0))[0], 30 + patience.QUIET_S)


class StandIn:
    """A process as a test watches it."""

    def __init__(self):
        self.ended = self.has_crashed = False

    def counted(self):
        return 7

    def crashed(self):
        return self.has_crashed

    def has_ended(self):
        return self.ended

    def last_words(self):
        return "stand-in (runs): 7 frames"

    def __enter__(self):
        patience.watch(self)
        return self

    def __exit__(self, *_):
        patience.forget(self)


class Tells(unittest.TestCase):
    def wait(self, condition, time, **options):
        return Wait(condition, patience=Patience(time, patience.counters, 1e9), **options)

    def test_what_did_not_come_and_the_last_reports(self):
        time, frames = Time(), 3
        with StandIn():
            wait = self.wait(lambda: frames == 12, time)
            wait.check()
            time.now = 61
            with contextlib.redirect_stderr(io.StringIO()), self.assertRaises(WaitedInVain) as told:
                wait.check()
        for text in ("frames == 12", "stand-in (runs): 7 frames", "for 60 s"):
            self.assertIn(text, str(told.exception))

    def test_that_it_is_still_waiting(self):
        time, said = Time(), io.StringIO()
        wait = Wait("the viewer's picture", patience=Patience(time, lambda: Counters((time.now,), 0), 1e9))
        with contextlib.redirect_stderr(said):
            for time.now in range(100):
                wait.check()
        self.assertEqual(said.getvalue().count("for: the viewer's picture"), 3)

    def test_a_crash_at_once(self):
        with StandIn() as one:
            wait = self.wait("anything", Time())
            wait.check()
            one.has_crashed = True
            with self.assertRaisesRegex(WaitedInVain, "crashed"):
                wait.check()

    def test_the_end_of_the_process_that_should_bring_it(self):
        with StandIn() as one:
            one.ended = True
            with self.assertRaisesRegex(WaitedInVain, "ended, and this did not come: a picture"):
                patience.wait_until(lambda: False, "a picture", of=one)
            # A last look finds what it left behind.
            self.assertEqual(patience.wait_until(lambda: 5, "a file", of=one), 5)


class RealProcesses(unittest.TestCase):
    def start(self, code):
        process = subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE)
        self.addCleanup(process.stdout.close)
        self.addCleanup(process.wait)
        self.addCleanup(process.kill)
        return process

    def test_work_of_children_counts_and_their_sleep_does_not(self):
        sleeps = self.start("import time; print(flush=True); time.sleep(1000)")
        sleeps.stdout.readline()
        before = patience.processor_seconds()
        self.assertGreater(before, 0)
        self.assertLess(patience.processor_seconds() - before, patience.MOVES_S)
        # It ends by itself: nobody kills a grandchild.
        work = "import time\nwhile time.process_time() < 1: pass"
        self.start(f"import subprocess, sys; subprocess.run([sys.executable, '-c', {work!r}])")
        patience.wait_until(lambda: patience.processor_seconds() > before + 0.2, "work of a grandchild")

    def test_a_command_runs_to_its_end(self):
        done = patience.run([sys.executable, "-c", "import sys; print('out'); sys.exit('err')"])
        self.assertEqual((done.returncode, done.stdout, done.stderr), (1, "out\n", "err\n"))

    def test_a_command_that_stands_still_is_ended_and_what_it_said_is_told(self):
        said, process = io.StringIO(), self.start("import time; print('so far', flush=True); time.sleep(1000)")
        with unittest.mock.patch.object(patience, "QUIET_S", 2), contextlib.redirect_stderr(said), \
                self.assertRaisesRegex(WaitedInVain, "time.sleep"):
            patience.finish(process)
        self.assertIn("so far", said.getvalue())
        self.assertIsNotNone(process.returncode)

    def test_the_end_of_a_process_is_waited_for(self):
        self.assertEqual(patience.end_of(self.start("raise SystemExit(3)")), 3)


if __name__ == "__main__":
    unittest.main()
