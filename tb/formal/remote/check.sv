  // SPDX-FileCopyrightText: 2026 The VeriCAN authors
  // SPDX-License-Identifier: Apache-2.0
  //
  // Properties of can_rn_check, spliced into it: any request to any node. No reset; f_ran is 0 in
  // the first clock alone.

  logic f_ran = 1'b0;
  always @(posedge clk_i) f_ran <= 1'b1;

  // First and last byte of an access, from the request itself.
  logic [12:0] f_first, f_last;
  logic        f_memory, f_config, f_window, f_row;
  assign f_first  = {1'b0, start_i};
  assign f_last   = f_first + {9'd0, end_i} - (far_o ? 13'd3 : 13'd1);
  assign f_memory = f_last < 13'hE00;
  assign f_config = f_first >= 13'hF00 && f_last < 13'hF20;
  assign f_window = f_last < 13'h078;
  assign f_row    = f_first >= 13'hFF0 && f_last < 13'h1000;

  logic f_write, f_read;
  assign f_write = write && !bad_function;
  assign f_read  = read && !bad_function && !info_o;
  // READ, STATUS, IDENT, a direct remote frame.
  logic f_asks;
  assign f_asks = sys_i ? 1'b0 : port_i ? a_i[2:0] == 3'd0 || a_i[2:1] == 2'd3 : rtr_i;

  always @(posedge clk_i) begin
    m_no_reset: assume (rst_ni);
    // The row of a frame ends with its bytes, that of an answer with what READ counts in its third
    // byte, the last; 1 to 6, or can_rn_head says that the value is bad.
    m_end: assume (end_i == (far_o && !a_i[0] ? end_i : dlc_i));
    m_count: assume (!(far_o && !a_i[0]) || value_bad_i || rtr_i || dlc_i != 4'd3
                     || (end_i >= 4'd3 && end_i <= 4'd8));
    // The last eight A are ports (can_rn_head).
    m_port: assume (port_i == (!sys_i && (&a_i[AddrBits-1:3])));
    // A direct access starts at A.
    m_start: assume (!near || mapped_i || start_i == 12'(a_i));
    // A map entry takes data frames that are no requests, of eight bytes at most.
    m_mapped: assume (!mapped_i || (near && !rtr_i && (short_i || dlc_i <= 4'd8)));
    if (f_ran) begin
      // RN-102 P-6, RN-61: locked, the configuration is not written.
      p_locked: assert (code_o != can_rn_pkg::CodeOk || !$past(f_write && f_last >= 13'hE00)
                        || $past(unlocked_i));
      // RN-102 P-1, RN-32: a write that is not refused lies in the memory or in the configuration.
      p_write: assert (code_o != can_rn_pkg::CodeOk || !$past(f_write)
                       || $past(f_memory || f_config));
      // RN-32, RN-22: so does a read, or in the rows of bytes that the bus may only read.
      p_read: assert (code_o != can_rn_pkg::CodeOk || !$past(f_read)
                      || $past(f_memory || f_config || f_row));
      // RN-32: a direct access that is not refused lies in the window.
      p_window: assert (code_o != can_rn_pkg::CodeOk
                        || !$past(near && !mapped_i && (f_write || f_read))
                        || $past(f_window));
      // RN-33: no more than eight bytes, and not none but by TRIGGER.
      p_length: assert (code_o != can_rn_pkg::CodeOk
                        || $past(dlc_i <= 4'd8 && (dlc_i != 4'd0 || trigger || mapped_i)));
      // RN-65: nor fewer than a map entry wants.
      p_short: assert (code_o != can_rn_pkg::CodeOk || !$past(mapped_i && short_i));
      // RN-32: what is protected is refused.
      p_denied: assert (code_o != can_rn_pkg::CodeOk || !$past(denied_i));
      // RN-102 P-3, RN-54: a read for which there is no room is refused.
      p_room: assert (code_o != can_rn_pkg::CodeOk || !$past(read_o && full_i));
      // RN-21, RN-22: what is a read, told a clock later.
      p_asks: assert (read_o == $past(f_asks));
      // RN-30, RN-32: a remote frame asks for memory, STATUS or IDENT alone.
      p_remote: assert (code_o != can_rn_pkg::CodeOk || !$past(rtr_i) || $past(near || info_o));
      // RN-61: UNLOCK needs the key, and a node that is not in OPERATE or locked until reset.
      p_unlock: assert (code_o != can_rn_pkg::CodeOk || !$past(setup_o && unlock_i)
                        || !$past(mismatch_i || operate_i || lock_reset_i));
      // RN-26: a node in OPERATE that is selected keeps its number.
      p_assign: assert (code_o != can_rn_pkg::CodeOk || !$past(assign_o && selected_i)
                        || !$past(operate_i));
    end
  end
