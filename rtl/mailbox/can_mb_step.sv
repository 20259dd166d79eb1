// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_mb_step: gives the engine's read slots (can_mb_port) to loads and moves, in turn if both want
// one, then to the match, then to the arbitration, and does the copies of loads and moves. A copy
// is a read slot and a write in the next clock; in between, the word is on the RAM outputs only, so
// there are never two steps in consecutive clocks.

module can_mb_step #(
  parameter int NumMb = 64,
  /// Derived, do not override.
  localparam int IdxW = $clog2(NumMb)
) (
  input  logic            clk_i,
  input  logic            rst_ni,
  // Steps of can_mb_load.
  input  logic            ld_req_i,        // 1: step ld_step_i (can_mb_pkg::Step*) is wanted
  input  logic [2:0]      ld_step_i,
  input  logic            ld_row_i,        // hidden row that is being filled; !ld_row_i: on the bus
  input  logic            ld_word_i,       // StepWord: 0 bytes 0-3, 1 bytes 4-7
  input  logic [IdxW-1:0] ld_idx_i,        // buffer that is being loaded
  input  logic [IdxW-1:0] cur_idx_i,       // StepEnd: buffer of the frame
  input  logic            ld_cancel_i,     // 1: StepEnd writes nothing
  input  logic [3:0]      ld_code_i,       // StepEnd: new code
  output logic            ld_data_o,       // 1: data of step ld_data_step_o is on the RAM outputs
  output logic [2:0]      ld_data_step_o,
  // Steps of can_mb_move.
  input  logic            mv_req_i,        // 1: step mv_step_i is wanted
  input  logic [1:0]      mv_step_i,
  input  logic            mv_row_i,        // hidden row that is moved
  input  logic [IdxW-1:0] mv_idx_i,        // buffer that the frame is moved to
  input  logic            moving_i,        // 1: a move is under way
  input  logic            mv_answer_i,     // 1: the move is an answer: only the code changes
  input  logic            mv_cancel_i,     // 1: the step writes nothing
  input  logic [8:0]      mv_top_i,        // bits 31:23 of the new C/S word
  output logic            mv_data_o,       // 1: data of the step is on the RAM outputs
  output logic            flight_o,        // 1: a step is granted and not over
  // Passes over all buffers: match (rx_*, can_mb_match) and arbitration (scan_*, can_mb_tx).
  input  logic            rx_req_i,
  input  logic [IdxW-1:0] rx_idx_i,
  input  logic [1:0]      rx_word_i,       // word of the MSG memory
  input  logic            rx_cs_i,         // 1: the C/S word is wanted, not that of MSG
  input  logic [IdxW:0]   rx_mask_row_i,
  output logic            rx_gnt_o,
  input  logic            scan_req_i,
  input  logic            scan_lazy_i,     // 1: a pass for ESR2, takes only unused slots
  input  logic [IdxW-1:0] scan_idx_i,
  output logic            scan_gnt_o,
  // Read port (can_mb_port).
  output logic            req_o,
  output logic            lazy_o,          // 1: the request is of a pass for ESR2
  output logic            cs_o,            // 1: word_i is to be the C/S word; 0: that of MSG
  output logic [IdxW:0]   cs_row_o,
  output logic [IdxW+1:0] msg_row_o,
  output logic [IdxW:0]   mask_row_o,
  input  logic            slot_i,          // 1: the read slot is the engine's
  input  logic            yield_i,         // 1: can_mb_smb waits to write, or will: begin no copy
  input  logic [31:0]     word_i,          // word that the step asked for
  // Write port (can_mb_port): second half of a copy.
  output logic            copy_o,          // 1: a copy writes in this clock
  output logic            copy_cs_o,       // 1: the copy goes to the C/S memory; 0: to MSG
  output logic [3:0]      copy_be_o,
  output logic            copy_off_o,      // 1: the copy is cancelled; only if it goes to a buffer
  output logic            copy_end_o,      // 1: the copy is the end of a sent frame (StepEnd)
  output logic [IdxW+1:0] copy_row_o,
  output logic [31:0]     copy_data_o
);
  logic step_req, take_ld, data_q, data_ld_q;
  assign step_req   = (ld_req_i || mv_req_i) && !data_q && !yield_i;
  assign take_ld    = ld_req_i && !(mv_req_i && data_ld_q);   // in turn if both want
  assign req_o      = step_req || rx_req_i || scan_req_i;
  assign lazy_o     = !step_req && !rx_req_i && scan_lazy_i;
  assign rx_gnt_o   = slot_i && !step_req && rx_req_i;
  assign scan_gnt_o = slot_i && !step_req && !rx_req_i && scan_req_i;
  assign flight_o   = data_q;
  assign ld_data_o  = data_q && data_ld_q;
  assign mv_data_o  = data_q && !data_ld_q && moving_i;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {data_q, data_ld_q} <= '0;
      ld_data_step_o <= '0;
    end else begin
      // A step lasts one clock, whether its move goes on or not: when a move is given up, the next
      // move must not take that step's word for its own.
      data_q <= slot_i && step_req;
      if (slot_i && step_req) begin
        data_ld_q      <= take_ld;
        ld_data_step_o <= ld_step_i;
      end
    end
  end

  // Hidden rows (can_mb_pkg): of the MSG memory, and of the C/S words of frames to be sent.
  function automatic logic [IdxW+1:0] hidden(input logic rx, input logic row,
      input logic [1:0] word);
    logic [3:0] behind;
    behind = can_mb_pkg::hidden_msg(rx, row, word);
    hidden = (IdxW+2)'(3 * NumMb) | (IdxW+2)'(behind);
  endfunction

  function automatic logic [IdxW:0] sent(input logic row);
    sent = (IdxW+1)'(NumMb + can_mb_pkg::RowSent) | (IdxW+1)'(row);
  endfunction

  logic [IdxW-1:0] pass_idx;
  assign pass_idx = rx_req_i ? rx_idx_i : scan_idx_i;
  always_comb begin
    cs_row_o  = {1'b0, pass_idx};
    msg_row_o = {rx_req_i ? rx_word_i : 2'b00, pass_idx};
    if (step_req && take_ld) begin
      cs_row_o  = {1'b0, ld_idx_i};
      msg_row_o = {ld_step_i[0], !ld_step_i[0], ld_idx_i};            // StepLow, StepHigh
      case (ld_step_i)
        can_mb_pkg::StepWord: msg_row_o = hidden(1'b0, !ld_row_i, {ld_word_i, !ld_word_i});
        can_mb_pkg::StepEnd:  cs_row_o = sent(!ld_row_i);
        can_mb_pkg::StepHead: msg_row_o = {2'd0, ld_idx_i};
        default: ;
      endcase
    end else if (step_req) begin
      cs_row_o  = mv_step_i == 2'd0 || mv_answer_i ? {1'b0, mv_idx_i}
                : (IdxW+1)'(NumMb + can_mb_pkg::RowReceived) | (IdxW+1)'(mv_row_i);
      msg_row_o = hidden(1'b1, mv_row_i, mv_step_i);
    end
  end
  assign mask_row_o = rx_mask_row_i;
  assign cs_o = !step_req ? rx_cs_i : take_ld ? !ld_step_i[1] : mv_step_i == 2'd3;

  // Data of a copy: the word on the RAM outputs; of a C/S word, bits 31:23 are from top where keep
  // is 0. A CPU that reads this C/S word in the same clock gets what is on the RAM outputs
  // (can_mb_port): for a received frame the hidden row's word, with BUSY; for an answer the
  // buffer's old word; for a sent frame the copy of the buffer's word made when it was presented,
  // with its stamp and the new code (can_mb_cpu).
  logic       is_ld, low, head, ended;
  logic [8:0] top, keep;
  assign is_ld     = data_q && data_ld_q;
  assign low       = ld_data_step_o == can_mb_pkg::StepLow;
  assign head      = ld_data_step_o == can_mb_pkg::StepHead;
  assign ended     = ld_data_step_o == can_mb_pkg::StepEnd;
  assign copy_end_o = is_ld && ended;
  assign copy_o    = is_ld ? ld_data_step_o != can_mb_pkg::StepWord : data_q && moving_i;
  assign copy_cs_o = is_ld ? !ld_data_step_o[1] : mv_step_i == 2'd3;

  always_comb begin
    copy_row_o = {copy_cs_o ? 2'b00 : mv_step_i, mv_idx_i};
    keep       = {{4{!copy_cs_o || mv_answer_i}}, {5{!copy_cs_o}}};
    top        = mv_top_i;
    if (is_ld) begin
      copy_row_o = hidden(1'b0, ld_row_i, {!low, low});
      if (head)  copy_row_o = {1'b0, sent(ld_row_i)};
      if (ended) copy_row_o = {2'b00, cur_idx_i};
      keep       = {9{!ended}};
      top        = {4'd1 << (can_mb_pkg::CsEnded - 28), ld_code_i, 1'b0};
    end
    copy_data_o = {(word_i[31:23] & keep) | (top & ~keep), word_i[22:0]};
  end

  always_comb begin
    copy_be_o  = {1'b1, {3{!(mv_answer_i && copy_cs_o)}}};
    copy_off_o = mv_cancel_i;
    if (is_ld) begin
      copy_be_o  = ended ? 4'b1011 : '1;
      copy_off_o = ended && ld_cancel_i;
    end
  end
endmodule
