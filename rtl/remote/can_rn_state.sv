// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_rn_state: state of the node: INIT, SAFE or OPERATE (RN-70), number, lock (RN-61), selection,
// flags of STATUS (RN-24), FLAGS of the configuration, and whether it is on the bus. It also keeps
// what the node owes: a STATUS or HERE frame (RN-30), and the reload of the watchdog (RN-71).

module can_rn_state #(
  parameter int NameBits = 3
) (
  input  logic                clk_i,
  input  logic                rst_ni,
  input  can_rn_pkg::job_t    job_i,         // present job
  input  logic [1:0]          phase_i,       // phase of the job
  // Request that is carried out
  input  logic                accept_i,      // pulse: work of an accepted request begins
  input  logic                dup_i,         // pulse: valid statement under the own number (RN-11)
  input  logic                refused_i,     // request is refused
  input  logic                all_i,         // request is never followed by STATUS
  input  logic                write_i,       // request writes the memory
  input  logic                select_i,      // request is SELECT
  input  logic                assign_i,      // request is ASSIGN
  input  logic                state_i,       // request is STATE
  input  logic                setup_i,       // request is SETUP
  input  logic                match_i,       // SELECT: serial number matches
  input  logic                new_i,         // SELECT NEW: only without a number
  input  logic [4:0]          op_i,          // operation of STATE, SETUP; number of ASSIGN
  // Time and bus
  input  logic                timer_i,       // timer of JobHigh: 0: watchdog
  input  logic                zero_i,        // byte read is 0
  input  logic [7:0]          byte_i,        // byte read
  input  logic                off_entry_i,   // pulse: node enters bus-off
  input  logic                off_exit_i,    // pulse: node leaves bus-off
  input  logic                gap_i,         // no frame on the bus
  input  logic                passive_i,     // node is error passive
  input  logic                stale_i,       // a map entry has exceeded its time-out (RN-66)
  input  logic                unsafe_i,      // such an entry leads to SAFE
  input  logic                told_i,        // pulse, on the bus: both have been updated
  output logic [1:0]          node_o,        // state, can_rn_pkg::Node*
  output logic                operate_o,     // node is in OPERATE
  output logic [NameBits-1:0] number_o,      // node number
  output logic                numbered_o,    // number_o is a number (2 or above)
  output logic                selected_o,    // node is selected
  output logic                unlocked_o,    // node is unlocked
  output logic                lock_reset_o,  // node is locked until reset
  output logic                run_o,         // node is on the bus
  output logic                restart_o,     // accepted request is RESTART
  output logic                flush_o,       // queue is emptied, block transfers end
  input  logic                gone_status_i, // pulse: STATUS has been sent or dropped
  input  logic                gone_here_i,   // pulse: HERE has been sent or dropped
  output logic                owe_status_o,  // a STATUS frame is to be sent
  output logic                owe_here_o,    // a HERE frame is to be sent
  output logic                owe_feed_o,    // watchdog is to be reloaded
  output logic                clear_o,       // pulse: SETUP CLEAR
  output logic [7:0]          status_o       // byte 0 of STATUS
);
  logic [1:0]          node_q;
  logic [NameBits-1:0] number_q;
  logic                unlocked_q, lock_reset_q, selected_q, run_q;
  logic                dup_q, watchdog_q, boff_seen_q, armed_q;
  logic                owe_status_q, owe_here_q, owe_feed_q;
  logic                errs_q, ackw_q, boot_q, auto_q, may_q;

  // A request takes effect in the third phase of JobCount, which counts_q marks.
  logic counts_q;
  logic act, to_operate, to_safe, expired, number_we, hit;
  assign hit        = match_i && !(new_i && numbered_o);
  assign act        = counts_q && !refused_i;
  assign to_operate = act && state_i && op_i[0] && !op_i[2];
  assign to_safe    = act && state_i && op_i[1];
  assign restart_o  = !refused_i && state_i && op_i[0] && op_i[2];
  assign expired    = job_i == can_rn_pkg::JobHigh && phase_i[1] && !timer_i && zero_i
                      && armed_q && operate_o && !owe_feed_q;

  assign node_o       = node_q;
  assign operate_o    = node_q == can_rn_pkg::NodeOperate;
  assign number_o     = number_q;
  assign numbered_o   = |number_q[NameBits-1:1];
  assign selected_o   = selected_q;
  assign unlocked_o   = unlocked_q;
  assign lock_reset_o = lock_reset_q;
  assign run_o        = run_q;
  assign flush_o      = !run_q || off_entry_i || (act && assign_i);
  assign owe_status_o = owe_status_q && numbered_o;
  assign owe_here_o   = owe_here_q;
  assign owe_feed_o   = owe_feed_q;
  assign status_o     = {boff_seen_q, watchdog_q, stale_i, dup_q, passive_i, unlocked_q, node_q};

  logic begins, leave;
  assign leave  = told_i && unsafe_i;
  assign begins = job_i == can_rn_pkg::JobConfig && (&phase_i);

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni)         node_q <= can_rn_pkg::NodeInit;
    else if (!run_q)     node_q <= begins ? {1'b1, byte_i[3]} : can_rn_pkg::NodeInit;
    // RN-70: on the bus, the codes of INIT and LISTEN are illegal and lead to SAFE.
    else if (off_entry_i || to_safe || expired || leave || !node_q[1])
                         node_q <= can_rn_pkg::NodeSafe;
    else if (to_operate || ((off_exit_i || told_i) && auto_q && may_q && !unsafe_i))
                         node_q <= can_rn_pkg::NodeOperate;
  end

  // RN-70: AUTO_OP acts unless the watchdog or STATE 02 ended OPERATE; STATE 01 allows it again.
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni)                   may_q <= 1'b0;
    else if (to_safe || expired)   may_q <= 1'b0;
    else if (!run_q || to_operate) may_q <= 1'b1;
  end

  assign number_we = (job_i == can_rn_pkg::JobConfig && phase_i == 2'd2) || (act && assign_i);
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni)        number_q <= '0;
    else if (number_we) number_q <= assign_i && run_q ? op_i[NameBits-1:0] : byte_i[NameBits-1:0];
  end
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni)     {auto_q, boot_q, ackw_q, errs_q} <= '0;
    else if (begins) {auto_q, boot_q, ackw_q, errs_q} <= byte_i[3:0];
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {unlocked_q, lock_reset_q, selected_q} <= '0;
    end else begin
      if (!run_q || operate_o)     unlocked_q <= 1'b0;
      else if (act && setup_i && op_i[2:1] != 2'd2 && !op_i[2]) unlocked_q <= !op_i[1];
      if (act && setup_i && (&op_i[1:0])) lock_reset_q <= 1'b1;
      if (!run_q || (accept_i && select_i)) selected_q <= hit && run_q;
    end
  end

  logic clear;
  assign clear   = act && setup_i && op_i[2];
  assign clear_o = clear;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {counts_q, dup_q, watchdog_q, boff_seen_q, armed_q, run_q} <= '0;
    end else begin
      counts_q    <= job_i == can_rn_pkg::JobCount && phase_i == 2'd1;
      dup_q       <= dup_i || (dup_q && !clear);
      watchdog_q  <= expired || (watchdog_q && !clear);
      boff_seen_q <= off_entry_i || (boff_seen_q && !clear);
      // WDT = 0 switches the watchdog off. Its two bytes pass in phases 2 and 3.
      if (job_i == can_rn_pkg::JobFeed && phase_i[1]) armed_q <= !zero_i || (armed_q && phase_i[0]);
      if (begins)                                              run_q <= 1'b1;
      else if (job_i == can_rn_pkg::JobStart && gap_i)     run_q <= 1'b0;
    end
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {owe_status_q, owe_here_q, owe_feed_q} <= '0;
    end else begin
      if (begins)                  owe_status_q <= byte_i[2];
      else if (off_exit_i)         owe_status_q <= boot_q;
      else if (counts_q && (refused_i ? errs_q && !all_i
                                      : (ackw_q && write_i && !all_i) || assign_i))
                                   owe_status_q <= 1'b1;
      else if (gone_status_i || off_entry_i) owe_status_q <= 1'b0;
      if (accept_i && select_i)    owe_here_q <= hit;
      else if (gone_here_i || flush_o) owe_here_q <= 1'b0;
      // RN-71: it also restarts where AUTO_OP may lead to OPERATE, the only state in which it runs.
      owe_feed_q <= accept_i || begins || off_exit_i || (told_i && !operate_o)
                    || (owe_feed_q && job_i != can_rn_pkg::JobFeed);
    end
  end

endmodule
