// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_time_sync: follower without a CPU (TM-100 to TM-105). Each pair of SYNC and FUP shifts the
// clock by its offset and corrects the rate towards that of the master.
//
// All arithmetic is bit-serial, lowest bit first. A round of 64 clocks processes one 64-bit number,
// and a pair takes at most seven rounds. result_q collects the data for the clock, ofs_o the offset
// for software.

module can_time_sync #(
  /// Increment after a reset, see can_clock.
  parameter logic [39:0] TimeInc = 40'h14_0000_0000
) (
  input  logic        clk_i,
  input  logic        rst_ni,
  // Registers of the follower.
  input  logic [31:0] ctrl_i,        // TSCTRL
  input  logic [31:0] id_i,          // TSID
  input  logic [23:0] delay_i,       // TSDLY
  output logic [31:0] stat_o,        // TSSTAT
  output logic [31:0] ofs_o,         // TSOFS; not stable while a pair is processed
  output logic        changed_o,     // pulse: TSSTAT.STATE changes
  // Reception, as in can_core.
  input  logic        rx_hdr_i,      // pulse: rx_id_i, rx_ide_i, rx_rtr_i are valid
  input  logic [28:0] rx_id_i,       // identifier; base frames in [28:18]
  input  logic        rx_ide_i,      // extended frame
  input  logic        rx_rtr_i,      // remote frame
  input  logic [3:0]  rx_dlc_i,      // raw DLC, valid with rx_valid_i
  input  logic        rx_byte_we_i,  // pulse: rx_byte_i is new
  input  logic [7:0]  rx_byte_i,     // received byte, stable for a bit
  input  logic        rx_valid_i,    // pulse: frame is valid
  // Time unit. Commands of the CPU take precedence.
  input  logic [63:0] stamp_i,       // stamp of the frame, good two clocks after rx_valid_i
  input  logic [39:0] inc_i,         // increment: 39:32 ns, 31:0 in 2^-32 ns
  input  logic        upset_i,       // compare unit needs to be armed again (TM-141)
  input  logic [can_pkg::TimeCmdWidth-1:0] cmd_i, // commands of the CPU
  output logic [can_pkg::TimeCmdWidth-1:0] cmd_o, // commands of CPU and follower
  output logic        own_o,         // data_o belongs to cmd_o; 0: the data of the CPU
  output logic [63:0] data_o         // data of the follower's command
);
  typedef enum logic [1:0] {
    StNone,       // unsynchronised: no pair yet, or none of a rate set anew
    StAcquiring,  // eight pairs that turn the rate with all of their weight, four as in LOCKED
    StLocked,
    StHoldover    // no pair for too long
  } state_t;
  // Operation of a round. No enumeration, because Icarus would require casts.
  localparam logic [2:0] OpIdle    = 3'd0;
  localparam logic [2:0] OpSeconds = 3'd1;  // load the seconds from the word of a SYNC
  localparam logic [2:0] OpOffset  = 3'd2;  // compute the offset; result_q := -offset
  localparam logic [2:0] OpJudge   = 3'd3;  // step or not; halve the shift; saturate TSOFS
  localparam logic [2:0] OpShift   = 3'd4;  // shift in the first clock; end a slew half-way
  localparam logic [2:0] OpRate    = 3'd5;  // compute the new increment in result_q
  localparam logic [2:0] OpTurn    = 3'd6;  // rotate it into position; set the rate half-way
  localparam logic [2:0] OpWhole   = 3'd7;  // compute a whole second; arm half-way
  localparam logic [6:0] OneNs = 7'd26;   // index of the bit of timer_q that is worth 1 ns

  logic       enable, pps;
  logic [4:0] ki;
  logic [1:0] kd;
  logic [5:0] tmo;
  assign enable = ctrl_i[can_regs_pkg::TsctrlEn];
  assign pps    = ctrl_i[can_regs_pkg::TsctrlPps];
  assign ki     = ctrl_i[can_regs_pkg::TsctrlKi +: can_regs_pkg::TsctrlKiW];
  assign kd     = ctrl_i[can_regs_pkg::TsctrlKd +: can_regs_pkg::TsctrlKdW];
  assign tmo    = ctrl_i[can_regs_pkg::TsctrlTmo +: can_regs_pkg::TsctrlTmoW];
  logic unused;
  assign unused = &{1'b0, ctrl_i};

  state_t     state_q, state_d;
  logic [2:0] op_q, op_d;
  logic [5:0] count_q;
  logic       low, first, half_way, last;
  assign low      = !count_q[5];
  assign first    = count_q == '0;
  assign half_way = count_q == 6'd32;
  assign last     = &count_q;

  // count_q[5:3] and count_q[2:0], one-hot.
  logic [7:0] byte_q, bit_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      byte_q <= 8'd1;
      bit_q  <= 8'd1;
    end else if (enable) begin
      bit_q <= {bit_q[6:0], &count_q[2:0]};
      if (&count_q[2:0]) byte_q <= {byte_q[6:0], &count_q[5:3]};
    end
  end

  // Messages, and the offset of a pair.
  logic       sync, pair, word, whole, offset, offset_round;
  logic [3:0] sc;
  logic [1:0] ovs;
  assign offset_round = op_q == OpOffset;
  can_time_pair u_pair (
    .clk_i, .rst_ni, .enable_i(enable),
    .domain_i(ctrl_i[can_regs_pkg::TsctrlDomain +: can_regs_pkg::TsctrlDomainW]), .id_i,
    .rx_hdr_i, .rx_id_i, .rx_ide_i, .rx_rtr_i, .rx_dlc_i, .rx_byte_we_i, .rx_byte_i, .rx_valid_i,
    .count_i(bit_q), .shift_i(op_q == OpSeconds || offset_round), .bit_o(word),
    .sync_o(sync), .pair_o(pair), .sc_o(sc), .ovs_o(ovs));
  can_time_offset u_offset (
    .clk_i, .rst_ni, .sync_i(sync), .stamp_i, .delay_i, .ovs_i(ovs), .count_i(count_q),
    .byte_i(byte_q), .bit_i(bit_q),
    .load_i(op_q == OpSeconds), .run_i(offset_round || op_q == OpWhole), .word_i(word),
    .whole_o(whole), .offset_o(offset));

  // Magnitude of the offset. It is far from 2^20 ns on, in LOCKED from 2^12 ns on. TSOFS saturates
  // from 2^31 ns on.
  logic above, below_q, one_q, zero_q, one_31_q, zero_31_q, negative_q, far, beyond;
  assign above  = count_q[5] || (state_q == StLocked ? count_q[4] || (count_q[3] && count_q[2])
                                                     : count_q[4] && (count_q[3] || count_q[2]));
  assign far    = one_q && (zero_q || !below_q);
  assign beyond = one_31_q && zero_31_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {below_q, one_q, zero_q, one_31_q, zero_31_q, negative_q} <= '0;
    end else if (offset_round) begin
      below_q    <= !first && (below_q || !above && offset) || first && offset;
      one_q      <= !first && (one_q || above && offset);
      zero_q     <= !first && (zero_q || above && !offset);
      one_31_q   <= low && count_q[4:0] != '1 ? 1'b0 : one_31_q || offset;
      zero_31_q  <= low && count_q[4:0] != '1 ? 1'b0 : zero_31_q || !offset;
      negative_q <= offset;
    end
  end

  // Decision on the pair (TM-103), and next state.
  logic [7:0] pairs_q;
  logic       leap_q, started, light, ignored, step, anew, arms, done, late, seconds_due_q,
    pair_due_q;
  assign started = state_q == StAcquiring || state_q == StLocked;
  assign light   = state_q == StLocked || pairs_q[3];   // in StAcquiring there are 11 at most
  assign ignored = state_q == StLocked && far && !leap_q;
  assign step    = !started || far;
  // If the offset is far while acquiring, the rate is too wrong to be corrected by pairs (an upset)
  // and restarts at TimeInc. The wrong rate was in use since the SYNC, so the next pair only shifts
  // and says nothing about the new rate.
  assign anew    = state_q == StAcquiring && far;
  // Arming sets the output to 0, so it is avoided where it is not needed: after a holdover with a
  // clock that is still near, the compare unit waits for the right time.
  assign arms    = pps && (far || upset_i || state_q == StNone);
  assign done    = last && ((op_q == OpShift && step && !anew) || op_q == OpTurn);
  always_comb begin
    op_d = op_q;
    case (op_q)
      OpIdle: begin
        if (seconds_due_q)   op_d = OpSeconds;
        else if (pair_due_q) op_d = OpOffset;
      end
      OpOffset: op_d = OpJudge;
      OpJudge: begin
        if (ignored) op_d = OpIdle;
        else         op_d = OpShift;
      end
      OpShift: begin
        if (!step || anew) op_d = OpRate;
        else if (arms)     op_d = OpWhole;
        else               op_d = OpIdle;
      end
      OpRate:  op_d = OpTurn;
      OpTurn: begin
        if (pps && upset_i) op_d = OpWhole;
        else                op_d = OpIdle;
      end
      default: op_d = OpIdle;
    endcase
    state_d = state_q;
    if (done) begin
      if (anew)                                          state_d = StNone;
      else if (step)                                     state_d = StAcquiring;
      else if (state_q == StAcquiring && pairs_q >= 8'd11) state_d = StLocked;
    end else if (late && started) begin
      state_d = StHoldover;
    end
    if (!enable) state_d = StNone;
  end
  assign changed_o = state_d != state_q;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      op_q    <= OpIdle;
      state_q <= StNone;
      count_q <= '0;
      pairs_q <= '0;
      {leap_q, seconds_due_q, pair_due_q} <= '0;
    end else begin
      state_q <= state_d;
      if (enable) count_q <= count_q + 6'd1;
      if (!enable)   op_q <= OpIdle;
      else if (last) op_q <= op_d;
      seconds_due_q <= enable && (sync || (seconds_due_q && op_q != OpSeconds));
      pair_due_q    <= enable && (pair || (pair_due_q && !offset_round));
      leap_q        <= enable && !done && (leap_q || (op_q == OpJudge && last && ignored));
      if (done) pairs_q <= step ? '0 : pairs_q + {7'b0, pairs_q != '1};
    end
  end

  // The settings of a correction, as they are when its offset is computed: software may change them
  // in any clock.
  logic [4:0] k_q;
  logic       halve_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      k_q     <= '0;
      halve_q <= 1'b0;
    end else if (offset_round) begin
      k_q     <= ki - (light ? {3'b0, kd} : '0);
      halve_q <= light && ctrl_i[can_regs_pkg::TsctrlPhalf];
    end
  end

  // New increment: increment - offset 2^K. ofs_o rotates once from bit K on, then its sign is used.
  // With anew, the increment is TimeInc.
  logic       at_k, begun_q, over_q, begun, rate_round, turning, inc, nominal, term, rate, borrow_q;
  assign rate_round = op_q == OpRate;
  assign at_k       = rate_round && !anew && count_q[4:0] == k_q;
  assign begun      = begun_q || at_k;
  assign turning    = begun && !over_q && !(begun_q && at_k);
  assign term       = begun && (turning ? ofs_o[0] : ofs_o[31]);
  assign rate       = anew ? nominal : inc ^ term ^ borrow_q;
  can_time_bits #(.Bytes(5)) u_inc (
    .word_i(inc_i), .byte_i(byte_q[4:0]), .bit_i(bit_q), .bit_o(inc));
  can_time_bits #(.Bytes(5)) u_nominal (
    .word_i(TimeInc), .byte_i(byte_q[4:0]), .bit_i(bit_q), .bit_o(nominal));
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {begun_q, over_q, borrow_q} <= '0;
    end else begin
      begun_q  <= rate_round && !last && begun;
      over_q   <= rate_round && !last && (over_q || (begun_q && at_k));
      borrow_q <= rate_round && ((!inc && term) || ((!inc || term) && borrow_q));
    end
  end

  // TSOFS: loaded, saturated, or rotated.
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      ofs_o <= '0;
    end else if (low && offset_round) begin
      ofs_o <= {offset, ofs_o[31:1]};
    end else if (low && op_q == OpJudge && beyond) begin
      ofs_o <= {negative_q == &count_q[4:0], ofs_o[31:1]};
    end else if (turning) begin
      ofs_o <= {ofs_o[0], ofs_o[31:1]};
    end
  end

  // Data for the clock. Half of the shift: -floor(o / 2) = floor((1 - o) / 2).
  logic        halving, any_q, half_carry_q, next;
  logic [63:0] result_q;
  assign halving = op_q == OpJudge && halve_q && !step;
  always_comb begin
    case (op_q)
      OpOffset: next = offset ^ any_q;
      OpJudge:  next = last ? result_q[63] : result_q[1] ^ (first ? result_q[0] : half_carry_q);
      OpRate:   next = rate;
      OpTurn:   next = result_q[0];
      default:  next = whole;
    endcase
  end
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      result_q <= '0;
      {any_q, half_carry_q} <= '0;
    end else begin
      if (offset_round || halving || rate_round || (low && op_q[2]))
        result_q <= {next, result_q[63:1]};
      any_q        <= offset_round && (any_q || offset);
      half_carry_q <= result_q[1] && (first ? result_q[0] : half_carry_q);
    end
  end

  // Time since the last pair (TM-104). It grows by 64 increments per round, so that bit n of it is
  // worth 2^(n - 26) ns. It is compared only between pairs.
  logic [63:0] timer_q;
  logic        timer, timer_carry_q;
  assign timer = !offset_round && (timer_q[0] ^ inc ^ timer_carry_q);
  assign late  = timer && op_q == OpIdle && {1'b0, count_q} == {1'b0, tmo} + OneNs;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      timer_q       <= '0;
      timer_carry_q <= 1'b0;
    end else if (enable) begin
      timer_q       <= {timer, timer_q[63:1]};
      timer_carry_q <= !last && !offset_round
                    && ((timer_q[0] && inc) || ((timer_q[0] || inc) && timer_carry_q));
    end
  end

  // A command of the CPU takes precedence; the follower's command in the same clock is lost.
  logic shift_now, slew_now, rate_now, whole_now;
  assign shift_now = op_q == OpShift && first;
  assign slew_now  = op_q == OpShift && half_way;   // result_q[63:32] is 0 by then
  assign rate_now  = op_q == OpTurn && half_way;
  assign whole_now = op_q == OpWhole && half_way;
  assign own_o     = enable && cmd_i[can_pkg::TimeArm:0] == '0;
  assign data_o    = result_q;
  always_comb begin
    cmd_o = cmd_i;
    cmd_o[can_pkg::TimeShift] = cmd_i[can_pkg::TimeShift] || (own_o && shift_now);
    cmd_o[can_pkg::TimeRate]  = cmd_i[can_pkg::TimeRate]  || (own_o && rate_now);
    cmd_o[can_pkg::TimeSlew]  = cmd_i[can_pkg::TimeSlew]  || (own_o && slew_now);
    cmd_o[can_pkg::TimeArm]   = cmd_i[can_pkg::TimeArm]   || (own_o && whole_now);
  end

  assign stat_o = {16'b0, pairs_q, sc, 2'b0, state_q};
endmodule
