// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_mb_guard: what MCR.AEN forbids the CPU, and its abort requests (flexcan.md 3.3, 3.4).
//
// Not written: the C/S word of a buffer that has moved out; any word of a buffer whose transmission
// has ended and whose IFLAG is still set. Code 1001 in a blocked C/S word is a request to
// can_mb_load; in one that is written it is done at once, and IFLAG tells.
//
// While there is an ended buffer with its IFLAG set, or about to be, writes wait for a clock, in
// which theirs is looked up: the RAM would be too late behind that.

module can_mb_guard #(
  parameter int NumMb = 64,
  /// Derived, do not override.
  localparam int IdxW = $clog2(NumMb)
) (
  input  logic             clk_i,
  input  logic             rst_ni,
  input  logic             clear_i,      // soft reset
  input  logic             aen_i,
  // CPU, data phase.
  input  logic             wr_i,         // a write ends in this clock or the next one
  input  logic             mb_wr_i,      // ... in this clock, to a mailbox
  input  logic             waited_i,     // ... and was there in the clock before
  input  logic [1:0]       kind_i,       // as of can_mb_port; others than 0 and 1 pass
  input  logic [IdxW-1:0]  idx_i,
  input  logic             be3_i,        // it has bits 31:24
  input  logic [3:0]       code_i,       // bits 27:24 of the word written
  input  logic             area_i,       // it belongs to the Rx FIFO
  output logic             block_o,      // it is not written
  output logic             abort_o,      // request for the frame that has moved out
  output logic             stall_o,      // it has to wait for a clock
  // Frame that is sent, see can_mb_load.
  input  logic             out_i,
  input  logic             kept_i,
  input  logic             done_i,
  input  logic [IdxW-1:0]  cur_idx_i,
  // IFLAG of this module's own aborts; gnt_i: it is being set.
  output logic             flag_o,
  output logic [IdxW-1:0]  flag_idx_o,
  input  logic             gnt_i,
  // IFLAG, and transmissions that end: it is set in the next clock.
  input  logic             end_i,
  input  logic [IdxW-1:0]  end_idx_i,
  input  logic             again_i,      // the CPU clears it while a reception sets it, or an end
  input  logic [NumMb-1:0] iflag_i
);
  localparam logic [1:0] KindCs  = 2'd0;
  localparam logic [1:0] KindMsg = 2'd1;

  logic [NumMb-1:0] ended_q;
  logic             any_q, hit_q, active, abort, at_once, cur, cs_block, all_block;

  assign active    = !be3_i || code_i == 4'b1100 || code_i == 4'b1110;
  assign abort     = wr_i && !area_i && kind_i == KindCs && be3_i && code_i == 4'b1001 && aen_i;
  assign cur       = idx_i == cur_idx_i;
  assign cs_block  = cur && (out_i || (kept_i && active));
  assign all_block = (waited_i && hit_q) || (cur && done_i) || (flag_o && idx_i == flag_idx_o);
  assign block_o   = aen_i && !area_i && ((kind_i == KindCs && (cs_block || all_block))
                               || (kind_i == KindMsg && all_block));
  assign abort_o   = abort && cs_block && !all_block;
  assign at_once   = abort && mb_wr_i && !cs_block && !all_block;
  assign stall_o   = any_q;

  // An abort done at once.
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      flag_o     <= 1'b0;
      flag_idx_o <= '0;
    end else begin
      if (gnt_i) flag_o <= 1'b0;
      if (at_once) begin
        flag_o     <= 1'b1;
        flag_idx_o <= idx_i;
      end
      if (clear_i) flag_o <= 1'b0;
    end
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {any_q, hit_q} <= '0;
      ended_q <= '0;
    end else begin
      any_q <= aen_i && (ended_q != '0 || end_i || at_once || flag_o);
      hit_q <= (ended_q[idx_i] && iflag_i[idx_i]) || (end_i && end_idx_i == idx_i);
      for (int n = 0; n < NumMb; n++) begin
        if ((end_i || again_i) && end_idx_i == IdxW'(n)) ended_q[n] <= end_i;
        else                                             ended_q[n] <= ended_q[n] && iflag_i[n];
      end
    end
  end
endmodule
