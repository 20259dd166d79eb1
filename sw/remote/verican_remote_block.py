# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""Block transfers of the client of can_remote; verican_remote.py is what to import."""
from verican_remote_link import (ABORTED, BLOCK, BUSY, DATA, OPEN, SEQUENCE, STATEMENT, TIMEOUT,
                                 Link, Refused, Sequence, Timeout)

_ABORT, _READ, _WRITE = 0, 1, 2
_IN_A_FRAME = 7
_LOOK = 0.001  # for an early end of a write; it is heard at the next look, or at the end


class Blocks(Link):
    """Calls for nodes that have block transfers; 1 to 4096 bytes."""

    tag = 0     # of the last transfer
    gap_ms = 0  # between the frames of a read

    def block_read(self, number, address, length):
        """Reads many bytes, seven a frame; what was lost is read again from there."""
        self.require_node(number)
        self.require_range(address, length)
        data = b""

        def once():
            nonlocal data
            data += self._read_once(number, address + len(data), length - len(data))
            if len(data) != length:
                raise Sequence(f"{length - len(data)} of {length} bytes are missing")

        self._tries(number, once)
        return data

    def block_write(self, number, address, data):
        """Writes many bytes; after a lost frame it goes on behind those that have arrived."""
        self.require_node(number)
        data = self.require_bytes(data)
        self.require_range(address, len(data))
        done = 0

        def once():
            nonlocal done
            moved, code = self._write_once(number, address + done, data[done:])
            done += moved
            if done != len(data):
                self._raise(code or SEQUENCE)

        self._tries(number, once)

    def _tries(self, number, once):
        for left in range(self.tries - 1, -1, -1):
            try:
                return once()
            except (Sequence, Timeout):
                if left == 0:
                    raise
            except Refused as refused:
                if refused.code != BUSY or left == 0:
                    raise
                self._abort_other(number)

    def _abort_other(self, number):
        """Ends a transfer that a host has left open. The answer has the tag of that one, which may
        be that of the next try: it is waited for, and that tag is not given again."""
        self._send_block(number, _ABORT, 0, 0)
        for message in self.frames(self.timeout):
            if self._is_block(number, message) and message.data[2] == ABORTED:
                self.tag = message.data[1]
                return
            self.pass_on(message)

    @staticmethod
    def _raise(code):
        if code == SEQUENCE:
            raise Sequence("the node has missed a frame")
        if code == TIMEOUT:
            raise Timeout("the node has waited too long for a frame")
        raise Refused(code)

    def _send_block(self, number, op, address, length):
        data = bytes([op, self.tag]) + address.to_bytes(2, "little") + length.to_bytes(2, "little")
        if op == _READ and self.gap_ms:
            data += bytes([self.gap_ms])
        return self.send(self.port(number, BLOCK), data)

    def _open(self, number, op, address, length):
        self.tag = (self.tag + 1) % 256
        self.flush()
        return self._send_block(number, op, address, length)

    def _is_block(self, number, message):
        return (message.arbitration_id == self.port(number, BLOCK) | STATEMENT
                and not message.is_remote_frame and message.dlc == 6)

    def _is_answer(self, number, op, message):
        return (self._is_block(number, message)
                and bytes(message.data[:2]) == bytes([op, self.tag]))

    def _next(self, number, op, request, frames):
        """Of `frames` the next of the transfer: DATA of a read, or an answer; None: there is none.
        """
        data = self.port(number, DATA) | STATEMENT

        def wanted(message):
            is_data = (op == _READ and message.arbitration_id == data
                       and not message.is_remote_frame and message.dlc >= 2)
            return is_data or self._is_answer(number, op, message)

        # Busy may be said of a BLOCK that came twice: then the transfer goes on nevertheless.
        return self.wait(number, request, frames, wanted, patient=(BUSY,))

    def _read_once(self, number, address, length):
        """The bytes of one block read that came in their order."""
        request = self._open(number, _READ, address, length)
        got, seq, lost = b"", 0, False
        wait = self.timeout + self.gap_ms / 1000
        frames = self.frames(wait)
        # Each frame of the transfer begins the wait anew. They may come twice (VA-03); a node that
        # sends more does not hold the client up.
        renewals = 2 * (length // _IN_A_FRAME + 1)
        while True:
            message = self._next(number, _READ, request, frames)
            if message is None:
                self._send_block(number, _ABORT, 0, 0)
                if not got:
                    raise Timeout(f"node {number} does not answer")
                return got
            if self._is_answer(number, _READ, message):
                if message.data[2] not in (0, SEQUENCE):
                    self._raise(message.data[2])
                return got
            if renewals:
                renewals -= 1
                frames = self.frames(wait)
            if got and message.data[0] == (seq - 1) % 256:
                continue  # once more
            lost = lost or message.data[0] != seq or message.dlc - 1 > length - len(got)
            if not lost:
                got += bytes(message.data[1:])
                seq = (seq + 1) % 256

    def _write_once(self, number, address, data):
        """How many bytes the node has taken, and with which code it closed the transfer."""
        request = self._open(number, _WRITE, address, len(data))
        message = self._next(number, _WRITE, request, self.frames(self.timeout))
        if message is not None and message.data[2] == OPEN:
            message = self._send_data(number, request, data)
        if message is None:
            self._send_block(number, _ABORT, 0, 0)
            raise Timeout(f"node {number} does not answer")
        done = int.from_bytes(message.data[4:6], "little")
        return min(done, len(data)), message.data[2]

    def _send_data(self, number, request, data):
        """Sends the bytes; the answer that ends the transfer, early if frames are lost."""
        for seq, at in enumerate(range(0, len(data), _IN_A_FRAME)):
            self.send(self.port(number, DATA), bytes([seq % 256]) + data[at:at + _IN_A_FRAME])
            message = self._next_end(number, request, self.frames(_LOOK, look=True))
            if message is not None:
                return message
        return self._next_end(number, request, self.frames(self.timeout))

    def _next_end(self, number, request, frames):
        """The answer that ends a write; the one that has opened it may come once more (VA-03)."""
        while True:
            message = self._next(number, _WRITE, request, frames)
            if message is None or message.data[2] != OPEN:
                return message
