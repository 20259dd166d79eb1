  // SPDX-FileCopyrightText: 2026 The VeriCAN authors
  // SPDX-License-Identifier: Apache-2.0
  //
  // Properties of can_top, spliced into it: the native port waits for one clock with what goes
  // to the mailbox and not at all with the rest, and its data are 0 but of a read. Together with
  // host.ahb (and of the other buses) this is the compliance of the whole slave.

  // Byte addresses of what is kept in the mailbox, as docs/registers.md lists them; masks and RXFIR
  // that cannot be written are not.
  logic        f_buffers, f_masks, f_mailbox;
  logic [12:0] f_addr;
  assign f_addr    = {addr_i, 2'b00};
  assign f_buffers = f_addr >= 13'h080 && f_addr < 13'h080 + 13'(16 * NumMb);
  assign f_masks   = f_addr == 13'h010 || f_addr == 13'h014 || f_addr == 13'h018
      || (Fifo != 0 && f_addr == 13'h048)
      || (OwnMasks != 0 && f_addr >= 13'h880 && f_addr < 13'h880 + 13'(4 * NumMb));
  assign f_mailbox = f_buffers || f_addr == 13'h008 || (f_masks && (!we_i || frz_ack))
      || (Fifo != 0 && f_addr == 13'h04C && !we_i)
      || (TimeUnit != 0 && f_addr >= 13'h1400 && f_addr < 13'h1400 + 13'(8 * NumMb)
          && (!we_i || frz_ack));

  logic f_first, f_waits, f_read;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {f_first, f_waits, f_read} <= '0;
    end else begin
      f_first <= req_i && !cancel_i && ready_o;
      f_waits <= req_i && !cancel_i && ready_o && f_mailbox;
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
      // AHB-WAIT: ... for exactly that clock if it goes to the mailbox, and for none if not.
      p_one_wait: assert (ready_o == !f_waits);
      // PK-15, PK-16: what was not read is 0, a cancelled access and the clock of waiting too.
      p_silent: assert ((f_read && ready_o) || rdata_o == '0);
    end
  end
