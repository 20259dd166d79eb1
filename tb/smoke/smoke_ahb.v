// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// smoke_ahb: the script on can_ahb; a master of one word at a time.
`ifndef CAN_AHB
`define CAN_AHB can_ahb
`endif

module smoke_ahb (
  input  wire clk,
  input  wire rst_n,
  output wire finished,
  output wire passed
);
  wire        start, we, ready, resp, tx;
  wire [31:0] addr, wdata, rdata;
  reg         address_q, data_q, error_q;   // which phase of a transfer this clock is
  reg  [31:0] wdata_q;

  always @(posedge clk or negedge rst_n)
    if (!rst_n) {address_q, data_q, error_q, wdata_q} <= 35'd0;
    else begin
      if (start)      address_q <= 1'b1;
      else if (ready) address_q <= 1'b0;
      if (ready)      data_q <= address_q;
      error_q <= resp && !ready;            // the first of two cycles
      wdata_q <= wdata;
    end

  smoke_script u_script (.clk(clk), .rst_n(rst_n), .start(start), .we(we), .addr(addr),
    .wdata(wdata), .done(data_q && ready), .rdata(rdata), .error(resp && error_q),
    .finished(finished), .passed(passed));

  `CAN_AHB u_can (
    .hclk(clk), .hresetn(rst_n), .hsel(1'b1), .haddr(addr), .htrans({address_q, 1'b0}),
    .hwrite(we), .hsize(3'd2), .hburst(3'd0), .hprot(4'b0011), .hready(ready), .hwdata(wdata_q),
    .hrdata(rdata), .hreadyout(ready), .hresp(resp),
    .irq_o(), .irq_mb_o(), .irq_boff_o(), .irq_err_o(), .irq_twrn_o(), .irq_rwrn_o(),
    .irq_wak_o(), .ext_i(1'b0), .time_out_o(), .irq_time_o(), .stop_req_i(1'b0),
    .can_rx_i(tx), .can_tx_o(tx), .trace_o());
endmodule
