  // SPDX-FileCopyrightText: 2026 The VeriCAN authors
  // SPDX-License-Identifier: Apache-2.0
  //
  // Properties of can_clock, spliced into it. There is no reset: the first clock is any content of
  // all flip-flops, and what is said of a clock follows from the five before it, so the few clocks
  // of the search stand for every clock of every run.
  //
  // TIME is {hi_o, lo_o of the clock before}; growth and setting are
  // computed here from the commands in one sum of 64 bits and carried along to their clock.

  logic [2:0]  f_clocks = 3'd0;      // since the arbitrary first one, saturates
  logic [31:0] f_lo;                 // lo_o of the clock before
  logic [63:0] f_before;             // TIME of the clock before
  logic        f_set, f_set2, f_set3, f_offset, f_carry2, f_carry3, f_jump, f_jump2, f_jump3;
  logic [63:0] f_data, f_data2, f_data3, f_grow2, f_grow3, f_growth, f_time;
  logic [1:0]  f_step;               // signed: the step that was made in the clock before, ns

  assign f_growth = {56'd0, incn_q} + {{62{f_step[1]}}, f_step};
  assign f_time   = {hi_o, f_lo};

  always @(posedge clk_i) begin
    f_clocks <= f_clocks == 3'd7 ? 3'd7 : f_clocks + 3'd1;
    f_lo     <= lo_o;
    f_before <= f_time;
    // A command, a clock after it was given; and its way.
    {f_set, f_offset, f_data} <= {set_i, shift_i, data_i};
    f_step <= !step ? 2'd0 : left_o[31] ? 2'b11 : 2'b01;
    {f_set2, f_data2}   <= {f_set, f_data};
    f_grow2             <= f_growth + (f_offset ? f_data : 64'd0);
    f_jump2             <= f_offset;
    {f_set3, f_data3, f_grow3, f_jump3} <= {f_set2, f_data2, f_grow2, f_jump2};
    f_jump              <= f_jump3;
    f_carry2            <= carry_q;
    f_carry3            <= f_carry2;
  end

  logic        f_set4, f_carry4;
  logic [63:0] f_data4, f_grow4;
  always @(posedge clk_i)
    {f_set4, f_data4, f_grow4, f_carry4} <= {f_set3, f_data3, f_grow3, f_carry3};

  always @(posedge clk_i) begin
    m_no_reset: assume (rst_ni);
    // can_time_regs: a write is one command.
    m_one: assume ({1'b0, set_i} + {1'b0, shift_i} + {1'b0, rate_i} + {1'b0, slew_i} < 2'd2);
    if (f_clocks >= 3'd6) begin
      // TM-10, TM-12, TM-13: NS is set, or the sum of itself, increment, carry, offset and step.
      p_exact: assert (f_time == (f_set4 ? f_data4 : f_before + f_grow4 + {63'd0, f_carry4}));
      // TM-17: TIME does not decrease, and grows by 257 ns at most, unless it is set or shifted.
      p_monotonic: assert (f_set4 || f_jump || f_time - f_before <= 64'd257);
    end
    if (f_clocks >= 3'd1) begin
      // TM-14: both parts of a rate in one clock, and nothing else changes them.
      p_rate: assert ({incn_q, incf_q}
                      == ($past(rate_i) ? {$past(data_i[7:0]), $past(data_i[63:32])}
                                        : {$past(incn_q), $past(incf_q)}));
      // TM-10, TM-12: the fraction and its carry; a set clears both.
      p_fraction: assert ({carry_q, fraction_q} == ($past(set1_q) ? 33'd0
                          : {1'b0, $past(fraction_q)} + {1'b0, $past(incf_q)}));
      // TM-15: what is left shrinks by the step that is made, towards 0; a write replaces it.
      p_slew: assert (left_o == ($past(slew_i) ? $past(data_i[63:32])
                      : $past(left_o) - {{30{f_step[1]}}, f_step}));
      // TM-15: a step has the sign of what is left; none if nothing is, or INCN is below 2.
      p_step: assert (f_step == 2'd0 || ($past(left_o) != 32'd0 && f_step[1] == $past(left_o[31])
                                         && incn_q >= 8'd2));
    end
  end
