// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_axil: the controller (can_top) as an AXI4-Lite slave of 32 bits. One read and one write may
// be outstanding; can_top serves one at a time, a read every two clocks, a write every three, and
// one clock more for what lies in the buffers' RAM and for TIMER.
//
// SLVERR: beyond the window of 8 KiB.

module can_axil #(
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
  /// 1: while MCR.SUPV = 1, unprivileged accesses (AxPROT[0] = 0) read 0, write nothing; 0: SUPV is
  /// only stored.
  parameter int CheckProt = 0,
  /// Clocks for which the bus must be dominant to wake the core if MCR.WAK_SRC = 1, 1 to 255.
  parameter int WakeFilter = 6
) (
  input  logic        aclk,
  input  logic        aresetn,
  input  logic [31:0] awaddr,        // 1:0 are ignored: accesses are whole words
  input  logic [2:0]  awprot,
  input  logic        awvalid,
  output logic        awready,
  input  logic [31:0] wdata,
  input  logic [3:0]  wstrb,
  input  logic        wvalid,
  output logic        wready,
  output logic [1:0]  bresp,
  output logic        bvalid,
  input  logic        bready,
  input  logic [31:0] araddr,        // 1:0 are ignored: accesses are whole words
  input  logic [2:0]  arprot,
  input  logic        arvalid,
  output logic        arready,
  output logic [31:0] rdata,
  output logic [1:0]  rresp,
  output logic        rvalid,
  input  logic        rready,
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
  input  logic        stop_req_i,    // 1: the system requests stop mode; synchronous to aclk
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
  assign unused = &{1'b0, awaddr[1:0], araddr[1:0], awprot, arprot, supv};

  // A transfer begins when its response channel is free and can_top is idle. A read and a write
  // that both wait take turns. Whose turn it is is decided a clock ahead, from the response
  // channels, so that the address is early.
  logic read_q, write_q, taken_q, read_last_q, prefer_write_q, reads, writes, turn, idle, begins;
  logic r_shut, b_shut, read_last;
  assign r_shut = rvalid && !rready;
  assign b_shut = bvalid && !bready;
  assign reads  = arvalid && !r_shut;
  assign writes = awvalid && wvalid && !taken_q && !b_shut;
  assign turn   = prefer_write_q ? awvalid && wvalid : !arvalid;      // of the write
  assign idle   = !read_q && !write_q;
  assign begins = (turn ? writes : reads) && idle;
  assign read_last = begins ? !turn : read_last_q;

  // Command. A read is of all byte lanes; a write without a strobe is not passed to can_top.
  logic        beyond, denied, cancel, error_q, ready;
  logic [3:0]  be;
  logic [31:0] addr, core_rdata;
  assign addr   = turn ? awaddr : araddr;
  assign beyond = (addr & 32'((33'd1 << RegionBits) - 33'd1)) >> 13 != '0;
  assign denied = CheckProt != 0 && supv && !(turn ? awprot[0] : arprot[0]);
  assign be     = turn ? wstrb : 4'b1111;
  assign cancel = beyond || denied || be == '0 || !begins;

  // Data phase: read_q, write_q. The master holds address and data until their READY, so nothing is
  // stored here: ARREADY comes with the read data, AWREADY and WREADY a clock after the write.
  always_ff @(posedge aclk or negedge aresetn) begin
    if (!aresetn) begin
      {read_q, write_q, taken_q, error_q, rvalid, bvalid} <= '0;
      {read_last_q, prefer_write_q} <= '0;
    end else begin
      taken_q <= write_q && ready;
      read_last_q    <= read_last;
      prefer_write_q <= !b_shut && (r_shut || read_last);
      if (begins) {read_q, write_q, error_q} <= {!turn, turn, beyond};
      else if (ready) {read_q, write_q} <= '0;
      if (read_q && ready) rvalid <= 1'b1;
      else if (rready)     rvalid <= 1'b0;
      if (taken_q)         bvalid <= 1'b1;
      else if (bready)     bvalid <= 1'b0;
    end
  end
  assign arready = read_q && ready;
  assign {awready, wready} = {2{taken_q}};

  always_ff @(posedge aclk or negedge aresetn) begin
    if (!aresetn) {rdata, rresp, bresp} <= '0;
    else begin
      if (arready) begin
        rdata <= core_rdata;          // 0 of what the core has not been given
        rresp <= {error_q, 1'b0};
      end
      if (write_q && ready) bresp <= {error_q, 1'b0};
    end
  end

  can_top #(
    .NumMb(NumMb), .Fifo(Fifo), .Abort(Abort), .Status(Status), .OwnMasks(OwnMasks), .Wake(Wake),
    .Extras(Extras), .ClearRam(ClearRam), .TimeUnit(TimeUnit), .TimeInc(TimeInc),
    .TimeSync(TimeSync), .SyncCtrl(SyncCtrl), .SyncId(SyncId), .SyncDelay(SyncDelay),
    .WakeFilter(WakeFilter)
  ) u_top (
    .clk_i(aclk), .rst_ni(aresetn),
    .req_i(idle && (arvalid || (awvalid && wvalid))), .cancel_i(cancel), .we_i(turn),
    .addr_i(addr[12:2]), .be_i(be), .wdata_i(wdata),
    .rdata_o(core_rdata), .ready_o(ready),
    .irq_o, .irq_mb_o, .irq_boff_o, .irq_err_o, .irq_twrn_o, .irq_rwrn_o, .irq_wak_o,
    .ext_i, .time_out_o, .irq_time_o, .stop_req_i, .supv_o(supv),
    .can_rx_i, .can_tx_o, .trace_o);
endmodule
