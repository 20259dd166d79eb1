// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_tx_frame: chooses the level that this node sends in the coming bit.
// Rules FF-01..FF-04, ST-01, AK-01, EF-01, EF-02, OV-01. Everything not named here is recessive.

module can_tx_frame (
  input  can_pkg::field_t field_i,
  input  logic            transmitter_i,
  input  logic            stuff_i,
  input  logic            last_i,         // level of the bit before
  input  logic            id_bit_i,
  input  logic            ex_id_bit_i,
  input  logic            data_bit_i,
  input  logic            crc_bit_i,
  input  logic            ide_i,
  input  logic            rtr_i,
  input  logic            dlc_bit_i,
  input  logic            ack_i,          // receiver: acknowledge
  input  logic            passive_flag_i, // the error flag is passive
  output logic            tx_o
);

  logic frame_bit;

  always_comb begin
    case (field_i)
      can_pkg::FldId:    frame_bit = id_bit_i;
      can_pkg::FldRtr:   frame_bit = rtr_i || ide_i;  // SRR is recessive (FF-02)
      can_pkg::FldIde:   frame_bit = ide_i;
      can_pkg::FldExId:  frame_bit = ex_id_bit_i;
      can_pkg::FldExRtr: frame_bit = rtr_i;
      can_pkg::FldDlc:   frame_bit = dlc_bit_i;
      can_pkg::FldData:  frame_bit = data_bit_i;
      can_pkg::FldCrc:   frame_bit = crc_bit_i;
      can_pkg::FldCrcDel: frame_bit = can_pkg::Recessive;
      default:           frame_bit = can_pkg::Dominant;  // SOF, r1, r0 (FF-04)
    endcase
  end

  always_comb begin
    case (field_i)
      can_pkg::FldAck:     tx_o = !ack_i;
      can_pkg::FldErrFlag: tx_o = passive_flag_i;
      can_pkg::FldOvlFlag: tx_o = can_pkg::Dominant;
      default:
        if (!transmitter_i || !(field_i[4] ^ field_i[3]) && field_i != can_pkg::FldCrcDel)
          tx_o = can_pkg::Recessive;
        else
          tx_o = stuff_i ? !last_i : frame_bit;
    endcase
  end

endmodule
