// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// MEMORY_BOX: stands for an inferred memory, so that its size and ports can be counted.
(* blackbox *) (* dynports *)
module MEMORY_BOX #(
  parameter SIZE = 1, WIDTH = 1, RP = 1, WP = 1, A = 1, MEMID = ""
) (
  input  [RP*A-1:0]     raddr,
  input  [RP-1:0]       ren,
  output [RP*WIDTH-1:0] rdata,
  input  [WP*A-1:0]     waddr,
  input  [WP*WIDTH-1:0] wdata,
  input  [WP*WIDTH-1:0] wen,
  input  [WP-1:0]       clk
);
endmodule
