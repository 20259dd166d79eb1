  // SPDX-FileCopyrightText: 2026 The VeriCAN authors
  // SPDX-License-Identifier: Apache-2.0
  //
  // Properties of can_rn_guard, spliced into it: any job, any address, any tables.

  logic f_ran = 1'b0;
  always @(posedge clk_i) f_ran <= 1'b1;

  // The byte and bit of WP or RP that an address has, in words of the specification.
  logic [4:0] f_page;
  logic [8:0] f_table, f_byte;
  logic       f_bit, f_hit;
  assign f_page  = mem_i[11:7];
  assign f_table = read_i ? 9'h110 : 9'h108;
  assign f_byte  = f_table + (f_page == 5'd0 ? 9'd4 : {7'd0, f_page[4:3]});
  assign f_bit   = 1'(byte_i >> (f_page == 5'd0 ? mem_i[6:4] : f_page[2:0]));
  assign f_hit   = job_i == can_rn_pkg::JobGuard && late_i && memory_i && f_page < 5'd28 && f_bit;

  always @(posedge clk_i) begin
    m_no_reset: assume (rst_ni);
    // RN-32: the byte that is looked at is that of WP for a write, of RP for a read.
    p_byte: assert (!guard_o || cell_o == f_byte);
    if (f_ran) begin
      // RN-32, RN-102 P-1: an access that a bit forbids is denied, until the node is done with it.
      p_denied: assert (!$past(f_hit) || denied_o);
      p_stays: assert (!$past(denied_o && (job_i != can_rn_pkg::JobIdle || live_i))  // RN-32
                       || denied_o);
      // RN-32: and no other.
      p_only: assert (!denied_o || $past(denied_o && (job_i != can_rn_pkg::JobIdle || live_i))
                      || $past(f_hit));
    end
  end
