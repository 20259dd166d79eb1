#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""The robot of docs/canopen.md with CANopenNode in its devices: eight boards with a Cortex-M3 and a
VeriCAN core each, six joints and two sensors, and a host that configures their PDOs by SDO.

    CANOPENNODE=~/CANopenNode sw/canopennode/build.py --clock 32000000 OUT 1 2 3 4 5 6 7 8
    examples/robot/firmware.py OUT --verican build/release/verican [--seconds 0.2] [--fail]

Exit code 1: a PDO was lost, a device did not take its configuration, or the failure did not go as
it should.
"""
import argparse
import collections
import pathlib
import struct
import subprocess
import sys
import tempfile

import yaml

from plan import FAILS, JOINTS, SENSORS, SET_POINTS

CLOCK = "32 MHz"
CONFIGURE, OPERATE, FIRST_SYNC, ENABLE = 12, 60, 65, 70  # ms
STEP = 2                                                  # ms between two requests to a device
FAILURE = 3                                               # ms
OFF = 0x80000000                                          # a PDO that is not valid
POSITION, STATUS, FORCE = 0x200A0010, 0x60610008, 0x20030010
SHORT_SET_POINT, DUMMY = 0x20090010, 0x00030010
SIZES = {1: 0x2F, 2: 0x2B, 4: 0x23}                       # expedited download of so many bytes


def download(index, sub, value, size):
    """An SDO request as the scenario has it."""
    return struct.pack("<BHBI", SIZES[size], index, sub, value).hex(" ")


def pdo(communication, mapping, cob_id, objects, kind=1):
    """Requests that map objects into a PDO."""
    yield download(communication, 1, OFF | cob_id, 4)
    yield download(communication, 2, kind, 1)
    yield download(mapping, 0, 0, 1)
    for place, entry in enumerate(objects, start=1):
        yield download(mapping, place, entry, 4)
    yield download(mapping, 0, len(objects), 1)
    yield download(communication, 1, cob_id, 4)


def configuration(number):
    """All requests to a device."""
    yield download(0x1017, 0, 100, 2)
    yield download(0x1801, 1, OFF | 0x280 + number, 4)  # the cyclic TPDO is not wanted here
    if number in SENSORS:
        yield from pdo(0x1800, 0x1A00, 0x180 + number, [FORCE])
        return
    place = (number - 1) % 3  # in the PDO of three joints; a shorter mapping is EMCY 8220
    yield from pdo(0x1800, 0x1A00, 0x180 + number, [POSITION, STATUS])
    yield from pdo(0x1400, 0x1600, SET_POINTS[(number - 1) // 3],
                   [DUMMY] * place + [SHORT_SET_POINT] + [DUMMY] * (2 - place))


def once(name, identifier, data, offset):
    """A frame of the host."""
    return {"node": "host", "name": name, "id": identifier, "data": data, "count": 1,
            "offset": f"{offset:.2f} ms"}


def traffic():
    """All that the host sends but SYNC and set points."""
    for number in (*JOINTS, *SENSORS):
        shift = CONFIGURE + 0.2 * number
        for k, request in enumerate(configuration(number)):
            yield once(f"set-up {number}.{k}", 0x600 + number, request, shift + STEP * k)
        if number in JOINTS:
            for k, word in enumerate((0x06, 0x07, 0x0F)):
                yield once(f"enable {number}.{k}", 0x600 + number, download(0x6040, 0, word, 2),
                           ENABLE + 0.1 * number + STEP * k)
    yield once("start", 0, "01 00", OPERATE)


def scenario(folder, cycles, fail):
    """The whole bus."""
    devices = [{"name": f"drive{n}", "clock": CLOCK, "ppm": 10 * n - 45, "cable": f"{n} m",
                "firmware": str(folder / f"drive{n}.elf")} for n in (*JOINTS, *SENSORS)]
    each = {"node": "host", "period": "1 ms", "count": cycles}
    points = [{**each, "name": f"set points {k}", "id": identifier, "data": "counter", "dlc": 6,
               "offset": f"{FIRST_SYNC + 0.02} ms"} for k, identifier in enumerate(SET_POINTS)]
    bus = {"name": "Robot with CANopenNode", "bitrate": "1000k",
           "duration": f"{FIRST_SYNC + cycles} ms", "nodes":
           [{"name": "host", "clock": "8 MHz", "tx_buffers": 16}, *devices], "traffic":
           [*traffic(), {**each, "name": "sync", "id": 0x80, "offset": f"{FIRST_SYNC} ms"},
            *points]}
    if fail:
        bus["faults"] = [{"kind": "recessive", "node": f"drive{FAILS}", "for": f"{FAILURE} ms",
                          "from": f"{FIRST_SYNC + cycles // 2}.1 ms"}]
    return bus


def frames(log):
    """(s, id, data) of each line of candump."""
    for line in log.read_text(encoding="ascii").splitlines():
        stamp, _, frame = line.split()
        identifier, data = frame.split("#")
        yield float(stamp[1:-1]), int(identifier, 16), bytes.fromhex(data)


class Cycles:
    """What each SYNC brought."""

    def __init__(self, log):
        self.missing, self.times = [], collections.defaultdict(list)
        self.refused, self.answers, self.emergencies = 0, 0, []
        answered, sync, last = None, 0.0, {}
        for when, identifier, data in frames(log):
            if identifier == 0x80:
                self._close(answered)
                answered, sync = set(), when
            elif identifier & 0x780 == 0x180 and answered is not None:
                answered.add(identifier & 0x7F)
                self.times[identifier & 0x7F].append(when - sync)
                last[identifier & 0x7F] = data
            elif identifier & 0x780 == 0x580:
                self.answers += 1
                self.refused += data[0] != 0x60
            elif identifier & 0x780 == 0x80:
                self.emergencies.append((identifier & 0x7F, struct.unpack_from("<H", data)[0]))
        self._close(answered)
        self.positions = {n: struct.unpack_from("<h", last[n])[0] for n in JOINTS if n in last}

    def _close(self, answered):
        if answered is not None:
            self.missing.append({n for n in (*JOINTS, *SENSORS) if n not in answered})

    @property
    def late(self):
        """PDOs that were not there when the next SYNC came."""
        return sum(map(len, self.missing))

    def lost(self, number):
        """Cycles less PDOs of a device."""
        return len(self.missing) - len(self.times[number])


def checks(cycles, found, fail):
    """(what, whether it holds, what was seen)."""
    requests = sum(1 for item in traffic() if item["id"] != 0)
    others = [n for n in (*JOINTS, *SENSORS) if not (fail and n == FAILS)]
    lost = sum(abs(found.lost(n)) for n in others)
    result = [("SYNCs", len(found.missing) == cycles, len(found.missing)),
              ("requests by SDO, all granted",
               found.answers == requests and found.refused == 0, f"{found.answers} of {requests}"),
              (f"PDOs of {len(others)} devices lost", lost == 0, lost)]
    if fail:
        out = found.lost(FAILS)
        told = (FAILS, 0x8140) in found.emergencies
        result += [("EMCY 8140 of joint 3", told, found.emergencies),
                   ("cycles without joint 3; it came back",
                    0 < out < 60 and FAILS not in found.missing[-1], out)]
    else:
        result += [("PDOs behind the next SYNC", found.late == 0, found.late),
                   ("EMCY", not found.emergencies, len(found.emergencies)),
                   # Joints 1 and 4 get the low half of the counter, the others what is above it: 0.
                   ("joints follow their set points", all(
                       abs(found.positions.get(n, -1) - (cycles - 2 if n in (1, 4) else 0)) <= 1
                       for n in JOINTS), found.positions)]
    return result


def main():
    """The command line."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n", maxsplit=1)[0])
    parser.add_argument("firmware", type=pathlib.Path, help="folder with drive1.elf to drive8.elf")
    parser.add_argument("--verican", default="verican", help="the tool")
    parser.add_argument("--seconds", type=float, default=0.2, help="with SYNC, 0.1 to 600 (0.2)")
    parser.add_argument("--fail", action="store_true", help="joint 3 fails in the middle")
    parser.add_argument("options", nargs="*", help="of verican run")
    arguments = parser.parse_args()
    if not 0.1 <= arguments.seconds <= 600:
        parser.error("--seconds: allowed are 0.1 to 600")
    cycles = round(arguments.seconds * 1000)
    with tempfile.TemporaryDirectory() as folder:
        file, log = pathlib.Path(folder) / "robot.yaml", pathlib.Path(folder) / "robot.log"
        bus = scenario(arguments.firmware.resolve(), cycles, arguments.fail)
        file.write_text(yaml.safe_dump(bus, sort_keys=False), encoding="utf-8")
        try:
            done = subprocess.run([arguments.verican, "run", str(file), "--candump", str(log),
                                   *arguments.options], stdout=subprocess.DEVNULL, check=False)
        except OSError as error:
            sys.exit(f"firmware.py: {arguments.verican}: {error.strerror}; --verican says where "
                     "the tool is")
        if done.returncode:
            return done.returncode
        found = Cycles(log)
    print(f"robot with CANopenNode: {arguments.seconds:g} s")
    print(f"  {'us from end of SYNC to end':28} {'least':>8} {'mean':>8} {'largest':>8}")
    for number, times in sorted(found.times.items()):
        mean = sum(times) / len(times)
        print(f"  TPDO {number:<23} {min(times) * 1e6:8.0f} {mean * 1e6:8.0f} "
              f"{max(times) * 1e6:8.0f}")
    held = checks(cycles, found, arguments.fail)
    for what, right, seen in held:
        print(f"  {'ok  ' if right else 'FAIL'}  {what}: {seen}")
    return 0 if all(right for _, right, _ in held) else 1


if __name__ == "__main__":
    sys.exit(main())
