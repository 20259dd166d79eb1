  // SPDX-FileCopyrightText: 2026 The VeriCAN authors
  // SPDX-License-Identifier: Apache-2.0
  //
  // Properties of can_rn_map, spliced into it: any order of jobs, any entries in the RAM.

  logic f_ran, f_ran_q;
  always_ff @(posedge clk_i or negedge rst_ni)
    if (!rst_ni) {f_ran, f_ran_q} <= '0;
    else         {f_ran, f_ran_q} <= {1'b1, f_ran};

  // Whether the entry that has been read takes the identifier: RN-65, bit by bit.
  logic        f_takes;
  logic [10:0] f_same;
  always_comb begin
    for (int i = 0; i < 11; i++) f_same[i] = !rdata_i[16 + i] || rdata_i[i] == id_i[i];
    f_takes = rdata_i[15] && (&f_same);
    // The last eight values of A are ports.
    if (id_i[AddrBits-1:0] >= AddrBits'((1 << AddrBits) - 8))
      for (int i = 0; i < AddrBits; i++) f_takes = f_takes && rdata_i[16 + i];
  end

  // Whether an entry was late in this pass over all of them: told in the clock behind.
  logic f_none, f_late, f_late_q, f_flag_q, f_unsafe;
  assign f_none = rdata_i[31:24] == 8'd0;
  assign f_late = job_i == can_rn_pkg::JobLate && (&phase_i) && on_q && !f_none
                  && !taken_q && !fresh_q && !off_q
                  && (byte_i > rdata_i[31:24] || (byte_i == 8'hFF && stale_o)
                      || (count_q && byte_i == rdata_i[31:24]));
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) {f_late_q, f_flag_q, f_unsafe} <= '0;
    else begin
      {f_late_q, f_flag_q} <= {f_late, rdata_i[22]};
      f_unsafe <= !(ends_q || !run_i) && (f_unsafe || (f_late_q && f_flag_q));
    end
  end

  always @(posedge clk_i) begin
    // Reset in the first clock, none later.
    m_reset: assume (rst_ni == !$initstate);
    if (f_ran) begin
      // RN-65: the search ends with an entry that takes the frame,
      p_takes: assert (!hit_o || $past(find && phase_i[0] && f_takes));
      // RN-65: the first that does: it does not go on behind one.
      p_first: assert (!$past(find && phase_i[0] && f_takes) || !find || phase_i[0] || !find_o);
      // RN-65: which one it was is kept until the next search.
      p_found: assert (!hit_o || found_q == $past(row_i[IndexWidth-1:0]));
      // RN-65: a frame is taken by an entry only where one has been found.
      p_mapped: assert (!mapped_q || $past(mapped_q && !take_i) || $past(hit_o));
      // RN-46, RN-65: it acts as a TRIGGER only where the entry says so.
      p_acts: assert (!act_q || $past(act_q && !take_i) || $past(aim_o && rdata_i[21]));
      // RN-66: STALE is told at the end of a pass, and not off the bus.
      p_stale: assert (stale_o == $past(stale_o) || $past(ends_q || !run_i));
      p_off: assert (!$past(!run_i) || (!stale_o && !unsafe_o)); // RN-60, RN-66
      // RN-66, RN-70: only an entry that is late and has its flag leads to SAFE.
      p_unsafe: assert (!unsafe_o || stale_o);
      p_leads: assert (!(unsafe_o && !$past(unsafe_o))                    // RN-70
                       || $past(f_unsafe || (f_late_q && f_flag_q)));
      // RN-66: tens of milliseconds do not begin anew behind 255.
      p_no_wrap: assert (!we_o || byte_i != 8'hFF || taken_q || fresh_q || off_q);
      // RN-66: an entry that is off, or has no time-out, is not late; nor is one whose time begins.
      p_watched: assert (!$past(ends_late && (!on_q || f_none || taken_q), 2) || !f_ran_q
                         || (any_q == $past(any_q && !ends_q && run_i)));
    end
  end
