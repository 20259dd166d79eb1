// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_time_pair: recognises SYNC and FUP among the received frames (TM-101) and keeps the 32-bit
// word in bytes 4 to 7 of the last one. The word leaves serially, lowest bit first. Bytes also
// enter serially in this order, so each flip-flop of the word only takes the value of its
// neighbour.

module can_time_pair (
  input  logic        clk_i,
  input  logic        rst_ni,
  input  logic        enable_i,      // 0: a SYNC under way or waiting is dropped, none begins
  input  logic [3:0]  domain_i,      // TSCTRL.DOMAIN
  input  logic [31:0] id_i,          // TSID
  // Reception, as in can_core.
  input  logic        rx_hdr_i,      // pulse: rx_id_i, rx_ide_i, rx_rtr_i are valid
  input  logic [28:0] rx_id_i,       // identifier; base frames in [28:18]
  input  logic        rx_ide_i,      // extended frame
  input  logic        rx_rtr_i,      // remote frame
  input  logic [3:0]  rx_dlc_i,      // raw DLC, valid with rx_valid_i
  input  logic        rx_byte_we_i,  // pulse: rx_byte_i is new
  input  logic [7:0]  rx_byte_i,     // received byte, stable for a bit
  input  logic        rx_valid_i,    // pulse: frame is valid
  // The word, good until byte 4 of the next SYNC or FUP.
  input  logic [7:0]  count_i,       // one-hot, rotating: bit of the byte
  input  logic        shift_i,       // bit_o moves on to the next bit
  output logic        bit_o,         // lowest bit of what is left of the word
  output logic        sync_o,        // pulse, in the clock after rx_valid_i: SYNC accepted
  output logic        pair_o,        // pulse, in the same clock: FUP of the last SYNC accepted
  output logic [3:0]  sc_o,          // sequence counter of the last SYNC
  output logic [1:0]  ovs_o          // OVS: whole seconds in the FUP
);
  // Type in byte 0: SYNC 0x10, with CRC 0x20; FUP 0x18, with CRC 0x28.
  logic sync_type, fup_type, known;
  assign known     = (rx_byte_i[7:4] == 4'h1) || (rx_byte_i[7:4] == 4'h2);
  assign sync_type = known && rx_byte_i[3:0] == 4'h0;
  assign fup_type  = known && rx_byte_i[3:0] == 4'h8;

  logic       fits_q, fup_q, waits_q;   // frame fits so far; it is a FUP; a SYNC waits for its FUP
  logic [2:0] next_q;                   // index of the next byte
  logic [3:0] sc_q;
  logic [7:0] byte_q;
  logic       valid, same_sc;
  assign valid   = rx_valid_i && fits_q && rx_dlc_i == 4'd8;
  assign same_sc = sc_q == sc_o;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {fits_q, fup_q} <= '0;
      next_q <= '0;
      sc_q   <= '0;
      ovs_o  <= '0;
      byte_q <= '0;
    end else if (!enable_i) begin
      fits_q <= 1'b0;   // the word is not shifted in without the clocks of count_i
    end else if (rx_hdr_i) begin
      fits_q <= !rx_rtr_i && {rx_ide_i, rx_id_i} == {id_i[31], id_i[28:0]};
      next_q <= '0;
    end else if (rx_byte_we_i) begin
      byte_q <= rx_byte_i;
      next_q <= next_q + 3'd1;
      case (next_q)
        3'd0: begin
          fup_q  <= fup_type;
          fits_q <= fits_q && (sync_type || fup_type);
        end
        3'd2: begin
          sc_q   <= rx_byte_i[3:0];
          fits_q <= fits_q && rx_byte_i[7:4] == domain_i;
        end
        3'd3:    ovs_o <= rx_byte_i[1:0];
        default: ;
      endcase
    end
  end
  logic unused;
  assign unused = &{1'b0, id_i[30:29]};

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {sync_o, pair_o, waits_q} <= '0;
      sc_o <= '0;
    end else begin
      sync_o  <= valid && !fup_q;
      pair_o  <= valid && fup_q && waits_q && same_sc;
      waits_q <= enable_i && (sync_o || waits_q && !pair_o);
      if (valid && !fup_q) sc_o <= sc_q;
    end
  end

  // The word consists of four registers of a byte each, chained once they are filled. A byte is
  // shifted in within 8 clocks that begin with count_i[0], well before the next byte comes.
  logic        due_q, fill_q, in;
  logic [31:0] word_q;
  assign in    = |(byte_q & count_i);
  assign bit_o = word_q[0];
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {due_q, fill_q} <= '0;
    end else begin
      due_q <= (rx_byte_we_i && next_q[2] && fits_q) || (due_q && !count_i[7]);
      if (count_i[7]) fill_q <= due_q;
    end
  end
  for (genvar i = 0; i < 4; i++) begin : gen_byte
    // Byte 7 of the frame is the lowest of the word; next_q has wrapped to 0 when it enters.
    logic here, first;
    assign here  = fill_q && next_q[1:0] == 2'(4 - i);
    if (i == 3) begin : gen_top
      assign first = in && fill_q;
    end else begin : gen_below
      assign first = fill_q ? in : word_q[8*i+8];
    end
    always_ff @(posedge clk_i or negedge rst_ni) begin
      if (!rst_ni)              word_q[8*i +: 8] <= '0;
      else if (here || shift_i) word_q[8*i +: 8] <= {first, word_q[8*i+1 +: 7]};
    end
  end
endmodule
