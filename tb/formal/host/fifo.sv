  // SPDX-FileCopyrightText: 2026 The VeriCAN authors
  // SPDX-License-Identifier: Apache-2.0
  //
  // Properties of can_rx_fifo, spliced into it. The model beside it counts the frames that came and
  // went; f_way are those on their way to their places.

  logic [2:0] f_count, f_ahead, f_head, f_tail;
  logic [1:0] f_way;          // at most two, one in each hidden row
  logic       f_ran;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {f_count, f_way, f_head, f_tail, f_ran} <= '0;
    end else begin
      f_ran <= 1'b1;
      if (clear_i) {f_count, f_way, f_head, f_tail} <= '0;
      else begin
        f_way   <= f_way + 2'(resolve_i && take_o) - 2'(stored_i);
        if (resolve_i && take_o) f_tail <= f_tail == 3'd5 ? 3'd0 : f_tail + 3'd1;
        if (pop_i && f_count != 3'd0) f_head <= f_head == 3'd5 ? 3'd0 : f_head + 3'd1;
        f_count <= f_count + 3'(stored_i) - 3'(pop_i && f_count != 3'd0);
      end
    end
  end
  assign f_ahead = f_count + 3'(f_way);

  always @(posedge clk_i) begin
    m_reset: assume (rst_ni == !$initstate);
    // A frame is stored that was taken before, and a third is not taken before the first is there:
    // can_mb_move has two rows, and a frame in the FIFO's row is not replaced or cancelled.
    m_stored: assume (!rst_ni || ((!stored_i || f_way != 2'd0) && !(resolve_i && f_way == 2'd2)));
    // can_mb_move tells which those are.
    m_way: assume (!rst_ni || {1'b0, fifo_in_flight_i[0]} + {1'b0, fifo_in_flight_i[1]} == f_way);
    if (rst_ni) begin
      // flexcan.md 4: never more than six frames, never fewer than none; one may be on its way.
      p_depth: assert (f_count <= 3'd6 && f_ahead <= 3'd6);
      // flexcan.md 4: the fill is frames come less frames gone: a frame stored is one that was
      // taken, popping an empty FIFO has no effect.
      p_fill: assert (fill_q == f_count && used == f_ahead);
      // flexcan.md 4: IFLAG1[5] tells of a frame at the output.
      p_avail: assert (avail_o == (f_count != 3'd0));
      // flexcan.md 4: the places are a ring of six rows, without gaps.
      p_ring: assert (head_q < 3'd6 && tail_o == f_tail);
      // flexcan.md 4: the output is the row of the oldest frame, from the clock after a pop on.
      p_output: assert (head_o == f_head);
      // flexcan.md 4: warning exactly when the fill rises from 4 to 5.
      p_warn: assert (warn_o == (f_count == 3'd4 && stored_i && !pop_i));
      // flexcan.md 4: overflow only when all six places are taken and no mailbox has the frame.
      p_overflow: assert (!ovf_o || (f_ahead == 3'd6 && filter_i && !mb_hit_i && resolve_i));
      // flexcan.md 4: no frame is taken into a full FIFO.
      p_take: assert (!take_o || (f_ahead < 3'd6 && filter_i));
      if (f_ran) begin
        // flexcan.md 4: emptied by a soft reset or a change of FEN.
        p_clear: assert (!$past(clear_i) || (!avail_o && f_ahead == 3'd0));
        // flexcan.md 4: the output changes by a pop of a frame only.
        p_head: assert (head_q == $past(head_q) || $past(clear_i || (pop_i && avail_o)));
      end
    end
  end
