# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""docs/json.md names each key of what `verican COMMAND --json` prints.

Run by ctest: python3 -m unittest json_test, with VERICAN_BINARY.
"""
import json
import os
import pathlib
import re
import subprocess
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
# Their keys are names of signals and interfaces.
NAMED = ("entries.signals", "events.signals", "interfaces")
# A node of each kind that has keys of its own.
BUS = """
bitrate: 500k
duration: 20 ms
dbc: engine.dbc
nodes:
  - {name: host}
  - {name: player, replay: one.log}
  - {name: pfc, type: remote, number: 6}
  - {name: can0, socketcand: "127.0.0.1:0"}
traffic: [{node: host, message: EngineData, data: {Mode: Sport}, period: 5 ms}]
commands: [{node: host, do: [operate, trigger]}]
faults: [{kind: flip, node: host, from: 3 ms, for: 20 us, hits: {min: 0}}]
expect: {error_frames: {max: 9999}}
"""
RECORDING = "(1.000000) can0 100#802500203C000000\n(1.010000) can0 123#00\n"


def keys(value, path=""):
    """The paths of all keys."""
    if isinstance(value, list):
        return {key for one in value for key in keys(one, path)}
    if not isinstance(value, dict) or path.endswith(NAMED):
        return set()
    below = {name: f"{path}.{name}" if path else name for name in value}
    return {*below.values(), *(key for name in value for key in keys(value[name], below[name]))}


class Json(unittest.TestCase):
    """In a folder with a scenario, a recording and a database."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="verican-json-")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        (self.folder / "engine.dbc").symlink_to(ROOT / "examples/engine.dbc")
        (self.folder / "bus.yaml").write_text(BUS, encoding="utf-8")
        (self.folder / "one.log").write_text(RECORDING, encoding="utf-8")
        page = (ROOT / "docs/json.md").read_text(encoding="utf-8")
        for other, start in (("tool.md", "### Identifiers"), ("timesync.md", "## The tool")):
            page += (ROOT / "docs" / other).read_text(encoding="utf-8").split(start)[1]
        self.described = set(re.findall(r"`(\w+)`", page))

    def check(self, *words, least):
        """least: so many keys there are, so that the command was not refused."""
        done = subprocess.run([os.environ["VERICAN_BINARY"], *words, "--json"], cwd=self.folder,
                              text=True, capture_output=True, check=False, timeout=100)
        self.assertIn(done.returncode, (0, 1), done.stderr)
        found = keys(json.loads(done.stdout))
        self.assertEqual({key for key in found if key.split(".")[-1] not in self.described}, set(),
                         words)
        self.assertGreaterEqual(len(found), least, words)

    def test_buses(self):
        self.check("run", "bus.yaml", least=160)
        self.check("replay", "one.log", "--dbc", "engine.dbc", least=100)
        self.check("bridge", "--socketcand", "127.0.0.1:0", "--time", "10ms", least=70)

    def test_recordings(self):
        self.check("ids", "one.log", least=15)
        self.check("signals", "one.log", "--dbc", "engine.dbc", least=25)

    def test_waveform(self):
        subprocess.run([os.environ["VERICAN_BINARY"], "run", "-q", "bus.yaml", "--vcd", "bus.vcd"],
                       cwd=self.folder, check=True, stderr=subprocess.DEVNULL)
        self.check("decode", "bus.vcd", "--dbc", "engine.dbc", least=20)

    def test_others(self):
        self.check("bittime", "-b", "500k", least=20)
        self.check("bittime", "--table", least=5)
        self.check("paper", "--no-waves", least=50)
        self.check("timesync", "--seeds", "1", "--intervals", "20", least=45)

    def test_firmware(self):
        firmware = pathlib.Path(os.environ.get("VERICAN_FIRMWARE", "")) / "pong.elf"
        if not firmware.exists():
            self.skipTest("no firmware was built")
        alone = "".join(line for line in BUS.splitlines(True) if "socketcand" not in line)
        (self.folder / "alone.yaml").write_text(alone, encoding="utf-8")
        self.check("firmware", str(firmware), "--bus", "alone.yaml", "--time", "5ms",
                   "--endless", least=100)


if __name__ == "__main__":
    unittest.main()
