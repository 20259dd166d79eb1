// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_rn_tick, hollow: C++ counts the milliseconds, so that the node rests in between and its clock
// may have any frequency.
module can_rn_tick #(
  parameter int ClocksPerMs = 8000
) (
  input  logic clk_i,
  input  logic rst_ni,
  output logic ms_o
);
  logic ms_v /* verilator public_flat_rw */;
  assign ms_o = ms_v;
endmodule
