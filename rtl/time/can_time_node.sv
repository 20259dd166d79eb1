// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_time_node: a clock on a CAN bus without a processor (TM-100): the protocol engine with
// constants in place of registers, its time unit, and the follower. It acknowledges frames but
// sends none.

module can_time_node #(
  /// Increment at the nominal rate: 39:32 ns, 31:0 in 2^-32 ns a clock; not 0.
  parameter logic [39:0] TimeInc = 40'h14_0000_0000,
  /// Follower: TSCTRL without EN and PPS, with KD at most KI, TSID, and TSDLY in 24 bits; see
  /// docs/registers.md. The default is for a pair a second at 50 MHz: KI 6, KD 2, PHALF, TMO 31.
  parameter logic [31:0] SyncCtrl = 32'h1F46_0100,
  parameter logic [31:0] SyncId = 32'd0,
  parameter logic [31:0] SyncDelay = 32'd0,
  /// ns between two edges of pps_o, at least 16 clocks; 500,000,000: one rising edge per second.
  parameter int HalfPeriod = 500000000,
  /// Bit timing as `verican bittime` prints it: clocks per quantum 1..256, quanta per segment 1..8,
  /// SJW 1..4; at least 8 clocks a bit.
  parameter int Brp = 10,
  parameter int Prop = 3,
  parameter int Ps1 = 4,
  parameter int Ps2 = 2,
  parameter int Sjw = 1
) (
  input  logic        clk_i,
  input  logic        rst_ni,
  output logic        pps_o,       // rises with the master's seconds, from the first step on
  output logic [1:0]  state_o,     // TSSTAT.STATE: 2 is locked
  output logic [31:0] offset_o,    // TSOFS: offset before the last correction, ns
  input  logic        can_rx_i,    // receive pin, asynchronous
  output logic        can_tx_o     // transmit pin, register
);
  can_time_params #(
    .TimeInc(TimeInc), .SyncCtrl(SyncCtrl), .SyncId(SyncId), .SyncDelay(SyncDelay),
    .HalfPeriod(HalfPeriod)
  ) u_time_params ();
  can_timing_params #(
    .Brp(Brp), .Prop(Prop), .Ps1(Ps1), .Ps2(Ps2), .Sjw(Sjw)
  ) u_timing_params ();

  localparam logic [31:0] Tctrl = 32'd1 << can_regs_pkg::TctrlPoint
                                | 32'd1 << can_regs_pkg::TctrlCmpen;
  localparam logic [31:0] Ctrl  = SyncCtrl | 32'd1 << can_regs_pkg::TsctrlEn
                                | 32'd1 << can_regs_pkg::TsctrlPps;

  logic [31:0] stat;
  logic [can_pkg::TimeStatWidth-1:0] time_stat;
  assign state_o = stat[can_regs_pkg::TsstatState +: can_regs_pkg::TsstatStateW];
  assign pps_o   = time_stat[can_pkg::TimeStatOut];
  logic unused;
  assign unused = &{1'b0, stat, time_stat};

  can_core #(.TimeUnit(1), .TimeInc(TimeInc), .TimeSync(1)) u_core (
    .clk_i, .rst_ni,
    .run_i(1'b1), .running_o(), .stop_ok_o(), .gap_o(),
    .presdiv_i(8'(Brp - 1)), .rjw_i(2'(Sjw - 1)), .pseg1_i(3'(Ps1 - 1)), .pseg2_i(3'(Ps2 - 1)),
    .propseg_i(3'(Prop - 1)), .smp_i(1'b0), .lom_i(1'b0), .lpb_i(1'b0), .fd_tolerant_i(1'b0),
    .boff_rec_i(1'b0),
    .ec_clear_i(1'b0), .ec_we_i(1'b0), .ec_wdata_i(16'd0), .tec_o(), .rec_o(),
    .passive_o(), .boff_o(), .err_o(),
    .idle_o(), .transmitter_o(), .receiver_o(), .synch_o(),
    .tick_req_i(1'b0), .tick_o(), .rx_req_i(1'b0), .rx_level_o(),
    .timer_clear_i(1'b0), .timer_we_i(1'b0), .timer_be_i(2'b00), .timer_wdata_i(16'd0),
    .timer_o(),
    .tx_req_i(1'b0), .tx_ide_i(1'b0), .tx_rtr_i(1'b0), .tx_dlc_i(4'd0), .tx_word_i(32'd0),
    .tx_next_o(), .tx_ok_o(), .tx_fail_o(),
    .start_o(), .stamp_o(), .rx_hdr_o(), .rx_id_o(), .rx_ide_o(), .rx_srr_o(),
    .rx_rtr_o(), .rx_dlc_o(), .rx_byte_we_o(), .rx_byte_o(), .rx_valid_o(), .crc_o(),
    .time_cmd_i({can_pkg::TimeCmdWidth{1'b0}}), .time_data_i(64'd0),
    .time_now_o(), .time_ext_o(), .time_left_o(),
    .time_tctrl_i(Tctrl), .time_tcmph_i(32'(HalfPeriod)), .time_ttx_i(32'd0), .time_wait_i(1'b0),
    .time_stat_o(time_stat), .time_stamp_o(), .time_stamp_we_o(), .time_stamp_tx_o(),
    .time_sync_ctrl_i(Ctrl), .time_sync_id_i(SyncId), .time_sync_delay_i(SyncDelay[23:0]),
    .time_sync_stat_o(stat), .time_sync_ofs_o(offset_o),
    .can_rx_i, .can_tx_o, .trace_o());
endmodule
