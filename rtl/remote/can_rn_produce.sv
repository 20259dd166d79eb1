// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_rn_produce: producers, statements that the node sends without a request (RN-63, RN-64). It
// visits the entries one after another and treats each like a remote frame that asks for its bytes:
// the blocks that answer such a frame check the entry and make the statement. Every millisecond one
// pass over all entries counts periods and gaps, and another one looks for changes. After a TRIGGER
// a pass counts the periods in TRIGGERs. Otherwise the first entry that is due and may be sent is
// visited and sent.
//   0x020   4 bytes per entry: rest of the period (2 bytes), rest of the gap
//   0x040   8 bytes per entry: the bytes last sent, from which a statement is sent
//   0x140   the entries, 8 bytes each

module can_rn_produce #(
  /// Entries, 4 or 8.
  parameter int NumProd = 8
) (
  input  logic               clk_i,
  input  logic               rst_ni,
  input  can_rn_pkg::job_t   job_i,        // present job
  input  logic [1:0]         phase_i,      // phase of the job
  input  logic [NumProd-1:0] event_i,      // user logic: entry is due now
  input  logic               ms_i,         // pulse: millisecond
  // Node
  input  logic               run_i,        // node is on the bus
  input  logic               forget_i,     // due bits are cleared
  input  logic               closed_i,     // queue is not empty, or nothing may be sent
  input  logic               popped_i,     // pulse: the head of the queue has gone
  input  logic               operate_i,    // node is in OPERATE
  // Entry
  input  logic               refused_i,    // entry is off
  input  logic               info_i,       // entry is for STATUS or IDENT
  input  logic [3:0]         mode_i,       // JobEntry: {on, TRIGGERs, on change, cyclic}
  input  logic               zero_i,       // byte read is 0
  input  logic               one_i,        // byte read is 1
  input  logic [2:0]         row_i,        // index of a byte in the statement
  input  logic               first_i,      // JobSame: no byte has been compared yet
  input  logic               ended_i,      // JobSame, JobMove: all bytes are done
  input  logic               differ_i,     // JobSame: byte differs from the one last sent
  input  logic               yield_i,      // frame or engine waits: JobBegin, JobSame stop
  input  logic               header_i,     // JobLoad fetches the header, else a byte
  input  logic [2:0]         at_i,         // JobLoad: index of that byte
  input  logic               status_i,     // frame offered to the engine is STATUS
  output logic               want_o,       // JobEntry is due: an entry is to be visited
  output logic               visit_o,      // an entry is visited
  output can_rn_pkg::job_t   then_o,       // next job of the visit
  output logic               keep_o,       // JobSame continues
  output logic               same_o,       // JobSame runs
  output logic               own_o,        // cell_o replaces the byte of the row
  output logic [8:0]         cell_o,       // byte to read or write; 0: none
  output logic               no_write_o    // the byte is not written
);
  localparam logic [1:0] PassPeriod  = 2'd0;
  localparam logic [1:0] PassChange  = 2'd1;
  localparam logic [1:0] PassTrigger = 2'd2;
  localparam logic [1:0] PassSend    = 2'd3;
  localparam int IndexWidth = $clog2(NumProd);

  logic [1:0]            pass_q;
  logic [IndexWidth-1:0] k_q, head_q;
  logic [NumProd-1:0]    due_q, here;
  logic ms_q, trigger_q, send_q, visit_q, given_q, statement_q, low_zero_q, low_one_q;

  logic idle, stand, entry, down, renew, gap, keep, same, send, last;
  assign idle  = job_i == can_rn_pkg::JobIdle;
  assign stand = idle && !visit_q;   // no visit, and none that has just ended
  assign entry = job_i == can_rn_pkg::JobEntry;
  assign down  = job_i == can_rn_pkg::JobDown;
  assign renew = job_i == can_rn_pkg::JobRenew;
  assign gap   = job_i == can_rn_pkg::JobGap;
  assign keep  = job_i == can_rn_pkg::JobKeep;
  assign same  = job_i == can_rn_pkg::JobSame;
  assign send  = pass_q == PassSend;
  assign last  = phase_i[1];

  // Passes.
  logic begins, first, rest, skip, next, wrap;
  assign begins = job_i == can_rn_pkg::JobBegin;
  assign first  = k_q == '0;
  assign rest   = send && first && (closed_i || !send_q);
  assign want_o = !visit_q && (!send || (!rest && !closed_i && due_q[k_q]));
  assign skip   = stand && send && !rest && !closed_i && !due_q[k_q];
  assign next   = skip || (visit_q && idle && !given_q);
  assign wrap   = next && (&k_q);

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      pass_q <= PassSend;
      k_q    <= '0;
    end else begin
      if (stand && send && closed_i) k_q <= '0;
      else if (next)                 k_q <= k_q + 1'b1;
      if (wrap)                      pass_q <= pass_q == PassPeriod ? PassChange : PassSend;
      else if (stand && rest && ms_q)      pass_q <= PassPeriod;
      else if (stand && rest && trigger_q) pass_q <= PassTrigger;
    end
  end
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {ms_q, trigger_q, send_q, visit_q, given_q} <= '0;
    end else begin
      ms_q      <= run_i && (ms_i || (ms_q && !(stand && rest)));
      trigger_q <= job_i == can_rn_pkg::JobTrigger || (trigger_q && (ms_q || !(stand && rest)));
      send_q    <= popped_i || (|event_i) || (wrap && !send)
                   || (stand && send && closed_i && !first)
                   || (send_q && !(next && send && first));
      visit_q   <= entry || (visit_q && !idle);
      // If a visit gives way to a frame, it is repeated.
      given_q   <= yield_i && (same || begins);
    end
  end
  assign visit_o = visit_q;

  logic counts, allowed, over, told;
  assign counts  = mode_i[0] && mode_i[2] == (pass_q == PassTrigger);
  assign allowed = !refused_i && (operate_i || info_i);
  assign over    = down && (&phase_i) && low_one_q && zero_i;
  assign told    = same && phase_i[0] && !first_i && differ_i;
  assign same_o  = same;
  assign keep_o  = !yield_i && !(phase_i[0] && (told || ended_i || !allowed));

  // A period that has ended stays 0 until the next tick starts it again. A period of 0 does not
  // count. The time of an entry that is off is set to 0.
  logic nothing;
  assign nothing = low_zero_q && zero_i;
  can_rn_pkg::job_t ticked;
  assign ticked = pass_q == PassPeriod ? can_rn_pkg::JobGap : can_rn_pkg::JobIdle;
  always_comb begin
    then_o = can_rn_pkg::JobIdle;
    case (job_i)
      can_rn_pkg::JobEntry: begin
        if (send)                        then_o = can_rn_pkg::JobGap;
        else if (pass_q == PassChange)   then_o = mode_i[1] ? can_rn_pkg::JobFresh
                                                            : can_rn_pkg::JobIdle;
        else if (counts || (!mode_i[3] && pass_q == PassPeriod)) then_o = can_rn_pkg::JobDown;
        else                             then_o = ticked;
      end
      can_rn_pkg::JobDown:  then_o = refused_i || nothing ? can_rn_pkg::JobRenew : ticked;
      can_rn_pkg::JobRenew: then_o = refused_i || nothing ? ticked : can_rn_pkg::JobDown;
      can_rn_pkg::JobGap:   if (send && zero_i && allowed) then_o = can_rn_pkg::JobBegin;
      can_rn_pkg::JobFresh: then_o = send ? can_rn_pkg::JobMove : can_rn_pkg::JobSame;
      can_rn_pkg::JobPush:  then_o = can_rn_pkg::JobKeep;
      default: ;
    endcase
  end
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {low_zero_q, low_one_q} <= '0;
    end else if (!phase_i[0]) begin
      low_zero_q <= zero_i;
      low_one_q  <= one_i;
    end
  end

  // An entry is due until its statement begins to be made, or until it may not be sent any more.
  logic over_now, not_now;
  assign over_now = allowed && (over || told);
  assign not_now  = send && visit_q && (job_i == can_rn_pkg::JobFresh || (gap && last && !allowed));
  assign here     = NumProd'(1) << k_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) due_q <= '0;
    else         due_q <= (event_i | (due_q & ~(here & {NumProd{not_now}}))
                           | (here & {NumProd{over_now}})) & {NumProd{!forget_i}};
  end

  // A statement enters only an empty queue, so there is at most one.
  logic push;
  assign push = visit_q && job_i == can_rn_pkg::JobPush;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      statement_q <= 1'b0;
      head_q      <= '0;
    end else begin
      statement_q <= push || (statement_q && !popped_i);
      if (push) head_q <= k_q;
    end
  end

  // Bytes.
  logic load_q, copy;
  logic [2:0] k;
  // Registered one clock before its use: JobLoad reads the byte in phase 1.
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) load_q <= 1'b0;
    else         load_q <= job_i == can_rn_pkg::JobLoad && phase_i == 2'd0 && statement_q
                           && !status_i && !header_i;
  end
  assign copy  = same || job_i == can_rn_pkg::JobMove;
  assign k     = load_q ? 3'(head_q) : 3'(k_q);
  assign own_o = load_q || (visit_q && phase_i[1]);
  // The mover writes one byte after the last. After the eighth that would be the first one again.
  assign no_write_o = entry || (visit_q && copy && ended_i) || (gap && (zero_i || send));
  always_comb begin
    cell_o = {4'b0001, k, gap || keep, phase_i[0] && !gap};
    if (load_q || copy)                          cell_o = {3'b001, k, load_q ? at_i : row_i};
    if (entry || (!last && keep))
                                                 cell_o = {3'b101, k, !entry, 1'b0,
                                                           entry && phase_i[0]};
    if (renew && !last)                          cell_o = refused_i ? 9'h006
                                                          : {3'b101, k, 2'b01, phase_i[0]};
    if (!(load_q || entry || down || renew || gap || keep || (visit_q && copy))) cell_o = '0;
  end
endmodule
