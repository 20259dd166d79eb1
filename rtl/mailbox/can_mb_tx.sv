// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_mb_tx: transmit arbitration (flexcan.md 3.3). Keeps the winner among the active buffers,
// which can_mb_load presents to the engine.
//
// A buffer whose C/S word is written is compared with the winner at once (an insertion, one read).
// When the winner is rewritten, taken away or goes on the bus, a pass over all buffers finds the
// next. A pass keeps only the best buffer so far; if it loses that one, it restarts. After
// MaxSpoils such losses the best buffer so far may be sent until a pass completes, so that a CPU
// that keeps writing C/S words cannot hold up the other buffers.
//
// An upset flip-flop must not stop transmission indefinitely: a winner that turns out not to be
// active is dropped, and without a winner all buffers are looked at now and then (fresh_i). An
// active buffer is found there (found) only after an upset; a pass for the winner follows.
//
// ESR2 (can_mb_status) is found in passes of its own, which take slots that nobody else wants and
// restart with every change. The register of the winner's value then holds that of the worst buffer
// so far, so the next insertion first reads the winner again (reload).

module can_mb_tx #(
  parameter int NumMb = 64,
  /// 1: with ESR2 (can_mb_status).
  parameter int Status = 1,
  /// Derived, do not override.
  localparam int IdxW = $clog2(NumMb)
) (
  input  logic            clk_i,
  input  logic            rst_ni,
  input  logic            running_i,    // 0: all state is forgotten; a pass begins when it rises
  input  logic            lbuf_i,       // CTRL1.LBUF: the lowest index wins, not the lowest value
  input  logic            lprio_en_i,   // MCR.LPRIO_EN: PRIO comes before the identifier
  input  logic [6:0]      first_i,      // buffers first_i to maxmb_i take part
  input  logic [6:0]      maxmb_i,
  // C/S write by the CPU (can_mb_cpu).
  input  logic            cs_written_i, // pulse: the CPU wrote a C/S word in the clock before
  input  logic [IdxW-1:0] cs_written_idx_i,
  input  logic            cs_written_act_i,  // 1: the code written may be active
  // Answer to a remote frame (can_mb_move).
  input  logic            ans_i,        // pulse: a remote frame made buffer ans_idx_i active
  input  logic [IdxW-1:0] ans_idx_i,
  // Frame presented or on the bus (can_mb_load).
  input  logic            off_i,        // 1: buffer cur_idx_i is on the bus or ends: takes no part
  input  logic [IdxW-1:0] cur_idx_i,
  input  logic            start_i,      // pulse: buffer cur_idx_i goes on the bus
  input  logic            retry_i,      // pulse: buffer cur_idx_i left the bus, may be active
  input  logic            sent_i,       // pulse: buffer cur_idx_i was sent and has its new code
  input  logic            inactive_i,   // pulse: the winner was found not to be active (upset)
  // Launch time (can_time).
  input  logic            held_i,       // 1: buffer held_idx_i loses against all others (TM-41)
  input  logic [IdxW-1:0] held_idx_i,
  // Recovery from an upset flip-flop, once in 1024 bit times.
  input  logic            fresh_i,      // 1: look at all buffers if there is no winner
  // Read slots (can_mb_port, can_mb_step); data in the clock after the grant.
  output logic            ins_req_o,    // 1: insertion, buffer ins_idx_o is to be read
  output logic [IdxW-1:0] ins_idx_o,
  input  logic            ins_gnt_i,
  output logic            scan_req_o,   // 1: pass, buffer scan_idx_o is to be read
  output logic            scan_lazy_o,  // 1: not for the winner (ESR2): only unused slots
  output logic [IdxW-1:0] scan_idx_o,
  input  logic            scan_gnt_i,
  input  logic            stale_i,      // 1: the C/S word was written while it was read
  input  logic [31:0]     cs_i,
  input  logic [31:0]     id_i,
  // Winner.
  output logic            settled_o,    // 1: the winner is final and may be sent
  output logic [IdxW-1:0] best_idx_o,
  output logic            retry_o,      // 1: a retry has not been compared with the winner yet
  // Pass for ESR2, see can_mb_status.
  output logic            pass_o,       // 1: a pass is wanted or under way, no result yet
  output logic            pass_end_o,   // pulse: the pass is complete, nothing changed during it
  output logic            seen_o,       // pulse: the pass has looked at buffer seen_idx_o
  output logic [IdxW-1:0] seen_idx_o,
  output logic            seen_worst_o, // 1: of those seen so far that buffer would be sent last
  output logic            seen_free_o   // 1: code of buffer seen_idx_o is INACTIVE
);
  localparam logic [1:0] MaxSpoils = 2'd3;

  // Passes wanted: scan_q for the winner, look_q for ESR2, quiet_q against upsets. open_q: buffers
  // that have stood for long may beat the winner, which the pass has to find out. again_q: one more
  // for the winner. own_q: best_val_q is the winner's. any_q: the ESR2 pass has seen an active
  // buffer. kept_q: the buffer on the bus beats all that nobody has looked at since, so its retry
  // needs no pass: after an error in its first bits there is no time for one (IF-03).
  logic            ins_q, ins_new, new_first, others_q, retry_q, retry_gnt, ans_q, ans_gnt;
  logic            freed_q, ins_want, open_q, kept_q;
  logic [2:0]      retry_on_q;
  logic            reload, lost, found, scan_q, look_q, quiet_q, own_q, again_q, spoilt, last;
  logic            change, redo, restart_q;
  logic [1:0]      spoils_q;
  // Stage 1: the buffer is on the RAM outputs. Stage 2: its arbitration value is compared. Stage 3:
  // the result is used. Reads are at least two clocks apart, so the registers of stage 2 hold their
  // buffer in stage 3 too.
  logic            s1_q, s1_look_q, s1_last_q, s2_q, s2_last_q, s3_q, s3_last_q, s3_end;
  logic            s1_reload_q, best_q, any_q, s1_part;
  logic            look2_q, reload2_q, active2_q, free2_q, less_q;
  logic [IdxW-1:0] s1_idx_q, idx2_q, ans_idx_q, held_idx_q;
  logic [34:0]     val2_q, best_val_q;

  // Insertions: a C/S write comes first, but in turn with the others, of which a retry comes before
  // an answer, and that before a released buffer (freed_q). If the winner's value is not in
  // best_val_q, the winner is read before all of them. A C/S write that waits while another one is
  // done is lost, so a pass follows (lost).
  assign ins_new    = ins_q || (cs_written_i && cs_written_act_i);
  assign new_first  = ins_new && !(others_q && (retry_q || ans_q || freed_q));
  assign ins_want   = running_i && (ins_new || retry_q || ans_q || freed_q);
  assign ins_req_o  = ins_want && !s1_q;
  assign reload     = best_q && !own_q;
  assign ins_idx_o  = reload ? best_idx_o : new_first ? cs_written_idx_i
                    : retry_q ? cur_idx_i : ans_q ? ans_idx_q : held_idx_q;
  assign retry_gnt  = ins_gnt_i && !reload && !new_first;
  assign ans_gnt    = retry_gnt && !retry_q;
  assign lost       = ins_q && cs_written_i;
  assign retry_o    = retry_q || retry_i || retry_on_q != '0;
  assign scan_req_o = running_i && (scan_q || look_q || quiet_q)
                   && !s1_q && !s2_last_q && !s3_last_q;
  assign scan_lazy_o = !scan_q;
  assign spoilt     = spoils_q == MaxSpoils;
  assign settled_o  = best_q && (!scan_q || !open_q || spoilt);
  assign last       = scan_idx_o == IdxW'(NumMb - 1) || 7'(scan_idx_o) == maxmb_i;
  assign s1_part    = 7'(s1_idx_q) >= first_i && 7'(s1_idx_q) <= maxmb_i
                   && !stale_i && !(cs_written_i && cs_written_idx_i == s1_idx_q);

  // Arbitration value: PRIO, then the bits in the order of the bus (flexcan.md 3.3).
  logic [3:0] code;
  logic       written2;  // the buffer in stage 2 or 3 has been written since
  assign code     = cs_i[can_regs_pkg::MbCsCode +: can_regs_pkg::MbCsCodeW];
  assign written2 = cs_written_i && cs_written_idx_i == idx2_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {look2_q, reload2_q, active2_q, free2_q} <= '0;
      idx2_q <= '0;
      val2_q <= '0;
    end else if (s1_q) begin
      look2_q   <= s1_look_q;
      reload2_q <= s1_reload_q;
      active2_q <= s1_part && (code == can_regs_pkg::MbCsCodeTxData
                               || code == can_regs_pkg::MbCsCodeTxAnswering);
      free2_q   <= s1_part && (code == can_regs_pkg::MbCsCodeRxInactive
                               || code == can_regs_pkg::MbCsCodeTxInactive);
      idx2_q    <= s1_idx_q;
      val2_q[34:32] <= id_i[can_regs_pkg::MbIdPrio +: can_regs_pkg::MbIdPrioW] & {3{lprio_en_i}};
      val2_q[31:0]  <= cs_i[can_regs_pkg::MbCsIde]
                       ? {id_i[28:18], 2'b11, id_i[17:0], cs_i[can_regs_pkg::MbCsRtr]}
                       : {id_i[28:18], cs_i[can_regs_pkg::MbCsRtr], 20'b0};
    end else if (written2) begin
      active2_q <= 1'b0;
    end
  end

  // A buffer that was written since it was read is no candidate: if it is active, an insertion
  // follows. Nor is the buffer on the bus; one that starts in this clock is withdrawn in the next.
  logic candidate, withdrawn;
  assign candidate = s3_q && active2_q && !written2
                  && !(off_i && idx2_q == cur_idx_i);
  // Launch time (TM-40): a buffer that is released is inserted as if it were written (freed). If
  // TTXMB names another one before that is done (renamed), a pass finds it. A winner that is held
  // from now on is withdrawn, because the runner-up is not known (set_aside).
  logic held_q, held2, best_held, freed, renamed, set_aside;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) {held_q, held_idx_q} <= '0;
    else         {held_q, held_idx_q} <= {held_i, held_idx_i};
  end
  assign held2   = held_i && idx2_q == held_idx_i;
  assign best_held = held_i && best_idx_o == held_idx_i;
  assign renamed   = held_idx_q != held_idx_i;
  assign freed     = held_q && (!held_i || renamed);
  assign set_aside = held_i && (!held_q || renamed) && best_idx_o == held_idx_i;
  // The winner was rewritten, has started, is not active or is held now, or a released buffer
  // cannot be inserted.
  assign withdrawn   = best_q && ((cs_written_i && cs_written_idx_i == best_idx_o)
                          || ((start_i || off_i) && cur_idx_i == best_idx_o) || inactive_i
                          || set_aside || ((freed || freed_q) && renamed));
  // The comparison is long, so it has a clock of its own and two halves side by side.
  logic high_less, high_equal, low_less;
  assign high_less  = val2_q[34:17] < best_val_q[34:17];
  assign high_equal = val2_q[34:17] == best_val_q[34:17];
  // Of two buffers with equal values the one with the higher index is the worse.
  assign low_less   = {val2_q[16:0], idx2_q}
                    < {best_val_q[16:0], {IdxW{!look2_q}} & best_idx_o};
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) less_q <= 1'b0;
    else         less_q <= high_less || (high_equal && low_less);
  end
  // by_value: the values decide; otherwise better tells whether this buffer beats the winner.
  logic by_value, better;
  always_comb begin
    {by_value, better} = {!lbuf_i, lbuf_i && idx2_q < best_idx_o};
    if (!look2_q && held2 != best_held) {by_value, better} = {1'b0, best_held};
  end

  // best_val_q has the value of the winner or, in a pass for ESR2, that of the worst buffer so far.
  // A candidate that does not beat a winner that is lost in the same clock is left to the pass that
  // follows.
  logic force_it, take, take_anyway, take_less, take_worst, worst_anyway, worst_more, load;
  assign force_it     = look2_q ? !any_q || lbuf_i || idx2_q == '0
                                  : !best_q || reload2_q;
  assign take_anyway  = candidate && !look2_q && (force_it || better);
  assign take_less    = candidate && !look2_q && by_value;
  assign worst_anyway = candidate && seen_o && force_it;
  assign worst_more   = candidate && seen_o;
  assign take         = take_anyway || (take_less && less_q);
  assign take_worst   = worst_anyway || (worst_more && !less_q);
  assign load         = take_anyway || worst_anyway || (less_q ? take_less : worst_more);

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {best_q, own_q} <= '0;
      best_idx_o <= '0;
      best_val_q <= '0;
    end else begin
      best_q <= running_i && (take || (best_q && !withdrawn));
      if (take) best_idx_o <= idx2_q;
      if (load) best_val_q <= val2_q;
      own_q <= take || (ins_gnt_i && reload) || (own_q && !take_worst);
    end
  end

  // A buffer of an ESR2 pass that an insertion overtakes does not count: the pass restarts.
  assign seen_o       = s3_q && look2_q && !scan_q && !quiet_q && !ins_want;
  assign seen_idx_o   = idx2_q;
  assign seen_worst_o = take_worst;
  assign seen_free_o  = free2_q;
  assign pass_o       = running_i && look_q;
  assign s3_end       = s3_last_q && !restart_q;
  assign pass_end_o   = s3_end && look_q && !scan_q && !change && !ins_want;

  // A pass for ESR2 restarts with every change, among them a frame that failed, whose buffer counts
  // again, and, while it is under way, a frame that was sent. A pass for the winner restarts only
  // when a winner or an insertion is lost, and MaxSpoils times at most.
  assign redo    = withdrawn || lost;
  // A buffer whose frame has just failed is not found here: its retry is an insertion.
  assign found   = candidate && look2_q && !best_q && !scan_q && !retry_i && !ins_want;
  assign change  = Status != 0 && (cs_written_i || ans_i || redo || retry_i || (sent_i && look_q));

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {look_q, quiet_q, any_q, restart_q} <= {Status != 0, 3'b000};
    end else if (!running_i) begin
      {look_q, quiet_q, any_q, restart_q} <= {Status != 0, 3'b000};
    end else begin
      restart_q <= scan_q ? redo && !spoilt : change || redo || ins_want || found;
      look_q    <= change || (look_q && !pass_end_o);
      quiet_q   <= !change && !found && !s3_end && !scan_q && !look_q
                && (quiet_q || (fresh_i && !best_q));
      if (seen_o) any_q <= take_worst || (any_q && idx2_q != '0);
    end
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) {ans_q, ans_idx_q, freed_q} <= '0;
    else begin
      ans_q <= running_i && (ans_i || (ans_q && !ans_gnt));
      if (ans_i) ans_idx_q <= ans_idx_i;
      // Written so that synthesis sees that it stays 0 without the time unit.
      if (freed && !renamed && running_i)                    freed_q <= 1'b1;
      else if (!running_i || renamed || (ans_gnt && !ans_q)) freed_q <= 1'b0;
    end
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {ins_q, others_q, retry_q, retry_on_q, again_q, spoils_q, kept_q} <= '0;
      {s1_q, s1_look_q, s1_reload_q, s1_last_q, s2_q, s2_last_q, s3_q, s3_last_q} <= '0;
      {scan_q, open_q} <= '1;
      {scan_idx_o, s1_idx_q} <= '0;
    end else if (!running_i) begin
      {ins_q, others_q, retry_q, retry_on_q, again_q, spoils_q, kept_q} <= '0;
      {s1_q, s1_look_q, s1_reload_q, s1_last_q, s2_q, s2_last_q, s3_q, s3_last_q} <= '0;
      {scan_q, open_q} <= '1;
      scan_idx_o <= '0;
    end else begin
      ins_q     <= ins_new && !(ins_gnt_i && !reload && new_first);
      if (ins_gnt_i && !reload) others_q <= new_first;
      retry_q   <= retry_i || (retry_q && !retry_gnt);
      retry_on_q <= {retry_on_q[1:0], retry_q && retry_gnt};
      s1_q      <= ins_gnt_i || scan_gnt_i;
      s1_look_q <= scan_gnt_i && !scan_q;
      s1_reload_q <= ins_gnt_i && reload;
      s1_last_q <= scan_gnt_i && last;
      s1_idx_q  <= ins_gnt_i ? ins_idx_o : scan_idx_o;
      // An insertion overtakes a pass for ESR2: the buffer of the pass is dropped.
      s2_q      <= s1_q && !(s1_look_q && ins_want);
      s3_q      <= s2_q && !(look2_q && ins_want);
      {s2_last_q, s3_last_q} <= {s1_last_q, s2_last_q};
      if (scan_gnt_i) scan_idx_o <= scan_idx_o + 1'b1;
      if (s3_end) begin                 // every buffer has been looked at
        scan_q     <= again_q || redo || found;
        again_q    <= 1'b0;
        if (!again_q && !redo) {spoils_q, open_q} <= '0;
        scan_idx_o <= '0;
      end else if (redo || found) begin
        scan_q  <= 1'b1;
        again_q <= spoilt;
      end
      if (redo && scan_q && !spoilt) spoils_q <= spoils_q + 1'b1;
      // If an insertion is lost, a winner that has been compared with all others stays what it is.
      if (withdrawn || ((lost || found) && !best_q))           open_q <= 1'b1;
      else if (retry_on_q[2] && candidate && kept_q && !held2) open_q <= 1'b0;
      if (start_i)                    kept_q <= best_q && best_idx_o == cur_idx_i && !scan_q;
      else if (redo || retry_on_q[2]) kept_q <= 1'b0;
      if (restart_q) begin
        scan_idx_o <= '0;
        {s1_last_q, s2_last_q, s3_last_q} <= '0;
      end
    end
  end
endmodule
