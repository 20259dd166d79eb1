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
  parameter int TimeUnit = 0,
  /// Derived, do not override.
  localparam int IdxW = $clog2(NumMb)
) (
  input  logic            clk_i,
  input  logic            rst_ni,
  input  logic            scrub_i,
  input  logic            fen_i,
  input  logic            aen_i,
  input  logic            osmb_i,        // bit 28 of a C/S word is kept with code 1100
  input  logic [6:0]      first_i,       // first buffer that is a mailbox
  input  logic [2:0]      head_i,        // row of the output, after a pop in this clock
  // Command, as of can_mailbox.
  input  logic            cmd_wr_i,
  input  logic            cmd_mb_i,      // a word of a buffer, or RXFIR
  input  logic            cmd_stamp_i,   // a word of a buffer's stamp
  input  logic [IdxW-1:0] cmd_idx_i,
  output logic            cmd_wr_o,      // without those that are ignored
  output logic            cmd_look_o,    // it is a mailbox: AEN may keep it from being written
  output logic [IdxW-1:0] cmd_idx_o,     // row
  // Data phase, see can_mb_port.
  input  logic            ready_i,
  input  logic            rd_done_i,
  input  logic            wr_done_i,
  input  logic            block_i,       // it does not take place
  input  logic [1:0]      mem_sel_i,
  input  logic            rxfir_i,       // mem_sel 0: RXFIR, not C/S; 3: TIMER, not a stamp
  input  logic [IdxW-1:0] idx_i,
  input  logic [3:0]      be_i,
  input  logic [31:0]     wdata_i,
  input  logic [31:0]     ram_rdata_i,
  input  logic [15:0]     timer_i,
  input  logic            moving_i,      // buffer mv_idx_i is BUSY
  input  logic [IdxW-1:0] mv_idx_i,
  output logic            raw_o,         // it belongs to the filter table
  output logic [31:0]     wdata_o,       // as it is kept
  output logic [31:0]     rdata_o,       // 0 if nothing is read
  output logic            timer_rd_o,
  output logic            timer_wr_o,
  output logic            cs_rd_o,       // C/S word of a mailbox is read
  output logic            busy_o,        // ... and is BUSY
  // C/S word of a mailbox was written in the clock before: the RAM holds the new word.
  output logic            cs_written_o,
  output logic [IdxW-1:0] cs_written_idx_o,
  output logic            cs_written_act_o,     // its code may be active
  output logic            cs_written_empty_o,   // its code is EMPTY, IDE is cs_written_ide_o
  output logic            cs_written_ide_o
);
  // Command: in the FIFO's area? Its memory, six rows, always is.
  logic in_area, in_ring, area_q, ring_q;
  assign in_area   = fen_i && cmd_mb_i && 7'(cmd_idx_i) < first_i;
  assign in_ring   = fen_i && cmd_mb_i && cmd_idx_i[IdxW-1:3] == '0 && cmd_idx_i[2:1] != 2'b11;
  assign cmd_wr_o  = cmd_wr_i && !in_ring;
  assign cmd_look_o = cmd_mb_i && !in_area;
  assign cmd_idx_o = fen_i && (cmd_mb_i || cmd_stamp_i) && cmd_idx_i == '0 ? IdxW'(head_i)
                                                                           : cmd_idx_i;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni)      {area_q, ring_q} <= '0;
    else if (ready_i) {area_q, ring_q} <= {in_area, in_ring};
  end

  // Data.
  logic       is_cs, mb_wr, cs_wr;
  logic [3:0] code;
  assign is_cs      = mem_sel_i == can_mb_pkg::MemCs;
  assign code       = wdata_i[can_regs_pkg::MbCsCode +: can_regs_pkg::MbCsCodeW];
  assign raw_o      = area_q && !ring_q;
  assign timer_rd_o = rd_done_i && mem_sel_i == can_mb_pkg::MemTimer && (rxfir_i || TimeUnit == 0);
  assign timer_wr_o = wr_done_i && mem_sel_i == can_mb_pkg::MemTimer && (rxfir_i || TimeUnit == 0);
  // RXFIR is no C/S word, with or without the FIFO: its read neither locks nor unlocks.
  assign cs_rd_o    = rd_done_i && is_cs && !rxfir_i && !area_q;
  assign mb_wr      = wr_done_i && !area_q && !scrub_i;
  assign cs_wr      = mb_wr && is_cs && !block_i;
  assign busy_o     = moving_i && mv_idx_i == idx_i && !area_q;

  // Of a C/S word all bits are kept in the filter table alone. Bit 30 of a mailbox marks the end of
  // a transmission: an abort is one (can_mb_guard). An answer is never one-shot.
  always_comb begin
    wdata_o = wdata_i;
    if (is_cs && !raw_o) begin
      {wdata_o[31:28], wdata_o[23]} = '0;
      wdata_o[can_mb_pkg::CsEnded] = aen_i && code == can_regs_pkg::MbCsCodeTxAbort;
      wdata_o[can_regs_pkg::MbCsOs] = osmb_i && wdata_i[can_regs_pkg::MbCsOs]
                                      && code == can_regs_pkg::MbCsCodeTxData;
    end
  end

  always_comb begin
    rdata_o = ram_rdata_i;
    if (timer_rd_o) rdata_o = {16'b0, timer_i};
    if (is_cs && rxfir_i) begin
      rdata_o = ring_q ? {23'b0, ram_rdata_i[31:can_mb_pkg::CsElement]} : '0;
    end else if (is_cs && !raw_o) begin
      {rdata_o[31:28], rdata_o[23]} = '0;
      rdata_o[24] = ram_rdata_i[24] || (busy_o && rd_done_i);
      if (ring_q) rdata_o[27:24] = '0;
    end
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
