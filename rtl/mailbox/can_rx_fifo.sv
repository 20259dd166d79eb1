// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_rx_fifo: the six places of the Rx FIFO, and whether a frame goes there or into a mailbox
// (flexcan.md section 4).
//
// The places are the rows of buffers 0 to 5, used in a ring; a frame is moved into its place like
// into a mailbox. The output is the row head_o, so that taking a frame out moves nothing.
//
// What can be derived is not counted twice: where the next frame goes follows from the output, the
// fill and the frames on their way, so that both ends agree again whatever an upset flip-flop did.

module can_rx_fifo (
  input  logic       clk_i,
  input  logic       rst_ni,
  input  logic       clear_i,        // empty, whatever else happens
  input  logic       bcc_i,
  input  logic       mrp_i,          // mailboxes before the FIFO
  // CPU.
  input  logic       pop_i,          // done with the frame at the output
  output logic [2:0] head_o,         // row of the output
  output logic       avail_o,        // there is a frame at the output
  output logic       warn_o,         // pulse: the fill rises from 4 to 5
  output logic       ovf_o,          // pulse: a frame was lost
  // Match: what the filter table and the mailboxes say about the frame being received.
  input  logic       rx_hdr_i,       // a new frame
  input  logic       filter_i,       // an element fits
  input  logic [8:0] idhit_i,        // its number
  input  logic       mb_hit_i,       // a mailbox fits
  input  logic       mb_free_i,      // ... and is free to receive
  output logic       enough_o,       // no need to look at the mailboxes
  output logic       take_o,         // the frame belongs into the FIFO
  // Moves.
  input  logic       resolve_i,      // the frame is good; its place is decided in this clock
  input  logic       stored_i,       // it is there
  // taken and not there yet: one bit for each that may be
  input  logic [1:0] fifo_in_flight_i,
  output logic [2:0] tail_o,         // its row, in the clock of resolve_i
  output logic [8:0] idhit_o         // its element, from then on until stored_i
);
  localparam logic [2:0] Depth = 3'd6;

  function automatic logic [2:0] next(input logic [2:0] row);
    next = row >= Depth - 3'd1 ? 3'd0 : row + 3'd1;
  endfunction

  // Frames at the output or behind it; those on their way are used places, too.
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

  // Mailbox first: a free one, or with BCC=0 the first that fits.
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
      // Room now is room later: only this frame can take it.
      enough_o <= !rx_hdr_i && (enough_o || (filter_i && !mrp_i && !full));
    end
  end
endmodule
