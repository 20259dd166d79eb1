// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_hx8k: a CAN node at the USB serial port of Lattice's HX8K breakout board (iCE40 HX8K, 12 MHz,
// 12 clocks a bit at 1 Mbit/s): can_apb in profile standard (sw/profiles.yaml) behind serial_apb.

module can_hx8k #(
  /// Clocks of a bit of the serial port; 104: 115,200 bit/s.
  parameter int BitClocks = 104,
  /// Clocks after which a command that is cut off is dropped; 100 ms.
  parameter int Silence = 1_200_000,
  /// Clocks for which a frame lights its LED, a power of two; 44 ms.
  parameter int LightBits = 19
) (
  input  logic       clk_i,
  input  logic       serial_rx_i,
  output logic       serial_tx_o,
  input  logic       can_rx_i,
  output logic       can_tx_o,
  output logic [4:0] leds_o        // running, received, sent, error passive, bus-off
);
  // iCE40 flip-flops begin at 0; there is no reset pin.
  logic [3:0] reset_q = '0;
  logic       rst_n;
  assign rst_n = reset_q[3];
  always_ff @(posedge clk_i) reset_q <= {reset_q[2:0], 1'b1};

  logic        psel, penable, pwrite, pready;
  logic [31:0] paddr, pwdata, prdata;
  serial_apb #(.BitClocks(BitClocks), .Silence(Silence)) u_serial (
    .clk_i, .rst_ni(rst_n), .rx_i(serial_rx_i), .tx_o(serial_tx_o),
    .psel_o(psel), .penable_o(penable), .paddr_o(paddr), .pwrite_o(pwrite), .pwdata_o(pwdata),
    .pready_i(pready), .prdata_i(prdata));

  logic [can_pkg::TraceWidth-1:0] trace;
  can_apb #(.NumMb(32), .Fifo(0), .Status(0), .RegionBits(32)) u_can (
    .pclk(clk_i), .presetn(rst_n),
    .psel, .penable, .paddr, .pprot(3'b001), .pwrite, .pstrb(4'b1111), .pwdata,
    .pready, .prdata, .pslverr(),
    .irq_o(), .irq_mb_o(), .irq_boff_o(), .irq_err_o(), .irq_twrn_o(), .irq_rwrn_o(), .irq_wak_o(),
    .ext_i(1'b0), .time_out_o(), .irq_time_o(), .stop_req_i(1'b0),
    .can_rx_i, .can_tx_o, .trace_o(trace));

  // Bits of the trace, see can_pkg: pulses of valid frames, and states.
  localparam int Transmitter = 44, RxValid = 25, TxOk = 24, Passive = 21, Running = 20, BusOff = 16;
  // A frame is too short to be seen: its LED stays on for a while.
  logic [LightBits-1:0] received_q, sent_q;
  always_ff @(posedge clk_i or negedge rst_n) begin
    if (!rst_n) begin
      {received_q, sent_q} <= '0;
    end else begin
      if (trace[RxValid] && !trace[Transmitter]) received_q <= '1;
      else if (received_q != '0)                 received_q <= received_q - 1'b1;
      if (trace[TxOk])       sent_q <= '1;
      else if (sent_q != '0) sent_q <= sent_q - 1'b1;
    end
  end
  assign leds_o = {trace[BusOff], trace[Passive], sent_q != '0,
                   received_q != '0, trace[Running]};
endmodule
