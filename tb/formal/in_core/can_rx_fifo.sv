  // SPDX-FileCopyrightText: 2026 The VeriCAN authors
  // SPDX-License-Identifier: Apache-2.0
  //
  // What host.fifo assumes of can_mb_move.

  logic [1:0] f_way;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni)      f_way <= '0;
    else if (clear_i) f_way <= '0;
    else              f_way <= f_way + 2'(resolve_i && take_o) - 2'(stored_i);
  end

  always @(posedge clk_i) if (rst_ni) begin
    m_stored: assert ((!stored_i || f_way != 2'd0) && !(resolve_i && f_way == 2'd2));
    m_way: assert (clear_i
                   || {1'b0, fifo_in_flight_i[0]} + {1'b0, fifo_in_flight_i[1]} == f_way);
  end
