// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// smoke_apb: the script on can_apb; setup and access phase.
`ifndef CAN_APB
`define CAN_APB can_apb
`endif

module smoke_apb (
  input  wire clk,
  input  wire rst_n,
  output wire finished,
  output wire passed
);
  wire        start, we, ready, error, tx;
  wire [31:0] addr, wdata, rdata;
  reg         select_q, enable_q;

  always @(posedge clk or negedge rst_n)
    if (!rst_n)                 {select_q, enable_q} <= 2'b00;
    else if (start)             {select_q, enable_q} <= 2'b10;
    else if (enable_q && ready) {select_q, enable_q} <= 2'b00;
    else                        enable_q <= select_q;

  smoke_script u_script (.clk(clk), .rst_n(rst_n), .start(start), .we(we), .addr(addr),
    .wdata(wdata), .done(enable_q && ready), .rdata(rdata), .error(error),
    .finished(finished), .passed(passed));

  `CAN_APB u_can (
    .pclk(clk), .presetn(rst_n), .psel(select_q), .penable(enable_q), .paddr(addr),
    .pprot(3'b001), .pwrite(we), .pstrb(we ? 4'b1111 : 4'b0000), .pwdata(wdata), .pready(ready),
    .prdata(rdata), .pslverr(error),
    .irq_o(), .irq_mb_o(), .irq_boff_o(), .irq_err_o(), .irq_twrn_o(), .irq_rwrn_o(),
    .irq_wak_o(), .ext_i(1'b0), .time_out_o(), .irq_time_o(), .stop_req_i(1'b0),
    .can_rx_i(tx), .can_tx_o(tx), .trace_o());
endmodule
