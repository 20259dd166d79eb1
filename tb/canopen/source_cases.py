# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""od_from_eds.py: what an object dictionary comes to, and what is refused."""
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

from canopen_run import needs_stack

SOURCES = pathlib.Path(os.environ["VERICAN_CANOPEN_SOURCES"])
EDS = SOURCES / "drive/drive.eds"
SMALL = """[MandatoryObjects]
SupportedObjects=2
1=0x1000
2=0x2006
[1000]
ParameterName=Device type
DataType=0x0007
AccessType=ro
DefaultValue=0x00020192
[2006]
ParameterName=Gains
ObjectType=0x8
SubNumber=3
[2006sub0]
ParameterName=Highest sub-index supported
DataType=0x0005
AccessType=ro
DefaultValue=2
[2006sub1]
ParameterName=Gain 1
DataType=0x0003
AccessType=rw
DefaultValue=-2
PDOMapping=1
[2006sub2]
ParameterName=Gain 2
DataType=0x0003
AccessType=rw
DefaultValue=$NODEID+0x100
PDOMapping=1
"""
# Prints what CANopenNode's own functions find in the dictionary.
READER = """
#include <stdio.h>
#include "301/CO_ODinterface.h"
#include "OD.h"
int main(void) {
  for (int i = 0; i < OD->size; ++i)
    for (unsigned sub = 0; sub < 256; ++sub) {
      OD_IO_t io;
      if (OD_getSub(&OD->list[i], (uint8_t)sub, &io, true) != ODR_OK) continue;
      unsigned char bytes[64] = {0};
      OD_size_t got = 0;
      if (io.stream.dataOrig != NULL) io.read(&io.stream, bytes, sizeof bytes, &got);
      printf("%04X.%u %02X ", OD->list[i].index, sub, (unsigned)io.stream.attribute);
      for (OD_size_t k = 0; k < got; ++k) printf("%02x", bytes[k]);
      printf("\\n");
    }
  return 0;
}
"""


def generate(eds, out):
    """Runs the generator: exit code and messages."""
    done = subprocess.run([sys.executable, "-B", str(SOURCES / "od_from_eds.py"), str(eds), out],
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
    return done.returncode, done.stdout


class CanopenDictionary(unittest.TestCase):
    """The generator of OD.h and OD.c."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def refused(self, old, new, message):
        """The small data sheet with a change."""
        self.assertIn(old, SMALL)
        (self.folder / "bad.eds").write_text(SMALL.replace(old, new), encoding="ascii")
        code, text = generate(self.folder / "bad.eds", self.folder)
        self.assertEqual(code, 2, text)
        self.assertIn(message, text)
        self.assertFalse((self.folder / "OD.c").exists())

    def test_refusals(self):
        for old, new, message in (
                ("DefaultValue=0x00020192", "DefaultValue=x", "[1000] DefaultValue=x: no number"),
                ("DefaultValue=2\n", "DefaultValue=256\n", "DefaultValue=256: no uint8_t"),
                ("AccessType=ro\nDefaultValue=0", "AccessType=r\nDefaultValue=0", "AccessType=r:"),
                ("SubNumber=3", "SubNumber=4", "SubNumber=4, but there are 3 sections"),
                ("ObjectType=0x8", "ObjectType=0x5", "ObjectType=5: 7 (VAR)"),
                ("2=0x2006", "2=0x2007", "object 0x2007 is listed, but has no section"),
                ("DataType=0x0007", "DataType=0x0020", "[1000] DataType=0x0020"),
                ("AccessType=rw\nDefaultValue=-2", "AccessType=ro\nDefaultValue=-2", "one access"),
                ("2=0x2006", "2=0x1000", "object 0x1000 is listed twice"),
                ("[2006sub2]", "[2006sub5]", "follow each other, 0 to 2; here the last one is 5"),
                ("DataType=0x0003", "DataType=0x0009", "elements of an ARRAY are numbers"),
                ("DataType=0x0003", "DataType=0x000F", "elements of an ARRAY are numbers"),
                ("DataType=0x0007", "DataType=0x0009\n;Length=-1", "[1000] ;Length=-1: 0 or more"),
                ("DataType=0x0007", "DataType=0x0008", "DefaultValue=0x00020192: no REAL32"),
                ("0x0007\nAccessType=ro\nDefaultValue=0x00020192",
                 "0x0008\nAccessType=ro\nDefaultValue=1e39", "DefaultValue=1e39: no REAL32"),
                ("0x0007\nAccessType=ro\nDefaultValue=0x00020192",
                 "0x0008\nAccessType=ro\nDefaultValue=inf", "DefaultValue=inf: no REAL32"),
                ("ParameterName=Gains\n", "", "[2006]: ParameterName is missing")):
            with self.subTest(message):
                self.refused(old, new, message)

    def test_no_file(self):
        code, text = generate(self.folder / "none.eds", self.folder)
        self.assertEqual(code, 2)
        self.assertIn("No such file", text)

    def test_a_folder_that_cannot_be_written(self):
        (self.folder / "file").touch()
        (self.folder / "small.eds").write_text(SMALL, encoding="ascii")
        self.assertEqual(generate(self.folder / "small.eds", self.folder / "file"),
                         (2, f"od_from_eds.py: {self.folder}/file: File exists\n"))

    def read_back(self, eds):
        """What CANopenNode's functions find in the dictionary of a data sheet, compiled for
        here."""
        stack = os.environ["CANOPENNODE"]
        self.assertEqual(generate(eds, self.folder), (0, ""))
        (self.folder / "reader.c").write_text(READER, encoding="ascii")
        includes = ["-I", SOURCES, "-I", SOURCES.parent / "driver/include", "-I", self.folder,
                    "-isystem", stack]
        subprocess.run(["cc", "-std=gnu99", "-Wall", "-Wextra", "-Werror", *map(str, includes),
                        "-o", f"{self.folder}/reader", f"{self.folder}/reader.c",
                        f"{self.folder}/OD.c", f"{stack}/301/CO_ODinterface.c"], check=True)
        done = subprocess.run([self.folder / "reader"], stdout=subprocess.PIPE, text=True,
                              check=True)
        return dict(line.split(" ", 1) for line in done.stdout.splitlines())

    @needs_stack
    def test_values_and_attributes(self):
        (self.folder / "small.eds").write_text(SMALL, encoding="ascii")
        # Attributes as 301/CO_ODinterface.h has them: SDO r 1, w 2; TPDO 4, RPDO 8; multi-byte 40.
        self.assertEqual(self.read_back(self.folder / "small.eds"),
                         {"1000.0": "41 92010200", "2006.0": "01 02", "2006.1": "4F feff",
                          "2006.2": "4F 0001"})

    @needs_stack
    def test_the_whole_drive(self):
        found = self.read_back(EDS)
        sections = [line[1:-1] for line in EDS.read_text(encoding="ascii").splitlines()
                    if line.startswith("[") and line[1:5].isalnum() and line[1].isdigit()]
        entries = {f"{s[:4]}.{int(s[7:], 16)}" for s in sections if "sub" in s}
        entries |= {f"{s}.0" for s in sections if "sub" not in s}
        self.assertEqual(set(found), entries)
        self.assertEqual(found["1400.1"], "43 00020000")
        self.assertEqual(found["2007.0"], "45 " + "00" * 8)


class CanopenBuild(unittest.TestCase):
    """What build.py says where it cannot build; the stack is one without content."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        (self.folder / "CANopen.c").touch()

    def told(self, *arguments):
        """Exit code and messages, without a compiler."""
        done = subprocess.run(
            [sys.executable, "-B", str(SOURCES / "build.py"), *map(str, arguments)], check=False,
            env={"PATH": str(self.folder), "CANOPENNODE": str(self.folder)}, text=True,
            stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        return done.returncode, done.stdout

    def test_no_compiler_and_no_folder(self):
        self.assertEqual(self.told(self.folder / "out"),
                         (2, "build.py: arm-none-eabi-gcc: No such file or directory\n"))
        out = self.folder / "CANopen.c"
        self.assertEqual(self.told(out), (2, f"build.py: {out}: File exists\n"))

    def test_numbers_out_of_range(self):
        for arguments, message in ((("--kbit", 0), "--kbit 0: 1 to 1000"),
                                   (("--kbit", 1001), "--kbit 1001: 1 to 1000"),
                                   (("--clock", -5), "--clock -5: 1000000 to 1000000000"),
                                   ((128,), "node-ID 128: 1 to 127, or 255")):
            code, text = self.told(self.folder / "out", *arguments)
            self.assertEqual(code, 2, text)
            self.assertIn(message, text)
            self.assertFalse((self.folder / "out").exists())


def run_here(test, *files):
    """Exit code and messages of a test in C, compiled for here with sanitizers."""
    with tempfile.TemporaryDirectory() as folder:
        program = f"{folder}/test"
        subprocess.run(
            ["cc", "-std=gnu99", "-Wall", "-Wextra", "-Werror", "-fsanitize=address,undefined",
             "-fno-sanitize-recover=undefined", "-I", str(SOURCES), "-I",
             str(SOURCES.parent / "driver/include"), *files, "-o", program,
             str(pathlib.Path(__file__).with_name(test))], check=True)
        done = subprocess.run([program], stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                              text=True, check=False)
    return done.returncode, done.stdout


class CanopenLock(unittest.TestCase):
    """Critical sections, on a lock that masks the core's interrupt alone."""

    def test_nested_and_interrupted(self):
        self.assertEqual(run_here("lock_test.c"), (0, ""))


class CanopenServo(unittest.TestCase):
    """The motor of the drive's firmware."""

    def test_speed_and_range(self):
        self.assertEqual(run_here("drive_test.c", str(SOURCES / "drive/drive.c")), (0, ""))


@needs_stack
class CanopenPort(unittest.TestCase):
    """The port on a driver that does as it is told."""

    def test_order_window_filters_errors(self):
        self.assertEqual(run_here("port_test.c", "-isystem", os.environ["CANOPENNODE"],
                                  str(SOURCES / "CO_driver.c"),
                                  str(SOURCES / "co_verican_tx.c")), (0, ""))


if __name__ == "__main__":
    unittest.main()
