  // SPDX-FileCopyrightText: 2026 The VeriCAN authors
  // SPDX-License-Identifier: Apache-2.0
  //
  // Properties of can_mb_port, spliced into it: an access takes two clocks, what the CPU reads
  // stands still, and nobody is kept waiting for ever. CPU, engine and RAM are free.

  logic       f_ran, f_new, f_slot_q, f_eng_cs_q, f_wrote_q;
  logic [2:0] f_read_q;                  // the last three clocks: a read of insertion or engine
  logic       f_mark;                    // a mark may be asked for
  logic [2:0] f_received, f_since;
  (* anyseq *) logic f_comes;            // can_mb_smb is given a byte of the frame received
  logic       f_came_q, f_byte_q;        // it asks for that byte: in the first clock, in later ones
  logic [1:0] f_words;                   // granted of words of the frame received in a row
  logic [5:0] f_engine, f_insertion;     // clocks that a wish has waited
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {f_ran, f_new, f_slot_q, f_read_q, f_eng_cs_q, f_wrote_q, f_engine, f_insertion} <= '0;
      {f_mark, f_received, f_since, f_words, f_came_q, f_byte_q} <= '0;
    end else begin
      f_ran       <= 1'b1;
      f_new       <= ready_o && (cmd_rd_i || cmd_wr_i);
      f_slot_q    <= eng_slot_o;
      f_wrote_q   <= rx_wr_req_i;
      f_mark      <= rd_done_o || (f_mark && !serviced_gnt_o);
      f_received  <= !rx_wr_req_i || rx_wr_gnt_o ? 3'd0 : f_received + 3'd1;
      f_since     <= !rx_wr_req_i ? 3'd0 : f_since + 3'(f_since != '1);
      f_came_q    <= f_comes;
      f_byte_q    <= (f_came_q || f_byte_q) && !rx_wr_gnt_o;
      f_words     <= !rx_wr_req_i ? 2'd0 : f_words + 2'(rx_wr_gnt_o && f_words != '1);
      if (eng_slot_o) f_eng_cs_q <= eng_cs_i;
      f_read_q    <= {f_read_q[1:0], ins_gnt_o || (eng_slot_o && eng_req_i)};
      f_engine    <= !wish || (eng_slot_o && eng_req_i) ? 6'd0 : f_engine + 6'd1;
      f_insertion <= !ins_req_i || ins_gnt_o ? 6'd0 : f_insertion + 6'd1;
    end
  end

  logic       f_cs, f_msg, f_mask;
  logic [3:0] f_we;
  assign f_we   = we_cs | we_msg | we_mask;
  assign f_cs   = of_cs || wr_q;
  assign f_msg  = of_msg && rd_q;
  assign f_mask = mem_sel_q == can_mb_pkg::MemMask && rd_q;
  always @(posedge clk_i) begin
    m_reset: assume (rst_ni == !$initstate);
    // host.ahb, host.apb, host.axil, host.wb: p_when_ready; one command.
    m_command: assume (!(cmd_rd_i && cmd_wr_i) && (ready_o || !(cmd_rd_i || cmd_wr_i)));
    // can_mb_step: a step's data is there in the clock after its slot; a copy is one of them, and
    // none begins while a word of the frame received waits, nor as a byte of it comes
    // (can_mailbox).
    m_copy: assume (!copy_i || (f_slot_q && !f_wrote_q && !f_came_q));
    // can_mb_smb: a byte is asked for from the next clock on. The words of the header, eight bits
    // before, are written by then, and so is the byte before.
    m_byte: assume (!(f_came_q || f_byte_q) || rx_wr_req_i);
    m_alone: assume (!f_came_q || !f_wrote_q);
    // host.lock, p_asked: each mark follows a read of its own.
    m_marks: assume (!serviced_req_i || f_mark);
    // host.lock, p_kind: it writes the memory that its step has asked for.
    m_kind: assume (!copy_i || copy_cs_i == f_eng_cs_q);
    // can_mb_tx: a pass asks for a slot in each clock but that behind a read and, as long as its
    // last buffer is compared, the two behind that.
    m_wish: assume (!eng_pass_i || eng_req_i || f_read_q != '0);
    // can_mb_smb: hidden rows.
    m_hidden: assume ((rx_wr_cs_i ? rx_wr_row_i[IdxW] : rx_wr_row_i[IdxW+1:IdxW] == 2'd3)
                      && (!of_msg || word_q != 2'd3));
    // host.guard, p_second: it looks at the C/S word in the second clock of a write.
    m_ended: assume (!if_ended_i || (cpu_wr_q && !mem_sel_q[1]));
    // can_mb_cpu: rows differ from buffers at the output of the Rx FIFO alone.
    m_row: assume (row_idx_i == idx_q || (idx_q == '0 && row_idx_i < 4'd6));
    if (rst_ni) begin
      // AHB-WAIT: an access takes two clocks: the port is not ready in the first.
      p_two_clocks: assert (ready_o == !f_new && first_q == f_new);
      // PK-15, PK-16: the data are 0 but in the clock in which a read ends.
      p_quiet: assert (rd_done_o || (rdata_o == '0 && !rd_word_o));
      // PK-15: they are the word of a buffer exactly if one was asked for, and that one.
      p_word: assert (rd_word_o == (rd_done_o && !scrub_o && !mem_sel_q[1])
                      && (!rd_word_o || (rdata_o == '0 && word_o == (of_cs ? cs_o : msg_o))));
      // flexcan.md 3.4: in the first clock of a write of a buffer its C/S word is read, or on the
      // outputs already, being copied.
      p_looks: assert (!(f_new && wr_q && !mem_sel_q[1]) || (cs_raddr == {1'b0, row_idx_i}
          && (re || (copy_i && copy_cs_i && copy_row_i[IdxW:0] == cs_raddr))));
      // flexcan.md 3.3: in the clock of the CPU nobody else reads.
      p_one_reader: assert (2'(cpu_rd) + 2'(ins_gnt_o) + 2'(eng_slot_o) < 2'd2);
      // flexcan.md 3.6: no word is written in the clock in which the CPU reads it, but for the mark
      // of one whose bit 30 a write looks at (host.guard, p_ended and p_written, count it).
      p_whole: assert (scrub_o || !cpu_rd || !re || f_we == '0
          || !((f_cs && w_cs && w_row[IdxW:0] == cs_raddr && !(wr_q && serviced_gnt_o))
               || (f_msg && w_msg && w_row == msg_raddr)
               || (f_mask && w_mask && w_row[IdxW:0] == mask_raddr)));
      // flexcan.md 3.4: a write of the CPU is made in its second clock, before all others, unless
      // MCR.AEN forbids it (for good, or by bit 30 of the C/S word) or the memory of the Rx FIFO is
      // not to be written.
      p_writes: assert (scrub_o || mem_sel_q == can_mb_pkg::MemTimer
          || !(wr_done_o && $past(first_q && !ring_i))
          || (w_data == wdata_i && w_cs == of_cs && w_row[IdxW-1:0] == idx_q
              && f_we == (be_q & {4{!block_i && !(if_ended_i && cs_o[can_mb_pkg::CsEnded])}})));
      // flexcan.md 3.5: the lanes of the memories that are meant, and of no other.
      p_lanes: assert (we_cs == (f_we & {4{w_cs}}) && we_msg == (f_we & {4{w_msg}})
                       && we_mask == (f_we & {4{w_mask}}));
      // flexcan.md 3.5, 3.6: what is granted is written: a copy, a mark, a word of the frame
      // received.
      p_granted: assert (scrub_o
          || ((!copy_i
               || (w_row == copy_row_i && w_cs == copy_cs_i && w_msg == !copy_cs_i
                   && f_we == (copy_be_i & {4{!copy_off_i}}) && w_data == copy_data_i))
              && (!serviced_gnt_o || (w_row == {2'b00, serviced_idx_i} && w_cs && f_we == 4'b1000))
              && (!rx_wr_gnt_o || (w_row == rx_wr_row_i && w_cs == rx_wr_cs_i && f_we == rx_wr_be_i
                                   && w_data == rx_wr_data_i))));
      // flexcan.md 3.5: no copy is ever due while the CPU writes: its word need not stay on the
      // outputs.
      p_no_copy: assert (!(f_slot_q && wr_done_o));
      // flexcan.md 3.5: a word of the frame received waits for four clocks at most.
      p_received: assert (f_received < 3'd5);
      // flexcan.md 3.5: a byte of it is written in the four clocks in which the engine still has it
      // if the bit behind it is as short as SJW allows at 8 clocks a bit, five clocks.
      p_byte: assert (!(f_came_q || f_byte_q) || f_received < 3'd4);
      // FX-6.c: two words in a row, the stamps of a frame as received and as sent, are
      // written in the seven clocks in which TIMER still has that value at 8 clocks a bit.
      p_stamps: assert (!rx_wr_req_i || f_since != 3'd6
          || f_words[1] || (f_words[0] && rx_wr_gnt_o));
      // FX-9.ERR005829: the engine gets a slot, and so does an insertion, whatever the CPU does.
      p_engine: assert (f_engine < 6'd10);
      p_insertion: assert (f_insertion < 6'd48);
    end
  end
