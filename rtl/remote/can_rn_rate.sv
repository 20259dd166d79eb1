// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_rn_rate: the search for the bit rate (RN-73): before the node joins the bus, its engine only
// listens, at one rate after the other. Two errors without a valid frame: the next; two valid
// frames: the right one. Two edges to dominant are two bits apart at least, so where there is no
// sample point between them, the rate is too low; that is an error, too, and the only one where
// all sample points fall between frames. A rate is also rejected after 256
// edges without a valid frame.

module can_rn_rate #(
  parameter int Rows = 8
) (
  input  logic       clk_i,
  input  logic       rst_ni,
  input  logic       start_i,    // user logic has set up the RAM
  input  logic [3:0] rate_i,     // row of the table; where there is none: search
  input  logic       run_i,      // the node is on the bus
  input  logic       error_i,    // pulses of the engine
  input  logic       valid_i,
  input  logic       tick_i,     // sample point
  input  logic       level_i,    // of the bus, while the engine listens
  output logic       start_o,    // the rate is known: join the bus
  output logic       listen_o,   // engine: listen
  output logic       run_o,      // .. at this row
  output logic [3:0] row_o
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
