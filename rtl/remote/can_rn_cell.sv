// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_rn_cell: address generator for the upper 512 bytes of the memory (0xE00 to 0xFFF). It gives
// the byte that a job reads or writes in each of its phases. Other blocks supply the bytes of
// producers, map entries, block transfers and counters.
//   0x000   variables                       0x100   configuration
//   0x010   shadow of the stage             0x1F0   STATUS, IDENT
//   0x080   rows of 16 bytes: queue of answers; behind it the frame received or the answer made.
//           Bytes 0 to 7 are data, 8 is A, 9 length, 10 life

module can_rn_cell (
  input  can_rn_pkg::job_t job_i,        // present job
  input  logic [1:0]       phase_i,      // phase of the job
  input  logic             read_i,       // JobMove copies memory to row
  input  logic             trigger_i,    // JobMove copies the shadow to the memory (TRIGGER)
  input  logic             none_i,       // JobTrigger: frame has no count, one is added
  input  logic             refused_i,    // request is refused
  input  logic             setup_i,      // request is SETUP
  input  logic             off_i,        // node is in bus-off, as noted by JobTurn
  input  logic             status_i,     // frame offered to the engine is STATUS
  input  logic [3:0]       row_i,        // byte of the row
  input  logic [2:0]       tail_i,       // row behind the queue: received frame, new answer
  input  logic [2:0]       head_i,       // row at the head of the queue
  input  logic [2:0]       age_i,        // JobAge: row of the answer that ages
  input  logic             header_i,     // JobLoad fetches the header, otherwise a data byte
  input  logic [2:0]       at_i,         // JobLoad: index of that data byte
  input  logic             timer_i,      // JobLow, JobHigh: 0: watchdog, 1: bus-off timer
  input  logic             new_tries_i,  // JobRow: attempts are reloaded from RETRY
  input  logic             zero_i,       // byte read is 0
  input  logic             one_i,        // byte read is 1
  input  logic             own_i,        // another block supplies the byte instead of the row
  output logic [8:0]       cell_o,       // byte of the upper 512 to read or write; 0: none
  output logic             we_o          // that byte is written in this phase
);
  // Variables: 0, 1 watchdog; 2 milliseconds; 3 rest of the back-off, or of 10 s; 4 constant for 10
  // s; 5 attempts left for the frame offered.
  localparam logic [1:0] PageVar    = 2'd0;
  localparam logic [1:0] PageRow    = 2'd1;
  localparam logic [1:0] PageConfig = 2'd2;
  localparam logic [1:0] PageStatus = 2'd3;
  logic [1:0] page;
  logic [3:0] place;
  logic [2:0] row;
  logic       last;
  assign last = phase_i[1];

  always_comb begin
    page  = PageVar;
    place = 4'd0;
    case (job_i)
      can_rn_pkg::JobByte: begin
        page  = PageRow;
        // The byte is written in phase 0. In phase 1 a mask of SELECT reads the byte before it.
        place = {row_i[3:1], row_i[0] && (setup_i || !phase_i[0])};
      end
      can_rn_pkg::JobMove, can_rn_pkg::JobOpen: begin
        page  = trigger_i ? PageVar : PageRow;
        place = row_i;
      end
      can_rn_pkg::JobLoad: begin
        // Header: length, then A. Data: before byte 0 of any frame, STATUS is updated in phase 0.
        page  = !header_i && (status_i || phase_i == 2'd0) ? PageStatus : PageRow;
        place = {header_i, at_i};
        if (header_i) place[0] = phase_i == 2'd0;
      end
      can_rn_pkg::JobPush: begin
        page  = PageRow;
        place = 4'd8;
      end
      can_rn_pkg::JobSeq: page = last ? PageRow : PageVar;
      can_rn_pkg::JobFresh: begin
        page  = PageStatus;
        place = 4'd0;
      end
      can_rn_pkg::JobTrigger: begin
        page  = none_i || last ? PageStatus : PageRow;
        place = {1'b0, {3{none_i || last}}};
      end
      can_rn_pkg::JobTurn: begin
        page  = last || off_i ? PageVar : PageConfig;
        place = last ? 4'd3 : 4'd4;
      end
      can_rn_pkg::JobLow, can_rn_pkg::JobHigh: begin
        page  = PageVar;
        place = {2'b00, timer_i, job_i[0]};
      end
      can_rn_pkg::JobTry: begin
        page  = PageVar;
        place = 4'd5;
      end
      can_rn_pkg::JobAge: begin
        page  = PageRow;
        place = 4'd10;
      end
      can_rn_pkg::JobCount: begin
        page  = PageStatus;
        place = {1'b0, !(&phase_i), refused_i, !refused_i};
      end
      can_rn_pkg::JobRow: begin
        page  = !last ? PageConfig : phase_i[0] ? PageVar : PageRow;
        place = {last && !phase_i[0], !(last && !phase_i[0]), last ^ phase_i[0],
                 !(last && !phase_i[0])};
      end
      can_rn_pkg::JobConfig: begin
        page  = PageConfig;
        place = {3'b000, phase_i[0]};
      end
      can_rn_pkg::JobFeed: begin
        page  = last ? PageVar : PageConfig;
        place = {2'b00, !last, phase_i[0]};
      end
      default: ;
    endcase
  end

  assign row = job_i == can_rn_pkg::JobLoad ? head_i
               : job_i == can_rn_pkg::JobAge ? age_i : tail_i;
  always_comb begin
    case (page)
      PageVar:    cell_o = {4'h0, job_i == can_rn_pkg::JobMove, place};
      PageRow:    cell_o = {2'b01, row, place} & {9{!own_i}};
      PageConfig: cell_o = {5'h10, place};
      default:    cell_o = {5'h1F, place};
    endcase
  end

  always_comb begin
    we_o = job_i[4] && last;
    case (job_i)
      can_rn_pkg::JobByte: we_o = phase_i == 2'd0;
      can_rn_pkg::JobLoad: we_o = phase_i == 2'd0 && !header_i && at_i == 3'd0;
      can_rn_pkg::JobMove: we_o = last && !(read_i && phase_i[0]);
      can_rn_pkg::JobPush, can_rn_pkg::JobFresh, can_rn_pkg::JobClear: we_o = 1'b1;
      can_rn_pkg::JobHigh, can_rn_pkg::JobTry: we_o = last && !zero_i;
      // A life of 0 would be no limit: a frame that is being sent keeps 1 and is checked again.
      can_rn_pkg::JobAge:    we_o = last && !zero_i && !one_i;
      can_rn_pkg::JobConfig: we_o = 1'b0;
      can_rn_pkg::JobRow:    we_o = last && (new_tries_i || !phase_i[0]);
      default: ;
    endcase
  end

endmodule
