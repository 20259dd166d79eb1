// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_remote: CAN node without a processor (docs/remote.md, rules RN-01 to RN-105). Frames of the
// bus read and write a block RAM that user logic shares. This file wires the protocol engine
// can_core with the blocks can_rn_*: a frame is decoded (can_rn_head), checked (can_rn_check) and
// carried out job by job (can_rn_step) on the RAM (can_rn_port); answers wait in a queue
// (can_rn_tx). Options that are not built are replaced by constants.

module can_remote #(
  /// Bits of the name in an identifier, 3 or 5; the same for all nodes of a bus.
  parameter int NameBits = 3,
  /// Bytes of the RAM: 1,024, 2,048 or 4,096.
  parameter int MemBytes = 4096,
  /// Bytes from address 0x010 that become visible by TRIGGER: 0, 8 or 16.
  parameter int StageBytes = 8,
  /// Answers that may wait for transmission: 1 or 4.
  parameter int TxDepth = 1,
  /// Producer entries: 0, 4 or 8.
  parameter int NumProd = 0,
  /// Map entries: 0, 4 or 8.
  parameter int NumMap = 0,
  /// 1: memory can be protected against reads and writes of the bus.
  parameter int Protect = 0,
  /// 1: block transfers (RN-40).
  parameter int Block = 0,
  /// 1: the bit rate is a row of RateTable, and the node can search for it (RN-73).
  parameter int AutoRate = 0,
  /// 1: eight event counters at 0xFE8 (RN-35).
  parameter int Counters = 0,
  /// 1: direct reads are answered with the identifier of the request, to demonstrate the collisions
  /// that this leads to (RN-16).
  parameter int SameId = 0,
  /// Serial number, 32 bits, different in each device.
  parameter int Serial = 0,
  /// Clocks per millisecond, 8,000 to 131,071.
  parameter int ClocksPerMs = 8000,
  /// Bit timing as `verican bittime` prints it: clocks per quantum, quanta per segment.
  parameter int Brp = 1,
  parameter int Prop = 1,
  parameter int Ps1 = 4,
  parameter int Ps2 = 2,
  parameter int Sjw = 1,
  /// File with the initial contents of the whole RAM, written by tools/remote_memory.py, for FPGAs
  /// whose RAM can be initialised; a reset then does not clear the RAM. "": a reset clears the RAM.
  parameter InitFile = "",
  /// 1: trace_o shows the engine to an observer; 0: trace_o is 0 and costs nothing.
  parameter int Trace = 0,
  /// Number of rows of RateTable, 1 to 15, and the rows, first one rightmost. A row has 19 bits:
  /// clocks per quantum, SJW, Ps1, Ps2, Prop, each minus one. `verican bittime --table` prints them
  /// for a given clock; the default is for 8 MHz.
  parameter int RateRows = 8,
  parameter logic [284:0] RateTable = {
    133'd0,
    8'd49, 2'd1, 3'd6, 3'd1, 3'd5,  // 10 kbit/s
    8'd24, 2'd1, 3'd6, 3'd1, 3'd5,  // 20 kbit/s
    8'd9, 2'd1, 3'd6, 3'd1, 3'd5,  // 50 kbit/s
    8'd3, 2'd1, 3'd6, 3'd1, 3'd5,  // 125 kbit/s
    8'd1, 2'd1, 3'd6, 3'd1, 3'd5,  // 250 kbit/s
    8'd0, 2'd1, 3'd6, 3'd1, 3'd5,  // 500 kbit/s
    8'd0, 2'd1, 3'd3, 3'd1, 3'd2,  // 800 kbit/s
    8'd0, 2'd1, 3'd2, 3'd1, 3'd1  // 1000 kbit/s
  },
  /// 1: the node has a clock that follows a master on the bus (TM-106), with the parameters of
  /// can_time_node. 0: the ports time_* and pps_o have no function and are 0.
  parameter int TimeSync = 0,
  /// Clock increment at the nominal rate: 39:32 ns, 31:0 in 2^-32 ns a clock. Default: 8 MHz.
  parameter logic [39:0] TimeInc = 40'h7D_0000_0000,
  /// Follower: TSCTRL without EN and PPS (default: a pair a second at 8 MHz), TSID (a base
  /// identifier that no node asks or answers with; default 0x420), TSDLY; see docs/registers.md.
  parameter logic [31:0] SyncCtrl = 32'h1F49_0100,
  parameter logic [31:0] SyncId = 32'h1080_0000,
  parameter logic [31:0] SyncDelay = 32'd0,
  /// ns between two edges of pps_o, at least 16 clocks; 500,000,000: one rising edge per second.
  parameter int HalfPeriod = 500000000,
  /// Derived, do not override.
  localparam int Events = NumProd == 0 ? 1 : NumProd
) (
  input  logic                clk_i,
  input  logic                rst_ni,
  // Set-up
  input  logic                start_i,        // RAM is set up: join the bus
  input  logic [NameBits-1:0] node_i,         // node number at start; 0, 1: none
  input  logic [3:0]          rate_i,         // AutoRate: row of RateTable; beyond its rows: search
  // User logic: one access per clock in which usr_ready_o is 1; data in the clock after
  input  logic                usr_req_i,      // access requested
  input  logic                usr_we_i,       // access writes
  input  logic [3:0]          usr_be_i,       // byte enables; byte 0 is bits 7:0
  input  logic [9:0]          usr_addr_i,     // word address
  input  logic [31:0]         usr_wdata_i,    // word to write
  output logic                usr_ready_o,    // access is carried out in this clock
  output logic [31:0]         usr_rdata_o,    // word read
  input  logic                usr_hold_i,     // nothing becomes visible, for at most 64 clocks
  // What has become visible
  output logic                written_o,      // pulse: an accepted write is in the RAM (RN-45)
  output logic [11:0]         written_addr_o, // with written_o: first address of the write
  output logic [3:0]          written_len_o,  // with written_o: number of bytes
  output logic                apply_o,        // pulse: staged bytes are visible (RN-46)
  // Producers; tie to 0 if there are none
  input  logic [Events-1:0]   event_i,        // pulse: send entry k now
  // State
  output logic                safe_o,         // node is not in OPERATE: drive safe outputs
  output logic [1:0]          state_o,        // 0 INIT, 1 LISTEN, 2 SAFE, 3 OPERATE
  // Clock
  input  logic                time_take_i,    // pulse: capture the time of this clock
  output logic [63:0]         time_o,         // captured time, ns; good from two clocks later on
  output logic [1:0]          time_state_o,   // TSSTAT.STATE: 2 is locked
  output logic                pps_o,          // toggles every HalfPeriod, from the first pair on
  // Pins and observers
  input  logic                can_rx_i,       // receive pin, asynchronous
  output logic                can_tx_o,       // transmit pin, register
  output logic [can_pkg::TraceWidth-1:0] trace_o // see can_pkg
);
  localparam int AddrBits = 10 - NameBits;
  localparam bit Filled   = |InitFile;
  localparam int Features = (StageBytes != 0 ? 1 : 0) + (NumProd != 0 ? 2 : 0)
                            + (NumMap != 0 ? 4 : 0) + (TxDepth == 4 ? 8 : 0)
                            + (Protect != 0 ? 16 : 0) + (Block != 0 ? 32 : 0)
                            + (AutoRate != 0 ? 64 : 0) + (Counters != 0 ? 128 : 0);

  // With a fixed bit timing, the engine's counters are only as wide as that timing needs.
  localparam int Longer       = Prop + Ps1 > Ps2 + Sjw ? Prop + Ps1 : Ps2 + Sjw;
  localparam int PosWidth     = AutoRate != 0 ? 5 : Longer < 4 ? 3 : $clog2(Longer + 1);
  localparam int PresdivWidth = AutoRate != 0 ? 8 : $clog2(Brp);

  can_rn_params #(
    .NameBits(NameBits), .MemBytes(MemBytes), .StageBytes(StageBytes), .TxDepth(TxDepth),
    .NumProd(NumProd), .NumMap(NumMap), .Protect(Protect), .Block(Block), .AutoRate(AutoRate),
    .Counters(Counters), .SameId(SameId), .Trace(Trace), .RateRows(RateRows),
    .TimeSync(TimeSync), .TimeInc(TimeInc), .SyncCtrl(SyncCtrl), .SyncId(SyncId),
    .SyncDelay(SyncDelay), .HalfPeriod(HalfPeriod)
  ) u_params ();
  can_timing_params #(
    .Brp(Brp), .Prop(Prop), .Ps1(Ps1), .Ps2(Ps2), .Sjw(Sjw)
  ) u_timing_params ();

  // Constant in hardware. The simulator writes it, so that one model serves all serial numbers.
  logic [31:0] serial /* verilator public_flat_rw */;
  assign serial = 32'(Serial);

  // Engine
  logic [can_pkg::TraceWidth-1:0] trace;
  logic        run, gap, boff, passive, transmitter, tick;
  logic        tx_req, tx_next, tx_ok, tx_fail, rx_hdr, rx_ide, rx_rtr, rx_byte_we, rx_valid;
  logic [3:0]  tx_dlc, rx_dlc;
  logic [31:0] tx_word;
  logic [28:0] rx_id;
  logic [7:0]  tec, rec, rx_byte;
  // Bit rate
  logic        start_now, listen, listen_run, level;
  logic [5:0]  err;
  logic [7:0]  presdiv;
  logic [1:0]  rjw, node;
  logic [2:0]  pseg1, pseg2, propseg;
  // Jobs
  can_rn_pkg::job_t job;
  logic [1:0]  phase;
  logic        timer, take, request, begins, release_off, ms;
  // Request
  logic        hdr, ours, has_byte, live, valid, sys, all, dup, port, key, refused;
  logic        value_bad, high_bad, mismatch, write, read, trigger, select, assign_number;
  logic        set_state, setup, far, info, stage, own_length;
  logic [AddrBits-1:0] a;
  logic [4:0]  op;
  logic [3:0]  code;
  // Addresses and data
  logic [11:0] start, mem;
  logic [3:0]  place, row, row_end;
  logic        ended, staged, cleared, zero, one, absent;
  logic [8:0]  cell_addr;
  logic [1:0]  lane;
  logic [31:0] rdata;
  logic [7:0]  read_byte, next_byte, wbyte, status;
  // Queue
  logic [2:0]  tail, head, age;
  logic [2:0]  at;
  logic        head_byte, urgent;
  logic        full, some, ages, load, try_due, flush, tx_status, gone, gone_status, gone_here;
  logic        new_tries, popped;
  // Producers
  logic        want, visit, keep_same, same, cell_own, no_write, differ;
  can_rn_pkg::job_t then_job;
  logic        rtr, cell_we;
  logic [3:0]  dlc;
  logic [8:0]  own_cell;
  // Map entries
  logic        search, find, hit, aim, mapped, act, watch, map_we, more;
  logic        stale, unsafe, told, ten, short, acts;
  // Protection
  logic        crosses, denied, guard;
  logic [8:0]  guard_cell;
  logic [8:0]  map_cell;
  logic [10:0] id;
  // Block transfers
  logic        block, data, make, answer, load_at, busy, part, order, again, excess, claims;
  logic        block_want, add_on, closes, timeout, block_own, block_we, block_no_write;
  logic        block_less, block_more, equal;
  logic [2:0]  add;
  logic [3:0]  length, shown;
  logic [8:0]  block_cell, sum;
  can_rn_pkg::job_t block_job, begun, block_then;
  // Counters
  logic        count, in_order, over, dropped, clear, tally, tally_own, tally_more, wide;
  logic        tally_no_write;
  logic [8:0]  tally_cell;
  // Clock
  logic        reads;
  logic [9:0]  read_word;
  logic [31:0] ram_rdata, time_stat, time_ofs;
  logic [63:0] time_applied;
  logic [can_pkg::TimeCmdWidth-1:0]  time_cmd;
  logic [can_pkg::TimeStatWidth-1:0] time_pins;
  // Node
  logic [NameBits-1:0] number;
  logic        off_entry, off_exit, carry;
  logic        operate, numbered, selected, unlocked, lock_reset, off, restart;
  logic        owe_status, owe_here, owe_feed, nothing;

  localparam logic [31:0] TimeCtrl = 32'd1 << can_regs_pkg::TctrlPoint
                                   | 32'd1 << can_regs_pkg::TctrlCmpen;
  localparam logic [31:0] FollowerCtrl = SyncCtrl | 32'd1 << can_regs_pkg::TsctrlEn
                                       | 32'd1 << can_regs_pkg::TsctrlPps;
  can_core #(
    .ByteWise(1), .PresdivWidth(PresdivWidth), .PosWidth(PosWidth), .TimeUnit(TimeSync),
    .TimeInc(TimeInc), .TimeSync(TimeSync)
  ) u_core (
    .clk_i, .rst_ni,
    .run_i(run || listen_run), .running_o(), .stop_ok_o(), .gap_o(gap),
    .presdiv_i(presdiv), .rjw_i(rjw), .pseg1_i(pseg1), .pseg2_i(pseg2),
    .propseg_i(propseg), .smp_i(1'b0), .lom_i(listen), .lpb_i(1'b0), .fd_tolerant_i(1'b0),
    .boff_rec_i(!release_off),
    .ec_clear_i(1'b1), .ec_we_i(1'b0), .ec_wdata_i(16'd0), .tec_o(tec), .rec_o(rec),
    .passive_o(passive), .boff_o(boff), .err_o(err),
    .idle_o(), .transmitter_o(transmitter), .receiver_o(), .synch_o(),
    .tick_req_i(1'b1), .tick_o(tick), .rx_req_i(listen), .rx_level_o(level),
    .timer_clear_i(1'b0), .timer_we_i(1'b0), .timer_be_i(2'b00), .timer_wdata_i(16'd0),
    .timer_o(),
    .tx_req_i(tx_req), .tx_ide_i(1'b0), .tx_rtr_i(1'b0), .tx_dlc_i(tx_dlc), .tx_word_i(tx_word),
    .tx_next_o(tx_next), .tx_ok_o(tx_ok), .tx_fail_o(tx_fail),
    .start_o(), .stamp_o(), .rx_hdr_o(rx_hdr), .rx_id_o(rx_id), .rx_ide_o(rx_ide), .rx_srr_o(),
    .rx_rtr_o(rx_rtr), .rx_dlc_o(rx_dlc), .rx_byte_we_o(rx_byte_we), .rx_byte_o(rx_byte),
    .rx_valid_o(rx_valid), .crc_o(),
    .time_cmd_i(time_cmd), .time_data_i(64'd0), .time_now_o(time_o), .time_ext_o(time_applied),
    .time_left_o(), .time_tctrl_i(TimeCtrl), .time_tcmph_i(32'(HalfPeriod)), .time_ttx_i(32'd0),
    .time_wait_i(1'b0), .time_stat_o(time_pins), .time_stamp_o(), .time_stamp_we_o(),
    .time_stamp_tx_o(), .time_sync_ctrl_i(FollowerCtrl), .time_sync_id_i(SyncId),
    .time_sync_delay_i(SyncDelay[23:0]), .time_sync_stat_o(time_stat), .time_sync_ofs_o(time_ofs),
    .can_rx_i, .can_tx_o, .trace_o(trace)
  );
  assign trace_o = Trace != 0 ? trace : '0;

  can_rn_head #(
    .NameBits(NameBits), .NumProd(NumProd), .NumMap(NumMap), .Counters(Counters != 0),
    .Block(Block != 0)
  ) u_head (
    .clk_i, .rst_ni,
    .hdr_i(rx_hdr), .transmitter_i(transmitter), .ide_i(rx_ide), .rtr_i(rx_rtr),
    .id_i(rx_id[28:18]), .byte_we_i(rx_byte_we), .byte_i(rx_byte), .valid_i(rx_valid),
    .gap_i(gap), .number_i(number), .numbered_i(numbered),
    .serial_i(serial), .job_i(job), .phase_i(phase), .take_i(take), .row_i(row),
    .read_i(read_byte),
    .search_o(search), .id_o(id), .lost_i(job == can_rn_pkg::JobFind && !find && !hit),
    .hit_i(hit), .mask_i(rdata[22:16]), .aim_i(aim), .aim_at_i({rdata[15:12], rdata[19:16]}),
    .mapped_i(mapped), .load_i(load_at), .load_at_i(rdata[15:12]), .answer_i(answer),
    .length_i(length),
    .hdr_o(hdr), .ours_o(ours), .byte_o(has_byte), .live_o(live), .valid_o(valid), .sys_o(sys),
    .all_o(all), .dup_o(dup), .a_o(a), .port_o(port), .key_o(key), .count_o(count), .op_o(op),
    .value_bad_o(value_bad), .high_bad_o(high_bad), .mismatch_o(mismatch)
  );

  // The visit of a producer entry is handled like a remote frame, except that it does not feed the
  // watchdog and that a full queue does not refuse it.
  assign rtr = (rx_rtr || visit) && !make;
  assign dlc = own_length ? op[3:0] : rx_dlc;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) own_length <= 1'b0;
    else         own_length <= visit || make || (mapped && (|op[3:0]));
  end
  assign short = rx_dlc < op[3:0] || (rx_dlc[3] && (|rx_dlc[2:0]));

  can_rn_check #(
    .NameBits(NameBits), .MemBytes(MemBytes), .NumProd(NumProd), .NumMap(NumMap),
    .Counters(Counters != 0), .Block(Block != 0), .Clock(TimeSync != 0)
  ) u_check (
    .clk_i, .rst_ni,
    .sys_i(sys), .all_i(all), .port_i(port), .a_i(a), .rtr_i(rtr), .dlc_i(dlc),
    .mapped_i(mapped), .short_i(short), .unlock_i(op[2:0] == 3'd1),
    .op_i(|op[1:0]), .make_i(make), .busy_i(busy), .order_i(order), .again_i(again),
    .over_i(excess),
    .value_bad_i(value_bad), .high_bad_i(high_bad),
    .mismatch_i(mismatch), .start_i(start), .end_i(row_end),
    .selected_i(selected), .operate_i(operate), .unlocked_i(unlocked),
    .lock_reset_i(lock_reset), .full_i(full && !visit && !make),
    .denied_i(denied), .crosses_o(crosses),
    .write_o(write), .read_o(read), .trigger_o(trigger), .stage_o(stage), .select_o(select),
    .assign_o(assign_number), .state_o(set_state), .setup_o(setup), .far_o(far), .info_o(info),
    .block_o(block), .data_o(data),
    .code_o(code)
  );
  // Requests without work: SELECT, STATE for another node, ASSIGN while not selected, a read of a
  // node without a number, a repeated DATA. Registered: known long before the frame is valid.
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) nothing <= 1'b0;
    else         nothing <= select || (set_state && mismatch) || (assign_number && !selected)
                            || (read && !numbered) || again;
  end
  assign refused = code != can_rn_pkg::CodeOk || denied;

  can_rn_step #(.Map(NumMap != 0), .Protect(Protect != 0), .Block(Block != 0)) u_step (
    .clk_i, .rst_ni,
    .hdr_i(hdr), .ours_i(ours), .byte_i(has_byte), .live_i(live), .valid_i(valid),
    .tick_i(tick), .dup_i(dup && !mapped), .key_i(key), .refused_i(refused),
    .write_i(write), .read_i(read),
    .trigger_i(trigger || acts), .nothing_i(nothing), .restart_i(restart), .operate_i(operate),
    .hold_i(usr_hold_i),
    .ended_i(ended), .cleared_i(cleared || Filled), .row_i(row), .carry_i(carry),
    .ms_i(ms), .boff_i(boff), .off_i(off), .try_i(try_due), .load_i(load), .urgent_i(urgent),
    .some_i(some),
    .more_i(ages),
    .gone_i(gone), .owe_feed_i(owe_feed), .tally_i(tally), .start_i(start_now), .run_i(run),
    .want_i(want), .visit_i(visit || make), .then_i(make ? block_then : then_job),
    .begun_i(make ? begun : can_rn_pkg::JobFresh), .same_i(keep_same),
    .fetch_i(data), .block_i(block_want), .block_job_i(block_job),
    .opens_i(block && !refused && (|op[1:0])), .ends_i(part && refused),
    .on_i(add_on), .closes_i(closes),
    .search_i(search), .find_i(find), .hit_i(hit), .mapped_i(mapped), .act_i(act), .again_i(acts),
    .watch_i(watch), .ten_o(ten),
    .job_o(job), .phase_o(phase), .timer_o(timer), .request_o(request), .begin_o(begins),
    .over_o(over),
    .take_o(take), .new_tries_o(new_tries),
    .written_o, .apply_o
  );

  // NameBits 5: A has 5 bits only. STATUS and IDENT get the A that they have with NameBits 3; for a
  // map entry, identifier bits 6:5 (part of the name) are added to the address.
  logic [6:0] row_a;
  assign row_a = NameBits == 5 ? {{2{info}} | (id[6:5] & {2{aim}}), 5'd0} : 7'd0;

  can_rn_move #(
    .StageBytes(StageBytes), .NumProd(NumProd), .NumMap(NumMap), .Protect(Protect != 0)
  ) u_move (
    .clk_i, .rst_ni,
    .job_i(job), .phase_i(phase), .request_i(request), .begin_i(begins), .take_i(take),
    .read_i(read), .trigger_i(trigger || acts), .stage_i(stage), .far_i(far), .info_i(info),
    .key_i(key),
    .data_i(data), .load_i(load_at), .answer_i(answer),
    .crosses_i(crosses), .find_i(find), .act_i(acts),
    .aim_i(aim), .aim_at_i(rdata[11:0]),
    .a_i(7'(a) | row_a), .dlc_i(dlc), .count_i(op[2:0]),
    .byte_i(rx_byte), .start_o(start), .mem_o(mem), .place_o(place), .row_o(row), .end_o(row_end),
    .ended_o(ended), .staged_o(staged), .cleared_o(cleared)
  );
  assign written_addr_o = start;
  assign written_len_o  = row_end - {2'b00, far, data};

  can_rn_cell u_cell (
    .job_i(job), .phase_i(phase), .read_i(read), .trigger_i(trigger || acts),
    .none_i(rx_dlc == 4'd0 || mapped),
    .refused_i(refused), .setup_i(setup), .off_i(off), .status_i(tx_status), .row_i(row),
    .tail_i(tail), .head_i(head), .age_i(age),
    .header_i(head_byte), .at_i(at), .timer_i(timer), .new_tries_i(new_tries), .zero_i(zero),
    .one_i(one), .own_i(cell_own || tally_own || block_own),
    .cell_o(cell_addr), .we_o(cell_we)
  );

  can_rn_data #(
    .NameBits(NameBits), .MemBytes(MemBytes), .StageBytes(StageBytes), .Features(Features),
    .Compare(NumProd != 0 || NumMap != 0)
  ) u_data (
    .clk_i, .rst_ni,
    .job_i(job), .none_i(rx_dlc == 4'd0 || mapped),
    .lane_i(lane),
    .rdata_i(rdata), .frame_i(rx_byte), .block_i(start[11:3]),
    .place_i(place), .node_i,
    .serial_i(serial), .last_i(phase[1]), .less_i(block_less),
    .more_i(more || tally_more || block_more), .add_i(add), .code_i(shown),
    .next_o(next_byte), .byte_o(read_byte), .zero_o(zero), .one_o(one), .differ_o(differ),
    .sum_o(sum), .same_o(in_order), .equal_o(equal), .wbyte_o(wbyte)
  );

  // RN-16: {request to all nodes, answer to a direct read}.
  logic [1:0] same_id;
  assign same_id = {all, !port && !visit && !make} & {2{SameId != 0}};

  // Byte address: a block that selects no byte drives 0, so the addresses are just ORed.
  logic [8:0] others;
  assign others = map_cell | own_cell | tally_cell | block_cell;
  can_rn_port #(.MemBytes(MemBytes), .InitFile(InitFile)) u_port (
    .clk_i, .rst_ni, .job_i(job), .odd_i(phase[0]), .read_i(read), .trigger_i(trigger || acts),
    .same_i(same && !phase[0]), .cell_i(cell_addr | others), .read_cell_i(guard_cell),
    .we_i((cell_we && !no_write && !tally_no_write && !block_no_write && !guard
           && !(Filled && job == can_rn_pkg::JobClear)
           && !(StageBytes == 0 && job == can_rn_pkg::JobMove && (trigger || acts)))
          || map_we || block_we),
    .wide_i(wide),
    .mem_i(mem), .staged_i(staged), .wbyte_i(wbyte),
    .a_i(7'(a)), .same_id_i(same_id), .end_i(row_end), .code_i(shown), .status_i(status),
    .tec_i(tec), .rec_i(rec),
    .lane_o(lane), .re_o(reads), .raddr_o(read_word), .rdata_o(ram_rdata),
    .usr_req_i, .usr_we_i, .usr_be_i, .usr_addr_i, .usr_wdata_i, .usr_ready_o,
    .usr_absent_o(absent)
  );
  assign usr_rdata_o = rdata & {32{!absent}};

  can_rn_tx #(.NameBits(NameBits), .TxDepth(TxDepth), .SameId(SameId != 0)) u_tx (
    .clk_i, .rst_ni,
    .job_i(job), .phase_i(phase), .live_i(live), .flush_i(flush), .number_i(number),
    .owe_status_i(owe_status), .owe_here_i(owe_here), .one_i(one), .next_i(next_byte),
    .tail_o(tail), .head_o(head), .age_o(age), .more_o(ages), .header_o(head_byte), .at_o(at),
    .status_o(tx_status),
    .full_o(full), .some_o(some),
    .load_o(load), .urgent_o(urgent), .try_o(try_due), .gone_o(gone), .gone_status_o(gone_status),
    .gone_here_o(gone_here), .popped_o(popped), .dropped_o(dropped),
    .tx_req_o(tx_req), .tx_dlc_o(tx_dlc), .tx_word_o(tx_word),
    .tx_next_i(tx_next), .tx_ok_i(tx_ok), .tx_fail_i(tx_fail), .transmitter_i(transmitter)
  );

  can_rn_state #(.NameBits(NameBits)) u_state (
    .clk_i, .rst_ni,
    .job_i(job), .phase_i(phase),
    .accept_i(begins && !refused && !visit && !make && !mapped && !again),
    .dup_i(valid && dup), .refused_i(refused), .all_i(all || sys || part), .write_i(write),
    .select_i(select), .assign_i(assign_number), .state_i(set_state), .setup_i(setup),
    .match_i(!mismatch), .new_i(a[2]), .op_i(op), .timer_i(timer), .zero_i(zero),
    .byte_i(read_byte), .off_entry_i(off_entry), .off_exit_i(off_exit), .gap_i(gap),
    .passive_i(passive), .stale_i(stale), .unsafe_i(unsafe), .told_i(told && !off),
    .node_o(node), .operate_o(operate), .number_o(number), .numbered_o(numbered),
    .selected_o(selected), .unlocked_o(unlocked), .lock_reset_o(lock_reset), .run_o(run),
    .restart_o(restart), .flush_o(flush), .gone_status_i(gone_status),
    .gone_here_i(gone_here), .owe_status_o(owe_status), .owe_here_o(owe_here),
    .owe_feed_o(owe_feed), .clear_o(clear), .status_o(status)
  );
  assign safe_o  = !operate;
  assign state_o = {node[1], node[0] || listen};

  if (NumProd == 0) begin : gen_no_produce
    logic unused;
    assign unused = &{1'b0, event_i, differ, popped, claims};
    assign {want, visit, keep_same, same, cell_own, own_cell, no_write} = '0;
    assign then_job = can_rn_pkg::JobIdle;
  end else begin : gen_produce
    can_rn_produce #(.NumProd(NumProd)) u_produce (
      .clk_i, .rst_ni,
      .job_i(job), .phase_i(phase), .event_i, .ms_i(ms),
      .run_i(run), .forget_i(!run || off_entry),
      .closed_i(some || off || !numbered || claims), .popped_i(popped),
      .operate_i(operate),
      .refused_i(refused), .info_i(info), .mode_i(read_byte[7:4]), .zero_i(zero), .one_i(one),
      .row_i(row[2:0]), .first_i(row == 4'd0),
      .ended_i(ended), .differ_i(differ), .yield_i(hdr || urgent),
      .header_i(head_byte), .at_i(at), .status_i(tx_status),
      .want_o(want), .visit_o(visit), .then_o(then_job), .keep_o(keep_same), .same_o(same),
      .own_o(cell_own), .cell_o(own_cell), .no_write_o(no_write)
    );
  end

  if (NumMap == 0) begin : gen_no_map
    logic unused;
    assign unused = &{1'b0, id, ten};
    assign {find, hit, aim, mapped, act, acts, watch, map_cell} = '0;
    assign {map_we, more, stale, unsafe, told} = '0;
  end else begin : gen_map
    can_rn_map #(.NameBits(NameBits), .NumMap(NumMap)) u_map (
      .clk_i, .rst_ni,
      .job_i(job), .phase_i(phase), .run_i(run), .visit_i(visit || make), .ten_i(ten),
      .take_i(take), .id_i(id), .row_i(row), .begin_i(begins), .write_i(write),
      .refused_i(refused), .rdata_i(rdata), .byte_i(read_byte), .find_o(find), .hit_o(hit),
      .aim_o(aim), .mapped_o(mapped),
      .act_o(act), .acts_o(acts), .want_o(watch), .cell_o(map_cell),
      .more_o(more), .we_o(map_we), .stale_o(stale), .unsafe_o(unsafe), .told_o(told)
    );
  end

  if (Protect == 0) begin : gen_no_guard
    logic unused;
    assign unused = &{1'b0, crosses};
    assign {guard, guard_cell, denied} = '0;
  end else begin : gen_guard
    can_rn_guard u_guard (
      .clk_i, .rst_ni,
      .job_i(job), .late_i(phase[1]), .live_i(live), .memory_i((read || write) && !again),
      .read_i(read),
      .mem_i(mem[11:4]),
      .byte_i(read_byte), .guard_o(guard), .cell_o(guard_cell), .denied_o(denied)
    );
  end

  if (Block == 0) begin : gen_no_block
    logic unused;
    assign unused = &{1'b0, block, in_order, equal, sum};
    assign {make, answer, load_at, busy, part, order, again, excess, claims} = '0;
    assign {block_want, add_on, closes, timeout, block_own, block_cell, block_we} = '0;
    assign {block_no_write, block_less, block_more, add, length} = '0;
    assign {block_job, begun, block_then} = {3{can_rn_pkg::JobIdle}};
    assign shown = code;
  end else begin : gen_block
    can_rn_block #(.Protect(Protect != 0)) u_block (
      .clk_i, .rst_ni,
      .job_i(job), .phase_i(phase), .flush_i(flush), .ms_i(ms), .ten_i(ten),
      .ready_i(run && !off && numbered), .full_i(full), .some_i(some),
      .live_i(live), .block_i(block), .data_i(data), .first_i(row == 4'd0),
      .refused_i(refused), .code_i(code), .op_i(op[1:0]), .dlc_i(dlc), .row_i(row),
      .end_i(row_end[2:0]), .zero_i(zero), .one_i(one), .same_i(in_order), .equal_i(equal),
      .sum_i(sum),
      .visit_o(make), .answer_o(answer), .load_o(load_at), .length_o(length), .busy_o(busy),
      .order_o(order), .again_o(again), .over_o(excess), .part_o(part), .claims_o(claims),
      .want_o(block_want), .next_o(block_job), .begun_o(begun), .then_o(block_then),
      .on_o(add_on), .closes_o(closes), .timeout_o(timeout), .code_o(shown),
      .own_o(block_own), .cell_o(block_cell), .we_o(block_we),
      .no_write_o(block_no_write), .add_o(add), .less_o(block_less), .more_o(block_more)
    );
  end

  if (AutoRate == 0) begin : gen_no_rate
    logic unused;
    assign unused     = &{1'b0, rate_i, err, level};
    assign start_now  = start_i;
    assign {listen, listen_run} = '0;
    assign {presdiv, rjw} = {8'(Brp - 1), 2'(Sjw - 1)};
    assign {pseg1, pseg2, propseg} = {3'(Ps1 - 1), 3'(Ps2 - 1), 3'(Prop - 1)};
  end else begin : gen_rate
    logic [3:0]   rate_row;
    logic [284:0] rates;
    assign rates = RateTable;
    can_rn_rate #(.Rows(RateRows)) u_rate (
      .clk_i, .rst_ni, .start_i, .rate_i, .run_i(run), .error_i(|err), .valid_i(rx_valid),
      .tick_i(tick), .level_i(level), .start_o(start_now), .listen_o(listen),
      .run_o(listen_run), .row_o(rate_row)
    );
    assign {presdiv, rjw, pseg1, pseg2, propseg} = rates[19 * 9'(rate_row) +: 19];
  end

  if (Counters == 0) begin : gen_no_tally
    logic unused;
    assign unused = &{1'b0, count, over, dropped, clear, timeout};
    assign {tally, tally_own, tally_cell, tally_more, wide, tally_no_write} = '0;
  end else begin : gen_tally
    can_rn_tally u_tally (
      .clk_i, .rst_ni,
      .job_i(job), .phase_i(phase), .count_i(count), .same_i(in_order),
      .none_i(rx_dlc == 4'd0 || mapped), .refused_i(refused), .code_i(code),
      .dup_i(valid && dup), .dropped_i(dropped), .off_entry_i(off_entry), .over_i(over),
      .timeout_i(timeout), .clear_i(clear), .byte_i(read_byte),
      .want_o(tally), .own_o(tally_own), .cell_o(tally_cell), .more_o(tally_more),
      .wide_o(wide), .no_write_o(tally_no_write)
    );
  end

  assign pps_o        = time_pins[can_pkg::TimeStatOut];
  assign time_state_o = time_stat[can_regs_pkg::TsstatState +: can_regs_pkg::TsstatStateW];
  if (TimeSync == 0) begin : gen_no_time
    logic unused;
    assign unused   = &{1'b0, time_take_i, reads, read_word, time_stat, time_ofs, time_applied,
                        time_pins};
    assign rdata    = ram_rdata;
    assign time_cmd = '0;
  end else begin : gen_time
    logic unused;
    assign unused = &{1'b0, time_pins};
    can_rn_time u_time (
      .clk_i, .rst_ni, .re_i(reads), .raddr_i(read_word), .rdata_i(ram_rdata), .rdata_o(rdata),
      .apply_i(apply_o), .take_i(time_take_i), .stat_i(time_stat), .ofs_i(time_ofs),
      .ext_i(time_applied), .cmd_o(time_cmd)
    );
  end

  can_rn_off u_off (
    .clk_i, .rst_ni, .job_i(job), .last_i(phase[1]), .timer_i(timer), .byte_i(read_byte),
    .zero_i(zero), .off_o(off), .entry_o(off_entry), .exit_o(off_exit), .carry_o(carry),
    .release_o(release_off)
  );

  can_rn_tick #(.ClocksPerMs(ClocksPerMs)) u_tick (.clk_i, .rst_ni, .ms_o(ms));

endmodule
