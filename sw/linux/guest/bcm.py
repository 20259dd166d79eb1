# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""bcm.py SENDER RECEIVER: the kernel's broadcast manager (CAN_BCM) sends cyclically on one device
and tells of what it receives on the other. One line for each message of it, the time in us of the
system's clock first."""
import select
import socket
import struct
import sys
import time

HEAD = struct.Struct("=IIIxxxxqqqqII")
FRAME = struct.Struct("=IB3x8s")
TX_SETUP, TX_DELETE, TX_SEND, RX_SETUP = 1, 2, 4, 5
NAMES = {9: "TX_EXPIRED", 11: "RX_TIMEOUT", 12: "RX_CHANGED"}
SETTIMER, STARTTIMER, COUNTEVT = 1, 2, 4
ANNOUNCE_RESUME, RTR_FRAME = 0x100, 0x400
RTR = 0x40000000


def frame(ident, data):
    """A struct can_frame."""
    return FRAME.pack(ident, len(data), data)


class Manager:
    """A socket of the broadcast manager."""

    def __init__(self, device):
        self.socket = socket.socket(socket.AF_CAN, socket.SOCK_DGRAM, socket.CAN_BCM)
        self.socket.connect((device,))

    def tell(self, opcode, ident, frames=(), flags=0, count=0, first=0, then=0):
        """One command; first, then: ival1 and ival2 in us."""
        million = 1_000_000
        self.socket.send(HEAD.pack(opcode, flags, count, first // million, first % million,
                                   then // million, then % million, ident, len(frames))
                         + b"".join(frames))

    def take(self):
        """One message as a line."""
        now = time.time_ns() // 1000
        data = self.socket.recv(512)
        opcode, _, _, _, _, _, _, ident, count = HEAD.unpack_from(data)
        words = [str(now), NAMES.get(opcode, str(opcode)), f"{ident:X}"]
        for n in range(count):
            got, size, payload = FRAME.unpack_from(data, HEAD.size + n * FRAME.size)
            words.append(f"{got:03X}#{payload[:size].hex().upper()}")
        return " ".join(words)


def listen(sockets, seconds):
    """Prints what the managers tell for so long."""
    end = time.monotonic() + seconds
    while (left := end - time.monotonic()) > 0:
        ready, _, _ = select.select([m.socket for m in sockets], [], [], left)
        for manager in sockets:
            if manager.socket in ready:
                print(manager.take(), flush=True)


def main():
    """The commands that judge_bcm.py knows."""
    sender, receiver, timers = Manager(sys.argv[1]), Manager(sys.argv[2]), Manager(sys.argv[2])
    # What differs in the first byte or in the lower half of the last.
    receiver.tell(RX_SETUP, 0x310, [frame(0x310, bytes.fromhex("FF0000000000000F"))])
    # Whether anything comes within 30 ms, and again when it does.
    timers.tell(RX_SETUP, 0x320, [frame(0x320, bytes(8))],
                SETTIMER | STARTTIMER | ANNOUNCE_RESUME, first=30_000)
    # The answer to a remote frame.
    receiver.tell(RX_SETUP, 0x330 | RTR, [frame(0x330, b"answer")], RTR_FRAME)
    # Three frames in turn: 12 times each 5 ms, then each 20 ms.
    sender.tell(TX_SETUP, 0x300, [frame(0x300, bytes([n] * (n + 1))) for n in range(3)],
                SETTIMER | STARTTIMER | COUNTEVT, 12, 5_000, 20_000)
    sender.tell(TX_SETUP, 0x320, [frame(0x320, b"alive")], SETTIMER | STARTTIMER, then=10_000)
    listen([sender, receiver, timers], 0.2)
    # Contents changed, the time table kept.
    sender.tell(TX_SETUP, 0x300, [frame(0x300, bytes([0xA0 + n])) for n in range(3)])
    for data in ("0000000000000000", "0011223344556670", "0100000000000000", "0100000000000001",
                 "01FFFFFFFFFFFFF1", "0100000000000001", "0000000000000001"):
        sender.tell(TX_SEND, 0x310, [frame(0x310, bytes.fromhex(data))])
        listen([sender, receiver, timers], 0.005)
    sender.tell(TX_SEND, 0x330, [frame(0x330 | RTR, b"")])
    listen([sender, receiver, timers], 0.02)
    sender.tell(TX_DELETE, 0x300)
    sender.tell(TX_DELETE, 0x320)
    listen([sender, receiver, timers], 0.1)
    sender.tell(TX_SETUP, 0x320, [frame(0x320, b"again")], SETTIMER | STARTTIMER, then=10_000)
    listen([sender, receiver, timers], 0.3)


if __name__ == "__main__":
    sys.exit(main())
