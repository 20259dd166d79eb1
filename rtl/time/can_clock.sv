// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_clock: TIME, a clock with 64 bits of ns and 32 bits of fraction. It can be set, shifted,
// slewed and run at another rate (TM-10 to TM-18).
//
// To keep carries short there are three adders, for fraction, lower and upper half, each one clock
// behind the one before. A command passes the same registers, so that it acts on all three in the
// same clock of TIME, the fourth after the clock in which it is given. lo_o is one clock ahead, for
// blocks that compare: TIME is hi_o with the lo_o of the clock before. This also holds after a
// reset.

module can_clock #(
  /// Increment after a reset: 39:32 ns, 31:0 in 2^-32 ns a clock.
  parameter logic [39:0] TimeInc = 40'h14_0000_0000
) (
  input  logic        clk_i,
  input  logic        rst_ni,
  // Commands, at most one per clock. Of a register pair, the second word is data_i[63:32].
  input  logic        set_i,       // pulse: TIME := data_i
  input  logic        shift_i,     // pulse: TIME := TIME + data_i
  input  logic        rate_i,      // pulse: increment := {ns data_i[7:0], fraction data_i[63:32]}
  input  logic        slew_i,      // pulse: work off data_i[63:32], signed ns, in steps of 1 ns
  input  logic [63:0] data_i,      // data of the command
  input  logic [1:0]  slewr_i,     // TCTRL.SLEWR: a step when bit 13 - slewr_i of TIME changes
  output logic [31:0] lo_o,        // TIME[31:0] of the next clock
  output logic [31:0] hi_o,        // TIME[63:32]
  output logic [31:0] left_o,      // rest of the slew, signed ns (TSLEW)
  output logic [39:0] inc_o        // increment: 39:32 ns, 31:0 in 2^-32 ns
);
  if (TimeInc == '0) begin : gen_check_time_inc
    TimeInc_must_be_more_than_0 u_stop ();   // no such module: its name is the message
  end

  logic [7:0]  incn_q, incn;
  logic [31:0] incf_q;
  assign incn  = rate_i ? data_i[7:0] : incn_q;
  assign inc_o = {incn_q, incf_q};

  // Slew. No step is made that would let TIME stand still or run back (TM-15, TM-17).
  logic slew_bit, bit_q, changed_q, step, forth, back;
  always_comb begin
    case (slewr_i)
      2'd0:    slew_bit = lo_o[13];
      2'd1:    slew_bit = lo_o[12];
      2'd2:    slew_bit = lo_o[11];
      default: slew_bit = lo_o[10];
    endcase
  end
  assign step  = changed_q && (left_o != '0) && (incn[7:1] != '0);
  assign forth = step && !left_o[31];
  assign back  = step && left_o[31];

  // Increment plus slew step. It is registered before it is added to TIME.
  logic [8:0] grow_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      incn_q <= TimeInc[39:32];
      incf_q <= TimeInc[31:0];
      grow_q <= {1'b0, TimeInc[39:32]};
      {bit_q, changed_q} <= '0;
      left_o <= '0;
    end else begin
      incn_q <= incn;
      grow_q <= {1'b0, incn} + {9{back}} + {8'b0, forth};
      if (rate_i) incf_q <= data_i[63:32];
      bit_q     <= slew_bit;
      changed_q <= slew_bit != bit_q;
      if (slew_i)    left_o <= data_i[63:32];
      else if (step) left_o <= left_o + {32{!left_o[31]}} + {31'b0, left_o[31]};
    end
  end

  // First clock of a command: registered once, to stay in step with a new increment.
  logic        set1_q, offset1_q;
  logic [63:0] data_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {set1_q, offset1_q} <= '0;
      data_q <= '0;
    end else begin
      set1_q    <= set_i;
      offset1_q <= set_i || shift_i;
      data_q    <= data_i;
    end
  end

  // Second clock: addend of the lower half; and the fraction, whose carry reaches the lower half
  // two clocks later.
  logic        set2_q, offset2_q, carry_q, carry2_q;
  logic [32:0] addend, addend_q;
  logic [31:0] fraction_q, upper2_q;
  assign addend = {1'b0, data_q[31:0]} + (set1_q ? '0 : {24'b0, grow_q});
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      addend_q   <= {25'b0, TimeInc[39:32]};
      {carry_q, fraction_q} <= {TimeInc[31:0], 1'b0};
      upper2_q   <= '0;
      {set2_q, offset2_q, carry2_q} <= '0;
    end else begin
      set2_q    <= set1_q;
      offset2_q <= offset1_q;
      addend_q  <= offset1_q ? addend : {24'b0, grow_q};
      upper2_q  <= data_q[63:32];
      carry2_q  <= carry_q;
      {carry_q, fraction_q} <= set1_q ? '0 : {1'b0, fraction_q} + {1'b0, incf_q};
    end
  end

  // Third clock: lower half. Fourth clock: upper half.
  logic        set3_q, carry3_q;
  logic [31:0] upper3_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {set3_q, carry3_q} <= '0;
      {hi_o, upper3_q} <= '0;
      lo_o <= {24'b0, TimeInc[39:32]};
    end else begin
      set3_q   <= set2_q;
      upper3_q <= offset2_q ? upper2_q + {31'b0, addend_q[32]} : '0;
      if (set2_q) {carry3_q, lo_o} <= {1'b0, addend_q[31:0]};
      else {carry3_q, lo_o} <= {1'b0, lo_o} + {1'b0, addend_q[31:0]} + {32'b0, carry2_q};
      if (set3_q) hi_o <= upper3_q;
      else        hi_o <= hi_o + upper3_q + {31'b0, carry3_q};
    end
  end
endmodule
