# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""Recordings of `verican run`, judged by programs that others wrote: tshark, log2asc, canplayer."""
import subprocess

from canlog import Frame, expect, expect_true, frames, parse, read, same

IDENTIFIERS = ((0x000, False), (0x123, False), (0x7FF, False),
               (0x00000000, True), (0x0ABCDEF1, True), (0x1FFFFFFF, True))


def every_frame(raw_dlc):
    """[(start in us, frame)]: every DLC, data and remote, both formats; with raw_dlc also 9 to 15,
    which mean eight bytes."""
    sent = []
    for ident, extended in IDENTIFIERS:
        for dlc in range(16 if raw_dlc else 9):
            for remote in (False, True):
                data = b"" if remote else bytes((ident + 17 * i + dlc) & 0xFF
                                                for i in range(min(dlc, 8)))
                sent.append((400 * len(sent), Frame(ident, extended, remote, dlc, data)))
    return sent


def scenario(sent):
    """A scenario in which two nodes in turn send these frames at these times."""
    lines = []
    for number, (offset, frame) in enumerate(sent):
        kind = "remote: true, " if frame.remote else ""
        data = f"data: \"{frame.data.hex(' ')}\", " if frame.data else ""
        lines.append(f"  - {{node: {'ab'[number % 2]}, name: m{number}, id: {frame.ident:#x}, "
                     f"extended: {str(frame.extended).lower()}, {kind}dlc: {frame.dlc}, {data}"
                     f"count: 1, offset: {offset} us}}\n")
    return ("name: every kind of frame\nbitrate: 1M\n"
            f"duration: {400 * len(sent)} us\n"
            "nodes:\n  - {name: a}\n  - {name: b}\ntraffic:\n" + "".join(lines))


def record(verican, directory, raw_dlc):
    """Runs the scenario; returns the frames that it asks for. Leaves bus.log and bus.pcap."""
    sent = every_frame(raw_dlc)
    (directory / "every-frame.yaml").write_text(scenario(sent))
    subprocess.run([str(verican), "run", str(directory / "every-frame.yaml"), "--candump",
                    str(directory / "bus.log"), "--pcap", str(directory / "bus.pcap")],
                   check=True, stdout=subprocess.DEVNULL)
    return sent


FIELDS = ("frame.protocols", "can.id", "can.flags.xtd", "can.flags.rtr", "can.flags.err",
          "can.len", "data.data", "frame.time_relative")
# Identifier 0 would be dissected further, as a message of AUTOSAR's network management.
TSHARK = ("tshark", "--disable-protocol", "autosar-nm", "-r")


def tshark(verican, directory):
    """Wireshark's CAN dissector sees each frame as the scenario asked for it, at its time."""
    sent = record(verican, directory, raw_dlc=True)
    command = [*TSHARK, str(directory / "bus.pcap"), "-T", "fields", "-E", "separator=;"]
    for name in FIELDS:
        command += ["-e", name]
    rows = [dict(zip(FIELDS, line.split(";"))) for line in _run(*command).splitlines()]
    expect(len(rows), len(sent), "frames in tshark")
    for number, (row, (_, frame)) in enumerate(zip(rows, sent), 1):
        wanted = {"can.id": str(frame.ident), "can.flags.xtd": str(int(frame.extended)),
                  "can.flags.rtr": str(int(frame.remote)), "can.flags.err": "0",
                  "can.len": str(min(frame.dlc, 8)), "data.data": frame.data.hex()}
        expect({key: row[key] for key in wanted}, wanted, f"packet {number}")
        expect_true(row["frame.protocols"].split(":")[0] == "can", f"packet {number}: not CAN")
    check_times([float(row["frame.time_relative"]) * 1e6 for row in rows], sent)
    expect(_run(*TSHARK, str(directory / "bus.pcap"), "-q", "-z", "expert").strip(), "",
           "complaints of tshark")


def check_times(times, sent):
    """Starts of frames in us, the first at any time: those of the scenario, to one bit and what a
    core takes from its queue to the wire."""
    for number, (time, (offset, _)) in enumerate(zip(times, sent), 1):
        late = (time - times[0]) - (offset - sent[0][0])
        expect_true(abs(late) < 30, f"frame {number} is {late:.1f} us off its time")


def _run(*command):
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def asc(verican, directory):
    """The log becomes Vector's format with log2asc, and with asc2log a log again: equal frames."""
    sent = record(verican, directory, raw_dlc=False)
    entries = read(directory / "bus.log")
    same(frames(entries), [frame for _, frame in sent], "bus.log")
    # log2asc takes a log that begins in the first second of 1970 for one without times.
    dated = directory / "dated.log"
    dated.write_text("".join(f"({e.time // 10**6 + 1_700_000_000}.{e.time % 10**6:06d}) can0 "
                             + line.split()[2] + "\n" for e, line in
                             zip(entries, (directory / "bus.log").read_text().splitlines())))
    for name in ("bus", "dated"):
        _run("log2asc", "-I", str(directory / f"{name}.log"), "-O", str(directory / f"{name}.asc"),
             "can0")
        back = [parse(line) for line in
                _run("asc2log", "-I", str(directory / f"{name}.asc")).splitlines()]
        same(frames(back), [frame for _, frame in sent], f"{name}.log after log2asc and asc2log")
    expect([e.time - back[0].time for e in back], [e.time - entries[0].time for e in entries],
           "times after log2asc and asc2log")


def canplayer(run):
    """canplayer puts the log on a vcan; candump there sees the same frames in the same order."""
    sent = [frame for _, frame in run.sent]
    for name in ("timed", "flat"):
        same(frames(read(run.dir / f"{name}.log")), sent, f"{name}.log")
