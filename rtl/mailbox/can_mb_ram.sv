// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_mb_ram: one read and one write port, byte enables, registered read data: a block RAM
// anywhere.

module can_mb_ram #(
  /// Words of 32 bits; a power of two.
  parameter int Depth = 128,
  /// First contents, as $readmemh takes them; "": any.
  parameter InitFile = "",
  /// Derived, do not override.
  localparam int AddrWidth = $clog2(Depth)
) (
  input  logic                 clk_i,
  input  logic                 re_i,
  input  logic [AddrWidth-1:0] raddr_i,
  output logic [31:0]          rdata_o,   // in the clock after re_i; kept until the next read
  input  logic [3:0]           we_i,      // one bit per byte
  input  logic [AddrWidth-1:0] waddr_i,
  input  logic [31:0]          wdata_i
);
  // What a read of a byte being written returns is different in every block RAM; nobody above
  // relies on it, and the attribute saves the logic that would pretend otherwise. Simulation
  // returns a byte made of the old one and the last one read, so that every test would see it.
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
