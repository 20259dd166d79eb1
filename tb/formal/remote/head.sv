  // SPDX-FileCopyrightText: 2026 The VeriCAN authors
  // SPDX-License-Identifier: Apache-2.0
  //
  // Properties of can_rn_head, spliced into it: any header, any entry of a producer or of the map,
  // any frame that is made.

  logic f_ran;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) f_ran <= 1'b0;
    else         f_ran <= 1'b1;
  end

  always @(posedge clk_i) begin
    // Reset in the first clock, none later.
    m_reset: assume (rst_ni == !$initstate);
    // can_rn_step: a header is taken over by an idle sequencer.
    m_take: assume (!take_i || job_i == can_rn_pkg::JobIdle);
    if (f_ran) begin
      // RN-36: a frame that is valid waits until the sequencer is idle.
      p_waits: assert (!$past(valid_o && job_i != can_rn_pkg::JobIdle && !gap_i && !lost_i)
                       || valid_o);
      // RN-04: the last eight A are ports, but of system functions, which have none.
      p_port: assert (port_o == (!sys_o && (&a_o[AddrBits-1:3])));
      // RN-63: an entry whose A has too many bits asks for nothing, neither window nor port.
      p_beyond: assert (!$past(entry && !phase_i[0] && (|read_i[7:AddrBits]))
                        || (sys_o && !port_o));
    end
  end
