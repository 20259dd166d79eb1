# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""canfdtest over the core: every frame that is sent comes back, one more in each byte."""
from judge import expect, expect_true


def canfdtest(run):
    """Both programs' frames, from the bus; what the generator says; what both devices had."""
    for device in ("can0", "can1"):
        run.same_as_bus(f"canfdtest-{device}.log", "canfdtest-bus.log")
    log = [frame for _, frame in run.log("canfdtest-bus.log")]
    there = [frame.data for frame in log if frame.ident == 0x77]
    back = [frame.data for frame in log if frame.ident == 0x78]
    wanted = int(run.settings["VERICAN_FRAMES"])
    expect_true(len(there) >= wanted, f"{len(there)} frames sent, not {wanted}")
    expect(there, [bytes((n + k) % 256 for k in range(8)) for n in range(len(there))],
           "frames of the generator")
    expect(back, [bytes((byte + 1) % 256 for byte in data) for data in there], "frames back")
    expect(len(log), 2 * len(there), "frames on the bus")
    expect(run.text("generator.txt").split()[-1], str(wanted), "frames that the generator checked")
    run.counters_agree("canfdtest")
    run.notes["frames"] = len(log)
