// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// replay_remote: as replay.sv, for can_remote: plays pins that record_remote.cpp wrote down, with
// everything unknown before the reset, and compares every output with `===` in every clock.
//
// Plus arguments: +rows=FILE, +count=NUMBER of rows in it. Prints DIFF and X lines, at most 20
// each, and a last line "END clocks ... diffs ... xs ...".
`timescale 1ns / 1ps

module replay;
  localparam int RowWidth = 4 * 53;
  localparam int MaxRows = 1_000_000;

  reg [RowWidth-1:0] rows [0:MaxRows-1];
  reg [8*256-1:0]    path;
  integer            count, row, diffs, xs;

  // One row, most significant digit first: see RecordRemoteNode::edge().
  reg         clk, rst_n, start, req, we, hold, can_rx, read_ends;
  reg  [2:0]  node;
  reg  [3:0]  be;
  reg  [9:0]  addr;
  reg  [31:0] wdata;
  reg  [7:0]  events;
  wire        ready, written, apply, safe, can_tx;
  wire [31:0] rdata;
  wire [11:0] written_addr;
  wire [3:0]  written_len;
  wire [1:0]  state;
  wire [48:0] trace;
  reg         want_ready, want_written, want_apply, want_safe, want_can_tx;
  reg  [31:0] want_rdata;
  reg  [11:0] want_written_addr;
  reg  [3:0]  want_written_len;
  reg  [1:0]  want_state;
  reg  [48:0] want_trace;
  reg  [3:0]  d0, d1, d2, d3, d4, d5, d6, d7, d8, d9, d10, d11, d12, d13;
  reg  [11:0] addr_digits;
  reg  [51:0] trace_digits;

`ifdef NETLIST
  can_remote dut (
`else
  can_remote #(`PARAMETERS) dut (
`endif
    .clk_i(clk), .rst_ni(rst_n), .start_i(start), .node_i(node), .rate_i(4'd0),
    .usr_req_i(req), .usr_we_i(we), .usr_be_i(be), .usr_addr_i(addr), .usr_wdata_i(wdata),
    .usr_ready_o(ready), .usr_rdata_o(rdata), .usr_hold_i(hold), .event_i(events),
    .written_o(written), .written_addr_o(written_addr), .written_len_o(written_len),
    .apply_o(apply), .safe_o(safe), .state_o(state),
    .time_take_i(1'b0), .time_o(), .time_state_o(), .pps_o(),
    .can_rx_i(can_rx), .can_tx_o(can_tx), .trace_o(trace));

`include "replay_player.svh"

  // Registers by name: check_registers and check_behind_ram, made by registers.py.
  integer cleared;   // clocks since user logic has had access: the RAM is clear
`ifdef REGISTERS
`include "registers.vh"
`endif

  task take_row;
    begin
      {d0, d1, d2, d3, d4, be, addr_digits, wdata, d5, events, d6,
       d7, d8, want_rdata, d9, want_written_addr, want_written_len, d10, d11, d12, d13,
       trace_digits} = rows[row];
      rst_n = d0[0];         start = d1[0];       node = d2[2:0];      req = d3[0];
      we = d4[0];            addr = addr_digits[9:0]; hold = d5[0];    can_rx = d6[0];
      read_ends = d7[0];     want_ready = d8[0];  want_written = d9[0];
      want_apply = d10[0];   want_safe = d11[0];  want_state = d12[1:0];
      want_can_tx = d13[0];  want_trace = trace_digits[48:0];
    end
  endtask

  task check_outputs;
    begin
      check("usr_ready_o", ready, want_ready);
      check("written_o", written, want_written);
      check("apply_o", apply, want_apply);
      check("safe_o", safe, want_safe);
      check("state_o", state, want_state);
      check("can_tx_o", can_tx, want_can_tx);
      check("trace_o", trace, want_trace);
      if (written) check("written_addr", written_addr, want_written_addr);
      if (written) check("written_len", written_len, want_written_len);
      // Only where a read ends does its data mean something.
      if (read_ends) check("usr_rdata_o", rdata, want_rdata);
      if (^{ready, written, apply, safe, state, can_tx, trace} === 1'bx) unknown("outputs");
`ifdef REGISTERS
      if (rst_n) check_registers;
      cleared = rst_n && (cleared > 0 || ready === 1'b1) ? cleared + 1 : 0;
      if (cleared > 4) check_behind_ram;
`endif
    end
  endtask

  task power_up;   // no reset yet, nothing is known
    begin
      {start, node, req, we, be, addr, wdata, hold, events, can_rx} = 'x;
      rst_n = 1;
    end
  endtask
endmodule
