// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_rn_time: the clock of a node without a processor (TM-106 to TM-109): what its time unit is
// asked, and the row of it that the bus and user logic read at 0xFC0 instead of the RAM.

module can_rn_time (
  input  logic        clk_i,
  input  logic        rst_ni,
  // Access of the RAM, and what the RAM gives in the clock after
  input  logic        re_i,
  input  logic [9:0]  raddr_i,    // words
  input  logic [31:0] rdata_i,
  output logic [31:0] rdata_o,
  // Node
  input  logic        apply_i,    // staged bytes are visible
  input  logic        take_i,     // user logic asks for the time of this clock
  // Time unit, see can_core
  input  logic [31:0] stat_i,     // TSSTAT
  input  logic [31:0] ofs_i,      // TSOFS
  input  logic [63:0] ext_i,      // time of the last apply_i
  output logic [can_pkg::TimeCmdWidth-1:0] cmd_o
);
  localparam logic [7:0] Row = 8'hFC;   // of 16 bytes

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
