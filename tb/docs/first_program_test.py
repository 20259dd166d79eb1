# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""The first program of docs/driver.md, built by the command of docs/firmware.md, runs on a board.

Run by ctest: python3 -m unittest first_program_test, with VERICAN_BINARY in the environment.
"""
import os
import pathlib
import re
import subprocess
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
# What docs/firmware.md says that the program needs on the board.
ON_THE_BOARD = {"can_interrupt": "can0_handler",
                "/* Enable the interrupt line in the interrupt controller here. */":
                    "board_irq_enable(BOARD_IRQ_CAN0, 1);",
                '#include "verican/verican.h"': '#include "verican/verican.h"\n#include "board.h"'}
SCENARIO = """
bitrate: 500k
duration: 10 ms
nodes: [{name: firmware, clock: 50 MHz}, {name: peer}]
traffic: [{node: peer, id: 0x200, data: 01 02, period: 2 ms}]
"""


def page(name):
    """The text of a page."""
    return (ROOT / "docs" / name).read_text(encoding="utf-8")


class FirstProgram(unittest.TestCase):
    """It sends Hello and answers every frame with the identifier next to it."""

    def test_by_the_commands_of_the_page(self):
        program = re.search(r"```c\n(#include.*?)```", page("driver.md"), re.DOTALL)[1]
        for text, other in ON_THE_BOARD.items():
            self.assertIn(text, program)
            program = program.replace(text, other)
        commands = re.search(r"^    arm-none-eabi-gcc .*?app\.elf\n(?=    verican)",
                             page("firmware.md"), re.DOTALL | re.MULTILINE)[0]
        with tempfile.TemporaryDirectory(prefix="verican-first-program-") as name:
            work = pathlib.Path(name)
            (work / "app.c").write_text(program, encoding="utf-8")
            (work / "scenario.yaml").write_text(SCENARIO, encoding="utf-8")
            (work / "sw").symlink_to(ROOT / "sw")
            subprocess.run(["bash", "-ec", commands], cwd=work, check=True)
            log = subprocess.run(
                [os.environ["VERICAN_BINARY"], "firmware", "app.elf", "--bus", "scenario.yaml",
                 "--endless", "--candump", "-"], cwd=work, check=True, capture_output=True,
                text=True).stdout
        frames = [line.split()[2] for line in log.splitlines()]
        self.assertEqual(sorted(frames), ["123#48656C6C6F", *["200#0102"] * 5, *["201#0102"] * 5])


if __name__ == "__main__":
    unittest.main()
