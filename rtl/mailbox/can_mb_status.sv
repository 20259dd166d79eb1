// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_mb_status: the status registers ESR2 and CRCR (flexcan.md 1.7, 1.8). A pass of can_mb_tx over
// all buffers finds ESR2: the lowest inactive buffer, or the one that would be sent last. CRCR has
// the CRC and the buffer of the last frame sent.

module can_mb_status #(
  parameter int NumMb = 64,
  /// Derived, do not override.
  localparam int IdxW = $clog2(NumMb)
) (
  input  logic            clk_i,
  input  logic            rst_ni,
  input  logic            clear_i,      // pulse: soft reset
  input  logic            cs_written_i, // pulse: the CPU wrote a C/S word in the clock before
  // Pass for ESR2, see can_mb_tx.
  input  logic            pass_i,       // 1: a pass is wanted or under way, VPS = 0
  input  logic            pass_end_i,   // pulse: the pass is complete, nothing changed during it
  input  logic            seen_i,       // pulse: the pass has looked at buffer seen_idx_i
  input  logic [IdxW-1:0] seen_idx_i,
  input  logic            seen_worst_i, // 1: of those seen so far that buffer would be sent last
  input  logic            seen_free_i,  // 1: code of buffer seen_idx_i is INACTIVE
  // Frame on the bus.
  input  logic            sent_i,       // pulse: buffer cur_idx_i was sent and is inactive now
  input  logic            tx_ok_i,      // pulse: the frame of buffer cur_idx_i has been sent
  input  logic [IdxW-1:0] cur_idx_i,
  input  logic [14:0]     crc_i,        // CRC of the frame on the bus, valid with tx_ok_i
  output logic [8:0]      esr2_o,       // {LPTM, VPS, IMB}
  output logic [21:0]     crcr_o        // {MBCRC, TXCRC}
);
  logic [IdxW-1:0] lptm_q, mbcrc_q;
  logic            vps_q, imb_q, crc_q, first;
  logic [14:0]     txcrc_q;

  // A C/S write beats the result before it, in the transfer right behind it too.
  assign esr2_o = {7'(lptm_q), vps_q && !cs_written_i, imb_q};
  assign crcr_o = {7'(mbcrc_q), txcrc_q} & {22{crc_q}};   // 0 until a frame has been sent

  // During a pass LPTM and IMB are those of the buffers seen so far; VPS = 0 tells that they are
  // not final.
  assign first = seen_idx_i == '0;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {vps_q, imb_q} <= '0;
      lptm_q <= '0;
    end else begin
      if (seen_i) begin
        if (first) imb_q <= 1'b0;
        if (seen_free_i && (first || !imb_q)) begin
          imb_q  <= 1'b1;
          lptm_q <= seen_idx_i;
        end else if (seen_worst_i && (first || !imb_q)) begin
          lptm_q <= seen_idx_i;
        end else if (first) begin
          lptm_q <= '0;
        end
      end
      if (sent_i && !imb_q && !pass_i) begin
        {vps_q, imb_q} <= '1;
        lptm_q <= cur_idx_i;
      end
      if (pass_i || cs_written_i) vps_q <= 1'b0;
      if (pass_end_i)             vps_q <= 1'b1;
      if (clear_i) begin
        {vps_q, imb_q} <= '0;
        lptm_q <= '0;
      end
    end
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      crc_q   <= 1'b0;
      mbcrc_q <= '0;
      txcrc_q <= '0;
    end else begin
      crc_q <= !clear_i && (crc_q || tx_ok_i);
      if (tx_ok_i) begin
        mbcrc_q <= cur_idx_i;
        txcrc_q <= crc_i;
      end
    end
  end
endmodule
