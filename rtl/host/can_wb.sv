// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_wb: the controller (can_top) as a Wishbone B4 slave with words of 32 bits, little-endian.
//
// Pipelined = 0: standard cycles of two clocks, three for what lies in the buffers' RAM and for
// TIMER. Pipelined = 1: a strobe is taken in each clock without STALL and answered in order, one
// clock later, or two. A cycle that ends before its answer never gets the answer.
//
// ERR: beyond the window of 8 KiB.

module can_wb #(
  /// NumMb to SyncDelay: as in can_ahb (docs/integration.md).
  parameter int NumMb = 64,
  parameter int Fifo = 1,
  parameter int Abort = 1,
  parameter int Status = 1,
  parameter int OwnMasks = 1,
  parameter int Wake = 1,
  parameter int Extras = 1,
  parameter int ClearRam = 1,
  parameter int TimeUnit = 0,
  parameter logic [39:0] TimeInc = 40'h14_0000_0000,
  parameter int TimeSync = 0,
  parameter logic [31:0] SyncCtrl = 32'd0,
  parameter logic [31:0] SyncId = 32'd0,
  parameter logic [31:0] SyncDelay = 32'd0,
  /// Size of the region that the core is selected for, as a number of address bits, 13 to 32.
  /// Address bits above are ignored; those from 13 up to the region's size must be zero.
  parameter int RegionBits = 16,
  /// 0: standard cycles; 1: pipelined.
  parameter int Pipelined = 0,
  /// Clocks for which the bus must be dominant to wake the core if MCR.WAK_SRC = 1, 1 to 255.
  parameter int WakeFilter = 6
) (
  input  logic        wb_clk_i,
  input  logic        wb_rst_i,      // asynchronous, active high
  input  logic        wb_cyc_i,
  input  logic        wb_stb_i,
  input  logic        wb_we_i,
  input  logic [31:2] wb_adr_i,
  input  logic [3:0]  wb_sel_i,
  input  logic [31:0] wb_dat_i,
  output logic [31:0] wb_dat_o,
  output logic        wb_ack_o,
  output logic        wb_err_o,
  output logic        wb_stall_o,
  output logic        irq_o,         // interrupt, level, active high: OR of the six below
  output logic        irq_mb_o,      // interrupt: message buffers, any IFLAG with its IMASK
  output logic        irq_boff_o,    // interrupt: bus-off
  output logic        irq_err_o,     // interrupt: error
  output logic        irq_twrn_o,    // interrupt: transmit warning, TEC has reached 96
  output logic        irq_rwrn_o,    // interrupt: receive warning, REC has reached 96
  output logic        irq_wak_o,     // interrupt: wake-up, the bus has ended stop mode
  input  logic        ext_i,         // external event of the time unit, asynchronous
  output logic        time_out_o,    // compare output of the time unit, e.g. a pulse per second
  output logic        irq_time_o,    // interrupt of the time unit, level; not part of irq_o
  input  logic        stop_req_i,    // 1: the system requests stop mode; synchronous to wb_clk_i
  input  logic        can_rx_i,      // RXD of the transceiver, asynchronous; 1: recessive
  output logic        can_tx_o,      // TXD of the transceiver, from a flip-flop; 1: recessive
  output logic [can_pkg::TraceWidth-1:0] trace_o  // for observers (can_pkg); leave open otherwise
);
  if (RegionBits < 13 || RegionBits > 32) begin : gen_check_region_bits
    RegionBits_must_be_13_to_32 u_stop ();   // no such module: the tool prints the name and stops
  end

  if (Pipelined < 0 || Pipelined > 1) begin : gen_check_pipelined
    Pipelined_must_be_0_or_1 u_stop ();
  end
  logic unused, supv;
  assign unused = &{1'b0, supv};

  // taken: a strobe is taken; due_q: its answer is due, from the next clock on while the cycle
  // lasts.
  logic        rst_n, taken, beyond, cancel, due_q, error_q, ready, answer;
  logic        held;                 // 1: the master still waits for the answer
  logic [31:0] wdata, rdata;
  assign rst_n  = !wb_rst_i;
  assign beyond = ({wb_adr_i, 2'b00} & 32'((33'd1 << RegionBits) - 33'd1)) >> 13 != '0;
  // A write without a byte lane is not passed to can_top. What is not passed to it reads 0.
  assign cancel = beyond || (wb_we_i && wb_sel_i == '0);
  always_ff @(posedge wb_clk_i or negedge rst_n) begin
    if (!rst_n) {due_q, error_q} <= '0;
    else begin
      due_q <= taken || (due_q && !ready && held);
      if (taken) error_q <= beyond;
    end
  end
  assign wb_ack_o = answer && !error_q;
  assign wb_err_o = answer && error_q;
  assign wb_dat_o = rdata;

  if (Pipelined != 0) begin : gen_pipelined
    logic [31:0] wdata_q;            // the master shows write data with the strobe only
    assign held       = wb_cyc_i;
    assign taken      = wb_cyc_i && wb_stb_i && ready;
    assign wb_stall_o = !ready;
    assign wdata      = wdata_q;
    always_ff @(posedge wb_clk_i or negedge rst_n) begin
      if (!rst_n)     wdata_q <= '0;
      else if (taken) wdata_q <= wb_dat_i;
    end
  end else begin : gen_classic
    assign held       = wb_cyc_i && wb_stb_i;
    assign taken      = held && !due_q;
    assign wb_stall_o = wb_cyc_i && !answer;
    assign wdata      = wb_dat_i;
  end
  assign answer = due_q && ready && held;

  can_top #(
    .NumMb(NumMb), .Fifo(Fifo), .Abort(Abort), .Status(Status), .OwnMasks(OwnMasks), .Wake(Wake),
    .Extras(Extras), .ClearRam(ClearRam), .TimeUnit(TimeUnit), .TimeInc(TimeInc),
    .TimeSync(TimeSync), .SyncCtrl(SyncCtrl), .SyncId(SyncId), .SyncDelay(SyncDelay),
    .WakeFilter(WakeFilter)
  ) u_top (
    .clk_i(wb_clk_i), .rst_ni(rst_n),
    .req_i(taken), .cancel_i(cancel), .we_i(wb_we_i), .addr_i(wb_adr_i[12:2]),
    .be_i(wb_sel_i), .wdata_i(wdata),
    .rdata_o(rdata), .ready_o(ready),
    .irq_o, .irq_mb_o, .irq_boff_o, .irq_err_o, .irq_twrn_o, .irq_rwrn_o, .irq_wak_o,
    .ext_i, .time_out_o, .irq_time_o, .stop_req_i, .supv_o(supv),
    .can_rx_i, .can_tx_o, .trace_o);
endmodule
