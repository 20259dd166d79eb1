// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_core: CAN 2.0A/B protocol engine. It connects the three processes of the paper, time quanta
// (can_tq_gen), bit timing (can_bit_timing) and bit stream (can_bsp), in one clock domain, and
// optionally the time unit. Pins are on one side; frames pass word by word on the other. Message
// buffers are not part of it.

module can_core #(
  /// 1: with the time unit (can_time); 0: without, the ports time_* have no function and are 0.
  parameter int TimeUnit = 0,
  /// Reset value of the clock's increment, see can_clock.
  parameter logic [39:0] TimeInc = 40'h14_0000_0000,
  /// 1: with the follower (can_time_sync), which needs the time unit; 0: without.
  parameter int TimeSync = 0,
  /// 1: only base frames are sent, byte by byte: within 8 bits after each tx_next_o the next data
  /// byte follows in tx_word_i[25:18]. Of a received extended frame, rx_id_o has the first 11 bits;
  /// rx_byte_o is valid for received frames only. 0: as described at the ports.
  parameter int ByteWise = 0,
  /// Counter widths for a fixed bit timing: bits of presdiv_i that are used (can_tq_gen), position
  /// in the bit (can_bit_timing). The default suits all timings.
  parameter int PresdivWidth = 8,
  parameter int PosWidth = 5
) (
  input  logic        clk_i,
  input  logic        rst_ni,
  // Mode
  input  logic        run_i,           // 1: take part in the bus; rising: integrate first (IN-01)
  output logic        running_o,       // on the bus; falls by the end of the current bit (MO-13)
  output logic        stop_ok_o,       // run_i may fall without hurting a frame
  output logic        gap_o,           // no frame on the bus: an own one may begin at any time
  // Bit timing, constant while running; encodings of CTRL (length minus one)
  input  logic [7:0]  presdiv_i,       // clocks per time quantum
  input  logic [1:0]  rjw_i,           // SJW - 1, time quanta
  input  logic [2:0]  pseg1_i,         // PHASE_SEG1 - 1
  input  logic [2:0]  pseg2_i,         // PHASE_SEG2 - 1
  input  logic [2:0]  propseg_i,       // PROP_SEG - 1
  input  logic        smp_i,           // triple sampling (BT-10)
  input  logic        lom_i,           // listen-only (MO-01)
  input  logic        lpb_i,           // loop-back (MO-04)
  input  logic        fd_tolerant_i,   // protocol exception on a recessive FDF bit (FF-06)
  input  logic        boff_rec_i,      // 1: no automatic recovery from bus-off (BO-03)
  // Error counters; writes take effect while running_o = 0
  input  logic        ec_clear_i,      // clear both counters and leave bus-off
  input  logic        ec_we_i,         // write both counters
  input  logic [15:0] ec_wdata_i,      // {REC, TEC}
  output logic [7:0]  tec_o,           // TEC; in bus-off: recovery sequences seen
  output logic [7:0]  rec_o,           // REC
  output logic        passive_o,       // error passive (FC-11)
  output logic        boff_o,          // bus-off (FC-13)
  output logic [5:0]  err_o,           // pulses, can_pkg::Err*
  // Status
  output logic        idle_o,          // bus is idle
  output logic        transmitter_o,   // transmitter of the current frame (RO-01)
  output logic        receiver_o,      // receiver of the current frame
  output logic        synch_o,         // node is integrated and not in bus-off
  input  logic        tick_req_i,      // requests tick_o; without a reader there is no event
  output logic        tick_o,          // pulse: sample point, while requested
  input  logic        rx_req_i,        // requests rx_level_o
  output logic        rx_level_o,      // bus level, synchronised; recessive unless requested
  // TIMER, nominal bit times (flexcan.md section 6)
  input  logic        timer_clear_i,   // pulse: clear, see can_timestamp
  input  logic        timer_we_i,      // pulse: write
  input  logic [1:0]  timer_be_i,      // byte enables
  input  logic [15:0] timer_wdata_i,   // value to write
  output logic [15:0] timer_o,         // TIMER
  // Transmission. A frame waits while tx_req_i is 1; tx_word_i is its ID word, ID[28:0] (base
  // frames: ID in [28:18]). Within 16 bits after each tx_next_o the next data word follows (byte 0
  // in 31:24).
  input  logic        tx_req_i,        // a frame waits
  input  logic        tx_ide_i,        // it is extended
  input  logic        tx_rtr_i,        // it is a remote frame
  input  logic [3:0]  tx_dlc_i,        // its DLC
  input  logic [31:0] tx_word_i,       // its ID word, then its data words
  output logic        tx_next_o,       // pulse: word taken
  output logic        tx_ok_o,         // pulse: frame sent (VA-02)
  output logic        tx_fail_o,       // pulse: attempt ended by error or lost arbitration
  // Reception. Pulses come in the clock after the sample point.
  output logic        start_o,         // pulse: a frame begins; transmitter_o tells whose
  output logic        stamp_o,         // pulse: the next bit is the first of the ID field
  output logic        rx_hdr_o,        // pulse: ID, IDE, SRR, RTR below are valid for 3 bits
  output logic [28:0] rx_id_o,         // base frames: ID in [28:18], rest 0
  output logic        rx_ide_o,        // extended frame
  output logic        rx_srr_o,        // SRR bit as received
  output logic        rx_rtr_o,        // remote frame
  output logic [3:0]  rx_dlc_o,        // raw DLC (FF-08), valid from the data or CRC field on
  output logic        rx_byte_we_o,    // pulse: rx_byte_o is the next data byte, stable for a bit
  output logic [7:0]  rx_byte_o,       // data byte
  output logic        rx_valid_o,      // pulse: frame valid, SP of EOF6 (VA-01); own frames too
  output logic [14:0] crc_o,           // CRC of the frame, valid with tx_ok_o
  // Time unit, see can_time
  input  logic [can_pkg::TimeCmdWidth-1:0] time_cmd_i, // pulses, can_pkg::Time*
  input  logic [63:0] time_data_i,     // data of a command
  output logic [63:0] time_now_o,      // TIME of the last TimeRead
  output logic [63:0] time_ext_o,      // TIME of the last TimeExt
  output logic [31:0] time_left_o,     // TSLEW: rest of a slew
  input  logic [31:0] time_tctrl_i,    // TCTRL
  input  logic [31:0] time_tcmph_i,    // TCMPH
  input  logic [31:0] time_ttx_i,      // TTX
  input  logic        time_wait_i,     // waiting frame is that of the held buffer (TM-41)
  output logic [can_pkg::TimeStatWidth-1:0] time_stat_o, // can_pkg::TimeStat*
  output logic [63:0] time_stamp_o,    // stamp of the frame
  output logic        time_stamp_we_o, // pulse: time_stamp_o is complete
  output logic        time_stamp_tx_o, // with it: stamp of an own frame
  input  logic [31:0] time_sync_ctrl_i,   // TSCTRL, see can_time_sync
  input  logic [31:0] time_sync_id_i,     // TSID
  input  logic [23:0] time_sync_delay_i,  // TSDLY
  output logic [31:0] time_sync_stat_o,   // TSSTAT
  output logic [31:0] time_sync_ofs_o,    // TSOFS
  // Pins and observers
  input  logic        can_rx_i,        // receive pin, asynchronous
  output logic        can_tx_o,        // transmit pin, register
  output logic [can_pkg::TraceWidth-1:0] trace_o // see can_pkg
);

  logic rx_pin, rx, tq, sample, bit_value, boundary, edge_seen, hard;
  logic tx_q, active_q;
  logic first_q;  // first clock of a bit
  logic stuff;
  logic [8:0]      tec;
  can_pkg::field_t field;
  logic [5:0]      left;
  logic            held;   // launch time of the waiting frame has not come (TM-41)

  can_sync u_sync (.clk_i, .rst_ni, .can_rx_i, .rx_o(rx_pin));

  assign rx = lpb_i ? tx_q : rx_pin;

  localparam int DivideWidth = PresdivWidth == 0 ? 1 : PresdivWidth;
  logic unused_presdiv;
  assign unused_presdiv = &{1'b0, presdiv_i};
  can_tq_gen #(.PresdivWidth(PresdivWidth)) u_tq_gen (
    .clk_i, .rst_ni, .run_i(active_q), .presdiv_i(DivideWidth'(presdiv_i)), .tq_o(tq)
  );

  can_bit_timing #(.PosWidth(PosWidth)) u_bit_timing (
    .clk_i, .rst_ni, .run_i(active_q), .tq_i(tq), .rx_i(rx), .tx_i(tx_q), .hard_i(hard),
    .propseg_i, .pseg1_i, .pseg2_i, .rjw_i, .smp_i,
    .sample_o(sample), .bit_o(bit_value), .boundary_o(boundary), .edge_o(edge_seen)
  );

  can_timestamp u_timestamp (
    .clk_i, .rst_ni, .clear_i(timer_clear_i), .sample_i(sample && active_q),
    .we_i(timer_we_i), .be_i(timer_be_i), .wdata_i(timer_wdata_i), .timer_o
  );

  can_bsp #(.ByteWise(ByteWise)) u_bsp (
    .clk_i, .rst_ni, .run_i(active_q), .sample_i(sample), .bit_i(bit_value),
    .stay_i(run_i), .boundary_i(boundary), .judge_i(first_q), .edge_i(edge_seen),
    .lom_i, .lpb_i, .fd_tolerant_i, .boff_rec_i, .ec_clear_i, .ec_we_i, .ec_wdata_i,
    .tx_req_i(tx_req_i && !held), .tx_ide_i, .tx_rtr_i, .tx_dlc_i, .tx_word_i,
    .tx_o(tx_q), .can_tx_o, .hard_o(hard), .field_o(field), .left_o(left), .stuff_o(stuff),
    .transmitter_o, .tec_o(tec), .rec_o, .passive_o, .boff_o, .err_o, .tx_next_o, .tx_ok_o,
    .tx_fail_o, .start_o, .stamp_o, .rx_hdr_o, .rx_id_o, .rx_ide_o, .rx_srr_o, .rx_rtr_o,
    .rx_dlc_o, .rx_byte_we_o, .rx_byte_o, .rx_valid_o, .crc_o
  );

  if (TimeUnit != 0) begin : gen_time
    logic [can_pkg::TimeCmdWidth-1:0]  cmd;
    logic [can_pkg::TimeStatWidth-1:0] stat;
    logic [63:0] data;
    logic [39:0] inc;
    logic        changed, upset;
    can_time #(.TimeInc(TimeInc), .Watch(TimeSync)) u_time (
      .clk_i, .rst_ni, .cmd_i(cmd), .data_i(data),
      .now_o(time_now_o), .ext_o(time_ext_o), .left_o(time_left_o), .inc_o(inc),
      .tctrl_i(time_tctrl_i), .tcmph_i(time_tcmph_i), .ttx_i(time_ttx_i),
      .stat_o(stat), .upset_o(upset),
      .rx_i(rx), .tx_i(tx_q), .sample_i(sample && active_q), .bit_i(bit_value), .field_i(field),
      .transmitter_i(transmitter_o), .sof_i(stamp_o), .rx_valid_i(rx_valid_o),
      .stamp_o(time_stamp_o), .stamp_we_o(time_stamp_we_o), .stamp_tx_o(time_stamp_tx_o));
    assign held = time_wait_i && time_stat_o[can_pkg::TimeStatHeld];
    always_comb begin
      time_stat_o = stat;
      time_stat_o[can_pkg::TimeStatSync] = changed;
    end

    if (TimeSync != 0) begin : gen_sync
      logic        own;
      logic [63:0] own_data;
      can_time_sync #(.TimeInc(TimeInc)) u_follower (
        .clk_i, .rst_ni, .ctrl_i(time_sync_ctrl_i), .id_i(time_sync_id_i),
        .delay_i(time_sync_delay_i), .stat_o(time_sync_stat_o), .ofs_o(time_sync_ofs_o),
        .changed_o(changed),
        .rx_hdr_i(rx_hdr_o), .rx_id_i(rx_id_o), .rx_ide_i(rx_ide_o), .rx_rtr_i(rx_rtr_o),
        .rx_dlc_i(rx_dlc_o), .rx_byte_we_i(rx_byte_we_o), .rx_byte_i(rx_byte_o),
        .rx_valid_i(rx_valid_o), .stamp_i(time_stamp_o), .inc_i(inc),
        .upset_i(upset),
        .cmd_i(time_cmd_i), .cmd_o(cmd), .own_o(own), .data_o(own_data));
      assign data = own ? own_data : time_data_i;
    end else begin : gen_no_sync
      logic unused;
      assign unused = &{1'b0, inc, upset, time_sync_ctrl_i, time_sync_id_i, time_sync_delay_i};
      assign {cmd, data} = {time_cmd_i, time_data_i};
      assign {time_sync_stat_o, time_sync_ofs_o, changed} = '0;
    end
  end else begin : gen_no_time
    logic unused;
    assign unused = &{1'b0, time_cmd_i, time_data_i, time_tctrl_i, time_tcmph_i,
                      time_ttx_i, time_wait_i, time_sync_ctrl_i, time_sync_id_i,
                      time_sync_delay_i};
    assign {time_now_o, time_ext_o, time_left_o} = '0;
    assign time_stat_o  = '0;
    assign time_stamp_o = '0;
    assign {time_stamp_we_o, time_stamp_tx_o, held} = '0;
    assign {time_sync_stat_o, time_sync_ofs_o} = '0;
  end

  // MO-13: a stop request never shortens a dominant bit. The node stays until it sends recessive.
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      active_q <= 1'b0;
      first_q  <= 1'b0;
    end else begin
      active_q <= run_i || (active_q && tx_q == can_pkg::Dominant);
      first_q  <= boundary;
    end
  end

  assign running_o  = active_q;
  assign tick_o     = sample && tick_req_i;
  assign rx_level_o = rx_pin || !rx_req_i;
  assign tec_o      = tec[7:0];
  assign idle_o     = (field == can_pkg::FldIdle);
  assign receiver_o = (|field[4:3]) && !transmitter_o;
  assign synch_o    = active_q && (field != can_pkg::FldInteg) && (field != can_pkg::FldBusOff);
  assign gap_o      = !(|field[4:3]);
  // EF-03: leaving a passive error flag hurts no frame, and on a busy bus it may not end.
  assign stop_ok_o  = gap_o || (field == can_pkg::FldWait)
                   || (field == can_pkg::FldErrFlag && left != 6'd5 && tx_q == can_pkg::Recessive);

  assign trace_o = {sample, boundary, bit_value, tx_q, transmitter_o, stuff, field, left, err_o,
                    rx_valid_o, tx_ok_o, tx_fail_o, start_o, passive_o, active_q, 3'b0, tec, rec_o};

endmodule
