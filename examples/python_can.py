#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""A CAN program that knows nothing of VeriCAN: python-can on a simulated bus.

    verican bridge --socketcand 29536 --bus examples/bridge.yaml &
    examples/python_can.py 29536
"""
import sys

import can


def main():
    port = int(sys.argv[1]) if len(sys.argv) > 1 else 29536
    bus = can.Bus(interface="socketcand", host="127.0.0.1", port=port, channel="can0")
    for number in range(3):
        bus.send(can.Message(arbitration_id=0x400 + number, is_extended_id=False,
                             data=[0xCA, 0xFE, number]))
    print("sent 3 frames; received from the other nodes:")
    for _ in range(6):
        message = bus.recv(10.0)
        if message is None:
            sys.exit("nothing came within 10 s: is there traffic on this bus?")
        print(f"  {message.timestamp:10.6f} s  {message.arbitration_id:X}  {message.data.hex(' ')}")
    bus.shutdown()


if __name__ == "__main__":
    main()
