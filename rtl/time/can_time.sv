// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_time: the part of the time unit that moves with every clock: clock, stamp of the frame on the
// bus, compare and launch. Registers and flags are on the host side (can_time_regs).

module can_time #(
  /// Increment after a reset, see can_clock.
  parameter logic [39:0] TimeInc = 40'h14_0000_0000,
  /// 1: upset_o, see can_time_cmp.
  parameter int Watch = 0
) (
  input  logic        clk_i,
  input  logic        rst_ni,
  // Host side, see can_pkg. Commands are pulses, data with them.
  input  logic [can_pkg::TimeCmdWidth-1:0] cmd_i,
  input  logic [63:0] data_i,
  output logic [63:0] now_o,        // TIME of the last TimeRead, see can_capture
  output logic [63:0] ext_o,        // TIME of the last TimeExt
  output logic [31:0] left_o,       // TSLEW
  output logic [39:0] inc_o,        // increment, see can_clock
  input  logic [31:0] tctrl_i,      // TCTRL
  input  logic [31:0] tcmph_i,      // TCMPH
  input  logic [31:0] ttx_i,        // TTX
  output logic [can_pkg::TimeStatWidth-1:0] stat_o,
  output logic        upset_o,
  // Engine, see can_stamp.
  input  logic        rx_i,
  input  logic        tx_i,
  input  logic        sample_i,
  input  logic        bit_i,
  input  can_pkg::field_t field_i,
  input  logic        transmitter_i,
  input  logic        sof_i,
  input  logic        rx_valid_i,
  // Stamp of the frame on the bus; changes at edges, good from stamp_we_o until the next frame.
  output logic [63:0] stamp_o,
  output logic        stamp_we_o,
  output logic        stamp_tx_o
);
  logic [31:0] lo, hi;
  can_clock #(.TimeInc(TimeInc)) u_clock (
    .clk_i, .rst_ni,
    .set_i(cmd_i[can_pkg::TimeSet]), .shift_i(cmd_i[can_pkg::TimeShift]),
    .rate_i(cmd_i[can_pkg::TimeRate]), .slew_i(cmd_i[can_pkg::TimeSlew]), .data_i,
    .slewr_i(tctrl_i[can_regs_pkg::TctrlSlewr +: can_regs_pkg::TctrlSlewrW]),
    .lo_o(lo), .hi_o(hi), .left_o, .inc_o);

  // TIME.
  logic [31:0] lo_q;
  logic [63:0] now;
  assign now = {hi, lo_q};
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) lo_q <= '0;
    else         lo_q <= lo;
  end

  logic take;
  can_stamp u_stamp (
    .clk_i, .rst_ni,
    .point_i(tctrl_i[can_regs_pkg::TctrlPoint +: can_regs_pkg::TctrlPointW]),
    .txpin_i(tctrl_i[can_regs_pkg::TctrlTxpin]),
    .rx_i, .tx_i, .sample_i, .bit_i, .field_i, .transmitter_i, .sof_i, .rx_valid_i,
    .take_o(take), .stamp_we_o, .stamp_tx_o);
  can_capture u_stamp_time (
    .clk_i, .rst_ni, .take_i(take), .now_i(now), .time_o(stamp_o));

  logic armed, match, out, held, launch;
  can_time_cmp #(.Watch(Watch)) u_cmp (
    .clk_i, .rst_ni, .lo_i(lo), .data_i(data_i[63:32]),
    .enable_i(tctrl_i[can_regs_pkg::TctrlCmpen]), .arm_i(cmd_i[can_pkg::TimeArm]),
    .period_i(tcmph_i), .armed_o(armed), .match_o(match), .out_o(out),
    .upset_o,
    .hold_i(cmd_i[can_pkg::TimeHold]), .release_i(cmd_i[can_pkg::TimeRelease]), .launch_i(ttx_i),
    .held_o(held), .launch_o(launch));

  can_capture u_ext_time (
    .clk_i, .rst_ni, .take_i(cmd_i[can_pkg::TimeExt]), .now_i(now), .time_o(ext_o));
  can_capture u_now (
    .clk_i, .rst_ni, .take_i(cmd_i[can_pkg::TimeRead]), .now_i(now), .time_o(now_o));

  logic slewing, slewing_q;
  assign slewing = left_o != '0;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      slewing_q <= 1'b0;
    end else begin
      slewing_q <= slewing;
    end
  end

  always_comb begin
    stat_o[can_pkg::TimeStatSlewing] = slewing_q;
    stat_o[can_pkg::TimeStatHeld]    = held;
    stat_o[can_pkg::TimeStatOut]     = out;
    stat_o[can_pkg::TimeStatArmed]   = armed;
    stat_o[can_pkg::TimeStatMatch]   = match;
    stat_o[can_pkg::TimeStatSlewed]  = slewing_q && !slewing;
    stat_o[can_pkg::TimeStatLaunch]  = launch;
    stat_o[can_pkg::TimeStatSync]    = 1'b0;   // that of can_time_sync
  end
endmodule
