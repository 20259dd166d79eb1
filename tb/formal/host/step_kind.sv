  // SPDX-FileCopyrightText: 2026 The VeriCAN authors
  // SPDX-License-Identifier: Apache-2.0
  //
  // Property of can_mb_step beside can_mb_move (lock_move.sv), spliced into it.

  logic f_cs_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni)                   f_cs_q <= 1'b0;
    else if (slot_i && step_req) f_cs_q <= cs_o;
  end
  always @(posedge clk_i) if (rst_ni) begin
    // flexcan.md 3.5: a copy is written to the memory that its step has asked for.
    p_kind: assert (!copy_o || copy_cs_o == f_cs_q);
  end
