// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_stuff: counts equal bits on the bus and tells which bit is a stuff bit, for both roles.
// Rules ST-01..ST-09. The bus is counted, not the own output: a joined SOF (ST-07) and the bits up
// to a lost arbitration (ST-08) need no special case.

module can_stuff (
  input  logic            clk_i,
  input  logic            rst_ni,
  input  logic            sample_i,
  input  logic            bit_i,
  input  can_pkg::field_t field_i,
  output logic            stuff_o,   // the current bit is a stuff bit
  output logic            last_o,    // level of the bit before
  output logic [2:0]      ones_o     // SOF to ACK delimiter: recessive bits up to the one before
);

  logic [2:0] run_q;
  logic       five_q;

  // After CRC0 the stuff bit stands before the CRC delimiter (ST-03). After an error or a protocol
  // exception in the fifth bit the mark means nothing: no frame is under way any more.
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
      // From SOF to CRC0; between frames a bit starts a run of one, and so does SOF, for the bit
      // before it was recessive (ST-02). The run goes on to the ACK delimiter: whoever integrates
      // after a CRC error counts from there (MO-02).
      counts = field_i[4] ^ field_i[3];
      run    = (|field_i[4:3] && bit_i == last_o) ? run_q + 3'd1 : 3'd1;
      run_q  <= run;
      five_q <= counts && (run >= 3'd5);  // beyond five: an upset flip-flop
      last_o <= bit_i;
    end
  end

endmodule
