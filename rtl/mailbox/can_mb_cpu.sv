// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_mb_cpu: what an access of the CPU means: where the output of the Rx FIFO is found, which bits
// of a C/S word can be seen, and that a C/S word was written.
//
// Rx FIFO (flexcan.md section 4): the rows of buffers 0 to 5 are its memory and those up to
// first_i - 1 its filter table. What is read as buffer 0 is the row of the oldest frame; its C/S
// word has the filter's number in 31:23, which only RXFIR shows.

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
  input  logic            scrub_i,
  input  logic            running_i,
  input  logic            fen_i,
  input  logic            aen_i,
  input  logic            osmb_i,        // bit 28 of a C/S word is kept with code 1100
  input  logic [6:0]      first_i,       // first buffer that is a mailbox
  input  logic [2:0]      head_i,        // row of the output
  // Data phase, see can_mb_port.
  input  logic            rd_done_i,
  input  logic            wr_done_i,
  input  logic            block_i,       // it does not take place,
  input  logic            if_ended_i,    // ... if bit 30 of its buffer's C/S word is set
  input  logic            ended_i,
  input  logic [1:0]      mem_sel_i,
  input  logic            rxfir_i,       // mem_sel 0: RXFIR, not C/S; 3: TIMER, not a stamp
  input  logic [IdxW-1:0] idx_i,
  input  logic [3:0]      be_i,
  input  logic [31:0]     wdata_i,
  input  logic            rd_word_i,     // word_i is read,
  input  logic [31:0]     word_i,
  input  logic [31:0]     other_i,       // ... this one, or none
  input  logic [3:0]      ram_code_i,    // code of the C/S word on the RAM outputs
  input  logic            end_i,         // ... that is end_code_i: a frame has just been sent
  input  logic [3:0]      end_code_i,
  input  logic [15:0]     timer_i,
  input  logic            moving_i,      // buffer mv_idx_i is BUSY
  input  logic [IdxW-1:0] mv_idx_i,
  output logic [IdxW-1:0] row_idx_o,     // its row
  // In the first clock: it belongs to the FIFO, to its memory.
  output logic            area_o,
  output logic            ring_o,
  output logic [31:0]     wdata_o,       // as it is kept
  output logic [31:0]     rdata_o,       // 0 if nothing is read
  output logic            timer_rd_o,
  output logic            timer_wr_o,
  output logic            cs_rd_o,       // C/S word of a mailbox is read,
  output logic [3:0]      cs_rd_code_o,  // with this code
  output logic            busy_o,        // ... and is BUSY
  // C/S word of a mailbox was written in the clock before: the RAM holds the new word.
  output logic            cs_written_o,
  output logic [IdxW-1:0] cs_written_idx_o,
  output logic            cs_written_act_o,     // its code may be active
  output logic            cs_written_empty_o,   // its code is EMPTY, IDE is cs_written_ide_o
  output logic            cs_written_ide_o
);
  // In the FIFO's area? Its memory, six rows, always is. The first clock finds it, the second needs
  // it.
  logic of_mb, in_area, ring_idx, in_ring, whole, area_q, ring_q, whole_q;
  assign of_mb     = !mem_sel_i[1];                          // a word of a buffer, or RXFIR
  assign in_area   = fen_i && of_mb && 7'(idx_i) < first_i;
  assign ring_idx  = idx_i[IdxW-1:3] == '0 && idx_i[2:1] != 2'b11;
  assign in_ring   = fen_i && of_mb && ring_idx;
  // Of a C/S word all bits are kept in the filter table, and where it may become one: NXP's driver
  // writes the table before FEN. MCR.AEN gives bit 30 a meaning, so not with that.
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
  // RXFIR is no C/S word, with or without the FIFO: its read neither locks nor unlocks.
  assign cs_rd_o    = rd_done_i && is_cs && !rxfir_i && !area_q && !scrub_i;
  assign cs_rd_code_o = end_i ? end_code_i : ram_code_i;
  assign mb_wr      = wr_done_i && !area_q && !scrub_i;
  assign cs_wr      = mb_wr && is_cs && !block_i && !(if_ended_i && ended_i);
  assign busy_o     = moving_i && mv_idx_i == idx_i && !area_q;

  // Bit 30 of a mailbox marks the end of a transmission: an abort is one (can_mb_guard). An answer
  // is never one-shot.
  always_comb begin
    wdata_o = wdata_i;
    if (is_cs && !whole_q) begin
      {wdata_o[31:28], wdata_o[23]} = '0;
      wdata_o[can_mb_pkg::CsEnded] = aen_i && code == can_regs_pkg::MbCsCodeTxAbort;
      wdata_o[can_regs_pkg::MbCsOs] = osmb_i && wdata_i[can_regs_pkg::MbCsOs]
                                      && code == can_regs_pkg::MbCsCodeTxData;
    end
  end

  // Bits of the RAM that are seen, which are late, and others beside them.
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
      {cs_written_o, cs_written_act_o, cs_written_empty_o, cs_written_ide_o} <= '0;
      cs_written_idx_o <= '0;
    end else begin
      cs_written_o <= cs_wr;
      if (cs_wr) begin
        cs_written_idx_o   <= idx_i;
        cs_written_act_o   <= !be_i[3] || code == can_regs_pkg::MbCsCodeTxData
                              || code == can_regs_pkg::MbCsCodeTxAnswering;
        cs_written_empty_o <= be_i == '1 && code == can_regs_pkg::MbCsCodeRxEmpty;
        cs_written_ide_o   <= wdata_i[can_regs_pkg::MbCsIde];
      end
    end
  end
endmodule
