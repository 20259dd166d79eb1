// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// remote_io: a remote node with pins as its user logic (RN-86): the byte at 0x010 drives outputs
// from each TRIGGER on, inputs stand at 0x040. Outputs are 0 unless the node is in OPERATE.

module remote_io #(
  /// Serial number of this board.
  parameter int Serial = 1,
  /// 0: profile small; 1: full.
  parameter bit Full = 1'b0,
  /// Outputs and inputs, at most 8 of each.
  parameter int Outputs = 4,
  parameter int Inputs = 2
) (
  input  logic               clk_i,       // 12 MHz
  input  logic [2:0]         number_i,    // node; 0, 1: none, ASSIGN gives one
  input  logic [Inputs-1:0]  inputs_i,    // asynchronous
  output logic [Outputs-1:0] outputs_o,
  output logic [1:0]         state_o,     // as RN-24
  output logic               seen_o,      // changes with each write that became visible
  input  logic               can_rx_i,
  output logic               can_tx_o
);
  // iCE40 flip-flops begin at 0; there is no reset pin.
  logic [3:0] reset_q = '0;
  logic       rst_n;
  assign rst_n = reset_q[3];
  always_ff @(posedge clk_i) reset_q <= {reset_q[2:0], 1'b1};

  localparam int Events = Full ? 8 : 1;
  localparam logic [9:0] OutputWord = 10'h010 / 10'd4;
  localparam logic [9:0] InputWord  = 10'h040 / 10'd4;

  logic        ready, written, apply, safe;
  logic [31:0] rdata;
  logic        due_q, take_q, seen_q;  // staged bytes are visible: read them; they come now
  logic [Outputs-1:0] out_q;
  logic [Inputs-1:0]  meta_q, in_q;

  // 12 quanta a bit, sample point 75 %, as in the paper: 1 + 5 + 3 and 3; in full from the first
  // row of the table, which is what `verican bittime --table --clock 12M` prints.
  can_remote #(
    .TxDepth(Full ? 4 : 1), .NumProd(Full ? 8 : 0), .NumMap(Full ? 8 : 0),
    .Protect(Full ? 1 : 0), .Block(Full ? 1 : 0), .AutoRate(Full ? 1 : 0),
    .Counters(Full ? 1 : 0), .Serial(Serial),
    .RateRows(8),
    .RateTable({
      133'd0,
      8'd74, 2'd1, 3'd6, 3'd1, 3'd5,  // 10 kbit/s
      8'd39, 2'd1, 3'd5, 3'd1, 3'd5,  // 20 kbit/s
      8'd14, 2'd1, 3'd6, 3'd1, 3'd5,  // 50 kbit/s
      8'd5, 2'd1, 3'd6, 3'd1, 3'd5,  // 125 kbit/s
      8'd2, 2'd1, 3'd6, 3'd1, 3'd5,  // 250 kbit/s
      8'd1, 2'd1, 3'd4, 3'd1, 3'd3,  // 500 kbit/s
      8'd0, 2'd2, 3'd5, 3'd2, 3'd4,  // 800 kbit/s
      8'd0, 2'd2, 3'd3, 3'd2, 3'd3  // 1000 kbit/s
    }),
    .ClocksPerMs(12000), .Brp(1), .Prop(5), .Ps1(3), .Ps2(3), .Sjw(3)
  ) u_node (
    .clk_i, .rst_ni(rst_n), .start_i(1'b1), .node_i(number_i), .rate_i(4'd0),
    .usr_req_i(1'b1), .usr_we_i(!due_q), .usr_be_i(4'b0001),
    .usr_addr_i(due_q ? OutputWord : InputWord), .usr_wdata_i(32'(in_q)),
    .usr_ready_o(ready), .usr_rdata_o(rdata), .usr_hold_i(1'b0),
    .written_o(written), .written_addr_o(), .written_len_o(), .apply_o(apply),
    .event_i(Events'(Full && take_q)),   // producer 0 tells what the inputs are then
    .time_take_i(1'b0), .time_o(), .time_state_o(), .pps_o(),
    .safe_o(safe), .state_o, .can_rx_i, .can_tx_o, .trace_o()
  );

  always_ff @(posedge clk_i or negedge rst_n) begin
    if (!rst_n) begin
      {due_q, take_q, seen_q} <= '0;
      out_q <= '0;
    end else begin
      due_q  <= apply || (due_q && !ready);
      take_q <= due_q && ready;
      seen_q <= seen_q ^ (written || apply);
      if (take_q) out_q <= rdata[Outputs-1:0];
    end
  end
  always_ff @(posedge clk_i) {in_q, meta_q} <= {meta_q, inputs_i};

  assign outputs_o = safe ? '0 : out_q;
  assign seen_o    = seen_q;

endmodule
