# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""Programs of python-can on vcan0 and vcan1, and two raw sockets; prints who has received what."""
import json
import socket
import struct

import can

LIMIT = 60  # seconds; nothing takes so long
FRAME = struct.Struct("=IB2xB8s")  # struct can_frame of linux/can.h


def show(message):
    """A message as text: identifier, kind, DLC, data."""
    kind = ("x" if message.is_extended_id else "") + ("r" if message.is_remote_frame else "")
    return f"{message.arbitration_id:X}{kind}/{message.dlc}/{bytes(message.data).hex()}"


def programs():
    """Each message is waited for on the other side before the next is sent."""
    buses = {
        "a": can.Bus(interface="socketcan", channel="vcan0"),
        "neighbour": can.Bus(interface="socketcan", channel="vcan0"),
        "vain": can.Bus(interface="socketcan", channel="vcan0", receive_own_messages=True),
        "b": can.Bus(interface="socketcan", channel="vcan1"),
        "choosy": can.Bus(interface="socketcan", channel="vcan1", can_filters=[
            {"can_id": 0x120, "can_mask": 0x7F0, "extended": False},
            {"can_id": 0x1ABC0000, "can_mask": 0x1FFF0000, "extended": True}]),
    }
    seen = {name: [] for name in buses}
    steps = (("a", 0x123, False, [1, 2, 3]), ("vain", 0x124, False, [4]), ("a", 0x223, False, []),
             ("b", 0x1ABCDEF0, True, [5, 6]), ("a", 0x1ABCDEF1, True, [7]),
             ("vain", 0x1ABD0000, True, [8]), ("a", 0x125, False, None), ("b", 0x12F, False, [9]),
             ("b", 0x7FE, False, []), ("a", 0x12E, False, []))
    for sender, ident, extended, data in steps:
        buses[sender].send(can.Message(arbitration_id=ident, is_extended_id=extended,
                                       is_remote_frame=data is None, data=data or []))
        other = "a" if sender == "b" else "b"
        message = None
        # The other side's witness may have an older message before it.
        while message is None or message.arbitration_id != ident:
            message = buses[other].recv(LIMIT)
            if message is None:
                raise SystemExit(f"{ident:X} never came to {other}")
            seen[other].append(show(message))
    for name, bus in buses.items():
        # Everything that was to come has come to the witnesses, and so to the others.
        while (message := bus.recv(0)) is not None:
            seen[name].append(show(message))
        bus.shutdown()
    return seen


def raw_dlc():
    """Length codes 9 to 15 go through as they are."""
    sockets = []
    for name in ("vcan0", "vcan1"):
        sockets.append(socket.socket(socket.AF_CAN, socket.SOCK_RAW, socket.CAN_RAW))
        sockets[-1].bind((name,))
        sockets[-1].settimeout(LIMIT)
    seen = []
    for sender, receiver in (sockets, sockets[::-1]):
        for code in range(9, 16):
            sender.send(FRAME.pack(0x300 + code, 8, code, b"abcdefgh"))
            seen.append(FRAME.unpack(receiver.recv(16)))
        sender.send(FRAME.pack(0x310 | socket.CAN_RTR_FLAG, 8, 15, b""))
        seen.append(FRAME.unpack(receiver.recv(16)))
    return [(ident, length, code, data.decode("latin-1")) for ident, length, code, data in seen]


print(json.dumps({"programs": programs(), "raw_dlc": raw_dlc()}))
