  // SPDX-FileCopyrightText: 2026 The VeriCAN authors
  // SPDX-License-Identifier: Apache-2.0
  //
  // Properties of can_apb, spliced into it: an APB4 slave (ARM IHI 0024). The model beside it keeps
  // one transfer in its access phase (f_access): to be answered by PSLVERR (f_bad), closed by
  // MCR.SUPV (f_closed), given to the core (f_given).

  logic f_access, f_bad, f_closed, f_given, f_first, f_setup, f_outside, f_shut;
  logic [31:0] f_place;
  logic [71:0] f_pins, f_pins_q;
  assign f_setup   = psel && !penable;
  assign f_place   = paddr % (33'd1 << RegionBits);
  assign f_outside = f_place >= 32'd8192;
  assign f_shut    = CheckProt != 0 && supv && !pprot[0];
  assign f_pins    = {paddr, pprot, pwrite, pstrb, pwdata};
  always_ff @(posedge pclk or negedge presetn) begin
    if (!presetn) begin
      {f_access, f_bad, f_closed, f_given, f_first} <= '0;
    end else begin
      f_access <= f_setup || (f_access && !pready);
      f_first  <= f_setup;
      f_pins_q <= f_pins;
      if (f_setup) {f_bad, f_closed, f_given} <= {f_outside, f_shut, trace_o[0]};
    end
  end

  always @(posedge pclk) begin
    // Reset in the first clock, none later.
    m_reset: assume (presetn == !$initstate);
    // The master: an access phase is behind a setup phase, until PREADY, with everything held.
    m_access: assume (f_access ? psel && penable && f_pins == f_pins_q : !(psel && penable));
    if (presetn) begin
      // APB-SETUP, PK-12: a command is exactly the setup phase of a transfer inside the window that
      // MCR.SUPV allows and that has a strobe, if it writes.
      p_command: assert (trace_o[0] == (f_setup && !f_outside && !f_shut
                                        && !(pwrite && pstrb == 4'd0)));
      // APB-SETUP: it carries direction and word of the address.
      p_address: assert (!trace_o[0] || trace_o[12:1] == {paddr[12:2], pwrite});
      // PK-13, PK-14: it has the lanes of PSTRB; reads have all.
      p_lanes: assert (!trace_o[0] || trace_o[16:13] == (pwrite ? pstrb : 4'd15));
      // APB-READY, PK-12: the transfer ends in the core's data phase of its command.
      p_data_phase: assert (!f_access || pready == ready);
      // PK-14: write data are those of the bus.
      p_write_data: assert (!f_access || trace_o[48:17] == pwdata);
      // PK-15, PK-16: read data are the core's, or 0 where it was not asked.
      p_read_data: assert (!f_access || pwrite
                           || prdata == (f_bad || f_closed ? 32'd0 : rdata));
      // APB-ERROR, PK-15: PSLVERR ends a transfer outside the window and no other.
      p_error: assert (!f_access || pslverr == (pready && f_bad));
      // APB-ERROR, PK-20: ... and is low but with PSEL, PENABLE and PREADY.
      p_no_error: assert (!pslverr || (psel && penable && pready));
      // APB-READY: PREADY is low for at most one clock of a transfer,
      p_one_wait: assert (!f_access || f_first || pready);
      // APB-READY, PK-15, PK-16: and for none of one that is not the core's.
      p_no_wait: assert (!f_access || f_given || pready);
    end
  end
