// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_rn_tally: the eight counters at 0xFE8, which stop at 255 (RN-35). An event is noted in what_q
// and counted by JobTally as soon as no other job runs; no second one comes before that. Only the
// end of a hold and of an answer's life may come in the same frame as another event, so these two
// have notes of their own (over_q, drop_q).

module can_rn_tally (
  input  logic             clk_i,
  input  logic             rst_ni,
  input  can_rn_pkg::job_t job_i,        // present job
  input  logic [1:0]       phase_i,      // phase of the job
  // Frame
  input  logic             count_i,      // JobByte: this byte is the count of a TRIGGER
  input  logic             same_i,       // frame byte is one more than the last TRIGGER count
  input  logic             none_i,       // JobTrigger: frame has no count
  input  logic             refused_i,    // JobCount: request is refused
  input  logic [3:0]       code_i,       // JobCount: code of the refused request
  input  logic             dup_i,        // pulse: statement under the own number (RN-11)
  input  logic             dropped_i,    // pulse: a frame was dropped unsent (LIFE, RETRY)
  input  logic             off_entry_i,  // pulse: node enters bus-off
  input  logic             over_i,       // pulse: a hold lasted too long (RN-52)
  input  logic             timeout_i,    // pulse: time-out of a block transfer
  input  logic             clear_i,      // pulse: SETUP CLEAR
  // RAM
  input  logic [7:0]       byte_i,       // byte read
  output logic             want_o,       // JobTally is due
  output logic             own_o,        // JobByte: cell_o replaces the byte of the row
  output logic [8:0]       cell_o,       // byte to read or write; 0 if none
  output logic             more_o,       // byte read + 1 is written in the clock after
  output logic             wide_o,       // all bytes of the word are written (CLEAR)
  output logic             no_write_o    // counter is at 255: no write
);
  logic       tally, last, byte_job, counted, sequence_bad;
  logic       due_q, drop_q, over_q, clear_q, order_q, byte_q, event_now, ends;
  logic [2:0] what_q, what, k;

  assign tally    = job_i == can_rn_pkg::JobTally;
  assign byte_job = byte_q && phase_i != 2'd0;
  assign last     = phase_i[1];
  assign ends     = tally && last && !due_q;

  // Counters by code: 0 function, 1 value, 2 address, protection and lock, 3 busy, 6 sequence.
  assign counted      = job_i == can_rn_pkg::JobCount && phase_i == 2'd2 && refused_i;
  assign sequence_bad = job_i == can_rn_pkg::JobTrigger && phase_i == 2'd0 && !none_i && !order_q;
  assign event_now    = counted || sequence_bad || dup_i || off_entry_i || timeout_i
                        || clear_i;
  always_comb begin
    what = {code_i[3] && code_i[1], code_i[3] || (code_i[1] && !code_i[0]),
            !code_i[3] && code_i[1] && (code_i[0] || code_i[2])};
    if (dup_i)        what = 3'd4;
    if (off_entry_i)  what = 3'd5;
    if (sequence_bad || timeout_i) what = 3'd6;
    if (clear_i)      what = 3'd0;
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {due_q, drop_q, over_q, clear_q, order_q, byte_q} <= '0;
      what_q <= '0;
    end else begin
      if (event_now)                what_q <= what;
      else if (tally && last && clear_q) what_q <= 3'd4;   // the second word
      due_q   <= event_now || (due_q && !(tally && last && (!clear_q || what_q[2])));
      clear_q <= clear_i || (clear_q && due_q);
      drop_q  <= dropped_i || (drop_q && !ends);
      over_q  <= over_i || (over_q && (drop_q || !ends));
      if (byte_job) order_q <= same_i;
      byte_q  <= job_i == can_rn_pkg::JobByte && count_i;
    end
  end

  assign want_o     = due_q || drop_q || over_q;
  assign k          = due_q ? what_q : {!drop_q, 2'b11};
  assign own_o      = byte_job;
  assign more_o     = (tally && !clear_q) || byte_job;
  assign wide_o     = tally && clear_q;
  assign no_write_o = tally && (&byte_i);
  always_comb begin
    cell_o = {6'b1_1110_1, k};
    if (!last && clear_q) cell_o = 9'h006;               // a byte that is 0
    if (byte_job)         cell_o = 9'h1F7;               // the last count
    if (!(tally || byte_job)) cell_o = '0;
  end
endmodule
