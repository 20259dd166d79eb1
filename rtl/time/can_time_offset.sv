// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_time_offset: bit-serial offset of a pair, lowest bit first (TM-102): stamp of SYNC minus 10^9
// (seconds + OVS) minus nanoseconds minus delay. 10^9 is nine stages of x 10. A stage needs one
// adder of one bit: 5 x = x + 4 x, and the flip-flop behind it doubles.

module can_time_offset (
  input  logic        clk_i,
  input  logic        rst_ni,
  input  logic        sync_i,        // pulse: a SYNC is accepted
  input  logic [63:0] stamp_i,       // stamp of the frame; good in the clock after sync_i
  input  logic [1:0]  ovs_i,         // whole seconds in the FUP
  input  logic [5:0]  count_i,       // index of the bit; a round is 64 clocks
  input  logic [7:0]  byte_i,        // count_i[5:3], one-hot
  input  logic [7:0]  bit_i,         // count_i[2:0], one-hot
  input  logic [23:0] delay_i,       // TSDLY, signed ns
  input  logic        load_i,        // this round loads the seconds from word_i
  input  logic        run_i,         // in this round whole_o and offset_o are valid
  input  logic        word_i,        // bit of bytes 4 to 7; while run_i: nanoseconds
  output logic        whole_o,       // bit of 10^9 (seconds + OVS)
  output logic        offset_o       // bit of the offset
);
  // Stamp of the SYNC. It is kept, because other frames with stamps may come before the FUP.
  logic        take_q;
  logic [63:0] stamp_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      take_q  <= 1'b0;
      stamp_q <= '0;
    end else begin
      take_q <= sync_i;
      if (take_q) stamp_q <= stamp_i;
    end
  end

  // Seconds of the SYNC, rotating. OVS is added as they leave the register.
  logic [31:0] seconds_q;
  logic        low, last, seconds, ovs, ovs_carry_q, sum;
  assign low     = !count_i[5];
  assign last    = &count_i;
  assign seconds = run_i && low && seconds_q[0];
  assign ovs     = run_i && count_i[5:1] == '0 && ovs_i[count_i[0]];
  assign sum     = seconds ^ ovs ^ ovs_carry_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      seconds_q   <= '0;
      ovs_carry_q <= 1'b0;
    end else begin
      if (low && (load_i || run_i)) seconds_q <= {load_i ? word_i : seconds_q[0], seconds_q[31:1]};
      ovs_carry_q <= (seconds && ovs) || ((seconds || ovs) && ovs_carry_q);
    end
  end

  // Nine stages of x 10. The product has 63 bits, so no stage holds anything at the end of a round.
  localparam int Tens = 9;
  logic [Tens:0]   x;
  logic [Tens-1:0] x2_q, x4_q, carry_q;
  assign x[0] = sum;
  for (genvar i = 0; i < Tens; i++) begin : gen_ten
    logic ten_q;
    always_ff @(posedge clk_i or negedge rst_ni) begin
      if (!rst_ni) begin
        {x2_q[i], x4_q[i], carry_q[i], ten_q} <= '0;
      end else begin
        x2_q[i]    <= x[i];
        x4_q[i]    <= x2_q[i];
        carry_q[i] <= (x[i] && x4_q[i]) || ((x[i] || x4_q[i]) && carry_q[i]);
        ten_q      <= x[i] ^ x4_q[i] ^ carry_q[i];
      end
    end
    assign x[i+1] = ten_q;
  end
  assign whole_o = x[Tens];

  // Right stamp = master's time + delay; offset = stamp - right stamp.
  logic stamp, delay, late, master, right, ns_carry_q, delay_carry_q, borrow_q;
  can_time_bits #(.Bytes(8)) u_stamp (
    .word_i(stamp_q), .byte_i, .bit_i, .bit_o(stamp));
  can_time_bits #(.Bytes(3)) u_delay (
    .word_i(delay_i), .byte_i(byte_i[2:0]), .bit_i, .bit_o(delay));
  assign late     = delay || (byte_i[2:0] == '0 && delay_i[23]);
  assign master   = whole_o ^ word_i ^ ns_carry_q;
  assign right    = master ^ late ^ delay_carry_q;
  assign offset_o = stamp ^ right ^ borrow_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {ns_carry_q, delay_carry_q, borrow_q} <= '0;
    end else begin
      ns_carry_q    <= !last && ((whole_o && word_i) || ((whole_o || word_i) && ns_carry_q));
      delay_carry_q <= !last && ((master && late) || ((master || late) && delay_carry_q));
      borrow_q      <= !last && ((!stamp && right) || ((!stamp || right) && borrow_q));
    end
  end
endmodule
