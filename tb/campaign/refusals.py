# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""RefusalCase: tests of what the campaign's programs refuse, before they work.

A program that began its work instead would take minutes to hours.
"""
import os
import signal
import subprocess
import tempfile
import unittest
from pathlib import Path

SECONDS = 30
# What is said to be allowed.
SEEDS, SCALES, JOBS = "allowed: 0 to 9223372036854775807", "above 0, at most 1", "1 to 64"


class RefusalCase(unittest.TestCase):
    """Programs are started in a folder of the test's own, without variables of a campaign."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="verican-campaign-")
        self.addCleanup(folder.cleanup)
        self.path = Path(folder.name)

    def run_it(self, *command, **variables):
        """(exit code, stdout, stderr); a code below 0 is a signal's."""
        clean = {name: value for name, value in os.environ.items()
                 if not name.startswith("CAMPAIGN_")}
        process = subprocess.Popen(list(map(str, command)), env={**clean, **variables},
                                   cwd=self.path, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                                   stderr=subprocess.PIPE, text=True, start_new_session=True)
        try:
            text, said = process.communicate(timeout=SECONDS)
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, signal.SIGKILL)  # its workers, too
            process.communicate()
            self.fail(f"it still runs after {SECONDS} s")
        return process.returncode, text, said

    def refused(self, text, *command, code=None, **variables):
        """The program says text, is not ended by a signal, and leaves nothing behind."""
        with self.subTest(command=command, **variables):
            status, _, said = self.run_it(*command, **variables)
            self.assertGreater(status, 0, said)
            self.assertIn(text, said)
            if code is not None:
                self.assertEqual(status, code, said)
            self.assertEqual(list(self.path.iterdir()), [])
