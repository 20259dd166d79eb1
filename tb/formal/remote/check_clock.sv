  // SPDX-FileCopyrightText: 2026 The VeriCAN authors
  // SPDX-License-Identifier: Apache-2.0
  //
  // Properties of the row of the clock (TM-108), spliced into can_rn_check with Clock = 1: any
  // request to any node, as in check.sv.

  logic f_ran = 1'b0;
  always @(posedge clk_i) f_ran <= 1'b1;

  logic [12:0] f_first, f_last;
  logic        f_far, f_touches, f_inside, f_read, f_write;
  assign f_far     = far_o && !bad_function;
  assign f_first   = {1'b0, start_i};
  assign f_last    = f_first + {9'd0, end_i} - 13'd3;   // the row begins with the address
  assign f_inside  = f_first >= 13'hFC0 && f_last < 13'hFD0;
  assign f_touches = f_first < 13'hFD0 && f_last >= 13'hFC0;
  assign f_read    = f_far && read;
  assign f_write   = f_far && write;

  always @(posedge clk_i) begin
    m_no_reset: assume (rst_ni);
    m_end: assume (!(far_o && a_i[0]) || end_i == dlc_i);
    m_count: assume (!(far_o && !a_i[0]) || value_bad_i || (end_i >= 4'd3 && end_i <= 4'd8));
    m_port: assume (port_i == (!sys_i && (&a_i[AddrBits-1:3])));
    if (f_ran) begin
      // TM-108: a read that touches the row and is not refused lies in it.
      p_row: assert (code_o != can_rn_pkg::CodeOk || !$past(f_read && f_touches)
                     || $past(f_inside));
      // TM-108: one that lies in it is not refused for its address.
      p_readable: assert (code_o != can_rn_pkg::CodeAddress
                          || !$past(f_read && f_inside && !high_bad_i));
      // TM-108: no write touches it.
      p_kept: assert (code_o != can_rn_pkg::CodeOk || !$past(f_write && f_touches));
    end
  end
