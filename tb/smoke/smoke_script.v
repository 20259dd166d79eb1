// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// smoke_script: what a program would do first, through a port of one transfer at a time: identify
// the core, leave an address outside the window, set a bit time, send a frame in loop-back, find it
// in another buffer. Verilog-2005, for every simulator.

module smoke_script (
  input  wire        clk,
  input  wire        rst_n,
  output reg         start,     // for one clock: a transfer with the values below
  output reg         we,
  output reg  [31:0] addr,
  output reg  [31:0] wdata,
  input  wire        done,      // for one clock
  input  wire [31:0] rdata,     // valid with done
  input  wire        error,
  output reg         finished,
  output reg         passed
);
  localparam [31:0] Mcr = 32'h000, Ctrl1 = 32'h004, Iflag1 = 32'h030;
  localparam [31:0] Mb0 = 32'h080, Mb1 = 32'h090, Xid = 32'h1000, Beyond = 32'h2000;
  localparam [31:0] Id = 32'h123 << 18;
  localparam [31:0] First = 32'hC0FFEE01, Second = 32'h8001A5F0;

  reg [31:0] got;
  reg        bad;
  integer    tries;

  task transfer(input write, input [31:0] where, input [31:0] what);
    begin
      @(negedge clk);
      start = 1'b1; we = write; addr = where; wdata = what;
      @(negedge clk);
      start = 1'b0;
      while (!done) @(negedge clk);
      got = rdata;
      bad = error;
    end
  endtask

  task expect_word(input [31:0] where, input [31:0] mask, input [31:0] want);
    begin
      transfer(1'b0, where, 32'd0);
      if (bad || (got & mask) !== want) begin
        $display("%m: %h reads %h, error %b; %h expected", where, got & mask, bad, want);
        passed = 1'b0;
      end
    end
  endtask

  // Reads until the bits under the mask are what is wanted: some frames' time at most.
  task await_word(input [31:0] where, input [31:0] mask, input [31:0] want);
    begin
      tries = 0;
      transfer(1'b0, where, 32'd0);
      while ((got & mask) !== want && tries < 2000) begin
        transfer(1'b0, where, 32'd0);
        tries = tries + 1;
      end
      expect_word(where, mask, want);
    end
  endtask

  initial begin
    {start, we, finished, passed} = 4'b0001;
    {addr, wdata} = 64'd0;
    @(posedge rst_n);
    expect_word(Xid, 32'hFFFFFFFF, 32'h5643414E);           // "VCAN"
    transfer(1'b0, Beyond, 32'd0);
    if (!bad) begin
      $display("%m: no error beyond the window");
      passed = 1'b0;
    end
    await_word(Mcr, 32'h80100000, 32'h80100000);            // the RAM is cleared; still disabled
    transfer(1'b1, Mcr, 32'h5000000F);                      // enabled, in freeze mode
    await_word(Mcr, 32'h01100000, 32'h01000000);
    transfer(1'b1, Ctrl1, 32'h00111001);                    // 8 clocks a bit, loop-back
    transfer(1'b1, Mb1 + 4, Id);
    transfer(1'b1, Mb1, 32'h04000000);                      // receives
    transfer(1'b1, Mcr, 32'h0000000F);
    await_word(Mcr, 32'h09000000, 32'h00000000);            // on the bus
    transfer(1'b1, Mb0 + 4, Id);
    transfer(1'b1, Mb0 + 8, First);
    transfer(1'b1, Mb0 + 12, Second);
    transfer(1'b1, Mb0, 32'h0C080000);                      // sends 8 bytes
    await_word(Iflag1, 32'h00000003, 32'h00000003);
    expect_word(Mb1, 32'h0F0F0000, 32'h02080000);           // FULL, 8 bytes
    expect_word(Mb1 + 4, 32'h1FFC0000, Id);
    expect_word(Mb1 + 8, 32'hFFFFFFFF, First);
    expect_word(Mb1 + 12, 32'hFFFFFFFF, Second);
    expect_word(Mb0, 32'h0F000000, 32'h08000000);           // sent
    finished = 1'b1;
  end
endmodule
