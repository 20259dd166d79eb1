// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_time_sync_regs: registers of the follower without a CPU at 0x1180 to 0x1190 (TM-100).

module can_time_sync_regs #(
  /// Reset values of TSCTRL, TSID and TSDLY.
  parameter logic [31:0] SyncCtrl  = '0,
  parameter logic [31:0] SyncId    = '0,
  parameter logic [31:0] SyncDelay = '0
) (
  input  logic        clk_i,
  input  logic        rst_ni,
  // CPU, in the data phase
  input  logic        rd_i,                 // read
  input  logic        wr_i,                 // write
  input  logic [4:0]  addr_i,               // word address in the page
  input  logic [3:0]  be_i,                 // byte enables
  input  logic [31:0] wdata_i,
  output logic [31:0] rdata_o,
  // can_time_sync
  output logic [31:0] ctrl_o,               // TSCTRL
  output logic [31:0] id_o,                 // TSID
  output logic [23:0] delay_o,              // TSDLY, signed ns
  input  logic [31:0] stat_i,               // TSSTAT
  input  logic [31:0] ofs_i                 // TSOFS
);
  can_time_params #(
    .SyncCtrl(SyncCtrl), .SyncId(SyncId), .SyncDelay(SyncDelay)
  ) u_params ();

  localparam logic [4:0] Tsctrl = 5'(can_regs_pkg::TsctrlAddr);
  localparam logic [4:0] Tsid   = 5'(can_regs_pkg::TsidAddr);
  localparam logic [4:0] Tsdly  = 5'(can_regs_pkg::TsdlyAddr);
  localparam logic [4:0] Tsstat = 5'(can_regs_pkg::TsstatAddr);
  localparam logic [4:0] Tsofs  = 5'(can_regs_pkg::TsofsAddr);

  logic [31:0] delay;
  assign delay_o = delay[23:0];

  can_reg #(.Reset(SyncCtrl), .Any(can_regs_pkg::TsctrlAny)) u_ctrl (
    .clk_i, .rst_ni, .clear_i(1'b0), .frz_ack_i(1'b0), .lpm_ack_i(1'b0), .wrn_en_i(1'b0),
    .we_i(wr_i && addr_i == Tsctrl), .be_i, .wdata_i, .value_o(ctrl_o));
  can_reg #(.Reset(SyncId), .Any(can_regs_pkg::TsidAny)) u_id (
    .clk_i, .rst_ni, .clear_i(1'b0), .frz_ack_i(1'b0), .lpm_ack_i(1'b0), .wrn_en_i(1'b0),
    .we_i(wr_i && addr_i == Tsid), .be_i, .wdata_i, .value_o(id_o));
  can_reg #(.Reset(SyncDelay), .Any(can_regs_pkg::TsdlyAny)) u_delay (
    .clk_i, .rst_ni, .clear_i(1'b0), .frz_ack_i(1'b0), .lpm_ack_i(1'b0), .wrn_en_i(1'b0),
    .we_i(wr_i && addr_i == Tsdly), .be_i, .wdata_i, .value_o(delay));

  always_comb begin
    rdata_o = '0;
    if (rd_i) begin
      case (addr_i)
        Tsctrl:  rdata_o = ctrl_o;
        Tsid:    rdata_o = id_o;
        Tsdly:   rdata_o = delay;
        Tsstat:  rdata_o = stat_i;
        Tsofs:   rdata_o = ofs_i;
        default: ;
      endcase
    end
  end
endmodule
