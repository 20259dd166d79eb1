# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""python-can's own tests of interfaces and its examples on ours. VERICAN_PYTHON_CAN names the
user's copy of the sources of the release that is installed; without it they are skipped."""
import os
import subprocess
import sys
import unittest
from pathlib import Path

SOURCES = os.environ.get("VERICAN_PYTHON_CAN", "")
RUNNER = Path(__file__).resolve().parent / "upstream_runner.py"


def run(*command, cwd, **settings):
    return subprocess.run([sys.executable, "-B", *command], cwd=cwd, timeout=200, text=True,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                          stdin=subprocess.DEVNULL, check=False, env={**os.environ, **settings})


@unittest.skipUnless(SOURCES, "VERICAN_PYTHON_CAN names no copy of python-can's sources")
class PythonCanUpstream(unittest.TestCase):
    def own_tests(self, module):
        done = run(str(RUNNER), SOURCES, f"test.{module}", cwd=SOURCES)
        self.assertEqual(done.returncode, 0, done.stdout)

    def example(self, name, text):
        done = run(f"{name}.py", cwd=Path(SOURCES) / "examples", CAN_INTERFACE="verican",
                   CAN_CHANNEL="example")
        self.assertEqual(done.returncode, 0, done.stdout)
        self.assertRegex(done.stdout, text)

    def test_back_to_back(self):
        self.own_tests("back2back_test")

    def test_notifier(self):
        self.own_tests("notifier_test")

    def test_cyclic(self):
        self.own_tests("simplecyclic_test")

    def test_context_manager(self):
        self.own_tests("contextmanager_test")

    def test_zero_dlc(self):
        self.own_tests("zero_dlc_test")

    def test_filtering(self):
        self.own_tests("test_message_filtering")

    def test_producer_and_consumer(self):
        self.own_tests("network_test.ControllerAreaNetworkTestCase.testProducerConsumer")

    def test_listeners(self):
        self.own_tests("listener_test")

    def test_example_send_one(self):
        self.example("send_one", "Message sent on verican example")

    def test_example_send_multiple(self):
        self.example("send_multiple", "finished sending 16 messages")

    def test_example_cyclic(self):
        self.example("cyclic", "done")

    def test_example_print_notifier(self):
        self.example("print_notifier", "ID: 00000001 +X Tx(.|\n)*ID: +0001 +S Tx")


if __name__ == "__main__":
    unittest.main()
