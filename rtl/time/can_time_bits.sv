// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_time_bits: selects one bit of a word of whole bytes by two one-hot positions, byte and bit.
// This takes half the area of a multiplexer with a binary index, and several words share the
// positions.

module can_time_bits #(
  /// Bytes of the word, 1 to 8.
  parameter int Bytes = 8
) (
  input  logic [8*Bytes-1:0] word_i,    // word
  input  logic [Bytes-1:0]   byte_i,    // one-hot: byte; all 0: bit_o is 0
  input  logic [7:0]         bit_i,     // one-hot: bit of that byte
  output logic               bit_o      // selected bit
);
  logic [Bytes-1:0] lane;
  for (genvar i = 0; i < Bytes; i++) begin : gen_byte
    assign lane[i] = |(word_i[8*i +: 8] & bit_i);
  end
  assign bit_o = |(lane & byte_i);
endmodule
