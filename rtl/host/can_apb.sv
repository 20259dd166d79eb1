// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_apb: the controller (can_top) as an APB4 slave. The setup phase is the command of can_top,
// the access phase its data: two clocks a transfer, three for what lies in the buffers' RAM and for
// TIMER. An APB3 master ties PSTRB to 1111 and PPROT to 001.
//
// PSLVERR: beyond the window of 8 KiB.

module can_apb #(
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
  /// 1: while MCR.SUPV = 1, unprivileged accesses (pprot[0] = 0) read 0 and write nothing; 0: SUPV
  /// is only stored.
  parameter int CheckProt = 0,
  /// Clocks for which the bus must be dominant to wake the core if MCR.WAK_SRC = 1, 1 to 255.
  parameter int WakeFilter = 6
) (
  input  logic        pclk,
  input  logic        presetn,
  input  logic        psel,
  input  logic        penable,
  input  logic [31:0] paddr,         // 1:0 are ignored: accesses are whole words
  input  logic [2:0]  pprot,
  input  logic        pwrite,
  input  logic [3:0]  pstrb,
  input  logic [31:0] pwdata,
  output logic        pready,
  output logic [31:0] prdata,
  output logic        pslverr,
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
  input  logic        stop_req_i,    // 1: the system requests stop mode; synchronous to pclk
  input  logic        can_rx_i,      // RXD of the transceiver, asynchronous; 1: recessive
  output logic        can_tx_o,      // TXD of the transceiver, from a flip-flop; 1: recessive
  output logic [can_pkg::TraceWidth-1:0] trace_o  // for observers (can_pkg); leave open otherwise
);
  if (RegionBits < 13 || RegionBits > 32) begin : gen_check_region_bits
    RegionBits_must_be_13_to_32 u_stop ();   // no such module: the tool prints the name and stops
  end
  if (CheckProt < 0 || CheckProt > 1) begin : gen_check_prot
    CheckProt_must_be_0_or_1 u_stop ();
  end

  logic unused, supv;
  assign unused = &{1'b0, paddr[1:0], pprot, supv};

  // Setup phase. A read is of all byte lanes; a write without a strobe is not passed to can_top.
  logic       setup, beyond, denied, cancel, ready;
  logic [3:0] be;
  assign setup  = psel && !penable;
  assign beyond = (paddr & 32'((33'd1 << RegionBits) - 33'd1)) >> 13 != '0;
  assign denied = CheckProt != 0 && supv && !pprot[0];
  assign be     = pwrite ? pstrb : 4'b1111;
  assign cancel = beyond || denied || be == '0;

  // Access phase. An access that was not passed to can_top reads 0.
  logic        error_q;
  logic [31:0] rdata;
  always_ff @(posedge pclk or negedge presetn) begin
    if (!presetn)   error_q <= 1'b0;
    else if (setup) error_q <= beyond;
  end
  assign pready  = ready;
  assign pslverr = psel && penable && ready && error_q;
  assign prdata  = rdata;

  can_top #(
    .NumMb(NumMb), .Fifo(Fifo), .Abort(Abort), .Status(Status), .OwnMasks(OwnMasks), .Wake(Wake),
    .Extras(Extras), .ClearRam(ClearRam), .TimeUnit(TimeUnit), .TimeInc(TimeInc),
    .TimeSync(TimeSync), .SyncCtrl(SyncCtrl), .SyncId(SyncId), .SyncDelay(SyncDelay),
    .WakeFilter(WakeFilter)
  ) u_top (
    .clk_i(pclk), .rst_ni(presetn),
    .req_i(setup), .cancel_i(cancel), .we_i(pwrite), .addr_i(paddr[12:2]),
    .be_i(be), .wdata_i(pwdata),
    .rdata_o(rdata), .ready_o(ready),
    .irq_o, .irq_mb_o, .irq_boff_o, .irq_err_o, .irq_twrn_o, .irq_rwrn_o, .irq_wak_o,
    .ext_i, .time_out_o, .irq_time_o, .stop_req_i, .supv_o(supv),
    .can_rx_i, .can_tx_o, .trace_o);
endmodule
