# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""The Python client of remote nodes: interfaces that are full or gone (RN-91, RN-92).
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
