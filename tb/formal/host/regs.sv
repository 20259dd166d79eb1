  // SPDX-FileCopyrightText: 2026 The VeriCAN authors
  // SPDX-License-Identifier: Apache-2.0
  //
  // Properties of can_regs, spliced into it: what flexcan.md 1 says of every register; the masks
  // below are typed from its tables, not taken from the package that the RTL uses.

  logic f_ran;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) f_ran <= 1'b0;
    else         f_ran <= 1'b1;
  end

  // Bits that may read 1, by offset; RAM and TIMER are not here.
  logic [31:0] f_readable;
  always_comb begin
    case ({19'd0, addr_i, 2'b00})
      32'h000: f_readable = 32'hFFFF_337F;
      32'h004: f_readable = 32'hFFFF_FCFF;
      32'h01C: f_readable = 32'h0000_FFFF;
      32'h020: f_readable = 32'h0007_FFFF;
      32'h024, 32'h02C: f_readable = NumMb > 32 ? 32'hFFFF_FFFF : 32'd0;
      32'h028, 32'h030: f_readable = NumMb > 16 ? 32'hFFFF_FFFF : 32'h0000_FFFF;
      32'h034: f_readable = 32'h1FFF_0000;
      32'h038: f_readable = 32'h007F_6000;
      32'h044: f_readable = 32'h007F_7FFF;
      32'h1000, 32'h1004, 32'h1008: f_readable = 32'hFFFF_FFFF;
      32'h100C: f_readable = 32'h0000_0007;
      default: f_readable = 32'd0;
    endcase
  end

  // Registers of plain storage: which bits are written in freeze mode only.
  logic [31:0] f_mcr_rw, f_mcr_f, f_lanes;
  assign f_mcr_rw = 32'h0444_0000;   // WAK_MSK, SLF_WAK, DOZE: any time
  assign f_mcr_f  = 32'h20AB_337F;   // flexcan.md 1.1, column F
  assign f_lanes  = {{8{be_i[3]}}, {8{be_i[2]}}, {8{be_i[1]}}, {8{be_i[0]}}};
  logic f_wr_mcr, f_wr_ctrl1, f_wr_ctrl2, f_wr_xctrl;
  assign f_wr_mcr   = wr_i && addr_i == 11'h000;
  assign f_wr_ctrl1 = wr_i && addr_i == 11'h001;
  assign f_wr_ctrl2 = wr_i && addr_i == 11'h00D;
  assign f_wr_xctrl = wr_i && addr_i == 11'h403;

  always @(posedge clk_i) begin
    m_reset: assume (rst_ni == !$initstate);
    if (rst_ni) begin
      // flexcan.md 1: reserved bits and reserved offsets read 0.
      p_reserved: assert ((rdata_o & ~f_readable) == '0);
      // flexcan.md 5: the common line is the OR of all others.
      p_all: assert (irq_o == (irq_mb_o || irq_boff_o || irq_err_o || irq_twrn_o || irq_rwrn_o
                               || irq_wak_o));
      // FX-MCR.NOT_RDY, FX-MCR.FRZ_ACK, FX-MCR.LPM_ACK: MCR shows the acknowledges.
      p_mcr_acks: assert (!(rd_i && addr_i == 11'h000)
                          || {rdata_o[27], rdata_o[24], rdata_o[20]}
                             == {lpm_ack_o || frz_ack_o, frz_ack_o, lpm_ack_o});
      // FX-MCR.WRN_EN: without it CTRL1[11:10] read 0.
      p_warning_masks: assert (!(rd_i && addr_i == 11'h001 && !mcr_q[21])
                               || rdata_o[11:10] == 2'b00);
      // flexcan.md 1.3: ECR is written in freeze mode only, the bytes that were not written stay.
      p_ecr: assert (!ec_we_o || (frz_ack_o && wr_i && addr_i == 11'h007
                     && (be_i[0] || ec_wdata_o[7:0] == tec_i)
                     && (be_i[1] || ec_wdata_o[15:8] == rec_i)));
      // flexcan.md 4: a frame leaves the FIFO by a 1 written to IFLAG1[5] only.
      p_pop: assert (fifo_pop_o == (mcr_q[29] && wr_i && addr_i == 11'h00C && be_i[0]
                                    && wdata_i[5]));
      if (f_ran) begin
        // flexcan.md 1.1: bits of column F change in freeze mode only, or by a soft reset.
        p_mcr_freeze: assert (((mcr_q ^ $past(mcr_q)) & f_mcr_f) == '0
                              || $past(clear_o || (f_wr_mcr && frz_ack_o)));
        // flexcan.md 1.1: nothing of MCR changes but by a write of it or a soft reset.
        p_mcr_kept: assert ({mcr_q, mdis_q, frz_q, halt_q} == $past({mcr_q, mdis_q, frz_q, halt_q})
                            || $past(clear_o || f_wr_mcr));
        // flexcan.md 1.1: in freeze mode what is written is what is there.
        p_mcr_written: assert (!$past(f_wr_mcr && frz_ack_o && be_i == '1 && !wdata_i[25])
                               || (mcr_q & (f_mcr_f | f_mcr_rw))
                                  == ($past(wdata_i) & (f_mcr_f | f_mcr_rw)));
        // FX-MCR.SOFT_RST: a soft reset leaves MDIS and asks for freeze; the zeros written with it
        // do not count.
        p_soft_reset: assert (!$past(clear_o || (f_wr_mcr && be_i[3] && wdata_i[25] && frz_ack_o))
                              || (frz_q && halt_q));
        // FX-MCR.MDIS: MDIS changes by a write only.
        p_mdis: assert (mdis_q == $past(mdis_q) || $past(f_wr_mcr && be_i[3]));
        // flexcan.md 1.2: bit timing, LPB, SMP, TSYN, LBUF, LOM change in freeze mode only.
        p_ctrl1_freeze: assert (((ctrl1_q ^ $past(ctrl1_q)) & 32'hFFFF_10BF) == '0
                                || $past(f_wr_ctrl1 && frz_ack_o));
        // flexcan.md 1.2: CLK_SRC in disable mode only.
        p_clk_src: assert (ctrl1_q[13] == $past(ctrl1_q[13]) || $past(f_wr_ctrl1 && disabled));
        // flexcan.md 1.2: the masks and BOFF_REC at any time, in their byte.
        p_ctrl1_any: assert (!$past(f_wr_ctrl1)
            || (ctrl1_q & 32'h0000_C040) == ((($past(wdata_i) & $past(f_lanes))
                | ($past(ctrl1_q) & ~$past(f_lanes))) & 32'h0000_C040));
        // flexcan.md 1.6: CTRL2 changes in freeze mode only, not by a soft reset.
        p_ctrl2: assert (ctrl2 == $past(ctrl2) || $past(f_wr_ctrl2 && frz_ack_o));
        // flexcan.md 1.2: the extension's XCTRL changes by a write only ...
        p_xctrl: assert (xctrl == $past(xctrl) || $past(f_wr_xctrl));
        // flexcan.md 1.2: ... and FDTOL in it in freeze mode only.
        p_fdtol: assert (xctrl[0] == $past(xctrl[0]) || $past(f_wr_xctrl && frz_ack_o));
        // FX-MCR.FEN: every change of FEN empties the FIFO.
        p_fen: assert (mcr_q[29] == $past(mcr_q[29]) || fifo_clear_o);
        // FX-MCR.SLF_WAK: not written in stop mode.
        p_slf_wak: assert (!$past(in_stop && !clear_o) || mcr_q[22] == $past(mcr_q[22]));
      end
    end
  end
