// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_mb_load: loads the winner of the arbitration (can_mb_tx), presents it to the engine, feeds
// the engine its words while it is sent, and writes its end back to the buffer. The frame is kept
// apart from the buffer, so that CPU writes do not change it (FF-12).
//
// Its data words are copied into one of two hidden rows ahead of time, while a frame may still be
// sent from the other. The last step takes C/S and ID at once, so that the presented frame is
// replaced in one clock (AR-13).
//
// Abort (MCR.AEN, flexcan.md 3.4): a frame has moved out when it is on the bus, or presented while
// no frame is on the bus, so that the engine may be taking it. can_mb_guard discards CPU writes to
// its C/S word and passes an abort request on (abort_i). A presented frame is taken back first. The
// request ends with the attempt at the latest, with code 1001 or that of a sent frame.

module can_mb_load #(
  parameter int NumMb = 64,
  /// Derived, do not override.
  localparam int IdxW = $clog2(NumMb)
) (
  input  logic            clk_i,
  input  logic            rst_ni,
  input  logic            running_i,     // 1: the engine takes part in the bus
  input  logic            mute_i,        // 1: the engine starts no frame (bus-off, listen-only)
  input  logic            gap_i,         // 1: no frame on the bus; an own one may begin any time
  input  logic            oneshot_i,     // XCTRL.ONESHOT: a failed frame is not retried
  input  logic            osmb_i,        // XCTRL.OSMB: bit 28 of C/S asks for one-shot
  input  logic            aen_i,         // MCR.AEN
  // Winner of the arbitration (can_mb_tx).
  input  logic            settled_i,     // 1: buffer best_idx_i is the winner and may be sent
  input  logic [IdxW-1:0] best_idx_i,
  input  logic            retry_busy_i,  // 1: a retry has not been compared with the winner yet
  output logic            retry_o,       // pulse: buffer cur_idx_o left the bus, may be active
  output logic            inactive_o,    // pulse: the winner was found not to be active (upset)
  // C/S writes by the CPU (can_mb_cpu), and writes that have not ended yet (can_mb_port).
  input  logic            cs_written_i,  // pulse: the CPU wrote a C/S word in the clock before
  input  logic [IdxW-1:0] cs_written_idx_i,
  input  logic            cs_written_act_i,  // 1: the code written may be active
  input  logic            cs_wr_i,       // 1 in both clocks of a write of C/S word cs_wr_idx_i
  input  logic [IdxW-1:0] cs_wr_idx_i,
  input  logic            cmd_i,         // 1: a command is taken; if of a C/S word, of cmd_mb_i
  input  logic [IdxW-1:0] cmd_mb_i,
  input  logic            abort_i,       // pulse: abort the frame that has moved out
  output logic            out_o,         // 1: buffer cur_idx_o has moved out
  output logic            done_o,        // 1: the end of its frame is being written back
  output logic            off_o,         // 1: buffer cur_idx_o takes no part in the arbitration
  // Engine, see can_core.
  output logic            tick_req_o,    // 1: a better frame waits for tick_i
  input  logic            tick_i,        // pulse: sample point, while tick_req_o = 1
  input  logic            start_i,       // pulse: a frame begins
  input  logic            transmitter_i, // 1: this node is the transmitter of the frame
  output logic            tx_req_o,      // 1: a frame is presented
  output logic            tx_ide_o,
  output logic            tx_rtr_o,
  output logic [3:0]      tx_dlc_o,
  output logic [31:0]     tx_word_o,     // ID word of the presented frame, then its data words
  input  logic            tx_next_i,     // pulse: the engine has taken tx_word_o
  input  logic            tx_ok_i,       // pulse: the frame has been sent (VA-02)
  input  logic            tx_fail_i,     // pulse: the attempt ended by error or lost arbitration
  // Frame presented or on the bus.
  output logic            started_o,     // pulse: buffer cur_idx_o goes on the bus
  output logic [IdxW-1:0] cur_idx_o,     // buffer of the frame presented or on the bus
  output logic            mine_o,        // 1: a frame is on the bus or ends, and its buffer has not
                                         // been rewritten meanwhile
  // Steps (can_mb_pkg), carried out by can_mb_step.
  output logic            req_o,         // 1: step step_o is wanted
  output logic [2:0]      step_o,
  output logic            row_o,         // hidden row that is being filled; !row_o: on the bus
  output logic [IdxW-1:0] ld_idx_o,      // buffer that is being loaded
  output logic            word_o,        // StepWord: 0 bytes 0-3, 1 bytes 4-7
  input  logic            flight_i,      // 1: a step is granted and not over
  input  logic            data_i,        // 1: data of step data_step_i is on the RAM outputs
  input  logic [2:0]      data_step_i,
  input  logic [31:0]     cs_i,
  input  logic [31:0]     msg_i,
  output logic            cancel_o,      // 1: StepEnd writes nothing
  output logic [3:0]      code_o,        // StepEnd: new code
  output logic            flag_o,        // pulse: set IFLAG of buffer cur_idx_o
  output logic            sent_o,        // pulse with flag_o: the frame was sent, not given up
  output logic            take_o,        // 1: StepHead is done, cur_idx_o changes in the next clock
  output logic            busy_o         // 1: an end or an abort is outstanding
);
  typedef enum logic [1:0] {StIdle, StLow, StHigh, StHead} state_e;
  // Encoded as written: all four codes are states, so an upset flip-flop leads to no undefined one.
  (* fsm_encoding = "none", syn_encoding = "safe" *) state_e state_q;

  // word_q, end_q: StepWord, StepEnd is wanted. failed_q: the end leaves code 1001. orphan_q: the
  // buffer was rewritten since its frame was presented. dropped_q: a frame was taken back, and none
  // has started since. abort_q: an abort is requested.
  logic       word_q, on_bus_q, end_q, failed_q, orphan_q, dropped_q, abort_q, one_shot_q, answer_q;
  logic       inactive_q, swap, swapped_q, wr_ld_q, wr_cur_q, at_cur_q;
  logic [1:0] tick_q;
  logic       pause_q, head_ok, head_bad, head_seen, head_taken, lost, cs_written_cur,
    cs_written_ld, withdrawn;
  logic       cs_written_best, takes_back;
  logic [3:0] code;

  assign code = cs_i[can_regs_pkg::MbCsCode +: can_regs_pkg::MbCsCodeW];

  assign cs_written_cur   = cs_written_i && at_cur_q;
  assign cs_written_ld    = cs_written_i && cs_written_idx_i == ld_idx_o;
  // settled_i falls only one clock after such a write.
  assign cs_written_best  = cs_written_i && cs_written_idx_i == best_idx_i;
  // The engine takes the first word with the start; either pulse suffices, should an upset swallow
  // the other. lost: the frame has ended without a pulse, and is retried.
  assign started_o = (start_i || tx_next_i) && transmitter_i && !on_bus_q;
  assign lost      = on_bus_q && gap_i && !tx_ok_i && !tx_fail_i;

  // A presented frame is replaced only in the two clocks after a sample point, when the engine
  // cannot be about to take it. No frame is presented (pause_q, a clock late) while one is sent,
  // ends, is aborted, waits for its retry or has just been taken back, nor while the engine starts
  // none.
  assign head_ok = !pause_q && (!tx_req_o || tick_q != '0);
  // Nor is a frame presented while the CPU rewrites its C/S word, or may be asking to abort the
  // frame that it would replace.
  assign head_bad = cs_written_ld || abort_q
                 || (cs_wr_i && (wr_ld_q || (aen_i && tx_req_o && wr_cur_q)));
  assign head_seen  = data_i && data_step_i == can_mb_pkg::StepHead && state_q == StHead
                   && !on_bus_q && !started_o && !head_bad;
  assign head_taken = head_seen && (code == can_regs_pkg::MbCsCodeTxData
                                    || code == can_regs_pkg::MbCsCodeTxAnswering);
  // inactive_o: only an upset makes an inactive buffer the winner. A buffer that was aborted while
  // it was loaded is not reported, because another one is the winner by then.
  assign mine_o     = (on_bus_q || end_q) && !orphan_q;
  assign inactive_o = inactive_q;
  assign req_o   = word_q || end_q || state_q == StLow || state_q == StHigh
                || (state_q == StHead && head_ok);
  assign step_o  = word_q ? can_mb_pkg::StepWord
                 : end_q ? can_mb_pkg::StepEnd
                 : state_q == StLow ? can_mb_pkg::StepLow
                 : state_q == StHigh ? can_mb_pkg::StepHigh : can_mb_pkg::StepHead;

  assign tick_req_o = tx_req_o && state_q == StHead;
  assign cancel_o = cs_written_cur || !end_q;   // rewritten now, or when the step was granted
  assign code_o   = failed_q ? can_regs_pkg::MbCsCodeTxAbort
                  : answer_q ? can_regs_pkg::MbCsCodeTxAnswer
                  : tx_rtr_o ? can_regs_pkg::MbCsCodeRxEmpty : can_regs_pkg::MbCsCodeTxInactive;
  assign busy_o   = end_q || flag_o || abort_q;
  assign sent_o   = flag_o && !failed_q;
  assign take_o   = head_taken;

  // An active code takes the frame back only once, so that a CPU that rewrites the buffer again and
  // again does not keep all off the bus; the frame that stays is replaced as soon as the new one is
  // loaded (StIdle). With MCR.AEN a C/S write that is not discarded always takes it back: no frame
  // may be sent that its buffer does not tell of.
  // can_mb_guard looks at out_o in the first clock of a write. A write that ended in the clock
  // before may be taking the frame back.
  assign takes_back = cs_written_cur && (!cs_written_act_i || !dropped_q || aen_i);
  assign out_o    = off_o || started_o || (tx_req_o && gap_i && !takes_back);
  assign done_o   = end_q || flag_o;
  assign off_o    = on_bus_q || abort_q || done_o;
  // withdrawn: the abort need not wait for the end of an attempt, because none is under way.
  assign withdrawn = abort_q && !tx_req_o && !on_bus_q && !started_o && !end_q;

  // swap: a better frame came while this one was being copied. Only once for each frame presented,
  // or a buffer that is rewritten again and again would keep all others off the bus. Not while a
  // frame is sent: StHead is early enough, and the frame that has just started may be the winner
  // for a clock.
  assign swap = settled_i && !on_bus_q && best_idx_i != ld_idx_o && !swapped_q;

  // Loading.
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      state_q  <= StIdle;
      ld_idx_o <= '0;
      row_o    <= 1'b0;
      {tx_ide_o, tx_rtr_o, tx_dlc_o} <= '0;
      tx_word_o <= '0;
      swapped_q <= 1'b0;
    end else begin
      if (data_i && data_step_i == can_mb_pkg::StepWord) tx_word_o <= msg_i;
      case (state_q)
        StIdle: if (settled_i && !flight_i && !cs_written_best
                    && !(((tx_req_o && !orphan_q) || off_o) && best_idx_i == cur_idx_o)) begin
          state_q  <= StLow;
          ld_idx_o <= best_idx_i;
        end
        StLow:  if (data_i && data_step_i == can_mb_pkg::StepLow) state_q <= StHigh;
        StHigh: if (data_i && data_step_i == can_mb_pkg::StepHigh) state_q <= StHead;
        StHead: begin
          if (data_i && data_step_i == can_mb_pkg::StepHead) begin
            if (head_seen) state_q <= StIdle;
            if (head_taken) begin
              row_o     <= !row_o;
              tx_ide_o  <= cs_i[can_regs_pkg::MbCsIde];
              tx_rtr_o  <= cs_i[can_regs_pkg::MbCsRtr];
              tx_dlc_o  <= cs_i[can_regs_pkg::MbCsDlc +: can_regs_pkg::MbCsDlcW];
              tx_word_o <= {3'b0, msg_i[28:18], cs_i[can_regs_pkg::MbCsIde] ? msg_i[17:0] : 18'b0};
            end
          end else if (!head_ok && settled_i && best_idx_i != ld_idx_o) begin
            state_q <= StIdle;          // a better one came while this one had to wait
          end
        end
        default: state_q <= StIdle;
      endcase
      if (head_taken) swapped_q <= 1'b0;
      if ((state_q == StLow || state_q == StHigh) && swap) begin
        state_q   <= StIdle;
        swapped_q <= 1'b1;
      end
      if (cs_written_ld || !running_i) state_q <= StIdle;
    end
  end

  // The frame presented or on the bus.
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {tx_req_o, on_bus_q, orphan_q, dropped_q, word_q, word_o} <= '0;
      {end_q, failed_q, flag_o, retry_o, inactive_q, abort_q, one_shot_q, answer_q} <= '0;
      {wr_ld_q, wr_cur_q, at_cur_q} <= '0;
      tick_q  <= '0;
      pause_q <= 1'b0;
      cur_idx_o <= '0;
    end else begin
      {flag_o, retry_o} <= '0;
      // Compared with the command already: when the data of StepHead is there, neither index has
      // changed for several clocks.
      if (cmd_i) {wr_ld_q, wr_cur_q} <= {cmd_mb_i == ld_idx_o, cmd_mb_i == cur_idx_o};
      // With head_taken cur_idx_o becomes ld_idx_o, whose C/S word is not being written (head_bad).
      at_cur_q <= cs_wr_idx_i == cur_idx_o && !head_taken;
      inactive_q   <= head_seen && !head_taken && best_idx_i == ld_idx_o;
      tick_q  <= {tick_q[0], tick_i};
      pause_q <= on_bus_q || end_q || retry_busy_i || abort_q || mute_i || (cs_written_cur
      && tx_req_o);

      if (head_taken) begin
        tx_req_o  <= 1'b1;
        orphan_q  <= 1'b0;
        word_o    <= 1'b0;
        cur_idx_o <= ld_idx_o;
        // Bit 28 may be set with any code in a C/S word that was stored whole (can_mb_cpu), but an
        // answer is never one-shot.
        {one_shot_q, answer_q} <= {osmb_i && cs_i[can_regs_pkg::MbCsOs] && !cs_i[25], cs_i[25]};
      end else if (cs_written_cur) begin
        // Rewritten: a frame on the bus is no longer the buffer's.
        orphan_q <= 1'b1;
        if (tx_req_o && takes_back) begin
          tx_req_o  <= 1'b0;
          dropped_q <= 1'b1;
        end
      end
      if (started_o) begin
        on_bus_q  <= 1'b1;
        tx_req_o  <= 1'b0;
        dropped_q <= 1'b0;
      end

      // Words for the engine: it takes the ID first, then bytes 0-3, then 4-7.
      if (data_i && data_step_i == can_mb_pkg::StepWord) {word_q, word_o} <= {1'b0, 1'b1};
      if (tx_next_i || started_o) word_q <= 1'b1;

      // The end of an attempt: StepEnd, or a retry.
      if (data_i && data_step_i == can_mb_pkg::StepEnd) begin
        {end_q, abort_q} <= '0;
        flag_o <= !cancel_o;
      end else if (end_q && cs_written_cur) begin
        end_q   <= 1'b0;
        retry_o <= 1'b1;
      end
      if ((tx_ok_i || tx_fail_i) && on_bus_q) begin
        on_bus_q <= 1'b0;
        word_q   <= 1'b0;
        failed_q <= tx_fail_i;
        if (orphan_q || cs_written_cur || (tx_fail_i && !oneshot_i && !one_shot_q && !abort_q
          && !abort_i))
          retry_o <= 1'b1;
        else end_q <= 1'b1;
      end
      if (lost) {on_bus_q, word_q, retry_o} <= 3'b001;
      if (abort_i && !done_o) {abort_q, tx_req_o} <= 2'b10;
      if (withdrawn) {end_q, failed_q} <= '1;
      if (mute_i)    tx_req_o <= 1'b0;
      if (!running_i) {tx_req_o, on_bus_q, word_q, dropped_q} <= '0;
    end
  end
endmodule
