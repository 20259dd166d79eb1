  // SPDX-FileCopyrightText: 2026 The VeriCAN authors
  // SPDX-License-Identifier: Apache-2.0
  //
  // Properties of can_mb_lock beside can_mb_move (lock_move.sv), spliced into it.

  logic f_mark;                          // a read since the last mark
  logic f_be3;                           // be3_i of the clock before
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) {f_mark, f_be3} <= '0;
    else         {f_mark, f_be3} <= {cs_rd_i || timer_rd_i || (f_mark && !serviced_gnt_i), be3_i};
  end

  always @(posedge clk_i) if (rst_ni) begin
    // FX-3.6.g: each mark follows a read of its own.
    p_asked: assert (!serviced_req_o || f_mark);
    // flexcan.md 3.6: no mark after a write of its buffer's code, and none is lost to another
    // write: what was compared in the last clock of the write is right.
    p_overwritten: assert (overwritten == (cs_written_i && f_be3
                                           && cs_written_idx_i == serviced_idx_o));
  end
