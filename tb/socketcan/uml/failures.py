# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""Error messages of the bridge, each field against the rules of CAN and linux/can/error.h.

Wireshark's dissector decodes each of them too: what it calls a bit is what was meant.
"""
import subprocess

from canlog import errors as error_messages
from canlog import expect, expect_true, frames, parse, read, same

# linux/can/error.h: classes, with Wireshark's names where it has one.
LOSTARB, CRTL, PROT, ACK, BUSOFF, BUSERROR, RESTARTED, CNT = (
    0x002, 0x004, 0x008, 0x020, 0x040, 0x080, 0x100, 0x200)
CLASSES = {LOSTARB: "lostarb", CRTL: "ctrl", PROT: "prot", ACK: "ack", BUSOFF: "busoff",
           BUSERROR: "buserror", RESTARTED: "restarted"}
# data[1]
TX_WARNING, TX_PASSIVE = 0x08, 0x20
CONTROLLER = {TX_WARNING: "ctrl.tx_warning", TX_PASSIVE: "ctrl.tx_passive"}
# data[2]
FORM, STUFF, BIT1, TX = 0x02, 0x04, 0x10, 0x80
KINDS = {FORM: "prot.type.form", STUFF: "prot.type.stuff", BIT1: "prot.type.bit1",
         TX: "prot.type.tx"}
# data[3]
LOC_DATA, LOC_CRC_SEQ, LOC_CRC_DEL, LOC_ACK, LOC_EOF, LOC_ACK_DEL = (
    0x0A, 0x08, 0x18, 0x19, 0x1A, 0x1B)

# The sender's first data bit, recessive, is seen dominant: 32 times TEC + 8 is 256 (FC-05, FC-13).
BUSOFF_BUS = """\
name: bus-off
bitrate: 500k
nodes:
  - {name: vcan0}
  - {name: other}
faults:
""" + "".join(
    f"  - {{kind: flip, node: vcan0, at: {{node: vcan0, frame: {attempt}, field: DATA, bit: 0}}}}\n"
    for attempt in range(1, 33))
# The receiver vcan0 alone sees these; the third node acknowledges what vcan0 refuses.
RECEIVER_BUS = """\
name: errors of a receiver
bitrate: 500k
nodes:
  - {name: vcan0}
  - {name: other}
  - {name: third}
traffic:
  - {node: other, name: m, id: 0x123, data: 00 FF, count: 1}
faults:
  - {kind: dominant, node: vcan0, at: {node: other, frame: 1, field: CRC_DEL}}
  - {kind: dominant, node: vcan0, at: {node: other, frame: 2, field: EOF, bit: 2}}
  - {kind: dominant, node: vcan0, at: {node: other, frame: 3, field: ACK_DEL}}
  - {kind: flip, node: vcan0, at: {node: other, frame: 4, field: CRC, bit: 12}}
  - {kind: dominant, node: vcan0, at: {node: other, frame: 5, field: DATA, stuff: true}}
"""
# It loses to all of the winner's but the last, each time at another bit.
LOSER = ("04000002#R",)
WINNER = ("100#01", "100#R1", "04000000#02", "04000002#03", "0FF#04", "7FE#05")


def files():
    """Scenarios for guest/errors.sh."""
    return {"busoff.yaml": BUSOFF_BUS, "receiver.yaml": RECEIVER_BUS}


def settings():
    """Variables of guest/errors.sh."""
    return {"VERICAN_LOSER": " ".join(LOSER), "VERICAN_WINNER": " ".join(WINNER)}


def message(classes, controller=0, kind=0, place=0, tec=0, rec=0, lost_at=0):
    """(class bits, eight bytes) as linux/can/error.h lays them out."""
    return classes, bytes((lost_at, controller, kind, place, 0, 0, tec, rec))


DECODED = {}


def decode(path):
    """Wireshark's view of the error messages of a candump log: [(set of names, place, bit)]."""
    text = path.read_text()
    if text not in DECODED:
        DECODED[text] = decode_anew(path)
    return DECODED[text]


def decode_anew(path):
    """The same; starting Wireshark takes its time."""
    names = [*CLASSES.values(), *CONTROLLER.values(), *KINDS.values(), "tx_timeout", "trx",
             "ctrl.rx_overflow", "ctrl.tx_overflow", "ctrl.rx_warning", "ctrl.rx_passive",
             "ctrl.active", "prot.type.bit", "prot.type.bit0", "prot.type.overload",
             "prot.type.active"]
    command = ["tshark", "-r", str(path), "-Y", "can.flags.err == 1", "-T", "fields",
               "-E", "separator=;"]
    for name in (*names, "prot.location", "lostarb.bitnum"):
        command += ["-e", f"can.err.{name}"]
    output = subprocess.run(command, check=True, capture_output=True, text=True).stdout
    result = []
    for row in (line.split(";") for line in output.splitlines()):
        flags = {name for name, value in zip(names, row) if value == "1"}
        result.append((flags, int(row[-2] or "0"), int(row[-1] or "0")))
    return result


def in_words(classes, data):
    """What Wireshark must say of a message."""
    names = {name for bit, name in CLASSES.items() if classes & bit}
    names |= {name for bit, name in CONTROLLER.items() if data[1] & bit}
    names |= {name for bit, name in KINDS.items() if data[2] & bit}
    return names, data[3], data[0]


def check(run, name, wanted, endless=False):
    """The error messages of a log; endless: the last of `wanted` comes again and again."""
    found = error_messages(read(run.dir / name))
    if endless:
        expect_true(len(found) > len(wanted), f"{name}: {len(found)} messages only")
        wanted = wanted + [wanted[-1]] * (len(found) - len(wanted))
    for number, (got, want) in enumerate(zip(found, wanted), 1):
        expect((f"{got[0]:03X}", got[1].hex(" ")), (f"{want[0]:03X}", want[1].hex(" ")),
               f"{name}: message {number}")
    expect(len(found), len(wanted), f"{name}: messages")
    if wanted:
        expect(decode(run.dir / name), [in_words(*entry) for entry in wanted],
               f"{name}: what Wireshark reads")


def nobody_acknowledges(run):
    """FC-05, FC-18: TEC counts to 128 in 16 attempts and stays; warning at 96, passive at 128."""
    common = PROT | BUSERROR | ACK | CNT
    wanted = []
    for attempt in range(1, 18):
        change = {12: TX_WARNING, 16: TX_PASSIVE}.get(attempt, 0)
        wanted.append(message(common | (CRTL if change else 0), change, TX, LOC_ACK,
                              min(128, 8 * attempt)))
    check(run, "noack.log", wanted, endless=True)
    same(frames(read(run.dir / "noack-bus.log")), [], "acknowledged frames")
    check(run, "state.log", [message(CRTL | CNT, TX_WARNING, tec=96),
                             message(CRTL | CNT, TX_PASSIVE, tec=128)])
    check(run, "none.log", [])


def to_bus_off():
    """The messages of BUSOFF_BUS up to bus-off."""
    wanted = []
    for attempt in range(1, 32):
        change = {12: TX_WARNING, 16: TX_PASSIVE}.get(attempt, 0)
        wanted.append(message(PROT | BUSERROR | CNT | (CRTL if change else 0), change, BIT1 | TX,
                              LOC_DATA, 8 * attempt))
    return wanted + [message(PROT | BUSERROR | BUSOFF, 0, BIT1 | TX, LOC_DATA)]


def check_restart(run, name):
    """Bus-off, and a restart that somebody has asked for."""
    check(run, name, to_bus_off() + [message(RESTARTED | CNT)])


def bus_off(run):
    """FC-13, BO-05: off at 256; 128 times 11 recessive bits later the frame leaves after all."""
    check(run, "busoff.log", to_bus_off() + [message(RESTARTED | CNT)])
    sent = [parse(f"(0.000000) x {text}").frame for text in ("123#80", "124#80")]
    same(frames(read(run.dir / "busoff.log")), sent, "frames of the program")
    same(frames(read(run.dir / "busoff-bus.log")), sent, "frames on the bus")
    # It was off for the 20 ms at least, and recovery takes its time.
    first = read(run.dir / "busoff-bus.log")[0]
    expect_true(first.time >= 20_000 + 32 * 2 * 30, f"back on the bus at {first.time} us already")


def receiver(run):
    """FC-02, FC-03, FC-10: each error REC + 1, and + 8 for the dominant bit after the own flag, as
    the others' flags come later; - 1 at each ACK slot that is reached without an error."""
    common = PROT | BUSERROR | CNT
    check(run, "receiver.log", [
        message(common, 0, FORM, LOC_CRC_DEL, 0, 1),
        message(common, 0, FORM, LOC_EOF, 0, 1 + 8 - 1 + 1),
        message(common, 0, FORM, LOC_ACK_DEL, 0, 9 + 8 - 1 + 1),
        message(common, 0, 0, LOC_CRC_SEQ, 0, 17 + 8 + 1),
        message(common, 0, STUFF, LOC_DATA, 0, 26 + 8 + 1)])
    sent = [parse("(0.000000) x 123#00FF").frame]
    same(frames(read(run.dir / "receiver.log")), sent, "frames received")
    same(frames(read(run.dir / "receiver-bus.log")), sent, "frames on the bus")


def lost_arbitration(run):
    """AR-12: the bit at which it was lost, SOF being 0, stuff bits left out."""
    lost_at = (12,  # SRR recessive, against RTR of a base data frame
               13,  # IDE recessive, against that of a base remote frame
               30,  # the 17th bit of the extension: ...10 against ...00
               32,  # RTR, against the same identifier with data
               3)   # 001 0000 0000 against 000 1111 1111
    check(run, "lost0.log", [message(LOSTARB | CNT, lost_at=bit) for bit in lost_at])
    check(run, "lost1.log", [message(LOSTARB | CNT, lost_at=1)])  # 111... against 001...
    order = [parse(f"(0.000000) x {text}").frame for text in (*WINNER[:5], *LOSER, WINNER[5])]
    loser, winner = ([parse(f"(0.000000) x {text}").frame for text in side]
                     for side in (LOSER, WINNER))
    same(frames(read(run.dir / "lost0.log")), loser + winner, "frames at vcan0")
    same(frames(read(run.dir / "lost1.log")), winner + loser, "frames at vcan1")
    same(frames(read(run.dir / "lost-bus.log")), order, "order on the bus")
    same(frames(read(run.dir / "lost-mon.log")), order, "order at the monitor")
    expect([entry.frame.is_error for entry in read(run.dir / "lost0.log")],
           [False, True] + [False, True] * 4 + [False] * 2,
           "each loss is told before the frame that has won")


def errors(run):
    """All that guest/errors.sh left."""
    nobody_acknowledges(run)
    bus_off(run)
    receiver(run)
    lost_arbitration(run)
    for name in ("noack", "busoff", "receiver", "lost", "state", "none"):
        run.ended(name)
