// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_rn_rate: the search for the bit rate (RN-73): before the node joins the bus, its engine only
// listens, at one rate after the other. Two errors without a valid frame: the next; two valid
// frames: the right one. Nor is it right where the engine sees no end of a frame for 16 ms, or no
// sample point, as each edge begins a bit anew: on a bus that is faster and never rests.

module can_rn_rate #(
  parameter int Rows = 8
) (
  input  logic       clk_i,
  input  logic       rst_ni,
  input  logic       start_i,    // user logic has set up the RAM
  input  logic [3:0] rate_i,     // row of the table; F: search
  input  logic       run_i,      // the node is on the bus
  input  logic       error_i,    // pulses of the engine
  input  logic       valid_i,
  input  logic       synch_i,    // sample point, and the engine has seen the bus at rest
  input  logic       ms_i,
  output logic       start_o,    // the rate is known: join the bus
  output logic       listen_o,   // engine: listen
  output logic       run_o,      // .. at this row
  output logic [3:0] row_o
);
  logic       search, wrong, next, error_q, valid_q, found_q, listen_q, pause_q;
  logic [3:0] row_q, wait_q;

  assign search   = &rate_i;
  assign start_o  = start_i && (!search || found_q);
  assign listen_o = listen_q;
  assign run_o    = listen_q && !pause_q;
  assign row_o    = search ? row_q : rate_i;
  assign wrong    = ms_i && (&wait_q);
  assign next     = (error_i && error_q) || wrong;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {error_q, valid_q, found_q, listen_q, pause_q} <= '0;
      row_q  <= '0;
      wait_q <= '0;
    end else begin
      listen_q <= search && start_i && !run_i && !found_q;
      found_q  <= !run_i && (found_q || (listen_q && valid_i && valid_q));
      pause_q  <= next;
      error_q  <= listen_q && !next && !valid_i && (error_q || error_i);
      valid_q  <= listen_q && !next && (valid_q || valid_i);
      if (run_i || found_q)   row_q <= row_q;
      else if (!listen_q)     row_q <= '0;
      else if (next)          row_q <= row_q == 4'(Rows - 1) ? 4'd0 : row_q + 4'd1;
      if (!listen_q || synch_i || next) wait_q <= '0;
      else if (ms_i)                    wait_q <= wait_q + 4'd1;
    end
  end
endmodule
