// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_rn_produce: statements that the node makes by itself (RN-63, RN-64). It walks through the
// entries and looks at each as if a remote frame had asked for it, so that whatever answers such a
// frame checks the entry and makes the statement. Passes, each over all entries: after a
// millisecond periods and gaps, then changes; after a TRIGGER the periods that count those; at last
// the first entry that is due and may be sent.
//   0x020 four bytes an entry: what is left of the period, 16 bits, and of the gap
//   0x040 eight bytes an entry: those last sent; they are sent from there
//   0x140 the entries

module can_rn_produce #(
  /// Entries, 4 or 8.
  parameter int NumProd = 8
) (
  input  logic               clk_i,
  input  logic               rst_ni,
  input  can_rn_pkg::job_t   job_i,
  input  logic [1:0]         phase_i,
  input  logic [NumProd-1:0] event_i,      // user logic: due now
  input  logic               ms_i,
  // Node
  input  logic               run_i,
  input  logic               forget_i,     // nothing is due any longer
  input  logic               closed_i,     // the queue holds something, or nothing may be sent
  input  logic               popped_i,     // the head of the queue has gone
  input  logic               operate_i,
  // Entry
  input  logic               refused_i,    // it is off
  input  logic               info_i,       // it is STATUS or IDENT
  input  logic [3:0]         mode_i,       // JobEntry: on, TRIGGERs, on change, cyclic
  input  logic               zero_i,       // the byte read is 0, 1
  input  logic               one_i,
  input  logic [2:0]         row_i,        // place of a byte in the statement
  input  logic               first_i,      // JobSame: no byte has been compared
  input  logic               ended_i,      // JobSame, JobMove: all have been
  input  logic               differ_i,     // JobSame: these two differ
  input  logic               yield_i,      // a header waits, or the engine: what takes long stops
  input  logic               header_i,     // JobLoad: the header, not ..
  input  logic [2:0]         at_i,         // .. this byte
  input  logic               status_i,     // it is one of STATUS
  output logic               want_o,       // an entry is to be looked at
  output logic               visit_o,      // this is being done
  output can_rn_pkg::job_t   then_o,       // what follows its jobs
  output logic               keep_o,       // JobSame goes on
  output logic               same_o,       // JobSame
  output logic               own_o,        // it is no byte of the row,
  output logic [8:0]         cell_o,       // but this
  output logic               no_write_o
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

  // Passes
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
      // The visit gives way to a frame, and comes again.
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

  // A period that is over stays 0 until the next tick begins it anew; one of 0 ms does not count.
  // An entry that is off leaves a 0.
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

  // Due until the statement begins to be made, or may not be any more.
  logic over_now, not_now;
  assign over_now = allowed && (over || told);
  assign not_now  = send && visit_q && (job_i == can_rn_pkg::JobFresh || (gap && last && !allowed));
  assign here     = NumProd'(1) << k_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) due_q <= '0;
    else         due_q <= (event_i | (due_q & ~(here & {NumProd{not_now}}))
                           | (here & {NumProd{over_now}})) & {NumProd{!forget_i}};
  end

  // The one statement in the queue, which was empty before.
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

  // Bytes
  logic load_q, copy;
  logic [2:0] k;
  // Known a clock before: JobLoad reads it in its second phase.
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) load_q <= 1'b0;
    else         load_q <= job_i == can_rn_pkg::JobLoad && phase_i == 2'd0 && statement_q
                           && !status_i && !header_i;
  end
  assign copy  = same || job_i == can_rn_pkg::JobMove;
  assign k     = load_q ? 3'(head_q) : 3'(k_q);
  assign own_o = load_q || (visit_q && phase_i[1]);
  // The mover writes a byte more than it is told: behind eight that would be the first again.
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
