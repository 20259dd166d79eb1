#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""The robot of docs/canopen.md: a host, six joints and two sensors on one CANopen bus at 1 Mbit/s,
every controller the RTL. Prints what was measured beside the analytic bound.

    PYTHONPATH=build/release/python examples/robot/robot.py [--seconds 1] [--fail] [--report FILE]

Exit code 1: a PDO was lost, a response was above its bound, or the failure did not go as it should.
"""
import argparse
import json
import random
import struct
import sys

try:
    import verican
except ModuleNotFoundError:
    sys.exit("robot.py: the Python package verican is not found; in a built tree "
             "PYTHONPATH=build/release/python leads to it (docs/python.md)")

from device import (EMCY, HEARTBEAT, NMT, OPERATIONAL, SDO_ANSWER, SYNC, TPDO, Device,
                    Uploader)
from measure import Measure
from network import Network, Node
from plan import (BEAT, CYCLE, DISTURBED, FAILS, HOST_DELAY, JOINTS, LOG, REACTION, RESTART,
                  SDO_PERIOD, SENSORS, SET_POINTS, START, WATCH)


class Joint(Device):
    """Follows its set point; tells its position at each SYNC, in a PDO of three bytes."""

    def __init__(self, network, number, reaction):
        super().__init__(network, f"joint{number}", number, reaction, BEAT)
        self.position = self.target = self.next_target = 0
        self.objects[0x2001, 0] = LOG
        place = (number - 1) % 3
        self.rpdo = {SET_POINTS[(number - 1) // 3]: lambda data: self._set(data, place)}

    def _set(self, data, place):
        self.next_target = struct.unpack_from("<h", data, 2 * place)[0]

    def on_sync(self, event):
        self.target = self.next_target  # synchronous: counts from this SYNC on
        way = self.target - self.position
        self.position += max(-50, min(50, way))
        self.send(TPDO + self.number, struct.pack("<hB", self.position, 0x27),
                  self.network.sync_of(event))


class Sensor(Device):
    """Tells a force at each SYNC, two bytes."""

    def __init__(self, network, number, reaction):
        super().__init__(network, f"sensor{number}", number, reaction, BEAT)
        self.value = 0

    def on_sync(self, event):
        self.value = (self.value + 37) % 1000
        self.send(TPDO + self.number, struct.pack("<h", self.value), self.network.sync_of(event))


class Host(Node):
    """NMT master, producer of SYNC and set points, consumer of positions, heartbeats and EMCY."""

    def __init__(self, network, seconds):
        super().__init__(network, "host")
        self.cycles = round(seconds / CYCLE)
        self.states, self.heard, self.events = {}, {}, []
        self.lost = set()  # joints that the host has given up
        self.upload = Uploader(self, 1, 0x2001, SDO_PERIOD, LOG)
        self.at(START - 10e-3, lambda: self.send(NMT, bytes([1, 0])))
        self.at(START, lambda: self._cycle(0))
        self.at(START + 2.3e-3, self.upload.start)

    def _cycle(self, cycle):
        self.send(SYNC)
        sync = self.now
        self.after(HOST_DELAY, lambda: self._set_points(cycle, sync))
        self._watch(cycle)
        if cycle + 1 < self.cycles:
            self.at(START + (cycle + 1) * CYCLE, lambda: self._cycle(cycle + 1))

    def _set_points(self, cycle, sync):
        for group, identifier in enumerate(SET_POINTS):
            points = [((cycle * (3 + j)) % 2000) - 1000 for j in range(3 * group, 3 * group + 3)]
            self.send(identifier, struct.pack("<3h", *points), sync)

    def _watch(self, cycle):
        for number in (*JOINTS, *SENSORS):
            silent = cycle - self.heard.get(number, -1)
            if silent > WATCH and number not in self.lost:
                self.lost.add(number)
                self.events.append((self.now, f"host: node {number} is silent"))

    def on_message(self, identifier, data):
        base, number = identifier & 0x780, identifier & 0x7F
        if identifier == SDO_ANSWER + 1:
            self.upload.on_answer(data)
        elif base == TPDO:
            cycle = int((self.now - START) // CYCLE)
            again = cycle - self.heard.get(number, -1) <= 1  # one frame alone may be an old one
            self.heard[number] = cycle
            if number in self.lost and again:
                self.lost.discard(number)
                self.events.append((self.now, f"host: node {number} is back"))
        elif base == HEARTBEAT:
            self.states[number] = data[0]
        elif base == EMCY and number:
            code = struct.unpack_from("<H", data)[0]
            self.events.append((self.now, f"host: EMCY {code:04X} of node {number}; starts it"))
            self.send(NMT, bytes([1, number]))


class Robot(Network):
    """The whole of it."""

    def __init__(self, seconds, report="", seed=1):
        names = ["host", *(f"joint{n}" for n in JOINTS), *(f"sensor{n}" for n in SENSORS)]
        scenario = {"name": "Robot", "bitrate": "1000k",
                    "nodes": [{"name": name, "clock": "8 MHz", "ppm": 20 * (k % 5) - 40,
                               "cable": f"{1 + k} m"} for k, name in enumerate(names)]}
        if report:
            scenario["outputs"] = {"report": report}
        super().__init__(verican.Bus(names, scenario=scenario, restart=RESTART, order="identifier"),
                         verican.Frame)
        chance = random.Random(seed)

        def reaction():
            return chance.uniform(*REACTION)
        self.host = self.add(Host(self, seconds))
        self.joints = [self.add(Joint(self, number, reaction)) for number in JOINTS]
        self.sensors = [self.add(Sensor(self, number, reaction)) for number in SENSORS]
        self.end = START + seconds

    @staticmethod
    def sync_of(received):
        """When the SYNC that was received at a time was queued."""
        return START + ((received - START) // CYCLE) * CYCLE

    def fail(self, number, when, duration):
        """The receiver of a joint breaks: it sees an idle bus, whatever it sends."""
        def broken():
            self.host.events.append((self.now, f"joint {number}: its receiver is broken"))
            self.bus.disturb("recessive", self.bus.now, duration, f"joint{number}")
        joint = self.nodes[f"joint{number}"]
        told = joint.on_error

        def on_error(message):
            if message.id & 0x140:
                word = "is bus-off" if message.id & 0x40 else "is back on the bus"
                self.host.events.append((self.now, f"joint {number}: {word}"))
            told(message)
        joint.on_error = on_error
        self.at(when, broken)


def story_checks(robot, measure, number):
    """Whether the joint went bus-off, told so, was started and moves again, and nobody else
    suffered for longer than it disturbed the bus."""
    words = [text for _, text in robot.host.events]
    times = dict(zip(words, (when for when, _ in robot.host.events)))
    story = [f"joint {number}: its receiver is broken", f"joint {number}: is bus-off",
             f"host: node {number} is silent", f"joint {number}: is back on the bus",
             f"host: EMCY 8140 of node {number}; starts it", f"host: node {number} is back"]
    checks = [("bus-off, silence, recovery, EMCY, NMT, and it moves again", words == story,
               f"{len(words)} of {len(story)} events" if words != story else "in this order"),
              ("a SYNC each millisecond", measure.syncs == robot.host.cycles, measure.syncs)]
    if words == story:
        failed, back = (int((times[story[k]] - START) // CYCLE) for k in (0, 5))
        lost = measure.lost_outside(number, failed, back, DISTURBED)
        checks.append(("PDOs lost otherwise", lost == 0, lost))
        checks.append((f"cycles of {measure.syncs} without joint {number}",
                       0 < back - failed < 40, back - failed))
    return checks


def main():
    """The command line; a report that cannot be written, and a reader that is gone, are told."""
    try:
        code = run()
        sys.stdout.flush()
    except (OSError, verican.InputError) as error:
        sys.stdout = None  # what it holds goes nowhere
        sys.exit(f"robot.py: {error}")
    return code


def run():
    """The exit code."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n", maxsplit=1)[0])
    parser.add_argument("--seconds", type=float, default=1.0, help="with SYNC, 0.1 to 3600 (1)")
    parser.add_argument("--fail", action="store_true", help="joint 3 fails in the middle")
    parser.add_argument("--report", default="", help="page for the browser to write")
    parser.add_argument("--seed", type=int, default=1, help="of the reactions of the devices")
    parser.add_argument("--json", action="store_true", help="figures for machines instead")
    arguments = parser.parse_args()
    if not 0.1 <= arguments.seconds <= 3600:
        parser.error("--seconds: allowed are 0.1 to 3600")
    robot = Robot(arguments.seconds, arguments.report, arguments.seed)
    if arguments.fail:
        robot.fail(FAILS, START + arguments.seconds / 2 + 0.1e-3, 3e-3)
    measure = Measure(robot)
    measure.run()
    checks = story_checks(robot, measure, FAILS) if arguments.fail else measure.checks()
    if arguments.json:
        print(json.dumps(measure.figures(checks)))
    else:
        measure.print(checks)
        for when, text in robot.host.events:
            print(f"  {(when - START) * 1e3:9.3f} ms  {text}")
    robot.bus.finish()
    return 0 if all(right for _, right, _ in checks) else 1


if __name__ == "__main__":
    sys.exit(main())
