  // SPDX-FileCopyrightText: 2026 The VeriCAN authors
  // SPDX-License-Identifier: Apache-2.0
  //
  // Properties of can_mb_guard, spliced into it: what is forbidden of a write of
  // two clocks.

  logic             f_second, f_guarded, f_iflag, f_cur, f_cs, f_abort, f_out, f_mark, f_own;
  logic             f_done;
  logic [1:0]       f_mem_sel;
  logic [IdxW-1:0]  f_idx;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {f_second, f_guarded, f_iflag, f_cur, f_cs, f_abort, f_out, f_mark, f_own} <= '0;
      f_done    <= 1'b0;
      f_mem_sel <= '0;
      f_idx     <= '0;
    end else begin
      f_second  <= first_i;
      f_guarded <= aen_i && !area_i && mem_sel_i < 2'd2;
      f_iflag   <= iflag_i[idx_i] || (end_i && end_idx_i == idx_i);
      f_cur     <= cur_idx_i == idx_i && !take_i;
      f_cs      <= mem_sel_i == can_mb_pkg::MemCs;
      f_abort   <= be3_i && code_i == 4'b1001;
      f_out     <= out_i;
      f_done    <= done_i;
      f_mark    <= mark_i && mark_idx_i == idx_i;
      f_own     <= flag_o && flag_idx_o == idx_i;
      f_mem_sel <= mem_sel_i;
      f_idx     <= idx_i;
    end
  end
  logic f_write, f_told, f_ends, f_blocked;
  assign f_write   = f_second && f_guarded;
  // A mark of the first clock makes bit 30 0, whatever the RAM shows that is read meanwhile.
  // f_told: an end that is being told just now.
  assign f_told    = (f_cur && done_i) || f_own || (flag_o && flag_idx_o == f_idx);
  assign f_ends    = (f_iflag && ended_i && !f_mark) || f_told;
  assign f_blocked = block_o || (if_ended_o && ended_i);

  always @(posedge clk_i) begin
    m_reset: assume (rst_ni == !$initstate);
    // can_mb_port: the second clock follows the first, with the same access (host.port,
    // p_two_clocks).
    m_clocks: assume (wr_done_i == f_second && !(first_i && f_second));
    m_held: assume (!f_second || (mem_sel_i == f_mem_sel && idx_i == f_idx));
    // can_mb_load: a frame that ends has moved out.
    m_done: assume (out_i || !done_i);
    if (rst_ni) begin
      // flexcan.md 3.4: what bit 30 decides is a write to a mailbox that ends in this clock.
      p_second: assert (!if_ended_o || (wr_done_i && f_write));
      // flexcan.md 3.4: without MCR.AEN, and of the Rx FIFO, masks and TIMER, nothing is forbidden.
      p_free: assert (f_guarded || !f_blocked);
      // flexcan.md 3.4: no word is written of a buffer whose transmission has ended and whose IFLAG
      // is set.
      p_ended: assert (!(f_write && f_ends) || f_blocked);
      // flexcan.md 3.3: nor the C/S word of one that had moved out in the first clock; a bus that
      // becomes free in the second is two bits away from the next frame. Any other word is written.
      p_out: assert (!(f_write && f_cs && f_cur && f_out) || f_blocked);
      p_written: assert (!(f_write && !f_ends && !(f_cs && f_cur && f_out))
                         || !f_blocked);
      // flexcan.md 3.3: a request is code 1001 in a C/S word that is forbidden as the frame is out,
      // beside the flag of an end before it, too: an answer is sent more than once.
      p_request: assert (abort_o == (f_write && f_cs && f_abort && f_cur && f_out && !f_told
                                     && !f_done));
      // flexcan.md 3.3: an abort is done at once exactly when the word is written, and IFLAG tells.
      p_at_once: assert ($initstate
          || !$past(rst_ni && f_write && f_cs && f_abort && !f_blocked && !clear_i)
          || (flag_o && flag_idx_o == $past(idx_i)));
    end
  end
