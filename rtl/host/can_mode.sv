// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_mode: state machine of the modes disable, stop, freeze and normal operation and of soft
// reset, with their acknowledges (flexcan.md section 2). It starts and stops the engine. No
// acknowledge waits for the bus longer than until the frame on it has ended.

module can_mode (
  input  logic clk_i,
  input  logic rst_ni,
  // Requests, from MCR (can_regs) and the system.
  input  logic mdis_i,          // 1: MCR.MDIS, disable mode requested
  input  logic freeze_i,        // 1: MCR.FRZ and HALT, freeze mode requested
  input  logic soft_rst_i,      // pulse: soft reset requested
  input  logic stop_req_i,      // 1: the system requests stop mode
  input  logic wake_i,          // pulse: an edge on the bus ends stop mode (can_wake)
  // Engine (can_core) and buffers (can_mailbox).
  input  logic running_i,       // 1: the engine takes part in the bus
  input  logic stop_ok_i,       // 1: stopping the engine hurts no frame
  input  logic transmitter_i,   // 1: this node is the transmitter of the frame on the bus
  input  logic busy_i,          // 1: moves, ends or aborts are outstanding (can_mailbox)
  input  logic scrub_i,         // 1: the buffer RAMs are being cleared
  output logic run_o,           // 1: the engine is to take part in the bus
  output logic clear_o,         // pulse: soft reset of everything it resets; the engine has stopped
  // Acknowledges and modes.
  output logic lpm_ack_o,       // 1: MCR.LPM_ACK, disable or stop mode
  output logic frz_ack_o,       // 1: MCR.FRZ_ACK, freeze mode
  output logic soft_rst_o,      // 1: MCR.SOFT_RST, a soft reset is under way
  output logic disabled_o,      // 1: disable mode
  output logic stop_o           // 1: stop mode
);
  localparam logic [1:0] SettleClocks = 2'd3;
  typedef enum logic [2:0] {
    StDisable,     // low power, registers readable
    StFreeze,      // engine stopped, configuration writable
    StRun,         // on the bus, or integrating
    StHalt,        // engine told to stop
    StReset,       // the same, for a soft reset
    StClear,       // soft reset, one clock
    StStop         // low power because the system wants it; the bus may end it
  } state_e;
  // Encoded as written, so that the unused code, reached by an upset, leads back (default below).
  (* fsm_encoding = "none", syn_encoding = "safe" *) state_e state_q;

  // After a wake-up by the bus the request for stop mode counts again only once it has been 0.
  logic woken_q, stop;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) woken_q <= 1'b0;
    else         woken_q <= stop_req_i && (woken_q || wake_i);
  end
  assign stop = stop_req_i && !woken_q;

  state_e target;
  assign target = mdis_i ? StDisable : stop ? StStop : freeze_i ? StFreeze : StRun;

  // Disable and stop mode drop a frame that is only being received: drivers wait 250 us for
  // LPM_ACK, less than a frame may take.
  logic may_stop, stopped;
  assign may_stop = stop_ok_i || ((mdis_i || stop) && !transmitter_i);

  // A pulse of the engine in its last clock makes the buffers busy only some clocks later. So
  // stopped waits until they have been idle for SettleClocks.
  logic [1:0] settle_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni)                  settle_q <= '0;
    else if (running_i || busy_i) settle_q <= '0;
    else if (!stopped)            settle_q <= settle_q + 1'b1;
  end
  assign stopped = !running_i && !busy_i && settle_q == SettleClocks;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      state_q <= StDisable;
    end else begin
      case (state_q)
        StDisable, StStop: if (!scrub_i) state_q <= target;
        StFreeze: begin
          if (soft_rst_i)                            state_q <= StReset;
          else if (target == StRun || !busy_i)       state_q <= target;
        end
        StRun: begin
          if (soft_rst_i)                            state_q <= StReset;
          else if (target != StRun && may_stop)      state_q <= StHalt;
        end
        StHalt: begin
          if (soft_rst_i)                            state_q <= StReset;
          else if (stopped)                          state_q <= target;
        end
        StReset: if (stopped) state_q <= StClear;
        StClear: state_q <= StFreeze;
        default: state_q <= StReset;
      endcase
    end
  end

  assign run_o      = state_q == StRun;
  assign clear_o    = state_q == StClear;
  assign lpm_ack_o  = disabled_o || stop_o;
  assign frz_ack_o  = state_q == StFreeze;
  assign soft_rst_o = state_q == StReset || state_q == StClear;
  assign disabled_o = state_q == StDisable;
  assign stop_o     = state_q == StStop;
endmodule
