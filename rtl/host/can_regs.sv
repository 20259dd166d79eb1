// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_regs: MCR, CTRL1, CTRL2, ECR, ESR1, ESR2, CRCR, IMASK, IFLAG and the extension page
// (flexcan.md section 1); what needs no RAM. Reserved offsets read 0 and ignore writes.

module can_regs #(
  parameter int NumMb = 64,
  /// Derived, do not override.
  localparam int IdxW = $clog2(NumMb)
) (
  input  logic            clk_i,
  input  logic            rst_ni,
  // CPU, in the data phase; always ready. addr_i counts words.
  input  logic            rd_i,
  input  logic            wr_i,
  input  logic [10:0]     addr_i,
  input  logic [3:0]      be_i,
  input  logic [31:0]     wdata_i,
  output logic [31:0]     rdata_o,
  // Mode.
  output logic            run_o,
  output logic            clear_o,
  output logic            frz_ack_o,
  input  logic            mb_busy_i,
  input  logic            mb_scrub_i,
  // Configuration of the buffers.
  output logic            bcc_o,
  output logic            srx_dis_o,
  output logic            lbuf_o,
  output logic            tsyn_o,
  output logic            lprio_en_o,
  output logic            aen_o,
  output logic            eacen_o,
  output logic            rrs_o,
  output logic            oneshot_o,
  output logic            osmb_o,        // bit 28 of a Tx buffer's C/S word asks for one shot
  output logic [6:0]      maxmb_o,
  input  logic            flag_i,
  input  logic [IdxW-1:0] flag_idx_i,
  output logic [63:0]     iflag_o,
  input  logic [8:0]      esr2_i,        // LPTM, VPS, IMB
  input  logic [21:0]     crcr_i,        // MBCRC, TXCRC
  // Rx FIFO.
  output logic            fen_o,
  output logic [1:0]      idam_o,
  output logic [3:0]      rffn_o,
  output logic            mrp_o,
  output logic            fifo_clear_o,  // pulse: FEN changes, or soft reset
  output logic            fifo_pop_o,    // pulse: the CPU is done with the frame at the output
  input  logic            fifo_avail_i,  // level: a frame is at the output
  input  logic            fifo_warn_i,   // pulse: almost full
  input  logic            fifo_ovf_i,    // pulse: a frame was lost
  // Configuration and state of the engine, see can_core.
  output logic [7:0]      presdiv_o,
  output logic [1:0]      rjw_o,
  output logic [2:0]      pseg1_o,
  output logic [2:0]      pseg2_o,
  output logic [2:0]      propseg_o,
  output logic            smp_o,
  output logic            lom_o,
  output logic            lpb_o,
  output logic            fd_tolerant_o,
  output logic            boff_rec_o,
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
  // Interrupt lines, level.
  output logic            irq_o,
  output logic            irq_mb_o,
  output logic            irq_boff_o,
  output logic            irq_err_o,
  output logic            irq_twrn_o,
  output logic            irq_rwrn_o
);
  // Word offsets.
  localparam logic [10:0] Mcr     = 11'h000;
  localparam logic [10:0] Ctrl    = 11'h001;
  localparam logic [10:0] Ecr     = 11'h007;
  localparam logic [10:0] Esr     = 11'h008;
  localparam logic [10:0] Imask2  = 11'h009;
  localparam logic [10:0] Imask1  = 11'h00A;
  localparam logic [10:0] Iflag2  = 11'h00B;
  localparam logic [10:0] Iflag1  = 11'h00C;
  localparam logic [10:0] Ctrl2   = 11'h00D;
  localparam logic [10:0] Esr2    = 11'h00E;
  localparam logic [10:0] Crcr    = 11'h011;
  localparam logic [10:0] ExtId   = 11'h400;
  localparam logic [10:0] ExtVer  = 11'h401;
  localparam logic [10:0] ExtConf = 11'h402;
  localparam logic [10:0] ExtCtrl = 11'h403;

  // MCR: mode requests.
  logic mdis_q, frz_q, halt_q, soft_rst, soft_rst_busy, lpm_ack;
  logic mcr_we, ctrl_we;
  assign mcr_we   = wr_i && addr_i == Mcr;
  assign ctrl_we  = wr_i && addr_i == Ctrl;
  assign soft_rst = mcr_we && be_i[3] && wdata_i[25] && !lpm_ack && !soft_rst_busy;

  can_mode u_mode (
    .clk_i, .rst_ni,
    .mdis_i(mdis_q), .freeze_i(frz_q && halt_q), .soft_rst_i(soft_rst),
    .running_i, .stop_ok_i, .transmitter_i, .busy_i(mb_busy_i), .scrub_i(mb_scrub_i),
    .run_o, .clear_o, .lpm_ack_o(lpm_ack), .frz_ack_o, .soft_rst_o(soft_rst_busy));

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {mdis_q, frz_q, halt_q} <= '1;
    end else begin
      if (mcr_we && be_i[3] && !soft_rst_busy)
        {mdis_q, frz_q, halt_q} <= {wdata_i[31:30], wdata_i[28]};
      if (soft_rst) {frz_q, halt_q} <= '1;   // beats the zeros written with it
    end
  end

  // MCR: wake-up and doze, written at any time.
  logic wak_msk_q, slf_wak_q, doze_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {wak_msk_q, slf_wak_q, doze_q} <= '0;
    end else if (clear_o) begin
      {wak_msk_q, slf_wak_q, doze_q} <= '0;
    end else if (mcr_we && !soft_rst && !soft_rst_busy) begin
      if (be_i[3]) wak_msk_q <= wdata_i[26];
      if (be_i[2]) {slf_wak_q, doze_q} <= {wdata_i[22], wdata_i[18]};
    end
  end

  // MCR: the rest, written in freeze mode only.
  logic supv_q, wrn_en_q, wak_src_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {supv_q, fen_o, wrn_en_q, wak_src_q, srx_dis_o, bcc_o} <= {1'b1, 5'b0};
      {lprio_en_o, aen_o, idam_o, maxmb_o} <= {4'b0, 7'h0F};
    end else if (clear_o) begin
      {supv_q, fen_o, wrn_en_q, wak_src_q, srx_dis_o, bcc_o} <= {1'b1, 5'b0};
      {lprio_en_o, aen_o, idam_o, maxmb_o} <= {4'b0, 7'h0F};
    end else if (mcr_we && frz_ack_o && !soft_rst) begin
      if (be_i[3]) fen_o <= wdata_i[29];
      if (be_i[2]) begin
        {supv_q, wrn_en_q} <= {wdata_i[23], wdata_i[21]};
        {wak_src_q, srx_dis_o, bcc_o} <= {wdata_i[19], wdata_i[17:16]};
      end
      if (be_i[1]) {lprio_en_o, aen_o, idam_o} <= {wdata_i[13:12], wdata_i[9:8]};
      if (be_i[0]) maxmb_o <= wdata_i[6:0];
    end
  end

  logic fen_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) fen_q <= 1'b0;
    else         fen_q <= fen_o;
  end
  assign fifo_clear_o = clear_o || fen_q != fen_o;

  // CTRL2: freeze mode only.
  logic       wrmfrz_q;
  logic [4:0] tasd_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {wrmfrz_q, rffn_o, mrp_o, rrs_o, eacen_o} <= '0;
      tasd_q <= 5'd22;
    end else if (wr_i && addr_i == Ctrl2 && frz_ack_o) begin
      if (be_i[3]) {wrmfrz_q, rffn_o} <= wdata_i[28:24];
      if (be_i[2]) {tasd_q, mrp_o, rrs_o, eacen_o} <= wdata_i[23:16];
    end
  end

  // CTRL1: interrupt masks and BOFF_REC at any time, CLK_SRC in disable mode, the rest in freeze
  // mode.
  logic boff_msk_q, err_msk_q, clk_src_q, twrn_msk_q, rwrn_msk_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {boff_msk_q, err_msk_q, clk_src_q, twrn_msk_q, rwrn_msk_q, boff_rec_o} <= '0;
      {presdiv_o, rjw_o, pseg1_o, pseg2_o, lpb_o, smp_o, tsyn_o, lbuf_o, lom_o, propseg_o} <= '0;
    end else begin
      if (ctrl_we && be_i[1]) begin
        {boff_msk_q, err_msk_q} <= wdata_i[15:14];
        if (wrn_en_q)  {twrn_msk_q, rwrn_msk_q} <= wdata_i[11:10];
        if (lpm_ack)   clk_src_q <= wdata_i[13];
        if (frz_ack_o) lpb_o <= wdata_i[12];
      end
      if (ctrl_we && be_i[0]) begin
        boff_rec_o <= wdata_i[6];
        if (frz_ack_o) begin
          smp_o <= wdata_i[7];
          {tsyn_o, lbuf_o, lom_o, propseg_o} <= wdata_i[5:0];
        end
      end
      if (ctrl_we && frz_ack_o) begin
        if (be_i[2]) {rjw_o, pseg1_o, pseg2_o} <= wdata_i[23:16];
        if (be_i[3]) presdiv_o <= wdata_i[31:24];
      end
    end
  end

  // Extension page.
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {osmb_o, oneshot_o, fd_tolerant_o} <= '0;
    end else if (wr_i && addr_i == ExtCtrl && be_i[0]) begin
      {osmb_o, oneshot_o} <= wdata_i[2:1];
      if (frz_ack_o) fd_tolerant_o <= wdata_i[0];
    end
  end

  // A 1 written to IFLAG1[5] takes the frame at the output out of the FIFO (section 4).
  assign fifo_pop_o = fen_o && wr_i && addr_i == Iflag1 && be_i[0] && wdata_i[5];

  // ECR.
  assign ec_we_o    = wr_i && addr_i == Ecr && frz_ack_o;
  assign ec_wdata_o = {be_i[1] ? wdata_i[15:8] : rec_i, be_i[0] ? wdata_i[7:0] : tec_i};

  // Events.
  logic        tx_wrn, rx_wrn;
  logic [63:0] imask;
  logic [5:0]  esr_err;
  logic [3:0]  esr_int;
  assign tx_wrn = tec_i >= 8'd96 && !boff_i;
  assign rx_wrn = rec_i >= 8'd96 && !boff_i;
  can_flags #(.NumMb(NumMb)) u_flags (
    .clk_i, .rst_ni, .clear_i(clear_o), .flag_i, .flag_idx_i, .err_i, .boff_i,
    .fen_i(fen_o), .fifo_clear_i(fifo_clear_o), .fifo_avail_i, .fifo_warn_i, .fifo_ovf_i,
    .tx_wrn_i(tx_wrn), .rx_wrn_i(rx_wrn), .wrn_en_i(wrn_en_q),
    .iflag_lo_we_i(wr_i && addr_i == Iflag1), .iflag_hi_we_i(wr_i && addr_i == Iflag2),
    .imask_lo_we_i(wr_i && addr_i == Imask1), .imask_hi_we_i(wr_i && addr_i == Imask2),
    .esr_we_i(wr_i && addr_i == Esr), .esr_rd_i(rd_i && addr_i == Esr && be_i[1]), .be_i, .wdata_i,
    .boff_msk_i(boff_msk_q), .err_msk_i(err_msk_q),
    .twrn_msk_i(twrn_msk_q && wrn_en_q), .rwrn_msk_i(rwrn_msk_q && wrn_en_q),
    .iflag_o, .imask_o(imask), .esr_err_o(esr_err), .esr_int_o(esr_int),
    .irq_mb_o, .irq_boff_o, .irq_err_o, .irq_twrn_o, .irq_rwrn_o);
  assign irq_o = irq_mb_o || irq_boff_o || irq_err_o || irq_twrn_o || irq_rwrn_o;

  // Reads.
  logic [1:0] flt_conf;
  // listen-only reads as passive (2.4)
  assign flt_conf = boff_i ? 2'b10 : {1'b0, passive_i || lom_o};
  always_comb begin
    rdata_o = '0;
    if (rd_i) begin
      case (addr_i)
        Mcr:  rdata_o = {mdis_q, frz_q, fen_o, halt_q, lpm_ack || frz_ack_o, wak_msk_q,
                         soft_rst_busy, frz_ack_o,
                         supv_q, slf_wak_q, wrn_en_q, lpm_ack, wak_src_q, doze_q, srx_dis_o, bcc_o,
                         2'b00, lprio_en_o, aen_o, 2'b00, idam_o, 1'b0, maxmb_o};
        Ctrl: rdata_o = {presdiv_o, rjw_o, pseg1_o, pseg2_o,
                         boff_msk_q, err_msk_q, clk_src_q, lpb_o,
                         twrn_msk_q && wrn_en_q, rwrn_msk_q && wrn_en_q, 2'b00,
                         smp_o, boff_rec_o, tsyn_o, lbuf_o, lom_o, propseg_o};
        Ecr:  rdata_o = {16'b0, rec_i, tec_i};
        Esr:  rdata_o = {13'b0, synch_i, esr_int[3:2], esr_err, tx_wrn, rx_wrn,
                         idle_i, transmitter_i, flt_conf, receiver_i, esr_int[1:0], 1'b0};
        Imask2:  rdata_o = imask[63:32];
        Imask1:  rdata_o = imask[31:0];
        Iflag2:  rdata_o = iflag_o[63:32];
        Iflag1:  rdata_o = iflag_o[31:0];
        Ctrl2:   rdata_o = {3'b0, wrmfrz_q, rffn_o, tasd_q, mrp_o, rrs_o, eacen_o, 16'b0};
        Esr2:    rdata_o = {9'b0, esr2_i[8:2], 1'b0, esr2_i[1:0], 13'b0};
        Crcr:    rdata_o = {9'b0, crcr_i[21:15], 1'b0, crcr_i[14:0]};
        ExtId:   rdata_o = 32'h5643_414E;               // "VCAN"
        ExtVer:  rdata_o = 32'h0001_0000;               // 1.0
        ExtConf: rdata_o = {22'b0, 2'b11, 8'(NumMb)};   // 8: FD tolerance, 9: one-shot
        ExtCtrl: rdata_o = {29'b0, osmb_o, oneshot_o, fd_tolerant_o};
        default: ;
      endcase
    end
  end
endmodule
