#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""A CAN program that knows nothing of VeriCAN: python-can on a simulated bus.

    verican bridge --socketcand 29536 --bus examples/bridge.yaml &
    examples/python_can.py 29536

PORT is where the bridge listens (29536), CHANNEL one of its buses (--bus-name, can0).
"""
import logging
import sys

import can

USAGE = "usage: python_can.py [PORT [CHANNEL]]"


def port_number(text):
    if not text.isdecimal() or not 0 < int(text) < 65536:
        sys.exit(f"python_can.py: PORT {text!r} is not allowed; allowed: 1 to 65535; {USAGE}")
    return int(text)


def open_bus(port, channel):
    logging.getLogger("can").setLevel(logging.CRITICAL)  # it tells each of a hundred attempts
    try:
        return can.Bus(interface="socketcand", host="127.0.0.1", port=port, channel=channel)
    except OSError as error:
        sys.exit(f"python_can.py: nobody answers at port {port}: {error}; does the bridge run?")
    except can.CanError as error:
        sys.exit(f"python_can.py: no bus {channel!r} at port {port}: {error}; allowed: a name "
                 "of the bridge's --bus-name (can0)")


def main():
    arguments = sys.argv[1:]
    if len(arguments) > 2:
        sys.exit(USAGE)
    port, channel = arguments + ["29536", "can0"][len(arguments):]
    bus = open_bus(port_number(port), channel)
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
