# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""Transfers that cannot be, over the core: each ends in its time, and nothing is delivered."""
import j1939 as sae
from judge import expect, expect_true

# ISO 15765-2: N_Bs and N_Cr, 1,000 ms. SAE J1939-21: T2 (no data after CTS) and T3 (no answer),
# 1,250 ms; T1 (a gap in the data), 750 ms.
NBS = NCR = 1_000_000
T1, T2, T3 = 750_000, 1_250_000, 1_250_000
REASON_TIMEOUT = 3
SLACK = 3_000  # us: frames on their way, programs that end


def prepare_timeouts(directory, _):
    """A message that nobody takes."""
    (directory / "hundred.bin").write_bytes(bytes(range(100)))


def near(found, wanted, what):
    expect_true(wanted - 100 <= found <= wanted + SLACK,
                f"{what}: after {found / 1000:.1f} ms, expected {wanted / 1000:.0f} ms")


def isotp_times(run, log):
    """{name: (exit code, us from begin to end)} against what ISO 15765-2 says."""
    lines = [line.split() for line in run.text("times.txt").splitlines()]
    took = {name: (int(code), (int(end) - int(begin)) // 1000)
            for name, code, begin, end in lines}
    for name, time in (("nobody", NBS), ("silent", NCR + 1_000), ("cut", NCR + 10_000),
                       ("cutsender", NBS + 10_000)):
        near(took[name][1], time, f"{name}: end of the program")
    for name in ("nobody", "cutsender"):
        expect_true(took[name][0] != 0, f"{name}: isotpsend says that all was sent")
        expect_true("ommunication error" in run.text(f"{name}.err"), f"{name}: no complaint")
    # A missing frame is noticed with the next one, and not by time.
    expect_true(took["missing"][1] < 100_000, "missing: a wrong number was noticed late")
    for name in ("silent", "missing", "cut", "toolong"):
        expect(run.text(f"{name}.txt").strip(), "", f"{name}: bytes delivered")
    answers = [frame.data[0] for _, frame in log if frame.ident == 0x7B8]
    # Ready, ready, too much (overflow), then those of the transfer that was cut.
    expect(answers[:3], [0x30, 0x30, 0x32], "flow control")
    expect([frame for _, frame in log if frame.ident == 0x7A8], [], "answers of nobody")


def j1939_times(run, log):
    """Aborts with the reason time-out, in the time of each state."""
    expect((run.dir / "announced.out").read_bytes(), b"", "bytes delivered")
    found = {}
    for message in sae.messages(log):
        expect(message.aborted, REASON_TIMEOUT, f"message of {message.by:02X}: abort")
        found[message.by] = message.end - message.last
    expect(sorted(found), [0x90, 0xB0, 0xB1], "messages that were begun")
    near(found[0x90], T3, "no answer to RTS (T3)")
    near(found[0xB0], T2, "no data after CTS (T2)")
    near(found[0xB1], T1, "no more data (T1)")


def timeouts(run):
    log = run.log("timeouts-bus.log")
    isotp_times(run, log)
    j1939_times(run, log)
    run.same_as_bus("timeouts-can0.log", "timeouts-bus.log")
    run.notes["frames"] = len(log)
