// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_reg: one register of plain storage. The masks, from can_regs_pkg, say which bits a write
// changes in which mode. Bits in none of them, or not in Has, have no flip-flop and read as Without
// says.

module can_reg #(
  parameter logic [31:0] Reset     = '0,
  parameter logic [31:0] Any       = '0,   // bits that can be written at any time
  parameter logic [31:0] Freeze    = '0,   // bits that can be written in freeze mode
  parameter logic [31:0] Disable   = '0,   // bits that can be written in disable mode
  parameter logic [31:0] WrnEn     = '0,   // bits that can be written with MCR.WRN_EN = 1
  parameter logic [31:0] Has       = 32'hFFFF_FFFF,  // bits that this core has
  parameter logic [31:0] Without   = '0,   // value that bits without a flip-flop read
  parameter bit          SoftReset = 1'b0  // 1: a soft reset restores Reset
) (
  input  logic        clk_i,
  input  logic        rst_ni,
  input  logic        clear_i,             // pulse: soft reset
  input  logic        frz_ack_i,           // 1: bits of Freeze can be written
  input  logic        lpm_ack_i,           // 1: bits of Disable can be written
  input  logic        wrn_en_i,            // 1: bits of WrnEn can be written
  input  logic        we_i,                // 1: the register is written, byte lanes be_i
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
