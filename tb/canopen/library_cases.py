# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""npm's canopen as master and as device on two cores of a bus, by socketcand: no other stack."""
import os
import tempfile
import unittest
import unittest.mock

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

    def test_mistakes(self):
        """Each is one line, which names the program."""
        for script in "device.mjs", "master.mjs":
            for words, said in (
                    ((1, NODE), "at port 1: connect ECONNREFUSED"), ((), "PORT is missing"),
                    (("x", NODE), "PORT is 'x'; allowed: 1 to 65535"),
                    ((29536, 128), "NODE is '128'; allowed: 1 to 127"),
                    ((29536, NODE, "can0", "can1"), "usage: ")):
                self.told(script, program(EXAMPLES / script, *words), said)
            with unittest.mock.patch.dict(os.environ, VERICAN_CANOPEN="/nonexistent"):
                self.told(script, program(EXAMPLES / script, 1, NODE), "npm ci --ignore-scripts")

    def told(self, script, outcome, said):
        """Exit code 1, and this is said."""
        code, text = outcome
        self.assertEqual((code, text.count("\n")), (1, 1), text)
        self.assertTrue(text.startswith(f"{script}: "), text)
        self.assertIn(said, text)

    def test_example(self):
        self.both(EXAMPLES / "master.mjs", "position 300")


if __name__ == "__main__":
    unittest.main()
