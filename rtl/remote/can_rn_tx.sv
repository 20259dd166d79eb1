// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_rn_tx: what is sent: HERE, STATUS, or the first of the queue of answers, which are rows of
// the RAM. A frame is received into the row behind the queue; an answer is made there and stays.

module can_rn_tx #(
  parameter int NameBits = 3,
  /// Answers, 1 or 4.
  parameter int TxDepth = 1,
  /// 1: bits 5:4 of byte 1 of a header: to all, answer under the identifier of its request (RN-16).
  parameter bit SameId = 1'b0
) (
  input  logic                clk_i,
  input  logic                rst_ni,
  input  can_rn_pkg::job_t    job_i,
  input  logic [1:0]          phase_i,
  input  logic                flush_i,       // nothing is sent any more
  input  logic [NameBits-1:0] number_i,
  input  logic                owe_status_i,
  input  logic                owe_here_i,
  input  logic                one_i,         // byte read is 1
  input  logic [7:0]          next_i,        // byte that comes from the RAM
  output logic [2:0]          tail_o,
  output logic [2:0]          head_o,
  output logic [2:0]          age_o,         // JobAge: row that it looks at
  output logic                more_o,        // and another one after it
  output logic                header_o,      // the header is wanted next,
  output logic [2:0]          at_o,          // or this byte
  output logic                status_o,      // it is one of STATUS
  output logic                full_o,
  output logic                some_o,        // the queue holds an answer
  output logic                load_o,        // it is wanted
  output logic                urgent_o,      // within eight bits
  output logic                try_o,         // an attempt has failed
  output logic                gone_o,        // pulse: what was offered is sent or dropped
  output logic                gone_status_o, // it was STATUS, HERE
  output logic                gone_here_o,
  output logic                popped_o,      // the head of the queue has gone
  output logic                dropped_o,     // pulse: something has gone and was not sent
  // Engine
  output logic                tx_req_o,
  output logic [3:0]          tx_dlc_o,
  output logic [31:0]         tx_word_o,
  input  logic                tx_next_i,
  input  logic                tx_ok_i,
  input  logic                tx_fail_i,
  input  logic                transmitter_i  // beside tx_fail_i: an error, else lost arbitration
);
  localparam int PtrWidth = TxDepth == 1 ? 1 : 3;

  logic [PtrWidth-1:0] tail_q, head_q, head_d;
  logic [1:0]          src_q;    // what is offered, once its header has been loaded
  logic                header_q; // the header is offered,
  logic [2:0]          at_q;     // or this byte comes next
  logic                load_q, try_q;
  logic [5:0]          length_q; // and identifier, see below
  logic [7:0]          hold_q;   // A, or a byte
  logic                loading, gone, stale, recalled, drop, first_gone;
  logic                first;    // JobAge looks at the head of the queue

  assign tail_o   = 3'(tail_q);
  assign head_o   = 3'(head_q);
  assign header_o = header_q;
  assign at_o     = at_q;
  assign status_o = src_q == can_rn_pkg::SrcStatus;
  assign some_o   = tail_q != head_q;
  if (TxDepth == 1) begin : gen_single
    assign full_o = some_o;
    assign first  = 1'b1;
    assign age_o  = 3'(head_q);
    assign more_o = 1'b0;
  end else begin : gen_queue
    assign full_o = tail_q == {~head_q[2], head_q[1:0]};
    // RN-54: all answers age, beginning with the first; only the first is dropped, the others wait
    // for that with 10 ms left. One that goes meanwhile takes no other with it.
    // The row behind is looked at a clock before that counts: both stay during JobAge.
    logic [2:0] age_q, behind;
    logic       looks, ages, last_q;
    assign looks  = job_i == can_rn_pkg::JobAge;
    assign ages   = looks && (&phase_i);
    assign behind = age_q + 3'd1;
    assign first  = age_q == head_q;
    assign more_o = some_o && !last_q;
    assign age_o  = age_q;
    always_ff @(posedge clk_i or negedge rst_ni) begin
      if (!rst_ni) begin
        age_q  <= '0;
        last_q <= 1'b0;
      end else begin
        last_q <= behind == tail_q;
        if (flush_i)                                   age_q <= tail_q;
        else if (ages && !more_o)                      age_q <= head_d;
        else if (ages || (first_gone && first && !looks)) age_q <= behind;
      end
    end
  end
  assign load_o  = load_q && (some_o || owe_status_i || owe_here_i);
  assign urgent_o = load_q && !header_q;
  assign try_o   = try_q;
  assign loading = job_i == can_rn_pkg::JobLoad;

  // Sent, or too many attempts; or its life is over. A frame that the engine has just taken stays,
  // and so does what is behind one that has gone while its life was read.
  assign gone  = tx_ok_i || (job_i == can_rn_pkg::JobTry && phase_i[1] && one_i);
  assign stale = job_i == can_rn_pkg::JobAge && (&phase_i) && one_i && header_q && !tx_next_i
                 && some_o && first;
  // A SELECT that does not select takes back a HERE that waits.
  assign recalled = (&src_q) && !owe_here_i;
  // STATUS and HERE do not go with the head of the queue.
  assign drop     = flush_i || gone || (stale && src_q == can_rn_pkg::SrcQueue) || recalled;
  assign gone_o        = drop;
  assign dropped_o     = stale || (gone && !tx_ok_i);
  assign gone_status_o = gone && status_o;
  assign gone_here_o   = gone && (&src_q);

  assign first_gone = stale || (gone && src_q == can_rn_pkg::SrcQueue);
  assign popped_o   = flush_i || first_gone;
  assign head_d     = first_gone ? head_q + 1'b1 : head_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      tail_q <= '0;
      head_q <= '0;
    end else begin
      if (job_i == can_rn_pkg::JobPush)             tail_q <= tail_q + 1'b1;
      if (flush_i)                                  head_q <= tail_q;
      else                                          head_q <= head_d;
    end
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      src_q  <= can_rn_pkg::SrcNone;
      header_q <= 1'b1;
      at_q   <= '0;
      load_q <= 1'b1;
      try_q  <= 1'b0;
    end else begin
      if (drop)                                   src_q <= can_rn_pkg::SrcNone;
      // In its first clock there is something; what was there may go in the next ones.
      else if (loading && phase_i == 2'd0 && src_q == can_rn_pkg::SrcNone)
        src_q <= owe_here_i ? can_rn_pkg::SrcHere
                            : owe_status_i ? can_rn_pkg::SrcStatus : can_rn_pkg::SrcQueue;
      if (flush_i || tx_ok_i || tx_fail_i)        header_q <= 1'b1;
      else if (tx_next_i)                         header_q <= 1'b0;
      if (header_q)                               at_q <= '0;
      else if (tx_next_i)                         at_q <= at_q + 3'd1;
      if (drop || tx_fail_i || tx_next_i || (job_i == can_rn_pkg::JobAge && phase_i[1]))
                                                  load_q <= 1'b1;
      // From its first clock on: what ends or begins meanwhile makes it be done again.
      else if (loading && phase_i == 2'd0)        load_q <= 1'b0;
      // What goes takes its failed attempt with it.
      if (drop || job_i == can_rn_pkg::JobTry) try_q <= 1'b0;
      else if (tx_fail_i && transmitter_i)     try_q <= 1'b1;
    end
  end

  // The read register of the RAM is shared, so bytes are kept here; length and A come one by one.
  // Header: A in byte 0, length in byte 1. STATUS is 7E with eight bytes, HERE 0x402 with none.
  localparam int AddrBits = 10 - NameBits;
  logic                own;
  logic [AddrBits-1:0] own_a;
  assign own   = src_q[1];
  assign own_a = {{AddrBits-2{!src_q[0]}}, 2'b10};
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      length_q <= '0;
      hold_q   <= '0;
    end else if (loading) begin
      // Own: 8 of STATUS, 0 of HERE.
      if (phase_i[0]) length_q <= {next_i[5:4] & {2{!own}}, own ? !src_q[0] : next_i[3],
                                   next_i[2:0] & {3{!own}}};
      if (phase_i[1]) hold_q   <= own && header_q ? 8'(own_a) : next_i;
    end
  end

  // RN-16, for the demonstration: direction 0, and name 1 where all have been asked.
  logic request, all;
  logic [10:0] id;
  assign request = SameId && !own && length_q[4];
  assign all     = request && length_q[5];
  assign id      = {!request, (number_i & {NameBits{!((&src_q) || all)}}) | NameBits'(all),
                    hold_q[AddrBits-1:0]};

  assign tx_req_o  = !load_q && header_q && !loading;
  assign tx_dlc_o  = length_q[3:0];
  assign tx_word_o = {3'b000, id[10:8], header_q ? id[7:0] : hold_q, 18'd0};

endmodule
