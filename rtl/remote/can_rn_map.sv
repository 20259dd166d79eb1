// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_rn_map: map entries (RN-65, RN-66). They copy frames that are no requests to this node into
// its memory. After the header JobFind searches the entries; the frame that one of them takes is
// then carried out as a write. Every 10 ms, and after each such frame, JobLate updates the
// time-outs.
//   0x08C   one byte in each row of 16: time since the entry's last frame in 10 ms, 255 at most
//   0x180   the entries, 8 bytes each

module can_rn_map #(
  parameter int NameBits = 3,
  /// Entries, 4 or 8.
  parameter int NumMap = 8
) (
  input  logic             clk_i,
  input  logic             rst_ni,
  input  can_rn_pkg::job_t job_i,      // present job
  input  logic [1:0]       phase_i,    // phase of the job
  input  logic             run_i,      // node is on the bus
  input  logic             visit_i,    // a frame is made that nobody has requested
  input  logic             ten_i,      // pulse: every 10 ms
  // Frame
  input  logic             take_i,     // pulse: a header is taken over
  input  logic [10:0]      id_i,       // identifier, good from the clock after take_i on
  input  logic [3:0]       row_i,      // JobFind: entry, two clocks each
  input  logic             begin_i,    // pulse: work of the frame begins
  input  logic             write_i,    // frame has data bytes
  input  logic             refused_i,  // frame is refused
  // RAM
  input  logic [31:0]      rdata_i,    // word read
  input  logic [7:0]       byte_i,     // byte read, one clock after rdata_i
  output logic             find_o,     // JobFind continues
  output logic             hit_o,      // JobFind has found an entry
  output logic             aim_o,      // JobAim: rdata_i has address, length and flags
  output logic             mapped_o,   // frame is taken by an entry
  output logic             act_o,      // that entry acts as a TRIGGER
  output logic             acts_o,     // its copy of the stage begins or is under way
  output logic             want_o,     // JobLate is due
  output logic [8:0]       cell_o,     // byte to read or write; 0: none
  output logic             more_o,     // JobLate: the time + 1 is written
  output logic             we_o,       // JobLate: the time is written
  // State
  output logic             stale_o,    // an entry has exceeded its time-out
  output logic             unsafe_o,   // such an entry leads to SAFE
  output logic             told_o      // pulse: stale_o and unsafe_o have been updated
);
  localparam int AddrBits   = 10 - NameBits;
  localparam int IndexWidth = $clog2(NumMap);

  logic idle, find, aim, late, ends_late;
  assign idle = job_i == can_rn_pkg::JobIdle;
  assign find = job_i == can_rn_pkg::JobFind;
  assign aim  = job_i == can_rn_pkg::JobAim;
  assign late = job_i == can_rn_pkg::JobLate;
  assign ends_late = late && (&phase_i);

  // First word of an entry: mask in 26:16, on in 15, ID in 10:0. A frame to a port needs a mask
  // that compares all of A.
  logic port, match, copied, hit_q, mapped_q, act_q, acts_q;
  logic [IndexWidth-1:0] found_q;
  assign port  = &id_i[AddrBits-1:3];
  assign match = rdata_i[15] && !(|((rdata_i[10:0] ^ id_i) & rdata_i[26:16]))
                 && (!port || (&rdata_i[16 +: AddrBits]));
  assign hit_o  = find && hit_q && !phase_i[0];
  assign find_o = !phase_i[0] ? !hit_q && row_i != 4'(NumMap) : 1'b1;
  assign aim_o  = aim && phase_i[0];
  assign mapped_o = mapped_q && !visit_i;
  assign act_o    = act_q;
  assign copied   = job_i == can_rn_pkg::JobMove && (&phase_i);
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
      acts_q <= mapped_o && act_q && !idle && (copied || (begin_i && !write_i) || acts_q);
    end
  end

  // A pass over all entries counts the times every 10 ms, after a start it restarts them. After
  // each frame that was taken a pass updates stale_o without counting.
  logic [IndexWidth-1:0] k_q;
  logic ten_q, again_q, taken_q, fresh_q, pass_q, count_q, on_q, off_q, told_q;
  logic over_q, flag_q, ends_q, any_q, unsafe_any_q, stale_q, unsafe_q;
  logic anew, over, done, ends;
  // JobLate reads on, the time, and the time-out with flags. The time is compared as this pass will
  // have counted it. It restarts at a start, with a frame, and for an entry that is off, which is
  // looked at twice.
  assign anew    = taken_q || fresh_q || off_q;
  // The time stops at 255. With that as the limit, a pass that does not count cannot tell the last
  // 10 ms from a time that is over; what STALE says stays then.
  logic [7:0] limit_byte;
  logic       full;
  assign limit_byte = rdata_i[31:24];
  assign full    = &byte_i;
  assign over    = ends_late && on_q && !anew && (|limit_byte)
                   && ({byte_i, count_q} > {limit_byte, 1'b0} || (full && stale_q));
  assign want_o  = pass_q || taken_q;
  assign done    = ends_late && !taken_q && (on_q || anew);
  assign ends    = done && (&k_q);
  assign told_o  = told_q;
  assign stale_o  = stale_q;
  assign unsafe_o = unsafe_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {ten_q, again_q, taken_q, fresh_q, pass_q, count_q, on_q, off_q} <= '0;
      k_q <= '0;
    end else begin
      ten_q   <= ten_i || !run_i || (ten_q && !(idle && !pass_q));
      again_q <= (ends_late && taken_q) || (again_q && (ten_q || !(idle && !pass_q)));
      taken_q <= (begin_i && mapped_q && !refused_i) || (taken_q && !ends_late);
      fresh_q <= !run_i || (fresh_q && !ends);
      if (idle && !pass_q) count_q <= ten_q;
      pass_q  <= run_i && ((idle && (ten_q || again_q)) || pass_q) && !ends;
      if (late && !phase_i[1]) on_q <= rdata_i[15];
      if (ends_late && !taken_q) off_q <= !on_q && !anew;
      if (!run_i)    k_q <= '0;
      else if (done) k_q <= k_q + 1'b1;
    end
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {over_q, flag_q, ends_q, any_q, unsafe_any_q, stale_q, unsafe_q, told_q} <= '0;
    end else begin
      // Registered between the comparison of a RAM byte and what follows from it (RN-81).
      {over_q, flag_q, ends_q} <= {over, over && rdata_i[22], ends};
      told_q       <= ends_q;
      any_q        <= !ends_q && run_i && (any_q || over_q);
      unsafe_any_q <= !ends_q && run_i && (unsafe_any_q || flag_q);
      if (ends_q || !run_i) begin
        stale_q  <= run_i && (any_q || over_q);
        unsafe_q <= run_i && (unsafe_any_q || flag_q);
      end
    end
  end

  // Bytes
  logic [2:0] k;
  logic       time_cell, limit;
  assign k          = find ? row_i[2:0] : aim || taken_q ? 3'(found_q) : 3'(k_q);
  assign more_o     = late && !anew;
  assign we_o       = ends_late && (anew || (on_q && count_q && !full));
  assign time_cell  = late && phase_i[0];
  assign limit      = late && phase_i[1];
  always_comb begin
    cell_o = time_cell ? {2'b01, k, 4'hC} : {3'b110, k, aim || limit, {2{limit}}};
    if (time_cell && !phase_i[1] && anew) cell_o = 9'h006;               // a byte that is 0
    if (!(find || aim || late)) cell_o = '0;
  end
endmodule
