// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_rx_frame: the one shift register of the frame: bits of the bus go in, bits to send come out.
// A sender reads back its own bits, so that at a lost arbitration the register already holds what
// the winner sent so far (AR-07). Data words are loaded as the bits pass; received bytes leave so.

module can_rx_frame #(
  /// 1: only base frames are sent, their data are loaded byte by byte, and of extended ones nothing
  /// is kept: a register of 11 bits instead of 32, whose last eight are the received byte, too.
  parameter int ByteWise = 0
) (
  input  logic            clk_i,
  input  logic            rst_ni,
  input  logic            sample_i,
  input  logic            bit_i,
  input  logic            stuff_i,
  input  logic            transmitter_i, // this node sends the frame
  input  can_pkg::field_t field_i,
  input  logic            judge_i,     // first clock of a bit
  input  logic            ends_i,      // last bit of the field
  input  logic            last_i,      // ... the same, from a bit's second clock on
  input  logic            byte_end_i,  // last bit of a data byte, if in the data field
  input  logic            word_end_i,  // last bit of the first data word, if in the data field
  input  logic            free_i,      // after this bit an own frame may begin
  input  logic            take_i,      // at this sample point an own frame starts: load its head,
                                       // with ByteWise its word, too
  input  logic            tx_ide_i,
  input  logic            tx_rtr_i,
  input  logic [3:0]      tx_dlc_i,
  input  logic [31:0]     tx_word_i,   // ID word, then the data words; ByteWise: [25:18]
  output logic            id_bit_o,    // next bits to send
  output logic            ex_id_bit_o,
  output logic            data_bit_o,
  output logic            load_o,      // data word taken at this sample point
  output logic [28:0]     rx_id_o,
  output logic            ide_o,
  output logic            srr_o,
  output logic            rtr_o,
  output logic [3:0]      dlc_o,
  output logic [7:0]      byte_o,
  output logic            byte_we_o    // one clock: byte_o is new
);

  logic in_id, in_data;
  assign in_id   = (field_i == can_pkg::FldId);
  assign in_data = (field_i == can_pkg::FldData);

  if (ByteWise == 0) begin : gen_words
    logic [31:0] shift_q;  // ID[28:0], or data with the next bit in 31
    logic [7:0]  byte_q;
    logic        in_ex_id, unused;

    assign unused   = &{1'b0, transmitter_i, last_i};
    assign in_ex_id = (field_i == can_pkg::FldExId);

    assign id_bit_o    = shift_q[28];
    assign ex_id_bit_o = shift_q[17];
    assign data_bit_o  = shift_q[31];
    assign byte_o      = byte_q;
    assign rx_id_o     = {shift_q[28:18], shift_q[17:0] & {18{ide_o}}};
    // What this bit will do, known from its second clock on: these enable many flip-flops.
    // Receivers load too (their word is not used): the role stays out of this path.
    logic load, load_q, high_q, low_q;
    assign load   = field_i == can_pkg::FldDlc ? ends_i : in_data && word_end_i;
    assign load_o = load_q;
    always_ff @(posedge clk_i or negedge rst_ni) begin
      if (!rst_ni) begin
        {load_q, high_q, low_q} <= '0;
      end else if (judge_i) begin
        load_q <= !stuff_i && load;
        high_q <= !stuff_i && (load || in_id || in_data);
        low_q  <= !stuff_i && (load || in_ex_id || in_data);
      end
    end

    // Where an own frame may begin the word is taken whoever begins: that is known before the bit
    // is, and a receiver puts another in its place.
    logic take;
    assign take = free_i || load_q;
    always_ff @(posedge clk_i or negedge rst_ni) begin
      if (!rst_ni) begin
        shift_q <= '0;
      end else if (sample_i) begin
        if (free_i || high_q)
          shift_q[31:18] <= take ? tx_word_i[31:18] : {shift_q[30:18], in_id ? bit_i : shift_q[17]};
        if (free_i || low_q)
          shift_q[17:0]  <= take ? tx_word_i[17:0] : {shift_q[16:0], bit_i};
      end
    end

    always_ff @(posedge clk_i or negedge rst_ni) begin
      if (!rst_ni) begin
        byte_q <= '0;
      end else if (sample_i) begin
        if (in_data && !stuff_i) byte_q <= {byte_q[6:0], bit_i};
      end
    end
  end else begin : gen_bytes
    logic [10:0] shift_q;  // ID[28:18]; the byte that comes in or goes out in [7:0]
    logic        unused;

    assign unused      = &{1'b0, free_i, judge_i, ends_i, word_end_i, tx_word_i[31:29],
                           tx_word_i[17:0]};
    assign id_bit_o    = shift_q[10];
    assign ex_id_bit_o = can_pkg::Recessive;
    assign data_bit_o  = shift_q[7];
    assign byte_o      = shift_q[7:0];
    assign rx_id_o     = {shift_q, 18'd0};
    assign load_o      = !stuff_i && transmitter_i && (last_i ? field_i == can_pkg::FldDlc
                                                              : in_data && byte_end_i);

    always_ff @(posedge clk_i or negedge rst_ni) begin
      if (!rst_ni) begin
        shift_q <= '0;
      end else if (sample_i) begin
        if (take_i || load_o)                    shift_q <= tx_word_i[28:18];
        else if (!stuff_i && (in_id || in_data)) shift_q <= {shift_q[9:0], bit_i};
      end
    end
  end

  // Head: RTR of a base frame is the bit where an extended one has SRR; known when IDE is (FF-13).
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {ide_o, srr_o, rtr_o} <= '0;
      dlc_o                 <= '0;
    end else if (sample_i) begin
      if (take_i) begin
        ide_o <= tx_ide_i;
        rtr_o <= tx_rtr_i;
        dlc_o <= tx_dlc_i;
      end else if (!stuff_i) begin
        case (field_i)
          can_pkg::FldRtr: begin
            srr_o <= bit_i;
            if (ByteWise != 0) rtr_o <= bit_i;   // until FldExRtr, nobody looks
          end
          can_pkg::FldIde: begin
            ide_o <= bit_i;
            if (ByteWise == 0 && !bit_i) rtr_o <= srr_o;
          end
          can_pkg::FldExRtr: rtr_o <= bit_i;
          can_pkg::FldDlc:   dlc_o <= {dlc_o[2:0], bit_i};
          default: ;
        endcase
      end
    end
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni)         byte_we_o <= 1'b0;
    else if (sample_i)   byte_we_o <= in_data && byte_end_i && !stuff_i;
    else if (byte_we_o)  byte_we_o <= 1'b0;
  end

endmodule
