// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_flags: the events that software sees: IFLAG, IMASK, the event bits of ESR1, and the interrupt
// lines (flexcan.md 1.4, 1.5 and section 5). An event beats a clear by software in the same clock,
// so that none is lost. Flags that end with a write of FEN or WRN_EN read 0 from the next clock on.

module can_flags #(
  parameter int NumMb = 64,
  /// Derived, do not override.
  localparam int IdxW = $clog2(NumMb)
) (
  input  logic             clk_i,
  input  logic             rst_ni,
  input  logic             clear_i,        // pulse: soft reset
  // Events.
  input  logic             flag_i,         // pulse: sets IFLAG of buffer flag_idx_i
  input  logic [IdxW-1:0]  flag_idx_i,
  // Rx FIFO; with FEN = 1 IFLAG1[4:0] read 0.
  input  logic             fen_i,          // MCR.FEN
  input  logic             fifo_clear_i,   // pulse: FEN changes, or soft reset: clears IFLAG1[7:5]
  input  logic             fifo_avail_i,   // 1: a frame is at the output; IFLAG1[5] if FEN = 1
  input  logic             fifo_warn_i,    // pulse: the fill rises from 4 to 5; sets IFLAG1[6]
  input  logic             fifo_ovf_i,     // pulse: a frame was lost; sets IFLAG1[7]
  input  logic [5:0]       err_i,          // pulses, can_pkg::Err*
  input  logic             boff_i,         // 1: bus-off
  input  logic             tx_wrn_i,       // 1: the transmit error counter is at 96 or above
  input  logic             rx_wrn_i,       // 1: the receive error counter is at 96 or above
  input  logic             wrn_en_i,       // MCR.WRN_EN
  input  logic             wake_i,         // pulse: the bus has ended stop mode
  // CPU accesses (can_regs), in the clock in which they take effect; writes by byte.
  input  logic             iflag_lo_we_i,  // 1: write of IFLAG1
  input  logic             iflag_hi_we_i,  // 1: write of IFLAG2
  input  logic             imask_lo_we_i,  // 1: write of IMASK1
  input  logic             imask_hi_we_i,  // 1: write of IMASK2
  input  logic             esr1_we_i,      // 1: write of ESR1
  input  logic             esr1_rd_i,      // 1: read of ESR1 that clears its error bits
  input  logic [3:0]       be_i,
  input  logic [31:0]      wdata_i,
  // Interrupt masks, from CTRL1 and MCR.
  input  logic             boff_msk_i,
  input  logic             err_msk_i,
  input  logic             twrn_msk_i,
  input  logic             rwrn_msk_i,
  input  logic             wak_msk_i,
  output logic [63:0]      iflag_o,
  output logic [63:0]      imask_o,
  output logic [31:0]      esr1_o,         // event bits of ESR1, in their places; the others are 0
  output logic             irq_mb_o,       // any IFLAG with its IMASK
  output logic             irq_boff_o,     // BOFF_INT with BOFF_MSK
  output logic             irq_err_o,      // ERR_INT with ERR_MSK
  output logic             irq_twrn_o,     // TWRN_INT with TWRN_MSK
  output logic             irq_rwrn_o,     // RWRN_INT with RWRN_MSK
  output logic             irq_wak_o       // WAK_INT with WAK_MSK
);
  logic [NumMb-1:0] iflag_q, imask_q;
  always_comb begin
    iflag_o = 64'(iflag_q);
    if (fifo_clear_i) iflag_o[7:5] = '0;
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
      if (fifo_warn_i)  iflag_q[can_regs_pkg::Iflag1FifoWarning]  <= 1'b1;
      if (fifo_ovf_i)   iflag_q[can_regs_pkg::Iflag1FifoOverflow] <= 1'b1;
      if (fifo_clear_i) iflag_q[7:5] <= '0;
    end
  end

  // Error bits, cleared by the read that returns them.
  logic [5:0] errors_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni)                        errors_q <= '0;
    else if (clear_i)                   errors_q <= '0;
    else if (esr1_rd_i || err_i != '0)  errors_q <= (esr1_rd_i ? 6'b0 : errors_q) | err_i;
  end

  // Flags of entries into a state. ERR_INT is set by each error, even if its error bit is set
  // already (flexcan.md section 7).
  logic boff_q, tx_wrn_q, rx_wrn_q, twrn_int_q, rwrn_int_q, boff_int_q, err_int_q, wak_int_q;
  logic [31:0] w1c;
  assign w1c = esr1_we_i ? wdata_i & {{8{be_i[3]}}, {8{be_i[2]}}, {8{be_i[1]}}, {8{be_i[0]}}} : '0;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {boff_q, tx_wrn_q, rx_wrn_q} <= '0;
      {twrn_int_q, rwrn_int_q, boff_int_q, err_int_q, wak_int_q} <= '0;
    end else begin
      boff_q   <= boff_i;
      tx_wrn_q <= tx_wrn_i;
      rx_wrn_q <= rx_wrn_i;
      if (w1c[can_regs_pkg::Esr1TwrnInt]) twrn_int_q <= 1'b0;
      if (w1c[can_regs_pkg::Esr1RwrnInt]) rwrn_int_q <= 1'b0;
      if (w1c[can_regs_pkg::Esr1BoffInt]) boff_int_q <= 1'b0;
      if (w1c[can_regs_pkg::Esr1ErrInt])  err_int_q  <= 1'b0;
      if (w1c[can_regs_pkg::Esr1WakInt])  wak_int_q  <= 1'b0;
      if (tx_wrn_i && !tx_wrn_q) twrn_int_q <= 1'b1;
      if (rx_wrn_i && !rx_wrn_q) rwrn_int_q <= 1'b1;
      if (boff_i && !boff_q)     boff_int_q <= 1'b1;
      if (err_i != '0)           err_int_q  <= 1'b1;
      if (wake_i)                wak_int_q  <= 1'b1;
      if (!wrn_en_i) {twrn_int_q, rwrn_int_q} <= '0;
      if (clear_i)   {twrn_int_q, rwrn_int_q, boff_int_q, err_int_q, wak_int_q} <= '0;
    end
  end

  always_comb begin
    esr1_o = '0;
    esr1_o[can_regs_pkg::Esr1TwrnInt] = twrn_int_q && wrn_en_i;
    esr1_o[can_regs_pkg::Esr1RwrnInt] = rwrn_int_q && wrn_en_i;
    esr1_o[can_regs_pkg::Esr1Bit1Err] = errors_q[can_pkg::ErrBit1];
    esr1_o[can_regs_pkg::Esr1Bit0Err] = errors_q[can_pkg::ErrBit0];
    esr1_o[can_regs_pkg::Esr1AckErr]  = errors_q[can_pkg::ErrAck];
    esr1_o[can_regs_pkg::Esr1CrcErr]  = errors_q[can_pkg::ErrCrc];
    esr1_o[can_regs_pkg::Esr1FrmErr]  = errors_q[can_pkg::ErrForm];
    esr1_o[can_regs_pkg::Esr1StfErr]  = errors_q[can_pkg::ErrStuff];
    esr1_o[can_regs_pkg::Esr1BoffInt] = boff_int_q;
    esr1_o[can_regs_pkg::Esr1ErrInt]  = err_int_q;
    esr1_o[can_regs_pkg::Esr1WakInt]  = wak_int_q;
  end

  // The lines are levels from flip-flops, so they have no glitches.
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {irq_mb_o, irq_boff_o, irq_err_o, irq_twrn_o, irq_rwrn_o, irq_wak_o} <= '0;
    end else begin
      irq_mb_o   <= (iflag_o[NumMb-1:0] & imask_q) != '0;
      irq_twrn_o <= twrn_int_q && wrn_en_i && twrn_msk_i;
      irq_rwrn_o <= rwrn_int_q && wrn_en_i && rwrn_msk_i;
      irq_boff_o <= boff_int_q && boff_msk_i;
      irq_err_o  <= err_int_q && err_msk_i;
      irq_wak_o  <= wak_int_q && wak_msk_i;
    end
  end
endmodule
