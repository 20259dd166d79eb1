// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_stuff: counts equal bits on the bus and marks stuff bits, for transmitter and receiver alike.
// Rules ST-01..ST-09. Because it counts the bus and not the own output, a joined SOF (ST-07) and
// the bits up to a lost arbitration (ST-08) need no special case.

module can_stuff (
  input  logic            clk_i,
  input  logic            rst_ni,
  input  logic            sample_i,  // pulse: sample point
  input  logic            bit_i,     // sampled bit
  input  can_pkg::field_t field_i,   // field of the current bit
  output logic            stuff_o,   // current bit is a stuff bit
  output logic            last_o,    // level of the previous bit
  output logic [2:0]      ones_o     // SOF to ACK delimiter: recessive bits before this bit
);

  logic [2:0] run_q;
  logic       five_q;

  // The last stuff bit comes between CRC0 and the CRC delimiter (ST-03). In fields without stuffing
  // five_q is ignored: after an error or a protocol exception in the fifth bit it is still set.
  assign stuff_o = five_q && ((field_i[4] ^ field_i[3]) || field_i == can_pkg::FldCrcDel);
  assign ones_o  = run_q & {3{last_o}};

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      run_q  <= 3'd1;
      five_q <= 1'b0;
      last_o <= can_pkg::Recessive;
    end else if (sample_i) begin : count
      logic       counts;
      logic [2:0] run;
      // Stuffing covers SOF to CRC0. Between frames each bit starts a run of one, and so does SOF,
      // because the bit before it is recessive (ST-02). The run continues to the ACK delimiter: a
      // node that integrates after a CRC error counts from there (MO-02).
      counts = field_i[4] ^ field_i[3];
      run    = (|field_i[4:3] && bit_i == last_o) ? run_q + 3'd1 : 3'd1;
      run_q  <= run;
      five_q <= counts && (run >= 3'd5);  // beyond five: an upset flip-flop
      last_o <= bit_i;
    end
  end

endmodule
