// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// In place of can_core: an engine that says anything at any time. What is proven with it holds
// whatever the engine does.

module can_core #(
  parameter int TimeUnit = 0,
  parameter logic [39:0] TimeInc = 40'h14_0000_0000,
  parameter int TimeSync = 0
) (
  input  logic        clk_i,
  input  logic        rst_ni,
  input  logic        run_i,
  output logic        running_o,
  output logic        stop_ok_o,
  output logic        gap_o,
  input  logic [7:0]  presdiv_i,
  input  logic [1:0]  rjw_i,
  input  logic [2:0]  pseg1_i,
  input  logic [2:0]  pseg2_i,
  input  logic [2:0]  propseg_i,
  input  logic        smp_i,
  input  logic        lom_i,
  input  logic        lpb_i,
  input  logic        fd_tolerant_i,
  input  logic        boff_rec_i,
  input  logic        ec_clear_i,
  input  logic        ec_we_i,
  input  logic [15:0] ec_wdata_i,
  output logic [7:0]  tec_o,
  output logic [7:0]  rec_o,
  output logic        passive_o,
  output logic        boff_o,
  output logic [5:0]  err_o,
  output logic        idle_o,
  output logic        transmitter_o,
  output logic        receiver_o,
  output logic        synch_o,
  input  logic        tick_req_i,
  output logic        tick_o,
  input  logic        rx_req_i,
  output logic        rx_level_o,
  input  logic        timer_clear_i,
  input  logic        timer_we_i,
  input  logic [1:0]  timer_be_i,
  input  logic [15:0] timer_wdata_i,
  output logic [15:0] timer_o,
  input  logic        tx_req_i,
  input  logic        tx_ide_i,
  input  logic        tx_rtr_i,
  input  logic [3:0]  tx_dlc_i,
  input  logic [31:0] tx_word_i,
  output logic        tx_next_o,
  output logic        tx_ok_o,
  output logic        tx_fail_o,
  output logic        start_o,
  output logic        stamp_o,
  output logic        rx_hdr_o,
  output logic [28:0] rx_id_o,
  output logic        rx_ide_o,
  output logic        rx_srr_o,
  output logic        rx_rtr_o,
  output logic [3:0]  rx_dlc_o,
  output logic        rx_byte_we_o,
  output logic [7:0]  rx_byte_o,
  output logic        rx_valid_o,
  output logic [14:0] crc_o,
  input  logic [can_pkg::TimeCmdWidth-1:0] time_cmd_i,
  input  logic [63:0] time_data_i,
  output logic [63:0] time_now_o,
  output logic [63:0] time_ext_o,
  output logic [31:0] time_left_o,
  input  logic [31:0] time_tctrl_i,
  input  logic [31:0] time_tcmph_i,
  input  logic [31:0] time_ttx_i,
  input  logic        time_wait_i,
  output logic [can_pkg::TimeStatWidth-1:0] time_stat_o,
  output logic [63:0] time_stamp_o,
  output logic        time_stamp_we_o,
  output logic        time_stamp_tx_o,
  input  logic [31:0] time_sync_ctrl_i,
  input  logic [31:0] time_sync_id_i,
  input  logic [23:0] time_sync_delay_i,
  output logic [31:0] time_sync_stat_o,
  output logic [31:0] time_sync_ofs_o,
  input  logic        can_rx_i,
  output logic        can_tx_o,
  output logic [can_pkg::TraceWidth-1:0] trace_o
);

  (* anyseq *) logic f_running;
  assign running_o = f_running;
  (* anyseq *) logic f_stop_ok;
  assign stop_ok_o = f_stop_ok;
  (* anyseq *) logic f_gap;
  assign gap_o = f_gap;
  (* anyseq *) logic [7:0] f_tec;
  assign tec_o = f_tec;
  (* anyseq *) logic [7:0] f_rec;
  assign rec_o = f_rec;
  (* anyseq *) logic f_passive;
  assign passive_o = f_passive;
  (* anyseq *) logic f_boff;
  assign boff_o = f_boff;
  (* anyseq *) logic [5:0] f_err;
  assign err_o = f_err;
  (* anyseq *) logic f_idle;
  assign idle_o = f_idle;
  (* anyseq *) logic f_transmitter;
  assign transmitter_o = f_transmitter;
  (* anyseq *) logic f_receiver;
  assign receiver_o = f_receiver;
  (* anyseq *) logic f_synch;
  assign synch_o = f_synch;
  (* anyseq *) logic f_tick;
  assign tick_o = f_tick;
  (* anyseq *) logic f_rx_level;
  assign rx_level_o = f_rx_level;
  (* anyseq *) logic [15:0] f_timer;
  assign timer_o = f_timer;
  (* anyseq *) logic f_tx_next;
  assign tx_next_o = f_tx_next;
  (* anyseq *) logic f_tx_ok;
  assign tx_ok_o = f_tx_ok;
  (* anyseq *) logic f_tx_fail;
  assign tx_fail_o = f_tx_fail;
  (* anyseq *) logic f_start;
  assign start_o = f_start;
  (* anyseq *) logic f_stamp;
  assign stamp_o = f_stamp;
  (* anyseq *) logic f_rx_hdr;
  assign rx_hdr_o = f_rx_hdr;
  (* anyseq *) logic [28:0] f_rx_id;
  assign rx_id_o = f_rx_id;
  (* anyseq *) logic f_rx_ide;
  assign rx_ide_o = f_rx_ide;
  (* anyseq *) logic f_rx_srr;
  assign rx_srr_o = f_rx_srr;
  (* anyseq *) logic f_rx_rtr;
  assign rx_rtr_o = f_rx_rtr;
  (* anyseq *) logic [3:0] f_rx_dlc;
  assign rx_dlc_o = f_rx_dlc;
  (* anyseq *) logic f_rx_byte_we;
  assign rx_byte_we_o = f_rx_byte_we;
  (* anyseq *) logic [7:0] f_rx_byte;
  assign rx_byte_o = f_rx_byte;
  (* anyseq *) logic f_rx_valid;
  assign rx_valid_o = f_rx_valid;
  (* anyseq *) logic [14:0] f_crc;
  assign crc_o = f_crc;
  (* anyseq *) logic [63:0] f_time_now;
  assign time_now_o = f_time_now;
  (* anyseq *) logic [63:0] f_time_ext;
  assign time_ext_o = f_time_ext;
  (* anyseq *) logic [31:0] f_time_left;
  assign time_left_o = f_time_left;
  (* anyseq *) logic [can_pkg::TimeStatWidth-1:0] f_time_stat;
  assign time_stat_o = f_time_stat;
  (* anyseq *) logic [63:0] f_time_stamp;
  assign time_stamp_o = f_time_stamp;
  (* anyseq *) logic f_time_stamp_we;
  assign time_stamp_we_o = f_time_stamp_we;
  (* anyseq *) logic f_time_stamp_tx;
  assign time_stamp_tx_o = f_time_stamp_tx;
  (* anyseq *) logic [31:0] f_time_sync_stat;
  assign time_sync_stat_o = f_time_sync_stat;
  (* anyseq *) logic [31:0] f_time_sync_ofs;
  assign time_sync_ofs_o = f_time_sync_ofs;
  (* anyseq *) logic f_can_tx;
  assign can_tx_o = f_can_tx;
  (* anyseq *) logic [can_pkg::TraceWidth-1:0] f_trace;
  assign trace_o = f_trace;
endmodule
