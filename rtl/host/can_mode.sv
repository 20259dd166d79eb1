// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_mode: disable, stop, freeze, normal operation and soft reset, with their acknowledges
// (flexcan.md section 2). No acknowledge waits for the bus longer than the frame that is being
// sent.

module can_mode (
  input  logic clk_i,
  input  logic rst_ni,
  // Requests, bits of MCR; stop comes from the system.
  input  logic mdis_i,
  input  logic freeze_i,        // FRZ and HALT
  input  logic soft_rst_i,      // pulse
  input  logic stop_req_i,
  input  logic wake_i,          // an edge on the bus ends stop mode, see can_wake
  // Engine and buffers.
  input  logic running_i,
  input  logic stop_ok_i,       // no frame is hurt by stopping
  input  logic transmitter_i,
  input  logic busy_i,          // moves under way
  input  logic scrub_i,         // buffer RAM not cleared yet
  output logic run_o,
  output logic clear_o,         // soft reset: everything it resets, one clock, engine stopped
  // Acknowledges.
  output logic lpm_ack_o,
  output logic frz_ack_o,
  output logic soft_rst_o,      // under way
  output logic disabled_o,      // disable mode
  output logic stop_o           // stop mode
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
  // As written here, so that the unused codes lead back (default below).
  (* fsm_encoding = "none", syn_encoding = "safe" *) state_e state_q;

  // Woken by the bus: the request counts again only after it has gone away.
  logic woken_q, stop;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) woken_q <= 1'b0;
    else         woken_q <= stop_req_i && (woken_q || wake_i);
  end
  assign stop = stop_req_i && !woken_q;

  state_e target;
  assign target = mdis_i ? StDisable : stop ? StStop : freeze_i ? StFreeze : StRun;

  // Low power drops a frame that is only received: the driver gives us 250 us, less than a frame.
  logic may_stop, stopped;
  assign may_stop = stop_ok_i || ((mdis_i || stop) && !transmitter_i);

  // What the engine told in its last clock makes the buffers busy some clocks later (SettleClocks).
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
