// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_bsp: bit stream processor. It connects the blocks of the frame (fields, stuffing, CRC,
// errors, fault confinement, shift register, transmit level) and turns their results into the
// pulses for the message buffers. Registers change at the sample point; conditions that depend only
// on the position of a bit are decided in its first clock (judge_i).

module can_bsp #(
  /// See can_rx_frame.
  parameter int ByteWise = 0
) (
  input  logic            clk_i,
  input  logic            rst_ni,
  input  logic            run_i,           // engine is active
  input  logic            stay_i,          // 0: recessive from the next bit on (MO-13)
  input  logic            sample_i,        // pulse: sample point
  input  logic            bit_i,           // sampled bit
  input  logic            boundary_i,      // pulse: last clock of a bit
  input  logic            judge_i,         // pulse: first clock of a bit
  input  logic            edge_i,          // pulse: synchronising edge
  input  logic            lom_i,           // listen-only (MO-01)
  input  logic            lpb_i,           // loop-back (MO-04)
  input  logic            fd_tolerant_i,   // protocol exception on a recessive FDF bit (FF-06)
  input  logic            boff_rec_i,      // 1: no automatic recovery from bus-off (BO-03)
  input  logic            ec_clear_i,      // clear both error counters, leave bus-off
  input  logic            ec_we_i,         // write both error counters
  input  logic [15:0]     ec_wdata_i,      // {REC, TEC}
  input  logic            tx_req_i,        // a frame waits
  input  logic            tx_ide_i,        // it is extended
  input  logic            tx_rtr_i,        // it is a remote frame
  input  logic [3:0]      tx_dlc_i,        // its DLC
  input  logic [31:0]     tx_word_i,       // its ID word, then its data words, see can_core
  output logic            tx_o,            // level that this node sends in the current bit
  output logic            can_tx_o,        // transmit pin
  output logic            hard_o,          // the next bit uses hard synchronisation (SY-05)
  output can_pkg::field_t field_o,         // field of the current bit
  output logic [5:0]      left_o,          // bits of the field after the current one
  output logic            stuff_o,         // current bit is a stuff bit
  output logic            transmitter_o,   // transmitter of the current frame (RO-01)
  output logic [8:0]      tec_o,           // bit 8: bus-off; 7:0 TEC, see can_fault
  output logic [7:0]      rec_o,           // REC
  output logic            passive_o,       // error passive (FC-11)
  output logic            boff_o,          // bus-off (FC-13)
  output logic [5:0]      err_o,           // pulses, can_pkg::Err*
  output logic            tx_next_o,       // pulse: word of the frame taken
  output logic            tx_ok_o,         // pulse: frame sent (VA-02)
  output logic            tx_fail_o,       // pulse: attempt failed (error, lost arbitration)
  output logic            start_o,         // pulse: a frame begins
  output logic            stamp_o,         // pulse: the next bit is the first of the ID field
  output logic            rx_hdr_o,        // pulse: header received, valid for 3 bits
  output logic [28:0]     rx_id_o,         // identifier; base frames in [28:18]
  output logic            rx_ide_o,        // extended frame
  output logic            rx_srr_o,        // SRR bit as received
  output logic            rx_rtr_o,        // remote frame
  output logic [3:0]      rx_dlc_o,        // raw DLC (FF-08)
  output logic            rx_byte_we_o,    // pulse: rx_byte_o is the next data byte
  output logic [7:0]      rx_byte_o,       // data byte, stable for a bit
  output logic            rx_valid_o,      // pulse: frame valid, SP of EOF6 (VA-01)
  output logic [14:0]     crc_o            // CRC of the frame, valid with tx_ok_o
);

  logic       prev, ends, last, free, crc_bit, mismatch, begin_rx, take_tx, load, in_frame,
    own_free;
  logic       passive_flag, overload_frame, boff_enter, boff_end;
  logic       id_bit, ex_id_bit, data_bit;
  logic [5:0] kind;
  logic [2:0] ones;
  logic       error, exempt, lost, overload, flag_r, flag_d, word_end;

  can_stuff u_stuff (
    .clk_i, .rst_ni, .sample_i, .bit_i, .field_i(field_o), .stuff_o, .last_o(prev),
    .ones_o(ones)
  );

  can_crc15 u_crc15 (
    .clk_i, .rst_ni, .sample_i, .bit_i, .stuff_i(stuff_o), .field_i(field_o),
    .crc_bit_o(crc_bit), .crc_o, .mismatch_o(mismatch)
  );

  can_error u_error (
    .clk_i, .rst_ni, .run_i, .judge_i, .field_i(field_o), .last_i(ends), .bit_i,
    .sent_i(tx_o), .transmitter_i(transmitter_o),
    .stuff_i(stuff_o), .prev_i(prev), .crc_mismatch_i(mismatch), .lpb_i,
    .kind_o(kind), .error_o(error), .exempt_o(exempt), .lost_o(lost), .overload_o(overload),
    .flag_r_o(flag_r), .flag_d_o(flag_d)
  );

  can_field u_field (
    .clk_i, .rst_ni, .run_i, .sample_i, .bit_i, .judge_i, .stuff_i(stuff_o), .prev_i(prev),
    .ones_i(ones), .edge_i, .error_i(error), .lost_i(lost), .overload_i(overload),
    .flag_r_i(flag_r), .flag_d_i(flag_d),
    .passive_i(passive_o), .boff_i(boff_o), .boff_enter_i(boff_enter), .boff_end_i(boff_end),
    .tx_req_i(tx_req_i && !lom_i), .ide_i(rx_ide_o), .rtr_i(rx_rtr_o), .dlc_i(rx_dlc_o[2:0]),
    .lom_i, .fd_tolerant_i,
    .field_o, .left_o, .ends_o(ends), .last_o(last), .transmitter_o, .passive_flag_o(passive_flag),
    .overload_frame_o(overload_frame), .free_o(free), .own_free_o(own_free),
    .begin_rx_o(begin_rx), .take_tx_o(take_tx)
  );

  can_fault u_fault (
    .clk_i, .rst_ni, .run_i, .sample_i, .bit_i, .field_i(field_o),
    .after_flag_i({left_o[5], left_o[2:0]}), .ends_i(ends), .last_i(last), .free_i(free),
    .sent_i(tx_o), .transmitter_i(transmitter_o), .overload_frame_i(overload_frame),
    .passive_flag_i(passive_flag), .error_i(error), .exempt_i(exempt),
    .ack_error_i(kind[can_pkg::ErrAck]), .lom_i, .boff_rec_i,
    .clear_i(ec_clear_i), .we_i(ec_we_i), .wdata_i(ec_wdata_i),
    .tec_o, .rec_o, .passive_o, .boff_o, .boff_enter_o(boff_enter), .boff_end_o(boff_end)
  );

  can_rx_frame #(.ByteWise(ByteWise)) u_rx_frame (
    .clk_i, .rst_ni, .sample_i, .bit_i, .stuff_i(stuff_o), .transmitter_i(transmitter_o),
    .field_i(field_o), .judge_i, .ends_i(ends), .last_i(last),
    .byte_end_i(left_o[2:0] == 3'd0), .word_end_i(word_end),
    .free_i(own_free), .take_i(take_tx),
    .tx_ide_i, .tx_rtr_i, .tx_dlc_i, .tx_word_i,
    .id_bit_o(id_bit), .ex_id_bit_o(ex_id_bit), .data_bit_o(data_bit), .load_o(load),
    .rx_id_o, .ide_o(rx_ide_o), .srr_o(rx_srr_o), .rtr_o(rx_rtr_o), .dlc_o(rx_dlc_o),
    .byte_o(rx_byte_o), .byte_we_o(rx_byte_we_o)
  );

  can_tx_frame u_tx_frame (
    .clk_i, .rst_ni, .active_i(run_i), .boundary_i, .run_i(stay_i), .mute_i(lom_i || lpb_i),
    .field_i(field_o), .transmitter_i(transmitter_o), .stuff_i(stuff_o), .prev_i(prev),
    .id_bit_i(id_bit), .ex_id_bit_i(ex_id_bit), .data_bit_i(data_bit), .crc_bit_i(crc_bit),
    .ide_i(rx_ide_o), .rtr_i(rx_rtr_o), .dlc_bit_i(rx_dlc_o[3]),
    .ack_i(!transmitter_o && !mismatch && !lom_i), .passive_flag_i(passive_flag), .tx_o, .can_tx_o
  );

  // The fourth of more than four data bytes is complete: the transmitter needs its second word.
  assign word_end = (left_o[5:3] == (rx_dlc_o[3] ? 3'd4 : {1'b0, rx_dlc_o[1:0]}))
                    && (left_o[2:0] == 3'd0) && !ends;

  // SY-05: hard synchronisation in idle, suspend, INT2, INT3, integration and bus-off recovery.
  assign hard_o = !(|field_o[4:3]) && !(field_o == can_pkg::FldInt && left_o[1]);

  // SOF to EOF, where an error or lost arbitration ends an attempt to send.
  assign in_frame = (|field_o[4:3]) && !(&field_o[4:2]);

  // All pulses come in the clock after a sample point. Nothing changes here in any other clock.
  logic sampled_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) sampled_q <= 1'b0;
    else         sampled_q <= sample_i;
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      err_o     <= '0;
      tx_next_o <= 1'b0;
      tx_ok_o   <= 1'b0;
      tx_fail_o <= 1'b0;
      start_o   <= 1'b0;
      stamp_o   <= 1'b0;
      rx_hdr_o  <= 1'b0;
      rx_valid_o <= 1'b0;
    end else if (sample_i || sampled_q) begin
      err_o      <= kind & {6{sample_i}};
      tx_next_o  <= sample_i && (take_tx || (load && transmitter_o));
      tx_ok_o    <= sample_i && field_o == can_pkg::FldEof && last && bit_i && transmitter_o;
      tx_fail_o  <= sample_i && transmitter_o && in_frame && (error || lost);
      start_o    <= sample_i && (take_tx || begin_rx);
      stamp_o    <= sample_i && !bit_i && (take_tx || begin_rx || field_o == can_pkg::FldSof);
      rx_hdr_o   <= sample_i && field_o == can_pkg::FldR0 && !stuff_o && !error;
      // VA-01. A sample point may fall into the first clock in which the engine stands: no frame
      // becomes valid behind a stop.
      rx_valid_o <= sample_i && field_o == can_pkg::FldEof && left_o == 6'd1 && bit_i && run_i;
    end
  end

endmodule
