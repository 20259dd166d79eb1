// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_mailbox: the message buffers, between the registers (can_top) and the engine (can_core).
// Wires the RAMs and their arbiter (can_mb_port, can_mb_step) to the CPU's side (can_mb_cpu,
// can_mb_lock, can_mb_guard), to reception (can_mb_smb, can_mb_match, can_mb_move) and to
// transmission (can_mb_tx, can_mb_load). How a frame passes: docs/architecture.md; rules:
// flexcan.md sections 3 and 4.

module can_mailbox #(
  /// Message buffers: 16, 32 or 64.
  parameter int NumMb = 64,
  /// Features, see can_top.
  parameter int Fifo = 1,
  parameter int Abort = 1,
  parameter int Status = 1,
  parameter int OwnMasks = 1,
  parameter int ClearRam = 1,
  parameter int TimeUnit = 0,
  /// Derived, do not override.
  localparam int IdxW = $clog2(NumMb)
) (
  input  logic            clk_i,
  input  logic            rst_ni,
  // Mode and configuration.
  input  logic            running_i,     // 1: the engine takes part in the bus
  input  logic            lpm_i,         // 1: disable or stop mode, no move begins
  input  logic            clear_i,       // pulse: soft reset
  input  logic [31:0]     mcr_i,         // registers, by the fields of can_regs_pkg
  input  logic [31:0]     ctrl1_i,
  input  logic [31:0]     ctrl2_i,
  input  logic [31:0]     xctrl_i,
  // Rx FIFO, see can_regs.
  input  logic            fifo_clear_i,  // pulse: soft reset, or FEN changes
  input  logic            fifo_pop_i,    // pulse: the CPU is done with the frame at the output
  output logic            fifo_avail_o,  // 1: a frame is at the output
  output logic            fifo_warn_o,   // pulse: the fill rises from 4 to 5
  output logic            fifo_ovf_o,    // pulse: a frame was lost
  output logic            busy_o,        // 1: moves, ends or aborts are outstanding, or scrub_o = 1
  output logic            scrub_o,       // 1: the RAMs are being cleared after a hard reset
  // CPU access, see can_mb_port.
  input  logic            cmd_rd_i,
  input  logic            cmd_wr_i,
  input  logic [1:0]      cmd_mem_sel_i,
  input  logic [1:0]      cmd_word_i,
  input  logic [IdxW-1:0] cmd_idx_i,     // row: a buffer, or a global mask
  input  logic [IdxW-1:0] cmd_mb_i,      // buffer, if the command is of a C/S word; known earlier
  input  logic [3:0]      cmd_be_i,
  input  logic [31:0]     wdata_i,       // write data, in both clocks of the access
  output logic            ready_o,       // 1: last clock of an access, or none; takes a command
  output logic [31:0]     rdata_o,       // read data with ready_o = 1; 0 if no read ends
  // Flags and status registers.
  input  logic [63:0]     iflag_i,       // IFLAG, see can_flags
  output logic [8:0]      esr2_o,        // {LPTM, VPS, IMB}
  output logic [21:0]     crcr_o,        // {MBCRC, TXCRC}
  output logic            flag_o,        // pulse: set IFLAG of buffer flag_idx_o
  output logic [IdxW-1:0] flag_idx_o,
  // Engine, see can_core.
  output logic            tick_req_o,
  input  logic            tick_i,
  output logic            timer_clear_o,
  output logic            timer_we_o,
  output logic [1:0]      timer_be_o,
  output logic [15:0]     timer_wdata_o,
  input  logic [15:0]     timer_i,
  input  logic            transmitter_i, // 1: this node is the transmitter of the frame
  input  logic            mute_i,        // 1: the engine starts no frame (bus-off, listen-only)
  input  logic            gap_i,         // 1: no frame on the bus; an own one may begin any time
  output logic            tx_req_o,
  output logic            tx_ide_o,
  output logic            tx_rtr_o,
  output logic [3:0]      tx_dlc_o,
  output logic [31:0]     tx_word_o,
  input  logic            tx_next_i,
  input  logic            tx_ok_i,
  input  logic            tx_fail_i,
  input  logic [14:0]     crc_i,
  input  logic            start_i,
  input  logic            stamp_i,
  input  logic            rx_hdr_i,
  input  logic [28:0]     rx_id_i,
  input  logic            rx_ide_i,
  input  logic            rx_srr_i,
  input  logic            rx_rtr_i,
  input  logic [3:0]      rx_dlc_i,
  input  logic            rx_byte_we_i,
  input  logic [7:0]      rx_byte_i,
  input  logic            rx_valid_i,
  // Stamp of the frame on the bus, see can_time.
  input  logic [63:0]     time_stamp_i,
  input  logic            time_stamp_we_i,
  input  logic            time_stamp_tx_i,
  // Launch time (TM-40), see can_time.
  input  logic            time_held_i,   // 1: buffer time_mb_i is held
  input  logic [5:0]      time_mb_i,
  output logic            time_wait_o    // 1: the presented frame is that of buffer time_mb_i
);
  // Flags of buffers that do not exist, and fields that other blocks use.
  logic unused;
  assign unused = &{1'b0, iflag_i, mcr_i, ctrl1_i, ctrl2_i, xctrl_i};

  // Configuration that more than one block uses.
  logic       bcc, aen, fen;
  logic [3:0] rffn;
  logic [6:0] maxmb;
  assign bcc   = mcr_i[can_regs_pkg::McrBcc];
  assign aen   = mcr_i[can_regs_pkg::McrAen];
  assign fen   = mcr_i[can_regs_pkg::McrFen];
  assign maxmb = mcr_i[can_regs_pkg::McrMaxmb +: can_regs_pkg::McrMaxmbW];
  assign rffn  = ctrl2_i[can_regs_pkg::Ctrl2Rffn +: can_regs_pkg::Ctrl2RffnW];

  // First buffer that is a mailbox: 8 + 2 * RFFN with the Rx FIFO, to which those below belong.
  // The lock and frames that wait do not outlast its change: their rows may belong to the table.
  logic [6:0] first, first_now;
  logic       drop;
  assign first_now = fen ? {1'b0, 5'(rffn) + 5'd4, 1'b0} : 7'd0;
  assign drop      = fifo_clear_i || first != first_now;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) first <= '0;
    else         first <= first_now;
  end

  // CPU accesses and their side effects.
  logic            rd_done, rd_end, wr, wr_done, block, if_ended, ring;
  logic            rxfir, area, cs_rd, timer_rd, cpu_busy;
  logic [1:0]      cpu_mem_sel;
  logic [IdxW-1:0] cpu_idx, row_idx;
  logic [3:0]      cpu_be, cs_rd_code, ld_code;
  logic            rd_word;
  logic [31:0]     rd_other, ram_wdata, cs, msg, mask, word;
  logic            cs_written, cs_written_act;
  logic [IdxW-1:0] cs_written_idx;
  logic            mv_busy_mb, mv_flag, mv_waits;
  logic [IdxW-1:0] mv_idx, mv_waits_idx;
  logic [2:0]      fifo_head;
  can_mb_cpu #(.NumMb(NumMb), .Fifo(Fifo), .TimeUnit(TimeUnit)) u_cpu (
    .clk_i, .rst_ni, .scrub_i(scrub_o), .running_i, .fen_i(fen), .aen_i(aen),
    .osmb_i(xctrl_i[can_regs_pkg::XctrlOsmb]), .first_i(first_now), .head_i(fifo_head),
    .rd_done_i(rd_done), .wr_done_i(wr_done), .block_i(block), .if_ended_i(if_ended),
    .ended_i(cs[can_mb_pkg::CsEnded]),
    .mem_sel_i(cpu_mem_sel),
    .rxfir_i(rxfir), .idx_i(cpu_idx), .be3_i(cpu_be[3]), .wdata_i,
    .rd_word_i(rd_word), .word_i(word), .other_i(rd_other),
    .ram_code_i(cs[can_regs_pkg::MbCsCode +: can_regs_pkg::MbCsCodeW]),
    .end_i(rd_end), .end_code_i(ld_code), .timer_i,
    .moving_i(mv_busy_mb), .mv_idx_i(mv_idx),
    .row_idx_o(row_idx), .area_o(area), .ring_o(ring), .wdata_o(ram_wdata), .rdata_o,
    .timer_rd_o(timer_rd), .timer_wr_o(timer_we_o),
    .cs_rd_o(cs_rd), .cs_rd_code_o(cs_rd_code), .busy_o(cpu_busy),
    .cs_written_o(cs_written), .cs_written_idx_o(cs_written_idx),
    .cs_written_act_o(cs_written_act));

  // TSYN (flexcan.md 2.10): TIMER is cleared when the first mailbox receives a frame. mv_first_q is
  // compared a clock early, which is safe because mv_idx does not change during a move.
  logic mv_first_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) mv_first_q <= 1'b0;
    else         mv_first_q <= 7'(mv_idx) == first;
  end
  assign timer_clear_o = clear_i || (ctrl1_i[can_regs_pkg::Ctrl1Tsyn] && mv_flag && mv_first_q);
  assign timer_be_o    = cpu_be[1:0];
  logic unused_be;   // the byte of IDE, RTR and DLC alone makes no difference
  assign unused_be     = cpu_be[2];
  assign timer_wdata_o = wdata_i[15:0];

  logic            lock, serviced_req, serviced_ovr, serviced_gnt;
  logic [IdxW-1:0] lock_idx, serviced_idx;
  can_mb_lock #(.NumMb(NumMb)) u_lock (
    .clk_i, .rst_ni, .clear_i(drop), .bcc_i(bcc),
    .cs_rd_i(cs_rd), .timer_rd_i(timer_rd), .idx_i(cpu_idx), .be3_i(cpu_be[3]),
    .code_i(cs_rd_code),
    .serviced_i(cs[can_mb_pkg::CsServiced]), .busy_i(cpu_busy),
    .cs_written_i(cs_written), .cs_written_idx_i(cs_written_idx),
    .lock_o(lock), .lock_idx_o(lock_idx),
    .serviced_req_o(serviced_req), .serviced_idx_o(serviced_idx), .serviced_ovr_o(serviced_ovr),
    .serviced_gnt_i(serviced_gnt));

  // Reception.
  logic            stale, id_stale, rx_req, rx_gnt, match_done, hit, hit_fifo, hit_ans, resolve;
  logic            stored;
  logic [IdxW-1:0] rx_idx, hit_idx;
  logic [1:0]      rx_word;
  logic            rx_cs, eng_cs;
  logic [IdxW:0]   rx_mask_row;
  logic [8:0]      idhit;
  logic [1:0]      fifo_in_flight;
  can_mb_match #(
    .NumMb(NumMb), .Fifo(Fifo), .OwnMasks(OwnMasks), .ClearRam(ClearRam)
  ) u_match (
    .clk_i, .rst_ni, .clear_i(fifo_clear_i), .bcc_i(bcc),
    .eacen_i(ctrl2_i[can_regs_pkg::Ctrl2Eacen]), .rrs_i(ctrl2_i[can_regs_pkg::Ctrl2Rrs]),
    .maxmb_i(maxmb), .fen_i(fen),
    .idam_i(mcr_i[can_regs_pkg::McrIdam +: can_regs_pkg::McrIdamW]), .rffn_i(rffn),
    .mrp_i(ctrl2_i[can_regs_pkg::Ctrl2Mrp]), .first_i(first),
    .rx_hdr_i, .rx_id_i, .rx_ide_i, .rx_rtr_i,
    .lock_i(lock), .lock_idx_i(lock_idx), .waits_i(mv_waits), .waits_idx_i(mv_waits_idx),
    .cs_written_i(cs_written), .cs_written_idx_i(cs_written_idx),
    .wr_i(wr && !wr_done), .wr_idx_i(cpu_idx),
    .req_o(rx_req), .idx_o(rx_idx), .word_o(rx_word), .cs_o(rx_cs),
    .mask_row_o(rx_mask_row), .gnt_i(rx_gnt),
    .stale_i(stale || id_stale), .cs_i(cs), .msg_i(msg), .mask_i(mask),
    .data_i(word), .done_o(match_done), .hit_o(hit), .hit_idx_o(hit_idx), .hit_fifo_o(hit_fifo),
    .hit_ans_o(hit_ans), .resolve_i(resolve), .stored_i(stored), .fifo_in_flight_i(fifo_in_flight),
    .idhit_o(idhit),
    .pop_i(fifo_pop_i), .head_o(fifo_head), .avail_o(fifo_avail_o), .warn_o(fifo_warn_o),
    .ovf_o(fifo_ovf_o));

  // Stamps.
  logic            stamp_busy, stamp_re, stamp_cpu, stamp_shown, mine;
  logic [IdxW:0]   stamp_row;
  logic [IdxW+1:0] scrub_row;
  logic [31:0]     stamp_rdata;

  logic            smb, ld_row, rx_wr_req, rx_wr_gnt, rx_wr_cs, flags_busy;
  logic [3:0]      rx_wr_be;
  logic [IdxW+1:0] rx_wr_row;
  logic [31:0]     rx_wr_data;
  can_mb_smb #(.NumMb(NumMb)) u_smb (
    .clk_i, .rst_ni, .smb_i(smb), .tx_row_i(!ld_row), .timer_i,
    .start_i, .stamp_i, .transmitter_i, .rx_hdr_i, .rx_id_i, .rx_ide_i, .rx_srr_i, .rx_rtr_i,
    .rx_dlc_i,
    .rx_byte_we_i, .rx_byte_i, .rx_valid_i,
    .req_o(rx_wr_req), .cs_o(rx_wr_cs), .be_o(rx_wr_be), .row_o(rx_wr_row), .data_o(rx_wr_data),
    .gnt_i(rx_wr_gnt),
    .flags_busy_o(flags_busy));

  logic       mv_req, mv_row, mv_data, mv_cancel, mv_busy, moving, ans, mv_answer;
  logic [1:0] mv_step;
  logic [8:0] mv_top;
  can_mb_move #(.NumMb(NumMb)) u_move (
    .clk_i, .rst_ni, .clear_i(drop), .start_i, .rx_hdr_i,
    .valid_i(rx_valid_i && !(transmitter_i && mcr_i[can_regs_pkg::McrSrxDis])),
    .hold_i(flags_busy || serviced_req || lpm_i || stamp_busy),
    .smb_o(smb),
    .match_done_i(match_done), .hit_i(hit), .hit_idx_i(hit_idx), .hit_fifo_i(hit_fifo),
    .hit_ans_i(hit_ans), .idhit_i(idhit), .resolve_o(resolve),
    .waits_o(mv_waits), .waits_idx_o(mv_waits_idx),
    .lock_i(lock), .lock_idx_i(lock_idx),
    .cs_written_i(cs_written), .cs_written_idx_i(cs_written_idx), .cpu_idx_i(cpu_idx),
    .req_o(mv_req), .step_o(mv_step), .row_o(mv_row), .idx_o(mv_idx),
    .data_i(mv_data), .cs_i(cs), .top_o(mv_top), .cancel_o(mv_cancel),
    .moving_o(moving), .busy_mb_o(mv_busy_mb), .answer_o(mv_answer), .flag_o(mv_flag),
    .stored_o(stored),
    .fifo_in_flight_o(fifo_in_flight), .ans_o(ans),
    .busy_o(mv_busy));

  // Transmission.
  logic            sent, held, ins_req, ins_gnt, scan_req, scan_lazy, scan_gnt, settled, retry;
  logic            retry_busy, inactive;
  logic            started, off;
  logic [IdxW-1:0] ins_idx, scan_idx, best_idx, cur_idx;
  logic            pass, pass_end, seen, seen_worst, seen_free;
  logic [IdxW-1:0] seen_idx;
  assign held        = time_held_i && {1'b0, time_mb_i} < 7'(NumMb);
  assign time_wait_o = TimeUnit != 0 && time_mb_i == 6'(cur_idx);
  can_mb_tx #(.NumMb(NumMb), .Status(Status)) u_tx (
    .clk_i, .rst_ni, .running_i, .lbuf_i(ctrl1_i[can_regs_pkg::Ctrl1Lbuf]),
    .lprio_en_i(mcr_i[can_regs_pkg::McrLprioEn]), .first_i(first), .maxmb_i(maxmb),
    .cs_written_i(cs_written), .cs_written_idx_i(cs_written_idx),
    .cs_written_act_i(cs_written_act), .ans_i(ans), .ans_idx_i(mv_idx),
    .off_i(off), .cur_idx_i(cur_idx), .start_i(started), .retry_i(retry), .sent_i(sent),
    .inactive_i(inactive),
    .held_i(held), .held_idx_i(time_mb_i[IdxW-1:0]),
    .fresh_i(timer_i[9:0] == '0),
    .ins_req_o(ins_req), .ins_idx_o(ins_idx), .ins_gnt_i(ins_gnt),
    .scan_req_o(scan_req), .scan_lazy_o(scan_lazy), .scan_idx_o(scan_idx),
    .scan_gnt_i(scan_gnt), .stale_i(stale), .cs_i(cs), .id_i(msg),
    .settled_o(settled), .best_idx_o(best_idx), .retry_o(retry_busy),
    .pass_o(pass), .pass_end_o(pass_end), .seen_o(seen), .seen_idx_o(seen_idx),
    .seen_worst_o(seen_worst), .seen_free_o(seen_free));

  logic            eng_slot, flight;
  logic            ld_req, ld_word, ld_data, ld_cancel, ld_flag, ld_take, ld_busy;
  logic            out, done, abort, ab_flag;
  logic [IdxW-1:0] ab_idx;
  logic [2:0]      ld_step, data_step;
  logic [IdxW-1:0] ld_idx;
  can_mb_load #(.NumMb(NumMb)) u_load (
    .clk_i, .rst_ni, .running_i, .mute_i, .gap_i,
    .oneshot_i(xctrl_i[can_regs_pkg::XctrlOneshot]),
    .osmb_i(xctrl_i[can_regs_pkg::XctrlOsmb]), .aen_i(aen),
    .settled_i(settled), .best_idx_i(best_idx), .retry_busy_i(retry_busy), .retry_o(retry),
    .inactive_o(inactive),
    .cs_written_i(cs_written), .cs_written_idx_i(cs_written_idx), .cs_written_act_i(cs_written_act),
    .cs_wr_i(wr && cpu_mem_sel == can_mb_pkg::MemCs), .cs_wr_idx_i(cpu_idx),
    .cmd_i(ready_o), .cmd_mb_i, .abort_i(abort),
    .out_o(out), .done_o(done), .off_o(off),
    .tick_req_o, .tick_i, .start_i, .transmitter_i,
    .tx_req_o, .tx_ide_o, .tx_rtr_o, .tx_dlc_o, .tx_word_o, .tx_next_i, .tx_ok_i, .tx_fail_i,
    .started_o(started), .cur_idx_o(cur_idx), .mine_o(mine),
    .req_o(ld_req), .step_o(ld_step), .row_o(ld_row), .ld_idx_o(ld_idx), .word_o(ld_word),
    .flight_i(flight), .data_i(ld_data), .data_step_i(data_step), .cs_i(cs), .msg_i(msg),
    .cancel_o(ld_cancel), .code_o(ld_code), .flag_o(ld_flag), .sent_o(sent), .take_o(ld_take),
    .busy_o(ld_busy));

  if (Abort != 0) begin : gen_guard
    can_mb_guard #(.NumMb(NumMb)) u_guard (
      .clk_i, .rst_ni, .clear_i, .aen_i(aen),
      .first_i(wr && !wr_done), .wr_done_i(wr_done), .mem_sel_i(cpu_mem_sel), .idx_i(cpu_idx),
      .be3_i(cpu_be[3]),
      .code_i(wdata_i[can_regs_pkg::MbCsCode +: can_regs_pkg::MbCsCodeW]),
      .area_i(area), .ended_i(cs[can_mb_pkg::CsEnded]),
      .mark_i(serviced_gnt), .mark_idx_i(serviced_idx),
      .block_o(block), .if_ended_o(if_ended), .abort_o(abort),
      .out_i(out), .done_i(done), .cur_idx_i(cur_idx),
      .take_i(ld_take), .flag_o(ab_flag), .flag_idx_o(ab_idx), .gnt_i(!mv_flag && !ld_flag),
      .end_i(flag_o && !mv_flag), .end_idx_i(flag_idx_o), .iflag_i(iflag_i[NumMb-1:0]));
  end else begin : gen_no_guard
    assign {block, if_ended, abort, ab_flag} = '0;
    assign ab_idx = '0;
    logic unused_guard;
    assign unused_guard = &{1'b0, area, out, done, ld_take};
  end

  if (Status != 0) begin : gen_status
    can_mb_status #(.NumMb(NumMb)) u_status (
      .clk_i, .rst_ni, .clear_i, .cs_written_i(cs_written),
      .pass_i(pass), .pass_end_i(pass_end), .seen_i(seen), .seen_idx_i(seen_idx),
      .seen_worst_i(seen_worst), .seen_free_i(seen_free),
      .sent_i(sent && ld_code == can_regs_pkg::MbCsCodeTxInactive), .tx_ok_i,
      .cur_idx_i(cur_idx), .crc_i, .esr2_o, .crcr_o);
  end else begin : gen_no_status
    assign {esr2_o, crcr_o} = '0;
    logic unused_status;
    assign unused_status = &{1'b0, pass, pass_end, seen, seen_idx, seen_worst, seen_free,
                             crc_i};
  end

  logic            copy, copy_cs, eng_req, eng_lazy;
  logic [3:0]      copy_be;
  logic            copy_off, copy_end;
  logic [IdxW:0]   eng_cs_row, eng_mask_row;
  logic [IdxW+1:0] copy_row, eng_msg_row;
  logic [31:0]     copy_data;
  // No copy begins as a byte of the frame being received comes, nor while a word of it waits: a bit
  // that resynchronisation makes short leaves four clocks to write a byte.
  logic yields;
  assign yields = rx_wr_req || rx_byte_we_i;
  can_mb_step #(.NumMb(NumMb)) u_step (
    .clk_i, .rst_ni,
    .ld_req_i(ld_req), .ld_step_i(ld_step), .ld_row_i(ld_row), .ld_word_i(ld_word),
    .ld_idx_i(ld_idx),
    .cur_idx_i(cur_idx), .ld_cancel_i(ld_cancel), .ld_code_i(ld_code),
    .ld_data_o(ld_data), .ld_data_step_o(data_step),
    .mv_req_i(mv_req), .mv_step_i(mv_step), .mv_row_i(mv_row), .mv_idx_i(mv_idx), .moving_i(moving),
    .mv_answer_i(mv_answer),
    .mv_cancel_i(mv_cancel), .mv_top_i(mv_top), .mv_data_o(mv_data), .flight_o(flight),
    .rx_req_i(rx_req), .rx_idx_i(rx_idx), .rx_word_i(rx_word), .rx_cs_i(rx_cs),
    .rx_mask_row_i(rx_mask_row), .rx_gnt_o(rx_gnt),
    .scan_req_i(scan_req), .scan_lazy_i(scan_lazy), .scan_idx_i(scan_idx), .scan_gnt_o(scan_gnt),
    .req_o(eng_req), .lazy_o(eng_lazy),
    .cs_o(eng_cs), .cs_row_o(eng_cs_row), .msg_row_o(eng_msg_row), .mask_row_o(eng_mask_row),
    .slot_i(eng_slot), .yield_i(yields), .word_i(word),
    .copy_o(copy), .copy_cs_o(copy_cs), .copy_be_o(copy_be), .copy_off_o(copy_off),
    .copy_end_o(copy_end), .copy_row_o(copy_row),
    .copy_data_o(copy_data));

  can_mb_port #(
    .NumMb(NumMb), .OwnMasks(OwnMasks), .ClearRam(ClearRam), .TimeUnit(TimeUnit)
  ) u_port (
    .clk_i, .rst_ni,
    .cmd_rd_i, .cmd_wr_i, .cmd_mem_sel_i, .cmd_word_i, .cmd_idx_i, .cmd_be_i,
    .row_idx_i(row_idx), .wdata_i(ram_wdata), .ring_i(ring), .block_i(block),
    .if_ended_i(if_ended), .ready_o, .rd_word_o(rd_word), .rdata_o(rd_other), .rd_end_o(rd_end),
    .rd_done_o(rd_done), .wr_o(wr), .wr_done_o(wr_done), .mem_sel_o(cpu_mem_sel), .rxfir_o(rxfir),
    .idx_o(cpu_idx), .be_o(cpu_be),
    .ins_req_i(ins_req), .ins_idx_i(ins_idx), .ins_gnt_o(ins_gnt),
    .eng_req_i(eng_req), .eng_lazy_i(eng_lazy), .eng_pass_i(running_i && !scan_lazy),
    .eng_cs_i(eng_cs), .eng_cs_row_i(eng_cs_row),
    .eng_msg_row_i(eng_msg_row), .eng_mask_row_i(eng_mask_row), .eng_slot_o(eng_slot),
    .stale_o(stale), .id_stale_o(id_stale), .cs_o(cs), .msg_o(msg), .mask_o(mask),
    .word_o(word), .copy_i(copy), .copy_cs_i(copy_cs), .copy_be_i(copy_be),
    .copy_off_i(copy_off), .copy_end_i(copy_end), .copy_row_i(copy_row),
    .copy_data_i(copy_data),
    .serviced_req_i(serviced_req), .serviced_idx_i(serviced_idx), .serviced_ovr_i(serviced_ovr),
    .serviced_gnt_o(serviced_gnt),
    .rx_wr_req_i(rx_wr_req), .rx_wr_cs_i(rx_wr_cs), .rx_wr_be_i(rx_wr_be), .rx_wr_row_i(rx_wr_row),
    .rx_wr_data_i(rx_wr_data), .rx_wr_gnt_o(rx_wr_gnt),
    .stamp_re_o(stamp_re), .stamp_cpu_o(stamp_cpu), .stamp_row_o(stamp_row),
    .stamp_shown_i(stamp_shown), .stamp_rdata_i(stamp_rdata),
    .scrub_o, .scrub_row_o(scrub_row));

  if (TimeUnit != 0) begin : gen_stamp
    can_mb_stamp #(.NumMb(NumMb)) u_stamp (
      .clk_i, .rst_ni, .scrub_i(scrub_o), .scrub_row_i(scrub_row),
      .start_i, .rx_valid_i, .stamp_i(time_stamp_i), .we_i(time_stamp_we_i),
      .own_i(time_stamp_tx_i), .cur_idx_i(cur_idx), .mine_i(mine), .smb_i(smb),
      .busy_o(stamp_busy),
      .re_i(stamp_re), .cpu_i(stamp_cpu), .cpu_row_i(stamp_row),
      .shown_o(stamp_shown),
      .rdata_o(stamp_rdata),
      .mv_step_i(mv_step), .mv_row_i(mv_row), .mv_idx_i(mv_idx), .mv_data_i(mv_data),
      .mv_cancel_i(mv_cancel));
  end else begin : gen_no_stamp
    assign {stamp_busy, stamp_shown} = '0;
    assign stamp_rdata = '0;
    logic unused_stamp;
    assign unused_stamp = &{1'b0, time_stamp_i, time_stamp_we_i, time_stamp_tx_i, mine, scrub_row,
                            stamp_re, stamp_cpu, stamp_row};
  end

  assign flag_o     = mv_flag || ld_flag || ab_flag;
  assign flag_idx_o = mv_flag ? mv_idx : ld_flag ? cur_idx : ab_idx;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) busy_o <= 1'b1;
    else         busy_o <= scrub_o || mv_busy || ld_busy || ab_flag;
  end
endmodule
