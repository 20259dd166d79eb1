# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""Interfaces that come and go, echo, and the end in the middle of traffic."""
import json
import subprocess

from canlog import Frame, expect, expect_true, frames, merged, read, same
from failures import check_restart
from traffic import cangen, counter

VXCAN = """\
name: echo
bitrate: 1M
nodes:
  - {name: other, tx_buffers: 1}
traffic:
  - {node: other, name: m, id: 0x7FF, data: counter, dlc: 8, period: saturated, count: 300}
"""

# CAN FD frames, short and long, with and without the other bit rate; error messages.
STRANGE = ("123##0CA", "123##1CAFE", f"12345678##1{'5A' * 64}", "20000004#0008000000000000",
           "20000088#0000020000000000")


def port(run, name, interface):
    """The bridge's own account of an interface, and of the frames on the bus."""
    report = json.loads(run.text(f"{name}.out"))
    found = [entry for entry in report["ports"] if entry["name"] == interface]
    expect(len(found), 1, f"{name}: accounts of {interface}")
    return found[0], report["bus"]["frames"]


def account(run, name, interface, **wanted):
    """Compares some numbers of the account."""
    found, _ = port(run, name, interface)
    expect({key: found[key] for key in wanted}, wanted, f"{name}: account of {interface}")


def said(run, name):
    """Its lines on stderr, without the one that it is ready."""
    lines = run.text(f"{name}.err").splitlines()
    return [line.removeprefix("verican bridge: ") for line in lines if " ready: " not in line]


def refused(run):
    """One line that names what is wrong, exit code 2."""
    for name, words in (("missing", ("--if nope0:", "no such interface", "ip link add")),
                        ("down", ("--if vcan7:", "is down", "ip link set vcan7 up")),
                        ("no-can", ("--if lo:", "not a CAN interface")),
                        ("monitor", ("nope1:", "no such interface"))):
        run.ended(name, 2)
        lines = run.text(f"{name}.err").splitlines()
        expect(len(lines), 1, f"{name}: lines on stderr ({lines})")
        expect([word for word in words if word not in lines[0]], [], f"not in {lines[0]!r}")
        expect(run.text(f"{name}.out"), "", f"{name}: stdout")


def come_and_go(run):
    """Down and up, gone and back: what had been sent before leaves; the bus goes on meanwhile."""
    accepted = cangen(1000)
    meanwhile = cangen(300, extended=True)
    after = {"vcan0": cangen(100, ident=0x7F0, dlc=8), "vcan1": cangen(100, ident=0x7F1, dlc=8)}
    vanished = cangen(200, ident=0x1ABCDEF0, extended=True, dlc=8)
    gone = cangen(100, ident=0x7F3, dlc=8)
    back = cangen(100, ident=0x7F2, dlc=8)
    early = {"vcan0": accepted + after["vcan0"], "vcan1": meanwhile + after["vcan1"]}
    late = {"vcan0": vanished + back, "vcan1": gone}
    for place, senders in (("mon0", early), ("vcan1", early), ("mon0-late", late),
                           ("vcan1-late", late)):
        merged(frames(read(run.dir / f"{place}.log")), senders, place)
    merged(frames(read(run.dir / "vcan0-back.log")), after, "vcan0 when it is back")
    bus = frames(read(run.dir / "traffic-bus.log"))
    merged(bus, {name: early[name] + late[name] for name in early}, "bus")
    same(bus, [frame for name in ("mon0", "mon0-late")
               for frame in frames(read(run.dir / f"{name}.log"))], "bus against monitor")
    expect(said(run, "traffic"), ["vcan0 is down or gone; waiting for it", "vcan0 is back"] * 2,
           "what the bridge says")
    account(run, "traffic", "vcan0", from_host=1400, sent=1400, pending=0, lost=0, received=500,
            away=400, to_host=100, up=True)
    account(run, "traffic", "vcan1", from_host=500, sent=500, received=1400, to_host=1400, away=0)
    run.ended("traffic")


def counted_losses(run):
    """What has not come is counted, and the exit code says so; the rest is in order."""
    seen = frames(read(run.dir / "small-mon.log"))
    expect(seen[-1:], [Frame(0x123, False, False, 0, b"")], "the last frame")
    sent = iter(cangen(2000, ident=0x7F0, dlc=8))
    expect([frame for frame in seen[:-1] if frame not in sent], [], "frames out of order")
    lost = 2001 - len(seen)
    expect_true(lost > 100, f"only {lost} frames were lost: the flood was too small")
    account(run, "small", "vcan0", lost=lost, sent=len(seen), pending=0)
    run.ended("small", 1)
    return [f"of 2000 frames into a small buffer {lost} were dropped by the kernel, and counted"]


def interfaces(run):
    """All that guest/interfaces.sh left."""
    refused(run)
    come_and_go(run)
    run.ended("end")
    expect(said(run, "end"), ["vcan0 is down or gone; this is the end"], "--end-when-down")
    for way in ("up", "signal"):
        check_restart(run, f"{way}.log")
        same(frames(read(run.dir / f"{way}-mon.log")), [Frame(0x123, False, False, 1, b"\x80")],
             f"{way}: frame after recovery")
        account(run, way, "vcan0", bus_off=1, restarts=1, sent=1, pending=0, bus_off_now=False)
        run.ended(way)
    return counted_losses(run)


def vxcan(run):
    """With --echo each frame comes once, in its place among those of the others; else never."""
    own, other = cangen(300), counter(300, 0x7FF, False, 8)
    for way in ("echo", "silent"):
        bus = frames(read(run.dir / f"{way}-bus.log"))
        merged(bus, {"program": own, "other": other}, f"{way}: bus")
        wanted = bus if way == "echo" else other
        same(frames(read(run.dir / f"{way}.log")), wanted, f"{way}: what the program's side sees")
        account(run, way, "vx1", from_host=300, sent=300, received=300, to_host=300, lost=0,
                echoes=300 if way == "echo" else 0)
        run.ended(way)
    account(run, "strange", "vx1", rejected=len(STRANGE), from_host=1, sent=1, lost=0)
    run.ended("strange")


def signals(run):
    """Logs are whole and agree; what has not left is a rest of what was sent, in its order."""
    lines = []
    for name in ("INT", "TERM"):
        run.ended(name)
        bus = frames(read(run.dir / f"{name}-bus.log"))
        same(bus, cangen(10000)[:len(bus)], f"{name}: bus")
        expect_true(300 <= len(bus) < 10000, f"{name}: {len(bus)} frames, no end under load")
        same(frames(read(run.dir / f"{name}-mon.log")), bus, f"{name}: monitor against bus")
        counted = subprocess.run(["tshark", "-r", str(run.dir / f"{name}.pcap"), "-T", "fields",
                                  "-e", "can.id"], check=True, capture_output=True, text=True)
        expect([int(ident) for ident in counted.stdout.split()], [f.ident for f in bus],
               f"{name}: identifiers in the capture")
        found, total = port(run, name, "vcan0")
        expect((found["sent"], total), (len(bus), len(bus)), f"{name}: frames in the account")
        expect(found["from_host"], found["sent"] + found["pending"], f"{name}: from the host")
        if name == "TERM":
            expect(found["from_host"], 10000, f"{name}: frames that the program has sent")
        expect((found["lost"], found["overruns"]), (0, 0), f"{name}: lost")
        lines.append(f"SIG{name}: {len(bus)} frames had left")
    return lines
