// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// smoke_wb: the script on can_wb; standard cycles.
`ifndef CAN_WB
`define CAN_WB can_wb
`endif

module smoke_wb (
  input  wire clk,
  input  wire rst_n,
  output wire finished,
  output wire passed
);
  wire        start, we, ack, error, tx;
  wire [31:0] addr, wdata, rdata;
  reg         cycle_q;

  always @(posedge clk or negedge rst_n)
    if (!rst_n)            cycle_q <= 1'b0;
    else if (start)        cycle_q <= 1'b1;
    else if (ack || error) cycle_q <= 1'b0;

  smoke_script u_script (.clk(clk), .rst_n(rst_n), .start(start), .we(we), .addr(addr),
    .wdata(wdata), .done(ack || error), .rdata(rdata), .error(error),
    .finished(finished), .passed(passed));

  `CAN_WB u_can (
    .wb_clk_i(clk), .wb_rst_i(!rst_n), .wb_cyc_i(cycle_q), .wb_stb_i(cycle_q), .wb_we_i(we),
    .wb_adr_i(addr[31:2]), .wb_sel_i(4'b1111), .wb_dat_i(wdata), .wb_dat_o(rdata),
    .wb_ack_o(ack), .wb_err_o(error), .wb_stall_o(),
    .irq_o(), .irq_mb_o(), .irq_boff_o(), .irq_err_o(), .irq_twrn_o(), .irq_rwrn_o(),
    .irq_wak_o(), .ext_i(1'b0), .time_out_o(), .irq_time_o(), .stop_req_i(1'b0),
    .can_rx_i(tx), .can_tx_o(tx), .trace_o());
endmodule
