// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// In place of can_core: an engine that says anything in any clock. What can_remote does not use
// is 0.

module can_core #(
  parameter int TimeUnit = 0,
  parameter logic [39:0] TimeInc = 40'h14_0000_0000,
  parameter int TimeSync = 0,
  parameter int ByteWise = 0,
  parameter int PresdivWidth = 8,
  parameter int PosWidth = 5
) (
  input logic clk_i, rst_ni, run_i, smp_i, lom_i, lpb_i, fd_tolerant_i, boff_rec_i, ec_clear_i,
    ec_we_i, tick_req_i, rx_req_i, timer_clear_i, timer_we_i, tx_req_i, tx_ide_i, tx_rtr_i,
    time_wait_i, can_rx_i,
  input logic [7:0] presdiv_i,
  input logic [1:0] rjw_i, timer_be_i,
  input logic [2:0] pseg1_i, pseg2_i, propseg_i,
  input logic [15:0] ec_wdata_i, timer_wdata_i,
  input logic [3:0] tx_dlc_i,
  input logic [31:0] tx_word_i, time_tctrl_i, time_tcmph_i, time_ttx_i, time_sync_ctrl_i,
    time_sync_id_i,
  input logic [can_pkg::TimeCmdWidth-1:0] time_cmd_i,
  input logic [63:0] time_data_i,
  input logic [23:0] time_sync_delay_i,
  output logic running_o, stop_ok_o, gap_o, passive_o, boff_o, idle_o, transmitter_o, receiver_o,
    synch_o, tick_o, rx_level_o, tx_next_o, tx_ok_o, tx_fail_o, start_o, stamp_o, rx_hdr_o,
    rx_ide_o, rx_srr_o, rx_rtr_o, rx_byte_we_o, rx_valid_o, time_stamp_we_o, time_stamp_tx_o,
    can_tx_o,
  output logic [7:0] tec_o, rec_o, rx_byte_o,
  output logic [5:0] err_o,
  output logic [15:0] timer_o,
  output logic [28:0] rx_id_o,
  output logic [3:0] rx_dlc_o,
  output logic [14:0] crc_o,
  output logic [63:0] time_now_o, time_ext_o, time_stamp_o,
  output logic [31:0] time_left_o, time_sync_stat_o, time_sync_ofs_o,
  output logic [can_pkg::TimeStatWidth-1:0] time_stat_o,
  output logic [can_pkg::TraceWidth-1:0] trace_o
);
  (* anyseq *) logic [76:0] f_any;
  assign {gap_o, tec_o, rec_o, passive_o, boff_o, err_o, transmitter_o, tick_o, rx_level_o,
          tx_next_o, tx_ok_o, tx_fail_o, rx_hdr_o, rx_id_o, rx_ide_o, rx_rtr_o, rx_dlc_o,
          rx_byte_we_o, rx_byte_o, rx_valid_o} = f_any;
  assign {running_o, stop_ok_o, idle_o, receiver_o, synch_o, timer_o, start_o, stamp_o,
          rx_srr_o, crc_o, time_now_o, time_ext_o, time_left_o, time_stat_o, time_stamp_o,
          time_stamp_we_o, time_stamp_tx_o, time_sync_stat_o, time_sync_ofs_o, can_tx_o,
          trace_o} = '0;
endmodule
