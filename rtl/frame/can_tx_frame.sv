// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_tx_frame: selects the level that this node sends, at every bit boundary. Rules FF-01..FF-04,
// ST-01, AK-01, EF-01, EF-02, OV-01. In fields that are not listed the level is recessive.

module can_tx_frame (
  input  logic            clk_i,
  input  logic            rst_ni,
  input  logic            active_i,       // 0: engine stopped: recessive, even after an upset
  input  logic            boundary_i,     // pulse: last clock of a bit
  input  logic            run_i,          // 0: recessive from the next bit on (MO-13)
  input  logic            mute_i,         // listen-only or loop-back: the pin stays recessive
  input  can_pkg::field_t field_i,        // field of the next bit
  input  logic            transmitter_i,  // this node sends the frame
  input  logic            stuff_i,        // next bit is a stuff bit
  input  logic            prev_i,         // level of the bit before it
  input  logic            id_bit_i,       // next bit of FldId
  input  logic            ex_id_bit_i,    // next bit of FldExId
  input  logic            data_bit_i,     // next bit of FldData
  input  logic            crc_bit_i,      // next bit of the CRC
  input  logic            ide_i,          // frame is extended
  input  logic            rtr_i,          // frame is a remote frame
  input  logic            dlc_bit_i,      // next bit of the DLC
  input  logic            ack_i,          // as receiver: acknowledge in the ACK slot
  input  logic            passive_flag_i, // the error flag is passive
  output logic            tx_o,           // level of the current bit, also with mute_i
  output logic            can_tx_o        // transmit pin
);

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      tx_o     <= can_pkg::Recessive;
      can_tx_o <= can_pkg::Recessive;
    end else if (!active_i) begin
      tx_o     <= can_pkg::Recessive;
      can_tx_o <= can_pkg::Recessive;
    end else if (boundary_i) begin : choose
      logic level, other;
      case (field_i)
        can_pkg::FldId:      level = id_bit_i;
        can_pkg::FldRtr:     level = rtr_i || ide_i;  // SRR is recessive (FF-02)
        can_pkg::FldIde:     level = ide_i;
        can_pkg::FldExId:    level = ex_id_bit_i;
        can_pkg::FldExRtr:   level = rtr_i;
        can_pkg::FldDlc:     level = dlc_bit_i;
        can_pkg::FldData:    level = data_bit_i;
        can_pkg::FldCrc:     level = crc_bit_i;
        can_pkg::FldSof, can_pkg::FldR1, can_pkg::FldR0:
                             level = can_pkg::Dominant;  // FF-04
        default:             level = can_pkg::Recessive;
      endcase
      case (field_i)
        can_pkg::FldAck:     other = !ack_i;
        can_pkg::FldErrFlag: other = passive_flag_i;
        can_pkg::FldOvlFlag: other = can_pkg::Dominant;  // OV-01
        default:             other = can_pkg::Recessive;
      endcase
      // Only the transmitter sends frame bits. A stuff bit is the complement of the bit before it.
      if (stuff_i) level = !prev_i;
      level = (level || !transmitter_i) && other;
      tx_o     <= level || !run_i;
      can_tx_o <= level || !run_i || mute_i;
    end
  end

endmodule
