// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_mb_ram: simple dual-port RAM with byte enables and registered read data, written so that
// every synthesis tool maps it to block RAM. An ASIC flow puts its macro here
// (docs/integration.md).

module can_mb_ram #(
  /// Number of 32-bit words, a power of two.
  parameter int Depth = 128,
  /// File with the initial contents, as $readmemh takes it; "": contents undefined.
  parameter InitFile = "",
  /// Derived, do not override.
  localparam int AddrWidth = $clog2(Depth)
) (
  input  logic                 clk_i,
  input  logic                 re_i,      // 1: read row raddr_i
  input  logic [AddrWidth-1:0] raddr_i,
  output logic [31:0]          rdata_o,   // valid one clock after re_i; kept until the next read
  input  logic [3:0]           we_i,      // byte enables of the write, one bit per byte
  input  logic [AddrWidth-1:0] waddr_i,
  input  logic [31:0]          wdata_i
);
  // A read of a byte that is being written returns something else in every block RAM. No block
  // relies on it, and the attribute saves the bypass logic that synthesis would add. In simulation
  // such a byte is garbage, so that a test would notice a block that does rely on it.
  (* no_rw_check *) logic [31:0] mem [Depth];

  if (|InitFile) begin : gen_init
    initial $readmemh(InitFile, mem);
  end

  always_ff @(posedge clk_i) begin
    if (re_i) rdata_o <= mem[raddr_i];
    for (int b = 0; b < 4; b++) begin
      if (we_i[b]) mem[waddr_i][8*b +: 8] <= wdata_i[8*b +: 8];
`ifndef SYNTHESIS
      if (re_i && we_i[b] && waddr_i == raddr_i) begin
        rdata_o[8*b +: 8] <= ~(mem[raddr_i][8*b +: 8] ^ rdata_o[8*b +: 8]);
      end
`endif
    end
  end
endmodule
