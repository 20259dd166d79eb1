// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_crc15: CRC over SOF to the last data bit, and comparison with the received CRC. Rules
// CR-01..CR-05. The initial value is 0, so that a dominant SOF leaves it unchanged; a joined start
// needs no special case. One register serves both roles: in the CRC field it shifts out.

module can_crc15 (
  input  logic            clk_i,
  input  logic            rst_ni,
  input  logic            sample_i,    // pulse: sample point
  input  logic            bit_i,       // sampled bit
  input  logic            stuff_i,     // current bit is a stuff bit, not part of the CRC (ST-09)
  input  can_pkg::field_t field_i,     // field of the current bit
  output logic            crc_bit_o,   // CRC bit to send next, CRC14 first
  output logic [14:0]     crc_o,       // CRC of the frame, valid from the CRC delimiter on
  output logic            mismatch_o   // a received CRC bit differed; until the next frame
);

  localparam logic [14:0] Polynomial = 15'h4599;

  logic [14:0] crc_q;
  logic        shift_out;

  assign crc_bit_o = crc_q[14];
  assign crc_o     = crc_q;
  assign shift_out = (field_i == can_pkg::FldCrc);

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      crc_q      <= '0;
      mismatch_o <= 1'b0;
    end else if (sample_i) begin
      if (!(|field_i[4:3])) begin  // between frames (CR-05)
        crc_q      <= '0;
        mismatch_o <= 1'b0;
      end else if ((field_i[4] ^ field_i[3]) && !stuff_i) begin
        // In the CRC field the register rotates once and then holds its value again.
        crc_q <= {crc_q[13:0], shift_out && crc_q[14]}
                 ^ ((!shift_out && (bit_i != crc_q[14])) ? Polynomial : 15'h0);
        if (shift_out && (bit_i != crc_q[14])) mismatch_o <= 1'b1;
      end
    end
  end

endmodule
