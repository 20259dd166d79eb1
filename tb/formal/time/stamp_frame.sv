// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_sync, can_stamp and can_capture as can_core and can_time connect them. The pin, the own
// level, TIME and the settings are anything; of fields and bits is assumed what makes them a frame.

module stamp_frame (
  input logic        clk_i, rst_ni, pin_i, tx_i, txpin_i, sample_i, bit_i, transmitter_i,
  input logic        sof_i, rx_valid_i,
  input logic [1:0]  point_i,
  input logic [4:0]  field_i,
  input logic [63:0] now_i
);
  logic        rx, take, we, own;
  logic [63:0] stamp;
  can_sync u_sync (.clk_i, .rst_ni, .can_rx_i(pin_i), .rx_o(rx));
  can_stamp u_stamp (
    .clk_i, .rst_ni, .point_i, .txpin_i, .rx_i(rx), .tx_i, .sample_i, .bit_i, .field_i,
    .transmitter_i, .sof_i, .rx_valid_i, .take_o(take), .stamp_we_o(we), .stamp_tx_o(own));
  can_capture u_capture (.clk_i, .rst_ni, .take_i(take), .now_i, .time_o(stamp));

  // Groups of fields (can_pkg): 0 no frame, 1 arbitration, 2 behind it, 3 from CRC delimiter on.
  logic [1:0] group, group_q;
  assign group = field_i[4:3];
  logic       sampled, bit_q, mine;
  logic [2:0] run, rest;         // equal bits on the bus; clocks since a sample, both saturate
  logic [4:0] bits;              // behind the arbitration field, saturates
  logic       good, whole, sof_due, stuff_error;
  assign stuff_error = group == 2'd3 && group_q == 2'd2 && run >= 3'd6;
  always_ff @(posedge clk_i) begin
    group_q <= rst_ni ? group : 2'd0;
    sampled <= rst_ni && sample_i;
    rest    <= !rst_ni || sample_i ? 3'd0 : rest == 3'd7 ? rest : rest + 3'd1;
    mine    <= transmitter_i;
    sof_due <= rst_ni && sample_i && !bit_i;
    if (!rst_ni) begin
      {run, bits, good, whole} <= '0;
      bit_q <= 1'b1;
    end else begin
      if (sample_i) begin
        run   <= bit_i != bit_q ? 3'd1 : run == 3'd7 ? run : run + 3'd1;
        bit_q <= bit_i;
      end
      if (group == 2'd0) bits <= '0;
      else if (sample_i && group == 2'd2 && bits != '1) bits <= bits + 1'b1;
      // A frame without an error so far; all of it, once EOF6 is over.
      good  <= group != 2'd0 && !stuff_error
               && (good || (group == 2'd1 && group_q == 2'd0));
      whole <= group != 2'd0 && (whole || rx_valid_i);
    end
  end

  always @(posedge clk_i) begin
    m_reset: assume (rst_ni == !$initstate);
    m_start: assume (rst_ni || group == 2'd0);
    // Eight clocks a bit at least, of which resynchronisation takes four at most.
    m_rest: assume (!sample_i || rest >= 3'd3);
    // A field ends at a sample point.
    m_fields: assume (sampled || group == group_q || group == 2'd0);
    // Fields come in the order of a frame; flags may come instead of any.
    m_order: assume (group == group_q || group == 2'd0 || group == 2'd3
                     || group == group_q + 2'd1);
    // From the arbitration field to the CRC delimiter the engine goes on a recessive or dominant
    // bit that keeps the rule of stuffing (engine.bsp_always): never six equal ones, but for the
    // last ones before an error flag, whose frame does not become valid (good).
    m_stuff: assume (group != 2'd2 || run < 3'd6);
    // The role stands fast behind the arbitration field.
    m_role: assume (group < 2'd2 || transmitter_i == mine || group != group_q);
    // can_bsp: the pulse of a start of frame follows its sample point, in the first field.
    m_sof: assume (!sof_i || (sof_due && group == 2'd1
                              && (group_q == 2'd0 || field_i == 5'b01001)));
    // A frame becomes valid once, at the sample point of EOF6; r1 or r0, DLC and CRC are 20 bits.
    m_valid: assume (!rx_valid_i || (sampled && group == 2'd3 && field_i == 5'b11011 && good
                                     && !whole && bits >= 5'd20));
  end

  // Stamps told of this frame, and the point that holds for it: that of the last clock before it.
  logic [1:0] told, point;
  logic       pin, started;
  always_ff @(posedge clk_i) begin
    told  <= !rst_ni || group == 2'd0 ? 2'd0 : we && told != 2'd3 ? told + 2'd1 : told;
    if (!rst_ni) {point, pin} <= {2'd1, 1'b0};
    else if (group == 2'd0) {point, pin} <= {point_i, txpin_i};
    started <= rst_ni && group != 2'd0 && (started || sof_i);
  end

  // The event, from pin and transmit level: TM-21, TM-24, TM-25.
  logic        pin1_q, pin2_q, pin3_q, tx_q, done, fall, event_now, have;
  logic [63:0] expected;
  always_ff @(posedge clk_i) begin
    if (!rst_ni) {pin3_q, pin2_q, pin1_q, tx_q} <= '1;
    else         {pin3_q, pin2_q, pin1_q, tx_q} <= {pin2_q, pin1_q, pin_i, tx_i};
    done <= rst_ni && group != 2'd0
            && (done || (point == 2'd0 && sof_i) || (point == 2'd2 && rx_valid_i)
                || (point[0] && group == 2'd2 && sample_i && !bit_i && bit_q));
    if (event_now) expected <= now_i;
    have <= rst_ni && (have || event_now);
  end
  assign fall = transmitter_i && !pin && group != 2'd0 ? tx_q && !tx_i : pin3_q && !pin2_q;
  assign event_now = point == 2'd2 ? rx_valid_i
                   : fall && !done && !(point == 2'd0 && sof_i);

  always @(posedge clk_i) begin
    if (rst_ni) begin
      // TM-20, TM-26: what is told is TIME, all 64 bits, of the clock in which the event is seen:
      // two flip-flops behind the pin, none behind the own level, one behind a sample point.
      p_latency: assert (!we || !have || stamp == expected);
      // TM-20, TM-28: and stays until the frame is over.
      p_kept: assert (told == 2'd0 || group == 2'd0 || !have || stamp == expected);
      // TM-20: one at most for a frame.
      p_once: assert (told < 2'd2 && !(told == 2'd1 && we));
      // TM-20, TM-22: one for every frame that ends well, before its end; POINT 2: right behind.
      p_one: assert (!rx_valid_i || point == 2'd2 || told == 2'd1 || (point == 2'd0 && !started));
      // TM-24: with POINT 2 two clocks after the frame has become valid.
      p_end: assert (!($past(rx_valid_i, 2) && $past(rst_ni, 2) && point == 2'd2)
                     || we || $past(group) == 2'd0 || group == 2'd0);
      // TM-23: none from the CRC delimiter to EOF5.
      p_tail: assert (!(we && group == 2'd3 && !whole));
      // TM-22: the reference bit is the eleventh behind the arbitration field at the latest, and it
      // is told in its bit.
      p_reference: assert (!(point[0] && group == 2'd2 && bits >= 5'd11 && rest >= 3'd3)
                           || told == 2'd1);
    end
  end
endmodule
