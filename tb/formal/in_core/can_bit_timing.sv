  // SPDX-FileCopyrightText: 2026 The VeriCAN authors
  // SPDX-License-Identifier: Apache-2.0
  //
  // What timing_rules.sv assumes of can_bsp and can_regs.

  logic        f_run, f_tx, f_boundary;
  logic [11:0] f_config;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {f_run, f_tx, f_boundary} <= '0;
      f_config <= '0;
    end else begin
      {f_run, f_tx, f_boundary} <= {run_i, tx_i, boundary_o};
      f_config <= {propseg_i, pseg1_i, pseg2_i, rjw_i, smp_i};
    end
  end

  always @(posedge clk_i) if (rst_ni) begin
    m_config: assert (!run_i || !f_run
                      || {propseg_i, pseg1_i, pseg2_i, rjw_i, smp_i} == f_config);
    m_tx: assert (!f_run || tx_i == f_tx || f_boundary);
  end
