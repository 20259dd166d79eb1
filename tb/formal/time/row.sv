  // SPDX-FileCopyrightText: 2026 The VeriCAN authors
  // SPDX-License-Identifier: Apache-2.0
  //
  // Properties of can_mb_stamp, spliced into it, around any_ram: of each word of the memory its
  // lowest bit is modelled here, all others are copied as it is. Moves are those of can_mb_move,
  // frames those of time.stamp; when they come is free.

  logic [4*NumMb-1:0] f_mem;
  logic               f_read, f_granted, f_same;
  (* anyseq *) logic  f_torn;        // what a word reads that is being written
  always_ff @(posedge clk_i) begin
    if (re_i) f_read <= we && waddr == raddr ? f_torn : f_mem[raddr];
    if (we)   f_mem[waddr] <= wdata[0];
    f_granted <= rst_ni && re_i && !cpu_i && !mv_data_i;
  end

  // Frames received, and the move that is under way (can_mb_move): step 0 reads the old C/S word,
  // 1 and 2 copy data, 3 writes the C/S word.
  logic            f_moving, f_row, f_told, f_valid, f_begin, f_smb;
  logic [1:0]      f_full, f_step, f_lower, f_upper;
  logic [IdxW-1:0] f_idx;
  logic [63:0]     f_stamp;
  (* anyseq *) logic f_wants;
  logic [1:0] f_come, f_gone;
  assign f_come  = {rx_valid_i && smb_i, rx_valid_i && !smb_i};
  assign f_gone  = {2{f_moving && mv_data_i && !mv_cancel_i && f_step == 2'd3}} & {f_row, !f_row};
  assign f_begin = f_wants && !f_moving && f_full[mv_row_i] && !busy_o;
  always_ff @(posedge clk_i) begin
    if (!rst_ni) begin
      {f_moving, f_told, f_valid, f_smb, f_full, f_step} <= '0;
    end else begin
      f_full <= (f_full | f_come) & ~f_gone;
      if (we_i) f_stamp <= stamp_i;
      if (we_i && !smb_i) {f_upper[0], f_lower[0]} <= {stamp_i[32], stamp_i[0]};
      if (we_i && smb_i)  {f_upper[1], f_lower[1]} <= {stamp_i[32], stamp_i[0]};
      f_told  <= !start_i && (f_told || we_i);
      f_valid <= !start_i && (f_valid || rx_valid_i);
      if (start_i && f_full[f_smb]) f_smb <= !f_smb;
      if (f_begin) {f_moving, f_row, f_idx, f_step} <= {1'b1, mv_row_i, mv_idx_i, 2'd0};
      else if (f_moving && mv_cancel_i) f_moving <= 1'b0;
      else if (f_moving && mv_data_i) begin
        f_step <= f_step + 2'd1;
        if (f_step == 2'd3) f_moving <= 1'b0;
      end
    end
  end

  always @(posedge clk_i) begin
    m_reset: assume (rst_ni == !$initstate);
    m_ram: assume (rdata_o[0] == f_read);
    m_scrub: assume (!scrub_i);
    // can_mb_step: data is there in the clock after the engine's read.
    m_data: assume (!mv_data_i || (f_moving && f_granted));
    // can_mb_move: row, buffer and step stand still in a move; a request for an answer copies none.
    m_move: assume (!f_moving || (mv_row_i == f_row && mv_idx_i == f_idx && mv_step_i == f_step));
    m_smb: assume (smb_i == f_smb);
    // time.stamp, p_once, p_one, p_kept: one stamp for each good frame, before or right behind its
    // end. It stays until an edge behind the intermission; here it is needed while it is written.
    m_once: assume (!we_i || (!f_told && !start_i));
    m_stamped: assume (!start_i || !f_valid || f_told);
    m_kept: assume (!write_q || stamp_i == f_stamp);
    // The start of the next frame is two bits of eight clocks away at least; four words are written
    // in less, as the CPU has every second clock at most, a copy one. And a valid frame ends one.
    m_long: assume (!start_i || !write_q);
    m_valid: assume (!rx_valid_i || (!f_valid && !start_i));
    // host.lock, m_time: the hidden row of the frame on the bus is free when that begins.
    m_time: assume (!start_i || f_full != 2'b11);
    m_free: assume (!(rx_valid_i || we_i) || !f_full[smb_i] || f_valid);
    // A buffer that sends is none that receives.
    m_own: assume (!(own && f_moving && cur_idx_i == f_idx));
    if (rst_ni) begin
      // TM-27: when the C/S word of a frame is written, both words of its stamp are in the row of
      // the buffer.
      p_row: assert (!(f_moving && mv_data_i && !mv_cancel_i && f_step == 2'd3)
                     || (f_mem[{2'b00, f_idx}] == f_lower[f_row]
                         && f_mem[{2'b01, f_idx}] == f_upper[f_row]));
      // TM-29: nothing but the engine writes; a read of the CPU meets no write but a copy.
      p_again: assert (!(cpu_i && we) || copy);
    end
  end
