# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# python_can_example_test VERICAN: examples/python_can.py on a bus that is there, and what it says
# of one that is not.
import re
import subprocess
import sys
import unittest

sys.path.insert(0, "tb/harness")
from tool_case import TOOL

EXAMPLE = "examples/python_can.py"
MISSING = subprocess.run(["/usr/bin/python3", "-c", "import can"], capture_output=True).returncode
BRIDGE = ["bridge", "--socketcand", "0", "--bus", "examples/bridge.yaml"]


class PythonCanExample(unittest.TestCase):
    def setUp(self):
        if MISSING:
            self.skipTest("python3-can is not installed")

    def bridge(self):
        """A bridge until the end of the test; its port."""
        process = subprocess.Popen([TOOL, *BRIDGE], stderr=subprocess.PIPE,
                                   stdout=subprocess.DEVNULL, text=True)
        self.addCleanup(process.stderr.close)
        self.addCleanup(process.wait, 20)
        self.addCleanup(process.terminate)
        return re.search(r"at 127\.0\.0\.1:(\d+)", process.stderr.readline())[1]

    def example(self, *arguments):
        return subprocess.run([EXAMPLE, *arguments], capture_output=True, text=True, timeout=60)

    def refused(self, said, *arguments):
        """One line that says it, and no traceback."""
        result = self.example(*arguments)
        self.assertEqual(result.returncode, 1, result.stdout + result.stderr)
        self.assertIn(said, result.stderr)
        self.assertEqual(result.stderr.count("\n"), 1, result.stderr)

    def test_a_bus_that_is_there(self):
        result = self.example(self.bridge(), "can0")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(len(result.stdout.splitlines()), 7)

    def test_a_channel_that_is_not(self):
        port = self.bridge()
        self.refused(f"no bus 'foo' at port {port}: ", port, "foo")

    def test_nobody_at_the_port(self):
        self.refused("nobody answers at port 1: ", "1")

    def test_arguments(self):
        for port in ("foo", "0", "65536", "-1", "2 9"):
            self.refused(f"PORT {port!r} is not allowed; allowed: 1 to 65535", port)
        self.refused("usage: python_can.py [PORT [CHANNEL]]", "1", "can0", "more")


if __name__ == "__main__":
    unittest.main()
