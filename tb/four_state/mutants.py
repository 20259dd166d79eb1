#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""mutants.py BUILD: run.py sees each of these faults in a copy of the RTL."""
import os
import shutil
import subprocess
import sys
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(os.path.dirname(HERE))

# Device, file, text, what takes its place, recording, what the report says of it.
MUTANTS = {
    "a register without reset": (
        "ahb", "bit/can_timestamp.sv",
        "always_ff @(posedge clk_i or negedge rst_ni) begin\n    if (!rst_ni) begin\n"
        "      timer_o <= '0;\n    end else if (clear_i)",
        "always_ff @(posedge clk_i) begin\n    if (clear_i)", "registers", "timer"),
    "RAM that is not cleared": (
        "ahb", "mailbox/can_mb_port.sv", "scrub_o     <= 1'b1;", "scrub_o     <= 1'b0;",
        "registers", "hrdata is xxxxxxxx"),
    "no stuff bits sent": (
        "ahb", "frame/can_tx_frame.sv", "      if (stuff_i) level = !prev_i;\n", "", "arbitration",
        "can_tx_o is"),
    "a register of the time unit without reset": (
        "time", "time/can_time_cmp.sv", "      target_q <= '0;\n", "", "time_registers",
        "reached_q"),
    "a register of the follower without reset": (
        "follower", "time/can_time_pair.sv", "      sc_o <= '0;\n", "", "pairs", "sc_o"),
    "a register of the remote node without reset": (
        "remote", "remote/can_rn_step.sv", "      ten_q <= 4'd1;\n", "", "vectors", "ten_q"),
    "RAM of the remote node that is not cleared": (
        "remote", "remote/can_rn_step.sv", "job_q   <= can_rn_pkg::JobClear;",
        "job_q   <= can_rn_pkg::JobStart;", "commands", "X clock"),
}

OPTIONS = {"ahb": ["--num-mb", "16"], "remote": ["--device", "remote"],
           "time": ["--device", "time"], "follower": ["--device", "follower"]}


def mutated(work, file, old, new):
    copy = f"{work}/rtl"
    shutil.rmtree(copy, ignore_errors=True)
    shutil.copytree(f"{ROOT}/rtl", copy)
    with open(f"{copy}/{file}", encoding="utf-8") as source:
        text = source.read()
    if text.count(old) != 1:
        sys.exit(f"mutants.py: {old!r} must be once in rtl/{file}, is {text.count(old)} times")
    with open(f"{copy}/{file}", "w", encoding="utf-8") as out:
        out.write(text.replace(old, new))
    return copy


def main():
    bad = 0
    for name, (device, file, old, new, recording, sign) in MUTANTS.items():
        with tempfile.TemporaryDirectory() as work:
            done = subprocess.run(
                [f"{HERE}/run.py", recording, *OPTIONS[device], "--most", "500",
                 "--build", sys.argv[1], "--rtl", mutated(work, file, old, new),
                 "--work", f"{work}/run"],
                capture_output=True, text=True, check=False)
        seen = done.returncode == 1 and sign in done.stdout
        print(f"{name}: {'seen' if seen else 'NOT SEEN'}\n{done.stdout}{done.stderr}")
        bad += not seen
    return 1 if bad else 0


sys.exit(main())
