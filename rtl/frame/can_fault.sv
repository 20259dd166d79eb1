// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_fault: error counters and error state, the fault confinement of ISO 11898-1 (FC, BO). A bit
// changes at most one of the counters (FC-01), so both share one counting logic.

module can_fault (
  input  logic            clk_i,
  input  logic            rst_ni,
  input  logic            run_i,            // engine is active
  input  logic            sample_i,         // pulse: sample point
  input  logic            bit_i,            // sampled bit
  input  can_pkg::field_t field_i,          // field of the current bit
  input  logic [3:0]      after_flag_i,     // FldWait: {first bit after flag, left modulo 8}
  input  logic            ends_i,           // last bit of the field
  input  logic            last_i,           // last bit of the field, registered
  input  logic            free_i,           // a frame may begin after this bit
  input  logic            sent_i,           // level that this node sent in the bit
  input  logic            transmitter_i,    // transmitter of the current frame
  input  logic            overload_frame_i, // flag or delimiter belongs to an overload frame
  input  logic            passive_flag_i,   // error flag that is sent is passive
  input  logic            error_i,          // error in this bit
  input  logic            exempt_i,         // it is a stuff error in arbitration (FC-05 exc. 2)
  input  logic            ack_error_i,      // it is an ACK error
  input  logic            lom_i,            // listen-only: counters are frozen (FC-22)
  input  logic            boff_rec_i,       // 1: no automatic recovery from bus-off (BO-03)
  input  logic            clear_i,          // clear both counters (soft reset); only while stopped
  input  logic            we_i,             // write both counters; only while stopped
  input  logic [15:0]     wdata_i,          // {REC, TEC}
  output logic [8:0]      tec_o,            // 8: bus-off; 7:0: TEC, in bus-off sequences counted
  output logic [7:0]      rec_o,            // REC
  output logic            passive_o,        // error passive
  output logic            boff_o,           // bus-off
  output logic            boff_enter_o,     // pulse: bus-off begins
  output logic            boff_end_o        // a recessive bit here completes the recovery
);

  logic [8:0] tec_q;
  logic [7:0] rec_q;
  logic       withheld_q;   // passive ACK error that is not counted yet (FC-05a)
  logic       hold_q;       // bus-off without automatic recovery
  logic       boff_seen_q;  // first clock of bus-off is over

  assign tec_o     = tec_q;
  assign rec_o     = rec_q;
  assign boff_o    = tec_q[8];
  assign boff_enter_o = tec_q[8] && !boff_seen_q;
  assign passive_o = !tec_q[8] && (tec_q[7] || rec_q[7]);   // FC-11, FC-12

  // BO-02: 128 sequences of 11 recessive bits. If recovery is held, the count waits at 128.
  assign boff_end_o = ends_i && (tec_q[7] || (&tec_q[6:0])) && !hold_q;

  // Decided at the sample point and counted in the next clock. This is early enough for all readers
  // and keeps the counters off the longest path.
  logic       plus8_q, plus1_q, minus1_q, sequence_q, recovered_q;
  logic       decided_q;    // clock after a sample point; nothing changes in any other
  logic       on_tec_q;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) decided_q <= 1'b0;
    else         decided_q <= sample_i;
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {plus8_q, plus1_q, minus1_q, sequence_q, recovered_q} <= '0;
      {withheld_q, on_tec_q} <= '0;
    end else if (decided_q && !sample_i) begin
      {plus8_q, plus1_q, minus1_q, sequence_q, recovered_q} <= '0;
    end else if (sample_i) begin : decide
      logic saw_d, in_flag, in_wait, first, eighth, good_tx, good_rx, withhold, late;

      saw_d   = !bit_i;
      in_flag = (&field_i[4:2]) && (field_i[1:0] == 2'b00 || field_i[1:0] == 2'b11);
      in_wait = (field_i == can_pkg::FldWait) && saw_d;
      first   = in_wait && after_flag_i[3];
      eighth  = in_wait && after_flag_i[2:0] == 3'd0;
      // A passive transmitter counts a missing ACK only if it sees dominant during its flag.
      withhold = ack_error_i && passive_o;                                               // FC-05
      late     = withheld_q && saw_d && field_i == can_pkg::FldErrFlag && passive_flag_i;  // FC-05a
      good_tx  = (field_i == can_pkg::FldEof) && last_i && bit_i && transmitter_i;       // FC-09
      good_rx  = (field_i == can_pkg::FldAck) && !sent_i && saw_d;                       // FC-10

      // The counter is that of the role in this bit, even if the engine stops after it.
      on_tec_q <= transmitter_i || tec_q[8];
      plus8_q <= !lom_i && (late
                 || (error_i && (transmitter_i ? !(exempt_i || withhold) : in_flag))   // FC-05..07
                 || eighth                                                               // FC-08
                 || (first && !transmitter_i && !overload_frame_i));                     // FC-04
      plus1_q <= !lom_i && error_i && !transmitter_i && !in_flag;                        // FC-02
      minus1_q <= !lom_i && (transmitter_i ? good_tx && (tec_q[7:0] != '0)
                                           : good_rx && (rec_q != '0));
      sequence_q  <= (field_i == can_pkg::FldBusOff) && last_i && bit_i && !tec_q[7];
      recovered_q <= tec_q[8] && free_i;                                                 // BO-05

      if (error_i)                                          withheld_q <= withhold;
      else if (field_i != can_pkg::FldErrFlag || saw_d)     withheld_q <= 1'b0;
    end
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      tec_q <= '0;
      rec_q <= '0;
    end else if (recovered_q || (clear_i && !run_i)) begin
      tec_q <= '0;
      rec_q <= '0;
    end else if (we_i && !run_i) begin
      rec_q <= wdata_i[15:8];
      if (!tec_q[8]) tec_q[7:0] <= wdata_i[7:0];
    end else if (boff_enter_o) begin
      tec_q[7:0] <= '0;                                                                  // FC-13
    end else if (sequence_q || plus8_q || plus1_q || minus1_q) begin : count
      logic [8:0] counter, goes, sum;
      logic       turns;
      // Counting by 1 starts at bit 0, by 8 at bit 3. Up: invert all bits up to and including the
      // first 0; down: up to and including the first 1. This takes no adder, and no bit waits for
      // the one below.
      counter = on_tec_q ? tec_q : {1'b0, rec_q};
      goes    = counter ^ {9{minus1_q}};  // the bits that a step goes through
      for (int i = 0; i < 9; i++) begin
        turns  = i < 3 ? !plus8_q && (&(goes | (9'h1ff << i)))
                       : (plus8_q || (&goes[2:0])) && (&(goes | 9'd7 | (9'h1ff << i)));
        sum[i] = counter[i] ^ turns;
      end
      if (on_tec_q)       tec_q <= sum;
      else if (!rec_q[7]) rec_q <= sum[7:0];
      else if (minus1_q)  rec_q <= 8'd127;                                               // FC-10
    end
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      hold_q      <= 1'b0;
      boff_seen_q <= 1'b0;
    end else begin
      boff_seen_q <= tec_q[8];
      if (!tec_q[8] || !boff_rec_i) hold_q <= 1'b0;
      else if (!boff_seen_q)        hold_q <= 1'b1;
    end
  end

endmodule
