  // SPDX-FileCopyrightText: 2026 The VeriCAN authors
  // SPDX-License-Identifier: Apache-2.0
  //
  // Properties of can_rn_rate, spliced into it: any bus, any engine, any row asked for.

  // What has been seen at this row: a valid frame; an error since the last one; an edge since the
  // last sample point.
  logic       f_ran, f_valid, f_error, f_edge, f_level;
  logic [3:0] f_row;
  logic       f_same, f_fall, f_error_now, f_second, f_many;
  assign f_same      = row_o == f_row;
  assign f_fall      = f_level && !level_i;
  assign f_error_now = error_i || (f_fall && f_edge && f_same);
  assign f_second    = f_error_now && f_error && f_same;
  assign f_many      = f_fall && edges_q == 8'd255;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {f_ran, f_valid, f_error, f_edge} <= '0;
      f_level <= 1'b1;
      f_row   <= '0;
    end else begin
      f_ran   <= 1'b1;
      f_row   <= row_o;
      f_level <= level_i;
      f_valid <= listen_o && ((f_valid && f_same) || valid_i);
      f_error <= listen_o && !valid_i && ((f_error && f_same) || f_error_now);
      f_edge  <= listen_o && (f_fall || (f_edge && f_same && !tick_i));
    end
  end

  always @(posedge clk_i) begin
    // Reset in the first clock, none later.
    m_reset: assume (rst_ni == !$initstate);
    // The row that is asked for is a pin of the board.
    m_rate: assume (!f_ran || rate_i == $past(rate_i));
    // A frame is not valid and in error at once.
    m_one: assume (!(valid_i && error_i));
    if (f_ran) begin
      // RN-73: the row is one of the table, whatever is asked for.
      p_row: assert (row_o < 4'(Rows));
      // RN-73: a row is taken for the right one behind the second valid frame at it.
      p_found: assert (!found_q || $past(found_q || (listen_o && valid_i && f_valid && f_same)));
      // RN-73: before that the node joins no bus whose rate it looks for; else it does at once.
      p_joins: assert (start_o == (start_i && (rate_i < 4'(Rows) || found_q)));
      // RN-73: it leaves a row for two errors without a valid frame, or 256 such edges.
      p_leaves: assert (row_o == $past(row_o) || !$past(listen_o) || $past(f_second || f_many));
      // RN-73: and then it does.
      p_left: assert (!$past(listen_o && search && !run_i && !found_q && !valid_i && f_same
                             && (f_second || f_many)) || row_o != $past(row_o));
      // RN-73: edges are counted one by one, from 0 at each row and behind each valid frame.
      p_edges: assert (edges_q == ($past(!listen_o || valid_i || f_second || f_many)
                                   ? 8'd0 : $past(edges_q) + {7'd0, $past(f_fall)}));
      // BT-11: the engine does not run while its timing changes.
      p_pause: assert (row_o == $past(row_o) || !run_o || !$past(listen_o));
      // RN-73: on the bus and off it before the start it does not listen.
      p_listens: assert (!listen_o || $past(!run_i && start_i && search));
    end
  end
