// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_mode: disable, freeze, normal operation and soft reset, with their acknowledges (flexcan.md
// section 2). No acknowledge waits for the bus longer than the frame that is being sent.

module can_mode (
  input  logic clk_i,
  input  logic rst_ni,
  // Requests, bits of MCR.
  input  logic mdis_i,
  input  logic freeze_i,        // FRZ and HALT
  input  logic soft_rst_i,      // pulse
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
  output logic soft_rst_o       // under way
);
  typedef enum logic [2:0] {
    StDisable,     // low power, registers readable
    StFreeze,      // engine stopped, configuration writable
    StRun,         // on the bus, or integrating
    StStop,        // engine told to stop
    StReset        // the same, for a soft reset
  } state_e;
  state_e state_q;

  // Disable drops a frame that is only received: the driver gives us 250 us, less than a frame.
  logic may_stop, stopped;
  assign may_stop = stop_ok_i || (mdis_i && !transmitter_i);
  assign stopped  = !running_i && !busy_i;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      state_q <= StDisable;
    end else begin
      case (state_q)
        StDisable: if (!mdis_i && !scrub_i) state_q <= freeze_i ? StFreeze : StRun;
        StFreeze: begin
          if (soft_rst_i)              state_q <= StReset;
          else if (mdis_i && !busy_i)  state_q <= StDisable;
          else if (!freeze_i)          state_q <= StRun;
        end
        StRun: begin
          if (soft_rst_i)                              state_q <= StReset;
          else if ((mdis_i || freeze_i) && may_stop)   state_q <= StStop;
        end
        StStop: begin
          if (soft_rst_i)   state_q <= StReset;
          else if (stopped) state_q <= mdis_i ? StDisable : freeze_i ? StFreeze : StRun;
        end
        StReset: if (stopped) state_q <= StFreeze;
        default: state_q <= StReset;
      endcase
    end
  end

  assign run_o      = state_q == StRun;
  assign clear_o    = state_q == StReset && stopped;
  assign lpm_ack_o  = state_q == StDisable;
  assign frz_ack_o  = state_q == StFreeze;
  assign soft_rst_o = state_q == StReset;
endmodule
