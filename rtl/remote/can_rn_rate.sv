// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_rn_rate: automatic bit rate (RN-73). Before the node joins the bus, its engine listens at one
// row of the rate table after another. Two errors without a valid frame select the next row, two
// valid frames accept the present one. At the right rate, edges to dominant are at least two bits
// apart. Two such edges without a sample point between them therefore mean that the rate is too
// low; they count as an error, the only one seen where all sample points fall between frames. A row
// is also rejected after 256 edges without a valid frame.

module can_rn_rate #(
  parameter int Rows = 8
) (
  input  logic       clk_i,
  input  logic       rst_ni,
  input  logic       start_i,    // user logic has set up the RAM
  input  logic [3:0] rate_i,     // row of the table; beyond its rows: search
  input  logic       run_i,      // node is on the bus
  input  logic       error_i,    // pulse: the engine has found an error
  input  logic       valid_i,    // pulse: the engine has received a valid frame
  input  logic       tick_i,     // pulse: sample point
  input  logic       level_i,    // bus level; recessive unless the engine listens
  output logic       start_o,    // rate is known: join the bus
  output logic       listen_o,   // engine is in listen-only mode
  output logic       run_o,      // engine runs in listen-only mode; 0 while the row changes
  output logic [3:0] row_o       // row of the table that is used
);
  logic       search, edge_now, error, next;
  logic       error_q, valid_q, found_q, listen_q, pause_q, level_q, edge_q;
  logic [3:0] row_q;
  logic [7:0] edges_q;

  assign search   = rate_i >= 4'(Rows);
  assign start_o  = start_i && (!search || found_q);
  assign listen_o = listen_q;
  assign run_o    = listen_q && !pause_q;
  assign row_o    = search ? row_q : rate_i;
  assign edge_now = level_q && !level_i;
  assign error    = error_i || (edge_now && edge_q);
  assign next     = (error && error_q) || (edge_now && (&edges_q));

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {error_q, valid_q, found_q, listen_q, pause_q, edge_q} <= '0;
      level_q <= 1'b1;
      row_q   <= '0;
      edges_q <= '0;
    end else begin
      listen_q <= search && start_i && !run_i && !found_q;
      found_q  <= !run_i && (found_q || (listen_q && valid_i && valid_q));
      pause_q  <= next;
      level_q  <= level_i;
      edge_q   <= listen_q && !next && (edge_now || (edge_q && !tick_i));
      error_q  <= listen_q && !next && !valid_i && (error_q || error);
      valid_q  <= listen_q && !next && (valid_q || valid_i);
      if (run_i || found_q)   row_q <= row_q;
      else if (!listen_q)     row_q <= '0;
      else if (next)          row_q <= row_q >= 4'(Rows - 1) ? 4'd0 : row_q + 4'd1;
      if (!listen_q || valid_i || next) edges_q <= '0;
      else if (edge_now)                edges_q <= edges_q + 8'd1;
    end
  end
endmodule
