  // SPDX-FileCopyrightText: 2026 The VeriCAN authors
  // SPDX-License-Identifier: Apache-2.0
  //
  // Properties of can_time_sync, spliced into it: the CPU goes first and EN = 0 touches nothing,
  // for any frames, registers and commands in every clock. Its arithmetic is compared with a model
  // instead (CanTimeSync.AgainstModel).

  logic f_ran = 1'b0;
  logic [can_pkg::TimeCmdWidth-1:0] f_own;     // what the follower adds to the CPU's commands
  assign f_own = cmd_o & ~cmd_i;
  always @(posedge clk_i) f_ran <= 1'b1;

  always @(posedge clk_i) begin
    m_reset: assume (rst_ni == f_ran);
    if (f_ran) begin
      // TM-104: a command of the CPU to the clock goes through alone, with its data.
      p_cpu: assert (cmd_i[can_pkg::TimeArm:0] == '0 || (!own_o && f_own == '0));
      p_through: assert ((cmd_i & ~cmd_o) == '0);
      // TM-104: EN = 0 touches nothing.
      p_disabled: assert (enable || (!own_o && f_own == '0));
    end
  end
