# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""What the pages show of the tool is what it prints, and what they give it to read, it reads.

In docs/tool.md and docs/recordings.md a block of four blanks whose first line is "$ COMMAND" shows
commands and the beginning of what each prints; "$ cat FILE" shows a file that the next ones use. A
block without outputs only shows how to call the tool. Run by ctest: python3 -m unittest shown_test,
with VERICAN_BINARY and VERICAN_FIRMWARE (the folder of the ELF files, if there is one).
"""
import json
import os
import pathlib
import re
import shlex
import subprocess
import tempfile
import unittest

from figures_test import COMPILER, compiler_is_ours

ROOT = pathlib.Path(__file__).resolve().parents[2]
BLOCK = re.compile(r"^\n((?:    .*\n|\n(?=    ))+)", re.MULTILINE)
RECORDING = ROOT.parent / "shared/data/traffic/canboat_candumpSample3.txt"
# What the pieces of scenarios on a page lack, in their order.
LACKS = {
    "scenario.md": ["", "nodes:\n  - {name: host}\n", """nodes:
  - {name: host}
  - {name: pfc, type: remote, number: 6, serial: 1,
     config: {producers: [{send: 0x40, length: 4, triggers: 1}]}}
  - {name: other, type: remote, number: 3, serial: 2}
""", "nodes: [{name: a}, {name: b}]\n"],
    "signals.md": ["nodes: [{name: engine}, {name: peer}]\n"],
}


def text_of(page):
    """A page, by its name from the root."""
    return (ROOT / page).read_text(encoding="utf-8")


def tool(*words, **how):
    """What the tool prints."""
    return subprocess.run([os.environ["VERICAN_BINARY"], *map(str, words)], text=True, check=True,
                          stdout=subprocess.PIPE, **how).stdout


def steps(page):
    """The commands of each block that shows outputs, with the lines that each prints."""
    text = text_of(f"docs/{page}")
    for lines in BLOCK.findall(text):
        block = re.sub("^    ", "", lines, flags=re.MULTILINE)
        found = re.findall(r"^\$ (.*)\n((?:(?!\$ ).*\n)*)", block, re.MULTILINE)
        if found and any(shown for _, shown in found):
            yield found


class Shown(unittest.TestCase):
    """Each block in a folder of its own."""

    def follow(self, page):
        """How many commands were run."""
        count = 0
        for block in steps(page):
            with tempfile.TemporaryDirectory(prefix="verican-shown-") as folder:
                for command, shown in block:
                    words = shlex.split(command)
                    if words[0] == "cat":
                        (pathlib.Path(folder) / words[1]).write_text(shown, encoding="utf-8")
                        continue
                    self.assertEqual(words[0], "verican", command)
                    done = subprocess.run(
                        [os.environ["VERICAN_BINARY"], *words[1:]], cwd=folder, text=True,
                        capture_output=True, check=True)
                    printed = done.stdout + done.stderr  # as a terminal shows them
                    self.assertTrue(printed.startswith(shown),
                                    f"{page}: {command}\n{shown}\nprints\n{printed}")
                    count += 1
        return count

    def test_tool(self):
        self.assertEqual(self.follow("tool.md"), 1)

    def test_recordings(self):
        self.assertEqual(self.follow("recordings.md"), 1)


class Demo(unittest.TestCase):
    """What README.md shows of `make demo`: pieces of what each part prints, with "..." between."""

    def check(self, start, printed):
        """printed: of the part whose headline begins so."""
        shown = re.search(r"```\n(== .*?)```", text_of("README.md"), re.DOTALL)[1]
        part = re.search(rf"^== {re.escape(start)}.*\n((?:(?!== ).*\n)*)", shown, re.MULTILINE)[1]
        for piece in filter(str.strip, re.split(r"^\.\.\.$", part, flags=re.MULTILINE)):
            self.assertIn(piece.strip("\n"), printed)

    def test_example(self):
        example = "examples/arbitration.yaml"
        self.check(example, tool("run", example, cwd=ROOT))

    def test_paper(self):
        with tempfile.TemporaryDirectory(prefix="verican-shown-") as folder:
            printed = tool("paper", "--out", folder)
        self.check("The paper's experiments", printed.replace(folder, "build/release/out/paper"))

    def test_firmware(self):
        firmware = pathlib.Path(os.environ.get("VERICAN_FIRMWARE", ""))
        if not (firmware / "ping.elf").exists():
            self.skipTest("no firmware was built")
        if not compiler_is_ours():
            self.skipTest(f"the answers' times are those of gcc {COMPILER}")
        self.check("Cortex-M3 firmware: ping",
                   tool("firmware", firmware / "ping.elf", firmware / "pong.elf", "--bus",
                        ROOT / "sw/firmware/ping/ping.yaml"))

    def test_recording(self):
        if not RECORDING.exists():
            self.skipTest(f"{RECORDING} is not there")
        self.check("Replay of a real recording",
                   tool("replay", os.path.relpath(RECORDING, ROOT), "--nodes", 4, "--bitrate",
                        "250k", "--fast", cwd=ROOT, stderr=subprocess.DEVNULL))


class Given(unittest.TestCase):
    """What the reader copies from a page."""

    def test_scenarios(self):
        """Pieces of scenarios run, completed, without a warning."""
        for page, lacks in LACKS.items():
            pieces = re.findall(r"^```yaml\n(.*?)^```$", text_of(f"docs/{page}"), re.DOTALL | re.M)
            self.assertEqual(len(pieces), len(lacks), page)
            for piece, lack in zip(pieces, lacks):
                with self.subTest(page=page, piece=piece), \
                        tempfile.TemporaryDirectory(prefix="verican-shown-") as name:
                    folder = pathlib.Path(name)
                    (folder / "engine.dbc").symlink_to(ROOT / "examples/engine.dbc")
                    (folder / "bus.yaml").write_text(lack + piece, encoding="utf-8")
                    done = subprocess.run([os.environ["VERICAN_BINARY"], "run", "bus.yaml"],
                                          cwd=folder, text=True, capture_output=True, check=False)
                    self.assertEqual((done.returncode, done.stderr), (0, ""), done.stdout)

    def test_keys_of_reports(self):
        """docs/report.md has those that the page of a report lists itself."""
        listed = text_of("sim/report/page/src/keys.js").split("export const kKeys")[1]
        keys = " ".join(re.findall(r"^  \['(.*?)',", listed, re.MULTILINE)).replace("\u2212", "-")
        table = text_of("docs/report.md").split("## Mouse and keys")[1].split("\n## ")[0]
        self.assertEqual(set(keys.split()) - set(re.findall(r"`(.*?)`", table)), set())

    def test_bit_timings_of_instances(self):
        """Parameters of an instance are the first row of verican bittime."""
        for page, clock in (("docs/remote.md", "12M"), ("docs/time.md", "16M")):
            best = json.loads(tool("bittime", "-c", clock, "-b", "1M", "--json"))["settings"][0]
            names = "brp", "prop", "ps1", "ps2", "sjw"
            row = ", ".join(f".{name.capitalize()}({best[name]})" for name in names)
            self.assertTrue(row in text_of(page), f"{page} has not {row}")


if __name__ == "__main__":
    unittest.main()
