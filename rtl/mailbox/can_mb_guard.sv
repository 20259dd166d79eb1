// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_mb_guard: what MCR.AEN forbids the CPU, and its abort requests (flexcan.md 3.3, 3.4).
//
// Not written: the C/S word of a buffer that has moved out; any word of a buffer whose transmission
// has ended and whose IFLAG is still set. Code 1001 in a blocked C/S word is a request to
// can_mb_load; in one that is written it is done at once, and IFLAG tells.
//
// In the first clock of a write the C/S word of its buffer is read: bit 30 says that a transmission
// has ended since the CPU wrote it. Everything else is evaluated meanwhile, because that bit is
// late in the second clock. A frame that has moved out by the first clock is kept from the CPU; one
// that moves out later cannot reach the bus before the write is noticed.

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
  input  logic             first_i,      // the first clock of a write
  input  logic             wr_done_i,    // ... its second, in which it ends
  input  logic [1:0]       mem_sel_i,    // as of can_mb_port; others than 0 and 1 pass
  input  logic [IdxW-1:0]  idx_i,
  input  logic             be3_i,        // it has bits 31:24
  input  logic [3:0]       code_i,       // bits 27:24 of the word written
  input  logic             area_i,       // it belongs to the Rx FIFO
  input  logic             ended_i,      // bit 30 of the C/S word
  // The word is being marked as serviced while it is read: bit 30 is 0.
  input  logic             mark_i,
  input  logic [IdxW-1:0]  mark_idx_i,
  // It is not written, whatever that bit says, or if it is set: which is known late.
  output logic             block_o,
  output logic             if_ended_o,
  output logic             abort_o,      // request for the frame that has moved out
  // Frame that is sent, see can_mb_load.
  input  logic             out_i,
  input  logic             kept_i,
  input  logic             done_i,
  input  logic [IdxW-1:0]  cur_idx_i,
  input  logic             take_i,       // cur_idx_i will be another one in the next clock
  // IFLAG of this module's own aborts; gnt_i: it is being set.
  output logic             flag_o,
  output logic [IdxW-1:0]  flag_idx_o,
  input  logic             gnt_i,
  // IFLAG, and transmissions that end: it is set in the next clock.
  input  logic             end_i,
  input  logic [IdxW-1:0]  end_idx_i,
  input  logic [NumMb-1:0] iflag_i
);
  logic abort_q, cur_q, flag_q, cs_block_q, guarded, is_cs, active, cur, abort, at_once, ended,
    all_block;

  assign guarded   = aen_i && !area_i && !mem_sel_i[1];
  assign abort     = wr_done_i && abort_q;
  assign is_cs     = mem_sel_i == can_mb_pkg::MemCs;
  assign active    = !be3_i || code_i == can_regs_pkg::MbCsCodeTxData
                  || code_i == can_regs_pkg::MbCsCodeTxAnswering;
  assign cur       = idx_i == cur_idx_i && !take_i;
  assign all_block = (cur_q && done_i) || flag_q;
  assign block_o   = cs_block_q || all_block;
  assign ended     = if_ended_o && ended_i;
  assign abort_o   = abort && cs_block_q && !all_block && !ended;
  assign at_once   = abort && !cs_block_q && !all_block && !ended;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {abort_q, flag_q, cs_block_q, if_ended_o, cur_q} <= '0;
    end else begin
      abort_q    <= guarded && is_cs && be3_i && code_i == can_regs_pkg::MbCsCodeTxAbort;
      cs_block_q <= guarded && is_cs && cur && (out_i || (kept_i && active));
      cur_q      <= guarded && cur;
      flag_q     <= guarded && flag_o && idx_i == flag_idx_o;
      if_ended_o <= first_i && guarded && (iflag_i[idx_i] || (end_i && end_idx_i == idx_i))
                 && !(mark_i && mark_idx_i == idx_i);
    end
  end

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
endmodule
