# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""npm's canopen as master and as device on two cores of a bus, by socketcand: no other stack."""
import tempfile
import unittest

from canopen_run import HERE, live, program, program_node, scenario, start_program

EXAMPLES = HERE.parent.parent / "examples/canopen"
NODE = 5


class CanopenLibrary(unittest.TestCase):
    """Both sides in JavaScript."""

    def both(self, script, expected):
        """A device, and a program that must be content with it."""
        with tempfile.TemporaryDirectory() as folder:
            file = scenario(folder, nodes=[program_node(), program_node(name="can1")])
            with live(file) as port, \
                 start_program(EXAMPLES / "device.mjs", port, NODE, "can1") as device:
                try:
                    self.assertIn("is there", device.stdout.readline())
                    code, text = program(script, port, NODE)
                finally:
                    device.kill()
                    device.communicate()
        self.assertEqual(code, 0, text)
        self.assertRegex(text, expected)

    def test_checks(self):
        self.both("library_checks.mjs", r"\d+ checks, 0 failed")

    def test_example(self):
        self.both(EXAMPLES / "master.mjs", "position 300")


if __name__ == "__main__":
    unittest.main()
