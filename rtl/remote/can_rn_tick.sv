// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_rn_tick: millisecond pulse. A linear feedback shift register (LFSR) takes the place of a
// binary counter. It passes through a cycle of ClocksPerMs states: at the end of the cycle some
// bits are inverted, which jumps over the unused states. From every state, also one reached by an
// upset, the register returns to this cycle (RN-103).

module can_rn_tick #(
  /// Clocks per millisecond, 8,000 to 131,071.
  parameter int ClocksPerMs = 8000
) (
  input  logic clk_i,
  input  logic rst_ni,
  output logic ms_o                         // pulse every ClocksPerMs clocks
);
  if (ClocksPerMs < 8000 || ClocksPerMs > 131071) begin : gen_check_clocks
    ClocksPerMs_must_be_8000_to_131071 u_stop ();
  end

  // The states are the powers of x modulo a primitive polynomial. The constants hold its terms
  // below the highest one. Among the polynomials with three or five terms, these were chosen
  // because they suit round frequencies best.
  localparam int Width  = $clog2(ClocksPerMs + 1);
  localparam int States = 2**Width - 1;
  localparam logic [16:0] Polynomial = Width == 13 ? 17'h0305    // x^9 + x^8 + x^2 + 1
                                       : Width == 14 ? 17'h0C09  // x^11 + x^10 + x^3 + 1
                                       : Width == 15 ? 17'h0003  // x + 1
                                       : Width == 16 ? 17'h1043  // x^12 + x^6 + x + 1
                                                     : 17'h0801; // x^11 + 1
  localparam logic [Width-1:0] Terms = Width'(Polynomial);

  function automatic logic [Width-1:0] following(input logic [Width-1:0] state);
    following = {state[Width-2:0], 1'b0} ^ (Terms & {Width{state[Width-1]}});
  endfunction
  function automatic logic [Width-1:0] power(input logic [Width-1:0] exponent);
    logic [Width-1:0] result, product;
    result = Width'(1);
    for (int i = Width - 1; i >= 0; i--) begin        // square, multiply by x
      product = '0;
      for (int k = Width - 1; k >= 0; k--) begin
        product = {product[Width-2:0], 1'b0} ^ (Terms & {Width{product[Width-1]}})
                  ^ (result & {Width{result[k]}});
      end
      result = product;
      if (exponent[i]) result = {result[Width-2:0], 1'b0} ^ (Terms & {Width{result[Width-1]}});
    end
    power = result;
  endfunction

  // The last state of the cycle has a single 1. Comparing only the other bits with 0 then also
  // catches the all-zero state, which shifting alone never leaves. The position of the 1 is free
  // and chosen such that few bits need an input function of their own. The first state is the last
  // one times x^(1 - ClocksPerMs).
  function automatic logic [Width+4:0] best_cut(input logic [Width-1:0] back);   // place, turned
    logic [Width-1:0] first, behind, inputs;
    logic [4:0]       ones, fewest;
    first    = back;
    behind   = Width'(2);
    fewest   = 5'd31;
    best_cut = '0;
    for (int i = 0; i < Width; i++) begin
      inputs = (first ^ behind) | {Terms[Width-1:1], 1'b0};
      ones   = 5'd0;
      for (int k = 0; k < Width; k++) ones = ones + {4'd0, inputs[k]};
      best_cut = ones < fewest ? {5'(i), first ^ behind} : best_cut;
      fewest   = ones < fewest ? ones : fewest;
      first    = {first[Width-2:0], 1'b0} ^ (Terms & {Width{first[Width-1]}});
      behind   = {behind[Width-2:0], 1'b0} ^ (Terms & {Width{behind[Width-1]}});
    end
  endfunction
  localparam logic [Width+4:0] Cut   = best_cut(power(Width'(States + 1 - ClocksPerMs)));
  localparam logic [Width-1:0] Lone  = Width'(1) << Cut[Width+4:Width];
  localparam logic [Width-1:0] Turn  = Cut[Width-1:0];
  localparam logic [Width-1:0] First = Turn ^ following(Lone);
  // If all states are used there is no jump, but the all-zero state still has to be left.
  localparam bit               Whole = ClocksPerMs == States;

  logic [Width-1:0] state_q;
  logic             last;
  assign last = !(|(state_q & ~Lone));
  assign ms_o = last;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) state_q <= First;
    else state_q <= following(state_q) ^ (Whole ? Width'(last && !(|(state_q & Lone)))
                                                : Turn & {Width{last}});
  end

endmodule
