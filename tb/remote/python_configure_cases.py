# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""The Python client of remote nodes: settings behind the lock while answers are lost (RN-61,
RN-92).
"""
import pathlib
import sys
import unittest

import can

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "sw/remote"))

import verican_remote as remote  # noqa: E402  pylint: disable=wrong-import-position

READ, WRITE, SETUP, STATUS = 0x1F8, 0x1F9, 0x1FC, 0x1FE  # of node 3
LOCK = (SETUP, b"\2")


class Node:
    """A python-can bus with node 3 on it: the lock, writes of settings, and the counts that confirm
    them. Address FF0 is protected. What it says comes at once or never: without an answer the
    client's time is over at once."""

    def __init__(self):
        self.sent, self.said = [], []
        self.unlocked = self.deaf = False
        self.code = self.accepted = self.refused = 0
        self.deaf_from = lambda frame: False  # from this frame on, which it gets, nobody hears it

    def send(self, message, timeout=None):
        """As can.Bus."""
        del timeout
        frame = message.arbitration_id, bytes(message.data)
        self.sent.append(frame)
        self.deaf = self.deaf or self.deaf_from(frame)
        if message.is_remote_frame and frame[0] == STATUS:
            row = bytes([0, 0, 0, self.code, 0, self.accepted, self.refused, 0])
            self.said.append(can.Message(arbitration_id=STATUS | 0x400, data=row,
                                         is_extended_id=False))
        elif frame[0] == WRITE and not (self.unlocked and frame[1][:2] != b"\xF0\x0F"):
            self.refused, self.code = self.refused + 1, 0x10 if self.unlocked else 0x11
        elif frame[0] in (WRITE, SETUP):
            self.accepted, self.code = self.accepted + 1, 0
            if frame[0] == SETUP:
                self.unlocked = frame[1][0] == 1
        if self.deaf:
            self.said.clear()

    def recv(self, timeout=None):
        """As can.Bus."""
        del timeout
        return self.said.pop(0) if self.said else None


class Configure(unittest.TestCase):
    """configure() on that node."""

    def setUp(self):
        self.node = Node()
        self.client = remote.Client(self.node, rtr="always")

    def configure(self, *settings):
        """The call; what it did."""
        self.client.configure(3, 0xCAFE1233, settings)

    def test_answers_are_heard(self):
        """Unlocks, writes, locks."""
        self.configure((0xF02, b"\x14\0"))
        changes = [frame for frame in self.node.sent if frame[0] != STATUS]
        self.assertEqual(changes, [(SETUP, b"\1\x33\x12\xFE\xCA"),
                                   (WRITE, b"\x02\x0F\x14\0"), LOCK])
        self.assertFalse(self.node.unlocked)

    def test_unlock_is_not_confirmed(self):
        """It was carried out, and nobody hears of it."""
        self.node.deaf_from = lambda frame: frame[0] == SETUP
        with self.assertRaises(remote.Timeout):
            self.configure((0xF02, b"\x14\0"))
        self.assertEqual(self.node.sent[-1], LOCK)
        self.assertFalse(self.node.unlocked)

    def test_the_first_error_is_raised(self):
        """The refusal of a setting, not what comes of the lock behind it."""
        def confirmed(frame):  # the second request for STATUS behind the write is the lock's
            behind = [sent for sent in self.node.sent if sent[0] in (WRITE, STATUS)]
            return frame[0] == STATUS and len(behind) > 2 and behind[-3][0] == WRITE

        self.node.deaf_from = confirmed
        with self.assertRaises(remote.Refused) as refused:
            self.configure((0xFF0, b"\1"))
        self.assertEqual(refused.exception.code, 0x10)
        self.assertEqual(self.node.sent[-1], LOCK)
        self.assertFalse(self.node.unlocked)

    def test_a_node_that_is_not_there(self):
        """It is not sent UNLOCK, nor LOCK."""
        self.node.deaf = True
        with self.assertRaises(remote.Timeout):
            self.configure()
        self.assertEqual(self.node.sent, 3 * [(STATUS, b"")])


if __name__ == "__main__":
    unittest.main()
