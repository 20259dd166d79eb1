// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_rn_map: what the node takes over from frames that are no requests to it (RN-65, RN-66). At
// the header the entries are searched; a frame that one of them takes is then carried out as a
// write. Time-outs are counted each 10 ms.
//   0x08C one byte each 16: tens of ms since the last frame of an entry
//   0x180 the entries

module can_rn_map #(
  parameter int NameBits = 3,
  /// Entries, 4 or 8.
  parameter int NumMap = 8
) (
  input  logic             clk_i,
  input  logic             rst_ni,
  input  can_rn_pkg::job_t job_i,
  input  logic [1:0]       phase_i,
  input  logic             run_i,
  input  logic             visit_i,    // a producer is looked at
  input  logic             ten_i,      // 10 ms have passed
  // Frame
  input  logic             take_i,     // a header is taken over
  input  logic [10:0]      id_i,       // from the clock after take_i on
  input  logic [3:0]       row_i,      // JobFind: two clocks an entry
  input  logic             begin_i,    // its work begins
  input  logic             refused_i,
  // RAM
  input  logic [31:0]      rdata_i,
  input  logic             zero_i,     // the byte read is 0,
  input  logic             above_i,    // more than the one before, or 255
  input  logic             equal_i,    // as much
  output logic             find_o,     // JobFind goes on
  output logic             hit_o,      // and has found one
  output logic             aim_o,      // JobAim: rdata_i is what the entry says of its place
  output logic             mapped_o,   // this frame is taken by an entry
  output logic             act_o,      // as a TRIGGER, too
  output logic             acts_o,     // what is carried out is the TRIGGER
  output logic             want_o,     // a time-out is to be looked at
  output can_rn_pkg::job_t next_o,     // by this
  output logic             zero_o,     // JobLate: the time begins anew
  output logic             cell_own_o, // the byte that is meant is ..
  output logic [8:0]       cell_o,
  output logic             more_o,     // one more is written
  output logic             re_o,
  output logic             we_o,
  // State
  output logic             stale_o,
  output logic             unsafe_o,   // STALE leads to SAFE
  output logic             told_o      // pulse: both are known anew
);
  localparam int AddrBits   = 10 - NameBits;
  localparam int IndexWidth = $clog2(NumMap);

  logic idle, find, aim, zero, look, late, last;
  assign idle = job_i == can_rn_pkg::JobIdle;
  assign find = job_i == can_rn_pkg::JobFind;
  assign aim  = job_i == can_rn_pkg::JobAim;
  assign zero = job_i == can_rn_pkg::JobKeep && !visit_i;
  assign look = job_i == can_rn_pkg::JobLook;
  assign late = job_i == can_rn_pkg::JobLate;
  assign last = phase_i[1];

  // An entry: ID and bit 15 on, mask. A port's frame needs a mask that compares all of A.
  logic port, match, hit_q, mapped_q, act_q, acts_q;
  logic [IndexWidth-1:0] found_q;
  assign port  = &id_i[AddrBits-1:3];
  assign match = rdata_i[15] && !(|((rdata_i[10:0] ^ id_i) & rdata_i[26:16]))
                 && (!port || (&rdata_i[16 +: AddrBits]));
  assign hit_o  = find && hit_q && !phase_i[0];
  assign find_o = !phase_i[0] ? !hit_q && row_i != 4'(NumMap) : 1'b1;
  assign aim_o  = aim && phase_i[0];
  assign mapped_o = mapped_q && !visit_i;
  assign act_o    = act_q;
  assign acts_o   = acts_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {hit_q, mapped_q, act_q, acts_q} <= '0;
      found_q <= '0;
    end else begin
      hit_q <= find && phase_i[0] && match;
      if (find && phase_i[0]) found_q <= row_i[IndexWidth-1:0];
      if (take_i || hit_o) mapped_q <= hit_o;
      if (take_i || aim_o) act_q <= aim_o && rdata_i[21];
      acts_q <= mapped_q && (job_i == can_rn_pkg::JobTrigger || (acts_q && !idle));
    end
  end

  // A pass over all entries every 10 ms, and one that only looks after each frame that was taken;
  // after a start one that begins all times anew.
  logic [IndexWidth-1:0] k_q;
  logic ten_q, again_q, taken_q, fresh_q, pass_q, count_q, watch_q, leads_q, told_q;
  logic any_q, unsafe_any_q, stale_q, unsafe_q;
  logic over, leave, done, ends;
  // Counted before it is compared.
  assign over    = late && (&phase_i) && watch_q && (above_i || (count_q && equal_i));
  assign leave   = !watch_q && !taken_q;
  assign zero_o  = !watch_q;
  assign want_o  = pass_q || taken_q;
  assign next_o  = taken_q ? can_rn_pkg::JobKeep : can_rn_pkg::JobLook;
  assign done    = (late && (&phase_i) && watch_q) || (zero && last && leave);
  assign ends    = done && (&k_q);
  assign told_o  = told_q;
  assign stale_o  = stale_q;
  assign unsafe_o = unsafe_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {ten_q, again_q, taken_q, fresh_q, pass_q, count_q} <= '0;
      k_q <= '0;
    end else begin
      ten_q   <= ten_i || !run_i || (ten_q && !(idle && !pass_q));
      again_q <= (zero && last && taken_q) || (again_q && (ten_q || !(idle && !pass_q)));
      taken_q <= (begin_i && mapped_q && !refused_i) || (taken_q && !(zero && last));
      fresh_q <= !run_i || (fresh_q && !ends);
      if (idle && !pass_q) count_q <= ten_q;
      pass_q  <= run_i && ((idle && (ten_q || again_q)) || pass_q) && !ends;
      if (!run_i)    k_q <= '0;
      else if (done) k_q <= k_q + 1'b1;
    end
  end

  // An entry that is off, or has no time-out, is not watched.
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {watch_q, leads_q, any_q, unsafe_any_q, stale_q, unsafe_q, told_q} <= '0;
    end else begin
      if (look)                             watch_q <= rdata_i[15] && !fresh_q;
      else if (late && phase_i == 2'd2)     watch_q <= watch_q && !zero_i;
      if (late && phase_i == 2'd1)          leads_q <= rdata_i[22];
      told_q       <= ends;
      any_q        <= !ends && run_i && (any_q || over);
      unsafe_any_q <= !ends && run_i && (unsafe_any_q || (over && leads_q));
      if (ends || !run_i) begin
        stale_q  <= run_i && (any_q || over);
        unsafe_q <= run_i && (unsafe_any_q || (over && leads_q));
      end
    end
  end

  // Bytes
  logic [2:0] k;
  assign k          = find ? row_i[2:0] : aim || (zero && taken_q) ? 3'(found_q) : 3'(k_q);
  assign more_o     = late;
  assign cell_own_o = find || aim || zero || look || late;
  assign re_o       = (cell_own_o && !phase_i[0]) || late;
  assign we_o       = late && (&phase_i) && watch_q && count_q && !above_i;
  always_comb begin
    cell_o = {3'b110, k, aim || late, late, late};
    if (zero && !last)                cell_o = 9'h006;
    if (last ? zero : late && phase_i[0]) cell_o = {2'b01, k, 4'hC};
    if (late && last)                 cell_o = {2'b01, k, 4'hC};
    if (!cell_own_o)                  cell_o = '0;
  end
endmodule
