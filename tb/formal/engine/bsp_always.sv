  // SPDX-FileCopyrightText: 2026 The VeriCAN authors
  // SPDX-License-Identifier: Apache-2.0
  //
  // Properties of can_bsp, spliced into it: what holds in every bit on every bus (TH-06).

  logic f_stuffed, f_frame_bit, f_may_drive, f_gap;
  assign f_stuffed   = (field_o[4] != field_o[3]);
  assign f_gap       = (field_o[4:3] == 2'b00);
  // Where the node may be dominant: own frame, ACK slot, active flag, overload flag.
  assign f_frame_bit = transmitter_o && (f_stuffed || (field_o == can_pkg::FldCrcDel && stuff_o));
  assign f_may_drive = f_frame_bit || (field_o == can_pkg::FldAck && !transmitter_o)
                       || (field_o == can_pkg::FldErrFlag && !passive_flag)
                       || field_o == can_pkg::FldOvlFlag;

  // Run of equal levels that the transmitter has sent in its frame, up to the bit before.
  logic [2:0] f_run;
  logic       f_level;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) {f_run, f_level} <= 4'b0001;
    else if (sample_i) begin
      if (!f_frame_bit)            f_run <= 3'd0;
      else if (f_run != 0 && f_level == tx_o) f_run <= (&f_run) ? f_run : f_run + 3'd1;
      else                         f_run <= 3'd1;
      f_level <= tx_o;
    end
  end

  // An own attempt is under way; the frame under way has seen no error.
  logic f_attempt, f_clean, f_changed;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) {f_attempt, f_clean} <= 2'b00;
    else if (!run_i) {f_attempt, f_clean} <= 2'b00;
    else if (sample_i) begin
      if (take_tx)                      f_attempt <= 1'b1;
      else if (error || lost)           f_attempt <= 1'b0;
      else if (field_o == can_pkg::FldEof && left_o == 0) f_attempt <= 1'b0;
      if (take_tx || begin_rx)          f_clean <= 1'b1;
      else if (error || overload)       f_clean <= 1'b0;
    end
  end

  // Counter steps since the last sample.
  logic f_moved, f_role;
  logic [16:0] f_counters;
  logic [1:0]  f_silent;  // listen-only in the last clocks
  assign f_moved = {tec_o, rec_o} != f_counters;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni)       {f_changed, f_role, f_counters, f_silent} <= '0;
    else begin
      if (sample_i)    f_role <= transmitter_o;
      f_counters <= {tec_o, rec_o};
      f_silent   <= {f_silent[0], run_i && lom_i};
      f_changed <= !sample_i && (f_changed || f_moved);
    end
  end

  // Recessive samples in a row while the node runs, up to eleven; and it runs in listen-only.
  logic [3:0] f_ones;
  logic       f_listens;
  assign f_listens = run_i && lom_i && f_silent[0];
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni)       f_ones <= 4'd0;
    else if (!run_i)   f_ones <= 4'd0;
    else if (sample_i) f_ones <= !bit_i ? 4'd0 : f_ones == 4'd11 ? 4'd11 : f_ones + 4'd1;
  end

  always @(posedge clk_i) if (rst_ni && !$initstate && $past(rst_ni)) begin
    // TH-06, ST-01: never six equal bits SOF..CRC on the own output.
    p_six_equal: assert (!(sample_i && f_frame_bit) || f_run < 3'd5 || f_level != tx_o);
    // TH-06: dominant only in the own frame, the ACK slot, an active flag, an overload flag.
    p_dominant_where: assert (!judge_i || tx_o || $past(f_may_drive));
    // TH-06, BO-01, IF-16, MO-01: never dominant in bus-off, integration, between frames,
    // listen-only.
    p_dominant_never: assert (!judge_i || can_tx_o || !((boff_o || $past(f_gap || !run_i
        || lom_i || lpb_i))));
    // TH-06, BT-05: the output changes at bit boundaries alone.
    p_edges: assert ($past(boundary_i) || (tx_o == $past(tx_o) && can_tx_o == $past(can_tx_o)));
    // MO-01, MO-04: the pin is dominant only if the node is.
    p_pin: assert (can_tx_o || !tx_o);
    // TH-06, FC-01: a sample point moves one counter, once; completed recovery clears both (BO-05).
    p_one_counter: assert (!$past(run_i) || !f_moved || boff_o || $past(boff_o)
                           || (!f_changed && (tec_o == $past(tec_o) || rec_o == $past(rec_o))));
    // TH-06, FC-01: TEC never moves as receiver, REC never as transmitter.
    p_tec_role: assert (!$past(run_i) || tec_o == $past(tec_o) || $past(boff_o) || f_role);
    p_rec_role: assert (!$past(run_i) || rec_o == $past(rec_o) || $past(boff_o) || !f_role);
    // TH-06, VA-01, RO-05: a frame is valid at EOF6, without error since its start, its CRC right.
    p_delivery: assert (!(rx_valid_o && !$past(rx_valid_o)) || ($past(sample_i && bit_i
                        && field_o == can_pkg::FldEof && left_o == 6'd1 && !error && f_clean
                        && (transmitter_o || !mismatch))));
    // TH-06, VA-02, VA-06: success at EOF7 of an own frame without error, at no other bit.
    p_success: assert (!(tx_ok_o && !$past(tx_ok_o)) || $past(sample_i && bit_i && transmitter_o
                       && field_o == can_pkg::FldEof && left_o == 6'd0 && !error && f_clean));
    // TH-06: an attempt ends once, as success or failure, and only an attempt ends.
    p_end_once: assert (!((tx_ok_o || tx_fail_o) && $past(sample_i))
                        || ($past(f_attempt) && !(tx_ok_o && tx_fail_o)));
    // TH-06: an attempt that ends while the node runs is told.
    p_end_told: assert (!($past(f_attempt && run_i && sample_i) && !f_attempt)
        || tx_ok_o != tx_fail_o);
    // TH-06: and it does end, before the next begins: it is under way while its frame is.
    p_end_ever: assert ((!(take_tx && sample_i && run_i) || !f_attempt)
                        && f_attempt == (transmitter_o && in_frame));
    // TH-06, CR-05: the CRC register is 0 when a frame begins, whatever came before.
    p_crc_zero: assert (!$past(run_i && sample_i && (take_tx || begin_rx)) || (crc_o == '0
        && !mismatch));
    // FC-22: listen-only moves no counter.
    p_frozen: assert (f_silent != 2'b11 || !f_moved || boff_o || $past(boff_o));
    // MO-02: listen-only is never in a flag or a delimiter.
    p_no_flag: assert (!f_listens || !(&field_o[4:2]));
    // MO-02, IN-01: after eleven recessive bits it is idle, whatever went wrong before, unless a
    // good frame that nobody acknowledged ends.
    p_rejoin: assert (!f_listens || fd_tolerant_i || f_ones != 4'd11
        || field_o == can_pkg::FldIdle || field_o == can_pkg::FldEof || field_o == can_pkg::FldInt
        || field_o == can_pkg::FldBusOff);
    // What it integrates with and what it counts in a frame are these bits.
    l_integ_ones: assert (!f_listens || fd_tolerant_i || field_o != can_pkg::FldInteg
        || left_o == 6'd10 - {2'd0, f_ones});
    l_frame_ones: assert (!f_listens || field_o[4:3] == 2'b00
        || field_o[4:2] == 3'b111 || field_o == can_pkg::FldEof || {1'b0, ones} == f_ones);
    // IF-01, IF-08, EF-01, OV-01, IN-01: no place between frames, in a flag or delimiter is longer
    // than its rule.
    p_places: assert (left_o <= (((&field_o[4:2]) && field_o[1:0] != 2'd2
        && field_o[1:0] != 2'd1) ? 6'd5
                      : field_o == can_pkg::FldDel ? 6'd6 : field_o == can_pkg::FldInt ? 6'd2
                      : field_o == can_pkg::FldSuspend ? 6'd7 : field_o == can_pkg::FldInteg ? 6'd10
                      : 6'd63));
    // EF-01, EF-02, OV-01: between frames, in flags and delimiters the level is what the place
    // wants.
    p_level: assert (!judge_i || !$past(stay_i && run_i) || $past(field_o[4:3] != 2'b00
        && !(&field_o[4:2]))
                     || tx_o == !$past((field_o == can_pkg::FldErrFlag && !passive_flag)
                                       || field_o == can_pkg::FldOvlFlag));
  end
