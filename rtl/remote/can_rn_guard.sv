// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_rn_guard: protection of the memory against the bus (WP at F08, RP at F10): the bit of the
// first and that of the last byte of an access. A bit is that of a page of 128 bytes; page 0 has
// one for each 16 bytes, in the fifth byte.

module can_rn_guard (
  input  logic             clk_i,
  input  logic             rst_ni,
  input  can_rn_pkg::job_t job_i,
  input  logic             late_i,     // the byte read in the phase before the last is there
  input  logic             live_i,     // a frame for this node is under way
  input  logic             memory_i,   // the request reads or writes
  input  logic             read_i,
  input  logic [11:4]      mem_i,      // first and last byte in turn
  input  logic [7:0]       byte_i,     // byte read, two phases later
  output logic             guard_o,    // JobGuard
  output logic [8:0]       cell_o,
  output logic             denied_o
);
  logic       first_page, config_area, denied_q;
  logic [2:0] index;
  assign first_page  = !(|mem_i[11:7]);
  assign config_area = &mem_i[11:9];
  assign index       = first_page ? mem_i[6:4] : mem_i[9:7];
  assign guard_o     = job_i == can_rn_pkg::JobGuard;
  assign cell_o      = {4'b1000, read_i, !read_i, first_page, mem_i[11:10] & {2{!first_page}}}
                       & {9{guard_o}};
  assign denied_o    = denied_q;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni)                                      denied_q <= 1'b0;
    // What a map entry takes is looked at before the frame is valid.
    else if (job_i == can_rn_pkg::JobIdle && !live_i) denied_q <= 1'b0;
    else if (guard_o && late_i && memory_i && !config_area && byte_i[index])
                                             denied_q <= 1'b1;
  end
endmodule
