// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_rn_cell: which byte of the upper 512 a job reads or writes in each of its phases.
//   0x000 variables                       0x100 configuration
//   0x010 shadow of the stage             0x1F0 STATUS, IDENT
//   0x080 rows of 16 bytes: the frame that is received or the answer that is made, and the queue;
//         0..7 data, 8 A, 9 length, A life

module can_rn_cell (
  input  can_rn_pkg::job_t job_i,
  input  logic [1:0]       phase_i,
  input  logic             read_i,       // JobMove: memory to row
  input  logic             trigger_i,    // JobMove: shadow to memory
  input  logic             none_i,       // the frame has no byte
  input  logic             refused_i,
  input  logic             setup_i,
  input  logic             off_i,        // bus-off
  input  logic             status_i,     // what the engine sends is STATUS
  input  logic [3:0]       row_i,        // byte of the row
  input  logic [2:0]       tail_i,       // row of the frame
  input  logic [2:0]       head_i,       // row at the head of the queue
  input  logic [2:0]       age_i,        // row whose life goes on
  input  logic             header_i,     // the engine wants a header,
  input  logic [2:0]       at_i,         // or this byte
  input  logic             timer_i,
  input  logic             new_tries_i,  // JobRow: attempts are written, too
  input  logic             zero_i,       // byte read is 0, 1
  input  logic             one_i,
  input  logic             own_i,        // not a byte of the row, but what another block says
  output logic [8:0]       cell_o,       // byte of the upper 512 that is read or written
  output logic             we_o
);
  // Variables: 0, 1 watchdog; 2 counts ms; 3 rest of the back-off, or of 10 s; 4 constant: 10 s;
  // 5 attempts of the frame that is offered
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
        // Written in the first phase; the byte before a mask is read in the second.
        place = {row_i[3:1], row_i[0] && (setup_i || !phase_i[0])};
      end
      can_rn_pkg::JobMove, can_rn_pkg::JobOpen: begin
        page  = trigger_i ? PageVar : PageRow;
        place = row_i;
      end
      can_rn_pkg::JobLoad: begin
        // Length and A, or the byte; before the first byte of any frame the node writes what it is.
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
      // 0 would be no limit: what is on its way stays, and is asked again.
      can_rn_pkg::JobAge:    we_o = last && !zero_i && !one_i;
      can_rn_pkg::JobConfig: we_o = 1'b0;
      can_rn_pkg::JobRow:    we_o = last && (new_tries_i || !phase_i[0]);
      default: ;
    endcase
  end

endmodule
