# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""frame_rate.py [FRAMES]: frames a second from one can.Bus to another, two RTL nodes on a bus of
1 Mbit/s, and by the module without python-can. Use: taskset -c 0 for one core. Prints figures."""
import sys
import time

import can

from verican import Bus, Frame


def through_python_can(count):
    with can.Bus(interface="verican", channel="rate", bitrate=1_000_000) as a, \
         can.Bus(interface="verican", channel="rate") as b:
        sent = can.Message(arbitration_id=0x123, data=b"12345678", is_extended_id=False)
        start, got = time.perf_counter(), 0
        for i in range(count):
            a.send(sent)
            if i % 256 == 255:  # as a program that looks now and then
                while b.recv(0):
                    got += 1
        while got < count and b.recv(10):
            got += 1
        return got / (time.perf_counter() - start)


def through_the_module(count):
    bus = Bus(["a", "b"], bitrate=1e6)
    start = time.perf_counter()
    for _ in range(count):
        bus.send("a", Frame(0x123, b"12345678"))
    bus.run_until_quiet(1e5)
    return len(bus.receive("b")) / (time.perf_counter() - start)


def main():
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 10_000
    print(f"python-can: {through_python_can(count):.0f} frames/s")
    print(f"module:     {through_the_module(count):.0f} frames/s")


if __name__ == "__main__":
    main()
