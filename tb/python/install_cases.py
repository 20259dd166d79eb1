# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""The Python package installed and used from there, by Debian's Python, without a network."""
import os
import subprocess
import tempfile
import unittest
from pathlib import Path

PROGRAM = """
import can, verican
assert "{prefix}" in verican.__file__, verican.__file__
with can.Bus(interface="verican", channel="x") as a, can.Bus(interface="verican", channel="x") as b:
    a.send(can.Message(arbitration_id=0x123, data=[1], is_extended_id=False))
    print(hex(b.recv(10).arbitration_id))
"""


class PythonInstalled(unittest.TestCase):
    def test_works_from_where_it_was_installed(self):
        build = Path(os.environ["VERICAN_BINARY"]).parent
        with tempfile.TemporaryDirectory() as prefix:
            subprocess.run(["cmake", "--install", str(build), "--prefix", prefix, "--component",
                            "python"], check=True, stdout=subprocess.DEVNULL)
            package, = Path(prefix).glob("lib/python3*/dist-packages")
            done = subprocess.run(["/usr/bin/python3", "-B", "-c", PROGRAM.format(prefix=prefix)],
                                  env={"PYTHONPATH": str(package), "HOME": prefix}, text=True,
                                  stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False)
        self.assertEqual((done.returncode, done.stdout), (0, "0x123\n"))


if __name__ == "__main__":
    unittest.main()
