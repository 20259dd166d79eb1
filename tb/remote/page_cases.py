# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""The reader of docs/remote.md can do what the page says, by copy and paste. Run by ctest:
VERICAN_BINARY=build/release/verican python3 -m unittest page_cases.Walk.test_from_top_to_bottom
"""
import os
import pathlib
import re
import subprocess
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
PATIENCE = 280
BLOCK = re.compile(r"(?P<before>[^\n]*)\n\n```(?P<kind>yaml|c|python|sh)\n(?P<text>.*?)^```$",
                   re.DOTALL | re.MULTILINE)
# What the test does otherwise: the build is there, few rounds are enough, a port that is free, the
# bridge as fast as it can with time-outs that no load of the computer reaches.
INSTEAD = {
    "make build\n": "",
    "--rounds 1000": "--rounds 20",
    "bridge --socketcand 29536 --bus my-nodes.yaml &":
        'bridge --fast --socketcand 127.0.0.1:0 --bus my-nodes.yaml 2>bridge.log &\n'
        'trap "kill $!" EXIT\n'
        # -s: the shell in the background may not have made the file yet.
        'until grep -qs ready bridge.log; do kill -0 $!; sleep 0.1; done\n'
        'PORT=$(sed -n "s/.*socketcand .* at 127.0.0.1://p" bridge.log)\n',
    "memory --socketcand 29536": "memory --timeout 5000 --socketcand $PORT",
    "/usr/bin/python3 ask.py": 'sed -i "s/29536/$PORT/" ask.py\n/usr/bin/python3 ask.py',
    "Client(bus)": "Client(bus, timeout=5, select_wait=0.5)",
}


def steps(page):
    """The page as a script for bash: files are written, commands are carried out."""
    script = ["set -eu"]
    for block in BLOCK.finditer(page):
        before, kind, text = block.group("before", "kind", "text")
        for words, others in INSTEAD.items():
            text = text.replace(words, others)
        file = re.search(r"[Ss]ave this as `([\w.-]+)`:$", before)
        if kind == "sh":
            script.append(text)
            if "export " in text:
                script.append('mkdir "$1"; cd "$1"  # an empty folder')
        elif file:
            script.append(f"cat >{file[1]} <<'END OF FILE'\n{text}END OF FILE")
    return "\n".join(script)


class Walk(unittest.TestCase):
    """RN-97: the tool, the client in C, the client in Python."""

    def test_from_top_to_bottom(self):
        """The sources, with the tool as build/release/verican; then an empty folder."""
        page = (ROOT / "docs/remote.md").read_text(encoding="utf-8")
        for words in INSTEAD:
            self.assertIn(words, page)
        with tempfile.TemporaryDirectory(prefix="verican-remote-page-") as folder:
            sources = pathlib.Path(folder) / "sources"
            (sources / "build/release").mkdir(parents=True)
            (sources / "build/release/verican").symlink_to(
                pathlib.Path(os.environ["VERICAN_BINARY"]).resolve())
            for name in "examples", "sw":
                (sources / name).symlink_to(ROOT / name)
            environment = {name: value for name, value in os.environ.items()
                           if name != "PYTHONPATH"}
            self.follow(steps(page), sources, environment)

    def follow(self, script, sources, environment):
        """What is printed, and what the program in C says without its interface."""
        empty = sources.parent / "empty"
        done = subprocess.run(["bash", "-c", script, "bash", str(empty)], cwd=sources, text=True,
                              env=environment, capture_output=True, timeout=PATIENCE, check=False)
        self.assertEqual((done.returncode, done.stderr), (0, ""), done.stdout)
        for line in ("The cabinet: 20 cycles;.*", "   6  [0-9A-F]{8} .*", "   7  [0-9A-F]{8} .*",
                     "6 [0-9A-F]{8}", "7 [0-9A-F]{8}", "01 02 00 00"):
            self.assertRegex(done.stdout, f"(?m)^{line}$")
        program = subprocess.run([empty / "outputs", "nocan0"], text=True, capture_output=True,
                                 timeout=PATIENCE, check=False)
        self.assertEqual(program.returncode, 1)
        self.assertRegex(program.stderr, r"^nocan0: .+\n$")


if __name__ == "__main__":
    assert os.environ["VERICAN_BINARY"]
    unittest.main()
