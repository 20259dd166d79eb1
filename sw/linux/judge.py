# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""What a run of a guest script must have left behind: one function a script."""
import json
import re
from collections import Counter

import frames
import kernel_log
from expectations import Failed, expect, expect_true


class Run:
    """The files of one run."""

    def __init__(self, directory, chip, settings):
        self.dir = directory
        self.chip = chip
        self.settings = settings
        self.notes = {}

    def text(self, name):
        path = self.dir / name
        expect_true(path.exists(), f"{name} is missing")
        return path.read_text()

    def log(self, name):
        """Frames in order, error messages left out."""
        expect_true((self.dir / name).exists(), f"{name} is missing")
        log = frames.read_log(self.dir / name)
        return [(e.time, e.frame) for e in log if not e.frame.is_error]

    def errors(self, name):
        """Error messages of the driver: (identifier, eight bytes)."""
        log = frames.read_log(self.dir / name)
        return [(e.frame.ident & 0x1FFFFFFF, e.frame.data) for e in log if e.frame.is_error]

    def link(self, stage, device):
        """What ip says of a device."""
        return json.loads(self.text(f"{stage}-{device}.json"))[0]

    def bus(self, stage):
        """What the simulator says: {node: {key: value}}."""
        result = {}
        for line in self.text(f"{stage}-bus.txt").splitlines():
            name, *pairs = line.split()
            values = dict(pair.split("=") for pair in pairs)
            result[name] = {k: int(v) if v.isdigit() else v for k, v in values.items()}
        return result

    def state(self, stage, device):
        return self.link(stage, device)["linkinfo"]["info_data"]["state"]

    def packets(self, stage, device):
        """(received, sent). Linux 6.1 counts the echo of what it has sent as received, too."""
        stats = self.link(stage, device)["stats64"]
        return stats["rx"]["packets"], stats["tx"]["packets"]

    def same_as_bus(self, device_log, bus_log):
        """Every frame of the bus, in its order, is in the device's log, and nothing else."""
        wanted = [frame for _, frame in self.log(bus_log)]
        found = [frame for _, frame in self.log(device_log)]
        if found == wanted:
            return wanted
        lost = list((Counter(wanted) - Counter(found)).elements())
        extra = list((Counter(found) - Counter(wanted)).elements())
        raise Failed(f"{device_log} differs from {bus_log}: {len(found)} of {len(wanted)} frames, "
                     f"lost {lost[:3]}, added {extra[:3]}, or another order")

    def counters_agree(self, stage):
        """Error counters and state of both devices are those of the cores."""
        bus = self.bus(stage)
        states = {"active": ("ERROR-ACTIVE", "ERROR-WARNING"), "passive": ("ERROR-PASSIVE",),
                  "bus-off": ("BUS-OFF",)}
        for device in ("can0", "can1"):
            info = self.link(stage, device)["linkinfo"]["info_data"]
            node = bus[device]
            if node["state"] != "bus-off":
                expect((info["berr_counter"]["tx"], info["berr_counter"]["rx"]),
                       (node["tec"], node["rec"]), f"{stage}: error counters of {device}")
            expect_true(info["state"] in states[node["state"]],
                        f"{stage}: {device} is {info['state']}, the core is {node['state']}")


def common(run):
    """What holds after every script."""
    console = run.text("console.txt")
    bad = [line for line in console.splitlines() if "FAILED" in line]
    expect(bad, [], "the guest complains")
    expect_true(f"end of {run.settings['VERICAN_SCRIPTS']}" in console, "the guest did not finish")
    found = kernel_log.complaints(run.text("dmesg.txt"),
                                  r"\bwarning\b|\bbug\b|timed out|flexcan.*(fail|error|timeout)")
    # What the J1939 stack says of transfers is for the judges of these.
    expect([line for line in found if "j1939_" not in line], [], "messages of the kernel")
    for path in run.dir.glob("*-bus.txt"):
        expect(run.bus(path.name[:-8])["bus"]["access_errors"], 0, f"{path.name}: bus errors")


def probe(run):
    driver = run.text("driver.txt")
    expect_true("driver: flexcan" in driver and "bus-info: e0000000.can" in driver,
                f"not the flexcan driver: {driver!r}")
    expect_true("rx-rtr: on" in run.text("flags.txt"), "the driver does not receive remote frames")
    for device in ("can0", "can1"):
        expect(run.state("stopped", device), "STOPPED", device)
        info = run.link("stopped", device)["linkinfo"]["info_data"]
        expect(info["clock"], 8_000_000, "clock of the device tree")
        for turn in (1, 2, 3):
            expect(run.state(f"up{turn}", device), "ERROR-ACTIVE", f"{device}, round {turn}")
            expect(run.state(f"down{turn}", device), "STOPPED", f"{device}, round {turn}")
            timing = run.link(f"up{turn}", device)["linkinfo"]["info_data"]["bittiming"]
            expect(timing["bitrate"], 500_000, "bit rate")
    for turn in (1, 2, 3):
        expect(run.bus(f"sent{turn}")["bus"]["frames"], turn, "frames on the bus")
        expect(run.packets(f"sent{turn}", "can0"), (turn, turn), "can0 packets")
        expect(run.packets(f"sent{turn}", "can1"), (turn, 0), "can1 packets")
    lines = re.findall(r"^\s*\d+:\s+(\d+)\s+verican", run.text("interrupts.txt"), re.M)
    expect([int(n) >= 3 for n in lines], [True, True], "interrupts of both lines")


def _rates(run):
    return [int(rate) for rate in run.settings["VERICAN_RATES"].split(",")]


def exchange(run):
    count = int(run.settings["VERICAN_FRAMES"])
    total = [0, 0]
    loads = []
    for rate in _rates(run):
        sent = run.same_as_bus(f"{rate}-can0.log", f"{rate}-bus.log")
        run.same_as_bus(f"{rate}-can1.log", f"{rate}-bus.log")
        expect(len(sent), 2 * count + 20, f"{rate}: frames on the bus")
        base = sum(not frame.extended for frame in sent)
        bus = run.bus(str(rate))
        for key, value in (("frames", len(sent)), ("errors", 0), ("unacked", 0), ("overloads", 0)):
            expect(bus["bus"][key], value, f"{rate}: {key} on the bus")
        expect((bus["can0"]["sent"], bus["can1"]["sent"]), (base, len(sent) - base), "senders")
        total[0] += base
        total[1] += len(sent) - base
        for number, device in enumerate(("can0", "can1")):
            expect(run.packets(str(rate), device), (sum(total), total[number]),
                   f"{rate}: packets of {device} (received with echo, sent)")
        run.counters_agree(str(rate))
        loads.append(frames.load(run.log(f"{rate}-bus.log")[20:], rate))
    run.notes["frames"] = sum(total)
    run.notes["load"] = min(loads)


def flood(run):
    count = int(run.settings["VERICAN_FRAMES"])
    loads = []
    for rate in _rates(run):
        for device in ("can0", "can1"):
            expect(len(run.same_as_bus(f"{rate}-{device}.log", f"{rate}-bus.log")), 2 * count,
                   f"{rate}: frames")
        loads.append(frames.load(run.log(f"{rate}-bus.log"), rate))
        # Not quite 1: in each frame the sender synchronises to an acknowledgement that is late by
        # the receivers' two clocks.
        expect_true(loads[-1] > 0.995, f"{rate}: load of the bus only {loads[-1]:.4f}")
        expect(run.bus(str(rate))["bus"]["errors"], 0, f"{rate}: error frames")
    run.notes["frames"] = 2 * count * len(loads)
    run.notes["load"] = min(loads)


def remote(run):
    sent = run.same_as_bus("can0.log", "bus.log")
    run.same_as_bus("can1.log", "bus.log")
    expect([(f.ident, f.extended, f.dlc) for f in sent if f.remote],
           [(0x123, False, 0), (0x12345678, True, 5), (0x124, False, 8),
            (0x223, False, 0), (0x02345678, True, 5), (0x224, False, 8)], "remote frames")
    expect([f.data.hex() for f in sent if not f.remote], ["1122", "3344"], "data frames")
    run.notes["frames"] = len(sent)


def loopback(run):
    sent = [frame for _, frame in run.log("can0.log")]
    expect(len(sent), 80, "each frame once as echo and once received")
    expect(sent[0::2], sent[1::2], "received frames")
    expect([f.ident for f in sent[0::2]], 2 * list(range(20)), "identifiers")
    expect(run.bus("loopback")["bus"]["frames"], 0, "frames on the bus")
    expect(run.log("can1.log"), [], "frames at can1")
    expect([f.ident for _, f in run.log("bus.log")], [0x321], "after loop-back")
    run.notes["frames"] = 40


def listenonly(run):
    alone = run.bus("alone")
    expect(alone["bus"]["frames"], 0, "acknowledged frames without a third node")
    expect_true(alone["bus"]["unacked"] > 100, "can0 did not repeat its frame")
    expect(run.state("alone", "can0"), "ERROR-PASSIVE", "can0 alone")
    expect((alone["can0"]["tec"], alone["can0"]["busoff"]), (128, 0), "TEC alone and bus-off")
    expect(run.link("alone", "can0")["linkinfo"]["info_data"]["berr_counter"]["tx"], 128, "TEC")
    expect(alone["can1"]["attempts"], 0, "attempts of can1 alone")
    # What an error-passive sender repeats is whole and valid for a listener (MO-03), each time; the
    # log of the bus has the acknowledged frames.
    expect(run.packets("alone", "can1"), (alone["bus"]["unacked"], 0), "packets of can1 alone")
    heard = [frame for _, frame in run.log("can1.log")]
    bus = [frame for _, frame in run.log("bus.log")]
    expect(len(bus), 71, "acknowledged frames")
    repeated = heard[:-len(bus)]
    expect(heard[-len(bus):], bus, "acknowledged frames that can1 heard")
    expect(set(repeated), {bus[0]}, "what can0 repeated")
    expect_true(len(repeated) >= alone["bus"]["unacked"], "repetitions that can1 heard")
    expect(run.bus("heard")["can1"]["attempts"], 0, "attempts of can1")
    run.notes["frames"] = len(heard)


# Classes and controller states of include/uapi/linux/can/error.h
CONTROLLER, BUS_OFF, RESTARTED = 0x004, 0x040, 0x100
TX_WARNING, TX_PASSIVE = 0x08, 0x20


def busoff(run):
    down = [(CONTROLLER, TX_WARNING), (CONTROLLER, TX_PASSIVE), (BUS_OFF, 0), (RESTARTED, 0)]
    for name in ("can0.log", "manual.log"):
        expect([(kind, data[1]) for kind, data in run.errors(name)], down, name)
    expect([f.ident for _, f in run.log("can0.log")], [0x123, 0x125], "frames of can0")
    expect([f.ident for _, f in run.log("manual.log")], [0x127], "frames after a manual restart")
    run.counters_agree("eleven")
    expect(run.bus("eleven")["can0"]["tec"], 87, "TEC after 11 errors and a success")
    expect(run.bus("off")["can0"]["busoff"], 1, "bus-off of the core")
    for stage, state in (("off", "BUS-OFF"), ("restarted", "ERROR-ACTIVE"), ("waits", "BUS-OFF"),
                         ("manual", "ERROR-ACTIVE")):
        expect(run.state(stage, "can0"), state, stage)
    pause = (int(run.text("restarted.txt")) - int(run.text("off.txt"))) / 1e6
    expect_true(95 <= pause <= 130, f"restart-ms 100 took {pause:.1f} ms of simulated time")
    stats = run.link("manual", "can0")["linkinfo"]["info_xstats"]
    wanted = {"restarts": 2, "bus_error": 0, "arbitration_lost": 0, "error_warning": 2,
              "error_passive": 2, "bus_off": 2}
    expect(stats, wanted, "statistics of can0")
    expect(run.bus("manual")["can0"]["busoff"], 2, "bus-off of the core")


def stuck(run):
    for number, level in enumerate(("dominant", "recessive"), 1):
        expect(run.bus(level)["can0"]["attempts"], number - 1, f"attempts, {level}")
        expect(run.state(f"after-{level}", "can0"), "ERROR-ACTIVE", f"after {level}")
        expect(run.packets(f"after-{level}", "can0")[1], number, f"sent, after {level}")
        expect(run.packets(f"after-{level}", "can1"), (number, 0), f"received, after {level}")


def statistics(run):
    stages = ["start", "tx-bit", "tx-ack", "tx-form", "rx-crc", "rx-data", "rx-form", "clean"]
    for stage in stages:
        run.counters_agree(stage)
        bus = run.bus(stage)
        for device in ("can0", "can1"):
            node = bus[device]
            stats = run.link(stage, device)["linkinfo"]["info_xstats"]
            expect(stats["bus_error"], node["errors"], f"{stage}: bus errors of {device}")
            expect(stats["bus_off"], node["busoff"], f"{stage}: bus-off of {device}")
            # A sender knows of its success with EOF7, a receiver one bit earlier.
            expect(run.packets(stage, device)[1], node["sent"], f"{stage}: sent by {device}")
            expect(run.packets(stage, device)[0], node["sent"] + node["delivered"],
                   f"{stage}: received by {device}, with echo")
    last = run.bus("clean")
    expect_true(last["can0"]["bit0"] + last["can0"]["bit1"] > 0 and last["can0"]["ack"] > 0 and
                last["can0"]["form"] > 0, f"errors that can0 did not see: {last['can0']}")
    expect_true(last["can1"]["crc"] > 0 and last["can1"]["form"] > 0 and last["can1"]["stuff"] > 0,
                f"errors that can1 did not see: {last['can1']}")
    for device in ("can0", "can1"):
        reported = sum(1 for kind, _ in run.errors(f"{device}.log") if kind & 0x80)
        expect(reported, last[device]["errors"], f"error messages of {device}")
    expect(run.state("stopped", "can0"), "STOPPED", "can0")


def reload(run):
    for turn in (1, 2, 3):
        bus = run.log(f"bus{turn}.log")
        run.same_as_bus(f"can0-{turn}.log", f"bus{turn}.log")
        run.same_as_bus(f"can1-{turn}.log", f"bus{turn}.log")
        expect(sum(f.extended for _, f in bus), 50, f"round {turn}: frames of can1")
        expect_true(sum(f.ident == 0x181 for _, f in bus) > 5, f"round {turn}: no traffic")
        expect_true(run.bus(f"before{turn}")["bus"]["frames"] > 20, f"round {turn}: no traffic")
        expect(run.state(f"after{turn}", "can0"), "ERROR-ACTIVE", f"round {turn}")
        expect(run.packets(f"after{turn}", "can1")[1], 50, f"round {turn}: a new device's packets")
        run.notes["frames"] = run.notes.get("frames", 0) + len(bus)


def rxrtr(run):
    for stage, on in (("fifo", True), ("mailbox", False), ("again", True)):
        expect_true(f"rx-rtr: {'on' if on else 'off'}" in run.text(f"{stage}-flags.txt"), stage)
        bus = [f for _, f in run.log(f"{stage}-bus.log")]
        at_can1 = [f for _, f in run.log(f"{stage}-can1.log")]
        expect(len(bus), 122, f"{stage}: frames on the bus")
        expect(at_can1, bus if on else [f for f in bus if not f.remote], f"{stage}: frames at can1")
        run.notes["frames"] = run.notes.get("frames", 0) + len(bus)
    expect_true("cannot receive RTR frames" in run.text("dmesg.txt"), "no message of the driver")
