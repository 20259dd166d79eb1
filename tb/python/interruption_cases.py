# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""Ctrl-C, or the end of the program, while simulated time passes."""
import concurrent.futures
import signal
import subprocess
import sys
import time
import unittest

from verican import Bus, Frame


class Interruption(unittest.TestCase):
    """Ctrl-C ends what lets time pass, and the bus can go on."""

    LONG = 20  # s, some of the host's too

    def setUp(self):
        self.bus = Bus(["a", "b"])
        self.bus.disturb("flip", 1e5, 1e-6)  # from now on the clocks never rest
        before = signal.signal(signal.SIGALRM, signal.default_int_handler)
        self.addCleanup(signal.signal, signal.SIGALRM, before)
        self.addCleanup(signal.setitimer, signal.ITIMER_REAL, 0)

    def interrupted(self, call):
        for node in self.bus.nodes:
            self.bus.receive(node)
        begin = self.bus.now
        signal.setitimer(signal.ITIMER_REAL, 0.05)
        with self.assertRaises(KeyboardInterrupt):
            call()
        self.assertLess(self.bus.now - begin, self.LONG / 2)
        self.bus.send("a", Frame(0x123, b"on"))
        self.bus.step(bits=200)
        self.assertEqual([m.id for m in self.bus.receive("b")], [0x123])

    def test_steps(self):
        self.interrupted(lambda: self.bus.step(seconds=self.LONG))
        self.interrupted(lambda: self.bus.pass_time(self.LONG))
        self.interrupted(lambda: self.bus.run_until_message(self.LONG))

    def test_until_quiet(self):
        self.bus = Bus(["a"])  # alone, it tries for ever
        self.bus.send("a", Frame(0x1))
        signal.setitimer(signal.ITIMER_REAL, 0.05)
        with self.assertRaises(KeyboardInterrupt):
            self.bus.run_until_quiet(self.LONG)
        self.assertLess(self.bus.now, self.LONG / 2)
        self.assertEqual(self.bus.pending("a"), 1)

    def test_bits_of_many_clocks(self):
        """4,096 bits take ten seconds of the host here."""
        self.bus = Bus([f"node{i}" for i in range(32)], bitrate=10e3, clock_hz=64e6)
        self.bus.disturb("flip", 1e5, 1e-6)
        begin = time.monotonic()
        signal.setitimer(signal.ITIMER_REAL, 0.05)
        with self.assertRaises(KeyboardInterrupt):
            self.bus.step(seconds=self.LONG)
        self.assertLess(time.monotonic() - begin, 4)

    def test_other_threads_finish_their_step(self):
        with concurrent.futures.ThreadPoolExecutor(1) as pool:
            step = pool.submit(self.bus.step, seconds=1)
            signal.setitimer(signal.ITIMER_REAL, 0.01)
            with self.assertRaises(KeyboardInterrupt):
                step.result()
            step.result()
        self.assertAlmostEqual(self.bus.now, 1, 6)


class EndOfTheProgram(unittest.TestCase):
    """A daemon thread that is in a step then must not take the process down with it."""

    PROGRAM = """
import threading, time
from verican import Bus, Frame
def work(bus):
    while True:
        bus.send("a", Frame(1))
        bus.step(1e-3)
threading.Thread(target=work, args=[Bus(["a", "b"])], daemon=True).start()
time.sleep(0.05)
"""

    def test_within_a_step(self):
        for _ in range(12):
            done = subprocess.run([sys.executable, "-B", "-c", self.PROGRAM], capture_output=True,
                                  text=True, timeout=60, check=False)
            self.assertEqual((done.returncode, done.stderr), (0, ""))


if __name__ == "__main__":
    unittest.main()
