// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// replay_follower: as replay.sv, for can_time_node: plays pins that record_follower.cpp wrote down,
// with everything unknown before the reset, and compares every output with `===` in every clock.
//
// Plus arguments: +rows=FILE, +count=NUMBER of rows in it. Prints DIFF and X lines, at most 20
// each, and a last line "END clocks ... diffs ... xs ...".
`timescale 1ns / 1ps

module replay;
  localparam int RowWidth = 4 * 13;
  localparam int MaxRows = 1_000_000;

  reg [RowWidth-1:0] rows [0:MaxRows-1];
  reg [8*256-1:0]    path;
  integer            count, row, diffs, xs;

  // One row, most significant digit first: see RecordedFollower.
  reg         clk, rst_n, can_rx;
  wire        pps, can_tx;
  wire [1:0]  state;
  wire [31:0] offset;
  reg         want_pps, want_can_tx;
  reg  [1:0]  want_state;
  reg  [31:0] want_offset;
  reg  [3:0]  d0, d1, d2, d3, d4;

`ifdef NETLIST
  can_time_node dut (
`else
  can_time_node #(`PARAMETERS) dut (
`endif
    .clk_i(clk), .rst_ni(rst_n), .pps_o(pps), .state_o(state), .offset_o(offset),
    .can_rx_i(can_rx), .can_tx_o(can_tx));

`include "replay_player.svh"

  // Registers by name: check_registers and check_behind_ram, made by registers.py.
  integer cleared;   // there is no RAM here
`ifdef REGISTERS
`include "registers.vh"
`endif

  task take_row;
    begin
      {d0, d1, d2, d3, want_offset, d4} = rows[row];
      rst_n = d0[0];       can_rx = d1[0];
      want_pps = d2[0];    want_state = d3[1:0];    want_can_tx = d4[0];
    end
  endtask

  task check_outputs;
    begin
      check("pps_o", pps, want_pps);
      check("state_o", state, want_state);
      check("offset_o", offset, want_offset);
      check("can_tx_o", can_tx, want_can_tx);
      if (^{pps, state, offset, can_tx} === 1'bx) unknown("outputs");
`ifdef REGISTERS
      if (rst_n) check_registers;
      if (rst_n) check_behind_ram;   // none is: what has no reset must not be X either
`endif
      cleared = 0;
    end
  endtask

  task power_up;   // no reset yet, nothing is known
    begin
      can_rx = 'x;
      rst_n = 1;
    end
  endtask
endmodule
