// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_flags: what happened: IFLAG, IMASK, the event bits of ESR1, and the interrupt lines
// (flexcan.md 1.4, 1.5, section 5). An event beats a clear in the same clock.

module can_flags #(
  parameter int NumMb = 64,
  /// Derived, do not override.
  localparam int IdxW = $clog2(NumMb)
) (
  input  logic             clk_i,
  input  logic             rst_ni,
  input  logic             clear_i,        // soft reset
  // Events.
  input  logic             flag_i,         // a buffer is done
  input  logic [IdxW-1:0]  flag_idx_i,
  // Rx FIFO: IFLAG1[4:0] are unused then, [5] is the level fifo_avail_i.
  input  logic             fen_i,
  input  logic             fifo_clear_i,
  input  logic             fifo_avail_i,
  input  logic             fifo_warn_i,
  input  logic             fifo_ovf_i,
  input  logic [5:0]       err_i,          // can_pkg::Err* pulses
  input  logic             boff_i,
  input  logic             tx_wrn_i,       // counters at 96 or above
  input  logic             rx_wrn_i,
  input  logic             wrn_en_i,
  // CPU: writes by byte, one group of buffers at a time, and the read that clears the error bits.
  input  logic             iflag_lo_we_i,
  input  logic             iflag_hi_we_i,
  input  logic             imask_lo_we_i,
  input  logic             imask_hi_we_i,
  input  logic             esr_we_i,
  input  logic             esr_rd_i,
  input  logic [3:0]       be_i,
  input  logic [31:0]      wdata_i,
  // Interrupt masks of CTRL1.
  input  logic             boff_msk_i,
  input  logic             err_msk_i,
  input  logic             twrn_msk_i,
  input  logic             rwrn_msk_i,
  output logic [63:0]      iflag_o,
  output logic [63:0]      imask_o,
  output logic [5:0]       esr_err_o,      // ESR1[15:10]
  output logic [3:0]       esr_int_o,      // TWRN_INT, RWRN_INT, BOFF_INT, ERR_INT
  output logic             irq_mb_o,
  output logic             irq_boff_o,
  output logic             irq_err_o,
  output logic             irq_twrn_o,
  output logic             irq_rwrn_o
);
  logic [NumMb-1:0] iflag_q, imask_q;
  always_comb begin
    iflag_o = 64'(iflag_q);
    if (fen_i) iflag_o[5:0] = {fifo_avail_i, 5'b0};
  end
  assign imask_o = 64'(imask_q);

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      iflag_q <= '0;
      imask_q <= '0;
    end else if (clear_i) begin
      iflag_q <= '0;
      imask_q <= '0;
    end else begin
      for (int b = 0; b < NumMb / 8; b++) begin
        if ((b < 4 ? iflag_lo_we_i : iflag_hi_we_i) && be_i[b % 4]) begin
          iflag_q[8*b +: 8] <= iflag_q[8*b +: 8] & ~wdata_i[8*(b % 4) +: 8];
        end
        if ((b < 4 ? imask_lo_we_i : imask_hi_we_i) && be_i[b % 4]) begin
          imask_q[8*b +: 8] <= wdata_i[8*(b % 4) +: 8];
        end
      end
      if (flag_i) iflag_q[flag_idx_i] <= 1'b1;
      if (fifo_warn_i)  iflag_q[6] <= 1'b1;
      if (fifo_ovf_i)   iflag_q[7] <= 1'b1;
      if (fifo_clear_i) iflag_q[7:5] <= '0;
    end
  end

  // Error bits, cleared by the read that returns them.
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni)                       esr_err_o <= '0;
    else if (clear_i)                  esr_err_o <= '0;
    else if (esr_rd_i || err_i != '0)  esr_err_o <= (esr_rd_i ? 6'b0 : esr_err_o) | err_i;
  end

  // Entries into a state; each error counts again (section 7).
  logic boff_q, tx_wrn_q, rx_wrn_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {boff_q, tx_wrn_q, rx_wrn_q} <= '0;
      esr_int_o <= '0;
    end else begin
      boff_q   <= boff_i;
      tx_wrn_q <= tx_wrn_i;
      rx_wrn_q <= rx_wrn_i;
      if (esr_we_i && be_i[2]) esr_int_o[3:2] <= esr_int_o[3:2] & ~wdata_i[17:16];
      if (esr_we_i && be_i[0]) esr_int_o[1:0] <= esr_int_o[1:0] & ~wdata_i[2:1];
      if (tx_wrn_i && !tx_wrn_q && wrn_en_i) esr_int_o[3] <= 1'b1;
      if (rx_wrn_i && !rx_wrn_q && wrn_en_i) esr_int_o[2] <= 1'b1;
      if (boff_i && !boff_q)                 esr_int_o[1] <= 1'b1;
      if (err_i != '0)                       esr_int_o[0] <= 1'b1;
      if (!wrn_en_i) esr_int_o[3:2] <= '0;
      if (clear_i) esr_int_o <= '0;
    end
  end

  // Lines from flip-flops: level, without glitches.
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {irq_mb_o, irq_boff_o, irq_err_o, irq_twrn_o, irq_rwrn_o} <= '0;
    end else begin
      irq_mb_o   <= (iflag_o[NumMb-1:0] & imask_q) != '0;
      irq_twrn_o <= esr_int_o[3] && twrn_msk_i;
      irq_rwrn_o <= esr_int_o[2] && rwrn_msk_i;
      irq_boff_o <= esr_int_o[1] && boff_msk_i;
      irq_err_o  <= esr_int_o[0] && err_msk_i;
    end
  end
endmodule
