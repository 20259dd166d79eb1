// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_rn_time: connects the time unit of the engine to the node (TM-106 to TM-109). It commands
// time captures for TRIGGER and user logic, and replaces the RAM's data when the bus or user logic
// reads the row at 0xFC0: TSSTAT, TSOFS, time of the last TRIGGER.

module can_rn_time (
  input  logic        clk_i,
  input  logic        rst_ni,
  // Read access of the RAM; data in the clock after
  input  logic        re_i,       // read enable
  input  logic [9:0]  raddr_i,    // word address
  input  logic [31:0] rdata_i,    // word that the RAM has read
  output logic [31:0] rdata_o,    // word for the reader: RAM or clock
  // Node
  input  logic        apply_i,    // pulse: staged bytes have become visible
  input  logic        take_i,     // pulse: user logic captures the time of this clock
  // Time unit, see can_core
  input  logic [31:0] stat_i,     // TSSTAT
  input  logic [31:0] ofs_i,      // TSOFS
  input  logic [63:0] ext_i,      // time of the last apply_i, ns
  output logic [can_pkg::TimeCmdWidth-1:0] cmd_o // command pulses, see can_pkg
);
  localparam logic [7:0] Row = 8'hFC;   // 0xFC0 to 0xFCF, rows of 16 bytes

  always_comb begin
    cmd_o = '0;
    cmd_o[can_pkg::TimeExt]  = apply_i;
    cmd_o[can_pkg::TimeRead] = take_i;
  end

  logic       here_q;
  logic [1:0] word_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      here_q <= 1'b0;
      word_q <= '0;
    end else if (re_i) begin
      here_q <= raddr_i[9:2] == Row;
      word_q <= raddr_i[1:0];
    end
  end

  logic [31:0] word;
  always_comb begin
    case (word_q)
      2'd0:    word = stat_i;
      2'd1:    word = ofs_i;
      2'd2:    word = ext_i[31:0];
      default: word = ext_i[63:32];
    endcase
  end
  assign rdata_o = here_q ? word : rdata_i;

endmodule
