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
from verican_remote_link import (ALL, BUSY, CODES, IDENT, OPERATE, READ, RESTART, ROW_IDENT,
                                 ROW_STATUS, SAFE, SETUP, STATEMENT, STATUS, WRITE, Answer, BusOff,
                                 Identity, NotTaken, Refused, RemoteError, Sequence, Status,
                                 Timeout)

__all__ = ["ALL", "CODES", "OPERATE", "SAFE", "RESTART", "Client", "Status", "Identity",
           "RemoteError", "Timeout", "Refused", "Sequence", "BusOff", "NotTaken"]

CONFIRMED_AT_ONCE = 100  # counts are modulo 256, and a write may come twice


class Client(Blocks):
    """The client. Calls raise Timeout, Refused, Sequence, NotTaken or BusOff, and ValueError for
    an argument that cannot be; then nothing was sent. `number` is that of a node."""

    def read(self, number, address, length):
        """Bytes of a node; what does not fit a frame is read in parts."""
        self.require_node(number)
        self.require_range(address, length)
        data = b""
        while len(data) < length:
            at = address + len(data)
            _, request, answer = self.read_request(number, at, length - len(data))
            data += self.ask(number, answer, *request)
        return data

    def _write_frames(self, number, address, data):
        """Identifier and bytes of each frame of a write."""
        while data:
            if address < self.window:
                n = min(len(data), 8, self.window - address)
                yield self.id(number, address), data[:n]
            else:
                n = min(len(data), 6)
                yield self.port(number, WRITE), address.to_bytes(2, "little") + data[:n]
            address, data = address + n, data[n:]

    def write(self, number, address, data):
        """Writes without confirmation; number ALL: to all nodes."""
        self.require_node(number, ALL)
        self.require_range(address, len(data))
        for frame in self._write_frames(number, address, bytes(data)):
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
                raise Refused(counts.code)
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
        self.require_range(address, len(data))
        frames = list(self._write_frames(number, address, bytes(data)))
        for first in range(0, len(frames), CONFIRMED_AT_ONCE):
            part = frames[first:first + CONFIRMED_AT_ONCE]
            if not any(self._send_confirmed(number, part) for _ in range(self.tries)):
                raise Timeout(f"node {number} has not taken all of it")

    def poll(self, address, length, expected=()):
        """{number: bytes} of all nodes at one moment, at most 8 bytes (6 beyond the window or
        without remote frames). Ends when the numbers of `expected` have answered; without, after
        the time-out."""
        self.require_range(address, length)
        for number in expected:
            self.require_node(number)
        fits, request, answer = self.read_request(ALL, address, length)
        if fits != length:
            raise ValueError(f"{length} bytes from 0x{address:X} are more than one frame")
        return self._gather(request, answer, set(expected))

    def _gather(self, request, answer, expected):
        self.flush()
        self.send(*request)
        found = {}
        for message in self.frames(self.timeout):
            number = (message.arbitration_id & 0x3FF) >> (10 - self.name_bits)
            its = Answer(answer.id | self.id(number, 0), answer.dlc, answer.head)
            if its.fits(message):
                found[number] = its.bytes_of(message)
            else:
                self.pass_on(message)
            if expected and expected <= found.keys():
                break
        if not expected <= found.keys():
            raise Timeout(f"no answer of {sorted(expected - found.keys())}")
        return dict(sorted(found.items()))

    def trigger(self, count):
        """Makes staged bytes visible in all nodes; `count`: one more than the last time."""
        if not 0 <= count <= 255:
            raise ValueError(f"count {count}: allowed are 0 to 255")
        self.send(self.id(0, 1), bytes([count]))

    def state(self, command, number=0):
        """OPERATE, SAFE or RESTART for one node, or for all (0). Not confirmed."""
        if number:
            self.require_node(number)
        if command not in (OPERATE, SAFE, RESTART):
            raise ValueError(f"command {command}: allowed are OPERATE, SAFE, RESTART")
        self.send(self.id(0, 0), bytes([command, number]))

    def _row(self, number, port, address):
        self.require_node(number)
        if not self.remote_frames:
            return self.read(number, address, 8)
        identifier = self.port(number, port)
        return self.ask(number, Answer(identifier | STATEMENT, 8), identifier, b"", 8)

    def status(self, number):
        """Status of a node."""
        row = self._row(number, STATUS, ROW_STATUS)
        self._refusals[number] = row[6]
        return Status.of(row)

    def identity(self, number):
        """Identity of a node."""
        return Identity.of(number, self._row(number, IDENT, ROW_IDENT))

    def select(self, value, mask=0xFFFFFFFF, only_new=False):
        """Selects the nodes whose serial number equals `value` under `mask` (`only_new`: of those
        without a number); whether there is one."""
        self.require_serial(value)
        self.require_serial(mask)
        pairs = zip(value.to_bytes(4, "little"), mask.to_bytes(4, "little"))
        self.flush()
        function = 4 if only_new else 2
        self.send(self.id(0, function), bytes(byte for pair in pairs for byte in pair))
        here = Answer(0x402, 0)
        for message in self.frames(self.select_wait):
            if here.fits(message):
                return True
            self.pass_on(message)
        return False

    def _next_serial(self, value):
        """The smallest serial number from `value` on of a node without a number, or None. Walks
        down a tree of prefixes: 33 SELECTs for a number."""
        bit = 31
        while True:
            if self.select(value, 0xFFFFFFFF << bit & 0xFFFFFFFF, only_new=True):
                if bit == 0:
                    return value
                bit -= 1
                continue
            while bit < 32 and value >> bit & 1:
                bit += 1
            if bit == 32:
                return None
            value = (value | 1 << bit) >> bit << bit

    def scan(self):
        """All nodes: those with a number, then those without by their serial numbers."""
        head = self.poll(ROW_IDENT, 4)
        tail = self.poll(ROW_IDENT + 4, 4, head) if head else {}
        nodes = [Identity.of(number, head[number] + tail[number]) for number in head]
        serial = 0
        while serial <= 0xFFFFFFFF and (found := self._next_serial(serial)) is not None:
            nodes.append(Identity(0, found))
            serial = found + 1
        return nodes

    def assign(self, serial, number):
        """Gives the node with this serial number a number (0: takes it away), and asks it whether
        it has taken it; NotTaken."""
        if number:
            self.require_node(number)
        self.require_serial(serial)
        if not self._find(serial):
            raise Timeout(f"no node with serial number {serial:08X}")
        taken = self._give_number(number) if number else self._take_number(serial)
        if not taken:
            raise NotTaken(f"the node with serial number {serial:08X} is there, but does not take "
                           f"number {number}; in OPERATE it takes none")

    def _find(self, serial, only_new=False):
        return any(self.select(serial, only_new=only_new) for _ in range(self.tries))

    def _take_number(self, serial):
        """A node that has no number any more can only say that it is new."""
        self.send(self.id(0, 3), b"\0")
        return self._find(serial, only_new=True)

    def _give_number(self, number):
        """ASSIGN may come more than once (RN-27); the answer is STATUS of the new number."""
        self._refusals.pop(number, None)
        answer = Answer(self.port(number, STATUS) | STATEMENT, 8)
        with contextlib.suppress(Timeout):
            self.ask(number, answer, self.id(0, 3), bytes([number]))
            return True
        return False

    def configure(self, number, serial, settings):
        """Unlocks a node by its serial number, writes `settings` ((address, bytes), ...) confirmed
        and locks it again, whatever comes of them or of the confirmation that it is unlocked; what
        went wrong first is raised. A node that does not answer is sent the lock once, without
        confirmation."""
        self.require_node(number)
        self.require_serial(serial)
        settings = [(address, bytes(data)) for address, data in settings]
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
