# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# tool_test VERICAN ELF_FOLDER: signals in the tool as a user meets them: scenario, log, waveform,
# page, firmware, bridge.
"""Expected bytes are worked out by hand from examples/engine.dbc."""
import csv
import json
import pathlib
import sys
import unittest

sys.path.insert(0, "tb/harness")
from tool_case import ToolCase

ELF_FOLDER = sys.argv.pop(1)
SCENARIO = "examples/signals.yaml"
DBC = "examples/engine.dbc"
# 9600 = 0x2580, Mode 2 from bit 28 on, start value 60 = 0x3C.
ENGINE_DATA = "100#802500203C000000"
DASHBOARD = "200#017D0000"  # page 1, 125 = 0x7D
EEC1 = "0CF00400#000000004B000000"  # 19200 = 0x4B00


class Signals(ToolCase):
    def log(self, *frames):
        path = self.path / "frames.log"
        path.write_text("".join(f"({1 + i}.000000) can0 {f}\n" for i, f in enumerate(frames)))
        return path

    def test_times_before_the_first_frame_without_a_time_of_day(self):
        """PCAN-View 1.1: ms since the start; the lines begin with the earliest one."""
        path = self.path / "back.trc"
        path.write_text(";$FILEVERSION=1.1\n  1) 100.0 Rx 0200 2 01 7D\n"
                        "  2) 50.0 Rx 0200 2 01 7C\n  3) 40.5 Rx 0123 0\n")
        result = self.tool("signals", path, "--dbc", DBC)
        self.assertEqual(result.stderr, f"verican: warning: {path}: frame 2 is 50.000 ms before "
                                        "frame 1\n")
        self.assertEqual([line.split()[0] for line in result.stdout.splitlines()],
                         ["(0000000000.059500)", "(0000000000.009500)", "(0000000000.000000)"])
        table = self.path / "signals.csv"
        self.passes("signals", path, "--dbc", DBC, "--csv", table)
        with open(table, encoding="utf-8") as file:
            times = [row["time"] for row in csv.DictReader(file)]
        self.assertEqual(sorted(set(times)), ["0.009500000", "0.059500000"])

    def test_what_is_no_classical_frame_is_told(self):
        log = self.log("100##180250020", ENGINE_DATA, "20000004#0000080000000000")
        result = self.tool("signals", log, "--dbc", DBC)
        self.assertEqual((result.returncode, result.stdout.count("\n")), (0, 1))
        self.assertEqual(result.stderr,
                         f"verican: warning: {log}: without 1 CAN FD frame, 1 error message\n")
        result = self.tool("signals", self.log("7FF#"), "--dbc", DBC)
        self.assertEqual(result.returncode, 1)
        self.assertIn("none of its 1 frame is in the database", result.stderr)

    def scenario(self, old, new):
        """The example with a part replaced; a line of its own for each key that is of interest."""
        text = pathlib.Path(SCENARIO).read_text()
        self.assertIn(old, text)
        (self.path / "engine.dbc").write_bytes(pathlib.Path(DBC).read_bytes())
        path = self.path / "scenario.yaml"
        path.write_text(text.replace(old, new))
        return path

    def test_scenario_sends_what_its_signals_say(self):
        log = self.path / "out.log"
        text = self.passes("run", SCENARIO, "--candump", log)
        self.assertIn("ok    EngineData.EngineSpeed count: 10 (expected 10)", text)
        self.assertIn("ok    EngineData.Mode: 2 (expected 2)", text)
        frames = [line.split()[2] for line in log.read_text().splitlines()]
        self.assertEqual(sorted(set(frames)), sorted([ENGINE_DATA, DASHBOARD, EEC1]))
        self.assertEqual([frames.count(f) for f in (ENGINE_DATA, DASHBOARD, EEC1)], [10, 2, 5])

    def test_expectations_of_signals_fail(self):
        for old, new, said in [
                ("EngineData.Mode: Sport", "EngineData.Mode: Eco", "FAIL  EngineData.Mode: 2"),
                ("{last: 62.5}", "{last: 62}", "FAIL  Dashboard.FuelLevel last: 62.5 %"),
                ("{count: 0}", "{min: 0}", "FAIL  Dashboard.Odometer: never there"),
                ("count: 10, min: 2400", "count: 9, min: 2400", "count: 10 (expected 9)"),
                ("max: 2400}", "max: 2400}\n    EngineData.Torque: {min: 1}",
                 "FAIL  EngineData.Torque: 0 (expected at least 1)")]:
            with self.subTest(new):
                self.assertIn(said, self.passes("run", self.scenario(old, new), code=1))

    def test_an_expectation_of_nothing_is_refused(self):
        self.assertIn("expect.signals.Dashboard.FuelLevel: nothing is in it; allowed: count, first",
                      self.refused("run", self.scenario("{last: 62.5}", "{}")))

    def wide_scenario(self, expected):
        """A frame with an integer and a frame with a float, both of 64 bits, and a float that is
        none: what is expected of them."""
        (self.path / "wide.dbc").write_text(
            'BO_ 1 I: 8 X\n SG_ S : 0|64@1- (1,0) [0|0] "" X\n'
            'BO_ 2 U: 8 X\n SG_ S : 0|64@1+ (-1,0) [0|0] "" X\n'
            'BO_ 3 F: 8 X\n SG_ S : 0|32@1- (1,0) [0|0] "" X\nSIG_VALTYPE_ 3 S : 1;\n')
        path = self.path / "wide.yaml"
        path.write_text(
            "name: wide\nbitrate: 500k\nduration: 4 ms\ndbc: wide.dbc\n"
            "nodes: [{name: a, clock: 8 MHz}, {name: b, clock: 8 MHz}]\ntraffic:\n"
            "  - {node: a, name: i, message: I, data: {S: 9223372036854775807}, period: 8 ms}\n"
            "  - {node: a, name: j, message: I, data: {S: 9223372036854775806}, period: 8 ms,"
            " offset: 1 ms}\n"
            "  - {node: a, name: f, id: 3, data: [0, 0, 0x80, 0x3F], period: 8 ms}\n"
            "  - {node: a, name: n, id: 3, data: [0, 0, 0xC0, 0x7F], period: 8 ms,"
            " offset: 2 ms}\n"
            f"expect:\n  signals:\n    {expected}\n")
        return path

    def test_integers_of_64_bits_are_compared_exactly(self):
        for expected, said in [
                ("I.S: {last: 9223372036854775807}",
                 "FAIL  I.S last: 9223372036854775806 (expected 9223372036854775807)"),
                ("I.S: {max: 9223372036854775806}",
                 "FAIL  I.S: 9223372036854775806 to 9223372036854775807 (expected at most "
                 "9223372036854775806)"),
                ("I.S: {min: 9223372036854775807}", "FAIL  I.S: 9223372036854775806 to 92233720")]:
            with self.subTest(expected):
                self.assertIn(said, self.passes("run", self.wide_scenario(expected), code=1))
        self.passes("run", self.wide_scenario(
            "I.S: {first: 9223372036854775807, min: 9223372036854775806, last: {max: "
            "9223372036854775806}}"))

    def test_limits_that_cannot_be_compared_exactly_are_refused(self):
        for expected in ("I.S: {max: 1e18}", "U.S: {min: -9007199254740993}"):
            self.assertIn("cannot be compared exactly", self.refused(
                "run", self.wide_scenario(expected)))

    def test_a_float_that_is_no_number_is_in_no_range(self):
        text = self.passes("run", self.wide_scenario("F.S: 1"), code=1)
        self.assertIn("FAIL  F.S: 1, nan in 1 frames (expected 1)", text)

    def test_bad_signals_are_refused_with_line_and_what_is_allowed(self):
        for old, new, said in [
                ("EngineSpeed: 2400, Mode", "EngineSpeed: 9000, Mode",
                 "scenario.yaml:14: traffic[0].data.EngineSpeed: '9000' is not allowed; allowed: "
                 "0 to 8000 rpm in steps of 0.25"),
                ("Mode: Sport}", "Mode: Fast}", "allowed: 0 to 6 in steps of 1, Off, Eco, Sport"),
                ("Mode: Sport}", "Gear: 1}", "message EngineData has no such signal; allowed: "),
                ("{Page: 1, FuelLevel", "{Page: 0, FuelLevel",
                 "FuelLevel: is there only while Page has the raw value 1"),
                ("message: Dashboard", "message: Dashbord", "no message 'Dashbord'"),
                ("id: 0x0CF00400", "id: 0x0CF00500", "an identifier of its parameter group 61444"),
                ("dbc: engine.dbc", "dbc: gone.dbc", "gone.dbc: no such file"),
                ("dbc: engine.dbc\n", "", "needs a database; allowed: 'dbc' in the scenario"),
                ("EngineData.Mode: Sport", "EngineData.Moode: 1", "has no signal 'Moode'"),
                ("EngineData.Mode: Sport", "EngineData: 1",
                 "is no signal; allowed: message.signal")]:
            with self.subTest(new):
                self.assertIn(said, self.refused("run", self.scenario(old, new)))

    def test_signals_of_a_log(self):
        log = self.log(ENGINE_DATA, DASHBOARD, EEC1, "18F00431#0000001027000000", "123#00",
                       "100#R8")
        self.assertEqual(self.passes("signals", log, "--dbc", DBC).splitlines(), [
            f"(0000000001.000000) can0 {ENGINE_DATA} :: EngineData(EngineSpeed: 2400 rpm, "
            "Torque: 0 Nm, Mode: Sport, CoolantTemperature: 20 degC)",
            f"(0000000002.000000) can0 {DASHBOARD} :: Dashboard(Page: 1, FuelLevel: 62.5 %)",
            f"(0000000003.000000) can0 {EEC1} :: EEC1(EngineSpeed: 2400 rpm)",
            "(0000000004.000000) can0 18F00431#0000001027000000 :: EEC1(EngineSpeed: 1250 rpm)",
            "(0000000005.000000) can0 123#00 :: unknown",
            "(0000000006.000000) can0 100#R8 :: EngineData, remote"])

    def test_units_and_choices_do_not_reach_the_terminal_as_commands(self):
        dbc = self.file("escape.dbc", 'BO_ 1 A: 2 X\n SG_ S : 0|8@1+ (1,0) [0|0] "\x1b[31m" X\n'
                                      ' SG_ T : 8|8@1+ (1,0) [0|0] "" X\nVAL_ 1 T 2 "a\x07b" ;\n')
        log = self.log("001#0102")
        self.assertIn(":: A(S: 1 ?[31m, T: a?b)\n", self.passes("signals", log, "--dbc", dbc))
        table = self.passes("signals", log, "--dbc", dbc, "--table").splitlines()
        self.assertTrue(table[2].endswith("  ?[31m"), table)
        self.assertIn(" a?b ", table[3])

    def test_lines_have_the_whole_microseconds_of_the_log(self):
        log = self.file("ns.log", f"(1.000000900) can0 {EEC1}\n(2.000001100) can0 {EEC1}\n")
        lines = self.passes("signals", log, "--dbc", DBC).splitlines()
        self.assertEqual([line.split()[0] for line in lines],
                         ["(0000000001.000000)", "(0000000002.000001)"])

    def test_table_json_and_csv_of_a_log(self):
        log = self.log(EEC1, "18F00431#0000001027000000", "123#00")
        table = self.passes("signals", log, "--dbc", DBC, "--table").splitlines()
        self.assertIn("2 frames of the database's messages, 1 others", table[0])
        self.assertEqual(table[2].split(),
                         ["EEC1.EngineSpeed", "2", "1250", "1250", "2400", "1825", "rpm"])
        data = json.loads(self.passes("signals", log, "--dbc", DBC, "--json"))
        self.assertEqual(data["frames"], {"known": 2, "unknown": 1})
        self.assertEqual(data["signals"][0]["first"], {"value": 2400.0, "unit": "rpm"})
        self.assertEqual(data["entries"][1]["signals"],
                         {"EngineSpeed": {"value": 1250.0, "unit": "rpm"}})
        self.assertNotIn("message", data["entries"][2])
        self.assertEqual(self.passes("signals", log, "--dbc", DBC, "--csv", "-").splitlines(), [
            "time,interface,id,message,signal,raw,value,unit,choice",
            "1.000000000,can0,0CF00400,EEC1,EngineSpeed,19200,2400,rpm,",
            "2.000000000,can0,18F00431,EEC1,EngineSpeed,10000,1250,rpm,"])

    def test_a_log_without_any_message_of_the_database_is_a_failure(self):
        result = self.tool("signals", self.log("123#00"), "--dbc", DBC)
        self.assertEqual(result.returncode, 1)
        self.assertIn("none of its 1 frame is in the database", result.stderr)

    def test_replay_decode_and_page(self):
        log = self.log(ENGINE_DATA, DASHBOARD, EEC1)
        vcd, table, page = (self.path / name for name in ("bus.vcd", "s.csv", "page.html"))
        text = self.passes("replay", log, "-b", "250k", "--fast", "--dbc", DBC, "--signals",
                           "--vcd", vcd, "--signals-csv", table)
        self.assertIn("EngineData.Mode", text)
        self.assertEqual(len(table.read_text().splitlines()), 8)
        decoded = self.passes("decode", vcd, "--dbc", DBC)
        self.assertIn(" :: Dashboard(Page: 1, FuelLevel: 62.5 %)", decoded)
        events = json.loads(self.passes("decode", vcd, "--dbc", DBC, "--json"))["events"]
        self.assertEqual([e["message"] for e in events], ["EngineData", "Dashboard", "EEC1"])
        self.passes("report", log, "-o", page, "--dbc", DBC, "--fast")
        self.assertIn('"databases":[{"name":"engine.dbc","text":"VERSION', page.read_text())

    def test_times_of_the_csv_are_those_of_the_log(self):
        log, table = self.path / "bus.log", self.path / "s.csv"
        self.passes("run", SCENARIO, "--candump", log, "--signals-csv", table)
        logged = [int(line.split()[0].strip("()").replace(".", ""))  # microseconds
                  for line in log.read_text().splitlines()]
        rows = csv.DictReader(table.read_text().splitlines())
        times = dict.fromkeys(int(row["time"].replace(".", "")) // 1000 for row in rows)
        self.assertEqual(list(times), logged)

    def test_firmware(self):
        # ping.c: byte i of ping n is n + 17 i; each byte of its answer is the complement.
        database = self.file("ping.dbc", 'VERSION ""\n' + "".join(
            f"BO_ {ident} {name}: 8 a\n SG_ N : 0|8@1+ (1,0) [0|255] \"\" b\n"
            ' SG_ Third : 24|8@1+ (1,-51) [-51|204] "x" b\n'
            for ident, name in [(0x100, "Ping"), (0x101, "Pong")]))
        args = ["firmware", f"{ELF_FOLDER}/ping.elf", f"{ELF_FOLDER}/pong.elf", "--bus",
                "sw/firmware/ping/ping.yaml", "--dbc", database]
        signals = json.loads(self.passes(*args, "--json"))["buses"][0]["signals"]
        # 22 frames: ten pings and answers; the eleventh of each has no data.
        self.assertEqual(signals["frames"], {"known": 22, "unknown": 0})
        self.assertEqual(
            [(s["message"], s["signal"], s["count"], s["first"]["value"], s["last"]["value"],
              s["min"], s["max"]) for s in signals["signals"]],
            [("Ping", "N", 10, 0, 9, 0, 9), ("Ping", "Third", 10, 0, 9, 0, 9),
             ("Pong", "N", 10, 255, 246, 246, 255), ("Pong", "Third", 10, 153, 144, 144, 153)])
        text = self.passes(*args, "--signals")
        self.assertRegex(text, r"\n  Pong\.Third +10 +144 +144 +153 +148\.5  x\n")

    def test_bridge(self):
        bus = self.file("bus.yaml", "nodes:\n  - {name: engine}\n  - {name: display}\ntraffic:\n"
                        "  - {node: engine, id: 0x100, data: 80 25 00 20 3C 00 00 00, count: 3,"
                        " period: 5 ms}\n  - {node: display, id: 0x300}\n")
        args = ["bridge", "--socketcand", "0", "--time", "20ms", "--bus", bus, "--dbc", DBC]
        table, page = self.path / "s.csv", self.path / "page.html"
        report = json.loads(self.passes(*args, "--json", "--signals-csv", table, "--report", page))
        signals = report["bus"]["signals"]
        self.assertEqual(signals["frames"], {"known": 3, "unknown": 1})
        last = {s["signal"]: (s["count"], s["last"]["value"]) for s in signals["signals"]}
        self.assertEqual(last,
                         {"EngineSpeed": (3, 2400), "Torque": (3, 0), "Mode": (3, 2),
                          "CoolantTemperature": (3, 20)})
        self.assertEqual(len(table.read_text().splitlines()), 1 + 3 * 4)
        self.assertIn('"databases":[{"name":"engine.dbc","text":"VERSION', page.read_text())
        self.assertRegex(self.passes(*args, "--signals"),
                         r"\n  EngineData\.EngineSpeed +3 +2400 +2400 +2400 +2400  rpm\n")

    def test_json_of_a_run(self):
        run = json.loads(self.passes("run", SCENARIO, "--json"))["runs"][0]
        summary = {f"{s['message']}.{s['signal']}": s for s in run["signals"]["signals"]}
        self.assertEqual(summary["EngineData.Mode"]["last"], {"value": 2, "text": "Sport"})
        self.assertEqual(summary["EEC1.EngineSpeed"]["count"], 5)

    def test_options_that_need_a_database(self):
        for option in (["--signals"], ["--signals-csv", self.path / "x.csv"]):
            said = self.refused("run", "examples/two-nodes.yaml", *option)
            self.assertIn(f"{option[0]}: needs a database; allowed: --dbc FILE", said)
        self.assertIn("--dbc is required", self.refused("signals", self.log(EEC1)))
        self.assertIn("allowed: one message for an identifier",
                      self.refused("signals", self.log(EEC1), "--dbc", DBC, "--dbc", DBC))

    def test_a_database_of_which_nothing_is_shown(self):
        log, bus = self.log(ENGINE_DATA), self.file("bus.yaml", "nodes: [{name: a}, {name: b}]\n")
        commands = [("run", bus), ("replay", log), ("replay", log, "--bus", bus),
                    ("bridge", "--socketcand", "0", "--time", "1ms"),
                    ("firmware", f"{ELF_FOLDER}/ping.elf", "--bus", "sw/firmware/ping/ping.yaml")]
        for command in commands:
            with self.subTest(command):
                said = self.refused(*command, "--dbc", DBC, "--ids", "--vcd", self.path / "x.vcd")
                self.assertIn("--dbc: nothing shows its signals; allowed: with --signals, "
                              "--signals-csv, --json or --report-page", said)
                self.assertFalse((self.path / "x.vcd").exists())
        shown = self.file("shown.yaml", "nodes: [{name: a}, {name: b}]\n"
                          f"outputs: {{report: {self.path}/bus.html}}\n")
        self.passes("run", shown, "--dbc", DBC)
        self.passes("run", bus, "--dbc", DBC, "--report", self.path / "page.html")


if __name__ == "__main__":
    unittest.main()
