# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""The Python client of remote nodes: settings behind the lock while answers are lost (RN-61,
RN-92), writes confirmed by a node that talks by itself or is busy (RN-31).
"""
import pathlib
import sys
import unittest

import can

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "sw/remote"))

import verican_remote as remote  # noqa: E402  pylint: disable=wrong-import-position

READ, WRITE, SETUP, STATUS = 0x1F8, 0x1F9, 0x1FC, 0x1FE  # of node 3
STATEMENT, BUSY = 0x400, 0x06
LOCK = (SETUP, b"\2")
COUNTS = (READ, b"\xF2\x0F\6")


class Node:
    """A python-can bus with node 3 on it: the lock, writes of settings, and the counts that confirm
    them. Address FF0 is protected. As a small node it has room for one answer beside STATUS, which
    goes first; both leave when the client waits. Without an answer the client's time is over at
    once."""

    def __init__(self):
        self.sent = []
        self.status = self.answer = None
        self.unlocked = self.deaf = self.acknowledges = False
        self.code = self.a = self.accepted = self.refused = 0
        self.deaf_from = lambda frame: False  # from this frame on, which it gets, nobody hears it
        self.busy_at = lambda frame: False

    def _row(self):
        return bytes([0, 0, 0, self.code, self.a, self.accepted, self.refused, 0])

    def _result(self, identifier, code=0):
        """A request has been carried out or refused."""
        self.code, self.a = code, identifier & 0x7F
        self.accepted, self.refused = self.accepted + (not code), self.refused + bool(code)
        if code or self.acknowledges:
            self.status = STATUS | STATEMENT, self._row()

    def _asked(self, identifier, data):
        """For STATUS by a remote frame, or bytes of it by READ."""
        if self.answer or self.busy_at((identifier, data)):
            self._result(identifier, BUSY)
        else:
            self.answer = identifier | STATEMENT, data[:2] + self._row()[2 if data else 0:]

    def send(self, message, timeout=None):
        """As can.Bus."""
        del timeout
        frame = message.arbitration_id, bytes(message.data)
        self.sent.append(frame)
        self.deaf = self.deaf or self.deaf_from(frame)
        if frame[0] in (READ, STATUS):
            self._asked(*frame)
        elif frame[0] == WRITE and not (self.unlocked and frame[1][:2] != b"\xF0\x0F"):
            self._result(WRITE, 0x10 if self.unlocked else 0x11)
        elif frame[0] in (WRITE, SETUP):
            self._result(frame[0])
            if frame[0] == SETUP:
                self.unlocked = frame[1][0] == 1
        if self.deaf:
            self.status = self.answer = None

    def recv(self, timeout=None):
        """As can.Bus."""
        if not timeout or not (self.status or self.answer):
            return None
        if self.status:
            (identifier, data), self.status = self.status, None
        else:
            (identifier, data), self.answer = self.answer, None
        return can.Message(arbitration_id=identifier, data=data, is_extended_id=False)


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
        changes = [frame for frame in self.node.sent if frame != COUNTS]
        self.assertEqual(changes, [(SETUP, b"\1\x33\x12\xFE\xCA"),
                                   (WRITE, b"\x02\x0F\x14\0"), LOCK])
        self.assertFalse(self.node.unlocked)

    def test_a_number_is_no_bytes(self):
        """bytes(20) is twenty zeros, over all of the configuration."""
        for settings in ([(0xF02, 20)], [(0xF02, b"\x14\0"), (0xF04, True)]):
            with self.assertRaisesRegex(ValueError, "^data (20|True): allowed are bytes, as in b"):
                self.configure(*settings)
        with self.assertRaises(ValueError):
            self.client.configure(3, 0xCAFE1233, {0xF02: 20})
        self.assertEqual(self.node.sent, [])

    def test_unlock_is_not_confirmed(self):
        """It was carried out, and nobody hears of it."""
        self.node.deaf_from = lambda frame: frame[0] == SETUP
        with self.assertRaises(remote.Timeout):
            self.configure((0xF02, b"\x14\0"))
        self.assertEqual(self.node.sent[-1], LOCK)
        self.assertFalse(self.node.unlocked)

    def test_the_first_error_is_raised(self):
        """The refusal of a setting, not what comes of the lock behind it."""
        def confirmed(frame):  # the second reading of the counts behind the write is the lock's
            behind = [sent for sent in self.node.sent if sent[0] == WRITE or sent == COUNTS]
            return frame == COUNTS and len(behind) > 2 and behind[-3][0] == WRITE

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
        self.assertEqual(self.node.sent, 3 * [COUNTS])


class Confirmed(unittest.TestCase):
    """write_confirmed() on that node."""

    def setUp(self):
        self.node = Node()
        self.node.unlocked = True
        self.client = remote.Client(self.node, rtr="always")

    def test_a_status_of_the_nodes_own(self):
        """It is not taken for the counts (RN-31), and none of the readings makes the node busy."""
        self.node.acknowledges = True
        for i in range(100):
            self.client.write_confirmed(3, 0xF02, bytes([i]))
        self.assertEqual((self.node.accepted, self.node.refused), (100, 0))

    def test_a_busy_node(self):
        """A reading that is refused is no refusal of the write; one refusal more is one."""
        def behind_a_write(frame):
            return frame == COUNTS and WRITE in [sent[0] for sent in self.node.sent[-2:]]

        self.node.busy_at = behind_a_write
        self.client.write_confirmed(3, 0xF02, b"\1")
        self.assertEqual((self.node.accepted, self.node.refused), (1, 1))
        with self.assertRaises(remote.Refused):
            self.client.write_confirmed(3, 0xFF0, b"\1")
        self.assertEqual((self.node.accepted, self.node.refused), (1, 3))


if __name__ == "__main__":
    unittest.main()
