// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_mb_step: gives the engine's read slots to loads, moves, matching and arbitration, in this
// order, and does the copies. A copy is a read slot and, in the next clock, a write: the word is
// kept nowhere but on the RAM outputs, so no two steps in a row, and no other read while it has to
// stay there (hold_i).

module can_mb_step #(
  parameter int NumMb = 64,
  /// Derived, do not override.
  localparam int IdxW = $clog2(NumMb)
) (
  input  logic            clk_i,
  input  logic            rst_ni,
  // Steps of can_mb_load.
  input  logic            ld_req_i,
  input  logic [2:0]      ld_step_i,
  input  logic            ld_row_i,
  input  logic            ld_word_i,
  input  logic [IdxW-1:0] ld_idx_i,
  input  logic [IdxW-1:0] cur_idx_i,
  input  logic            ld_cancel_i,
  input  logic [3:0]      ld_code_i,
  output logic            ld_data_o,       // data of ld_data_step_o is there
  output logic [2:0]      ld_data_step_o,
  // Steps of can_mb_move.
  input  logic            mv_req_i,
  input  logic [1:0]      mv_step_i,
  input  logic            mv_row_i,
  input  logic [IdxW-1:0] mv_idx_i,
  input  logic            moving_i,
  input  logic            mv_cancel_i,
  input  logic [8:0]      mv_top_i,        // bits 31:23 of the new C/S word
  output logic            mv_data_o,
  output logic            flight_o,        // a step is not over
  // Passes over all buffers.
  input  logic            rx_req_i,
  input  logic [IdxW-1:0] rx_idx_i,
  input  logic [1:0]      rx_word_i,
  input  logic [IdxW:0]   rx_mask_row_i,
  output logic            rx_gnt_o,
  input  logic            scan_req_i,
  input  logic            scan_lazy_i,
  input  logic [IdxW-1:0] scan_idx_i,
  output logic            scan_gnt_o,
  // Read port.
  output logic            req_o,
  output logic            lazy_o,          // it never keeps the CPU waiting
  output logic [IdxW:0]   cs_row_o,
  output logic [IdxW+1:0] msg_row_o,
  output logic [IdxW:0]   mask_row_o,
  input  logic            gnt_i,
  input  logic            hold_i,
  input  logic [31:0]     cs_i,
  // Write port: second half of a copy.
  output logic            copy_o,
  output logic [3:0]      copy_cs_we_o,
  output logic [IdxW:0]   copy_cs_row_o,
  output logic [31:0]     copy_cs_o,
  output logic            copy_msg_we_o,
  output logic [IdxW+1:0] copy_msg_row_o
);
  localparam logic [2:0] StepWord = 3'd0;   // as in can_mb_load
  localparam logic [2:0] StepEnd  = 3'd1;
  localparam logic [2:0] StepLow  = 3'd2;
  localparam logic [2:0] StepHead = 3'd4;

  logic step_req, take_ld, data_q, data_ld_q;
  assign step_req   = (ld_req_i || mv_req_i) && !data_q;
  assign take_ld    = ld_req_i && !(mv_req_i && data_ld_q);   // in turn if both want
  assign req_o      = (step_req || rx_req_i || scan_req_i) && !hold_i;
  assign lazy_o     = !step_req && !rx_req_i && scan_lazy_i;
  assign rx_gnt_o   = gnt_i && !step_req && rx_req_i;
  assign scan_gnt_o = gnt_i && !step_req && !rx_req_i;
  assign flight_o   = data_q;
  assign ld_data_o  = data_q && data_ld_q && !hold_i;
  assign mv_data_o  = data_q && !data_ld_q && moving_i && !hold_i;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {data_q, data_ld_q} <= '0;
      ld_data_step_o <= '0;
    end else begin
      data_q <= (gnt_i && step_req) || hold_i;
      if (gnt_i && step_req) begin
        data_ld_q      <= take_ld;
        ld_data_step_o <= ld_step_i;
      end
    end
  end

  // Rows of the MSG memory behind the buffers (can_mailbox).
  function automatic logic [IdxW+1:0] hidden(input logic rx, input logic row,
      input logic [1:0] word);
    hidden = (IdxW+2)'(3 * NumMb) | (IdxW+2)'({rx, row, word});
  endfunction

  logic [IdxW-1:0] pass_idx;
  assign pass_idx = rx_req_i ? rx_idx_i : scan_idx_i;
  always_comb begin
    cs_row_o  = {1'b0, pass_idx};
    msg_row_o = {rx_req_i ? rx_word_i : 2'b00, pass_idx};
    if (step_req && take_ld) begin
      cs_row_o  = ld_step_i == StepEnd ? (IdxW+1)'(NumMb) : {1'b0, ld_idx_i};
      msg_row_o = ld_step_i == StepWord ? hidden(1'b0, !ld_row_i, {ld_word_i, !ld_word_i})
                : {ld_step_i == StepHead ? 2'd0 : {ld_step_i[0], !ld_step_i[0]}, ld_idx_i};
    end else if (step_req) begin
      cs_row_o  = mv_step_i[0] == mv_step_i[1] ? {1'b0, mv_idx_i}
                : (IdxW+1)'(NumMb + 2) | (IdxW+1)'(mv_row_i);
      msg_row_o = hidden(1'b1, mv_row_i, mv_step_i);
    end
  end
  assign mask_row_o = rx_mask_row_i;

  always_comb begin
    copy_o         = 1'b0;
    copy_cs_we_o   = '0;
    copy_msg_we_o  = 1'b0;
    copy_cs_row_o  = {1'b0, mv_idx_i};
    copy_msg_row_o = {mv_step_i, mv_idx_i};
    copy_cs_o      = {mv_top_i, cs_i[22:0]};
    if (mv_step_i == 2'd3) copy_cs_o[31:28] = cs_i[31:28];
    if (data_q && data_ld_q) begin
      copy_o         = ld_data_step_o != StepWord && ld_data_step_o != StepHead;
      copy_cs_we_o   = ld_data_step_o == StepEnd && !ld_cancel_i ? 4'b1011 : 4'b0000;
      copy_cs_row_o  = {1'b0, cur_idx_i};
      copy_cs_o      = {4'b0, ld_code_i, 1'b0, cs_i[22:0]};
      copy_msg_we_o  = ld_data_step_o[1];
      copy_msg_row_o = hidden(1'b0, ld_row_i, {ld_data_step_o != StepLow,
          ld_data_step_o == StepLow});
    end else if (data_q && moving_i) begin
      copy_o        = 1'b1;
      copy_cs_we_o  = {mv_step_i[1], {3{mv_step_i == 2'd2}}} & {4{!mv_cancel_i}};
      copy_msg_we_o = mv_step_i != 2'd3 && !mv_cancel_i;
    end
  end
endmodule
