#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""tools/layers.py: an include that goes up is found and named; one that goes down is not."""

import subprocess
import tempfile
import unittest
from pathlib import Path

TOOL = Path(__file__).resolve().parents[2] / "tools/layers.py"


class Layers(unittest.TestCase):
    """A folder like sim/, with one source or two."""

    def run_on(self, **sources):
        """What the tool says of sources `folder`: text, and its status."""
        with tempfile.TemporaryDirectory() as root:
            for folder, text in sources.items():
                (Path(root) / folder).mkdir()
                (Path(root) / folder / "a.hpp").write_text(text)
            run = subprocess.run([TOOL, root], capture_output=True, text=True, check=False)
            return run.stdout.replace(root + "/", ""), run.returncode

    def test_down(self):
        said, status = self.run_on(bus='#include "bus/b.hpp"\n', node='#include "bus/a.hpp"\n')
        self.assertEqual((said, status), ("", 0))

    def test_up(self):
        said, status = self.run_on(bus='#pragma once\n\n#include "node/a.hpp"\n', node="")
        self.assertEqual(status, 1)
        self.assertIn("bus/a.hpp:3: bus includes from node, a layer above", said)

    def test_a_folder_without_a_layer(self):
        said, status = self.run_on(strange="")
        self.assertEqual(status, 1)
        self.assertIn("strange: no layer", said)

    def test_nothing_to_look_at(self):
        said, status = self.run_on()
        self.assertEqual(status, 1)
        self.assertIn("no folder with sources", said)

    def test_no_directory(self):
        run = subprocess.run([TOOL, "/nowhere"], capture_output=True, text=True, check=False)
        self.assertNotEqual(run.returncode, 0)
        self.assertIn("/nowhere is no directory", run.stderr)


if __name__ == "__main__":
    unittest.main()
