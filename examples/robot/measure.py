# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""Response times, SYNC jitter and lost PDOs of the robot, beside the bound of the response-time
analysis (Davis, Burns, Bril, Lukkien 2007; jitter of the devices as Tindell's holistic analysis
has it: what answers a SYNC inherits its worst response)."""
import plan
import verican
from device import EMCY, HEARTBEAT, NMT, SDO_ANSWER, SDO_REQUEST, SYNC, TPDO

STRETCH = 0.1        # s of simulated time between two looks
INTERMISSION = 3e-6  # a frame's end is that of EOF; the bound has the intermission with it


class Figure:
    """Least, mean and largest of a time."""

    def __init__(self):
        self.count, self.total, self.least, self.most = 0, 0.0, float("inf"), 0.0

    def add(self, value):
        self.count += 1
        self.total += value
        self.least, self.most = min(self.least, value), max(self.most, value)

    def __str__(self):
        if not self.count:
            return f"{0:8}"
        mean = self.total / self.count
        return f"{self.count:8} {self.least * 1e6:9.1f} {mean * 1e6:9.1f} {self.most * 1e6:9.1f}"


def messages():
    """(id, name, bytes, period, jitter) of every message, by priority; jitter of those that answer
    a SYNC is filled in by bounds()."""
    cycle, beat, devices = plan.CYCLE, plan.BEAT, (*plan.JOINTS, *plan.SENSORS)
    rows = [(SYNC, "SYNC", 0, cycle, 0.0)]
    rows += [(TPDO + n, f"position {n}", 3, cycle, None) for n in plan.JOINTS]
    rows += [(TPDO + n, f"force {n}", 2, cycle, None) for n in plan.SENSORS]
    rows += [(i, f"set points {k}", 6, cycle, plan.HOST_DELAY)
             for k, i in enumerate(plan.SET_POINTS)]
    # A request follows the answer by SDO_PERIOD at least, an answer the request's arrival.
    rows += [(SDO_ANSWER + 1, "SDO answer", 8, plan.SDO_PERIOD, None),
             (SDO_REQUEST + 1, "SDO request", 8, plan.SDO_PERIOD, 0.0)]
    rows += [(HEARTBEAT + n, f"heartbeat {n}", 1, beat, 0.0) for n in devices]
    return sorted(rows)


def bounds(rows, reaction):
    """{id: worst-case response, s, from the event that queues the message}."""
    jitter = [0.0 if row[4] is None else row[4] for row in rows]
    while True:
        specs = [(row[2], False, row[3], jitter[k]) for k, row in enumerate(rows)]
        found = verican.response_times(specs, 1e6)
        after = [reaction + found[0] if TPDO <= row[0] < 0x200 else jitter[k]
                 for k, row in enumerate(rows)]
        if after == jitter:
            return {row[0]: bound for row, bound in zip(rows, found)}
        jitter = after


class Measure:
    """Runs a robot and looks at all that was sent."""

    def __init__(self, robot):
        self.robot = robot
        self.rows = messages()
        self.bounds = bounds(self.rows, plan.REACTION[1])
        self.responses = {row[0]: Figure() for row in self.rows}
        self.sync_start = Figure()   # delay of SYNC's first bit behind its millisecond
        self.syncs = self.frames = self.error_frames = 0
        self.strange = 0
        self.missing = {}     # number of a SYNC: devices that had not answered before the next
        self._answers = None  # ids that have answered the last SYNC
        self._busy = 0.0

    def run(self):
        """To the end, and what is under way then."""
        robot = self.robot
        end = robot.end + 1e-3
        while robot.now < end - 1e-9:
            stop = min(end, robot.bus.now + STRETCH)
            robot.run(stop)
            robot.now = stop
            self._take()
        self._close_cycle()

    def _take(self):
        for _, identifier, event, when in self.robot.sent:
            if identifier in self.responses:
                self.responses[identifier].add(when - event)
            elif identifier not in (NMT, *range(EMCY + 1, EMCY + 9)):
                self.strange += 1
        self.robot.sent.clear()
        for start, end, _, frame in self.robot.bus.frames():
            self.frames += 1
            self._busy += end - start + INTERMISSION
            if frame.id == SYNC:
                self._close_cycle()
                self._answers = set()
                nominal = plan.START + self.syncs * plan.CYCLE
                self.sync_start.add(start - nominal)
                self.syncs += 1
            elif TPDO <= frame.id < 0x200 and self._answers is not None:
                self.strange += frame.id in self._answers
                self._answers.add(frame.id)
        self.error_frames += sum(event["kind"] != "frame" for event in self.robot.bus.events())

    def _close_cycle(self):
        if self._answers is None:
            return
        missing = {n for n in (*plan.JOINTS, *plan.SENSORS)
                   if TPDO + n not in self._answers}
        if missing:
            self.missing[self.syncs - 1] = missing

    @property
    def lost(self):
        """PDOs that were not there when the next SYNC came."""
        return sum(map(len, self.missing.values()))

    def lost_outside(self, number, failed, back, disturbed):
        """Of these, those that the failure of a device from cycle `failed` to `back` is no reason
        for: it disturbs others only for so many cycles."""
        return sum(len(missing - ({number} if failed <= cycle <= back else set()))
                   for cycle, missing in self.missing.items()
                   if not failed <= cycle <= failed + disturbed)

    def _over(self):
        return [row[1] for row in self.rows if self.bounds[row[0]] is not None
                and self.responses[row[0]].most + INTERMISSION > self.bounds[row[0]] + 1e-9]

    def checks(self):
        """(what, whether it holds, what was seen)."""
        robot, upload = self.robot, self.robot.host.upload
        blocking = self.bounds[SYNC] - 55e-6
        return [
            ("a SYNC each millisecond", self.syncs == robot.host.cycles, self.syncs),
            ("PDOs that a SYNC did not bring before the next", self.lost == 0, self.lost),
            ("frames twice, or of nobody", self.strange == 0, self.strange),
            ("error frames", self.error_frames == 0, self.error_frames),
            ("responses above their bound", not self._over(), ", ".join(self._over()) or 0),
            (f"SYNC begins at most {blocking * 1e6:.0f} us late (bound)",
             self.sync_start.most <= blocking, f"{self.sync_start.most * 1e6:.1f} us"),
            ("uploads by SDO, all right", upload.completed > 0 and upload.wrong == 0,
             upload.completed)]

    def figures(self, checks):
        """For machines: counts, times in microseconds, checks."""
        largest = {name: round(self.responses[identifier].most * 1e6, 3)
                   for identifier, name, *_ in self.rows}
        return {"syncs": self.syncs, "frames": self.frames, "lost": self.lost,
                "error_frames": self.error_frames, "largest_us": largest,
                "sync_late_us": round(self.sync_start.most * 1e6, 3),
                "load": round(self._busy / self.robot.bus.now, 4),
                "uploads": self.robot.host.upload.completed,
                "checks": [{"what": what, "ok": right, "seen": seen}
                           for what, right, seen in checks]}

    def print(self, checks):
        """Tables for people."""
        seconds = self.robot.end - plan.START
        print(f"robot: {seconds:g} s, {self.syncs} SYNCs, {self.frames} frames, load "
              f"{100 * self._busy / self.robot.bus.now:.1f} %")
        print(f"  {'us from event to end':24} {'count':>8} {'least':>9} {'mean':>9} {'largest':>9} "
              f"{'bound':>9}")
        for identifier, name, *_ in self.rows:
            bound = self.bounds[identifier]
            text = "full" if bound is None else f"{(bound - INTERMISSION) * 1e6:9.1f}"
            print(f"  {identifier:03X} {name:20} {self.responses[identifier]} {text}")
        print(f"  {'SYNC behind its ms':24} {self.sync_start}")
        for what, right, seen in checks:
            print(f"  {'ok  ' if right else 'FAIL'}  {what}: {seen}")
