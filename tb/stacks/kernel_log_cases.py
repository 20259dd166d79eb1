# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""What the judges of user-mode Linux take for a complaint of the kernel: lines as Linux 6.1 prints
them, and its command line, which holds paths of the user."""
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "sw/linux"))
import kernel_log  # noqa: E402  pylint: disable=wrong-import-position

FAULTS = [
    "[    1.1] WARNING: CPU: 0 PID: 1 at net/core/dev.c:10 skb_warn_bad_offload+0x1/0x2",
    "[    1.2] BUG: kernel NULL pointer dereference, address: 0000000000000000",
    "[    1.3] Call Trace:",
    "[    1.4] can0-cansend[12]: segfault at 0 ip 0000000000000000",
    "[    1.5] Out of memory: Killed process 42 (candump)",
]


class Complaints(unittest.TestCase):
    """kernel_log.complaints."""

    def test_faults_of_the_kernel_are_found(self):
        text = "[    1.0] can: raw protocol\n" + "\n".join(FAULTS)
        self.assertEqual(kernel_log.complaints(text), FAULTS)

    def test_words_of_a_driver_are_found_in_any_case(self):
        line = "[    2.0] flexcan e0000000.can: Error in probe"
        self.assertEqual(kernel_log.complaints(line), [])
        self.assertEqual(kernel_log.complaints(line, also="flexcan.*error"), [line])

    def test_a_path_on_the_command_line_is_no_complaint(self):
        for name in ("tmp.xBugY", "BUG:1", "debug", "a warning"):
            text = (f"[    0.0] Kernel command line: mem=64M init=/{name}/init\n"
                    f"[    0.0] Unknown kernel command line parameters \"OUT=/{name}\"\n")
            self.assertEqual(kernel_log.complaints(text, also=r"\bbug\b|\bwarning\b"), [], name)


if __name__ == "__main__":
    unittest.main()
