# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""The tops whose pins are recorded and replayed with four states."""
import dataclasses

# Profile full, the bit timing and the serial number of the recorded remote node
# (record_remote.cpp): a rate table of one row, 1 Mbit/s at 12 MHz.
REMOTE = {"NumProd": 8, "NumMap": 8, "TxDepth": 4, "Protect": 1, "Block": 1, "AutoRate": 1,
          "Counters": 1, "RateRows": 1, "RateTable": "285'd1235", "Serial": "32'hCAFE1234",
          "ClocksPerMs": 12000, "Trace": 1}


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

    def parameters(self, size):
        """Of the top, for the bench and for Yosys."""
        return {"NumMb": size} if self.top == "can_ahb" else REMOTE

    def shown(self, size):
        """What a line of the output calls it."""
        return f"NumMb={size}" if self.top == "can_ahb" else self.top


DEVICES = {
    "ahb": Device("can_ahb", "replay.sv", "four_state_record", (16, 64),
                  ("u_top.u_mailbox.u_match.gen_fifo.u_filter.s2_equal_q",)),
    "remote": Device("can_remote", "replay_remote.sv", "four_state_record_remote", (0,), ())}
