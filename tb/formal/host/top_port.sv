  // SPDX-FileCopyrightText: 2026 The VeriCAN authors
  // SPDX-License-Identifier: Apache-2.0
  //
  // Properties of can_top, spliced into it: the native port waits for one clock at most, and its
  // data are 0 but of a read. Together with host.ahb (and of the other buses) this is the
  // compliance of the whole slave.

  logic f_first, f_read;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {f_first, f_read} <= '0;
    end else begin
      f_first <= req_i && !cancel_i && ready_o;
      if (ready_o) f_read <= req_i && !cancel_i && !we_i;
    end
  end

  always @(posedge clk_i) begin
    m_reset: assume (rst_ni == !$initstate);
    // Discharged by host.ahb, host.apb, host.axil, host.wb: p_when_ready.
    m_when_ready: assume (!(req_i && !cancel_i) || ready_o);
    if (rst_ni) begin
      // AHB-WAIT: the port is not ready in the clock after a command at most.
      p_waits: assert (ready_o || f_first);
      // PK-15, PK-16: what was not read is 0, a cancelled access too.
      p_silent: assert (f_read || rdata_o == '0);
    end
  end
