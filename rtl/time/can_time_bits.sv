// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_time_bits: one bit of a word of whole bytes, chosen by two positions of which one bit each is
// 1: half as large as a choice by a number, and the positions serve several words.

module can_time_bits #(
  /// Bytes of the word, 1 to 8.
  parameter int Bytes = 8
) (
  input  logic [8*Bytes-1:0] word_i,
  input  logic [Bytes-1:0]   byte_i,    // which byte; none: the bit is 0
  input  logic [7:0]         bit_i,     // which bit of it
  output logic               bit_o
);
  logic [Bytes-1:0] lane;
  for (genvar i = 0; i < Bytes; i++) begin : gen_byte
    assign lane[i] = |(word_i[8*i +: 8] & bit_i);
  end
  assign bit_o = |(lane & byte_i);
endmodule
