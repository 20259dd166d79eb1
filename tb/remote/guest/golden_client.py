#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""The golden vectors through the Python client and python-can on a CAN interface of Linux, as
tb/socketcan/guest/remote.sh runs it (RN-93). Environment: VERICAN_INTERFACE, VERICAN_LIFE (which of
the lives of vectors.yaml), VERICAN_PROFILE of the node.
"""
import os
import sys
import unittest
from pathlib import Path

import can

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
# ruff: noqa: E402  (the path must be set first)
import python_client_cases as cases


class GoldenOnInterface(cases.Vectors):
    """One life, whose node has said BOOT."""

    sends_remote_frames = True

    def test_every_vector(self):
        """RN-93."""
        life = self.lives()[int(os.environ["VERICAN_LIFE"])]
        bus = self.enterContext(can.Bus(interface="socketcan",
                                        channel=os.environ["VERICAN_INTERFACE"]))
        self.connect(bus, life["name_bits"])
        self.run_life(life, os.environ["VERICAN_PROFILE"])


if __name__ == "__main__":
    unittest.main()
