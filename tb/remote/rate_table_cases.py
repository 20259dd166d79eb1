# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""`verican bittime --table` prints the rate table of a remote node (RN-73). Run by ctest:
VERICAN_BINARY=build/release/verican python3 -m unittest rate_table_cases.Table.test_rows
"""
import json
import os
import pathlib
import re
import subprocess
import unittest

RTL = pathlib.Path(__file__).resolve().parents[2] / "rtl/remote/can_remote.sv"
RATES = [1000, 800, 500, 250, 125, 50, 20, 10]


def tool(*words, code=0):
    """Standard output and error of `verican bittime --table`."""
    done = subprocess.run([os.environ["VERICAN_BINARY"], "bittime", "--table", *words],
                          capture_output=True, text=True, timeout=60, check=False)
    assert done.returncode == code, done
    return done.stdout, done.stderr


class Table(unittest.TestCase):
    """RN-73: the rows that a clock can do, the fastest first."""

    def rows(self, clock):
        """As JSON; each gives its rate, with a sample point between 65 and 90 %."""
        table = json.loads(tool("--clock", clock, "--json")[0])
        for row in table["rows"]:
            before = 1 + row["prop"] + row["ps1"]
            quanta = before + row["ps2"]
            rate = table["clock_hz"] / row["brp"] / quanta
            self.assertAlmostEqual(rate / row["bitrate"], 1, delta=0.005)
            self.assertTrue(0.65 <= before / quanta <= 0.9, row)
        return [row["bitrate"] // 1000 for row in table["rows"]]

    def test_rows(self):
        """All of them, and no row that the clock cannot do."""
        self.assertEqual(self.rows("8M"), RATES)
        self.assertEqual(self.rows("10M"), [rate for rate in RATES if rate != 800])
        self.assertEqual(self.rows("100M"), [rate for rate in RATES if rate != 10])

    def test_parameters(self):
        """They are what can_remote has for 8 MHz, which all tools that read RTL take."""
        rtl = RTL.read_text(encoding="utf-8")
        ours = re.search(r"RateRows = (\d+),.*?RateTable = \{(.*?)\n  \},", rtl, re.DOTALL)
        printed = re.search(r"\.RateRows\((\d+)\),\n\.RateTable\(\{(.*)\n\}\)", tool()[0],
                            re.DOTALL)
        for i in 1, 2:
            self.assertEqual("".join(ours[i].split()), "".join(printed[i].split()))

    def test_widths(self):
        """Rows and what is left free are 285 bits for every clock."""
        for clock in "8M", "10M", "50M":
            text = re.sub(r"//.*", "", tool("--clock", clock)[0])
            self.assertEqual(sum(map(int, re.findall(r"(\d+)'d", text))), 285)

    def test_refused(self):
        """A clock that can_remote cannot have, and a rate beside the table."""
        rtl = (RTL.parent / "can_rn_tick.sv").read_text(encoding="utf-8")
        self.assertIn("ClocksPerMs < 8000 || ClocksPerMs > 131071", rtl)
        for clock in "50k", "1M", "7999999", "131071001":
            out, error = tool("--clock", clock, code=2)
            self.assertEqual(out, "")
            self.assertIn("allowed: 8 MHz to 131.071 MHz", error)
        self.assertIn("excludes", tool("--bitrate", "500k", code=2)[1])
