# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""The cabinet of examples/remote meets its bars (RN-98), in a few of its 10,000 cycles and in its
variants. Run by ctest, one case each:
VERICAN_BINARY=build/release/verican python3 -m unittest cabinet_cases.Cabinet.test_bars
"""
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

import yaml

EXAMPLE = pathlib.Path(__file__).resolve().parents[2] / "examples/remote"
sys.path[:0] = [str(EXAMPLE)]

import cabinet  # noqa: E402  pylint: disable=wrong-import-position

PATIENCE = 280
ROUNDS = 300


def run(scenario):
    """Exit code of `verican run`, and its only run."""
    with tempfile.NamedTemporaryFile("w", suffix=".yaml", encoding="utf-8") as file:
        yaml.safe_dump(scenario, file)
        file.flush()
        done = subprocess.run([os.environ["VERICAN_BINARY"], "run", file.name, "--json"],
                              stdout=subprocess.PIPE, timeout=PATIENCE, check=False)
    return done.returncode, json.loads(done.stdout)["runs"][0]


class Cabinet(unittest.TestCase):
    """RN-98: host, three power stages, PFC, DAB."""

    def test_bars(self):
        """No set point lost, skew within its bound (RN-47), each measurement in its cycle."""
        code, seen = run(cabinet.scenario(None, ROUNDS))
        self.assertEqual(code, 0, seen["checks"])
        remote = seen["remote"]
        self.assertEqual((remote["triggers"], remote["compared"], remote["above_bound"]),
                         (ROUNDS, ROUNDS, 0))
        self.assertTrue(0 < remote["skew_longest_ps"] <= remote["skew_bound_ps"] < 450e3)
        for node in remote["nodes"]:
            self.assertEqual(
                (node["applied"], node["lost_set_points"], node["statements"],
                 node["late_statements"], node["refused"]), (ROUNDS, 0, ROUNDS, 0, 0))
            self.assertLessEqual(node["longest_ps"], node["bound_ps"])
        # Between no stuff bit at all and as many as can be.
        self.assertTrue(624e6 <= remote["traffic_shortest_ps"] <= remote["traffic_mean_ps"]
                        <= remote["traffic_longest_ps"] <= 750e6, remote["traffic_shortest_ps"])
        self.assertTrue(0.624 <= remote["cycle_load"] <= 0.75)
        self.assertTrue(50e6 <= remote["latency_shortest_ps"] <= remote["latency_longest_ps"]
                        <= 200e6)

    def test_a_lost_set_point_is_no_success(self):
        """A stage that misses TRIGGERs fails the run of the plain cabinet."""
        changed = cabinet.scenario(None, 20)
        changed["faults"] = [{"kind": "cut", "node": "stage2", "from": "9.8 ms", "for": "2 ms"}]
        code, seen = run(changed)
        self.assertEqual(code, 1)
        self.assertIn("lost_set_points", [c["what"] for c in seen["checks"] if not c["ok"]])

    def test_plug(self):
        """All nodes are in SAFE 20 ms after the last frame, a millisecond early at most."""
        code, seen = run(cabinet.scenario("plug", None))
        self.assertEqual(code, 0, seen["checks"])
        for node in seen["remote"]["nodes"]:
            self.assertTrue(79.1e9 < node["last_safe_ps"] < 80.4e9, node)

    def test_noise(self):
        """Frames are repeated; in a tenth of the variant's rounds already."""
        code, seen = run(cabinet.scenario("noise", 100) | {"duration": "110 ms", "expect": {
            "lost_set_points": 0, "trigger_skew": "bound"}})
        self.assertEqual(code, 0, seen["checks"])
        self.assertGreater(seen["error_frames"], 0)

    def test_stage(self):
        """One stage alone loses set points."""
        code, seen = run(cabinet.scenario("stage", None))
        self.assertEqual(code, 0, seen["checks"])
        self.assertEqual([n["lost_set_points"] for n in seen["remote"]["nodes"]], [0, 54, 0, 0, 0])

    def test_table(self):
        """The example prints the rows that the specification has: what is computed is as there,
        what is measured within its bounds, also in a few cycles of a longer run."""
        done = subprocess.run(
            [EXAMPLE / "cabinet.py", "--verican", os.environ["VERICAN_BINARY"], "--rounds", "5"],
            stdout=subprocess.PIPE, text=True, timeout=PATIENCE, check=False)
        self.assertEqual(done.returncode, 0, done.stdout)
        self.assertIn("5 cycles; applied 25, lost set points 0, late statements 0, refused 0",
                      done.stdout)
        rows = {row[0]: row[1:] for row in (re.split("  +", line.strip())
                                            for line in done.stdout.splitlines())}
        # The host has an answer some microseconds after it was on the bus.
        for name, least, most, *computed in (
                ("traffic", 624, 750, "750 bits at worst, 624 unstuffed",
                 "740 bits (shared RPDOs)", "FC23 to 5 nodes"),
                ("load or cycle", 62.3, 75.1, "75.0 % at worst, 62.4 % unstuffed", "74.0 %",
                 "29.0 ms, 14.8 ms with pauses of 3.5 characters"),
                ("set points act at once within", 1, 373, "bound 373 ns"),
                ("TRIGGER to action, worst", 0, 200, "65 + 135 bits = 200 us, jitter 135 us",
                 "the same frames", "2.1 to 3.6 ms"),
                ("action to end of measurement", 47 + 32, 750, "bound 750 us"),
                ("read 4 bytes", 126, 150 + 5, "55 + 95 bits = 150 us", "SDO 270 us",
                 "2.3 to 5.1 ms"),
                ("write 4 bytes, confirmed", 237, 285 + 5,
                 "285 us by reading STATUS, 230 us with ACKW", "SDO 270 us", "about the same")):
            with self.subTest(name):
                figures = re.findall(r"[\d.]+", rows[name][0])
                self.assertTrue(figures)
                for figure in figures:
                    self.assertTrue(least <= float(figure) <= most, rows[name][0])
                self.assertEqual(rows[name][1:len(computed) + 1], computed)

    def test_without_the_tool(self):
        """One line, exit code 2."""
        done = subprocess.run([EXAMPLE / "cabinet.py", "--verican", "/none/verican"], text=True,
                              capture_output=True, timeout=PATIENCE, check=False)
        self.assertEqual((done.returncode, done.stdout), (2, ""))
        self.assertEqual(done.stderr, "cabinet.py: /none/verican: No such file or directory; "
                         "--verican says where the tool is\n")

    def test_words_for_the_kinds_of_nodes(self):
        """A run in which all nodes are of one kind is not told about others."""
        model = "the model of the rules on the RTL's protocol engine"
        for rtl, words in ((5, "all 5 nodes are RTL"), (0, f"all 5 nodes are {model}"),
                           (3, f"3 of 5 nodes are RTL; the other 2 are {model}"),
                           (4, f"4 of 5 nodes are RTL; the other 1 is {model}"),
                           (1, f"1 of 5 nodes is RTL; the other 4 are {model}")):
            self.assertEqual(cabinet.kinds(rtl), words)


if __name__ == "__main__":
    assert os.environ["VERICAN_BINARY"]
    unittest.main()
