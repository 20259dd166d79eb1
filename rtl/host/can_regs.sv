// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_regs: the registers that are not in the buffers' RAM: MCR, CTRL1, CTRL2, ECR, ESR1, ESR2,
// CRCR, IMASK, IFLAG (flexcan.md section 1) and the extension page, on the host side of can_core
// and can_mailbox. can_mode has the modes, can_flags the events. Reserved offsets read 0 and ignore
// writes.

module can_regs #(
  parameter int NumMb = 64,
  /// Value of XCONFIG: the features of this core.
  parameter logic [31:0] Config = can_regs_pkg::XconfigReset | 32'd64,
  /// Derived, do not override.
  localparam int IdxW = $clog2(NumMb)
) (
  input  logic            clk_i,
  input  logic            rst_ni,
  // CPU access: its data phase, one clock, never a wait state.
  input  logic            rd_i,          // 1: register addr_i is read, rdata_o is valid
  input  logic            wr_i,          // 1: register addr_i is written
  input  logic [10:0]     addr_i,        // word address
  input  logic [3:0]      be_i,
  input  logic [31:0]     wdata_i,
  output logic [31:0]     rdata_o,       // read data; 0 if rd_i = 0
  // Mode, see can_mode.
  output logic            run_o,         // 1: the engine is to take part in the bus
  output logic            clear_o,       // pulse: soft reset
  output logic            frz_ack_o,     // 1: freeze mode
  output logic            lpm_ack_o,     // 1: disable or stop mode
  input  logic            stop_req_i,    // 1: the system requests stop mode
  input  logic            wake_i,        // pulse: the bus ends stop mode (can_wake)
  output logic            wake_en_o,     // 1: the bus may end stop mode
  input  logic            mb_busy_i,     // 1: moves, ends or aborts are outstanding (can_mailbox)
  input  logic            mb_scrub_i,    // 1: the buffer RAMs are being cleared
  // Configuration, by the fields of can_regs_pkg. mcr_o lacks mode requests and acknowledges.
  output logic [31:0]     mcr_o,
  output logic [31:0]     ctrl1_o,
  output logic [31:0]     ctrl2_o,
  output logic [31:0]     xctrl_o,
  // Flags and status of the buffers, see can_mailbox.
  input  logic            flag_i,        // pulse: sets IFLAG of buffer flag_idx_i
  input  logic [IdxW-1:0] flag_idx_i,
  output logic [63:0]     iflag_o,
  input  logic [8:0]      esr2_i,        // {LPTM, VPS, IMB}
  input  logic [21:0]     crcr_i,        // {MBCRC, TXCRC}
  // Rx FIFO.
  output logic            fifo_clear_o,  // pulse: FEN changes, or soft reset
  output logic            fifo_pop_o,    // pulse: the CPU is done with the frame at the output
  input  logic            fifo_avail_i,  // 1: a frame is at the output
  input  logic            fifo_warn_i,   // pulse: the fill rises from 4 to 5
  input  logic            fifo_ovf_i,    // pulse: a frame was lost
  // State of the engine, see can_core.
  output logic            ec_we_o,
  output logic [15:0]     ec_wdata_o,
  input  logic            running_i,
  input  logic            stop_ok_i,
  input  logic [7:0]      tec_i,
  input  logic [7:0]      rec_i,
  input  logic            passive_i,
  input  logic            boff_i,
  input  logic [5:0]      err_i,
  input  logic            idle_i,
  input  logic            transmitter_i,
  input  logic            receiver_i,
  input  logic            synch_i,
  // Interrupt lines, level, active high; irq_o is the OR of the others.
  output logic            irq_o,
  output logic            irq_mb_o,
  output logic            irq_boff_o,
  output logic            irq_err_o,
  output logic            irq_twrn_o,
  output logic            irq_rwrn_o,
  output logic            irq_wak_o
);
  logic [31:0] ctrl1, ctrl2, xctrl;

  // MCR: mode requests.
  logic mdis_q, frz_q, halt_q, soft_rst, soft_rst_busy, disabled, in_stop, mcr_we;
  assign mcr_we   = wr_i && addr_i == can_regs_pkg::McrAddr && !soft_rst_busy;
  assign soft_rst = mcr_we && be_i[3] && wdata_i[can_regs_pkg::McrSoftRst] && !lpm_ack_o;

  can_mode u_mode (
    .clk_i, .rst_ni,
    .mdis_i(mdis_q), .freeze_i(frz_q && halt_q), .soft_rst_i(soft_rst), .stop_req_i, .wake_i,
    .running_i, .stop_ok_i, .transmitter_i, .busy_i(mb_busy_i), .scrub_i(mb_scrub_i),
    .run_o, .clear_o, .lpm_ack_o, .frz_ack_o, .soft_rst_o(soft_rst_busy),
    .disabled_o(disabled), .stop_o(in_stop));

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {mdis_q, frz_q, halt_q} <= '1;
    end else begin
      if (mcr_we && be_i[3]) begin
        mdis_q <= wdata_i[can_regs_pkg::McrMdis];
        frz_q  <= wdata_i[can_regs_pkg::McrFrz];
        halt_q <= wdata_i[can_regs_pkg::McrHalt];
      end
      if (soft_rst || clear_o) {frz_q, halt_q} <= '1;   // beats the zeros written with it
    end
  end

  // The rest of MCR. SLF_WAK cannot be changed in stop mode (flexcan.md 1.1).
  localparam logic [31:0] ModeRequests = (32'd1 << can_regs_pkg::McrMdis)
                                       | (32'd1 << can_regs_pkg::McrFrz)
                                       | (32'd1 << can_regs_pkg::McrHalt);
  logic [31:0] mcr_q, mcr_wdata;
  logic        wrn_en;
  always_comb begin
    mcr_wdata = wdata_i;
    if (in_stop) mcr_wdata[can_regs_pkg::McrSlfWak] = mcr_q[can_regs_pkg::McrSlfWak];
  end
  can_reg #(
    .Reset(can_regs_pkg::McrReset), .SoftReset(1'b1),
    .Any(can_regs_pkg::McrAny & ~ModeRequests), .Freeze(can_regs_pkg::McrFreeze),
    .Has(can_regs_pkg::mcr_has(Config)), .Without(can_regs_pkg::mcr_without(Config))
  ) u_mcr (
    .clk_i, .rst_ni, .clear_i(clear_o), .frz_ack_i(frz_ack_o), .lpm_ack_i(lpm_ack_o),
    .wrn_en_i(wrn_en), .we_i(mcr_we && !soft_rst), .be_i, .wdata_i(mcr_wdata), .value_o(mcr_q));
  assign mcr_o     = mcr_q;
  assign wake_en_o = mcr_q[can_regs_pkg::McrSlfWak] && in_stop;
  assign wrn_en    = mcr_q[can_regs_pkg::McrWrnEn];

  logic fen, fen_q;
  assign fen = mcr_q[can_regs_pkg::McrFen];
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) fen_q <= 1'b0;
    else         fen_q <= fen;
  end
  assign fifo_clear_o = clear_o || fen_q != fen;

  // CTRL1. With WRN_EN = 0 the warning masks read as 0 and act so, whatever is stored.
  logic [31:0] ctrl1_q;
  can_reg #(
    .Reset(can_regs_pkg::Ctrl1Reset), .Any(can_regs_pkg::Ctrl1Any),
    .Freeze(can_regs_pkg::Ctrl1Freeze), .Disable(can_regs_pkg::Ctrl1Disable),
    .WrnEn(can_regs_pkg::Ctrl1WrnEn), .Has(can_regs_pkg::ctrl1_has(Config))
  ) u_ctrl1 (
    .clk_i, .rst_ni, .clear_i(clear_o), .frz_ack_i(frz_ack_o), .lpm_ack_i(disabled),
    .wrn_en_i(wrn_en), .we_i(wr_i && addr_i == can_regs_pkg::Ctrl1Addr), .be_i, .wdata_i,
    .value_o(ctrl1_q));
  assign ctrl1   = wrn_en ? ctrl1_q : ctrl1_q & ~can_regs_pkg::Ctrl1WrnEn;
  assign ctrl1_o = ctrl1;

  // CTRL2.
  can_reg #(
    .Reset(can_regs_pkg::Ctrl2Reset), .Freeze(can_regs_pkg::Ctrl2Freeze),
    .Has(can_regs_pkg::ctrl2_has(Config)), .Without(can_regs_pkg::ctrl2_without(Config))
  ) u_ctrl2 (
    .clk_i, .rst_ni, .clear_i(clear_o), .frz_ack_i(frz_ack_o), .lpm_ack_i(lpm_ack_o),
    .wrn_en_i(wrn_en), .we_i(wr_i && addr_i == can_regs_pkg::Ctrl2Addr), .be_i, .wdata_i,
    .value_o(ctrl2));
  assign ctrl2_o = ctrl2;

  // Extension page.
  can_reg #(
    .Reset(can_regs_pkg::XctrlReset), .Any(can_regs_pkg::XctrlAny),
    .Freeze(can_regs_pkg::XctrlFreeze), .Has(can_regs_pkg::xctrl_has(Config))
  ) u_xctrl (
    .clk_i, .rst_ni, .clear_i(clear_o), .frz_ack_i(frz_ack_o), .lpm_ack_i(lpm_ack_o),
    .wrn_en_i(wrn_en), .we_i(wr_i && addr_i == can_regs_pkg::XctrlAddr), .be_i, .wdata_i,
    .value_o(xctrl));
  assign xctrl_o = xctrl;

  // A 1 written to IFLAG1[5] takes the frame at the output out of the Rx FIFO (flexcan.md section
  // 4).
  assign fifo_pop_o = fen && wr_i && addr_i == can_regs_pkg::Iflag1Addr && be_i[0]
                   && wdata_i[can_regs_pkg::Iflag1FifoAvailable];

  // ECR.
  assign ec_we_o    = wr_i && addr_i == can_regs_pkg::EcrAddr && frz_ack_o;
  assign ec_wdata_o = {be_i[1] ? wdata_i[15:8] : rec_i, be_i[0] ? wdata_i[7:0] : tec_i};

  // Events and their interrupts.
  logic        tx_wrn, rx_wrn, esr1_at;
  logic [31:0] events;
  logic [63:0] imask;
  // Warning level: 96 or above. In bus-off TEC counts recovery sequences instead (BO-06).
  assign tx_wrn  = (tec_i[7] || (&tec_i[6:5])) && !boff_i;
  assign rx_wrn  = rec_i[7] || (&rec_i[6:5]);
  assign esr1_at = addr_i == can_regs_pkg::Esr1Addr;
  can_flags #(.NumMb(NumMb)) u_flags (
    .clk_i, .rst_ni, .clear_i(clear_o), .flag_i, .flag_idx_i,
    .err_i, .boff_i,
    .fen_i(fen), .fifo_clear_i(fifo_clear_o), .fifo_avail_i, .fifo_warn_i, .fifo_ovf_i,
    .tx_wrn_i(tx_wrn), .rx_wrn_i(rx_wrn), .wrn_en_i(wrn_en),
    .iflag_lo_we_i(wr_i && addr_i == can_regs_pkg::Iflag1Addr),
    .iflag_hi_we_i(wr_i && addr_i == can_regs_pkg::Iflag2Addr),
    .imask_lo_we_i(wr_i && addr_i == can_regs_pkg::Imask1Addr),
    .imask_hi_we_i(wr_i && addr_i == can_regs_pkg::Imask2Addr),
    .esr1_we_i(wr_i && esr1_at), .esr1_rd_i(rd_i && esr1_at && be_i[1]), .be_i, .wdata_i,
    .boff_msk_i(ctrl1[can_regs_pkg::Ctrl1BoffMsk]), .err_msk_i(ctrl1[can_regs_pkg::Ctrl1ErrMsk]),
    .twrn_msk_i(ctrl1[can_regs_pkg::Ctrl1TwrnMsk]), .rwrn_msk_i(ctrl1[can_regs_pkg::Ctrl1RwrnMsk]),
    .wake_i, .wak_msk_i(mcr_q[can_regs_pkg::McrWakMsk]),
    .iflag_o, .imask_o(imask), .esr1_o(events),
    .irq_mb_o, .irq_boff_o, .irq_err_o, .irq_twrn_o, .irq_rwrn_o, .irq_wak_o);
  assign irq_o = irq_mb_o || irq_boff_o || irq_err_o || irq_twrn_o || irq_rwrn_o || irq_wak_o;

  // Reads. ESR1 shows listen-only mode as error passive (flexcan.md 2.4).
  always_comb begin
    rdata_o = '0;
    if (rd_i) begin
      case (addr_i)
        can_regs_pkg::McrAddr: begin
          rdata_o = mcr_q;
          rdata_o[can_regs_pkg::McrMdis]    = mdis_q;
          rdata_o[can_regs_pkg::McrFrz]     = frz_q;
          rdata_o[can_regs_pkg::McrHalt]    = halt_q;
          rdata_o[can_regs_pkg::McrNotRdy]  = lpm_ack_o || frz_ack_o;
          rdata_o[can_regs_pkg::McrSoftRst] = soft_rst_busy;
          rdata_o[can_regs_pkg::McrFrzAck]  = frz_ack_o;
          rdata_o[can_regs_pkg::McrLpmAck]  = lpm_ack_o;
        end
        can_regs_pkg::Ctrl1Addr:    rdata_o = ctrl1;
        can_regs_pkg::EcrAddr: begin
          rdata_o[can_regs_pkg::EcrRxerr +: can_regs_pkg::EcrRxerrW] = rec_i;
          rdata_o[can_regs_pkg::EcrTxerr +: can_regs_pkg::EcrTxerrW] = tec_i;
        end
        can_regs_pkg::Esr1Addr: begin
          rdata_o = events;
          rdata_o[can_regs_pkg::Esr1Synch] = synch_i;
          rdata_o[can_regs_pkg::Esr1TxWrn] = tx_wrn;
          rdata_o[can_regs_pkg::Esr1RxWrn] = rx_wrn;
          rdata_o[can_regs_pkg::Esr1Idle]  = idle_i;
          rdata_o[can_regs_pkg::Esr1Tx]    = transmitter_i;
          rdata_o[can_regs_pkg::Esr1FltConf +: can_regs_pkg::Esr1FltConfW] =
              boff_i ? 2'b10 : {1'b0, passive_i || ctrl1[can_regs_pkg::Ctrl1Lom]};
          rdata_o[can_regs_pkg::Esr1Rx]    = receiver_i;
        end
        can_regs_pkg::Imask2Addr:   rdata_o = imask[63:32];
        can_regs_pkg::Imask1Addr:   rdata_o = imask[31:0];
        can_regs_pkg::Iflag2Addr:   rdata_o = iflag_o[63:32];
        can_regs_pkg::Iflag1Addr:   rdata_o = iflag_o[31:0];
        can_regs_pkg::Ctrl2Addr:    rdata_o = ctrl2;
        can_regs_pkg::Esr2Addr: begin
          rdata_o[can_regs_pkg::Esr2Lptm +: can_regs_pkg::Esr2LptmW] = esr2_i[8:2];
          rdata_o[can_regs_pkg::Esr2Vps] = esr2_i[1];
          rdata_o[can_regs_pkg::Esr2Imb] = esr2_i[0];
        end
        can_regs_pkg::CrcrAddr: begin
          rdata_o[can_regs_pkg::CrcrMbcrc +: can_regs_pkg::CrcrMbcrcW] = crcr_i[21:15];
          rdata_o[can_regs_pkg::CrcrTxcrc +: can_regs_pkg::CrcrTxcrcW] = crcr_i[14:0];
        end
        can_regs_pkg::XidAddr:      rdata_o = can_regs_pkg::XidReset;
        can_regs_pkg::XversionAddr: rdata_o = can_regs_pkg::XversionReset;
        can_regs_pkg::XconfigAddr:  rdata_o = Config;
        can_regs_pkg::XctrlAddr:    rdata_o = xctrl;
        default: ;
      endcase
    end
  end
endmodule
