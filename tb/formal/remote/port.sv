  // SPDX-FileCopyrightText: 2026 The VeriCAN authors
  // SPDX-License-Identifier: Apache-2.0
  //
  // Properties of can_rn_port, spliced into it: any job, any access of user logic.

  logic f_free;   // jobs in which the RAM is user logic's
  assign f_free = job_i == can_rn_pkg::JobIdle || job_i == can_rn_pkg::JobBegin
                  || job_i == can_rn_pkg::JobInt2 || job_i == can_rn_pkg::JobStart;

  always @(posedge clk_i) begin
    // RN-102 P-2, RN-50: no access of user logic while the node works in the RAM: while bytes are
    // copied, and while an answer is made.
    p_alone: assert (usr_ready_o == f_free);
    // RN-53: what user logic writes is not in E00..EFF and not in FE0..FFF.
    p_user_area: assert (!f_free || we == 4'd0
                         || !(address >= 10'h380 && address < 10'h3C0) && address < 10'h3F8);
    // RN-51: and it is the word that user logic shows, in its lanes.
    p_user_word: assert (!f_free || (wdata == usr_wdata_i && (we & ~usr_be_i) == 4'd0
                                     && (usr_req_i && usr_we_i || we == 4'd0)));
  end
