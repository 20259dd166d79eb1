// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_reg: one register of plain storage. Which bits a write changes, and in which mode, are the
// masks of can_regs_pkg; bits in none of them are no flip-flops and read as Without says.

module can_reg #(
  parameter logic [31:0] Reset     = '0,
  parameter logic [31:0] Any       = '0,   // written at any time
  parameter logic [31:0] Freeze    = '0,   // in freeze mode
  parameter logic [31:0] Disable   = '0,   // in disable mode
  parameter logic [31:0] WrnEn     = '0,   // with MCR.WRN_EN
  parameter logic [31:0] Has       = '1,   // what of all these there is in this core
  parameter logic [31:0] Without   = '0,   // what the others read
  parameter bit          SoftReset = 1'b0  // cleared by a soft reset
) (
  input  logic        clk_i,
  input  logic        rst_ni,
  input  logic        clear_i,             // soft reset
  input  logic        frz_ack_i,
  input  logic        lpm_ack_i,
  input  logic        wrn_en_i,
  input  logic        we_i,
  input  logic [3:0]  be_i,
  input  logic [31:0] wdata_i,
  output logic [31:0] value_o
);
  localparam logic [31:0] Stored = (Any | Freeze | Disable | WrnEn) & Has;
  logic [31:0] value_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      value_q <= Reset;
    end else if (SoftReset && clear_i) begin
      value_q <= Reset;
    end else if (we_i) begin
      for (int i = 0; i < 32; i++) begin
        if (be_i[i / 8] && (Any[i] || (Freeze[i] && frz_ack_i) || (Disable[i] && lpm_ack_i) ||
                            (WrnEn[i] && wrn_en_i))) value_q[i] <= wdata_i[i];
      end
    end
  end
  assign value_o = (value_q & Stored) | Without;
endmodule
