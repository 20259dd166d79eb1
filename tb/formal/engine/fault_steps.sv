  // SPDX-FileCopyrightText: 2026 The VeriCAN authors
  // SPDX-License-Identifier: Apache-2.0
  //
  // Steps of TEC and REC by the rules of fault confinement (FC-01..FC-17), written from the rules
  // and compared with the counters of can_fault two clocks after each sample point. Spliced into
  // can_bsp, so that causes are what the whole bit stream processor makes of the bus.

  // Dominant bits since the own flag ended (FC-04, FC-08), counted here anew.
  logic [3:0] f_d_after;   // 0..8, then 1..8 again
  logic       f_flag, f_wait, f_first, f_eighth;
  assign f_flag   = field_o == can_pkg::FldErrFlag || field_o == can_pkg::FldOvlFlag;
  assign f_wait   = field_o == can_pkg::FldWait;
  assign f_first  = f_wait && !bit_i && f_d_after == 4'd0;
  assign f_eighth = f_wait && !bit_i && f_d_after == 4'd7;
  logic f_wait_once;  // a dominant bit came after this flag already
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) {f_d_after, f_wait_once} <= '0;
    else if (sample_i) begin
      if (!f_wait)     {f_d_after, f_wait_once} <= '0;
      else if (!bit_i) begin
        f_d_after   <= (f_d_after == 4'd7) ? 4'd0 : f_d_after + 4'd1;
        f_wait_once <= 1'b1;
      end
    end
  end

  // The last flag was an error flag; a passive transmitter's ACK error is not yet counted.
  logic f_error_flag, f_withheld;
  logic f_ack_exempt;
  assign f_ack_exempt = field_o == can_pkg::FldAck && bit_i && tx_o && transmitter_o && passive_o;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) {f_error_flag, f_withheld} <= '0;
    else if (sample_i) begin
      if (f_flag)         f_error_flag <= field_o == can_pkg::FldErrFlag;
      if (error)          f_withheld   <= f_ack_exempt;
      else if (!bit_i || field_o != can_pkg::FldErrFlag) f_withheld <= 1'b0;
    end
  end

  // Exception 2: a stuff bit before RTR, sent recessive, sampled dominant. The one after a base RTR
  // (FldIde) may count or not (FC-05b).
  logic f_arb_exempt;
  assign f_arb_exempt = transmitter_o && stuff_o && tx_o && !bit_i
                        && (field_o == can_pkg::FldId || field_o == can_pkg::FldRtr
                            || field_o == can_pkg::FldIde || field_o == can_pkg::FldExId
                            || field_o == can_pkg::FldExRtr);

  logic f_t8, f_t1, f_r8, f_r1, f_rdec;   // steps of TEC: +8, -1; of REC: +8, +1, -1
  assign f_t8 = !lom_i && transmitter_o
                && ((error && !f_arb_exempt && !f_ack_exempt) || f_eighth
                    || (f_withheld && !bit_i && field_o == can_pkg::FldErrFlag));
  assign f_t1 = !lom_i && transmitter_o && !error && bit_i
                && field_o == can_pkg::FldEof && left_o == 6'd0;
  assign f_r8 = !lom_i && !transmitter_o
                && ((error && f_flag) || f_eighth || (f_first && !f_wait_once && f_error_flag));
  assign f_r1 = !lom_i && !transmitter_o && error && !f_flag;
  assign f_rdec = !lom_i && !transmitter_o && !error && !bit_i && !tx_o
                  && field_o == can_pkg::FldAck;

  logic       f_s1, f_s2, f_on1, f_on2;   // one, two clocks after a sample; the node was running
  logic [8:0] f_tec0;
  logic [7:0] f_rec0;
  logic       f_t8_1, f_t1_1, f_r8_1, f_r1_1, f_rdec_1, f_boff_count;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {f_s1, f_s2, f_on1, f_on2} <= '0;
      {f_tec0, f_rec0, f_t8_1, f_t1_1, f_r8_1, f_r1_1, f_rdec_1, f_boff_count} <= '0;
    end else begin
      f_s1  <= sample_i;
      f_s2  <= f_s1;
      f_on1 <= run_i;
      f_on2 <= f_on1 && run_i;
      if (sample_i) begin
        {f_tec0, f_rec0} <= {tec_o, rec_o};
        {f_t8_1, f_t1_1, f_r8_1, f_r1_1, f_rdec_1} <= {f_t8, f_t1, f_r8, f_r1, f_rdec};
      end
    end
  end

  logic f_check;
  assign f_check = f_s2 && f_on2 && !f_tec0[8];
  always @(posedge clk_i) if (rst_ni && !$initstate && $past(rst_ni)) begin
    // FC-05, FC-05a, FC-05b, FC-05c, FC-06, FC-08, FC-09, FC-16: steps of TEC, each with its cause.
    p_tec: assert (!f_check || tec_o == (f_t8_1 ? f_tec0 + 9'd8
                                         : (f_t1_1 && f_tec0 != '0) ? f_tec0 - 9'd1 : f_tec0));
    // FC-02, FC-04, FC-07, FC-08, FC-10, FC-14: steps of REC; from 128 on it holds, down to
    // 119..127.
    p_rec: assert (!f_check || (f_rec0 > 8'd127 ? (f_rdec_1 ? rec_o >= 8'd119 && rec_o <= 8'd127
                                                            : rec_o >= 8'd128)
                                : rec_o == (f_r8_1 ? f_rec0 + 8'd8 : f_r1_1 ? f_rec0 + 8'd1
                                            : (f_rdec_1 && f_rec0 != '0) ? f_rec0 - 8'd1
                                                : f_rec0)));
    // FC-01, FC-17: no other moment moves a counter; but recovery, and software while stopped.
    p_still: assert (f_s2 || !$past(run_i) || boff_o || $past(boff_o)
                     || {tec_o, rec_o} == $past({tec_o, rec_o}));
    // FC-13: bus-off is TEC above 255, and nothing else.
    p_bus_off: assert (!f_check || boff_o == ({1'b0, f_tec0} + (f_t8_1 ? 10'd8 : 10'd0) > 10'd255));
    p_bus_off_only: assert (!boff_o || $past(boff_o) || f_s2);
    // FC-11, FC-12: passive from 128 on, active when both are below.
    p_passive: assert (passive_o == (!boff_o && (tec_o[7:0] >= 8'd128 || rec_o >= 8'd128)));
    // FC-14: REC never wraps.
    p_rec_wrap: assert (!f_check || rec_o >= f_rec0 || f_rdec_1);
  end
