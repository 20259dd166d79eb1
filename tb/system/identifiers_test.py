# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# identifiers_test VERICAN ELF_FOLDER: the table of identifiers of run, replay, bridge and firmware.
"""Judges: what the scenario says of its periods, and the candump log of the same run, from which
identifiers are counted here anew."""
import csv
import json
import math
import pathlib
import re
import sys
import unittest

sys.path[:0] = ["tb/harness", "sw/linux"]
from frames import read_log
from tool_case import ToolCase

ELF_FOLDER = sys.argv.pop(1)
SECOND = 10**12  # ps
MICROSECOND = 10**6  # ps; a log has no more
BIT = 2 * MICROSECOND  # at 500 kbit/s

# Both messages of node a come at 10, 30, 50 ms: then 100 waits for the end of 080.
SCENARIO = """bitrate: 500k
duration: 60 ms
nodes:
  - {name: a}
  - {name: b}
traffic:
  - {node: a, id: 0x080, data: counter, dlc: 2, period: 20 ms, offset: 10 ms}
  - {node: a, id: 0x100, data: 11 22 33, period: 10 ms}
  - {node: b, id: 0x1ABCDEF0, extended: true, data: AA, offset: 5 ms}
  - {node: b, id: 0x300, remote: true, dlc: 2, period: 25 ms, offset: 1 ms}
"""
DATABASE = 'VERSION ""\nBO_ 256 Mode: 3 a\n SG_ First : 0|8@1+ (1,0) [0|255] "" b\n'
# Two bytes of data: 50 bits with at most 12 stuff bits, 10 from CRC delimiter to EOF, 3 between.
SHORTEST, LONGEST = (50 + 10 + 3) * BIT, (50 + 12 + 10 + 3) * BIT


def frames_of(log):
    """(identifier with flags, DLC, data, time in ps) of each line."""
    for entry in read_log(pathlib.Path(log)):
        frame = entry.frame
        key = frame.remote, frame.extended, frame.ident
        yield key, frame.dlc, frame.data, entry.time * MICROSECOND


def count_again(log):
    """The table, as docs/recordings.md defines it, of the frames of a candump log."""
    found = {}
    for key, dlc, data, time in frames_of(log):
        found.setdefault(key, []).append((dlc, data, time))
    table = []
    for (remote, extended, ident), frames in sorted(found.items()):
        times = [time for _, _, time in frames]
        periods = [b - a for a, b in zip(times, times[1:])]
        mean = sum(periods) / len(periods) if periods else 0
        spread = sum((p - mean)**2 for p in periods)
        longest = max(len(data) for _, data, _ in frames)
        table.append({
            "interface": "can0", "id": ident, "extended": extended, "remote": remote,
            "count": len(frames), "period_mean_ps": mean,
            "period_min_ps": min(periods, default=0), "period_max_ps": max(periods, default=0),
            "period_jitter_ps": math.sqrt(spread / len(periods)) if periods else 0,
            "first_ps": times[0], "last_ps": times[-1], "last_dlc": frames[-1][0],
            "last_data": frames[-1][1].hex(" ").upper(),
            "changed_bytes": [i for i in range(longest)
                              if len({data[i:i + 1] for _, data, _ in frames}) > 1]})
    return table


class Identifiers(ToolCase):
    def assert_same(self, table, judged, origin):
        """Times of a log are cut to microseconds and count from `origin`, ps, of the table's."""
        self.assertEqual(len(table), len(judged))
        for row, want in zip(table, judged):
            self.assertEqual(row.keys(), want.keys())
            for key in row:
                if not key.endswith("_ps"):
                    self.assertEqual(row[key], want[key], key)
                    continue
                shift = origin if key in ("first_ps", "last_ps") else 0
                self.assertAlmostEqual(row[key] + shift, want[key], delta=MICROSECOND, msg=key)

    def origin_of(self, table, judged):
        """When the scenario began, in the log: from the first row; the others must agree."""
        return judged[0]["first_ps"] - table[0]["first_ps"]

    def test_run_has_the_periods_of_its_scenario(self):
        scenario = self.file("a.yaml", SCENARIO)
        table = json.loads(self.passes("run", scenario, "--json"))["runs"][0]["identifiers"]
        rows = {(row["id"], row["remote"]): row for row in table}
        self.assertEqual([(row["id"], row["count"], row["last_data"], row["changed_bytes"])
                          for row in table],
                         [(0x080, 3, "02 00", [0]), (0x100, 6, "11 22 33", []),
                          (0x1ABCDEF0, 1, "AA", []), (0x300, 3, "", [])])
        # Nothing else is on the bus when these come: a period off by no more than a bit.
        for ident, remote, period, first in [(0x080, False, 20, 10), (0x300, True, 25, 1)]:
            row = rows[ident, remote]
            for key in ("period_mean_ps", "period_min_ps", "period_max_ps"):
                self.assertAlmostEqual(row[key], period * SECOND / 1000, delta=BIT, msg=key)
            self.assertLessEqual(row["period_jitter_ps"], BIT)
            self.assertAlmostEqual(row["first_ps"], first * SECOND / 1000, delta=20 * BIT)
        row = rows[0x100, False]
        period = 10 * SECOND / 1000
        for off in (row["period_max_ps"] - period, period - row["period_min_ps"]):
            self.assertTrue(SHORTEST - BIT <= off <= LONGEST + BIT, off)
        self.assertEqual(rows[0x1ABCDEF0, False]["period_mean_ps"], 0)

    def test_run_has_what_its_log_has(self):
        scenario, log = self.file("a.yaml", SCENARIO), self.path / "a.log"
        run = json.loads(self.passes("run", scenario, "--candump", log, "--json"))["runs"][0]
        judged = count_again(log)
        self.assert_same(run["identifiers"], judged, self.origin_of(run["identifiers"], judged))
        of_log = json.loads(self.passes("ids", log, "--json"))["identifiers"]
        first = min(row["first_ps"] for row in judged)
        self.assert_same(of_log, judged, first)

    def test_text_and_csv_of_a_run(self):
        scenario, table = self.file("a.yaml", SCENARIO), self.path / "ids.csv"
        self.assertNotIn("last data", self.passes("run", scenario))
        text = self.passes("run", scenario, "--ids", "--ids-csv", table)
        self.assertRegex(text, r"\n  can0 +080 +3 +20\.00\d +\d+\.\d+ +\d+\.\d+ .* 02\* 00\n")
        self.assertRegex(text, r"\n  can0 +1ABCDEF0 +1 +- +- +- +- +0\.005\d+ +0\.005\d+ +AA\n")
        rows = list(csv.DictReader(table.read_text().splitlines()))
        run = json.loads(self.passes("run", scenario, "--json"))["runs"][0]["identifiers"]
        for row, want in zip(rows, run, strict=True):
            self.assertEqual((int(row["id"], 16), int(row["count"]), row["last_data"]),
                             (want["id"], want["count"], want["last_data"]))
            self.assertAlmostEqual(float(row["period_mean_s"]), want["period_mean_ps"] / SECOND, 8)
            self.assertAlmostEqual(float(row["first_s"]), want["first_ps"] / SECOND, 8)

    def test_outputs_of_the_scenario_and_of_several_bit_rates(self):
        table = self.path / "ids.csv"
        text = SCENARIO.replace("500k", "[250k, 500k]") + f"outputs: {{ids_csv: {table}}}\n"
        run = json.loads(self.passes("run", self.file("a.yaml", text), "--json"))["runs"]
        self.assertEqual([len(r["identifiers"]) for r in run], [4, 4])
        for rate in ("250k", "500k"):
            self.assertEqual(len((self.path / f"ids-{rate}.csv").read_text().splitlines()), 5)

    def test_replay_has_the_table_of_its_bus_beside_that_of_the_recording(self):
        log, sent = self.path / "sent.log", self.path / "bus.log"
        log.write_text("".join(f"({100 + i // 40}.{i % 40 * 25000:06}) vcan0 "
                               f"{0x100 + i % 3:03X}#{i:04X}{'AB'[i > 20] * 2}\n"
                               for i in range(90)))
        args = ["replay", log, "--candump", sent]
        replayed = json.loads(self.passes(*args, "--json"))
        bus, judged = replayed["bus"]["identifiers"], count_again(sent)
        self.assert_same(bus, judged, self.origin_of(bus, judged))
        recorded = json.loads(self.passes("ids", log, "--json"))["identifiers"]
        self.assertEqual(replayed["identifiers"], recorded)
        for row, want in zip(bus, recorded, strict=True):
            self.assertEqual((row["id"], row["count"], row["last_data"], row["changed_bytes"]),
                             (want["id"], want["count"], want["last_data"], want["changed_bytes"]))
            self.assertEqual(want["period_mean_ps"], 0.075 * SECOND)
            self.assertAlmostEqual(row["period_mean_ps"], 0.075 * SECOND, delta=2 * BIT)
        fast = self.passes(*args, "--fast", "--ids")
        self.assertRegex(fast, r"\n  can0 +100 +30 +0\.\d+ ")

    def test_bridge(self):
        log = self.path / "a.log"
        report = json.loads(self.passes("bridge", "--socketcand", "0", "--time", "60ms",
                                      "--bus", self.file("a.yaml", SCENARIO), "--candump", log,
                                      "--json"))["bus"]
        judged = count_again(log)
        self.assertEqual(len(judged), 4)
        self.assert_same(report["identifiers"], judged,
                         self.origin_of(report["identifiers"], judged))
        plain = self.passes("bridge", "--socketcand", "0", "--time", "1ms", "--ids",
                          "--ids-csv", self.path / "ids.csv")
        self.assertIn("last data, * changes", plain)
        self.assertEqual(len((self.path / "ids.csv").read_text().splitlines()), 1)

    def test_firmware(self):
        log, table = self.path / "a.log", self.path / "ids.csv"
        args = ["firmware", f"{ELF_FOLDER}/ping.elf", f"{ELF_FOLDER}/pong.elf", "--bus",
                "sw/firmware/ping/ping.yaml", "--candump", log]
        bus = json.loads(self.passes(*args, "--json"))["buses"][0]
        judged = count_again(log)
        self.assertGreater(len(judged), 1)
        self.assert_same(bus["identifiers"], judged, self.origin_of(bus["identifiers"], judged))
        text = self.passes(*args, "--ids", "--ids-csv", table)
        self.assertIn("last data, * changes", text)
        self.assertNotIn("TEC (max)", text)
        self.assertEqual(len(table.read_text().splitlines()), 1 + len(judged))
        database = self.file("a.dbc", DATABASE)
        signals = self.passes(*args, "--signals", "--dbc", database)
        self.assertIn("frames of the database's messages", signals)


if __name__ == "__main__":
    unittest.main()
