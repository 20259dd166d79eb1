  // SPDX-FileCopyrightText: 2026 The VeriCAN authors
  // SPDX-License-Identifier: Apache-2.0
  //
  // Properties of can_flags, spliced into it. f_n is one buffer, any one of them.

  (* anyconst *) logic [5:0] f_n;
  logic f_ran, f_set, f_we, f_mwe, f_lane;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) f_ran <= 1'b0;
    else         f_ran <= 1'b1;
  end

  // Causes of IFLAG bit f_n, and a 1 that the CPU writes there.
  assign f_set  = (flag_i && 6'(flag_idx_i) == f_n) || (fifo_warn_i && f_n == 6'd6)
               || (fifo_ovf_i && f_n == 6'd7);
  assign f_lane = be_i[f_n[4:3]];
  assign f_we   = (f_n[5] ? iflag_hi_we_i : iflag_lo_we_i) && f_lane && wdata_i[f_n[4:0]];
  assign f_mwe  = (f_n[5] ? imask_hi_we_i : imask_lo_we_i) && f_lane;

  // The event bits of ESR1: 17 TWRN, 16 RWRN, 2 BOFF, 1 ERR, 0 WAK.
  logic [31:0] f_esr_w1c, f_esr_bits;
  logic [4:0]  f_event;
  assign f_esr_w1c  = esr1_we_i ? wdata_i & {{8{be_i[3]}}, {8{be_i[2]}}, {8{be_i[1]}}, {8{be_i[0]}}}
                                : 32'd0;
  assign f_esr_bits = 32'h0003_FC07;
  // Entries, each from the level that causes it.
  logic f_tx_q, f_rx_q, f_boff_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) {f_tx_q, f_rx_q, f_boff_q} <= '0;
    else         {f_tx_q, f_rx_q, f_boff_q} <= {tx_wrn_i, rx_wrn_i, boff_i};
  end
  assign f_event = {tx_wrn_i && !f_tx_q && wrn_en_i, rx_wrn_i && !f_rx_q && wrn_en_i,
                    boff_i && !f_boff_q, err_i != '0, wake_i};

  function automatic logic [4:0] f_five(input logic [31:0] word);
    f_five = {word[17:16], word[2:0]};
  endfunction

  // What the lines have to show one clock later (flip-flops).
  logic [5:0] f_lines_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) f_lines_q <= '0;
    else f_lines_q <= {(iflag_o & imask_o) != '0, esr1_o[2] && boff_msk_i, esr1_o[1] && err_msk_i,
                       esr1_o[17] && twrn_msk_i, esr1_o[16] && rwrn_msk_i, esr1_o[0] && wak_msk_i};
  end

  always @(posedge clk_i) begin
    m_reset: assume (rst_ni == !$initstate);
    if (rst_ni) begin
      // flexcan.md 4: in FIFO mode IFLAG1[4:0] read 0 and [5] tells that a frame is there.
      p_fifo_flags: assert (!fen_i || iflag_o[5:0] == {fifo_avail_i, 5'd0});
      // flexcan.md 1.4: ESR1 has no other event bits.
      p_esr1_bits: assert ((esr1_o & ~f_esr_bits) == '0);
      // flexcan.md 5: each line is its flag AND its mask, always, from a flip-flop.
      p_lines: assert ({irq_mb_o, irq_boff_o, irq_err_o, irq_twrn_o, irq_rwrn_o, irq_wak_o}
                       == f_lines_q);
      // FX-MCR.WRN_EN: without WRN_EN no warning interrupt.
      p_no_warning: assert (wrn_en_i || esr1_o[17:16] == 2'b00);
      // FX-MCR.FEN: its change clears what the FIFO shows in IFLAG1[7:6], from that clock on.
      p_toggled: assert (!fifo_clear_i || iflag_o[7:6] == 2'b00);
      if (f_ran) begin
        // flexcan.md 1.5: a flag rises by its cause only.
        p_cause: assert (!(iflag_q[f_n] && !$past(iflag_q[f_n])) || $past(f_set));
        // flexcan.md 1.5: a cause sets it, also against a clear in the same clock.
        p_set_wins: assert (!$past(f_set && !clear_i && !(fifo_clear_i && f_n >= 5 && f_n <= 7))
                            || iflag_q[f_n]);
        // flexcan.md 1.5: only a written 1 clears it, a soft reset, or FEN of the FIFO's bits.
        p_kept: assert (!$past(iflag_q[f_n] && !f_we && !clear_i
                               && !(fifo_clear_i && f_n >= 5 && f_n <= 7)) || iflag_q[f_n]);
        // flexcan.md 1.5: a written 1 does clear it.
        p_cleared: assert (!$past(f_we && !f_set) || !iflag_q[f_n]);
        // flexcan.md 1.5: IMASK is what was written, byte by byte, and 0 after a soft reset.
        p_mask: assert (imask_q[f_n] == ($past(clear_i) ? 1'b0
                        : $past(f_mwe) ? $past(wdata_i[f_n[4:0]]) : $past(imask_q[f_n])));
        // flexcan.md 1.4: interrupt bits of ESR1: set by their event, against a clear too; cleared
        // by a written 1, by a soft reset, the warnings without WRN_EN; nothing else.
        p_esr1_events: assert (f_five(esr1_o) == ($past(clear_i) ? 5'd0
            : (($past(f_event) | (f_five($past(esr1_o)) & ~f_five($past(f_esr_w1c))))
               & {{2{wrn_en_i}}, 3'b111})));
        // flexcan.md 1.4: error bits: set by their error, cleared by the read that returns them;
        // an error in that very clock is not lost.
        p_esr1_errors: assert (esr1_o[15:10] == ($past(clear_i) ? 6'd0
            : ($past({err_i[can_pkg::ErrBit1], err_i[can_pkg::ErrBit0], err_i[can_pkg::ErrAck],
                      err_i[can_pkg::ErrCrc], err_i[can_pkg::ErrForm], err_i[can_pkg::ErrStuff]})
               | ($past(esr1_rd_i) ? 6'd0 : $past(esr1_o[15:10])))));
      end
    end
  end
