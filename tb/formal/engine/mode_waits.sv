  // SPDX-FileCopyrightText: 2026 The VeriCAN authors
  // SPDX-License-Identifier: Apache-2.0
  //
  // can_mode keeps the engine's contract (m_stay of bsp_inputs.sv), spliced into it.

  always @(posedge clk_i) begin
    // Reset in the first clock, none later.
    m_reset: assume (rst_ni == !$initstate);
    // can_core.active_q: it does not run before it is told to.
    m_running: assume ($initstate ? !running_i : (!running_i || $past(running_i || run_o)));
    if (rst_ni && !$initstate && $past(rst_ni)) begin
      // MO-13: who has told the engine to stop tells it to run again only after it has stopped.
      p_run_waits: assert (!run_o || $past(run_o || !running_i));
    end
  end
