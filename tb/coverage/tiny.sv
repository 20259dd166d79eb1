// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// tiny: a module whose coverage points can be listed by hand, for machinery.py; with a package that
// has some, too.

package tiny_pkg;
  function automatic logic [1:0] other(input logic [2:0] in);
    other = {2{|in[2:1]}};
  endfunction
endpackage

module tiny (
  input  logic       clk_i,
  input  logic       rst_ni,
  input  logic [2:0] in_i,
  output logic [1:0] state_q,
  output logic       seen_q
);
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      state_q <= 2'd2;
      seen_q  <= 1'b1;
    end else begin
      case (in_i)
        3'd0:    state_q <= 2'd0;
        3'd1:    state_q <= 2'd1;
        default: state_q <= tiny_pkg::other(in_i);
      endcase
      if (in_i == 3'd1) seen_q <= 1'b0;
    end
  end
endmodule
