// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_mb_guard: the write protection and the abort requests of MCR.AEN (flexcan.md 3.3, 3.4).
//
// Discarded are writes to the C/S word of a buffer that has moved out, and to any word of a buffer
// whose transmission has ended while its IFLAG is still set. Code 1001 in a discarded C/S word is
// an abort request to can_mb_load; in one that is written the abort is done at once and sets IFLAG.
//
// In the first clock of a write the C/S word of its buffer is read: CsEnded (bit 30) tells whether
// a transmission has ended since the CPU wrote it. That bit is late in the second clock, so
// everything else is evaluated in the first. A frame that has moved out by then is protected; one
// that moves out later cannot reach the bus before can_mb_load notices the write.

module can_mb_guard #(
  parameter int NumMb = 64,
  /// Derived, do not override.
  localparam int IdxW = $clog2(NumMb)
) (
  input  logic             clk_i,
  input  logic             rst_ni,
  input  logic             clear_i,      // pulse: soft reset
  input  logic             aen_i,        // MCR.AEN
  // CPU access, see can_mb_port.
  input  logic             first_i,      // 1 in the first clock of a write
  input  logic             wr_done_i,    // 1 in the second clock of a write, in which it ends
  input  logic [1:0]       mem_sel_i,    // can_mb_pkg::Mem*; MemCs and MemMsg are guarded
  input  logic [IdxW-1:0]  idx_i,        // buffer that is written
  input  logic             be3_i,        // 1: bits 31:24 are written
  input  logic [3:0]       code_i,       // code (bits 27:24) of the word that is written
  input  logic             area_i,       // 1: the word belongs to the Rx FIFO
  input  logic             ended_i,      // CsEnded of the buffer's C/S word, in the second clock
  // A mark that is written while the C/S word is read makes ended_i undefined, but a word that is
  // marked has CsEnded = 0.
  input  logic             mark_i,       // 1: buffer mark_idx_i is being marked as serviced
  input  logic [IdxW-1:0]  mark_idx_i,
  // Verdict, valid in the second clock; ended_i is late, so can_mb_port and can_mb_cpu combine it.
  output logic             block_o,      // 1: the write is discarded
  output logic             if_ended_o,   // 1: the write is discarded if ended_i = 1
  output logic             abort_o,      // pulse: abort the frame that has moved out
  // Frame that is presented or sent, see can_mb_load.
  input  logic             out_i,        // 1: buffer cur_idx_i has moved out
  input  logic             done_i,       // 1: the end of its frame is being written back
  input  logic [IdxW-1:0]  cur_idx_i,
  input  logic             take_i,       // 1: cur_idx_i changes in the next clock
  // IFLAG of an abort that was done at once.
  output logic             flag_o,       // 1: set IFLAG of buffer flag_idx_o
  output logic [IdxW-1:0]  flag_idx_o,
  input  logic             gnt_i,        // 1: IFLAG of buffer flag_idx_o is being set
  // IFLAG as it is, and as it will be in the next clock.
  input  logic             end_i,        // 1: IFLAG of buffer end_idx_i is set in the next clock
  input  logic [IdxW-1:0]  end_idx_i,
  input  logic [NumMb-1:0] iflag_i
);
  logic abort_q, cur_q, flag_q, cs_block_q, guarded, is_cs, cur, abort, at_once, ended,
    all_block;

  assign guarded   = aen_i && !area_i && !mem_sel_i[1];
  assign abort     = wr_done_i && abort_q;
  assign is_cs     = mem_sel_i == can_mb_pkg::MemCs;
  assign cur       = idx_i == cur_idx_i && !take_i;
  assign all_block = (cur_q && done_i) || flag_q;
  assign block_o   = cs_block_q || all_block;
  assign ended     = if_ended_o && ended_i;
  assign abort_o   = abort && cs_block_q && !all_block;
  assign at_once   = abort && !cs_block_q && !all_block && !ended;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {abort_q, flag_q, cs_block_q, if_ended_o, cur_q} <= '0;
    end else begin
      // A frame whose end is told in the first clock has nothing left to abort in the second.
      abort_q    <= guarded && is_cs && be3_i && code_i == can_regs_pkg::MbCsCodeTxAbort
                 && !(cur && done_i);
      cs_block_q <= guarded && is_cs && cur && out_i;
      cur_q      <= guarded && cur;
      flag_q     <= guarded && flag_o && idx_i == flag_idx_o;
      if_ended_o <= first_i && guarded && (iflag_i[idx_i] || (end_i && end_idx_i == idx_i))
                 && !(mark_i && mark_idx_i == idx_i);
    end
  end

  // An abort that was done at once sets IFLAG.
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
endmodule
