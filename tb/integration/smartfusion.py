#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""The project for SmartFusion, run by the Tcl of Yosys with Libero's commands replaced by
recorders: which files it names. What Libero does with them is not tested. What the constraints say:
constraints.py."""

import tempfile
import unittest
from pathlib import Path

import design

FOLDER = design.ROOT / "constraints/smartfusion"
# Libero's commands that the files use; any other is an error of Tcl.
RECORDERS = """\
foreach name {new_project import_files set_root save_project run_tool} {
  proc $name args "puts \\"RECORD\\\\t$name\\\\t\\[join \\$args \\\\t\\]\\""
}
"""


def records(script):
    """The commands of a script, each a list of words."""
    with tempfile.TemporaryDirectory() as name:
        runner = Path(name) / "recorders.tcl"
        runner.write_text(RECORDERS + f"source {{{script}}}\n", encoding="utf-8")
        code, text = design.run("yosys", "-q", "-c", runner, cwd=name)
    if code != 0:
        raise AssertionError(f"{script}:\n{text}")
    lines = (line.split("\t") for line in text.splitlines())
    return [words[1:] for words in lines if words[0] == "RECORD"]


class SmartFusion(unittest.TestCase):
    """What the project names is there."""

    def test_project_takes_the_rtl_and_the_constraints(self):
        done = records(FOLDER / "libero.tcl")
        imported = {option: [Path(words[2]) for words in done
                             if words[:2] == ["import_files", option]]
                    for option in ("-hdl_source", "-sdc", "-pdc")}
        self.assertEqual(imported["-hdl_source"], [design.ROOT / n for n in design.rtl_files()])
        self.assertEqual(imported["-sdc"], [FOLDER / "can.sdc"])
        self.assertEqual(imported["-pdc"], [FOLDER / "can.pdc"])
        self.assertTrue(all(path.is_file() for paths in imported.values() for path in paths))
        self.assertEqual(done[0][0], "new_project")
        self.assertIn(["set_root", "can_ahb"], done)
        self.assertEqual(done[-1], ["run_tool", "-name", "SYNTHESIZE"])


if __name__ == "__main__":
    unittest.main()
