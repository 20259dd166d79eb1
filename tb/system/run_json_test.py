# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# run_json_test VERICAN: `run --json` of a scenario with several bit rates and several faults.
"""The places of the faults on the wire are counted by hand."""
import json
import sys
import unittest

sys.path.insert(0, "tb/harness")
from tool_case import ToolCase

# b's frames: the first, the second, torn, its retransmission, ...
SCENARIO = """bitrate: [125k, 500k]
duration: 35 ms
nodes:
  - {name: a}
  - {name: b}
traffic:
  - {node: a, id: 0x555, data: [0x3F], period: 10 ms}
faults:
  - {kind: flip, name: torn, at: {node: a, frame: 2, field: CRC, bit: 0}}
  - {kind: recessive, name: weak, at: {node: b, frame: 3, field: DATA, bit: 0}}
  - {kind: dominant, name: nothing, at: {node: b, frame: 1, field: DATA, bit: 0}, hits: 0}
"""
# SOF, ID 10101010101, RTR IDE r0 000, DLC 00: a stuff bit; DLC 01.
DATA_BIT_0 = 1 + 11 + 3 + 4 + 1
CRC_BIT_0 = DATA_BIT_0 + 9  # 00111111 and a stuff bit before its last


class RunJson(ToolCase):
    def run_scenario(self, text, code=0):
        log = self.path / "bus.log"
        output = json.loads(self.passes("run", self.file("a.yaml", text), "--json", "--pcap",
                                        self.path / "bus.pcap", "--candump", log, code=code))
        return output["ok"], output["runs"]

    def test_each_rate_has_a_run_with_its_faults(self):
        ok, runs = self.run_scenario(SCENARIO)
        self.assertTrue(ok)
        self.assertEqual([run["bitrate"] for run in runs], [125e3, 500e3])
        for run in runs:
            self.assertTrue(run["ok"])
            self.assertEqual((run["frames"], run["error_frames"]), (4, 2))
            self.assertEqual(
                [(f["name"], f["kind"], f["node"], f["line"], f["hits"], f["took_effect"])
                 for f in run["faults"]],
                [("torn", "flip", "a", 9, 1, True), ("weak", "recessive", "b", 10, 1, True),
                 ("nothing", "dominant", "b", 11, 0, False)])
            self.assertEqual(run["messages"][0]["sent"], 4)
            self.assertEqual([node["errors"] for node in run["nodes"]], [2, 2])

    def test_worst_case_of_the_load(self):
        for analysis, bits in (("true", 65), ("false", 0)):  # 8n + 44 + 3 + (34 + 8n - 1) / 4
            text = f"duration: 5 ms\nanalysis: {analysis}\n" + """nodes: [{name: a}, {name: b}]
traffic: [{node: a, id: 1, data: 01, period: 1 ms}]
"""
            (run,) = self.run_scenario(text)[1]
            self.assertAlmostEqual(run["analytic_load"], bits * 2e-6 / 1e-3)

    def test_faults_are_where_the_scenario_puts_them(self):
        for run in self.run_scenario(SCENARIO)[1]:
            bit = 1e12 / run["bitrate"]
            # The second frame: a period behind the first, which nothing delays.
            sof = run["identifiers"][0]["first_ps"] + 10e9
            (torn,), (weak,), none = [fault["times_ps"] for fault in run["faults"]]
            self.assertEqual(none, [])
            for time in torn:
                self.assertTrue(CRC_BIT_0 - 1 <= (time - sof) / bit <= CRC_BIT_0 + 2, (time, sof))
            # Flag, its echoes, delimiter, intermission: the retransmission is at least 17 bits on.
            again = (weak[0] - torn[0]) / bit - DATA_BIT_0
            self.assertTrue(17 <= again <= 17 + 15 + 6 + 3, again)

    def test_one_rate_that_fails_fails_all(self):
        # 4 frames of 55 bits and 2 that were broken off, in 55 ms: 3 to 6 % at 125 kbit/s.
        ok, runs = self.run_scenario(SCENARIO + "expect: {load: {max: 2}}\n", code=1)
        self.assertFalse(ok)
        self.assertEqual([run["ok"] for run in runs], [False, True])
        load = [[c for c in run["checks"] if c["what"].startswith("load")] for run in runs]
        self.assertEqual([check["ok"] for check, in load], [False, True])

    def test_each_rate_has_its_files(self):
        self.run_scenario(SCENARIO)
        for rate in ("125k", "500k"):
            log = (self.path / f"bus-{rate}.log").read_text().splitlines()
            self.assertEqual([line.split()[2] for line in log], ["555#3F"] * 4)
            self.assertTrue((self.path / f"bus-{rate}.pcap").exists())


if __name__ == "__main__":
    unittest.main()
