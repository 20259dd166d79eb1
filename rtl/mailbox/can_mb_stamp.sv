// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_mb_stamp: memory of the 64-bit stamps of the time unit, two words per buffer (TM-27 to
// TM-29). The stamp of the frame on the bus (can_time) is written to the hidden row of the frame
// being received and, for an own frame, to the row of its buffer. With a move (can_mb_move) it goes
// where the frame goes.
//
// Word address: {hidden, upper half, row}; hidden rows 0 and 1 are those of the two frames
// received.

module can_mb_stamp #(
  parameter int NumMb = 64,
  /// Derived, do not override.
  localparam int IdxW = $clog2(NumMb)
) (
  input  logic            clk_i,
  input  logic            rst_ni,
  // After a hard reset all rows are cleared, one a clock (can_mb_port).
  input  logic            scrub_i,
  input  logic [IdxW+1:0] scrub_row_i,
  // Frame on the bus and its stamp, see can_core and can_time.
  input  logic            start_i,       // pulse: a frame begins
  input  logic            rx_valid_i,    // pulse: the frame is valid (VA-01)
  input  logic [63:0]     stamp_i,
  input  logic            we_i,          // pulse: stamp_i is the stamp of the frame
  input  logic            own_i,         // 1: this node is the transmitter of the frame
  input  logic [IdxW-1:0] cur_idx_i,     // buffer of an own frame
  input  logic            mine_i,        // 1: buffer cur_idx_i has not been rewritten meanwhile
  input  logic            smb_i,         // hidden row of the frame being received
  output logic            busy_o,        // 1: the stamp is still to be written: no move may begin
  // Read port (can_mb_port).
  input  logic            re_i,          // 1: a row is read
  input  logic            cpu_i,         // 1: the CPU reads: only a copy may write in this clock
  input  logic [IdxW:0]   cpu_row_i,     // {upper half, buffer}
  output logic            shown_o,       // 1: rdata_o holds row cpu_row_i, which a copy writes
  output logic [31:0]     rdata_o,
  // Moves (can_mb_move): the two steps that copy data bytes copy a half of the stamp each.
  input  logic [1:0]      mv_step_i,
  input  logic            mv_row_i,
  input  logic [IdxW-1:0] mv_idx_i,
  input  logic            mv_data_i,
  input  logic            mv_cancel_i
);
  // word_q counts the words to write: 0, 1 row of the own buffer; 2, 3 hidden row. The own buffer
  // comes first: its end (StepEnd) follows one bit, of five clocks at least, after EOF6, where the
  // latest stamps are taken, and busy_o does not hold it back. The first word is written before;
  // what holds back the second also holds back the end.
  logic       write_q, have_q, await_q, copy, own, upper;
  logic [1:0] word_q;
  assign own  = own_i && mine_i;
  assign copy = mv_data_i && (mv_step_i == 2'd1 || mv_step_i == 2'd2);

  logic            we;
  logic [IdxW+1:0] raddr, waddr;
  logic [31:0]     wdata;
  assign upper = copy ? mv_step_i[1] : word_q[0];
  assign raddr = cpu_i ? {1'b0, cpu_row_i} : {1'b1, mv_step_i[1], IdxW'(mv_row_i)};
  always_comb begin
    waddr = {word_q[1], upper, word_q[1] ? IdxW'(smb_i) : cur_idx_i};
    wdata = word_q[0] ? stamp_i[63:32] : stamp_i[31:0];
    we    = write_q && !cpu_i && (own || word_q[1]);
    if (copy) begin
      waddr = {1'b0, upper, mv_idx_i};
      wdata = rdata_o;
      we    = !mv_cancel_i;
    end
    if (scrub_i) begin
      waddr = scrub_row_i;
      wdata = '0;
      we    = 1'b1;
    end
  end
  assign shown_o = copy && !mv_cancel_i && waddr == {1'b0, cpu_row_i};

  // A stamp that is taken at the end of the frame comes after rx_valid_i; await_q holds moves back
  // until then. Should no stamp come, they wait until the next frame begins and no longer.
  assign busy_o = write_q || await_q || (we_i && !have_q);
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {write_q, have_q, await_q} <= '0;
      word_q <= '0;
    end else begin
      if (we_i)         have_q <= 1'b1;
      else if (start_i) have_q <= 1'b0;
      await_q <= (await_q || (rx_valid_i && !have_q)) && !we_i && !start_i;
      if (we_i) begin
        write_q <= 1'b1;
        word_q  <= '0;
      end else if (write_q && !copy && !cpu_i) begin
        write_q <= word_q != '1;
        word_q  <= word_q + 1'b1;
      end
    end
  end

  can_mb_ram #(.Depth(4 * NumMb)) u_ram (
    .clk_i, .re_i, .raddr_i(raddr), .rdata_o, .we_i({4{we}}), .waddr_i(waddr), .wdata_i(wdata));
endmodule
