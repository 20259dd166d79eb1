// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_top: the whole controller behind a plain native port; the bus wrappers (can_ahb, can_apb,
// can_axil, can_wb) adapt it. Decodes the address and wires registers (can_regs), message buffers
// (can_mailbox) and engine (can_core).
//
// A command (address, direction, byte lanes) is taken in a clock with ready_o = 1. Its data phase
// (wdata_i or rdata_o) ends in the next clock with ready_o = 1: one clock for registers, two for
// what lies in the buffers' RAM and for TIMER.

module can_top #(
  /// Number of message buffers: 16, 32 or 64. The Linux driver uses buffer 63.
  parameter int NumMb = 64,
  /// 1: with the Rx FIFO; 0: without. This and the other features: docs/integration.md.
  parameter int Fifo = 1,
  /// 1: with aborts that are certain of their outcome (MCR.AEN).
  parameter int Abort = 1,
  /// 1: with ESR2 and CRCR.
  parameter int Status = 1,
  /// 1: with a mask for each buffer and the queue of matching buffers (RXIMR, MCR.BCC).
  parameter int OwnMasks = 1,
  /// 1: with stop mode and wake-up.
  parameter int Wake = 1,
  /// 1: with local priority, one-shot, CAN FD tolerance, MAXMB, LBUF, remote answers, TSYN.
  parameter int Extras = 1,
  /// 1: the RAM of the buffers is cleared after a hard reset; 0: software has to clear it.
  parameter int ClearRam = 1,
  /// 1: with the time unit (docs/time.md).
  parameter int TimeUnit = 0,
  /// Increment of the time unit's clock in each clock, after a hard reset: 39:32 ns, 31:0 in 2^-32
  /// ns. The default, 20 ns, is for 50 MHz.
  parameter logic [39:0] TimeInc = 40'h14_0000_0000,
  /// 1: with the follower: the clock follows a master's without the CPU; needs TimeUnit.
  parameter int TimeSync = 0,
  /// Values of the follower's registers TSCTRL, TSID and TSDLY after a hard reset.
  parameter logic [31:0] SyncCtrl = 32'd0,
  parameter logic [31:0] SyncId = 32'd0,
  parameter logic [31:0] SyncDelay = 32'd0,
  /// Clocks for which the bus must be dominant to wake the core if MCR.WAK_SRC = 1, 1 to 255.
  parameter int WakeFilter = 6
) (
  input  logic        clk_i,
  input  logic        rst_ni,
  // Native port, window of 8 KiB.
  input  logic        req_i,           // 1: a command
  input  logic        cancel_i,        // 1: the command is withdrawn; may come late in the clock
  input  logic        we_i,            // 1: write; 0: read
  input  logic [12:2] addr_i,          // word address
  input  logic [3:0]  be_i,            // byte lanes
  input  logic [31:0] wdata_i,         // write data, in all clocks of the data phase
  output logic [31:0] rdata_o,         // 0 except in the data phase of a read: wrappers rely on it
  output logic        ready_o,         // 1: last clock of a data phase, or none; takes a command
  // Interrupt lines, level, active high.
  output logic        irq_o,           // interrupt, level, active high: OR of the six below
  output logic        irq_mb_o,        // interrupt: message buffers, any IFLAG with its IMASK
  output logic        irq_boff_o,      // interrupt: bus-off
  output logic        irq_err_o,       // interrupt: error
  output logic        irq_twrn_o,      // interrupt: transmit warning, TEC has reached 96
  output logic        irq_rwrn_o,      // interrupt: receive warning, REC has reached 96
  output logic        irq_wak_o,       // interrupt: wake-up, the bus has ended stop mode
  // Time unit.
  input  logic        ext_i,           // external event of the time unit, asynchronous
  output logic        time_out_o,      // compare output of the time unit, e.g. a pulse per second
  output logic        irq_time_o,      // interrupt of the time unit, level; not part of irq_o
  // System.
  input  logic        stop_req_i,      // 1: the system requests stop mode; synchronous to clk_i
  output logic        supv_o,          // MCR.SUPV, for the bus wrapper
  // Transceiver and observer.
  input  logic        can_rx_i,        // RXD of the transceiver, asynchronous; 1: recessive
  output logic        can_tx_o,        // TXD of the transceiver, from a flip-flop; 1: recessive
  output logic [can_pkg::TraceWidth-1:0] trace_o  // for observers (can_pkg); leave open otherwise
);
  localparam int IdxW = $clog2(NumMb);
  if (NumMb != 16 && NumMb != 32 && NumMb != 64) begin : gen_check_num_mb
    NumMb_must_be_16_32_or_64 u_stop ();   // no such module: the tool prints the name and stops
  end

  if (((Fifo | Abort | Status | OwnMasks | Wake | Extras | ClearRam | TimeUnit | TimeSync) & ~1)
      != 0)
  begin : gen_check_features
    Fifo_Abort_Status_OwnMasks_Wake_Extras_ClearRam_TimeUnit_TimeSync_must_be_0_or_1 u_stop ();
  end
  if (TimeSync != 0 && TimeUnit == 0) begin : gen_check_time_sync
    TimeSync_needs_TimeUnit u_stop ();
  end
  // Value of XCONFIG.
  localparam logic [31:0] Config = 32'(NumMb)
      | 32'(Fifo)     << can_regs_pkg::XconfigRxfifo   | 32'(Abort)  << can_regs_pkg::XconfigAbort
      | 32'(Status)   << can_regs_pkg::XconfigStatus   | 32'(Wake)   << can_regs_pkg::XconfigWake
      | 32'(OwnMasks) << can_regs_pkg::XconfigOwnmasks | 32'(Extras) << can_regs_pkg::XconfigExtras
      | 32'(Extras)   << can_regs_pkg::XconfigOsmb     | 32'(Extras) << can_regs_pkg::XconfigOneshot
      | 32'(Extras)   << can_regs_pkg::XconfigFdtol
      | 32'(ClearRam) << can_regs_pkg::XconfigClearram
      | 32'(TimeUnit) << can_regs_pkg::XconfigTime
      | 32'(TimeSync) << can_regs_pkg::XconfigTimesync;

  // Buffers, masks, RXFIR, TIMER and stamps are accessed through can_mailbox (to_mb), because they
  // lie in its RAMs or must keep their order with them; all else is in the registers.
  logic       req, in_mb, in_mask, in_gmask, in_timer, in_rxfir, in_stamp, to_mb, wr_ok, frz_ack;
  logic [1:0] mem_sel, word;
  logic [3:0] hi;
  logic [6:0] mb_idx;
  logic [8:0] mask_idx;
  assign req      = req_i && !cancel_i;
  assign hi       = addr_i[10:7] - 4'd1;            // buffers begin at 0x080, masks at 0x880
  assign mb_idx   = {hi, addr_i[6:4]};
  assign mask_idx = {hi, addr_i[6:2]};
  assign in_mb    = addr_i[12:11] == 2'b00 && mb_idx[6:IdxW] == '0;
  assign in_mask  = OwnMasks != 0 && addr_i[12:11] == 2'b01 && mask_idx[8:IdxW] == '0;
  assign in_gmask = addr_i == can_regs_pkg::RxgmaskAddr  || addr_i == can_regs_pkg::Rx14maskAddr
                 || addr_i == can_regs_pkg::Rx15maskAddr
                 || (Fifo != 0 && addr_i == can_regs_pkg::RxfgmaskAddr);
  assign in_timer = addr_i == can_regs_pkg::TimerAddr;
  assign in_rxfir = Fifo != 0 && addr_i == can_regs_pkg::RxfirAddr;
  // Stamps begin at 0x1400, 8 bytes a buffer.
  assign in_stamp = TimeUnit != 0 && addr_i[12:10] == 3'b101 && {1'b0, addr_i[9:3]} < 8'(NumMb);
  assign to_mb    = in_mb || in_mask || in_gmask || in_timer || in_rxfir || in_stamp;
  // Masks are written in freeze mode only.
  assign wr_ok    = in_mb || in_timer || (frz_ack && !in_rxfir);

  // Global masks are hidden rows of the mask memory, or of the MSG memory (can_mb_pkg).
  logic [1:0]      gmask;
  logic [IdxW-1:0] idx;
  assign gmask = {addr_i[3] | addr_i[6], addr_i[2] | addr_i[6]};
  // Decoded from as few address bits as possible: the result is used with to_mb = 1 only.
  always_comb begin
    mem_sel = addr_i[3:2] != 2'd0 ? can_mb_pkg::MemMsg : can_mb_pkg::MemCs;
    word = addr_i[3:2] - 2'd1;
    idx  = mb_idx[IdxW-1:0];
    if (TimeUnit != 0 && addr_i[12]) begin
      mem_sel = can_mb_pkg::MemTimer;
      word = {1'b1, addr_i[2]};
      idx  = addr_i[3 +: IdxW];
    end else if (OwnMasks != 0 && addr_i[11]) begin
      mem_sel = can_mb_pkg::MemMask;
      word = 2'd0;
      idx  = mask_idx[IdxW-1:0];
    end else if (addr_i[10:7] == '0) begin
      mem_sel = in_timer ? can_mb_pkg::MemTimer : can_mb_pkg::MemMask;
      word = OwnMasks == 0 && !in_timer ? can_mb_pkg::GroupMask : 2'd1;
      idx  = OwnMasks == 0 ? IdxW'({gmask, can_mb_pkg::GroupMask}) : IdxW'(gmask);
      if (in_rxfir) begin                     // hidden bits of the C/S word at the FIFO's output
        mem_sel = can_mb_pkg::MemCs;
        word = 2'd1;
        idx  = '0;
      end
    end
  end

  // Registers are the first 32 words of either page, at 0x0000 and 0x1000.
  logic        reg_rd_q, reg_wr_q, in_reg, mb_ready;
  logic [5:0]  reg_addr_q;
  logic [3:0]  reg_be_q;
  logic [31:0] reg_rdata, mb_rdata;
  assign in_reg = addr_i[11:7] == '0 && !to_mb;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {reg_rd_q, reg_wr_q} <= '0;
      reg_addr_q <= '0;
      reg_be_q <= '0;
    end else if (ready_o) begin
      reg_rd_q   <= req && !we_i && in_reg;
      reg_wr_q   <= req && we_i && in_reg;
      reg_addr_q <= {addr_i[12], addr_i[6:2]};
      reg_be_q   <= be_i;
    end
  end
  assign ready_o = mb_ready;
  logic [31:0] time_reg_rdata, sync_reg_rdata;
  assign rdata_o = (reg_rdata | time_reg_rdata | sync_reg_rdata) | mb_rdata;  // the last is late

  // Registers of the time unit, 0x1100 to 0x117F, and of the follower, 0x1180 to 0x11FF.
  logic        in_time, time_rd_q, time_wr_q, in_sync, sync_rd_q, sync_wr_q;
  assign in_time = TimeUnit != 0 && addr_i[12:7] == 6'b100010;
  assign in_sync = TimeSync != 0 && addr_i[12:7] == 6'b100011;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {time_rd_q, time_wr_q, sync_rd_q, sync_wr_q} <= '0;
    end else if (ready_o) begin
      {time_rd_q, time_wr_q} <= {req && !we_i && in_time, req && we_i && in_time};
      {sync_rd_q, sync_wr_q} <= {req && !we_i && in_sync, req && we_i && in_sync};
    end
  end

  // Wires between the blocks, named like their ports.
  logic        run, clear, running, stop_ok, mb_busy, mb_scrub;
  logic        wake, wake_en, rx_level, lpm_ack;
  logic [31:0] mcr, ctrl1, ctrl2, xctrl;
  logic        flag, fifo_clear, fifo_pop, fifo_avail, fifo_warn, fifo_ovf;
  logic [8:0]  esr2;
  logic [21:0] crcr;
  logic [14:0] crc;
  logic [63:0] iflag;
  logic [IdxW-1:0] flag_idx;
  logic [7:0]  tec, rec, rx_byte;
  logic        ec_we, passive, boff;
  logic [15:0] ec_wdata;
  logic [5:0]  err;
  logic        idle, transmitter, receiver, synch, gap, tick_req, tick, timer_clear, timer_we;
  logic [1:0]  timer_be;
  logic [15:0] timer_wdata, timer;
  logic        tx_req, tx_ide, tx_rtr, tx_next, tx_ok, tx_fail;
  logic [3:0]  tx_dlc, rx_dlc;
  logic [31:0] tx_word;
  logic        start, stamp, rx_hdr, rx_ide, rx_srr, rx_rtr, rx_byte_we, rx_valid;
  logic [28:0] rx_id;

  can_regs #(.NumMb(NumMb), .Config(Config)) u_regs (
    .clk_i, .rst_ni,
    .rd_i(reg_rd_q), .wr_i(reg_wr_q), .addr_i({reg_addr_q[5], 5'b0, reg_addr_q[4:0]}),
    .be_i(reg_be_q), .wdata_i, .rdata_o(reg_rdata),
    .run_o(run), .clear_o(clear), .frz_ack_o(frz_ack), .lpm_ack_o(lpm_ack),
    .mb_busy_i(mb_busy), .mb_scrub_i(mb_scrub),
    .stop_req_i(stop_req_i && Wake != 0), .wake_i(wake), .wake_en_o(wake_en),
    .mcr_o(mcr), .ctrl1_o(ctrl1), .ctrl2_o(ctrl2), .xctrl_o(xctrl),
    .flag_i(flag), .flag_idx_i(flag_idx), .iflag_o(iflag),
    .esr2_i(esr2), .crcr_i(crcr),
    .fifo_clear_o(fifo_clear), .fifo_pop_o(fifo_pop), .fifo_avail_i(fifo_avail),
    .fifo_warn_i(fifo_warn), .fifo_ovf_i(fifo_ovf),
    .ec_we_o(ec_we), .ec_wdata_o(ec_wdata), .running_i(running), .stop_ok_i(stop_ok),
    .tec_i(tec), .rec_i(rec), .passive_i(passive), .boff_i(boff), .err_i(err),
    .idle_i(idle), .transmitter_i(transmitter), .receiver_i(receiver), .synch_i(synch),
    .irq_o, .irq_mb_o, .irq_boff_o, .irq_err_o, .irq_twrn_o, .irq_rwrn_o, .irq_wak_o);
  assign supv_o = mcr[can_regs_pkg::McrSupv];

  // Registers of the time unit; what moves with every clock is in can_core.
  logic [can_pkg::TimeCmdWidth-1:0]  time_cmd;
  logic [can_pkg::TimeStatWidth-1:0] time_stat;
  logic [63:0] time_data, time_now, time_ext, time_stamp;
  logic [31:0] time_left, tctrl, tcmph, ttx;
  logic [5:0]  time_mb;
  logic        time_stamp_we, time_stamp_tx, time_wait;
  if (TimeUnit != 0) begin : gen_time
    can_time_regs u_time_regs (
      .clk_i, .rst_ni,
      .ask_i(req && !we_i && ready_o && addr_i[12:2] == can_regs_pkg::TimeloAddr),
      .rd_i(time_rd_q), .wr_i(time_wr_q), .addr_i(reg_addr_q[4:0]), .be_i(reg_be_q), .wdata_i,
      .rdata_o(time_reg_rdata),
      .cmd_o(time_cmd), .data_o(time_data), .now_i(time_now), .ext_i(time_ext),
      .left_i(time_left),
      .tctrl_o(tctrl), .tcmph_o(tcmph), .ttx_o(ttx), .stat_i(time_stat), .mb_o(time_mb),
      .pin_i(ext_i), .time_out_o, .irq_o(irq_time_o));
  end else begin : gen_no_time
    assign {time_cmd, time_data, tctrl, tcmph, ttx, time_mb} = '0;
    assign {time_reg_rdata, time_out_o, irq_time_o} = '0;
    logic unused_time;
    assign unused_time = &{1'b0, ext_i, time_rd_q, time_wr_q, time_stat, time_now, time_ext,
      time_left};
  end

  logic [31:0] sync_ctrl, sync_id, sync_stat, sync_ofs;
  logic [23:0] sync_delay;
  if (TimeSync != 0) begin : gen_sync
    can_time_sync_regs #(
      .SyncCtrl(SyncCtrl), .SyncId(SyncId), .SyncDelay(SyncDelay)
    ) u_sync_regs (
      .clk_i, .rst_ni, .rd_i(sync_rd_q), .wr_i(sync_wr_q), .addr_i(reg_addr_q[4:0]),
      .be_i(reg_be_q), .wdata_i, .rdata_o(sync_reg_rdata),
      .ctrl_o(sync_ctrl), .id_o(sync_id), .delay_o(sync_delay), .stat_i(sync_stat),
      .ofs_i(sync_ofs));
  end else begin : gen_no_sync
    assign {sync_reg_rdata, sync_ctrl, sync_id, sync_delay} = '0;
    logic unused_sync;
    assign unused_sync = &{1'b0, sync_rd_q, sync_wr_q, sync_stat, sync_ofs};
  end

  if (Wake != 0) begin : gen_wake
    can_wake #(.FilterClocks(WakeFilter)) u_wake (
      .clk_i, .rst_ni, .enable_i(wake_en), .filter_i(mcr[can_regs_pkg::McrWakSrc]),
      .rx_i(rx_level), .wake_o(wake));
  end else begin : gen_no_wake
    logic unused;
    assign unused = &{1'b0, rx_level};
    assign wake   = 1'b0;
  end

  can_mailbox #(
    .NumMb(NumMb), .Fifo(Fifo), .Abort(Abort), .Status(Status), .OwnMasks(OwnMasks),
    .ClearRam(ClearRam), .TimeUnit(TimeUnit)
  ) u_mailbox (
    .clk_i, .rst_ni,
    .running_i(running), .lpm_i(lpm_ack), .clear_i(clear),
    .mcr_i(mcr), .ctrl1_i(ctrl1), .ctrl2_i(ctrl2), .xctrl_i(xctrl), .fifo_clear_i(fifo_clear),
    .fifo_pop_i(fifo_pop), .fifo_avail_o(fifo_avail), .fifo_warn_o(fifo_warn),
    .fifo_ovf_o(fifo_ovf), .iflag_i(iflag), .esr2_o(esr2), .crcr_o(crcr),
    .busy_o(mb_busy), .scrub_o(mb_scrub),
    .cmd_rd_i(req && !we_i && to_mb), .cmd_wr_i(req && we_i && to_mb && wr_ok),
    .cmd_mem_sel_i(mem_sel), .cmd_word_i(word), .cmd_idx_i(idx),
    .cmd_mb_i(mb_idx[IdxW-1:0]), .cmd_be_i(be_i),
    .wdata_i, .ready_o(mb_ready), .rdata_o(mb_rdata), .flag_o(flag), .flag_idx_o(flag_idx),
    .tick_req_o(tick_req), .tick_i(tick),
    .timer_clear_o(timer_clear), .timer_we_o(timer_we), .timer_be_o(timer_be),
    .timer_wdata_o(timer_wdata), .timer_i(timer), .transmitter_i(transmitter),
    .mute_i(boff || ctrl1[can_regs_pkg::Ctrl1Lom]), .gap_i(gap), .crc_i(crc),
    .tx_req_o(tx_req), .tx_ide_o(tx_ide), .tx_rtr_o(tx_rtr), .tx_dlc_o(tx_dlc), .tx_word_o(tx_word),
    .tx_next_i(tx_next), .tx_ok_i(tx_ok), .tx_fail_i(tx_fail),
    .start_i(start), .stamp_i(stamp), .rx_hdr_i(rx_hdr), .rx_id_i(rx_id), .rx_ide_i(rx_ide),
    .rx_srr_i(rx_srr),
    .rx_rtr_i(rx_rtr), .rx_dlc_i(rx_dlc), .rx_byte_we_i(rx_byte_we), .rx_byte_i(rx_byte),
    .rx_valid_i(rx_valid), .time_stamp_i(time_stamp), .time_stamp_we_i(time_stamp_we),
    .time_stamp_tx_i(time_stamp_tx), .time_held_i(time_stat[can_pkg::TimeStatHeld]),
    .time_mb_i(time_mb), .time_wait_o(time_wait));

  can_core #(.TimeUnit(TimeUnit), .TimeInc(TimeInc), .TimeSync(TimeSync)) u_core (
    .clk_i, .rst_ni,
    .run_i(run), .running_o(running), .stop_ok_o(stop_ok), .gap_o(gap), .crc_o(crc),
    .presdiv_i(ctrl1[can_regs_pkg::Ctrl1Presdiv +: can_regs_pkg::Ctrl1PresdivW]),
    .rjw_i(ctrl1[can_regs_pkg::Ctrl1Rjw +: can_regs_pkg::Ctrl1RjwW]),
    .pseg1_i(ctrl1[can_regs_pkg::Ctrl1Pseg1 +: can_regs_pkg::Ctrl1Pseg1W]),
    .pseg2_i(ctrl1[can_regs_pkg::Ctrl1Pseg2 +: can_regs_pkg::Ctrl1Pseg2W]),
    .propseg_i(ctrl1[can_regs_pkg::Ctrl1Propseg +: can_regs_pkg::Ctrl1PropsegW]),
    .smp_i(ctrl1[can_regs_pkg::Ctrl1Smp]), .lom_i(ctrl1[can_regs_pkg::Ctrl1Lom]),
    .lpb_i(ctrl1[can_regs_pkg::Ctrl1Lpb]), .fd_tolerant_i(xctrl[can_regs_pkg::XctrlFdtol]),
    .boff_rec_i(ctrl1[can_regs_pkg::Ctrl1BoffRec]),
    .ec_clear_i(clear), .ec_we_i(ec_we), .ec_wdata_i(ec_wdata),
    .tec_o(tec), .rec_o(rec), .passive_o(passive), .boff_o(boff), .err_o(err),
    .idle_o(idle), .transmitter_o(transmitter), .receiver_o(receiver), .synch_o(synch),
    .tick_req_i(tick_req), .tick_o(tick), .rx_req_i(wake_en), .rx_level_o(rx_level),
    .timer_clear_i(timer_clear), .timer_we_i(timer_we), .timer_be_i(timer_be),
    .timer_wdata_i(timer_wdata), .timer_o(timer),
    .tx_req_i(tx_req), .tx_ide_i(tx_ide), .tx_rtr_i(tx_rtr), .tx_dlc_i(tx_dlc), .tx_word_i(tx_word),
    .tx_next_o(tx_next), .tx_ok_o(tx_ok), .tx_fail_o(tx_fail),
    .start_o(start), .stamp_o(stamp), .rx_hdr_o(rx_hdr), .rx_id_o(rx_id), .rx_ide_o(rx_ide),
    .rx_srr_o(rx_srr),
    .rx_rtr_o(rx_rtr), .rx_dlc_o(rx_dlc), .rx_byte_we_o(rx_byte_we), .rx_byte_o(rx_byte),
    .rx_valid_o(rx_valid),
    .time_cmd_i(time_cmd), .time_data_i(time_data), .time_now_o(time_now),
    .time_ext_o(time_ext), .time_left_o(time_left),
    .time_tctrl_i(tctrl), .time_tcmph_i(tcmph), .time_ttx_i(ttx),
    .time_wait_i(time_wait), .time_stat_o(time_stat), .time_stamp_o(time_stamp),
    .time_stamp_we_o(time_stamp_we), .time_stamp_tx_o(time_stamp_tx),
    .time_sync_ctrl_i(sync_ctrl), .time_sync_id_i(sync_id), .time_sync_delay_i(sync_delay),
    .time_sync_stat_o(sync_stat), .time_sync_ofs_o(sync_ofs),
    .can_rx_i, .can_tx_o, .trace_o);
endmodule
