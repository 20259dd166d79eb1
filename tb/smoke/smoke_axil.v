// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// smoke_axil: the script on can_axil; address and data of a write together.
`ifndef CAN_AXIL
`define CAN_AXIL can_axil
`endif

module smoke_axil (
  input  wire clk,
  input  wire rst_n,
  output wire finished,
  output wire passed
);
  wire        start, we, awready, wready, bvalid, arready, rvalid, tx;
  wire [1:0]  bresp, rresp;
  wire [31:0] addr, wdata, rdata;
  reg         awvalid_q, wvalid_q, arvalid_q;

  always @(posedge clk or negedge rst_n)
    if (!rst_n)     {awvalid_q, wvalid_q, arvalid_q} <= 3'b000;
    else if (start) {awvalid_q, wvalid_q, arvalid_q} <= {we, we, !we};
    else begin
      if (awready) awvalid_q <= 1'b0;
      if (wready)  wvalid_q  <= 1'b0;
      if (arready) arvalid_q <= 1'b0;
    end

  smoke_script u_script (.clk(clk), .rst_n(rst_n), .start(start), .we(we), .addr(addr),
    .wdata(wdata), .done(bvalid || rvalid), .rdata(rdata),
    .error(bvalid ? bresp == 2'b10 : rresp == 2'b10), .finished(finished), .passed(passed));

  `CAN_AXIL u_can (
    .aclk(clk), .aresetn(rst_n), .awaddr(addr), .awprot(3'b001), .awvalid(awvalid_q),
    .awready(awready), .wdata(wdata), .wstrb(4'b1111), .wvalid(wvalid_q), .wready(wready),
    .bresp(bresp), .bvalid(bvalid), .bready(1'b1), .araddr(addr), .arprot(3'b001),
    .arvalid(arvalid_q), .arready(arready), .rdata(rdata), .rresp(rresp), .rvalid(rvalid),
    .rready(1'b1),
    .irq_o(), .irq_mb_o(), .irq_boff_o(), .irq_err_o(), .irq_twrn_o(), .irq_rwrn_o(),
    .irq_wak_o(), .ext_i(1'b0), .time_out_o(), .irq_time_o(), .stop_req_i(1'b0),
    .can_rx_i(tx), .can_tx_o(tx), .trace_o());
endmodule
