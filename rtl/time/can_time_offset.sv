// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_time_offset: offset of a pair, bit by bit, the lowest first (TM-102): stamp of SYNC minus
// 10^9 (seconds + OVS) minus nanoseconds minus delay. Ten is 2 + 8, so a factor of ten is one adder
// of one bit: x 5 = x + 4 x, and the flip-flop behind it doubles; there are nine of them in a row.

module can_time_offset (
  input  logic        clk_i,
  input  logic        rst_ni,
  input  logic        sync_i,        // pulse: a SYNC is accepted
  input  logic [63:0] stamp_i,       // good in the clock after sync_i
  input  logic [1:0]  ovs_i,
  input  logic [5:0]  count_i,       // number of the bit; a round is 64 clocks
  input  logic [7:0]  byte_i,        // the same number in two parts, one of each 1: of its byte,
  input  logic [7:0]  bit_i,         // and in it
  input  logic [23:0] delay_i,       // TSDLY, signed ns
  input  logic        load_i,        // in this round: word_i becomes the seconds
  input  logic        run_i,         // in this round: offset_o and whole_o count
  input  logic        word_i,        // bit of the word in bytes 4 to 7; nanoseconds while run_i
  output logic        whole_o,       // 10^9 (seconds + OVS)
  output logic        offset_o
);
  // Stamp of the SYNC: its FUP comes later, and frames with other stamps before it.
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

  // Seconds of the SYNC, which go round; OVS is added on their way out.
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

  // Times 10, nine times. The product has 63 bits: at the end of a round nothing is left in here.
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

  // The master's time and the delay: the right stamp; and what the stamp is more than that.
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
