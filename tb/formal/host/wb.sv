  // SPDX-FileCopyrightText: 2026 The VeriCAN authors
  // SPDX-License-Identifier: Apache-2.0
  //
  // Properties of can_wb, spliced into it: a Wishbone B4 slave, classic and pipelined. The model
  // beside it keeps the transfer whose answer is due (f_due): to be ERR (f_bad), given to the core
  // (f_given), its write data of the clock in which it was taken (f_dat).

  localparam logic FClassic = Pipelined == 0;
  logic f_due, f_bad, f_given, f_first, f_fresh, f_low, f_taken, f_outside, f_answer, f_waits;
  logic [31:0] f_place, f_dat;
  logic [66:0] f_pins, f_pins_q;
  assign f_place   = {wb_adr_i, 2'd0} % (33'd1 << RegionBits);
  assign f_outside = f_place >= 32'd8192;
  assign f_answer  = wb_ack_o || wb_err_o;
  assign f_taken   = wb_cyc_i && wb_stb_i && (FClassic ? !f_due : !wb_stall_o);
  assign f_waits   = wb_cyc_i && (!FClassic || wb_stb_i);
  assign f_pins    = {wb_adr_i, wb_we_i, wb_sel_i, wb_dat_i};
  always_ff @(posedge wb_clk_i or posedge wb_rst_i) begin
    if (wb_rst_i) begin
      {f_due, f_bad, f_given, f_first, f_fresh, f_low} <= '0;
    end else begin
      f_due    <= f_taken || (f_due && f_waits && !f_answer);
      f_first  <= f_taken;
      f_low    <= !wb_cyc_i;
      f_fresh  <= wb_cyc_i && (f_fresh || f_taken);
      f_pins_q <= f_pins;
      if (f_taken) {f_bad, f_given, f_dat} <= {f_outside, trace_o[0], wb_dat_i};
    end
  end

  always @(posedge wb_clk_i) begin
    // Reset in the first clock, none later.
    m_reset: assume (wb_rst_i == $initstate);
    // Classic: who waits holds everything.
    m_held: assume (!FClassic || !f_due || !f_waits || f_pins == f_pins_q);
    // PK-17: no answer in reset.
    p_reset: assert (!wb_rst_i || !f_answer);
    if (!wb_rst_i) begin
      // WB-ANSWER: one answer, not two.
      p_one_answer: assert (!(wb_ack_o && wb_err_o));
      // WB-ANSWER, PK-12: no answer without a transfer that waits for it.
      p_answer: assert (!f_answer || (f_due && f_waits));
      // PK-25: ... nor for one that was taken before CYC was low.
      p_dropped: assert (!f_answer || f_fresh);
      // WB-ANSWER, PK-15: ERR is the answer outside the window and nowhere else.
      p_error: assert (!f_answer || wb_err_o == f_bad);
      // PK-12: the answer comes in the core's data phase of the command,
      p_data_phase: assert (!(f_due && f_waits) || f_answer == ready);
      // PK-24: which is the next clock, or one later,
      p_one_wait: assert (!(f_due && f_waits) || f_first || f_answer);
      // PK-15: ... the next where the core was not asked.
      p_no_wait: assert (!(f_due && f_waits) || f_given || f_answer);
      // WB-STALL: STALL only while an answer is due; classic: CYC without answer.
      p_stall: assert (FClassic ? wb_stall_o == (wb_cyc_i && !f_answer) : !wb_stall_o || f_due);
      // PK-25: what was dropped does not hold up the next cycle.
      p_again: assert (!f_low || !(wb_cyc_i && wb_stb_i) || (FClassic ? taken : !wb_stall_o));
      // WB-TAKEN, PK-12, PK-14: a command is exactly a transfer that is taken, inside the window,
      // with a lane if it writes.
      p_command: assert (trace_o[0] == (f_taken && !f_outside && !(wb_we_i && wb_sel_i == 4'd0)));
      // WB-TAKEN: it carries direction and word of the address.
      p_address: assert (!trace_o[0] || trace_o[12:1] == {wb_adr_i[12:2], wb_we_i});
      // PK-13: it has the lanes of SEL.
      p_lanes: assert (!trace_o[0] || trace_o[16:13] == wb_sel_i);
      // PK-14, PK-24: write data are those that came with the strobe.
      p_write_data: assert (!(f_due && f_waits) || trace_o[48:17] == (FClassic ? wb_dat_i : f_dat));
      // PK-15: read data are the core's, or 0 outside the window.
      p_read_data: assert (!f_answer || wb_dat_o == (f_bad ? 32'd0 : rdata));
    end
  end
