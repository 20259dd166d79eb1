// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_rx_frame: shift register of the frame. Sampled bits shift in, bits to send shift out. A
// transmitter reads its own bits back, so that after a lost arbitration the register holds what the
// winner has sent (AR-07). Data words to send are loaded when needed, received bytes leave one by
// one.

module can_rx_frame #(
  /// 1: only base frames are sent, with data loaded byte by byte, and only the first 11 bits of an
  /// extended identifier are kept. The register has 11 bits instead of 32; its last eight are also
  /// the received byte.
  parameter int ByteWise = 0
) (
  input  logic            clk_i,
  input  logic            rst_ni,
  input  logic            sample_i,    // pulse: sample point
  input  logic            bit_i,       // sampled bit
  input  logic            stuff_i,     // current bit is a stuff bit
  input  logic            transmitter_i, // this node sends the frame
  input  can_pkg::field_t field_i,     // field of the current bit
  input  logic            judge_i,     // pulse: first clock of a bit
  input  logic            ends_i,      // last bit of the field
  input  logic            last_i,      // last bit of the field, from a bit's second clock on
  input  logic            byte_end_i,  // in the data field: last bit of a byte
  input  logic            word_end_i,  // in the data field: last bit of the first word
  input  logic            free_i,      // an own frame may begin after this bit
  input  logic            take_i,      // at this sample point an own frame begins: load its
                                       // header, with ByteWise its ID word as well
  input  logic            tx_ide_i,    // frame to send is extended
  input  logic            tx_rtr_i,    // frame to send is a remote frame
  input  logic [3:0]      tx_dlc_i,    // DLC of the frame to send
  input  logic [31:0]     tx_word_i,   // ID word, then data words; ByteWise: [25:18]
  output logic            id_bit_o,    // next bit to send in FldId
  output logic            ex_id_bit_o, // next bit to send in FldExId
  output logic            data_bit_o,  // next bit to send in FldData
  output logic            load_o,      // data word is taken at this sample point
  output logic [28:0]     rx_id_o,     // identifier; base frames in [28:18]
  output logic            ide_o,       // IDE: extended frame
  output logic            srr_o,       // SRR bit, in base frames RTR
  output logic            rtr_o,       // RTR: remote frame
  output logic [3:0]      dlc_o,       // raw DLC; while sending, the next bit in [3]
  output logic [7:0]      byte_o,      // received data byte
  output logic            byte_we_o    // pulse: byte_o is new
);

  logic in_id, in_data;
  assign in_id   = (field_i == can_pkg::FldId);
  assign in_data = (field_i == can_pkg::FldData);

  if (ByteWise == 0) begin : gen_words
    logic [31:0] shift_q;  // ID[28:0]; or data, next bit in [31]
    logic [7:0]  byte_q;
    logic        in_ex_id, unused;

    assign unused   = &{1'b0, transmitter_i, last_i};
    assign in_ex_id = (field_i == can_pkg::FldExId);

    assign id_bit_o    = shift_q[28];
    assign ex_id_bit_o = shift_q[17];
    assign data_bit_o  = shift_q[31];
    assign byte_o      = byte_q;
    assign rx_id_o     = {shift_q[28:18], shift_q[17:0] & {18{ide_o}}};
    // Enables, registered from the bit's second clock on, because they drive many flip-flops.
    // Receivers load too, which keeps the role out of this path; they do not use the word.
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

    // Where an own frame may begin, its ID word is loaded in any case: this is known before the bit
    // is sampled. If the node becomes receiver, the received bits replace it.
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
    logic [10:0] shift_q;  // ID[28:18]; byte received or to send in [7:0]
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

  // Header. The RTR bit of a base frame is where an extended frame has SRR; IDE decides (FF-13).
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
