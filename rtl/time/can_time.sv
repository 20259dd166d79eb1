// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_time: the part of the time unit that changes with every clock: clock, stamp of the frame on
// the bus, compare unit and launch time. Registers and flags are on the host side (can_time_regs),
// where nothing changes in a clock without an event.

module can_time #(
  /// Increment after a reset, see can_clock.
  parameter logic [39:0] TimeInc = 40'h14_0000_0000,
  /// 1: upset_o is built, see can_time_cmp; 0: it is 0.
  parameter int Watch = 0
) (
  input  logic        clk_i,
  input  logic        rst_ni,
  // Host side.
  input  logic [can_pkg::TimeCmdWidth-1:0] cmd_i, // command pulses, can_pkg::Time*
  input  logic [63:0] data_i,       // data of the command
  output logic [63:0] now_o,        // TIME of the last TimeRead
  output logic [63:0] ext_o,        // TIME of the last TimeExt
  output logic [31:0] left_o,       // TSLEW: rest of a slew
  output logic [39:0] inc_o,        // increment, see can_clock
  input  logic [31:0] tctrl_i,      // TCTRL
  input  logic [31:0] tcmph_i,      // TCMPH
  input  logic [31:0] ttx_i,        // TTX
  output logic [can_pkg::TimeStatWidth-1:0] stat_o, // levels and pulses, can_pkg::TimeStat*
  output logic        upset_o,      // compare unit has changed by an upset (TM-141)
  // Engine, as for can_stamp.
  input  logic        rx_i,         // receive level, synchronised, behind loop-back
  input  logic        tx_i,         // own transmit level
  input  logic        sample_i,     // sample point
  input  logic        bit_i,        // sampled bit
  input  can_pkg::field_t field_i,  // field of the current bit
  input  logic        transmitter_i, // this node sends the frame
  input  logic        sof_i,        // pulse after the sample point of SOF
  input  logic        rx_valid_i,   // pulse after the sample point of EOF6
  // Stamp of the frame on the bus.
  output logic [63:0] stamp_o,      // changes at edges; good from stamp_we_o to the next frame
  output logic        stamp_we_o,   // pulse: stamp_o is complete
  output logic        stamp_tx_o    // with stamp_we_o: stamp of an own frame
);
  logic [31:0] lo, hi;
  can_clock #(.TimeInc(TimeInc)) u_clock (
    .clk_i, .rst_ni,
    .set_i(cmd_i[can_pkg::TimeSet]), .shift_i(cmd_i[can_pkg::TimeShift]),
    .rate_i(cmd_i[can_pkg::TimeRate]), .slew_i(cmd_i[can_pkg::TimeSlew]), .data_i,
    .slewr_i(tctrl_i[can_regs_pkg::TctrlSlewr +: can_regs_pkg::TctrlSlewrW]),
    .lo_o(lo), .hi_o(hi), .left_o, .inc_o);

  // TIME: lo is one clock ahead of hi.
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
