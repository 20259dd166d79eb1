# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""NXP's SDK driver fsl_flexcan, unmodified, on a Cortex-M3 and a Verilated core. MCUX_SDK names the
user's copy of NXP's mcux-sdk, CMSIS_CORE the folder of its copy of CMSIS with core_cm4.h.
"""
import os
import pathlib
import subprocess
import tempfile
import unittest

HERE = pathlib.Path(__file__).resolve().parent
SW = HERE.parents[1] / "sw"
BOARD = SW / "firmware/common"
CPU = ("-mcpu=cortex-m3", "-mthumb", "-std=gnu99", "-Os", "-g", "-ffunction-sections",
       "-fdata-sections", "-nostartfiles", "-Wl,--gc-sections", "-T", BOARD / "a2f500.ld")
OWN = ("-Wall", "-Wextra", "-Werror")
CHECKS = ("polling", "interrupts", "remote", "fifo, table A", "fifo, table B", "fifo, table C",
          "flood", "abort", "loop-back", "listen-only", "bus-off")
PATIENCE = 250
needs_sdk = unittest.skipUnless(
    os.environ.get("MCUX_SDK") and os.environ.get("CMSIS_CORE"),
    "MCUX_SDK and CMSIS_CORE name no copies of NXP's SDK and of CMSIS's core headers")


def compile_program(out, sources, flags):
    """An ELF file of these sources, with the board's own."""
    subprocess.run(["arm-none-eabi-gcc", *CPU, *OWN, *flags, "-I", HERE, "-I", BOARD,
                    "-I", SW / "driver/include", *sources, "-o", out], check=True)


def compile_check(out, part, cpu):
    """check.c with the SDK's driver for a part; warnings are for our own files."""
    sdk = pathlib.Path(os.environ["MCUX_SDK"])
    device = sdk / "devices" / part
    driver = out.with_suffix(".o")
    flags = ["-DFSL_SDK_DISABLE_DRIVER_CLOCK_CONTROL=1", f"-DCPU_{cpu}", f"-DMCUX_PART={part}",
             "-I", SW / "mcux"]
    for folder in (sdk / "drivers/flexcan", sdk / "drivers/common", device,
                   os.environ["CMSIS_CORE"]):
        flags += ["-isystem", folder]
    subprocess.run(["arm-none-eabi-gcc", *CPU, *flags, "-c", sdk / "drivers/flexcan/fsl_flexcan.c",
                    "-o", driver], check=True)
    board = [BOARD / name for name in ("startup.c", "semihost.c", "board.c")]
    compile_program(out, [HERE / "check.c", driver, *board], flags)


def compile_peer(out, *flags):
    """peer.c with the project's own driver."""
    compile_program(out, [HERE / "peer.c", *BOARD.glob("*.c"), *(SW / "driver/src").glob("*.c")],
                    flags)


@needs_sdk
class McuxSdk(unittest.TestCase):
    """The driver against a partner that answers each frame."""

    def run_check(self, part, cpu, *peer_flags):
        """Exit code and lines of the program."""
        with tempfile.TemporaryDirectory() as folder:
            check, peer = (pathlib.Path(folder) / name for name in ("check.elf", "peer.elf"))
            compile_check(check, part, cpu)
            compile_peer(peer, *peer_flags)
            done = subprocess.run(
                [os.environ["VERICAN_BINARY"], "firmware", check, peer, "--bus", HERE / "bus.yaml"],
                stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=PATIENCE,
                check=False)
        return done.returncode, done.stdout

    def test_part_with_sixteen_buffers(self):
        """Kinetis K64."""
        code, text = self.run_check("MK64F12", "MK64FN1M0VLL12")
        self.assertEqual((code, text), (0, "".join(f"firmware: ok {name}\n" for name in CHECKS)))

    def test_part_with_all_buffers_and_errata(self):
        """i.MX RT1050: 64 buffers, and what the driver does against errata of that part."""
        code, text = self.run_check("MIMXRT1052", "MIMXRT1052DVL6B")
        self.assertEqual((code, text), (0, "".join(f"firmware: ok {name}\n" for name in CHECKS)))

    def test_a_wrong_answer_is_noticed(self):
        """The partner answers without inverting."""
        code, text = self.run_check("MK64F12", "MK64FN1M0VLL12", "-DINVERTED=0x00u")
        self.assertNotEqual(code, 0)
        self.assertIn("firmware: FAILED polling\n", text)


if __name__ == "__main__":
    unittest.main()
