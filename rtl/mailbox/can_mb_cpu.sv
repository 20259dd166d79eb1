// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_mb_cpu: gives CPU accesses their meaning, beside can_mb_port: finds the row that is the
// output of the Rx FIFO, hides the bits of a C/S word that software does not see, and reports reads
// of C/S words and TIMER (can_mb_lock) and writes of C/S words (cs_written_o).
//
// Rx FIFO (flexcan.md section 4): the rows of buffers 0 to 5 are its memory, those from 6 on and
// below first_i its filter table. A read of buffer 0 returns the row of the oldest frame. Bits
// 31:23 of its C/S word are the number of the filter element, which only RXFIR shows.

module can_mb_cpu #(
  parameter int NumMb = 64,
  /// Features, see can_top.
  parameter int Fifo = 1,
  parameter int TimeUnit = 0,
  /// Derived, do not override.
  localparam int IdxW = $clog2(NumMb)
) (
  input  logic            clk_i,
  input  logic            rst_ni,
  input  logic            scrub_i,       // 1: the RAMs are being cleared and cannot be accessed
  input  logic            running_i,     // 1: the engine takes part in the bus
  input  logic            fen_i,         // MCR.FEN
  input  logic            aen_i,         // MCR.AEN
  input  logic            osmb_i,        // XCTRL.OSMB: bit 28 of C/S is stored with code 1100
  input  logic [6:0]      first_i,       // first buffer that is a mailbox, after the Rx FIFO
  input  logic [2:0]      head_i,        // row of the Rx FIFO's output
  // CPU access, see can_mb_port.
  input  logic            rd_done_i,     // 1 in the second clock of a read
  input  logic            wr_done_i,     // 1 in the second clock of a write
  input  logic            block_i,       // 1: the write is discarded (can_mb_guard)
  input  logic            if_ended_i,    // 1: the write is discarded if ended_i = 1
  input  logic            ended_i,       // CsEnded of the buffer's C/S word
  input  logic [1:0]      mem_sel_i,     // memory that is accessed, can_mb_pkg::Mem*
  input  logic            rxfir_i,       // MemCs: 1 RXFIR, 0 C/S word; MemTimer: 1 TIMER, 0 stamp
  input  logic [IdxW-1:0] idx_i,         // buffer that is accessed
  input  logic            be3_i,         // 1: bits 31:24 are accessed
  input  logic [31:0]     wdata_i,
  input  logic            rd_word_i,     // 1: the read returns word_i
  input  logic [31:0]     word_i,        // C/S or MSG word on the RAM outputs
  input  logic [31:0]     other_i,       // mask or stamp, if the read returns one; else 0
  input  logic [3:0]      ram_code_i,    // code of the C/S word on the RAM outputs
  input  logic            end_i,         // 1: word_i is a sent frame's, its code is end_code_i
  input  logic [3:0]      end_code_i,    // code that a sent frame leaves
  input  logic [15:0]     timer_i,       // TIMER
  input  logic            moving_i,      // 1: a move into buffer mv_idx_i is under way
  input  logic [IdxW-1:0] mv_idx_i,
  output logic [IdxW-1:0] row_idx_o,     // row of buffer idx_i
  // Valid from the first clock of an access on.
  output logic            area_o,        // 1: the word belongs to the Rx FIFO
  output logic            ring_o,        // 1: the word belongs to the six rows of its memory
  output logic [31:0]     wdata_o,       // data as it is to be stored
  output logic [31:0]     rdata_o,       // read data; 0 if no read ends in this clock
  output logic            timer_rd_o,    // pulse: TIMER is read
  output logic            timer_wr_o,    // pulse: TIMER is written
  output logic            cs_rd_o,       // pulse: the C/S word of mailbox idx_i is read
  output logic [3:0]      cs_rd_code_o,  // code of the C/S word that is read, without BUSY
  output logic            busy_o,        // 1: mailbox idx_i shows BUSY
  // cs_written_o: pulse in the clock after the CPU has written the C/S word of mailbox
  // cs_written_idx_o; the RAM holds the new word.
  output logic            cs_written_o,
  output logic [IdxW-1:0] cs_written_idx_o,
  output logic            cs_written_act_o    // 1: the code written may be active
);
  // Does the word belong to the Rx FIFO (area), or to its memory (ring)? The six rows of the memory
  // are part of the area for every RFFN. Decoded in the first clock of an access, used in the
  // second.
  logic of_mb, in_area, ring_idx, in_ring, whole, area_q, ring_q, whole_q;
  assign of_mb     = !mem_sel_i[1];                          // a word of a buffer, or RXFIR
  assign in_area   = fen_i && of_mb && 7'(idx_i) < first_i;
  assign ring_idx  = idx_i[IdxW-1:3] == '0 && idx_i[2:1] != 2'b11;
  assign in_ring   = fen_i && of_mb && ring_idx;
  // whole: all bits of the word are stored. So they are in the filter table and, while the engine
  // is stopped, where the table may be: NXP's driver writes it before it sets FEN. Not with
  // MCR.AEN, which gives bit 30 a meaning.
  assign whole     = !ring_idx && (fen_i ? in_area : Fifo != 0 && !running_i && !aen_i);
  assign row_idx_o = fen_i && idx_i == '0 && (of_mb || (TimeUnit != 0 && !rxfir_i
                     && mem_sel_i == can_mb_pkg::MemTimer)) ? IdxW'(head_i) : idx_i;
  assign area_o    = in_area;
  assign ring_o    = in_ring;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) {area_q, ring_q, whole_q} <= '0;
    else         {area_q, ring_q, whole_q} <= {in_area, in_ring, whole};
  end

  // Data.
  logic       is_cs, mb_wr, cs_wr, raw;
  logic [3:0] code;
  assign is_cs      = mem_sel_i == can_mb_pkg::MemCs;
  assign code       = wdata_i[can_regs_pkg::MbCsCode +: can_regs_pkg::MbCsCodeW];
  assign raw        = area_q && !ring_q;                   // of the filter table
  assign timer_rd_o = rd_done_i && mem_sel_i == can_mb_pkg::MemTimer && (rxfir_i || TimeUnit == 0);
  assign timer_wr_o = wr_done_i && mem_sel_i == can_mb_pkg::MemTimer && (rxfir_i || TimeUnit == 0);
  // RXFIR is not a C/S word, with or without FEN: reading it neither locks nor unlocks.
  assign cs_rd_o    = rd_done_i && is_cs && !rxfir_i && !area_q && !scrub_i;
  assign cs_rd_code_o = end_i ? end_code_i : ram_code_i;
  assign mb_wr      = wr_done_i && !area_q && !scrub_i;
  assign cs_wr      = mb_wr && is_cs && !block_i && !(if_ended_i && ended_i);
  assign busy_o     = moving_i && mv_idx_i == idx_i && !area_q;

  // A C/S word as it is stored: CsEnded marks the end of a transmission, and an abort written with
  // MCR.AEN is one (can_mb_guard). One-shot counts with code 1100 only: an answer is never
  // one-shot.
  always_comb begin
    wdata_o = wdata_i;
    if (is_cs && !whole_q) begin
      {wdata_o[31:28], wdata_o[23]} = '0;
      wdata_o[can_mb_pkg::CsEnded] = aen_i && code == can_regs_pkg::MbCsCodeTxAbort;
      wdata_o[can_regs_pkg::MbCsOs] = osmb_i && wdata_i[can_regs_pkg::MbCsOs]
                                      && code == can_regs_pkg::MbCsCodeTxData;
    end
  end

  // Read data. word_i comes from the RAM and is late, so it passes two gates only: seen masks it,
  // and beside, made of everything else, is ORed to it.
  logic        rxfir, cs_word;
  logic [31:0] seen, beside;
  assign rxfir   = is_cs && rxfir_i;
  assign cs_word = is_cs && !raw && !rxfir_i;
  always_comb begin
    seen          = {32{rd_word_i && !rxfir}};
    seen[31:23]   = seen[31:23] & ~{{4{cs_word}}, {4{cs_word && (end_i || ring_q)}}, cs_word};
    beside        = other_i | {16'b0, timer_i & {16{timer_rd_o}}};
    beside[27:24] = beside[27:24] | (((end_code_i & {4{end_i}}) | 4'(busy_o))
                                     & {4{cs_word && rd_done_i && !ring_q}});
    beside[8:0]   = beside[8:0]
                    | (word_i[31:can_mb_pkg::CsElement] & {9{rd_word_i && rxfir && ring_q}});
    rdata_o       = beside | (word_i & seen);
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {cs_written_o, cs_written_act_o} <= '0;
      cs_written_idx_o <= '0;
    end else begin
      cs_written_o <= cs_wr;
      if (cs_wr) begin
        cs_written_idx_o <= idx_i;
        cs_written_act_o <= !be3_i || code == can_regs_pkg::MbCsCodeTxData
                            || code == can_regs_pkg::MbCsCodeTxAnswering;
      end
    end
  end
endmodule
