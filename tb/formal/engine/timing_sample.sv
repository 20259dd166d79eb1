  // SPDX-FileCopyrightText: 2026 The VeriCAN authors
  // SPDX-License-Identifier: Apache-2.0
  //
  // The sample point, quantum by quantum, for bits of the lengths assumed here; every SJW.

  always @(posedge clk_i) begin
    // 8 quanta: PROP_SEG 1, PHASE_SEG1 3, PHASE_SEG2 3.
    m_length: assume (propseg_i == 3'd0 && pseg1_i == 3'd2 && pseg2_i == 3'd2);
  end

  always @(posedge clk_i) if (rst_ni && run_i && f_known) begin
      // BT-05, BT-06, SY-06, SY-07, SY-08, SY-10: the sample point comes in its quantum, in no
      // other.
      p_sample: assert (sample_o == (tq_i && f_now == f_due_next));
      // SY-08, SY-16: without hard synchronisation a bit is at most SJW off its length.
      p_length: assert (!sample_o || f_synced_hard || (f_now >= f_nominal - f_sjw
                                                       && f_now <= f_nominal + f_sjw));
  end
