  // SPDX-FileCopyrightText: 2026 The VeriCAN authors
  // SPDX-License-Identifier: Apache-2.0
  //
  // What time.row assumes of the engine, the port and can_mb_move.

  logic        f_granted, f_told, f_valid;
  logic [63:0] f_stamp;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {f_granted, f_told, f_valid} <= '0;
      f_stamp <= '0;
    end else begin
      f_granted <= re_i && !cpu_i && !mv_data_i;
      f_told    <= !start_i && (f_told || we_i);
      f_valid   <= !start_i && (f_valid || rx_valid_i);
      if (we_i) f_stamp <= stamp_i;
    end
  end

  always @(posedge clk_i) if (rst_ni) begin
    m_data: assert (!mv_data_i || f_granted);
    m_once: assert (!we_i || (!f_told && !start_i));
    m_stamped: assert (!start_i || !f_valid || f_told);
    m_kept: assert (!write_q || stamp_i == f_stamp);
    m_long: assert (!start_i || !write_q);
    m_valid: assert (!rx_valid_i || (!f_valid && !start_i));
    m_own: assert (!(own && write_q && !word_q[1] && mv_data_i && cur_idx_i == mv_idx_i));
  end
