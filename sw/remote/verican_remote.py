# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""Client of can_remote, the CAN node without a processor, over python-can.

    import can, verican_remote
    with can.Bus(interface="socketcan", channel="can0") as bus:
        pfc = verican_remote.Client(bus)
        pfc.write_confirmed(6, 0x010, b"\\x12\\x34")
        print(pfc.read(6, 0x040, 4).hex(" "))

What the nodes are: docs/remote.md. A bus has one client: nodes take requests from a single host.
"""
import contextlib

from verican_remote_block import Blocks
from verican_remote_link import (ALL, BUSY, CODES, OPERATE, READ, RESTART, ROW_STATUS, SAFE, SETUP,
                                 WRITE, BusOff, Identity, InUse, NotTaken, Refused, RemoteError,
                                 Sequence, Status, Timeout, TooMany)
from verican_remote_nodes import Nodes, refused_at

__all__ = ["ALL", "CODES", "OPERATE", "SAFE", "RESTART", "Client", "Status", "Identity",
           "RemoteError", "Timeout", "Refused", "Sequence", "BusOff", "NotTaken", "InUse",
           "TooMany"]

CONFIRMED_AT_ONCE = 100  # counts are modulo 256, and a write may come twice


class Client(Nodes, Blocks):
    """The client. Calls raise Timeout, Refused, Sequence, NotTaken, InUse, TooMany or BusOff, and
    ValueError for an argument that cannot be; then nothing was sent. `number` is that of a node."""

    def _write_frames(self, number, address, data):
        """Address, identifier and bytes of each frame of a write."""
        while data:
            if address < self.window:
                n = min(len(data), 8, self.window - address)
                yield address, self.id(number, address), data[:n]
            else:
                n = min(len(data), 6)
                head = address.to_bytes(2, "little")
                yield address, self.port(number, WRITE), head + data[:n]
            address, data = address + n, data[n:]

    def write(self, number, address, data):
        """Writes without confirmation; number ALL: to all nodes."""
        self.require_node(number, ALL)
        data = self.require_bytes(data)
        self.require_range(address, len(data))
        for _, *frame in self._write_frames(number, address, data):
            self.send(*frame)

    def _counts(self, number, ask=None):
        """Status without its first two bytes, at one moment. READ brings it, never a remote frame:
        what a node sends by itself looks like the answer to that one, and the real one then makes
        the node busy. `ask`: Link.ask, or ask_once, which may give None."""
        _, request, answer = self.read_request(number, ROW_STATUS + 2, 6)
        row = (ask or self.ask)(number, answer, *request)
        if row is None:
            return None
        counts = Status.of(bytes(2) + row)
        self._refusals[number] = counts.refused
        return counts

    def _send_confirmed(self, number, frames):
        """Sends frames that change something, and looks whether all have been accepted."""
        return self._send_and_confirm(number, frames, self._counts(number))

    def _send_and_confirm(self, number, frames, before):
        """`before`: _counts() until then. False: nobody knows, or they have been lost."""
        for frame in frames:
            self.send(*frame)
        unanswered = 0
        for _ in range(self.tries):
            try:
                counts = self._counts(number, self.ask_once)
            except Refused:  # busy; but that is said of this reading
                counts = None
            if counts is None:
                unanswered += 1
            elif self._is_refused(before, counts, unanswered):
                raise Refused(counts.code, number)
            elif (counts.accepted - before.accepted) % 256 >= len(frames):
                return True
        return False

    def _is_refused(self, before, counts, unanswered):
        """Whether more has been refused since `before` than readings of the counts, of which
        `unanswered` brought nothing. One more than those would be a request whose refusal the last
        one hides."""
        more = (counts.refused - before.refused) % 256
        busy = counts.code == BUSY and counts.a == self.window + READ
        return more != 0 and not (busy and more <= unanswered)

    def write_confirmed(self, number, address, data):
        """Writes, and asks the node whether all of it was accepted."""
        self.require_node(number)
        data = self.require_bytes(data)
        self.require_range(address, len(data))
        frames = list(self._write_frames(number, address, data))
        for first in range(0, len(frames), CONFIRMED_AT_ONCE):
            part = frames[first:first + CONFIRMED_AT_ONCE]
            at = part[0][0]
            with refused_at(number, at):
                taken = any(self._send_confirmed(number, [frame for _, *frame in part])
                            for _ in range(self.tries))
            if not taken:
                raise Timeout(f"node {number} has not taken all from 0x{at:03X} on")

    def trigger(self, count):
        """Makes staged bytes visible in all nodes; `count`: one more than the last time."""
        if not 0 <= count <= 255:
            raise ValueError(f"count {count}: allowed are 0 to 255")
        self.send(self.id(0, 1), bytes([count]))

    def state(self, command, number=0):
        """OPERATE, SAFE or RESTART for one node, or for all (0). Not confirmed."""
        self.require_node(number, 0)
        if command not in (OPERATE, SAFE, RESTART):
            raise ValueError(f"command {command}: allowed are OPERATE, SAFE, RESTART")
        self.send(self.id(0, 0), bytes([command, number]))

    def clear(self, number):
        """Clears counters and the flags doubled number, watchdog and bus-off of a node (SETUP
        CLEAR), confirmed."""
        self.require_node(number)
        frame = self.port(number, SETUP), b"\4"
        if not any(self._send_confirmed(number, [frame]) for _ in range(self.tries)):
            raise Timeout(f"node {number} has not taken SETUP")

    def configure(self, number, serial, settings):
        """Unlocks a node by its serial number, writes `settings`, ((address, bytes), ...) or
        {address: bytes, ...}, confirmed and locks it again, whatever comes of them or of the
        confirmation that it is unlocked; what went wrong first is raised. A node that does not
        answer is sent the lock once, without confirmation."""
        self.require_node(number)
        self.require_serial(serial)
        if isinstance(settings, dict):
            settings = settings.items()
        settings = [(address, self.require_bytes(data)) for address, data in settings]
        for address, data in settings:
            self.require_range(address, len(data))
        before = self._counts(number)
        try:
            self._setup(number, b"\1" + serial.to_bytes(4, "little"), before)
            for address, data in settings:
                self.write_confirmed(number, address, data)
        except BaseException:
            with contextlib.suppress(RemoteError):
                self._lock(number)
            raise
        self._lock(number)

    def _setup(self, number, data, before):
        """`before`: _counts() until then."""
        if not self._send_and_confirm(number, [(self.port(number, SETUP), data)], before):
            raise Timeout(f"node {number} has not taken SETUP")

    def _lock(self, number):
        """A node that does not answer is told all the same."""
        try:
            before = self._counts(number)
        except RemoteError:
            with contextlib.suppress(RemoteError):
                self.send(self.port(number, SETUP), b"\2")
            raise
        self._setup(number, b"\2", before)
