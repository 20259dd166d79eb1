# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""Frames of candump logs: read, and measured in bits on the wire."""
import re
from dataclasses import dataclass

# As candump -L and asc2log write it, direction included.
LINE = re.compile(r"\((\d+)\.(\d{6})\) (\S+) ([0-9A-F]{3}|[0-9A-F]{8})#"
                  r"(?:(R)(\d?)|((?:[0-9A-F]{2}){0,8}))(?:_([9A-F]))?(?: [RT])?$")
ERROR_FLAG = 0x20000000


@dataclass(frozen=True)
class Frame:
    """What two logs must agree on."""

    ident: int
    extended: bool
    remote: bool
    dlc: int
    data: bytes

    @property
    def is_error(self):
        """An error message of the driver, no frame of the bus."""
        return self.extended and bool(self.ident & ERROR_FLAG)


@dataclass(frozen=True)
class Entry:
    """One line of a log; time in us."""

    time: int
    interface: str
    frame: Frame


def parse(line):
    """One line of a log as an Entry; ValueError if it is none."""
    match = LINE.match(line.strip())
    if not match:
        raise ValueError(f"no line of a log: {line!r}")
    seconds, micros, interface, ident, remote, asked, rest, raw_dlc = match.groups()
    data = bytes.fromhex(rest or "")
    dlc = int(raw_dlc, 16) if raw_dlc else (int(asked or "0") if remote else len(data))
    frame = Frame(int(ident, 16), len(ident) == 8, bool(remote), dlc, data)
    return Entry(int(seconds) * 1_000_000 + int(micros), interface, frame)


def read_log(path):
    """[Entry] of a log; ValueError names a bad line."""
    entries = []
    for number, line in enumerate(path.read_text().splitlines(), 1):
        try:
            entries.append(parse(line))
        except ValueError as error:
            raise ValueError(f"{path}:{number}: {error}") from None
    return entries


def _bits(value, count):
    return [(value >> n) & 1 for n in reversed(range(count))]


def _crc(bits):
    """CRC-15-CAN, polynomial 0x4599 (rule book, section 3)."""
    crc = 0
    for bit in bits:
        invert = bit ^ (crc >> 14)
        crc = (crc << 1) & 0x7FFF
        if invert:
            crc ^= 0x4599
    return crc


def length_in_bits(frame):
    """Bits from SOF to the end of the intermission, stuff bits included."""
    remote = int(frame.remote)
    if frame.extended:
        header = _bits(frame.ident >> 18, 11) + [1, 1] + _bits(frame.ident & 0x3FFFF, 18)
        header += [remote, 0, 0]
    else:
        header = _bits(frame.ident, 11) + [remote, 0, 0]
    bits = [0] + header + _bits(frame.dlc, 4)
    for byte in frame.data:
        bits += _bits(byte, 8)
    bits += _bits(_crc(bits), 15)
    stuffed, run, last = 0, 0, None
    for bit in bits:
        run = run + 1 if bit == last else 1
        last = bit
        if run == 5:
            stuffed += 1
            last, run = 1 - bit, 1
    return len(bits) + stuffed + 1 + 2 + 7 + 3


def load(entries, bitrate):
    """Part of the time that the bus was held by `entries`, [(time in us, Frame)], from the first
    one's start to the last one's."""
    if len(entries) < 2:
        return 0.0
    span = (entries[-1][0] - entries[0][0]) * bitrate / 1e6
    return sum(length_in_bits(frame) for _, frame in entries[:-1]) / span
