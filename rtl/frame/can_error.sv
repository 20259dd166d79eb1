// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_error: what is wrong with the bit just sampled, and what it asks for: flag, overload, retreat.
// Rules ED-01..ED-21, AR-02..AR-05, OV-03. Valid at the sample point; one event a bit (ED-17).

module can_error (
  input  can_pkg::field_t field_i,
  input  logic            last_i,         // last bit of the field
  input  logic            bit_i,          // sampled
  input  logic            sent_i,         // level this node sent in the bit
  input  logic            transmitter_i,
  input  logic            stuff_i,        // the bit is a stuff bit
  input  logic            prev_i,         // level of the bit before
  input  logic            crc_mismatch_i,
  input  logic            lpb_i,          // loop-back: no ACK needed (MO-04)
  output logic [5:0]      kind_o,         // can_pkg::Err*, at most one set
  output logic            error_o,        // an error flag follows
  output logic            exempt_o,       // stuff error in arbitration: counts nothing (FC-05 exc. 2)
  output logic            lost_o,         // arbitration lost
  output logic            overload_o      // an overload flag follows
);

  logic dominant, saw_d, arbitration, fixed, bit0, bit1, ack, crc, form, stuff;

  assign dominant    = !bit_i;
  assign saw_d       = transmitter_i && sent_i && dominant;  // sent recessive, somebody sends dominant
  assign arbitration = !field_i[4] && field_i[3];            // AR-01

  assign lost_o   = saw_d && arbitration && !stuff_i;        // AR-02
  assign exempt_o = saw_d && arbitration && stuff_i;         // AR-04

  // Whoever sends dominant and sees recessive: frame bit, ACK, active flag, overload flag (ED-06).
  assign bit0 = !sent_i && bit_i;
  assign bit1 = saw_d && ((field_i[4] && !field_i[3]) || stuff_i) && !arbitration;
  assign ack  = (field_i == can_pkg::FldAck) && transmitter_i && bit_i && !lpb_i;  // ED-16
  assign crc  = (field_i == can_pkg::FldAckDel) && crc_mismatch_i && !transmitter_i && bit_i;  // ED-20
  assign stuff = exempt_o || (!transmitter_i && stuff_i && bit_i == prev_i);       // ST-06

  // Fixed form; the last bit of EOF is judged by the transmitter alone (ED-10, ED-11) and that of a
  // delimiter by nobody (ED-12).
  always_comb begin
    case (field_i)
      can_pkg::FldCrcDel: fixed = !stuff_i;
      can_pkg::FldAckDel: fixed = 1'b1;
      can_pkg::FldEof:    fixed = !last_i || transmitter_i;
      can_pkg::FldDel:    fixed = !last_i;
      default:            fixed = 1'b0;
    endcase
  end
  assign form = fixed && dominant;

  assign kind_o  = {bit1, bit0, ack, crc, form, stuff};
  assign error_o = |kind_o;

  always_comb begin
    case (field_i)
      can_pkg::FldEof: overload_o = dominant && last_i && !transmitter_i;
      can_pkg::FldDel: overload_o = dominant && last_i;
      can_pkg::FldInt: overload_o = dominant && !last_i;
      default:         overload_o = 1'b0;
    endcase
  end

endmodule
