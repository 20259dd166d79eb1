// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_rn_tick: a pulse every millisecond. A shift register with feedback instead of a counter: it
// runs through ClocksPerMs of its 131,071 states in a circle, because some bits are turned where
// the rest is cut out. Whatever state an upset has led to, it comes back to that circle (RN-103).

module can_rn_tick #(
  /// Clocks per millisecond, 8,000 to 131,071.
  parameter int ClocksPerMs = 8000
) (
  input  logic clk_i,
  input  logic rst_ni,
  output logic ms_o
);
  if (ClocksPerMs < 8000 || ClocksPerMs > 131071) begin : gen_check_clocks
    ClocksPerMs_must_be_8000_to_131071 u_stop ();
  end

  // The states are the powers of x modulo x^17 + x^3 + 1, which is primitive.
  function automatic logic [16:0] following(input logic [16:0] state);
    following = {state[15:0], state[16]} ^ {13'd0, state[16], 3'd0};
  endfunction
  function automatic logic [16:0] power(input logic [16:0] exponent);
    logic [16:0] result, product;
    result = 17'd1;
    for (int i = 16; i >= 0; i--) begin        // square, multiply by x
      product = '0;
      for (int k = 16; k >= 0; k--) begin
        product = {product[15:0], product[16]} ^ {13'd0, product[16], 3'd0}
                  ^ (result & {17{result[k]}});
      end
      result = exponent[i] ? {product[15:0], product[16]} ^ {13'd0, product[16], 3'd0} : product;
    end
    power = result;
  endfunction

  // The last state of the circle has a single 1, so that a look at the other bits finds that of all
  // zeros, too, which no shift leaves. Where the 1 is, is free: the fewer bits are turned the
  // better. The first state is the last one times x^(1 - ClocksPerMs).
  function automatic logic [21:0] best_cut(input logic [16:0] back);   // place, turned bits
    logic [16:0] first, behind;
    logic [4:0]  ones, fewest;
    first    = back;
    behind   = 17'd2;
    fewest   = 5'd31;
    best_cut = '0;
    for (int i = 0; i < 17; i++) begin
      ones = 5'd0;
      for (int k = 0; k < 17; k++) ones = ones + {4'd0, first[k] ^ behind[k]};
      best_cut = ones < fewest ? {5'(i), first ^ behind} : best_cut;
      fewest   = ones < fewest ? ones : fewest;
      first    = {first[15:0], first[16]} ^ {13'd0, first[16], 3'd0};
      behind   = {behind[15:0], behind[16]} ^ {13'd0, behind[16], 3'd0};
    end
  endfunction
  localparam logic [21:0] Cut   = best_cut(power(17'(131072 - ClocksPerMs)));
  localparam logic [4:0]  Place = Cut[21:17];
  localparam logic [16:0] Turn  = Cut[16:0];
  localparam logic [16:0] First = Turn ^ following(17'd1 << Place);
  // 131,071 states need no cut, but zeros have to be left.
  localparam bit          Whole = ClocksPerMs == 131071;

  logic [16:0] state_q;
  logic        last;
  assign last = !(|(state_q & ~(17'd1 << Place)));
  assign ms_o = last;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) state_q <= First;
    else state_q <= following(state_q) ^ (Whole ? {16'd0, last && !state_q[Place]}
                                                : Turn & {17{last}});
  end

endmodule
