// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_ahb: the controller as an AHB-Lite slave. One wait state for what lies in the buffers' RAM
// and for TIMER, none for other registers.
//
// ERROR (two cycles): unaligned, wider than 32 bits, or beyond the window of 8 KiB.

module can_ahb #(
  /// Message buffers: 16, 32 or 64; the Linux driver uses number 63.
  parameter int NumMb = 64,
  /// What the core has, 1, or has not, 0 (docs/integration.md): the Rx FIFO;
  parameter int Fifo = 1,
  /// aborts that are certain of their outcome (MCR.AEN);
  parameter int Abort = 1,
  /// ESR2 and CRCR;
  parameter int Status = 1,
  /// a mask for each buffer, and the queue of several matching buffers (RXIMR, MCR.BCC);
  parameter int OwnMasks = 1,
  /// stop mode and waking from it;
  parameter int Wake = 1,
  /// local priority, one-shot, tolerance of CAN FD, MAXMB, LBUF, remote answers, TSYN;
  parameter int Extras = 1,
  /// zeros in the RAM of the buffers after a hard reset: without, software has to clear it.
  parameter int ClearRam = 1,
  /// The time unit, docs/time.md: 1 with, 0 without.
  parameter int TimeUnit = 0,
  /// Increment of its clock after a hard reset: 39:32 ns, 31:0 in 2^-32 ns a clock; 20 ns: 50 MHz.
  parameter logic [39:0] TimeInc = 40'h14_0000_0000,
  /// 1: with the follower that keeps this clock to a master's without the CPU; needs TimeUnit.
  parameter int TimeSync = 0,
  /// Values of its registers TSCTRL, TSID and TSDLY after a hard reset.
  parameter logic [31:0] SyncCtrl = 32'd0,
  parameter logic [31:0] SyncId = 32'd0,
  parameter logic [31:0] SyncDelay = 32'd0,
  /// Size of the region that hsel stands for, as a number of address bits, 13 to 32; address bits
  /// above are not looked at, those down to 13 must be zero.
  parameter int RegionBits = 16,
  /// 1: with MCR.SUPV = 1 unprivileged accesses (hprot[1] = 0) read 0 and write nothing; 0: SUPV is
  /// only stored.
  parameter int CheckHprot = 0,
  /// Clocks that the bus must be dominant to wake the core if MCR.WAK_SRC = 1, 1 to 255.
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
  output logic        irq_o,
  output logic        irq_mb_o,
  output logic        irq_boff_o,
  output logic        irq_err_o,
  output logic        irq_twrn_o,
  output logic        irq_rwrn_o,
  output logic        irq_wak_o,
  input  logic        ext_i,         // time unit: external event, asynchronous
  output logic        time_out_o,    // ... output of the compare unit, a pulse a second if wanted
  output logic        irq_time_o,    // ... interrupt, not part of irq_o
  input  logic        stop_req_i,    // the system wants stop mode; in step with hclk
  input  logic        can_rx_i,
  output logic        can_tx_o,
  output logic [can_pkg::TraceWidth-1:0] trace_o
);
  if (RegionBits < 13 || RegionBits > 32) begin : gen_check_region_bits
    RegionBits_must_be_13_to_32 u_stop ();   // no such module: the tool prints the name and stops
  end
  if (CheckHprot < 0 || CheckHprot > 1) begin : gen_check_hprot
    CheckHprot_must_be_0_or_1 u_stop ();
  end

  // A burst is treated as single transfers. Of hprot only bit 1 counts, with CheckHprot = 1.
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

  // A denied access is not passed to the core: it reads 0 and has no wait state.
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
