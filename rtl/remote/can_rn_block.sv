// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_rn_block: block transfers (RN-40 to RN-43), one at a time. The bytes of a transfer's state
// are in the RAM, only what decisions need is in flip-flops. JobOpen sets it up from a BLOCK
// request. A DATA frame of a read, and the answer of BLOCK, are made like an answer of READ without
// a request. After each frame JobAdd adds the bytes moved to address and counts; JobClose stores
// the code.
//   0x008   address (2 bytes); 0x00A: answer of BLOCK: op, tag, code, 0, bytes done (2 bytes)
//   0x023   and each 4 on: bytes left (low, high), gap, sequence number of the next frame, clock

module can_rn_block #(
  parameter bit Protect = 1'b0
) (
  input  logic             clk_i,
  input  logic             rst_ni,
  input  can_rn_pkg::job_t job_i,        // present job
  input  logic [1:0]       phase_i,      // phase of the job
  input  logic             flush_i,      // transfers end without an answer
  input  logic             ms_i,         // pulse: millisecond
  input  logic             ten_i,        // pulse: every 10 ms
  input  logic             ready_i,      // node may send: on the bus, numbered, not in bus-off
  input  logic             full_i,       // queue of answers is full
  input  logic             some_i,       // queue of answers is not empty
  // Request
  input  logic             live_i,       // a frame for this node is under way
  input  logic             block_i,      // request is BLOCK
  input  logic             data_i,       // request is DATA
  input  logic             first_i,      // JobByte: first byte of the frame
  input  logic             refused_i,    // request is refused
  input  logic [3:0]       code_i,       // result code of the request
  input  logic [1:0]       op_i,         // op of BLOCK
  input  logic [3:0]       dlc_i,        // DLC of the frame, or length of the one made
  input  logic [3:0]       row_i,        // JobOpen: byte of the row
  input  logic [2:0]       end_i,        // index behind the last byte of the row
  // RAM
  input  logic             zero_i,       // byte read is 0
  input  logic             one_i,        // byte read is 1
  input  logic             same_i,       // sum_i equals the byte of the frame
  input  logic             equal_i,      // byte read equals the byte of the frame
  input  logic [8:0]       sum_i,        // byte to write, with carry
  output logic             visit_o,      // a frame of the transfer is made
  output logic             answer_o,     // that frame is the answer of BLOCK
  output logic             load_o,       // JobFetch: word read has the address
  output logic [3:0]       length_o,     // length of the frame that is made
  output logic             busy_o,       // a transfer is open or its answer not yet sent
  output logic             order_o,      // write: DATA has the expected sequence number
  output logic             again_o,      // write: DATA repeats the last frame
  output logic             over_o,       // write: DATA has more bytes than are left
  output logic             part_o,       // DATA of an open write, also an illegal one
  output logic             claims_o,     // next place in the queue is claimed
  output logic             want_o,       // next_o is due
  output can_rn_pkg::job_t next_o,       // next job of the transfer
  output can_rn_pkg::job_t begun_o,      // job after JobBegin while visit_o
  output can_rn_pkg::job_t then_o,       // job after the present one while visit_o
  output logic             on_o,         // JobAdd continues
  output logic             closes_o,     // JobAdd is followed by JobClose
  output logic             timeout_o,    // pulse: time-out of a write (BLKTO)
  output logic [3:0]       code_o,       // code to store: of the request, or of the end
  output logic             own_o,        // cell_o replaces the byte of the row
  output logic [8:0]       cell_o,       // byte to read or write; 0: none
  output logic             we_o,         // JobClose writes
  output logic             no_write_o,   // clock is 0: no write
  output logic [2:0]       add_o,        // added to the byte read
  output logic             less_o,       // ~add_o is added instead, in the clock after
  output logic             more_o        // 1 more is added, in the clock after
);
  localparam logic [2:0] VarLeft = 3'd0, VarGap = 3'd2, VarSeq = 3'd3, VarClock = 3'd4;

  logic read_q, write_q, answer_q, open_q, advance_q, close_q, late_q, abort_q;
  logic waiting_q, time_q, visit_q, order_q, again_q, any_q, few_q, key_q, copy_q;
  logic [1:0] turn_q;
  logic [2:0] left_q;

  logic idle, aim, seq, tick, add, open, close, push, count, key, last, ends, opens;
  assign idle  = job_i == can_rn_pkg::JobIdle;
  assign aim   = job_i == can_rn_pkg::JobFetch;
  assign seq   = job_i == can_rn_pkg::JobSeq;
  assign tick  = job_i == can_rn_pkg::JobClock;
  assign add   = job_i == can_rn_pkg::JobAdd;
  assign open  = job_i == can_rn_pkg::JobOpen;
  assign close = job_i == can_rn_pkg::JobClose;
  assign push  = job_i == can_rn_pkg::JobPush && visit_q;
  assign count = job_i == can_rn_pkg::JobCount && phase_i == 2'd2;
  assign key   = key_q && phase_i != 2'd0;
  assign last  = phase_i[1];
  assign ends  = &phase_i;
  assign opens = open && ends && row_i[3] && row_i[1];

  // State of the transfer, and the jobs that it needs.
  logic nothing_left, round3, aborts;
  assign nothing_left = few_q && left_q == 3'd0;
  assign round3       = &turn_q;
  assign aborts       = count && block_i && !refused_i && op_i == 2'd0 && (read_q || write_q);
  assign timeout_o    = tick && last && write_q && one_i;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {read_q, write_q, answer_q, open_q, advance_q, close_q, late_q, abort_q} <= '0;
    end else if (flush_i) begin
      {read_q, write_q, answer_q, open_q, advance_q, close_q, late_q, abort_q} <= '0;
    end else begin
      read_q    <= (opens && op_i[0]) || (read_q && !close);
      write_q   <= (opens && op_i[1]) || (write_q && (!close || open_q));
      open_q    <= (opens && op_i[1]) || (open_q && !close);
      answer_q  <= close || (answer_q && !(push && answer_q));
      advance_q <= (push && !answer_q) || (count && data_i && !refused_i && !visit_q)
                   || (advance_q && !(add && ends && round3));
      close_q   <= aborts || timeout_o || (close_q && !close);
      abort_q   <= aborts || (abort_q && !close);
      late_q    <= timeout_o || (late_q && !close);
    end
  end

  // For a write: position of a DATA frame in the sequence. For both: bytes left, exact below 8.
  logic left_write;
  assign left_write = last && ((open && row_i[3:1] == 3'd3) || (add && turn_q == 2'd2));
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {order_q, again_q, any_q, few_q, key_q, copy_q} <= '0;
      left_q <= '0;
      turn_q <= '0;
    end else begin
      if (key) {order_q, again_q} <= {equal_i, same_i};
      key_q  <= job_i == can_rn_pkg::JobByte && data_i && first_i;
      copy_q <= open;
      any_q <= !open && (any_q || (advance_q && write_q));
      if (left_write && !phase_i[0]) left_q <= sum_i[2:0];
      if (left_write) few_q <= phase_i[0] ? few_q && sum_i[7:0] == 8'd0 : sum_i[7:3] == 5'd0;
      // If no frame has been moved (JobOpen), JobAdd only starts the clock (round 3).
      if (add ? ends : idle) turn_q <= add ? turn_q + 2'd1 : {2{!advance_q}};
    end
  end
  assign busy_o  = read_q || write_q || answer_q;
  assign order_o = write_q && order_q;
  assign again_o = write_q && again_q && any_q && data_i && !visit_o;
  assign part_o  = write_q && data_i && code_i != can_rn_pkg::CodeFunction;
  assign over_o  = write_q && few_q && dlc_i > {1'b0, left_q} + 4'd1;

  // Clock: gap in ms between frames of a read; BLKTO in steps of 10 ms for a write.
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {waiting_q, time_q, visit_q} <= '0;
    end else begin
      if (open)                       waiting_q <= 1'b0;
      else if (add && ends && round3) waiting_q <= read_q && !zero_i;
      else if (tick && last)          waiting_q <= waiting_q && !one_i && !zero_i;
      time_q  <= (write_q ? ten_i : ms_i && waiting_q) || (time_q && !(tick && last) && !open);
      visit_q <= (aim && !live_i) || (visit_q && !idle);
    end
  end

  // A frame is made: DATA if the queue is empty, the answer of BLOCK if the queue has room.
  logic send;
  assign send     = ready_i && (answer_q ? !full_i
                                         : read_q && !waiting_q && !some_i && !advance_q);
  assign claims_o = answer_q || (read_q && !waiting_q);
  assign visit_o  = visit_q;
  assign answer_o = visit_o && answer_q;
  assign load_o   = aim && phase_i == 2'd1;
  assign length_o = answer_q ? 4'd6 : few_q && !(&left_q) ? {1'b0, left_q} + 4'd1 : 4'd8;

  assign want_o = advance_q || open_q || close_q || time_q || send;
  always_comb begin
    next_o = can_rn_pkg::JobFetch;
    if (time_q)              next_o = can_rn_pkg::JobClock;
    if (close_q)             next_o = can_rn_pkg::JobClose;
    if (advance_q || open_q) next_o = can_rn_pkg::JobAdd;
    begun_o = answer_q ? can_rn_pkg::JobMove : can_rn_pkg::JobSeq;
    if (refused_i) begun_o = can_rn_pkg::JobClose;
    then_o = can_rn_pkg::JobIdle;
    if (aim) then_o = Protect ? can_rn_pkg::JobGuard : can_rn_pkg::JobBegin;
    if (job_i == can_rn_pkg::JobGuard) then_o = can_rn_pkg::JobBegin;
    if (seq) then_o = can_rn_pkg::JobMove;
  end
  assign on_o     = !(ends && round3);
  assign closes_o = open_q || (nothing_left && !close_q);
  always_comb begin
    code_o = code_i;
    if (abort_q)      code_o = can_rn_pkg::CodeAborted;
    if (nothing_left) code_o = can_rn_pkg::CodeOk;
    if (late_q)       code_o = can_rn_pkg::CodeTimeout;
    if (open_q)       code_o = can_rn_pkg::CodeOpen;
    if (job_i == can_rn_pkg::JobCount)
      code_o = code_i | (can_rn_pkg::CodeOpen & {4{block_i && op_i[1] && !refused_i}});
  end

  // Bytes. JobOpen copies the frame, two bytes a round; bytes that it lacks are 0. The rounds of
  // JobAdd are address, bytes done, bytes left, and sequence number with clock.
  logic [2:0] moved;
  assign moved = write_q ? end_i - 3'd1 : few_q ? left_q : 3'd7;
  // Kept until they have been added: the length of the frame changes when the node begins to send
  // an answer that waits, the bytes left with the third round.
  logic [2:0] moved_q;
  logic       adds_q;
  assign add_o = moved_q & {3{adds_q}};
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      moved_q <= '0;
      adds_q  <= 1'b0;
    end else begin
      if (!advance_q) moved_q <= moved;
      adds_q <= add && !round3 && phase_i == 2'd1;
    end
  end
  assign less_o = (add && turn_q == 2'd2) || key || tick;
  assign more_o = add && (last ? sum_i[8] && !round3 : turn_q == 2'd2 || (round3 && !open_q));
  assign no_write_o = tick && zero_i;
  assign we_o       = close;

  function automatic logic [8:0] var_cell(input logic [2:0] index);
    var_cell = {4'b0001, index, 2'b11};
  endfunction
  logic [2:0] round;
  logic       none;
  assign round = open ? row_i[3:1] : {1'b0, turn_q};
  assign none  = row_i[3] || ((&row_i[2:1]) && (row_i[0] || !dlc_i[0]));
  assign own_o = key || (copy_q && (last || none));
  always_comb begin
    cell_o = var_cell(VarSeq);
    if (tick)  cell_o = var_cell(VarClock);
    if (aim)   cell_o = 9'h008;
    if (close) cell_o = 9'h00C;
    if (add) begin
      case (turn_q)
        2'd0:    cell_o = {8'h04, phase_i[0]};
        2'd1:    cell_o = {8'h07, phase_i[0]};
        2'd2:    cell_o = var_cell({VarLeft[2:1], phase_i[0]});
        default: if (phase_i[0]) cell_o = last ? var_cell(VarClock)
                                               : write_q ? 9'h106 : var_cell(VarGap);
      endcase
    end
    if (open) begin
      case (round)
        3'd1:    cell_o = {8'h05, phase_i[0]};
        3'd2:    cell_o = {8'h04, phase_i[0]};
        3'd3:    cell_o = var_cell({VarLeft[2:1], phase_i[0]});
        3'd4:    cell_o = var_cell({VarGap[2:1], phase_i[0]});
        default: cell_o = {8'h07, phase_i[0]};
      endcase
      if (!last) cell_o = none ? 9'h006 : '0;
    end
    if (!(aim || tick || add || close || key || (seq && !last) || open)) cell_o = '0;
  end
endmodule
