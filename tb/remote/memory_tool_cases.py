# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""tools/remote_memory.py, which writes the first contents of a remote node's RAM: what it puts
where, and mistakes, each of which it refuses. Run by ctest:
python3 -m unittest memory_tool_cases.MemoryTool.test_contents
"""
import pathlib
import subprocess
import sys
import tempfile
import unittest

TOOL = pathlib.Path(__file__).resolve().parents[2] / "tools/remote_memory.py"


def tool(*words):
    """The tool's exit code and standard error."""
    done = subprocess.run([sys.executable, "-B", str(TOOL), *words], stderr=subprocess.PIPE,
                          text=True, timeout=60, check=False)
    return done.returncode, done.stderr


def image(*words):
    """The bytes that the tool writes, read as $readmemh does."""
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "m.hex"
        code, text = tool("--serial", "0xCAFE1234", *words, str(path))
        assert code == 0, text
        return b"".join(int(word, 16).to_bytes(4, "little") for word in path.read_text().split())


class MemoryTool(unittest.TestCase):
    """Expected bytes: the memory map of remote-node.md, section 8."""

    def test_contents(self):
        """RN-60: NODE, FLAGS, BOFF, LIFE, BLKTO, RETRY; IDENT (RN-25); bytes of one's own."""
        ram = image("--number", "7", "--set", "0x40=01 02", "--set", "66=FF")
        self.assertEqual(ram[0xF00:0xF08].hex(), "070500000a0a3208")
        self.assertEqual(ram[0xFF8:].hex(), "01013c083412feca")
        self.assertEqual(ram[0x3F:0x44].hex(), "000102ff00")
        self.assertEqual(image("--name-bits", "5", "--number", "31")[0xF00], 31)

    def test_one_byte_of_the_configuration(self):
        """Those beside it keep what they have after a reset."""
        self.assertEqual(image("--set", "0xF00=05")[0xF00:0xF08].hex(), "050500000a0a3208")
        self.assertEqual(image("--profile", "full", "--set", "0xF7F=0102")[0xF7F:0xF81].hex(),
                         "0102")

    def refused(self, text, *words, file="m.hex"):
        """Says what was wrong and what is allowed, in the words of `text`."""
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / file
            code, said = tool(*words, str(path))
            self.assertNotIn("Traceback", said)
            self.assertIn(text, said)
            self.assertEqual(code, 2)
            self.assertFalse(path.is_file())

    def test_refused_numbers(self):
        """The number has `--name-bits`, the serial number 32 bits (RN-02)."""
        for number in "9", "300", "-1", "1":
            self.refused(f"--number: {number}; allowed: 2 to 7, or 0 for none",
                         "--serial", "1", "--number", number)
        self.refused("--number: 32; allowed: 2 to 31",
                     "--serial", "1", "--name-bits", "5", "--number", "32")
        self.refused("--number: 'x'; allowed: a number", "--serial", "1", "--number", "x")
        for serial in "0x100000000", "-1":
            self.refused("; allowed: 0 to 0xFFFFFFFF", "--serial", serial)

    def test_refused_bytes(self):
        """No bytes, half a byte, an address that is none or not in the memory."""
        for text in "0x40", "0x40=", "0x40=1", "0x40=xy", "foo=01":
            self.refused(f"--set: '{text}'; allowed: ADDRESS=HEX", "--serial", "1", "--set", text)
        for text in "0x1FF=0102", "0xE00=01", "0xF20=01", "0xF40=00", "0xFFF=00", "0x1000=00":
            self.refused("is not in the memory; allowed: 0x000 to 0x1ff, 0xf00 to 0xf1f\n",
                         "--serial", "1", "--mem-bytes", "1024", "--set", text)
        for text in "0xF3F=0102", "0xFBF=0102":
            self.refused("; allowed: 0x000 to 0xdff, 0xf00 to 0xf1f, 0xf40 to 0xf7f, 0xf80 to "
                         "0xfbf\n", "--serial", "1", "--profile", "standard", "--set", text)

    def test_refused_bytes_that_are_given_twice(self):
        """Whichever would win."""
        self.refused("--set: 0x041 is given twice",
                     "--serial", "1", "--set", "0x40=0102", "--set", "65=FF")

    def test_two_numbers(self):
        """NODE has the number: one of them would be lost."""
        for number in "5", "0":
            self.refused("--set: 0xf00 is the number of the node, which --number gives",
                         "--serial", "1", "--number", number, "--set", "0xF00=06")

    def test_standard_output(self):
        """As `-` of the tools."""
        done = subprocess.run([sys.executable, "-B", str(TOOL), "--serial", "1", "-"], text=True,
                              stdout=subprocess.PIPE, timeout=60, check=False)
        self.assertEqual((done.returncode, len(done.stdout.split())), (0, 1024))

    def test_a_file_that_cannot_be_written(self):
        """A full disk, a folder that is not there."""
        self.refused("/dev/full: No space left", "--serial", "1", file="/dev/full")
        self.refused("none/m.hex: No such file", "--serial", "1", file="none/m.hex")
