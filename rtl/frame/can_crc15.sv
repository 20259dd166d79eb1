// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_crc15: CRC from SOF to the last data bit, and its comparison with the one received.
// Rules CR-01..CR-05. It starts from 0, so the dominant SOF adds nothing.

module can_crc15 (
  input  logic            clk_i,
  input  logic            rst_ni,
  input  logic            sample_i,
  input  logic            bit_i,
  input  logic            stuff_i,     // current bit is a stuff bit: invisible to the CRC (ST-09)
  input  can_pkg::field_t field_i,
  output logic            crc_bit_o,   // CRC bit to send next (CRC14 first)
  output logic [14:0]     crc_o,       // CRC of the frame, from the CRC delimiter to its end
  output logic            mismatch_o   // a received CRC bit differed; holds until the next frame
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
        // In the CRC field it goes round once, and is what it was.
        crc_q <= {crc_q[13:0], shift_out && crc_q[14]}
                 ^ ((!shift_out && (bit_i != crc_q[14])) ? Polynomial : 15'h0);
        if (shift_out && (bit_i != crc_q[14])) mismatch_o <= 1'b1;
      end
    end
  end

endmodule
