// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_error: error detection. It evaluates the sampled bit and reports an error, lost arbitration
// or an overload condition. Rules ED-01..ED-21, AR-02..AR-05, OV-03; at most one event per bit
// (ED-17). The result for either level is prepared in the first clock of the bit, and the sample
// point only selects, because this is the longest path of the core.

module can_error (
  input  logic            clk_i,
  input  logic            rst_ni,
  input  logic            run_i,          // engine is active
  input  logic            judge_i,        // first clock of a bit: field, level and role are new
  input  can_pkg::field_t field_i,        // field of the current bit
  input  logic            last_i,         // last bit of the field
  input  logic            bit_i,          // sampled bit
  input  logic            sent_i,         // level that this node sends in the bit
  input  logic            transmitter_i,  // transmitter of the current frame
  input  logic            stuff_i,        // current bit is a stuff bit
  input  logic            prev_i,         // level of the previous bit
  input  logic            crc_mismatch_i, // received CRC differs
  input  logic            lpb_i,          // loop-back: no ACK needed (MO-04)
  output logic [5:0]      kind_o,         // can_pkg::Err*, at most one set
  output logic            error_o,        // an error flag follows
  output logic            exempt_o,       // stuff error in arbitration (FC-05 exception 2)
  output logic            lost_o,         // arbitration lost
  output logic            overload_o,     // an overload flag follows
  output logic            flag_r_o,       // either follows if the bit is recessive
  output logic            flag_d_o        // either follows if it is dominant
);

  // Results if the bit is dominant.
  logic bit1_q, form_q, stuff_d_q, lost_q, exempt_q, overload_q, error_d_q;
  // Results if the bit is recessive.
  logic bit0_q, ack_q, crc_q, stuff_r_q, error_r_q;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {bit1_q, form_q, stuff_d_q, lost_q, exempt_q, overload_q, error_d_q} <= '0;
      {bit0_q, ack_q, crc_q, stuff_r_q, error_r_q}                         <= '0;
    end else if (!run_i) begin
      {bit1_q, form_q, stuff_d_q, lost_q, exempt_q, overload_q, error_d_q} <= '0;
      {bit0_q, ack_q, crc_q, stuff_r_q, error_r_q}                         <= '0;
    end else if (judge_i) begin : judge
      logic arbitration, saw_d, foreign_stuff, fixed, overload;
      logic bit1, stuff_d, exempt, bit0, ack, crc, stuff_r;

      saw_d         = transmitter_i && sent_i;                 // if dominant: sent by somebody else
      arbitration   = !field_i[4] && field_i[3];               // AR-01
      foreign_stuff = stuff_i && !transmitter_i;

      // Fixed form. A dominant bit is an error in the last bit of EOF for the transmitter only
      // (ED-10, ED-11), in the last bit of a delimiter for nobody (ED-12). Where it is no error it
      // leads to overload.
      case (field_i)
        can_pkg::FldCrcDel: {fixed, overload} = {!stuff_i, 1'b0};
        can_pkg::FldAckDel: {fixed, overload} = 2'b10;
        can_pkg::FldEof:    {fixed, overload} = (!last_i || transmitter_i) ? 2'b10 : 2'b01;
        can_pkg::FldDel:    {fixed, overload} = {!last_i, last_i};
        can_pkg::FldInt:    {fixed, overload} = {1'b0, !last_i};
        default:            {fixed, overload} = 2'b00;
      endcase

      bit1    = saw_d && !arbitration && (stuff_i || (field_i[4] && !field_i[3]));
      exempt  = saw_d && arbitration && stuff_i;                                      // AR-04
      stuff_d = foreign_stuff && !prev_i;                                             // ST-06
      // ED-06: dominant sent, recessive sampled: in a frame bit, ACK, active or overload flag.
      bit0    = !sent_i;
      ack     = (field_i == can_pkg::FldAck) && transmitter_i && !lpb_i;              // ED-16
      crc     = (field_i == can_pkg::FldAckDel) && crc_mismatch_i && !transmitter_i;  // ED-20
      stuff_r = foreign_stuff && prev_i;

      bit1_q     <= bit1;
      form_q     <= fixed;
      stuff_d_q  <= stuff_d || exempt;
      lost_q     <= saw_d && arbitration && !stuff_i;                                 // AR-02
      exempt_q   <= exempt;
      overload_q <= overload;
      error_d_q  <= bit1 || fixed || stuff_d || exempt;
      bit0_q     <= bit0;
      ack_q      <= ack;
      crc_q      <= crc;
      stuff_r_q  <= stuff_r;
      error_r_q  <= bit0 || ack || crc || stuff_r;
    end
  end

  assign kind_o     = bit_i ? {1'b0, bit0_q, ack_q, crc_q, 1'b0, stuff_r_q}
                            : {bit1_q, 3'b000, form_q, stuff_d_q};
  assign error_o    = bit_i ? error_r_q : error_d_q;
  assign exempt_o   = exempt_q && !bit_i;
  assign lost_o     = lost_q && !bit_i;
  assign overload_o = overload_q && !bit_i;
  assign flag_r_o   = error_r_q;
  assign flag_d_o   = error_d_q || overload_q;

endmodule
