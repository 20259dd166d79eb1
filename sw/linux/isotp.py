# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""ISO 15765-2 (ISO-TP, classical CAN), as read from a log of the bus: what was transferred, and
whether both sides kept to the protocol."""
from dataclasses import dataclass, field

SINGLE, FIRST, CONSECUTIVE, FLOW = 0, 1, 2, 3
CONTINUE, WAIT, OVERFLOW = 0, 1, 2


@dataclass(frozen=True)
class Stream:
    """One direction: identifiers of data and of flow control, and extended addresses or None."""

    data: int
    flow: int
    extended: bool = False
    address: int | None = None
    flow_address: int | None = None


@dataclass
class Transfer:
    """A PDU on the bus. Times in us, of the ends of the frames' start bits."""

    start: int
    size: int
    data: bytearray = field(default_factory=bytearray)
    end: int = 0
    frames: int = 0


class Broken(ValueError):
    """Somebody did not keep to the protocol."""


def shortest_gap(code):
    """STmin in us (9.6.5.4): 0 to 127 ms, 100 to 900 us; what is reserved means 127 ms."""
    if code <= 0x7F:
        return 1000 * code
    return 100 * (code - 0xF0) if 0xF1 <= code <= 0xF9 else 127_000


class _Reader:
    def __init__(self):
        self.done = []
        self.now = None
        self.number = 0      # of the next consecutive frame
        self.left = 0        # consecutive frames until the next flow control; 0: it is awaited
        self.block = 0
        self.gap = 0
        self.last = None     # time of the last consecutive frame

    def _take(self, time, payload):
        now = self.now
        now.data += payload[:now.size - len(now.data)]
        now.frames += 1
        now.end = time
        if len(now.data) == now.size:
            self.done.append(now)
            self.now = None

    def single(self, time, pci):
        size = pci[0] & 15
        if self.now or not 1 <= size < len(pci):
            raise Broken(f"{time} us: single frame of {size} bytes in {pci.hex()}")
        self.now = Transfer(time, size)
        self._take(time, pci[1:])

    def first(self, time, pci, room):
        size = (pci[0] & 15) << 8 | pci[1]
        if self.now or size <= room - 1 or len(pci) != room:
            raise Broken(f"{time} us: first frame of {size} bytes in {pci.hex()}")
        self.now = Transfer(time, size)
        self.number, self.left, self.last = 1, 0, None
        self._take(time, pci[2:])

    def consecutive(self, time, pci):
        if not self.now or self.left == 0 or pci[0] & 15 != self.number % 16:
            raise Broken(f"{time} us: consecutive frame {pci[0] & 15}, not {self.number % 16}, "
                         f"{self.left} allowed")
        if self.last is not None and time - self.last < self.gap:
            raise Broken(f"{time} us: {time - self.last} us after its predecessor, STmin is "
                         f"{self.gap} us")
        self.number += 1
        self.left -= 1
        self.last = time
        self._take(time, pci[1:])

    def flow(self, time, pci):
        status, self.block = pci[0] & 15, pci[1]
        if not self.now or self.left or status not in (CONTINUE, WAIT):
            raise Broken(f"{time} us: flow control {pci.hex()} that nobody waits for")
        if status == CONTINUE:
            self.gap = shortest_gap(pci[2])
            self.left = self.block or 1 << 30
            self.last = None


def transfers(entries, stream):
    """The PDUs of one stream in entries, [(time, Frame)]; Broken if the protocol was."""
    reader = _Reader()
    for time, frame in entries:
        if frame.extended != stream.extended or frame.ident not in (stream.data, stream.flow):
            continue
        flow = frame.ident == stream.flow
        pci = frame.data
        address = stream.flow_address if flow else stream.address
        if address is not None:
            if pci[0] != address:
                raise Broken(f"{time} us: address {pci[0]:02X}, not {address:02X}")
            pci = pci[1:]
        kind = pci[0] >> 4
        if flow != (kind == FLOW):
            raise Broken(f"{time} us: kind {kind} on {frame.ident:X}")
        if kind == FLOW:
            reader.flow(time, pci)
        elif kind == SINGLE:
            reader.single(time, pci)
        elif kind == FIRST:
            reader.first(time, pci, 8 if address is None else 7)
        elif kind == CONSECUTIVE:
            reader.consecutive(time, pci)
        else:
            raise Broken(f"{time} us: kind {kind}")
    if reader.now:
        raise Broken(f"{reader.now.start} us: {len(reader.now.data)} of {reader.now.size} bytes")
    return reader.done
