  // SPDX-FileCopyrightText: 2026 The VeriCAN authors
  // SPDX-License-Identifier: Apache-2.0
  //
  // Property of can_mb_lock beside can_mb_move (lock_move.sv), spliced into it.

  always @(posedge clk_i) if (rst_ni) begin
    // flexcan.md 3.6: no mark after a C/S write to its buffer, and none is lost to another write:
    // what was compared in the last clock of the write is right.
    p_overwritten: assert (overwritten == (cs_written_i && cs_written_idx_i == serviced_idx_o));
  end
