# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# bus_forms_test VERICAN: short forms of the tool on buses with every kind of node: `replay --bus`,
# and `report` of scenarios whose nodes are programs.
"""Judges: the recording, what the scenario says, and what the test itself sends by TCP."""
import json
import pathlib
import re
import socket
import subprocess
import sys
import unittest

sys.path.insert(0, "tb/harness")
from tool_case import TOOL, ToolCase

# The node that sends the recording reads the first bit of its third CRC wrong.
BUS = """bitrate: 250k
duration: 1 ms
nodes:
  - {name: replay, clock: 16 MHz, ppm: 50}
  - {name: sensor}
traffic:
  - {node: sensor, name: t, id: 0x7F0, data: counter, dlc: 1, period: 10 ms}
faults:
  - {kind: flip, name: torn, at: {node: replay, frame: 3, field: CRC, bit: 0}}
expect: {error_frames: 1}
"""


def frames_of(log):
    return [line.split()[2] for line in pathlib.Path(log).read_text().splitlines()]


class ReplayOnABus(ToolCase):
    def setUp(self):
        super().setUp()
        self.recorded = [f"{0x100 + i % 4:03X}#{i:04X}" for i in range(40)]
        self.log = self.file("in.log", "".join(
            f"({1000 + i // 400}.{i % 400 * 2500:06}) vcan0 {frame}\n"
            for i, frame in enumerate(self.recorded)))
        self.out = self.path / "out.log"

    def replay(self, bus, *options, code=0):
        text = self.passes("replay", self.log, "--bus", self.file("bus.yaml", bus), "--candump",
                           self.out, "--json", *options, code=code)
        return json.loads(text)

    def split_log(self):
        frames = frames_of(self.out)
        return ([f for f in frames if not f.startswith("7F0")],
                [f for f in frames if f.startswith("7F0")])

    def test_recording_and_traffic_with_a_fault(self):
        result = self.replay(BUS)
        sent, traffic = self.split_log()
        self.assertEqual(sent, self.recorded)
        # 39 distances of 2.5 ms: at 0, 10, ... 90 ms, and no end at 1 ms.
        self.assertEqual(traffic, [f"7F0#{i:02X}" for i in range(10)])
        bus = result["bus"]
        self.assertEqual([node["name"] for node in bus["nodes"]], ["replay", "sensor"])
        self.assertEqual((bus["bitrate"], bus["error_frames"]), (250000, 1))
        self.assertEqual(bus["faults"][0]["name"], "torn")
        self.assertEqual(bus["faults"][0]["hits"], 1)
        self.assertEqual([(r["node"], r["frames"], r["sent"]) for r in bus["replays"]],
                         [("replay", 40, 40)])
        self.assertEqual(result["interfaces"], {"vcan0": 40})
        self.assertEqual(len(result["identifiers"]), 4)

    def test_new_nodes_share_the_recording(self):
        bus = "bitrate: 250k\nnodes:\n  - {name: sensor}\n"
        result = self.replay(bus, "--senders", "2", "--fast", "--frames", "30", "-c", "16M")
        sent, _ = self.split_log()
        self.assertEqual(sorted(sent), sorted(self.recorded[:30]))
        self.assertEqual([node["name"] for node in result["bus"]["nodes"]],
                         ["sensor", "replay", "replay2"])
        shares = [r["sent"] for r in result["bus"]["replays"]]
        self.assertEqual((len(shares), sum(shares)), (2, 30))
        self.assertGreater(min(shares), 0)
        self.assertLess(result["bus"]["duration_ps"], 30 * 0.5e9)

    def test_text_has_the_report_of_the_run(self):
        text = self.passes("replay", self.log, "--bus", self.file("bus.yaml", BUS))
        self.assertRegex(text, r"\n  replay +40 +40 +97\.500 ms  yes, at 1 node\n")
        self.assertIn("ok    error_frames: 1 (expected 1)", text)

    def test_expectations_of_the_scenario_count(self):
        bus = BUS.replace("error_frames: 1", "error_frames: 0")
        self.assertFalse(self.replay(bus, code=1)["ok"])

    def test_refused_with_the_reason(self):
        said = {
            BUS.replace("250k", "[250k, 500k]"): "has several bit rates; --bitrate says which",
            BUS.replace("node: sensor", "node: replay"):
                "traffic 't' is that of node 'replay', which sends the recording; allowed: the "
                "other nodes",
            BUS.replace("ppm: 50", f"replay: {self.log}"):
                "bus.yaml:4: node 'replay', which sends the recording, has 'replay' in the file",
            BUS.replace("ppm: 50", "software: none"):
                "which sends the recording, has 'software: none'",
        }
        for bus, reason in said.items():
            self.assertIn(reason, self.refused("replay", self.log, "--bus",
                                               self.file("bus.yaml", bus)))
        for option in (["--nodes", "3"], ["--ppm", "1"], ["--cable", "1"], ["--mailboxes", "16"]):
            self.assertIn("--bus", self.refused("replay", self.log, "--bus", "x.yaml", *option))
        bus = self.file("bus.yaml", BUS)
        self.assertIn("is the file of the scenario and of --candump",
                      self.refused("replay", self.log, "--bus", bus, "--candump", bus))


class ReportOfPrograms(ToolCase):
    SCENARIO = """bitrate: 500k
duration: 400 ms
nodes:
  - {name: sensor}
  - {name: can0, socketcand: '127.0.0.1:0', wait_for_clients: 1}
traffic:
  - {node: sensor, id: 0x10, data: AA, period: 100 ms}
"""

    def page(self, path):
        """Names of the nodes and what each has sent, and the number of frames, as the page says."""
        meta = json.loads(re.search(r'id="verican-meta">(.*?)</script>', path.read_text(), re.S)[1])
        return {n["name"]: n["sent"] for n in meta["nodes"]}, meta["summary"]["frames"]

    def talk(self, tool):
        """Sends two frames when the bus is open."""
        for line in tool.stderr:
            if found := re.search(r"127\.0\.0\.1:(\d+)", line):
                break
        client = socket.create_connection(("127.0.0.1", int(found[1])), 10)
        self.wait_for(client, b"< hi >")
        for words in (b"< open can0 >", b"< rawmode >"):
            client.sendall(words)
            self.wait_for(client, b"< ok >")
        client.sendall(b"< send 123 2 11 22 >< send 124 0 >")
        return client

    def wait_for(self, client, words):
        read = b""
        while words not in read:
            part = client.recv(4096)
            self.assertTrue(part, read)
            read += part

    def test_page_shows_what_the_programs_sent(self):
        page = self.path / "page.html"
        command = [TOOL, "report", self.file("a.yaml", self.SCENARIO), "-o", page]
        with subprocess.Popen(command, text=True, stdout=subprocess.PIPE,
                              stderr=subprocess.PIPE) as tool:
            client = self.talk(tool)
            said = [tool.stderr.readline() for _ in range(2)]
            out, error = tool.communicate(timeout=60)
            client.close()
        self.assertEqual(tool.returncode, 0, out + error)
        self.assertIn("frames 6  error frames 0", out)
        self.assertEqual(said, ["verican: waits for 1 client on can0\n", "verican: ready\n"])
        self.assertEqual(self.page(page), ({"sensor": 4, "can0": 2}, 6))

    def test_missing_interface_is_told_as_in_run(self):
        scenario = self.file("a.yaml", "nodes:\n  - {name: a}\n  - {name: pc, interface: nocan7}\n")
        said = self.refused("report", scenario, "-o", self.path / "page.html")
        self.assertIn("a.yaml:3: interface nocan7: ", said)
        self.assertEqual(said, self.refused("run", scenario))


if __name__ == "__main__":
    unittest.main()
