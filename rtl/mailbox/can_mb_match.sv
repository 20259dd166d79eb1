// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_mb_match: where the frame being received belongs: a pass over the filter table of the Rx FIFO
// and then one over the mailboxes (flexcan.md 3.5, 3.7 and section 4).
//
// Clocks: 8 * (RFFN + 1) words and NumMb - 8 - 2 * RFFN mailboxes at one a clock, 154 in the
// longest case (64 buffers, RFFN=15). A CPU that never pauses takes every second slot: 308. The
// result is due when the header of the next frame is complete, after 47 bits at the least: 376
// clocks at 8 clocks a bit. While another frame waits for a locked buffer it is due at the start of
// the next frame, after 264 clocks: too late only for RFFN > 9 with the shortest frames in a row
// and a CPU that uses the buffers in every clock.

module can_mb_match #(
  parameter int NumMb = 64,
  /// Features, see can_top.
  parameter int Fifo = 1,
  parameter int OwnMasks = 1,
  parameter int ClearRam = 1,
  /// Derived, do not override.
  localparam int IdxW = $clog2(NumMb)
) (
  input  logic            clk_i,
  input  logic            rst_ni,
  input  logic            clear_i,      // soft reset, or FEN changes
  // Configuration, constant while the engine runs.
  input  logic            bcc_i,
  input  logic            eacen_i,
  input  logic            rrs_i,
  input  logic [6:0]      maxmb_i,
  input  logic            fen_i,
  input  logic [1:0]      idam_i,
  input  logic [3:0]      rffn_i,
  input  logic            mrp_i,
  input  logic [6:0]      first_i,
  // Frame.
  input  logic            rx_hdr_i,
  input  logic [28:0]     rx_id_i,
  input  logic            rx_ide_i,
  input  logic            rx_rtr_i,
  // Locks, and C/S writes by the CPU in the clock before.
  input  logic            lock_i,
  input  logic [IdxW-1:0] lock_idx_i,
  input  logic            waits_i,      // buffer waits_idx_i gets the frame before this one
  input  logic [IdxW-1:0] waits_idx_i,
  input  logic            cs_written_i,
  input  logic [IdxW-1:0] cs_written_idx_i,
  input  logic            cs_written_empty_i,
  input  logic            cs_written_ide_i,
  // Read slots.
  output logic            req_o,
  output logic [IdxW-1:0] idx_o,
  output logic [1:0]      word_o,       // of the MSG memory,
  output logic            cs_o,         // ... or that of the C/S memory: it is on data_i
  output logic [IdxW:0]   mask_row_o,
  input  logic            gnt_i,
  input  logic            stale_i,
  input  logic [31:0]     cs_i,
  input  logic [31:0]     msg_i,
  input  logic [31:0]     mask_i,
  input  logic [31:0]     data_i,
  // Result.
  output logic            done_o,
  output logic            hit_o,        // it belongs somewhere
  output logic [IdxW-1:0] hit_idx_o,
  output logic            hit_fifo_o,   // into the FIFO
  output logic            hit_ans_o,    // nowhere: the buffer answers it
  input  logic            resolve_i,    // the result is taken over
  input  logic            stored_i,     // the frame is in the FIFO
  input  logic [1:0]      fifo_in_flight_i,        // frames on their way there
  output logic [8:0]      idhit_o,      // filter element of the frame on its way there
  // CPU's side of the FIFO.
  input  logic            pop_i,
  output logic [2:0]      head_o,
  output logic            avail_o,
  output logic            warn_o,
  output logic            ovf_o
);
  logic [28:0]     id;
  logic            ide, rtr, flt_req, flt_busy, flt_hit, enough;
  logic [IdxW-1:0] flt_idx;
  logic [1:0]      flt_word;
  logic [IdxW:0]   flt_mask_row;
  logic [8:0]      idhit;
  logic            mb_req, mb_done, mb_hit, mb_free, mb_ans, req, load, gnt;
  logic [1:0]      gmask, want;
  logic [31:0]     mask, mb_mask;
  logic [IdxW-1:0] mb_idx, mb_hit_idx;
  can_mb_rx #(.NumMb(NumMb)) u_rx (
    .clk_i, .rst_ni, .clear_i, .bcc_i, .eacen_i, .rrs_i, .maxmb_i, .first_i,
    .wait_i(flt_busy || enough), .rx_hdr_i, .rx_id_i, .rx_ide_i, .rx_rtr_i,
    .lock_i, .lock_idx_i, .waits_i, .waits_idx_i,
    .cs_written_i, .cs_written_idx_i, .cs_written_empty_i, .cs_written_ide_i,
    .req_o(mb_req), .idx_o(mb_idx), .gnt_i(gnt && !flt_busy), .stale_i,
    .cs_i, .id_i(msg_i), .mask_i(mb_mask),
    .id_o(id), .ide_o(ide), .rtr_o(rtr), .ans_o(mb_ans),
    .done_o(mb_done), .hit_o(mb_hit), .hit_free_o(mb_free), .hit_idx_o(mb_hit_idx));

  // The Rx FIFO with its filter table.
  logic [2:0] tail;
  if (Fifo != 0) begin : gen_fifo
    can_mb_filter #(.NumMb(NumMb)) u_filter (
      .clk_i, .rst_ni, .clear_i, .bcc_i, .idam_i, .rffn_i, .first_i,
      .start_i(rx_hdr_i && fen_i), .id_i(id), .ide_i(ide), .rtr_i(rtr),
      .req_o(flt_req), .idx_o(flt_idx), .word_o(flt_word), .mask_row_o(flt_mask_row),
      .gnt_i(gnt && flt_busy), .data_i, .mask_i(mask),
      .busy_o(flt_busy), .hit_o(flt_hit), .idhit_o(idhit));
    can_rx_fifo u_fifo (
      .clk_i, .rst_ni, .clear_i, .bcc_i, .mrp_i, .pop_i, .head_o, .avail_o, .warn_o, .ovf_o,
      .rx_hdr_i, .filter_i(flt_hit), .idhit_i(idhit), .mb_hit_i(mb_hit), .mb_free_i(mb_free),
      .enough_o(enough), .take_o(hit_fifo_o), .resolve_i, .stored_i, .fifo_in_flight_i,
      .tail_o(tail),
      .idhit_o);
  end else begin : gen_no_fifo
    assign {flt_req, flt_idx, flt_word, flt_mask_row, flt_busy, flt_hit, idhit} = '0;
    assign {head_o, avail_o, warn_o, ovf_o, enough, hit_fifo_o, tail, idhit_o} = '0;
    logic unused;
    assign unused = &{1'b0, fen_i, idam_i, rffn_i, mrp_i, id, ide, rtr, mb_free, resolve_i,
                      stored_i, fifo_in_flight_i, pop_i, flt_mask_row, flt_hit, idhit, mask,
                      data_i};
  end

  // Masks of mailboxes: their own, or RXGMASK, RX14MASK, RX15MASK; all ones where a remote frame
  // looks for its answer.
  always_comb begin
    gmask = can_mb_pkg::RowRxgmask;
    if (mb_idx == IdxW'(14)) gmask = can_mb_pkg::RowRx14mask;
    if (mb_idx == IdxW'(15)) gmask = can_mb_pkg::RowRx15mask;
  end
  assign want = flt_busy ? can_mb_pkg::RowRxfgmask : gmask;
  assign req  = flt_req || mb_req;

  if (OwnMasks != 0) begin : gen_own_masks
    // A row of ones that nobody writes, if the RAM has been cleared.
    logic [IdxW:0] mb_row;
    assign mb_row     = mb_ans && ClearRam != 0 ? (IdxW+1)'(NumMb + can_mb_pkg::RowOnes)
                      : bcc_i ? {1'b0, mb_idx} : (IdxW+1)'(NumMb) | (IdxW+1)'(gmask);
    assign mask       = mask_i;
    assign mb_mask    = ClearRam != 0 ? mask_i : mask_i | {32{mb_ans}};
    assign mask_row_o = flt_busy ? flt_mask_row : mb_row;
    assign req_o      = req;
    assign load       = 1'b0;
    assign gnt        = gnt_i;
  end else begin : gen_global_masks
    can_mb_mask u_mask (
      .clk_i, .rst_ni, .clear_i(rx_hdr_i), .req_i(req), .want_i(want),
      .all_i(mb_ans && !flt_busy), .req_o, .load_o(load), .gnt_i, .gnt_o(gnt), .msg_i,
      .mask_o(mask));
    assign mb_mask    = mask;
    assign mask_row_o = '0;
    logic unused_masks;
    assign unused_masks = &{1'b0, mask_i, flt_mask_row};
  end

  assign idx_o  = load ? IdxW'({want, can_mb_pkg::GroupMask}) : flt_busy ? flt_idx : mb_idx;
  assign cs_o   = flt_busy && flt_word == 2'd0;
  assign word_o = load ? can_mb_pkg::GroupMask : flt_busy ? flt_word - 2'd1 : 2'd0;

  assign done_o    = !flt_busy && (enough || mb_done);
  assign hit_o     = hit_fifo_o || mb_hit;
  assign hit_idx_o = hit_fifo_o ? IdxW'(tail) : mb_hit_idx;
  assign hit_ans_o = mb_ans && !hit_fifo_o;
endmodule
