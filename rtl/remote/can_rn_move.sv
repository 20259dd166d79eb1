// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_rn_move: address unit of the byte mover. It holds the first address of an access, the address
// in the memory and the index in the row of the frame, and tells where the bytes of the row end and
// whether an address lies in the stage (RN-46). Memory and row index step in turn, one byte a clock
// (RN-37).

module can_rn_move #(
  parameter int StageBytes = 8,
  parameter int NumProd = 0,
  parameter int NumMap = 0,
  parameter bit Protect = 1'b0
) (
  input  logic             clk_i,
  input  logic             rst_ni,
  input  can_rn_pkg::job_t job_i,      // present job
  input  logic [1:0]       phase_i,    // phase of the job
  input  logic             request_i,  // pulse: a request is valid
  input  logic             begin_i,    // pulse: work of a request or visit begins
  input  logic             take_i,     // pulse: a header is taken over
  input  logic             read_i,     // mover copies memory to row, otherwise row to memory
  input  logic             trigger_i,  // mover copies the stage to memory (TRIGGER)
  input  logic             stage_i,    // request is TRIGGER: the access starts at the stage
  input  logic             far_i,      // request is READ or WRITE
  input  logic             info_i,     // request is for STATUS or IDENT
  input  logic             data_i,     // request is DATA
  input  logic             load_i,     // first address comes from a block transfer
  input  logic             answer_i,   // block transfer: its answer of BLOCK is sent
  input  logic             key_i,      // JobByte: byte is compared, which takes four phases
  input  logic             crosses_i,  // access ends in the next block of eight bytes
  input  logic             find_i,     // JobFind continues
  input  logic             act_i,      // map entry: its frame's bytes are done, the stage follows
  input  logic             aim_i,      // JobAim: first address is aim_at_i | A
  input  logic [11:0]      aim_at_i,   // address in the word read, for aim_i and load_i
  input  logic [6:0]       a_i,        // A
  input  logic [3:0]       dlc_i,      // DLC of the frame, or length of the answer
  input  logic [2:0]       count_i,    // number of bytes that READ asks for
  input  logic [7:0]       byte_i,     // received byte
  output logic [11:0]      start_o,    // first address of the access
  output logic [11:0]      mem_o,      // present address in the memory
  output logic [3:0]       place_o,    // mem_o, relative to the block of eight of start_o
  output logic [3:0]       row_o,      // present byte of the row
  output logic [3:0]       end_o,      // index behind the last byte of the row
  output logic             ended_o,    // row_o has reached the end
  output logic             staged_o,   // mem_o lies in the stage (RN-46)
  output logic             cleared_o   // JobClear: mem_o is the last address
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
    // Derived from the block of start_q, because mem_o is at the end of a longer path.
    logic stage_here, stage_behind;
    assign stage_here   = start_q[4] && (StageBytes == 16 || !start_q[3]);
    assign stage_behind = start_q[4] ? StageBytes == 16 && !start_q[3] : start_q[3];
    assign staged_o = !(|start_q[11:5]) && (low_q[3] ? stage_behind : stage_here);
    assign ended_o  = trigger_i ? (StageBytes == 16 ? row_q == 4'd0 : row_q[3]) : row_q == end_o;
  end

  // An access reaches at most into the next block of eight bytes, so only the place in the block is
  // counted. JobClear moves the start on from block to block.
  assign high  = (act_i ? 9'h002 : start_q[11:3]) + {8'd0, low_q[3]};
  assign mem_o = {high, low_q[2:0]};

  // First address: A itself, the row of STATUS or IDENT, the stage, or the first bytes of the
  // frame.
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
    // JobGuard: first and last byte of the access in turn.
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

  // READ gives its length in the third byte, and its answer begins with the two address bytes. The
  // end is registered: it is known long before the first byte moves.
  logic [3:0] end_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) end_q <= '0;
    else         end_q <= far_i && !a_i[0] ? {1'b0, count_i} + 4'd2 : dlc_i;
  end
  assign end_o = end_q;

endmodule
