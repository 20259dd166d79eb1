// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_rn_tick: a pulse every millisecond. A shift register with feedback instead of a counter: it
// runs through a cycle of ClocksPerMs of its 131,071 states, because one feedback bit is turned
// where the rest of the cycle is cut out.

module can_rn_tick #(
  /// Clocks per millisecond, 8,000 to 131,071.
  parameter int ClocksPerMs = 8000
) (
  input  logic clk_i,
  input  logic rst_ni,
  input  logic kick_i,       // begins anew: whatever an upset has led to
  output logic ms_o
);
  if (ClocksPerMs < 8000 || ClocksPerMs > 131071) begin : gen_check_clocks
    ClocksPerMs_must_be_8000_to_131071 u_stop ();
  end

  // The states are the powers of x modulo x^17 + x^3 + 1, which is primitive.
  function automatic logic [16:0] power(input logic [16:0] base, input logic [16:0] exponent);
    logic [16:0] result, product;
    result = 17'd1;
    for (int i = 33; i >= 0; i--) begin        // square, multiply
      product = '0;
      for (int k = 16; k >= 0; k--) begin
        product = {product[15:0], 1'b0} ^ (17'h00009 & {17{product[16]}})
                  ^ (result & {17{i % 2 == 1 ? result[k] : base[k]}});
      end
      if (i % 2 == 1 || exponent[i / 2]) result = product;
    end
    power = result;
  endfunction
  function automatic logic [16:0] preceding(input logic [16:0] state);
    preceding = {state[0], state[16:1] ^ {13'd0, state[0], 2'd0}};
  endfunction

  // ClocksPerMs steps lead from First to First + 1, as First (x^ClocksPerMs + 1) = 1; one bit more
  // turned makes it First. The whole cycle needs no cut.
  localparam bit Whole = ClocksPerMs == 131071;
  localparam logic [16:0] Factor = power(17'd2, 17'(ClocksPerMs)) ^ 17'd1;
  localparam logic [16:0] First  = Whole ? 17'd1 : power(Factor, 17'h1FFFE);   // its inverse
  localparam logic [16:0] Last   = preceding(Whole ? First : First ^ 17'd1);

  // Constants, but for the simulator, which has clocks of any rate.
  logic [16:0] state_q /* verilator public_flat_rw */;
  logic [16:0] last_state /* verilator public_flat_rw */;
  logic        last;
  assign last_state = Last;
  assign last = state_q == last_state;
  assign ms_o = last;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      state_q <= First;
    end else if (kick_i) begin
      state_q <= First;
    end else begin
      state_q    <= {state_q[15:0], state_q[16]} ^ {13'd0, state_q[16], 3'd0};
      state_q[0] <= state_q[16] ^ (last && !Whole);
    end
  end

endmodule
