// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_rn_move: the addresses of a request: where it starts in the memory, where the mover is in the
// memory and in the row of the frame, where the bytes of the row end.

module can_rn_move #(
  parameter int StageBytes = 8,
  parameter int NumProd = 0,
  parameter int NumMap = 0,
  parameter bit Protect = 1'b0
) (
  input  logic             clk_i,
  input  logic             rst_ni,
  input  can_rn_pkg::job_t job_i,
  input  logic [1:0]       phase_i,
  input  logic             request_i,  // a request is valid
  input  logic             begin_i,    // its work begins
  input  logic             take_i,     // a header is taken over
  input  logic             read_i,     // memory to row, else row to memory
  input  logic             trigger_i,  // JobMove: the stage to memory
  input  logic             stage_i,    // the start is the stage
  input  logic             far_i,      // READ, WRITE
  input  logic             info_i,     // STATUS, IDENT
  input  logic             data_i,     // DATA
  input  logic             load_i,     // the start is in the word read,
  input  logic             answer_i,   // or that of the answer of BLOCK
  input  logic             key_i,
  input  logic             crosses_i,  // the access ends in the next block of eight bytes
  input  logic             find_i,     // JobFind goes on
  input  logic             act_i,      // JobMove: the stage, whatever the start is
  input  logic             aim_i,      // the start is in the word read, and in A
  input  logic [11:0]      aim_at_i,
  input  logic [6:0]       a_i,
  input  logic [3:0]       dlc_i,
  input  logic [2:0]       count_i,    // of READ
  input  logic [7:0]       byte_i,     // byte of the frame
  output logic [11:0]      start_o,    // first address
  output logic [11:0]      mem_o,      // where the mover is
  output logic [3:0]       place_o,    // the same from the block of the start on
  output logic [3:0]       row_o,
  output logic [3:0]       end_o,      // end of the bytes in the row
  output logic             ended_o,    // row_o is there
  output logic             staged_o,   // mem_o lies in the stage (RN-46)
  output logic             cleared_o   // mem_o is the last address
);
  logic [11:0] start_q;
  logic [3:0]  low_q, row_q;
  logic [8:0]  high;
  logic        head, far_byte, clear, move, entry, fresh, same, find, found;

  assign start_o   = start_q;
  assign row_o     = row_q;
  assign place_o   = low_q;
  assign clear     = job_i == can_rn_pkg::JobClear;
  assign move      = job_i == can_rn_pkg::JobMove;
  assign cleared_o = (&start_q[11:3]) && (&low_q[2:0]);
  assign find = NumMap != 0 && job_i == can_rn_pkg::JobFind;
  assign found = find && !find_i;
  if (NumProd == 0) begin : gen_no_produce
    assign {entry, fresh, same} = '0;
  end else begin : gen_produce
    assign entry = job_i == can_rn_pkg::JobEntry;
    assign fresh = job_i == can_rn_pkg::JobFresh;
    assign same  = job_i == can_rn_pkg::JobSame;
  end
  if (StageBytes == 0) begin : gen_no_stage
    assign staged_o = 1'b0;
    assign ended_o  = trigger_i || row_q == end_o;   // a TRIGGER copies nothing (can_remote)
  end else begin : gen_stage
    // From the block of the start, as mem_o comes late.
    logic stage_here, stage_behind;
    assign stage_here   = start_q[4] && (StageBytes == 16 || !start_q[3]);
    assign stage_behind = start_q[4] ? StageBytes == 16 && !start_q[3] : start_q[3];
    assign staged_o = !(|start_q[11:5]) && (low_q[3] ? stage_behind : stage_here);
    assign ended_o  = trigger_i ? (StageBytes == 16 ? row_q == 4'd0 : row_q[3]) : row_q == end_o;
  end

  // An access reaches into the next block of eight bytes at most: only the place in the block is
  // counted. JobClear goes on from block to block.
  assign high  = (act_i ? 9'h002 : start_q[11:3]) + {8'd0, low_q[3]};
  assign mem_o = {high, low_q[2:0]};

  // The start is A itself, the row of STATUS or IDENT, the stage, or what the first bytes say.
  logic [7:0]  near;
  logic [11:0] at;
  logic        fetched;
  assign head     = job_i == can_rn_pkg::JobHead || entry || aim_i || load_i;
  assign fetched  = load_i && !answer_i;
  assign at       = aim_at_i & {12{aim_i || fetched}};
  assign far_byte = job_i == can_rn_pkg::JobByte && far_i && !(|row_q[3:1]);
  assign near     = {info_i, a_i[6:5] & {2{!answer_i}}, (a_i[4] && !answer_i) || stage_i,
                     info_i ? a_i[0] : a_i[3], a_i[2:1] & {2{!info_i}},
                     a_i[0] && !info_i && !stage_i && !answer_i};
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      start_q <= '0;
    end else if (clear) begin
      start_q[11:3] <= high;
    end else begin
      if (head || (far_byte && !row_q[0]))
        start_q[7:0]  <= head ? (near & {8{!fetched}}) | at[7:0] : byte_i;
      if (head || (far_byte && row_q[0]))
        start_q[11:8] <= head ? {{3{info_i || answer_i}}, info_i} | at[11:8]
                              : byte_i[3:0];
    end
  end

  logic step_mem;
  assign step_mem = clear || (move && (read_i || phase_i[1])) || (same && phase_i[0]);
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni)       low_q <= '0;
    else if (begin_i || fresh) low_q <= {1'b0, start_q[2:0] & {3{!act_i}}};
    else if (aim_i || load_i) low_q <= '0;
    // First and last byte in turn.
    else if (Protect && (request_i || job_i == can_rn_pkg::JobGuard))
                       low_q <= {crosses_i && !request_i && !phase_i[0], 3'd0};
    else if (step_mem) low_q <= {low_q[3] && !clear, low_q[2:0]} + 4'd1;
  end

  logic step_row;
  always_comb begin
    case (job_i)
      can_rn_pkg::JobBegin: step_row = &phase_i;
      can_rn_pkg::JobByte:  step_row = !key_i || (&phase_i);
      can_rn_pkg::JobMove:  step_row = read_i ? phase_i[1] && !ended_o
                                              : phase_i == 2'd0 || !ended_o;
      can_rn_pkg::JobOpen:  step_row = !phase_i[1];
      default:              step_row = (same || find) && phase_i[0];
    endcase
  end
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni)                  row_q <= '0;
    else if (take_i || request_i || entry || found || load_i) row_q <= '0;
    else if (begin_i)             row_q <= {2'b00, far_i, data_i};
    else if (step_row)            row_q <= row_q + 4'd1;
  end

  // READ says how much in its third byte; its answer begins with the address.
  // It is known long before the first byte moves.
  logic [3:0] end_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) end_q <= '0;
    else         end_q <= far_i && !a_i[0] ? {1'b0, count_i} + 4'd2 : dlc_i;
  end
  assign end_o = end_q;

endmodule
