// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// replay: plays pins that record.cpp wrote down to can_ahb in a simulator with four states, with
// everything unknown before the reset, and compares every output with `===` in every clock. Runs
// with Icarus Verilog; NETLIST: the device is a netlist, without parameters or registers by name.
//
// Plus arguments: +rows=FILE, +count=NUMBER of rows in it. Prints DIFF and X lines, at most 20
// each, and a last line "END clocks ... diffs ... xs ...".
`timescale 1ns / 1ps
`ifndef PARAMETERS
`define PARAMETERS .NumMb(64)
`endif

module replay;
  localparam int RowWidth = 4 * 53;
  localparam int MaxRows = 400_000;

  reg [RowWidth-1:0] rows [0:MaxRows-1];
  reg [8*256-1:0]    path;
  integer            count, row, diffs, xs;

  // One row, most significant digit first: see hex() in record_row.cpp.
  reg         clk, hresetn, hsel, hwrite, hready, stop_req, ext, can_rx, read_ends;
  reg  [31:0] haddr, hwdata;
  reg  [1:0]  htrans;
  reg  [2:0]  hsize, hburst;
  reg  [3:0]  hprot;
  wire [31:0] hrdata;
  wire        hreadyout, hresp, can_tx, time_out;
  wire [7:0]  irq;   // bit 7: of the time unit
  wire [48:0] trace;
  reg  [31:0] want_hrdata;
  reg         want_hreadyout, want_hresp, want_can_tx, want_time_out;
  reg  [7:0]  want_irq;
  reg  [48:0] want_trace;
  reg  [3:0]  d0, d1, d2, d3, d4, d5, d6, d7, d8, d9, d10, d11, d12;
  reg  [7:0]  irq_digits;
  reg  [51:0] trace_digits;

`ifdef NETLIST
  can_ahb dut (
`else
  can_ahb #(`PARAMETERS) dut (
`endif
    .hclk(clk), .hresetn(hresetn), .hsel(hsel), .haddr(haddr), .htrans(htrans), .hwrite(hwrite),
    .hsize(hsize), .hburst(hburst), .hprot(hprot), .hready(hready), .hwdata(hwdata),
    .hrdata(hrdata), .hreadyout(hreadyout), .hresp(hresp),
    .irq_o(irq[0]), .irq_mb_o(irq[1]), .irq_boff_o(irq[2]), .irq_err_o(irq[3]),
    .irq_twrn_o(irq[4]), .irq_rwrn_o(irq[5]), .irq_wak_o(irq[6]),
    .irq_time_o(irq[7]), .ext_i(ext), .time_out_o(time_out),
    .stop_req_i(stop_req), .can_rx_i(can_rx), .can_tx_o(can_tx), .trace_o(trace));

`include "replay_player.svh"

  // Registers by name: check_registers and check_behind_ram, made by registers.py.
  integer cleared;   // clocks since the buffer RAM has been cleared
`ifdef REGISTERS
`include "registers.vh"
`endif

  task take_row;
    begin
      {d0, d1, haddr, d2, d3, d4, d5, hprot, d6, hwdata, d7, d8, d9, want_hrdata, d10, d11,
       irq_digits, d12, trace_digits} = rows[row];
      hresetn = d0[0];         hsel = d1[0];    htrans = d2[1:0]; hwrite = d3[0];
      hsize = d4[2:0];         hburst = d5[2:0]; hready = d6[0];   {ext, stop_req} = d7[1:0];
      can_rx = d8[0];          read_ends = d9[0];
      want_hreadyout = d10[0]; want_hresp = d11[0];
      want_irq = irq_digits;
      {want_time_out, want_can_tx} = d12[1:0]; want_trace = trace_digits[48:0];
    end
  endtask

  task check_outputs;
    begin
      check("hreadyout", hreadyout, want_hreadyout);
      check("hresp", hresp, want_hresp);
      check("irq", irq, want_irq);
      check("can_tx_o", can_tx, want_can_tx);
      check("time_out_o", time_out, want_time_out);
      check("trace_o", trace, want_trace);
      // Only where a read ends does hrdata mean something.
      if (read_ends) check("hrdata", hrdata, want_hrdata);
      if (^{hreadyout, hresp, irq, can_tx, time_out, trace} === 1'bx)
        unknown("outputs");
`ifdef REGISTERS
      if (hresetn) check_registers;
      // Without ClearRam that is software's, before it leaves freeze mode.
      if (hresetn && (dut.ClearRam != 0 ? dut.u_top.mb_scrub === 1'b0
                                        : cleared > 0 || dut.u_top.run === 1'b1))
        cleared = cleared + 1;
      else
        cleared = 0;
      if (cleared > 4) check_behind_ram;
`endif
    end
  endtask

  task power_up;   // no reset yet, nothing is known
    begin
      {hsel, haddr, htrans, hwrite, hsize, hburst, hprot, hready, hwdata, stop_req, ext,
       can_rx} = 'x;
      hresetn = 1;
    end
  endtask
endmodule
