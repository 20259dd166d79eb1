// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_time_params: checks the parameters of clock and follower at elaboration (TM-31, TM-100). An
// illegal value instantiates a module that does not exist; its name is the error message. This also
// works in tools that do not support $error at elaboration.

module can_time_params #(
  /// Increment, 39:32 ns, 31:0 in 2^-32 ns a clock; can_clock has its own check.
  parameter logic [39:0] TimeInc = 40'h14_0000_0000,
  /// Values of TSCTRL, TSID and TSDLY.
  parameter logic [31:0] SyncCtrl = 32'd0,
  parameter logic [31:0] SyncId = 32'd0,
  parameter logic [31:0] SyncDelay = 32'd0,
  /// ns between two edges of the compare output.
  parameter int HalfPeriod = 500000000
) ();
  localparam logic [31:0] Ki = 32'(SyncCtrl[can_regs_pkg::TsctrlKi +: can_regs_pkg::TsctrlKiW]);
  localparam logic [31:0] Kd = 32'(SyncCtrl[can_regs_pkg::TsctrlKd +: can_regs_pkg::TsctrlKdW]);
  localparam logic Extended = SyncId[can_regs_pkg::TsidIde];
  // 16 clocks, in 2^-32 ns.
  localparam logic [63:0] Half     = 64'(HalfPeriod) << 32;
  localparam logic [63:0] Clocks16 = 64'(TimeInc) << 4;
  // TM-103: the rate is corrected by 2^(KI - KD).
  if (Kd > Ki) begin : gen_check_sync_ctrl
    SyncCtrl_must_be_with_KD_of_KI_at_most u_stop ();
  end
  // No frame has any other identifier: the follower would never find a pair.
  if (SyncId[30:29] != '0 || (!Extended && SyncId[17:0] != '0)) begin : gen_check_sync_id
    SyncId_must_be_as_in_TSID_base_identifiers_in_bits_28_to_18 u_stop ();
  end
  if (SyncDelay[31:24] != '0) begin : gen_check_sync_delay
    SyncDelay_must_be_24_bits u_stop ();
  end
  if (HalfPeriod < 1 || Half < Clocks16) begin : gen_check_half_period
    HalfPeriod_must_be_16_clocks_at_least u_stop ();
  end
endmodule
