# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""SAE J1939-21 and -81, as read from a log of the bus: messages of one frame, transport protocol
(TP, up to 1,785 bytes), extended transport protocol (ETP), claims of addresses."""
from dataclasses import dataclass, field

TP_CM, TP_DT, ETP_CM, ETP_DT = 0xEC00, 0xEB00, 0xC800, 0xC700
CLAIM = 0xEE00
GLOBAL = 0xFF
RTS, CTS, EOMA, BAM, ERTS, ECTS, EDPO, EEOMA, ABORT = 16, 17, 19, 32, 20, 21, 22, 23, 255


class Broken(ValueError):
    """Somebody did not keep to the protocol."""


@dataclass(frozen=True)
class Header:
    """What the 29 bits say."""

    priority: int
    pgn: int
    to: int
    by: int


def header(ident):
    """The fields of an identifier; PDU1 (format below 240) has a destination."""
    kind = ident >> 16 & 0xFF
    pgn = ident >> 8 & 0x3FFFF
    if kind < 240:
        return Header(ident >> 26 & 7, pgn & 0x3FF00, pgn & 0xFF, ident & 0xFF)
    return Header(ident >> 26 & 7, pgn, GLOBAL, ident & 0xFF)


@dataclass
class Message:
    """A message of several frames. Times in us."""

    pgn: int
    by: int
    to: int
    size: int
    start: int
    data: bytearray = field(default_factory=bytearray)
    end: int = 0
    aborted: int | None = None  # reason
    left: int = 0               # packets that may be sent
    packet: int = 1             # the next one
    offset: int = 0             # ETP: packets before the first that is numbered 1
    last: int = 0               # time of the last frame


def little(data):
    return int.from_bytes(data, "little")


class _Reader:
    def __init__(self):
        self.done, self.open = [], {}

    def begin(self, time, head, data, extended):
        size = little(data[1:5] if extended else data[1:3])
        if not (1786 <= size if extended else 9 <= size <= 1785):
            raise Broken(f"{time} us: {size} bytes announced")
        if not extended and data[3] != -(-size // 7):
            raise Broken(f"{time} us: {data[3]} packets for {size} bytes")
        key = head.by, head.to, extended
        if key in self.open:
            raise Broken(f"{time} us: a second message from {head.by:02X} to {head.to:02X}")
        message = Message(little(data[5:8]), head.by, head.to, size, time, last=time)
        message.left = 1 << 30 if data[0] == BAM else 0
        self.open[key] = message

    def clear(self, time, message, data, extended):
        count = data[1]
        asked = little(data[2:5]) if extended else data[2]
        if count and (message.left or asked != message.packet):
            raise Broken(f"{time} us: packet {asked} asked for, {message.packet} is due")
        message.left = count

    def control(self, time, head, data, extended):
        kind = data[0]
        if kind in (RTS, BAM, ERTS):
            self.begin(time, head, data, extended)
            return
        forward = kind == EDPO or (kind == ABORT and (head.by, head.to, extended) in self.open)
        key = (head.by, head.to, extended) if forward else (head.to, head.by, extended)
        message = self.open.get(key)
        if message is None or little(data[5:8]) != message.pgn:
            raise Broken(f"{time} us: {data.hex()} belongs to no message")
        if kind in (CTS, ECTS):
            self.clear(time, message, data, extended)
        elif kind == EDPO:
            message.offset = little(data[2:5])
            if message.offset != message.packet - 1 or data[1] > message.left:
                raise Broken(f"{time} us: offset {message.offset}, packet {message.packet} is due")
        elif kind == ABORT:
            message.aborted, message.end = data[1], time
            self.done.append(self.open.pop(key))
            return
        elif kind in (EOMA, EEOMA):
            size = little(data[1:5]) if extended else little(data[1:3])
            if len(message.data) != message.size or size != message.size:
                raise Broken(f"{time} us: end after {len(message.data)} of {message.size} bytes")
            self.done.append(self.open.pop(key))
        message.last = time

    def data(self, time, head, data, extended):
        key = head.by, head.to, extended
        message = self.open.get(key)
        if message is None or message.left == 0 or data[0] != message.packet - message.offset:
            raise Broken(f"{time} us: packet {data[0]} that nobody waits for")
        message.data += data[1:1 + message.size - len(message.data)]
        message.packet += 1
        message.left -= 1
        message.end = message.last = time
        if message.to == GLOBAL and len(message.data) == message.size:
            self.done.append(self.open.pop(key))


def messages(entries):
    """The messages of several frames in entries, [(time, Frame)], in the order of their ends;
    Broken if the protocol was, or if one does not end."""
    reader = _Reader()
    for time, frame in entries:
        if not frame.extended:
            continue
        head = header(frame.ident)
        if head.pgn in (TP_CM, ETP_CM):
            reader.control(time, head, frame.data, head.pgn == ETP_CM)
        elif head.pgn in (TP_DT, ETP_DT):
            reader.data(time, head, frame.data, head.pgn == ETP_DT)
    if reader.open:
        raise Broken(f"messages without an end: {list(reader.open)}")
    return reader.done


def claims(entries):
    """The claims of addresses in entries: [(time, address, NAME)]."""
    return [(time, frame.ident & 0xFF, little(frame.data)) for time, frame in entries
            if frame.extended and header(frame.ident).pgn == CLAIM]
