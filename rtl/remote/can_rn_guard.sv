// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_rn_guard: protection of the memory against writes (WP at 0xF08) and reads (RP at 0xF10) of
// the bus. JobGuard fetches the protection bits of the first and of the last byte of an access;
// either of them denies it. A bit covers a page of 128 bytes, in page 0 (fifth byte of WP, RP) 16
// bytes.

module can_rn_guard (
  input  logic             clk_i,
  input  logic             rst_ni,
  input  can_rn_pkg::job_t job_i,      // present job
  input  logic             late_i,     // phase 2 or 3: byte_i belongs to mem_i
  input  logic             live_i,     // a frame for this node is under way
  input  logic             memory_i,   // request reads or writes the memory
  input  logic             read_i,     // request reads
  input  logic [11:4]      mem_i,      // first byte in phases 0 and 2, else last byte
  input  logic [7:0]       byte_i,     // protection byte addressed two phases before
  output logic             guard_o,    // JobGuard runs
  output logic [8:0]       cell_o,     // protection byte to read; 0 outside of JobGuard
  output logic             denied_o    // access is denied
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
    // For a map entry JobGuard runs before its frame is valid: the result is kept while it is live.
    else if (job_i == can_rn_pkg::JobIdle && !live_i) denied_q <= 1'b0;
    else if (guard_o && late_i && memory_i && !config_area && byte_i[index])
                                             denied_q <= 1'b1;
  end
endmodule
