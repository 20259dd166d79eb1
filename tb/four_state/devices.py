# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""The tops whose pins are recorded and replayed with four states."""
import dataclasses
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]

# Profile full, the bit timing and the serial number of the recorded remote node
# (record_remote.cpp): a rate table of one row, 1 Mbit/s at 12 MHz.
REMOTE = {"NumProd": 8, "NumMap": 8, "TxDepth": 4, "Protect": 1, "Block": 1, "AutoRate": 1,
          "Counters": 1, "RateRows": 1, "RateTable": "285'd1235", "Serial": "32'hCAFE1234",
          "ClocksPerMs": 12000, "Trace": 1}
# Of the recorded clock (record_follower.cpp): 4 MHz, 8 clocks a bit, a pair every 2.5 ms.
FOLLOWER = {"TimeInc": "40'hFA00000000", "SyncCtrl": "32'h18530130", "SyncId": "32'h00040000",
            "SyncDelay": "32'd375", "HalfPeriod": 500000, "Brp": 1, "Prop": 2, "Ps1": 3, "Ps2": 2,
            "Sjw": 1}


@dataclasses.dataclass(frozen=True)
class Device:
    """A top with its recorder and its bench."""
    top: str
    bench: str               # the file with module replay
    recorder: str            # the program that records
    sizes: tuple             # what the recorder and the figures call the variants
    # Registers that show what a RAM returns, and may be X as long as the RAM is being cleared:
    # nobody asks for it then. Those without a reset (the RAMs' read data) are found in the netlist.
    behind_ram: tuple
    fixed: dict = dataclasses.field(default_factory=dict)  # parameters, if there is but one size
    # RAM outputs that also show what nobody asks for: rows that software cannot write, and of the
    # hidden C/S row of a received frame the byte that becomes its code. What follows is looked at.
    unasked: tuple = ()

    def parameters(self, size):
        """Of the top, for the bench and for Yosys."""
        return self.fixed or {"NumMb": size}

    def shown(self, size):
        """What a line of the output calls it."""
        return f"NumMb={size or self.fixed['NumMb']}" if self.top == "can_ahb" else self.top


def profile(name):
    """The parameters of a profile of the core (sw/profiles.yaml)."""
    text = subprocess.run([sys.executable, ROOT / "tools/profiles.py", name], check=True,
                          capture_output=True, text=True).stdout
    return dict(word.split("=") for word in text.split())


DEVICES = {
    "ahb": Device("can_ahb", "replay.sv", "four_state_record", (16, 64),
                  ("u_top.u_mailbox.u_match.gen_fifo.u_filter.s2_equal_q",)),
    "small": Device("can_ahb", "replay.sv", "four_state_record_small", (0,), (), profile("small"),
                    ("u_top.u_mailbox.u_match.gen_global_masks.u_mask.msg_i",
                     "u_top.u_mailbox.u_match.u_rx.cs_i")),
    "time": Device("can_ahb", "replay.sv", "four_state_record_time", (0,),
                   ("u_top.u_mailbox.u_match.gen_fifo.u_filter.s2_equal_q",),
                   {"NumMb": 16, "TimeUnit": 1, "TimeInc": "40'h7D00000000"}),
    "remote": Device("can_remote", "replay_remote.sv", "four_state_record_remote", (0,), (),
                     REMOTE),
    "follower": Device("can_time_node", "replay_follower.sv", "four_state_record_follower", (0,),
                       (), FOLLOWER)}

# How many clocks each recording has at least, in any of its devices: a little below what it has, so
# that one that ends early, or holds nothing, is no success.
LEAST_CLOCKS = {
    "registers": 6500, "frames": 7000, "fifo": 7500, "arbitration": 3500, "errors": 15000,
    "bus_off": 12000, "modes": 12000, "time_registers": 1700, "time_stamps": 7000,
    "pairs": 250000, "vectors": 70000, "commands": 200000, "producers": 100000}
