# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""The Python client of remote nodes: what a client before has left behind in a node, and interfaces
that are full or gone (RN-42, RN-91, RN-92).
"""
import errno
import pathlib
import sys
import unittest
import unittest.mock

import can

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "sw/remote"))

# pylint: disable=wrong-import-position
import verican_remote as remote  # noqa: E402
import verican_remote_link  # noqa: E402


BLOCK, DATA = 0x1FA, 0x1FB  # of node 3
STATEMENT = 0x400
BUSY, OPEN, ABORTED = 0x06, 0x05, 0x14


class Node:
    """A python-can bus with node 3 on it, which has a block write open. What it says is heard when
    the client waits; without an answer the client's time is over at once."""

    def __init__(self, tag):
        self.transfer = 2, tag
        self.memory = b"\1\2\3"
        self.said = []

    def _say(self, identifier, *data):
        self.said.append(can.Message(arbitration_id=identifier | STATEMENT, data=data,
                                     is_extended_id=False))

    def _block(self, op, tag, *_):
        if op == 0:
            self._say(BLOCK, *self.transfer, ABORTED, 0, 0, 0)
            self.transfer = None
        elif self.transfer:
            self._say(0x1FE, 2, 0, 0, BUSY, BLOCK & 0x7F, 0, 1, 0)
        elif op == 1:
            self._say(DATA, 0, *self.memory)
            self._say(BLOCK, op, tag, 0, 0, len(self.memory), 0)
        else:
            self.transfer = op, tag
            self._say(BLOCK, op, tag, OPEN, 0, 0, 0)

    def send(self, message, timeout=None):
        """As can.Bus."""
        del timeout
        if message.arbitration_id == BLOCK:
            self._block(*message.data)
        elif self.transfer:
            self.memory = bytes(message.data[1:])
            self._say(BLOCK, *self.transfer, 0, 0, len(self.memory), 0)
            self.transfer = None

    def recv(self, timeout=None):
        """As can.Bus."""
        return self.said.pop(0) if timeout and self.said else None


class LeftOpen(unittest.TestCase):
    """Block transfers of a client before."""

    def test_tag_of_the_next_try(self):
        """The answer to the abort has the tag of what is aborted: it answers no other BLOCK."""
        for tag in 1, 2, 3:
            self.assertEqual(remote.Client(Node(tag)).block_read(3, 0x300, 3), b"\1\2\3")
            node = Node(tag)
            remote.Client(node).block_write(3, 0x300, b"\4\5\6")
            self.assertEqual(node.memory, b"\4\5\6")


class Interface:
    """A python-can bus whose calls fail with `failures`, one after the other."""

    def __init__(self, *failures):
        self.failures, self.sent = list(failures), []

    def _fail(self):
        if self.failures:
            raise self.failures.pop(0)

    def send(self, message, timeout=None):
        """As can.Bus."""
        del timeout
        self._fail()
        self.sent.append(bytes(message.data))

    def recv(self, timeout=None):
        """As can.Bus."""
        if timeout:
            self._fail()


def no_room():
    """As python-can's socketcan has it when the queue of the interface is full."""
    return can.CanOperationError("Failed to transmit: No buffer space available", errno.ENOBUFS)


class Interfaces(unittest.TestCase):
    """What the client makes of those failures."""

    def test_no_room(self):
        """A queue that is full makes the client wait: each frame is sent, and once."""
        interface = Interface(no_room(), no_room())
        remote.Client(interface).write(3, 0, bytes(range(16)))
        self.assertEqual(interface.sent, [bytes(range(8)), bytes(range(8, 16))])

    def test_no_room_for_ever(self):
        """One that stays full is no bus-off, but a time-out."""
        with unittest.mock.patch.object(verican_remote_link, "SEND", 0.0):
            with self.assertRaisesRegex(remote.Timeout, "no room"):
                remote.Client(Interface(no_room())).trigger(1)

    def test_gone(self):
        """However an interface of python-can says so: socketcand's lets errors of the socket
        through."""
        for failure in (can.CanOperationError("down", errno.ENETDOWN), can.CanError("gone"),
                        BrokenPipeError(errno.EPIPE, "Broken pipe")):
            with self.assertRaises(remote.BusOff):
                remote.Client(Interface(failure)).trigger(1)
            with self.assertRaises(remote.BusOff):
                list(remote.Client(Interface(failure)).frames(1))


if __name__ == "__main__":
    unittest.main()
