// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_mb_match: finds where the frame being received belongs (flexcan.md 3.5, 3.7 and section 4).
// When the header is complete, a pass over the filter table of the Rx FIFO (can_mb_filter) and then
// one over the mailboxes (can_mb_rx) begin; can_rx_fifo decides between the two. can_mb_move takes
// the result over when the frame is valid.
//
// Time: one clock for each of 8 * (RFFN + 1) words and NumMb - 8 - 2 * RFFN mailboxes, at most 154
// (64 buffers, RFFN = 15), or 308 beside a CPU that never pauses and takes every second slot. The
// result is due when the header of the next frame is complete, at least 47 bits later: 376 clocks
// at 8 clocks a bit. While another frame waits for a locked buffer it is due at the start of the
// next frame, after 264 clocks: missed only for RFFN > 9 with shortest frames back to back and a
// CPU that accesses the buffers in every clock.

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
  input  logic            clear_i,      // pulse: soft reset or change of FEN
  // Configuration, constant while the engine runs.
  input  logic            bcc_i,        // MCR.BCC
  input  logic            eacen_i,      // CTRL2.EACEN
  input  logic            rrs_i,        // CTRL2.RRS
  input  logic [6:0]      maxmb_i,      // MCR.MAXMB
  input  logic            fen_i,        // MCR.FEN
  input  logic [1:0]      idam_i,       // MCR.IDAM
  input  logic [3:0]      rffn_i,       // CTRL2.RFFN
  input  logic            mrp_i,        // CTRL2.MRP
  input  logic [6:0]      first_i,      // first buffer that is a mailbox
  // Frame being received, see can_core.
  input  logic            rx_hdr_i,     // pulse: header complete, rx_id_i to rx_rtr_i are valid
  input  logic [28:0]     rx_id_i,
  input  logic            rx_ide_i,
  input  logic            rx_rtr_i,
  // Buffers that are not free, and C/S writes by the CPU (can_mb_cpu).
  input  logic            lock_i,       // 1: buffer lock_idx_i is locked
  input  logic [IdxW-1:0] lock_idx_i,
  input  logic            waits_i,      // 1: a frame received earlier waits for buffer waits_idx_i
  input  logic [IdxW-1:0] waits_idx_i,
  input  logic            cs_written_i, // pulse: the CPU wrote a C/S word in the clock before
  input  logic [IdxW-1:0] cs_written_idx_i,
  // CPU access, see can_mb_port.
  input  logic            wr_i,         // 1 in the first clock of a write to row wr_idx_i
  input  logic [IdxW-1:0] wr_idx_i,
  // Read slots (can_mb_step).
  output logic            req_o,        // 1: a read slot is wanted
  output logic [IdxW-1:0] idx_o,        // row that is wanted: a buffer, or a global mask
  output logic [1:0]      word_o,       // word of the MSG memory, if cs_o = 0
  output logic            cs_o,         // 1: data_i is to be the word of the C/S memory
  output logic [IdxW:0]   mask_row_o,
  input  logic            gnt_i,        // 1: slot granted; data in the next clock
  input  logic            stale_i,      // 1: C/S or ID was written while it was read
  input  logic [31:0]     cs_i,
  input  logic [31:0]     msg_i,
  input  logic [31:0]     mask_i,
  input  logic [31:0]     data_i,       // the wanted word: cs_i or msg_i, as cs_o asked
  // Result.
  output logic            done_o,       // 1: the result is final
  output logic            hit_o,        // 1: the frame belongs to buffer or row hit_idx_o
  output logic [IdxW-1:0] hit_idx_o,
  output logic            hit_fifo_o,   // 1: the frame belongs into the Rx FIFO, row hit_idx_o
  output logic            hit_ans_o,    // 1: not stored: buffer hit_idx_o answers the frame
  input  logic            resolve_i,    // pulse: the frame is valid, the result is taken over
  input  logic            stored_i,     // pulse: the frame is in the Rx FIFO
  input  logic [1:0]      fifo_in_flight_i,  // per hidden row: frame on its way into the FIFO
  output logic [8:0]      idhit_o,      // filter element of the frame on its way into the FIFO
  // CPU's side of the Rx FIFO, see can_rx_fifo.
  input  logic            pop_i,        // pulse: the CPU is done with the frame at the output
  output logic [2:0]      head_o,       // row of the output
  output logic            avail_o,      // 1: a frame is at the output
  output logic            warn_o,       // pulse: the fill rises from 4 to 5
  output logic            ovf_o         // pulse: a frame was lost
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
    .cs_written_i, .cs_written_idx_i,
    .req_o(mb_req), .idx_o(mb_idx), .gnt_i(gnt && !flt_busy), .stale_i,
    .cs_i, .id_i(msg_i), .mask_i(mb_mask),
    .id_o(id), .ide_o(ide), .rtr_o(rtr), .ans_o(mb_ans),
    .done_o(mb_done), .hit_o(mb_hit), .hit_free_o(mb_free), .hit_idx_o(mb_hit_idx));

  // The Rx FIFO with its filter table.
  logic [2:0] tail;
  if (Fifo != 0) begin : gen_fifo
    can_mb_filter #(.NumMb(NumMb)) u_filter (
      .clk_i, .rst_ni, .clear_i, .bcc_i, .idam_i, .rffn_i, .first_i,
      .start_i(rx_hdr_i && fen_i), .id_i(id), .ide_i(ide), .rtr_i(rtr), .wr_i, .wr_idx_i,
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
                      data_i, wr_i, wr_idx_i};
  end

  // Mask of a mailbox: its RXIMR if BCC = 1, otherwise RXGMASK, RX14MASK or RX15MASK. The search
  // for an answer to a remote frame is exact: its mask is all ones.
  always_comb begin
    gmask = can_mb_pkg::RowRxgmask;
    if (mb_idx == IdxW'(14)) gmask = can_mb_pkg::RowRx14mask;
    if (mb_idx == IdxW'(15)) gmask = can_mb_pkg::RowRx15mask;
  end
  assign want = flt_busy ? can_mb_pkg::RowRxfgmask : gmask;
  assign req  = flt_req || mb_req;

  if (OwnMasks != 0) begin : gen_own_masks
    // The all-ones mask is row RowOnes, which holds ones since the RAM was cleared. Without
    // ClearRam no row is known to, so the ones are ORed in.
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
