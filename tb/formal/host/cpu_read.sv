  // SPDX-FileCopyrightText: 2026 The VeriCAN authors
  // SPDX-License-Identifier: Apache-2.0
  //
  // Properties of can_mb_cpu, spliced into it: what the CPU reads, bit by bit as it is documented,
  // of every word of the RAM.

  // The word of the RAM, or a mask or stamp; nothing while the RAM is cleared.
  logic [31:0] f_word, f_read;
  logic        f_rxfir, f_timer;
  assign f_word  = rd_word_i ? word_i : other_i;
  assign f_rxfir = mem_sel_i == 2'd0 && rxfir_i;
  assign f_timer = rd_done_i && mem_sel_i == 2'd3 && (rxfir_i || TimeUnit == 0);
  // In the clock before: the word belongs to the Rx FIFO, to its memory.
  logic f_area_q, f_ring_q;
  always @(posedge clk_i) begin
    f_area_q <= rst_ni && area_o;
    f_ring_q <= rst_ni && ring_o;
  end
  always_comb begin
    f_read = f_word;
    if (f_timer) f_read = {16'd0, timer_i};
    if (f_rxfir) f_read = f_ring_q ? {23'd0, f_word[31:23]} : 32'd0;
    else if (mem_sel_i == 2'd0 && (!f_area_q || f_ring_q)) begin
      f_read[31:28] = 4'd0;
      f_read[23]    = 1'b0;
      if (rd_done_i && end_i) f_read[27:24] = end_code_i;
      if (rd_done_i && busy_o) f_read[24] = 1'b1;
      if (f_ring_q) f_read[27:24] = 4'd0;
    end
  end

  always @(posedge clk_i) begin
    m_reset: assume (rst_ni == !$initstate);
    // host.port, p_quiet and p_word: there is a word, something else or nothing; TIMER is not in
    // the port.
    m_word: assume (!rd_word_i || (rd_done_i && !mem_sel_i[1] && other_i == 32'd0));
    m_other: assume ((rd_done_i && mem_sel_i[1] && !f_timer) || other_i == 32'd0);
    // can_mb_port: the end of a frame is shown in the last clock of an access to the word.
    m_end: assume (!end_i || rd_done_i || wr_done_i);
    if (rst_ni) begin
      // flexcan.md 1.5, 3.2, 4: bits 31:28 and 23 of a C/S word are read as 0 but in the filter
      // table; a buffer that is moved into is BUSY, one whose frame has just ended has its new
      // code; RXFIR is the number of the filter; TIMER has 16 bits.
      p_read: assert (rdata_o == f_read);
      // PK-15, PK-16: nothing is read but in the clock in which a read ends.
      p_nothing: assert (rd_done_i || rdata_o == 32'd0);
    end
  end
