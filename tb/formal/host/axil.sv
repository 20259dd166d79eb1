  // SPDX-FileCopyrightText: 2026 The VeriCAN authors
  // SPDX-License-Identifier: Apache-2.0
  //
  // Properties of can_axil, spliced into it: an AXI4-Lite slave (ARM IHI 0022). The model beside it
  // keeps the transfer that the core has (f_read, f_write, f_used), the answers that are due
  // (f_r_due, f_b_due) with what they have to say, and how long a master has waited.

  logic f_read, f_write, f_used, f_last_read, f_given, f_bad, f_closed;
  logic f_r_due, f_b_due, f_r_bad, f_b_bad, f_r_held, f_b_held, f_ar, f_aw, f_outside, f_shut;
  logic f_reads, f_writes, f_r_shut, f_b_shut, f_shut_q, f_free, f_blocked;
  logic [3:0]  f_ar_wait, f_aw_wait;
  logic [31:0] f_place, f_data;
  logic [33:0] f_r_q;
  logic [1:0]  f_b_q;
  logic [34:0] f_ar_q, f_aw_q;
  logic [35:0] f_w_q;
  logic        f_ar_held, f_aw_held, f_w_held;
  assign f_ar      = arvalid && arready;
  assign f_aw      = awvalid && awready;
  assign f_place   = (turn ? awaddr : araddr) % (33'd1 << RegionBits);
  assign f_outside = f_place >= 32'd8192;
  assign f_shut    = CheckProt != 0 && supv && !(turn ? awprot[0] : arprot[0]);
  assign f_r_shut  = rvalid && !rready;
  assign f_b_shut  = bvalid && !bready;
  assign f_reads   = arvalid && !f_r_shut;
  assign f_writes  = awvalid && wvalid && !awready && !f_b_shut;
  assign f_free    = (f_reads || f_writes) && !(f_read || f_write);
  always_ff @(posedge aclk or negedge aresetn) begin
    if (!aresetn) begin
      {f_read, f_write, f_used, f_last_read, f_given, f_bad, f_closed} <= '0;
      {f_r_due, f_b_due, f_r_bad, f_b_bad, f_r_held, f_b_held, f_shut_q, f_blocked} <= '0;
      {f_ar_held, f_aw_held, f_w_held, f_ar_wait, f_aw_wait} <= '0;
    end else begin
      f_used  <= f_write && ready;
      if (begins) begin
        {f_read, f_write, f_last_read} <= {!turn, turn, !turn};
        {f_given, f_bad, f_closed} <= {trace_o[0], f_outside, f_shut};
      end else if (ready) begin
        {f_read, f_write} <= '0;
      end
      f_r_due <= f_ar || (f_r_due && !rready);
      f_b_due <= f_aw || (f_b_due && !bready);
      if (f_ar) {f_r_bad, f_data} <= {f_bad, f_bad || f_closed ? 32'd0 : core_rdata};
      if (f_write && ready) f_b_bad <= f_bad;
      {f_r_held, f_b_held} <= {f_r_shut, f_b_shut};
      {f_shut_q, f_blocked} <= {f_r_shut || f_b_shut, f_free && !begins};
      {f_b_q, f_r_q} <= {bresp, rresp, rdata};
      {f_ar_q, f_aw_q, f_w_q} <= {araddr, arprot, awaddr, awprot, wdata, wstrb};
      {f_ar_held, f_aw_held, f_w_held} <= {arvalid && !arready, awvalid && !awready,
                                           wvalid && !wready};
      f_ar_wait <= arvalid && !arready && !f_r_shut ? f_ar_wait + 4'd1 : 4'd0;
      f_aw_wait <= awvalid && wvalid && !awready && !f_b_shut ? f_aw_wait + 4'd1 : 4'd0;
    end
  end

  always @(posedge aclk) begin
    // Reset in the first clock, none later.
    m_reset: assume (aresetn == !$initstate);
    // The master: VALID stays, and its channel with it, until READY.
    m_ar: assume (!f_ar_held || (arvalid && {araddr, arprot} == f_ar_q));
    m_aw: assume (!f_aw_held || (awvalid && {awaddr, awprot} == f_aw_q));
    m_w: assume (!f_w_held || (wvalid && {wdata, wstrb} == f_w_q));
    // AXI-RESET, PK-17: nothing is answered or taken in reset.
    p_reset: assert (aresetn || !(arready || awready || wready || rvalid || bvalid));
    if (aresetn) begin
      // AXI-VALID: an answer stays until it is taken, and what it says with it.
      p_r_stays: assert (!f_r_held || (rvalid && {rresp, rdata} == f_r_q));
      p_b_stays: assert (!f_b_held || (bvalid && bresp == f_b_q));
      // AXI-ANSWER, PK-21: one answer for each handshake of AR, from the next clock on.
      p_r_answer: assert (rvalid == f_r_due);
      // AXI-ANSWER, PK-21: ... of AW and W.
      p_b_answer: assert (bvalid == f_b_due);
      // PK-21: at most one read and one write are open.
      p_one_read: assert (!f_ar || !f_r_due);
      p_one_write: assert (!f_aw || !f_b_due);
      // PK-21: AW and W are taken together.
      p_together: assert (awready == wready && (!awready || (awvalid && wvalid)));
      // PK-12: the core has one transfer at a time, and each once: it begins, AR is taken in its
      // data phase,
      p_once: assert (!begins || !(f_read || f_write));
      p_ar_taken: assert (arready == (f_read && ready));
      // PK-21: ... AW and W in the clock behind it.
      p_aw_taken: assert (awready == f_used);
      // PK-12, PK-14, PK-15, PK-16: a command is exactly a transfer that begins, inside the window,
      // that MCR.SUPV allows and that has a strobe, if it writes.
      p_command: assert (trace_o[0] == (begins && !f_outside && !f_shut
                                        && !(turn && wstrb == 4'd0)));
      // PK-12: it begins only while its channels are VALID and its answer has room.
      p_begins: assert (!begins || (turn ? f_writes : f_reads));
      // AXI-CMD: it carries direction and word of the address.
      p_address: assert (!trace_o[0]
                         || trace_o[12:1] == {turn ? awaddr[12:2] : araddr[12:2], turn});
      // PK-13, PK-14: it has the lanes of WSTRB; reads have all.
      p_lanes: assert (!trace_o[0] || trace_o[16:13] == (turn ? wstrb : 4'd15));
      // PK-14: write data are those of the bus.
      p_write_data: assert (!f_write || trace_o[48:17] == wdata);
      // PK-15, PK-16: read data are the core's of the data phase, or 0 where it was not asked.
      p_read_data: assert (!rvalid || rdata == f_data);
      // AXI-RESP, PK-15: SLVERR outside the window, OKAY elsewhere.
      p_rresp: assert (!rvalid || rresp == (f_r_bad ? 2'b10 : 2'b00));
      p_bresp: assert (!bvalid || bresp == (f_b_bad ? 2'b10 : 2'b00));
      // PK-15, PK-16: what is not the core's does not wait.
      p_no_wait: assert (f_given || (f_read ? arready : !f_write || ready));
      // PK-22: where both wait they take turns, the read first, but in the clock behind one in
      // which an answer was not taken.
      p_turns: assert (!begins || !f_reads || !f_writes || turn == f_last_read || f_shut_q);
      // PK-22: who can begin does, at once or one clock later, whatever the other channel does.
      p_free: assert (begins || !f_free || !f_blocked);
      // PK-23: ARREADY within 7 clocks of ARVALID while R is open,
      p_ar_bound: assert (f_ar_wait <= 4'd7);
      // PK-23: ... AWREADY within 8 of AWVALID and WVALID while B is open.
      p_aw_bound: assert (f_aw_wait <= 4'd8);
    end
  end
