// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_smoke: the script through each bus wrapper; prints "smoke: passed" or ends with an error.
// Defines: NO_AHB, NO_APB, NO_AXIL, NO_WB leave a bus out; CAN_AHB and so on name another module.
`timescale 1ns/1ps

module can_smoke;
  reg        clk, rst_n;
  wire [3:0] finished, passed;

  initial begin
    clk = 1'b0;
    forever #50 clk = !clk;                 // 10 MHz
  end
  initial begin
    rst_n = 1'b0;
    #330 rst_n = 1'b1;
  end

`ifdef NO_AHB
  assign {finished[0], passed[0]} = 2'b11;
`else
  smoke_ahb u_ahb (.clk(clk), .rst_n(rst_n), .finished(finished[0]), .passed(passed[0]));
`endif
`ifdef NO_APB
  assign {finished[1], passed[1]} = 2'b11;
`else
  smoke_apb u_apb (.clk(clk), .rst_n(rst_n), .finished(finished[1]), .passed(passed[1]));
`endif
`ifdef NO_AXIL
  assign {finished[2], passed[2]} = 2'b11;
`else
  smoke_axil u_axil (.clk(clk), .rst_n(rst_n), .finished(finished[2]), .passed(passed[2]));
`endif
`ifdef NO_WB
  assign {finished[3], passed[3]} = 2'b11;
`else
  smoke_wb u_wb (.clk(clk), .rst_n(rst_n), .finished(finished[3]), .passed(passed[3]));
`endif

  initial begin
    #2000000;
    $display("smoke: not finished after 2 ms: %b", finished);
    $fatal(1);
  end
  always @(posedge clk) begin
    if (&finished) begin
      if (&passed) begin
        $display("smoke: passed");
        $finish;
      end else begin
        $display("smoke: failed");
        $fatal(1);
      end
    end
  end
endmodule
