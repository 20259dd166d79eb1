// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_rx_fifo: order and fill of the Rx FIFO's six places, and the decision whether a frame goes
// there or into a mailbox (flexcan.md section 4).
//
// The places are the rows of buffers 0 to 5, used as a ring. can_mb_move moves a frame into its
// place as into a mailbox. The output is row head_o, so a pop moves no data.
//
// There is no write pointer: the row for the next frame follows from the output, the fill and the
// frames in flight. So both ends agree again after an upset of a flip-flop.

module can_rx_fifo (
  input  logic       clk_i,
  input  logic       rst_ni,
  input  logic       clear_i,        // pulse: soft reset or change of FEN; empties the FIFO
  input  logic       bcc_i,          // MCR.BCC
  input  logic       mrp_i,          // CTRL2.MRP: mailboxes before the FIFO
  // CPU's side.
  input  logic       pop_i,          // pulse: the CPU is done with the frame at the output
  output logic [2:0] head_o,         // row of the output
  output logic       avail_o,        // 1: a frame is at the output
  output logic       warn_o,         // pulse: the fill rises from 4 to 5
  output logic       ovf_o,          // pulse: a frame was lost
  // Results of the search for the frame being received (can_mb_filter, can_mb_rx).
  input  logic       rx_hdr_i,       // pulse: the header of a new frame is complete
  input  logic       filter_i,       // 1: a filter element fits
  input  logic [8:0] idhit_i,        // number of the filter element that fits
  input  logic       mb_hit_i,       // 1: a mailbox fits
  input  logic       mb_free_i,      // 1: the mailbox that fits is free to receive
  output logic       enough_o,       // 1: the mailboxes need not be searched
  output logic       take_o,         // 1: the frame belongs into the FIFO
  // Moves (can_mb_move).
  input  logic       resolve_i,      // pulse: the frame is valid, its place is decided now
  input  logic       stored_i,       // pulse: a frame has been moved into the FIFO
  // per hidden row: its frame is taken and not stored yet
  input  logic [1:0] fifo_in_flight_i,
  output logic [2:0] tail_o,         // row for a frame that is taken in the clock of resolve_i
  output logic [8:0] idhit_o         // filter element of the frame in flight, until stored_i
);
  localparam logic [2:0] Depth = 3'd6;

  function automatic logic [2:0] next(input logic [2:0] row);
    next = row >= Depth - 3'd1 ? 3'd0 : row + 3'd1;
  endfunction

  // fill_q: frames stored. used: places in use, those of frames in flight included.
  logic [2:0] head_q, fill_q, used;
  logic [3:0] ring;
  logic       pop, put, full;
  assign used    = fill_q + {2'b0, fifo_in_flight_i[0]} + {2'b0, fifo_in_flight_i[1]};
  assign ring    = {1'b0, head_q} + {1'b0, used};
  assign tail_o  = 3'(ring >= {1'b0, Depth} ? ring - {1'b0, Depth} : ring);
  assign avail_o = fill_q != '0;
  assign pop     = pop_i && avail_o;
  assign put     = resolve_i && take_o;
  assign full    = fill_q >= Depth || (fill_q >= Depth - 3'd1 && fifo_in_flight_i != '0)
                || (fill_q >= Depth - 3'd2 && fifo_in_flight_i == '1);
  assign head_o  = head_q;

  // MRP = 1: a mailbox that fits comes first if it is free, with BCC = 0 even if it is not.
  logic to_mb;
  assign to_mb  = mrp_i && mb_hit_i && (mb_free_i || !bcc_i);
  assign take_o = filter_i && !full && !to_mb;
  assign ovf_o  = resolve_i && filter_i && full && !mb_hit_i;
  assign warn_o = stored_i && !pop && fill_q == 3'd4;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {head_q, fill_q} <= '0;
      enough_o <= 1'b0;
      idhit_o  <= '0;
    end else if (clear_i) begin
      {head_q, fill_q} <= '0;
      enough_o <= 1'b0;
    end else begin
      head_q <= head_q >= Depth ? 3'd0 : pop ? next(head_q) : head_q;
      fill_q <= fill_q + {2'b0, stored_i && !pop} - {2'b0, pop && !stored_i};
      if (put) idhit_o <= idhit_i;
      // Room in the FIFO does not go away before resolve_i: only this frame could take it.
      enough_o <= !rx_hdr_i && (enough_o || (filter_i && !mrp_i && !full));
    end
  end
endmodule
