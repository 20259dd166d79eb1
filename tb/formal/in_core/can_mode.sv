  // SPDX-FileCopyrightText: 2026 The VeriCAN authors
  // SPDX-License-Identifier: Apache-2.0
  //
  // What mode_waits.sv assumes of can_core.

  logic f_ran, f_may_run;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) {f_ran, f_may_run} <= '0;
    else         {f_ran, f_may_run} <= {1'b1, running_i || run_o};
  end

  always @(posedge clk_i) if (rst_ni) begin
    m_running: assert (!f_ran || !running_i || f_may_run);
  end
