// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// In place of can_top under a bus wrapper: a native port that may do whatever can_top is proven to
// do (host.native_port), with outputs free otherwise. What the wrapper owes to it is checked here.

module can_top #(
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
  parameter int WakeFilter = 6
) (
  input  logic        clk_i,
  input  logic        rst_ni,
  input  logic        req_i,
  input  logic        cancel_i,
  input  logic        we_i,
  input  logic [12:2] addr_i,
  input  logic [3:0]  be_i,
  input  logic [31:0] wdata_i,
  output logic [31:0] rdata_o,
  output logic        ready_o,
  output logic        irq_o,
  output logic        irq_mb_o,
  output logic        irq_boff_o,
  output logic        irq_err_o,
  output logic        irq_twrn_o,
  output logic        irq_rwrn_o,
  output logic        irq_wak_o,
  input  logic        ext_i,
  output logic        time_out_o,
  output logic        irq_time_o,
  input  logic        stop_req_i,
  output logic        supv_o,
  input  logic        can_rx_i,
  output logic        can_tx_o,
  output logic [can_pkg::TraceWidth-1:0] trace_o
);
  (* anyseq *) logic [31:0] f_rdata;
  (* anyseq *) logic        f_ready, f_supv;
  assign rdata_o = f_read ? f_rdata : '0;
  assign ready_o = f_ready;
  assign supv_o  = f_supv;
  // One bit of the data, any of them, for a wrapper that gives them no name of their own: which and
  // its level.
  (* anyconst *) logic [4:0] f_bit;
  assign {irq_o, irq_mb_o, irq_boff_o, irq_err_o, irq_twrn_o} = f_bit;
  assign irq_rwrn_o = rdata_o[f_bit];
  assign irq_wak_o  = 1'b0;
  assign {time_out_o, irq_time_o} = '0;
  assign can_tx_o = can_pkg::Recessive;
  // What the port is told, for the properties in the wrapper.
  assign trace_o  = can_pkg::TraceWidth'({wdata_i, be_i, addr_i, we_i, req_i && !cancel_i});

  // A command was taken in the clock before: only its first clock may be one of waiting. Data are
  // 0 but in the data phase of a read, up to the clock in which the port is ready: discharged by
  // host.native_port, p_silent.
  logic f_first, f_read;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {f_first, f_read} <= '0;
    end else begin
      f_first <= req_i && !cancel_i && ready_o;
      if (ready_o) f_read <= req_i && !cancel_i && !we_i;
    end
  end

  always @(posedge clk_i) begin
    // Discharged by host.native_port, p_waits and p_first_only: the port is ready, but for at most
    // the clock after a command.
    m_ready: assume (!rst_ni || f_ready || f_first);
    // PK-12: the port is given a command only while it is ready.
    p_when_ready: assert (!rst_ni || !(req_i && !cancel_i) || ready_o);
  end
endmodule
