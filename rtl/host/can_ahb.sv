// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_ahb: the controller (can_top) as an AHB-Lite slave. The address phase is the command of
// can_top, the data phase its data: one wait state for what lies in the buffers' RAM and for TIMER,
// none for other registers. A burst is served as single transfers.
//
// ERROR response (two cycles): unaligned, wider than 32 bits, or beyond the window of 8 KiB.

module can_ahb #(
  /// Number of message buffers: 16, 32 or 64. The Linux driver uses buffer 63.
  parameter int NumMb = 64,
  /// 1: with the Rx FIFO; 0: without. This and the other features: docs/integration.md.
  parameter int Fifo = 1,
  /// 1: with aborts that are certain of their outcome (MCR.AEN).
  parameter int Abort = 1,
  /// 1: with ESR2 and CRCR.
  parameter int Status = 1,
  /// 1: with a mask for each buffer and the queue of matching buffers (RXIMR, MCR.BCC).
  parameter int OwnMasks = 1,
  /// 1: with stop mode and wake-up.
  parameter int Wake = 1,
  /// 1: with local priority, one-shot, CAN FD tolerance, MAXMB, LBUF, remote answers, TSYN.
  parameter int Extras = 1,
  /// 1: the RAM of the buffers is cleared after a hard reset; 0: software has to clear it.
  parameter int ClearRam = 1,
  /// 1: with the time unit (docs/time.md).
  parameter int TimeUnit = 0,
  /// Increment of the time unit's clock in each clock, after a hard reset: 39:32 ns, 31:0 in 2^-32
  /// ns. The default, 20 ns, is for 50 MHz.
  parameter logic [39:0] TimeInc = 40'h14_0000_0000,
  /// 1: with the follower: the clock follows a master's without the CPU; needs TimeUnit.
  parameter int TimeSync = 0,
  /// Values of the follower's registers TSCTRL, TSID and TSDLY after a hard reset.
  parameter logic [31:0] SyncCtrl = 32'd0,
  parameter logic [31:0] SyncId = 32'd0,
  parameter logic [31:0] SyncDelay = 32'd0,
  /// Size of the region that hsel stands for, as a number of address bits, 13 to 32. Address bits
  /// above are ignored; those from 13 up to the region's size must be zero.
  parameter int RegionBits = 16,
  /// 1: while MCR.SUPV = 1, unprivileged accesses (hprot[1] = 0) read 0 and write nothing; 0: SUPV
  /// is only stored.
  parameter int CheckHprot = 0,
  /// Clocks for which the bus must be dominant to wake the core if MCR.WAK_SRC = 1, 1 to 255.
  parameter int WakeFilter = 6
) (
  input  logic        hclk,
  input  logic        hresetn,
  input  logic        hsel,
  input  logic [31:0] haddr,
  input  logic [1:0]  htrans,
  input  logic        hwrite,
  input  logic [2:0]  hsize,
  input  logic [2:0]  hburst,
  input  logic [3:0]  hprot,
  input  logic        hready,
  input  logic [31:0] hwdata,
  output logic [31:0] hrdata,
  output logic        hreadyout,
  output logic        hresp,
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
  input  logic        stop_req_i,    // 1: the system requests stop mode; synchronous to hclk
  input  logic        can_rx_i,      // RXD of the transceiver, asynchronous; 1: recessive
  output logic        can_tx_o,      // TXD of the transceiver, from a flip-flop; 1: recessive
  output logic [can_pkg::TraceWidth-1:0] trace_o  // for observers (can_pkg); leave open otherwise
);
  if (RegionBits < 13 || RegionBits > 32) begin : gen_check_region_bits
    RegionBits_must_be_13_to_32 u_stop ();   // no such module: the tool prints the name and stops
  end
  if (CheckHprot < 0 || CheckHprot > 1) begin : gen_check_hprot
    CheckHprot_must_be_0_or_1 u_stop ();
  end

  // Bursts are single transfers; of hprot only bit 1 matters, and only with CheckHprot = 1.
  logic unused, supv;
  assign unused = &{1'b0, hburst, hprot, htrans[0], supv};

  // Address phase.
  logic       taken, bad, beyond, denied;
  logic [3:0] be;
  assign taken  = hsel && hready && htrans[1];                     // NONSEQ or SEQ
  assign beyond = (haddr & 32'((33'd1 << RegionBits) - 33'd1)) >> 13 != '0;
  assign bad    = hsize > 3'd2 || (hsize == 3'd2 && haddr[1:0] != '0) || (hsize == 3'd1 && haddr[0])
               || beyond;
  assign denied = CheckHprot != 0 && supv && !hprot[1];
  always_comb begin
    case (hsize)
      3'd0:    be = 4'b0001 << haddr[1:0];
      3'd1:    be = haddr[1] ? 4'b1100 : 4'b0011;
      default: be = 4'b1111;
    endcase
  end

  // ERROR response: first cycle with hreadyout low, second with it high.
  logic err1_q, err2_q, ready;
  always_ff @(posedge hclk or negedge hresetn) begin
    if (!hresetn) {err1_q, err2_q} <= '0;
    else          {err1_q, err2_q} <= {taken && bad, err1_q};
  end
  assign hreadyout = ready && !err1_q;
  assign hresp     = err1_q || err2_q;

  // A denied access is not passed to can_top: it reads 0 and has no wait state.
  can_top #(
    .NumMb(NumMb), .Fifo(Fifo), .Abort(Abort), .Status(Status), .OwnMasks(OwnMasks), .Wake(Wake),
    .Extras(Extras), .ClearRam(ClearRam), .TimeUnit(TimeUnit), .TimeInc(TimeInc),
    .TimeSync(TimeSync), .SyncCtrl(SyncCtrl), .SyncId(SyncId), .SyncDelay(SyncDelay),
    .WakeFilter(WakeFilter)
  ) u_top (
    .clk_i(hclk), .rst_ni(hresetn),
    .req_i(taken), .cancel_i(bad || denied), .we_i(hwrite), .addr_i(haddr[12:2]), .be_i(be),
    .wdata_i(hwdata),
    .rdata_o(hrdata), .ready_o(ready),
    .irq_o, .irq_mb_o, .irq_boff_o, .irq_err_o, .irq_twrn_o, .irq_rwrn_o, .irq_wak_o,
    .ext_i, .time_out_o, .irq_time_o, .stop_req_i, .supv_o(supv),
    .can_rx_i, .can_tx_o, .trace_o);
endmodule
