  // SPDX-FileCopyrightText: 2026 The VeriCAN authors
  // SPDX-License-Identifier: Apache-2.0
  //
  // Properties of can_ahb, spliced into it: an AHB-Lite slave (ARM IHI 0033). The model beside it
  // keeps one transfer in its data phase: accepted (f_data), to be answered by ERROR (f_wrong).

  // What is wrong with a transfer: wider than the bus, not aligned to its width, or out of the
  // 8 KiB of the core.
  logic f_taken, f_bad, f_open, f_data, f_wrong, f_second, f_denied, f_low_q, f_ran;
  logic [31:0] f_bytes, f_place;
  assign f_bytes = 32'd1 << hsize;
  assign f_place = haddr % (33'd1 << RegionBits);
  assign f_bad   = f_bytes > 32'd4 || (haddr & (f_bytes - 32'd1)) != 32'd0 || f_place >= 32'd8192;
  assign f_taken = hsel && hready && (htrans == 2'b10 || htrans == 2'b11);
  assign f_open  = !(CheckHprot != 0 && supv && !hprot[1]);
  always_ff @(posedge hclk or negedge hresetn) begin
    if (!hresetn) begin
      {f_data, f_wrong, f_second, f_denied, f_low_q, f_ran} <= '0;
    end else begin
      f_ran    <= 1'b1;
      f_low_q  <= !hreadyout;
      f_second <= f_data && f_wrong && !f_second;
      if (hready) begin
        f_data   <= f_taken;
        f_wrong  <= f_taken && f_bad;
        f_denied <= f_taken && !f_open;
      end
    end
  end

  always @(posedge hclk) begin
    // Reset in the first clock, none later.
    m_reset: assume (hresetn == !$initstate);
    // The interconnect: HREADY of the bus is HREADYOUT of the slave whose data phase it is.
    m_hready: assume (!f_data || hready == hreadyout);
    if (hresetn) begin
      // AHB-RESET: HREADYOUT is high and the answer OKAY after reset.
      p_after_reset: assert (f_ran || (hreadyout && !hresp));
      // AHB-IDLE: without a data phase (IDLE, BUSY, not selected, HREADY low) OKAY without waiting.
      p_zero_wait: assert (f_data || (hreadyout && !hresp));
      // AHB-WAIT: HREADYOUT is never low for two clocks in a row.
      p_one_wait: assert (!f_low_q || hreadyout);
      // AHB-ERROR: ERROR takes two clocks, the first with HREADYOUT low.
      p_error_first: assert (!(f_data && f_wrong && !f_second) || (hresp && !hreadyout));
      // AHB-ERROR: ... and the second with HREADYOUT high.
      p_error_second: assert (!(f_data && f_wrong && f_second) || (hresp && hreadyout));
      // AHB-OKAY: an aligned access of at most 32 bits inside the window never gets ERROR.
      p_okay: assert (!(f_data && !f_wrong) || !hresp);
      // AHB-CMD: a command is exactly an accepted transfer that is neither wrong nor denied; all
      // others change nothing, because the core does not see them.
      p_command: assert (trace_o[0] == (f_taken && !f_bad && f_open));
      // AHB-CMD: it carries direction and word of the address phase.
      p_address: assert (!trace_o[0] || trace_o[12:1] == {haddr[12:2], hwrite});
      // AHB-LANES: ... and the byte lanes of its size and address (little-endian).
      p_lanes: assert (!trace_o[0] || {28'd0, trace_o[16:13]}
                       == (((32'd1 << f_bytes) - 32'd1) << haddr[1:0]));
      // AHB-DATA: write data are those of the bus.
      p_write_data: assert (trace_o[48:17] == hwdata);
      // AHB-DATA, flexcan.md 1.1: read data are the core's, or 0 where MCR.SUPV forbids the access.
      p_read_data: assert (f_data && f_denied ? hrdata == 32'd0
          : hrdata[{irq_o, irq_mb_o, irq_boff_o, irq_err_o, irq_twrn_o}] == irq_rwrn_o);
    end
  end
