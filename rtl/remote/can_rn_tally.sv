// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_rn_tally: the eight counters at FE8, which stop at 255 (RN-35). What happens is noted, and
// counted as soon as nothing else is under way. No two of them happen before that, but what may
// happen within a frame as well: the end of a hold and of an answer's life have notes of their own.

module can_rn_tally (
  input  logic             clk_i,
  input  logic             rst_ni,
  input  can_rn_pkg::job_t job_i,
  input  logic [1:0]       phase_i,
  // Frame
  input  logic             count_i,      // JobByte: this byte is the count of a TRIGGER ..
  input  logic             same_i,       // .. and one more than the last
  input  logic             none_i,       // JobTrigger: the frame has no count
  input  logic             refused_i,    // JobCount: the request is refused ..
  input  logic [3:0]       code_i,       // .. with this code
  input  logic             dup_i,        // pulses
  input  logic             dropped_i,
  input  logic             off_entry_i,
  input  logic             over_i,       // a hold
  input  logic             timeout_i,    // of a block transfer
  input  logic             clear_i,
  // RAM
  input  logic [7:0]       byte_i,       // read
  output logic             want_o,       // JobTally is due
  output logic             own_o,        // the byte that is meant is none of the row,
  output logic [8:0]       cell_o,       // but this
  output logic             more_o,       // one more is written in the clock after
  output logic             wide_o,       // all bytes of the word
  output logic             no_write_o
);
  logic       tally, last, byte_job, counted, sequence_bad;
  logic       due_q, drop_q, over_q, clear_q, order_q, byte_q, event_now, ends;
  logic [2:0] what_q, what, k;

  assign tally    = job_i == can_rn_pkg::JobTally;
  assign byte_job = byte_q && phase_i != 2'd0;
  assign last     = phase_i[1];
  assign ends     = tally && last && !due_q;

  // 0 function, 1 value, 2 address, protection and lock, 3 busy, 6 sequence.
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
