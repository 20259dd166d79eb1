// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_rn_map: what the node takes over from frames that are no requests to it (RN-65, RN-66). At
// the header the entries are searched; a frame that one of them takes is then carried out as a
// write. Time-outs are counted each 10 ms.
//   0x08C one byte each 16: tens of ms since the last frame of an entry, 255 at most
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
  input  logic             visit_i,    // a frame is made
  input  logic             ten_i,      // 10 ms have passed
  // Frame
  input  logic             take_i,     // a header is taken over
  input  logic [10:0]      id_i,       // from the clock after take_i on
  input  logic [3:0]       row_i,      // JobFind: two clocks an entry
  input  logic             begin_i,    // its work begins
  input  logic             write_i,    // it has bytes
  input  logic             refused_i,
  // RAM
  input  logic [31:0]      rdata_i,
  input  logic [7:0]       byte_i,     // byte read before
  output logic             find_o,     // JobFind goes on
  output logic             hit_o,      // and has found one
  output logic             aim_o,      // JobAim: rdata_i is what the entry says of its place
  output logic             mapped_o,   // this frame is taken by an entry
  output logic             act_o,      // as a TRIGGER, too
  output logic             acts_o,     // its bytes are copied, and now the stage
  output logic             want_o,     // JobLate is due
  output logic [8:0]       cell_o,     // the byte that is meant
  output logic             more_o,     // one more is written
  output logic             we_o,
  // State
  output logic             stale_o,
  output logic             unsafe_o,   // STALE leads to SAFE
  output logic             told_o      // pulse: both are known anew
);
  localparam int AddrBits   = 10 - NameBits;
  localparam int IndexWidth = $clog2(NumMap);

  logic idle, find, aim, late, ends_late;
  assign idle = job_i == can_rn_pkg::JobIdle;
  assign find = job_i == can_rn_pkg::JobFind;
  assign aim  = job_i == can_rn_pkg::JobAim;
  assign late = job_i == can_rn_pkg::JobLate;
  assign ends_late = late && (&phase_i);

  // An entry: ID and bit 15 on, mask. A port's frame needs a mask that compares all of A.
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

  // A pass over all entries every 10 ms, and one that only looks after each frame that was taken;
  // after a start one that begins all times anew.
  logic [IndexWidth-1:0] k_q;
  logic ten_q, again_q, taken_q, fresh_q, pass_q, count_q, on_q, off_q, told_q;
  logic over_q, flag_q, ends_q, any_q, unsafe_any_q, stale_q, unsafe_q;
  logic anew, over, done, ends;
  // JobLate reads ID with on, time, time-out with flags; the time is compared as it will be
  // counted. It begins anew at a start, with a frame, and in a second look at an entry that is off.
  assign anew    = taken_q || fresh_q || off_q;
  logic [7:0] limit_byte;
  logic       full;
  assign limit_byte = rdata_i[31:24];
  assign full    = &byte_i;
  assign over    = ends_late && on_q && !anew && (|limit_byte)
                   && ({byte_i, count_q} > {limit_byte, 1'b0} || full);
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
      // A byte of the RAM is compared in one clock, what follows from it comes in the next.
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
