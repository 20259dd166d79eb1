// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_rn_tx: transmission. It selects the next frame (HERE, STATUS, or the head of the queue of
// answers, RN-54), fetches its header and data bytes from the RAM and offers them to the engine
// (RN-80), and drops frames after too many attempts (RN-15) or at the end of their life (RN-54).
// The queue consists of rows of the RAM. A frame is received into the row behind the queue; an
// answer is made in the same row and stays there.

module can_rn_tx #(
  parameter int NameBits = 3,
  /// Depth of the queue of answers, 1 or 4.
  parameter int TxDepth = 1,
  /// 1: answers to direct reads carry the identifier of their request (RN-16). Byte 9 of such a row
  /// has bit 4 set, and bit 5 if the request went to all nodes.
  parameter bit SameId = 1'b0
) (
  input  logic                clk_i,
  input  logic                rst_ni,
  input  can_rn_pkg::job_t    job_i,         // present job
  input  logic [1:0]          phase_i,       // phase of the job
  input  logic                live_i,        // a frame for this node is under way
  input  logic                flush_i,       // queue is emptied, a frame that is offered is dropped
  input  logic [NameBits-1:0] number_i,      // node number
  input  logic                owe_status_i,  // a STATUS frame is to be sent
  input  logic                owe_here_i,    // a HERE frame is to be sent
  input  logic                one_i,         // byte read is 1
  input  logic [7:0]          next_i,        // byte from the RAM, not registered
  output logic [2:0]          tail_o,        // row behind the queue: received frame, new answer
  output logic [2:0]          head_o,        // row at the head of the queue
  output logic [2:0]          age_o,         // JobAge: row of the answer that ages
  output logic                more_o,        // JobAge: another answer has to age
  output logic                header_o,      // JobLoad fetches the header, otherwise a data byte
  output logic [2:0]          at_o,          // index of that data byte
  output logic                status_o,      // frame offered to the engine is STATUS
  output logic                full_o,        // queue is full
  output logic                some_o,        // queue is not empty
  output logic                load_o,        // JobLoad is due
  output logic                urgent_o,      // JobLoad is due for a data byte, within eight bits
  output logic                try_o,         // JobTry is due: an attempt has failed
  output logic                gone_o,        // pulse: the frame offered has been sent or dropped
  output logic                gone_status_o, // pulse: that frame was STATUS
  output logic                gone_here_o,   // pulse: that frame was HERE
  output logic                popped_o,      // pulse: the head of the queue has gone
  output logic                dropped_o,     // pulse: a frame was dropped unsent
  // Engine
  output logic                tx_req_o,      // frame waits for the engine
  output logic [3:0]          tx_dlc_o,      // its DLC
  output logic [31:0]         tx_word_o,     // its ID word, or next data byte in 25:18
  input  logic                tx_next_i,     // pulse: word taken
  input  logic                tx_ok_i,       // pulse: frame sent
  input  logic                tx_fail_i,     // pulse: attempt failed
  input  logic                transmitter_i  // with tx_fail_i: by an error, not lost arbitration
);
  localparam int PtrWidth = TxDepth == 1 ? 1 : 3;

  logic [PtrWidth-1:0] tail_q, head_q, head_d;
  logic [1:0]          src_q;    // source of the frame offered, chosen with its header
  logic                header_q; // header is offered, otherwise a data byte
  logic [2:0]          at_q;     // index of the next data byte
  logic                load_q, try_q;
  logic [5:0]          length_q; // {all nodes, direct read (SameId), DLC}
  logic [7:0]          hold_q;   // A of the header, or a data byte
  logic                loading, gone, stale, recalled, drop, first_gone;
  logic                first;    // JobAge is at the head of the queue

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
    // RN-54: every 10 ms all answers age, from the head on. Only the head is dropped; the others
    // wait for that with their last 10 ms. If the head goes before its JobAge, age_q moves on with
    // it; the other answers are not affected. The comparison of the next row with the tail is
    // registered: neither changes during JobAge.
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

  // A frame goes when it is sent, after too many attempts, or when its life is over. Life does not
  // end a frame that the engine has just taken, nor the answer behind a head that has gone while
  // the life of that head was read.
  assign gone  = tx_ok_i || (job_i == can_rn_pkg::JobTry && phase_i[1] && one_i);
  assign stale = job_i == can_rn_pkg::JobAge && (&phase_i) && one_i && header_q && !tx_next_i
                 && some_o && first;
  // RN-26: a SELECT that does not select takes back a HERE that waits.
  assign recalled = (&src_q) && !owe_here_i;
  // If STATUS or HERE is offered, it stays when the head of the queue becomes stale.
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
      // Chosen in phase 0, where load_o shows that there is a frame; it may go in a later phase.
      else if (loading && phase_i == 2'd0 && src_q == can_rn_pkg::SrcNone)
        src_q <= owe_here_i ? can_rn_pkg::SrcHere
                            : owe_status_i ? can_rn_pkg::SrcStatus : can_rn_pkg::SrcQueue;
      if (flush_i || tx_ok_i || tx_fail_i)        header_q <= 1'b1;
      else if (tx_next_i)                         header_q <= 1'b0;
      if (header_q)                               at_q <= '0;
      else if (tx_next_i)                         at_q <= at_q + 3'd1;
      // JobAge withdraws the request in phase 3, where it may drop the frame: it is not taken then.
      // A frame for this node withdraws it until its work is done, however long user logic holds
      // that: the engine puts DLC and RTR of what it sends where the work looks for the frame's.
      // Cleared in phase 0: an event in a later phase sets it again and repeats the load.
      load_q <= drop || tx_fail_i || tx_next_i || live_i
                || (job_i == can_rn_pkg::JobAge && phase_i[1])
                || (load_q && !(loading && phase_i == 2'd0));
      // A frame that goes takes a failed attempt with it that has not been counted.
      if (drop || job_i == can_rn_pkg::JobTry) try_q <= 1'b0;
      else if (tx_fail_i && transmitter_i)     try_q <= 1'b1;
    end
  end

  // The read register of the RAM is shared, so the engine's next byte is held here (RN-80). The
  // length of a header is loaded before its A. STATUS: A 7E, DLC 8; HERE: ID 0x402, DLC 0.
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
      // Fixed DLC of own frames: STATUS 8, HERE 0.
      if (phase_i[0]) length_q <= {next_i[5:4] & {2{!own}}, own ? !src_q[0] : next_i[3],
                                   next_i[2:0] & {3{!own}}};
      if (phase_i[1]) hold_q   <= own && header_q ? 8'(own_a) : next_i;
    end
  end

  // RN-16: identifier of the request: direction 0, name 1 if the request went to all nodes.
  logic request, all;
  logic [10:0] id;
  assign request = SameId && !own && length_q[4];
  assign all     = request && length_q[5];
  assign id      = {!request, (number_i & {NameBits{!((&src_q) || all)}}) | NameBits'(all),
                    hold_q[AddrBits-1:0]};

  assign tx_req_o  = header_q && !(load_q || loading);
  assign tx_dlc_o  = length_q[3:0];
  assign tx_word_o = {3'b000, id[10:8], header_q ? id[7:0] : hold_q, 18'd0};

endmodule
