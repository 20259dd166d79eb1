// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// In place of can_mb_ram: a RAM of which every read returns anything. What is proven with it holds
// for every content of the buffers, and after every upset of it.

module can_mb_ram #(
  parameter int Depth = 128,
  parameter InitFile = "",
  localparam int AddrWidth = $clog2(Depth)
) (
  input  logic                 clk_i,
  input  logic                 re_i,
  input  logic [AddrWidth-1:0] raddr_i,
  output logic [31:0]          rdata_o,
  input  logic [3:0]           we_i,
  input  logic [AddrWidth-1:0] waddr_i,
  input  logic [31:0]          wdata_i
);
  (* anyseq *) logic [31:0] f_rdata;
  assign rdata_o = f_rdata;
endmodule
