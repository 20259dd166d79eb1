// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_mb_stamp: the stamps of 64 bits beside the buffers (TM-27 to TM-29). The stamp of the frame
// on the bus is written to the hidden row of a frame received and, of an own frame, to the row of
// its buffer; with a move it goes where the frame goes.
//
// Words: {hidden, upper half, row}; hidden rows 0 and 1 belong to the two frames received.

module can_mb_stamp #(
  parameter int NumMb = 64,
  /// Derived, do not override.
  localparam int IdxW = $clog2(NumMb)
) (
  input  logic            clk_i,
  input  logic            rst_ni,
  // After a hard reset: every row is written once (can_mb_port).
  input  logic            scrub_i,
  input  logic [IdxW+1:0] scrub_row_i,
  // Stamp of the frame on the bus, see can_time; own_i: an own frame.
  input  logic            start_i,
  input  logic            rx_valid_i,
  input  logic [63:0]     stamp_i,
  input  logic            we_i,
  input  logic            own_i,
  input  logic [IdxW-1:0] cur_idx_i,     // its buffer,
  input  logic            mine_i,        // which the CPU has not rewritten meanwhile
  input  logic            smb_i,         // hidden row of the frame being received
  output logic            busy_o,        // to be written yet: no move may begin
  // CPU reads; row: {upper half, buffer}.
  input  logic            re_i,
  input  logic            cpu_i,         // the slot is the CPU's: nothing but a copy is written now
  input  logic [IdxW:0]   cpu_row_i,
  output logic            shown_o,       // its row is being copied: it is on the output
  output logic [31:0]     rdata_o,
  // Moves: one word with each of the two steps that copy data.
  input  logic [1:0]      mv_step_i,
  input  logic            mv_row_i,
  input  logic [IdxW-1:0] mv_idx_i,
  input  logic            mv_data_i,
  input  logic            mv_cancel_i
);
  // The own row first: its buffer is done a bit after EOF6, and soonest.
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

  // A stamp that is taken at the end of the frame comes after rx_valid_i; one that does not come at
  // all keeps nobody waiting for longer than to the next frame.
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
