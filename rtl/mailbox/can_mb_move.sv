// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_mb_move: moves valid frames from the hidden rows (can_mb_smb) into the buffers that
// can_mb_match has found (flexcan.md 3.5, 3.6); can_mb_step does the copies.
//
// There are two hidden rows: one takes the frame on the bus while the other may hold a frame whose
// buffer is locked. Each waiting frame is bound to its buffer; a later frame for the same buffer
// replaces it. A frame for the Rx FIFO is moved in the same way but never waits for a lock. A
// remote frame that is answered is not moved: only the code of its buffer changes (flexcan.md 3.7).

module can_mb_move #(
  parameter int NumMb = 64,
  /// Derived, do not override.
  localparam int IdxW = $clog2(NumMb)
) (
  input  logic            clk_i,
  input  logic            rst_ni,
  input  logic            clear_i,       // pulse: soft reset, or change of FEN or of the filter
                                         // table; drops all frames
  // Frame on the bus, see can_core.
  input  logic            start_i,       // pulse: a frame begins
  input  logic            rx_hdr_i,      // pulse: the header of a frame is complete
  input  logic            valid_i,       // pulse: the frame in row smb_o is valid and wanted
  input  logic            hold_i,        // 1: flags, stamp or mark not written yet, or low power
  output logic            smb_o,         // hidden row for the frame on the bus
  // Match of the last frame (can_mb_match).
  input  logic            match_done_i,  // 1: the result of the match is final
  input  logic            hit_i,         // 1: the frame belongs to buffer or row hit_idx_i
  input  logic [IdxW-1:0] hit_idx_i,
  input  logic            hit_fifo_i,    // 1: the frame belongs into the Rx FIFO, row hit_idx_i
  input  logic            hit_ans_i,     // 1: not stored: buffer hit_idx_i answers the frame
  input  logic [8:0]      idhit_i,
  output logic            resolve_o,     // pulse: the match is taken over
  output logic            waits_o,       // 1: a frame received earlier waits for buffer waits_idx_o
  output logic [IdxW-1:0] waits_idx_o,
  // Lock (can_mb_lock), and C/S writes by the CPU (can_mb_cpu).
  input  logic            lock_i,        // 1: buffer lock_idx_i is locked
  input  logic [IdxW-1:0] lock_idx_i,
  input  logic            cs_written_i,  // pulse: the CPU wrote a C/S word in the clock before
  input  logic [IdxW-1:0] cs_written_idx_i,
  input  logic [IdxW-1:0] cpu_idx_i,     // buffer of the CPU access; next clock: cs_written_idx_i
  // Steps of a move, a copy each (can_mb_step): 0 ID, with a read of the old C/S word; 1 bytes 0-3;
  // 2 bytes 4-7; 3 C/S. An answer has step 3 only.
  output logic            req_o,         // 1: step step_o is wanted
  output logic [1:0]      step_o,
  output logic            row_o,         // hidden row that is moved
  output logic [IdxW-1:0] idx_o,         // buffer or row of the Rx FIFO that it is moved to
  input  logic            data_i,        // 1: the step's data is on the RAM outputs
  input  logic [31:0]     cs_i,          // C/S word on the RAM outputs
  output logic [8:0]      top_o,         // bits 31:23 of the new C/S word: code, or filter element
  output logic            cancel_o,      // 1: the step writes nothing
  output logic            moving_o,      // 1: a move to buffer idx_o is under way
  output logic            busy_mb_o,     // 1: buffer idx_o shows BUSY
  output logic            answer_o,      // 1: the move is an answer: only the code changes
  output logic            flag_o,        // pulse: set IFLAG of idx_o
  output logic            stored_o,      // pulse: a frame has been moved into the Rx FIFO
  output logic [1:0]      fifo_in_flight_o,  // per hidden row: frame on its way into the FIFO
  output logic            ans_o,         // pulse: buffer idx_o has code 1110 (answer) now
  output logic            busy_o         // 1: a match or a move is outstanding
);
  // unres_q: the match of the frame in row unres_row_q is outstanding. mv_q: a move is under way;
  // arm_q, end_q: its first and its last clock; ovr_q: the frame that it replaces was not read.
  logic            unres_q, unres_row_q, bound_q, mv_q, arm_q, end_q, ovr_q, fifo, ans;
  // Per hidden row: it holds a frame (full_q), which goes into the FIFO (fifo_q), is answered
  // (ans_q).
  logic [1:0]      full_q, fifo_q, ans_q;
  logic [IdxW-1:0] tgt0_q, tgt1_q;

  // A frame may move when its buffer is known (not unres_q) and not locked. The buffer shows BUSY
  // from the clock after the decision on. In that clock (arm_q) the lock is checked once more,
  // because the CPU may have locked the buffer in the clock of the decision.
  logic [1:0] ready, kill;
  assign ready[0] = full_q[0] && !(unres_q && !unres_row_q) && !(lock_i && lock_idx_i == tgt0_q);
  assign ready[1] = full_q[1] && !(unres_q && unres_row_q) && !(lock_i && lock_idx_i == tgt1_q);

  assign fifo_in_flight_o = full_q & fifo_q & ~{unres_q && unres_row_q, unres_q && !unres_row_q};

  // Rows that still hold a frame where a move ends in this clock; crowded: the frame that begins
  // finds no empty row.
  logic [1:0] stays;
  logic       crowded;
  assign stays   = full_q & ~({row_o, !row_o} & {2{end_q}});
  assign crowded = start_i && (&stays);

  // A frame that has just been bound to its buffer replaces one that waits for the same buffer.
  logic replaces;
  assign replaces = bound_q && tgt0_q == tgt1_q && !(mv_q && row_o != unres_row_q);

  // The match is that of the frame in row smb_o, so an earlier frame can only be in the other row.
  // If smb_o has changed since the match began, the new row smb_o was empty: no earlier frame
  // waits.
  assign waits_o     = (smb_o ? full_q[0] && !fifo_q[0] && !ans_q[0] && !(unres_q && !unres_row_q)
                              : full_q[1] && !fifo_q[1] && !ans_q[1] && !(unres_q && unres_row_q));
  assign waits_idx_o = smb_o ? tgt0_q : tgt1_q;

  // A C/S write, whatever it writes, cancels a frame that waits for this buffer or is moved there
  // (flexcan.md 3.4): the buffer's identifier or kind may have changed.
  assign kill[0] = cs_written_i && cs_written_idx_i == tgt0_q && !(unres_q && !unres_row_q);
  assign kill[1] = cs_written_i && cs_written_idx_i == tgt1_q && !(unres_q && unres_row_q);

  // A C/S write to the buffer that is being moved to. hit_q compares its index a clock ahead, so
  // that cancel_o, which gates the write of a step, is early.
  logic cancel, hit_q;
  assign cancel   = cs_written_i && cs_written_idx_i == idx_o;
  assign cancel_o = cs_written_i && hit_q;
  assign top_o    = fifo ? idhit_i : {4'b0, ans, ovr_q || ans, 2'b10, 1'b0};
  assign fifo     = fifo_q[row_o];
  assign ans      = ans_q[row_o];
  assign req_o    = mv_q && !end_q;
  assign moving_o = mv_q;
  assign busy_mb_o = mv_q && !ans;
  assign answer_o = ans;
  assign resolve_o = unres_q && match_done_i && !valid_i && !crowded && !clear_i;
  assign busy_o   = unres_q || mv_q || ready != '0;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {smb_o, unres_q, unres_row_q, bound_q, mv_q, arm_q, end_q, ovr_q, row_o} <= '0;
      {flag_o, stored_o, ans_o, hit_q} <= '0;
      step_o <= '0;
      full_q <= '0;
      fifo_q <= '0;
      ans_q  <= '0;
      {tgt0_q, tgt1_q, idx_o} <= '0;
    end else begin
      {flag_o, stored_o, ans_o} <= '0;
      hit_q <= cpu_idx_i == idx_o;
      // Moves. None begins in a clock in which its frame may be cancelled, replaced or dropped.
      if (!mv_q && ready != '0 && !hold_i && !start_i && !replaces && kill == '0) begin
        {mv_q, arm_q} <= '1;
        row_o  <= !ready[0];
        idx_o  <= ready[0] ? tgt0_q : tgt1_q;
        step_o <= {2{ready[0] ? ans_q[0] : ans_q[1]}};
      end else if (end_q) begin      // the C/S word is there: CPU reads of it are good from here on
        {mv_q, end_q} <= '0;
        full_q[row_o] <= 1'b0;
      end else if (mv_q && (cancel || (arm_q && lock_i && lock_idx_i == idx_o))) begin
        {mv_q, arm_q} <= '0;
      end else if (arm_q) begin
        arm_q <= 1'b0;
      end else if (data_i) begin
        step_o <= step_o + 1'b1;
        // The old code is FULL or OVERRUN, not serviced: the new one is OVERRUN.
        if (step_o == 2'd0) ovr_q <= cs_i[25] && !cs_i[can_mb_pkg::CsServiced];
        if (step_o == 2'd3) begin
          end_q <= 1'b1;
          {flag_o, stored_o, ans_o} <= {!fifo && !ans, fifo, ans};
        end
      end
      if (kill[0] && !(end_q && !row_o)) full_q[0] <= 1'b0;
      if (kill[1] && !(end_q && row_o))  full_q[1] <= 1'b0;

      bound_q <= resolve_o && hit_i;
      if (replaces) full_q[!unres_row_q] <= 1'b0;

      // New frames, and the results of their matches.
      if (valid_i) begin
        full_q[smb_o] <= 1'b1;
        unres_q       <= 1'b1;
        unres_row_q   <= smb_o;
      end else if (unres_q && match_done_i && !crowded) begin
        unres_q <= 1'b0;
        if (!hit_i) full_q[unres_row_q] <= 1'b0;
        fifo_q[unres_row_q] <= hit_fifo_i;
        ans_q[unres_row_q]  <= hit_ans_i;
        if (unres_row_q) tgt1_q <= hit_idx_i;
        else             tgt0_q <= hit_idx_i;
      end else if (unres_q && rx_hdr_i) begin
        unres_q <= 1'b0;              // no buffer found in the time of a whole frame
        full_q[unres_row_q] <= 1'b0;
      end
      // The frame that begins needs an empty row. If both are full, the one that came last is lost
      // unless it is being moved or replaces the one that waits; then that one is lost.
      if (start_i && stays[smb_o]) begin
        if (crowded && !replaces && !(mv_q && row_o == smb_o)) begin
          unres_q       <= 1'b0;
          full_q[smb_o] <= 1'b0;
        end else begin
          full_q[!smb_o] <= 1'b0;
          smb_o          <= !smb_o;
        end
      end
      if (clear_i) begin
        full_q <= '0;
        {unres_q, mv_q, arm_q, end_q, flag_o, stored_o, ans_o} <= '0;
      end
    end
  end
endmodule
