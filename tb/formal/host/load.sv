  // SPDX-FileCopyrightText: 2026 The VeriCAN authors
  // SPDX-License-Identifier: Apache-2.0
  //
  // Properties of can_mb_load, spliced into it: its indices beside the CPU's writes. What it
  // compares a clock early is right where it is used. CPU, engine, RAM and winner are free.

  // can_mb_port, can_mb_cpu: an access takes two clocks; a C/S write in its second one is told in
  // the next, if it takes place. What a read or another write asks for is anything.
  logic            f_first, f_second, f_wr, f_told, f_told_act;
  logic [IdxW-1:0] f_idx, f_told_idx;
  (* anyseq *) logic            f_go, f_cs, f_off, f_act;
  (* anyseq *) logic [IdxW-1:0] f_other;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {f_first, f_second, f_wr, f_told, f_told_act} <= '0;
      {f_idx, f_told_idx} <= '0;
    end else begin
      f_first  <= !f_first && f_go;
      f_second <= f_first;
      if (!f_first) begin
        f_wr  <= f_go && f_cs;
        f_idx <= f_go && f_cs ? cmd_mb_i : f_other;
      end
      f_told <= f_second && f_wr && !f_off;
      if (f_second && f_wr && !f_off) {f_told_idx, f_told_act} <= {f_idx, f_act};
    end
  end

  always @(posedge clk_i) begin
    m_reset: assume (rst_ni == !$initstate);
    // host.port, p_two_clocks; host.native_port, p_row.
    m_command: assume (cmd_i == !f_first);
    m_write: assume (cs_wr_i == f_wr && cs_wr_idx_i == f_idx);
    m_written: assume (cs_written_i == f_told && cs_written_idx_i == f_told_idx
                       && cs_written_act_i == f_told_act);
    if (rst_ni) begin
      // flexcan.md 3.4: a C/S write is one to the buffer that is presented, sent or given up
      // exactly if it is: in the clock behind it, for the header too that was taken meanwhile.
      p_written: assert (cs_written_cur == (cs_written_i && cs_written_idx_i == cur_idx_o));
      // flexcan.md 3.4: with a header, a write under way is one to its buffer exactly if it is.
      p_head: assert (!(data_i && data_step_i == can_mb_pkg::StepHead && state_q == StHead)
          || !cs_wr_i || wr_ld_q == (cs_wr_idx_i == ld_idx_o));
      // flexcan.md 3.4: ... or to the one that is presented.
      p_replaced: assert (!(data_i && data_step_i == can_mb_pkg::StepHead && state_q == StHead)
          || !cs_wr_i || wr_cur_q == (cs_wr_idx_i == cur_idx_o));
      // flexcan.md 3.4: no header is taken of a buffer that is being written, or that was in the
      // clock before.
      p_not_taken: assert (!take_o || !((cs_wr_i && cs_wr_idx_i == ld_idx_o)
                                        || (cs_written_i && cs_written_idx_i == ld_idx_o)));
      // flexcan.md 3.4: the end of a frame is not written into a buffer that was written.
      p_end: assert (!(cs_written_i && cs_written_idx_i == cur_idx_o) || cancel_o);
      // flexcan.md 3.3: the load of a buffer does not begin while it is sent or about to end.
      p_not_on_the_bus: assert ($initstate || !$past(rst_ni && state_q == StIdle && off_o)
          || state_q != StLow || ld_idx_o != $past(cur_idx_o));
    end
  end
