# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""ISO-TP over the core: what must be sent, and what a run must have left behind."""
import random
import re

import frames
import isotp as iso
from judge import expect, expect_true

# Those of guest/isotp.sh.
STREAMS = {
    "plain": iso.Stream(0x7A0, 0x7A8),
    "extended": iso.Stream(0x7B0, 0x7B8, address=0x5A, flow_address=0xA5),
    "wide": iso.Stream(0x18DAF110, 0x18DA10F1, extended=True),
    "slow": iso.Stream(0x18DB33F1, 0x18DBF133, extended=True, address=0x11, flow_address=0x22),
}
LOAD = 0x081
# Every length around the ends of frames and blocks, the longest, and some between.
EDGES = (1, 2, 5, 6, 7, 8, 9, 12, 13, 14, 20, 21, 62, 63, 69, 70, 4094, 4095)


def lengths(name, count):
    """The lengths of a stream's PDUs: the edges, then random ones."""
    chosen = random.Random(name)
    edges = [n for n in EDGES if n != 4094 or name == "plain"]
    if name == "slow":  # its receiver wants 1 ms between frames
        edges = edges[:-1]
    found = edges + [int(4095 ** chosen.random()) for _ in range(count)]
    chosen.shuffle(found)
    return found


def pdus(name, count):
    """The PDUs of a stream."""
    chosen = random.Random(f"{name} data")
    return [chosen.randbytes(n) for n in lengths(name, count)]


def prepare_isotp(directory, settings):
    """What guest/isotp.sh sends, one file a PDU."""
    for name in STREAMS:
        for number, pdu in enumerate(pdus(name, int(settings["VERICAN_PDUS"]))):
            (directory / f"{name}-{number:03}.pdu").write_text(pdu.hex(" ") + "\n")


def other_load(log, rate, span):
    """Part of the time between two times in us that the third node's frames held the bus."""
    begin, end = span
    bits = sum(frames.length_in_bits(frame) for time, frame in log
               if frame.ident == LOAD and not frame.extended and begin <= time < end)
    return bits * 1e6 / rate / (end - begin)


def isotp_streams(run, log):
    """What was received is what was sent, by isotprecv and as reassembled from the bus."""
    total, span = 0, []
    for name, stream in STREAMS.items():
        sent = pdus(name, int(run.settings["VERICAN_PDUS"]))
        received = [bytes.fromhex(line) for line in run.text(f"{name}.txt").splitlines()]
        expect(len(received), len(sent), f"{name}: PDUs")
        for number, pdu in enumerate(sent):
            expect_true(received[number] == pdu, f"{name}: PDU {number} of {len(pdu)} bytes is "
                                                 f"another one")
        done = iso.transfers(log, stream)
        expect([bytes(transfer.data) for transfer in done] == sent, True, f"{name}: on the bus")
        total += sum(map(len, sent))
        span += [done[0].start, done[-1].end]
    run.notes["bytes"] = total
    return min(span), max(span)


def perf(run, log):
    """isotpperf's figures are those of the bus; below a millisecond it has none."""
    found = re.findall(r": (\d+) byte in (?:(\d+)\.(\d{6})s => (\d+) byte/s)?",
                       run.text("perf.txt"))
    done = iso.transfers(log, STREAMS["plain"])
    expect([int(size) for size, *_ in found], [transfer.size for transfer in done],
           "isotpperf: PDUs")
    rates = []
    for (size, seconds, micros, rate), transfer in zip(found, done):
        if not rate:
            continue
        took = int(seconds) * 1_000_000 + int(micros)
        expect_true(abs(took - (transfer.end - transfer.start)) < 400,
                    f"isotpperf: {size} bytes in {took} us, {transfer.end - transfer.start} us on "
                    "the bus")
        rates.append((int(size), int(rate)))
    expect_true(len(rates) >= 8, "isotpperf has too few figures")
    run.notes["isotpperf"] = max(rates)


def isotp(run):
    log = run.log("isotp-bus.log")
    span = isotp_streams(run, log)
    load = other_load(log, 1_000_000, span)
    expect_true(load >= float(run.settings["VERICAN_LEAST"]),
                f"load of the third node only {load:.3f}")
    perf(run, log)
    for device in ("can0", "can1"):
        run.same_as_bus(f"isotp-{device}.log", "isotp-bus.log")
    run.counters_agree("isotp")
    expect_true(run.bus("isotp")["bus"]["errors"] > 20, "no errors on the bus")
    run.notes["frames"] = len(log)
    run.notes["load"] = load
