  // SPDX-FileCopyrightText: 2026 The VeriCAN authors
  // SPDX-License-Identifier: Apache-2.0
  //
  // Properties of can_crc15, spliced into it: the register is its definition (CR-01..CR-05).

  // The definition, by polynomial arithmetic over GF(2): the register holds the remainder of
  // message * x^15 by G = x^15 + 4599h; a further bit b makes it (R * x + b * x^15) mod G.
  function automatic logic [14:0] f_step(input logic [14:0] r, input logic b);
    logic [15:0] dividend;
    dividend = {r, 1'b0} ^ {b, 15'd0};
    if (dividend[15]) dividend = dividend ^ 16'hC599;  // G with its x^15
    f_step = dividend[14:0];
  endfunction

  logic f_between, f_covered, f_in_crc;
  assign f_between = (field_i[4:3] == 2'b00);
  assign f_covered = (field_i[4] != field_i[3]) && field_i != can_pkg::FldCrc;
  assign f_in_crc  = (field_i == can_pkg::FldCrc);

  always @(posedge clk_i) begin
    // Reset in the first clock, none later.
    m_reset: assume (rst_ni == !$initstate);
    if (rst_ni && !$initstate && $past(rst_ni)) begin
      // CR-01, CR-02: a destuffed bit from SOF to the last data bit divides once by the generator.
      p_step: assert (!$past(sample_i && f_covered && !stuff_i)
                      || crc_q == f_step($past(crc_q), $past(bit_i)));
      // CR-05: between frames the register is cleared, with the mark of a mismatch.
      p_clear: assert (!$past(sample_i && f_between) || (crc_q == '0 && !mismatch_o));
      // CR-02, ST-09: a stuff bit and a bit of fixed form change nothing.
      p_hold: assert (!$past(!sample_i || ((f_covered || f_in_crc) && stuff_i) || (&field_i[4:3]))
                      || (crc_q == $past(crc_q) && mismatch_o == $past(mismatch_o)));
      // CR-01: the 15 bits leave with the highest first.
      p_out: assert (!$past(sample_i && f_in_crc && !stuff_i)
                     || crc_q == {$past(crc_q[13:0]), $past(crc_q[14])});
      // CR-03: every bit of the CRC field is compared; one that differs is remembered.
      p_compare: assert (!$past(sample_i && f_in_crc && !stuff_i)
                         || mismatch_o == $past(mismatch_o || bit_i != crc_q[14]));
    end
  end
