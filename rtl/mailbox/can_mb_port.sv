// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_mb_port: arbiter of the buffer RAMs (C/S words; identifiers and data, MSG; masks). They share
// one read and one write port; in each clock either port serves the CPU or the engine.
//
// A CPU access takes two clocks: it owns the read port in the first and the write port in the
// second. So it always has one wait state, its address comes from registers, and at least every
// second clock of either port is free: for reads of insertions (can_mb_tx) and of the engine
// (can_mb_step); for writes of copies (can_mb_step), serviced marks (can_mb_lock) and the frame
// being received (can_mb_smb). A copy reads in one clock and writes in the next. As nobody else
// reads in the CPU's first clock, no copy writes in its second.
//
// A block RAM returns undefined data for a word that is being written. An engine read that collides
// is flagged (stale_o, id_stale_o). While the CPU reads, only a copy can write the same word; the
// RAM is then not read, because its outputs already hold the word that is copied. A serviced mark
// may hit the C/S word that a CPU write looks up; can_mb_guard allows for that.

module can_mb_port #(
  parameter int NumMb = 64,
  /// Features, see can_top.
  parameter int OwnMasks = 1,
  parameter int ClearRam = 1,
  parameter int TimeUnit = 0,
  /// Derived, do not override.
  localparam int IdxW = $clog2(NumMb)
) (
  input  logic            clk_i,
  input  logic            rst_ni,
  // CPU command, taken in a clock with ready_o = 1. Memories and their words: can_mb_pkg::Mem*.
  input  logic            cmd_rd_i,
  input  logic            cmd_wr_i,
  input  logic [1:0]      cmd_mem_sel_i,
  input  logic [1:0]      cmd_word_i,
  input  logic [IdxW-1:0] cmd_idx_i,
  input  logic [3:0]      cmd_be_i,
  // CPU access: the two clocks after the command.
  input  logic [IdxW-1:0] row_idx_i,    // row of buffer idx_o; differs at the output of the Rx FIFO
  input  logic [31:0]     wdata_i,      // data as it is to be stored (can_mb_cpu)
  input  logic            ring_i,       // 1, first clock: a write is discarded (Rx FIFO memory)
  input  logic            block_i,      // 1, second clock: a write is discarded (MCR.AEN)
  input  logic            if_ended_i,   // 1, second clock: a write is discarded if cs_o has CsEnded
  output logic            ready_o,      // 1: last clock of an access, or none; takes a command
  output logic            rd_word_o,    // 1: the read that ends in this clock returns word_o
  output logic [31:0]     rdata_o,      // mask or stamp, if the read that ends returns one; else 0
  output logic            rd_end_o,     // 1: word_o, C/S of a sent frame, still has its old code
  output logic            rd_done_o,    // 1 in the second clock of a read
  output logic            wr_o,         // 1 in both clocks of a write
  output logic            wr_done_o,    // 1 in the second clock of a write; cs_o is valid then
  output logic [1:0]      mem_sel_o,    // memory that is accessed, can_mb_pkg::Mem*
  output logic            rxfir_o,      // MemCs: 1 RXFIR, 0 C/S word; MemTimer: 1 TIMER, 0 stamp
  output logic [IdxW-1:0] idx_o,        // buffer that is accessed
  output logic [3:0]      be_o,         // byte lanes of the access
  // Reads of insertions (ins_*, can_mb_tx) and of the engine; data in the clock after the grant.
  input  logic            ins_req_i,
  input  logic [IdxW-1:0] ins_idx_i,
  output logic            ins_gnt_o,
  input  logic            eng_req_i,
  input  logic            eng_lazy_i,   // 1: low-priority pass (ESR2), the request may wait
  input  logic            eng_pass_i,   // 1: a pass for the winner is under way and will ask again
  input  logic            eng_cs_i,     // 1: the wanted word is in the C/S memory; 0: in MSG
  input  logic [IdxW:0]   eng_cs_row_i,
  input  logic [IdxW+1:0] eng_msg_row_i,
  input  logic [IdxW:0]   eng_mask_row_i,
  output logic            eng_slot_o,   // 1: the read slot is the engine's, whether it asks or not
  output logic            stale_o,      // 1, with the data: the C/S row was written while read
  output logic            id_stale_o,   // 1, with the data: the MSG row was written while read
  output logic [31:0]     cs_o,
  output logic [31:0]     msg_o,
  output logic [31:0]     mask_o,
  output logic [31:0]     word_o,       // cs_o or msg_o, whichever the reader asked for
  // Second half of a copy (can_mb_step): its write.
  input  logic            copy_i,       // 1: a copy writes in this clock
  input  logic            copy_cs_i,    // 1: the copy goes to the C/S memory; 0: to MSG
  input  logic [3:0]      copy_be_i,
  input  logic            copy_off_i,   // 1: the copy is cancelled; only if it goes to a buffer
  input  logic            copy_end_i,   // 1: the copy is the end of a sent frame (StepEnd)
  input  logic [IdxW+1:0] copy_row_i,
  input  logic [31:0]     copy_data_i,
  // Serviced mark (can_mb_lock): writes the top byte of the C/S word of buffer serviced_idx_i.
  input  logic            serviced_req_i,
  input  logic [IdxW-1:0] serviced_idx_i,
  input  logic            serviced_ovr_i,  // 1: code OVERRUN is written; 0: FULL
  output logic            serviced_gnt_o,
  // Writes of the frame being received to its hidden rows (can_mb_smb).
  input  logic            rx_wr_req_i,
  input  logic            rx_wr_cs_i,   // 1: the write goes to the C/S memory; 0: to MSG
  input  logic [3:0]      rx_wr_be_i,
  input  logic [IdxW+1:0] rx_wr_row_i,
  input  logic [31:0]     rx_wr_data_i,
  output logic            rx_wr_gnt_o,
  // Memory of the stamps, see can_mb_stamp.
  output logic            stamp_re_o,   // 1: the stamp memory reads a row
  output logic            stamp_cpu_o,  // 1: the read slot is the CPU's
  output logic [IdxW:0]   stamp_row_o,  // {upper half, buffer}
  input  logic            stamp_shown_i,  // 1: stamp_rdata_i holds row stamp_row_o already
  input  logic [31:0]     stamp_rdata_i,
  // After a hard reset all rows are cleared, one a clock; other writes to the RAMs are lost.
  output logic            scrub_o,      // 1: row scrub_row_o of the RAMs is being cleared
  output logic [IdxW+1:0] scrub_row_o
);
  logic [IdxW+1:0] scrub_row_q;
  if (ClearRam != 0) begin : gen_scrub
    always_ff @(posedge clk_i or negedge rst_ni) begin
      if (!rst_ni) begin
        scrub_o     <= 1'b1;
        scrub_row_q <= '0;
      end else if (scrub_o) begin
        scrub_o     <= scrub_row_q != '1;
        scrub_row_q <= scrub_row_q + 1'b1;
      end
    end
  end else begin : gen_no_scrub
    assign scrub_o     = 1'b0;
    assign scrub_row_q = '0;
  end

  // CPU access. first_q and ready_q are complements, each in its own flip-flop because of the large
  // fan-out: first_q drives the addresses, ready_q everything else.
  logic            rd_q, wr_q, first_q, ready_q, begins;
  logic [1:0]      mem_sel_q, word_q;
  logic [IdxW-1:0] idx_q;
  logic [3:0]      be_q;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {rd_q, wr_q, first_q} <= '0;
      ready_q <= 1'b1;
      {mem_sel_q, word_q} <= '0;
      idx_q <= '0;
      be_q <= '0;
    end else begin
      first_q <= begins;
      ready_q <= !begins;
      if (ready_q) begin
        rd_q      <= cmd_rd_i;
        wr_q      <= cmd_wr_i;
        mem_sel_q <= cmd_mem_sel_i;
        word_q    <= cmd_word_i;
        idx_q     <= cmd_idx_i;
        be_q      <= cmd_be_i;
      end
    end
  end
  assign begins    = ready_q && (cmd_rd_i || cmd_wr_i);
  assign ready_o   = ready_q;
  assign rd_done_o = rd_q && ready_q;
  assign wr_o      = wr_q;
  assign wr_done_o = wr_q && ready_q;
  assign mem_sel_o = mem_sel_q;
  assign rxfir_o   = !word_q[1];
  assign idx_o     = idx_q;
  assign be_o      = be_q;

  // Read port. After an insertion the next Turns slots are the engine's while it wants slots: a CPU
  // that keeps writing C/S words causes an insertion in every second clock and reads in the others,
  // which would leave the engine none.
  localparam logic [2:0] Turns = 3'd5;
  logic       cpu_rd, wish, engine_first_q;
  logic [2:0] turns_q;
  assign cpu_rd     = first_q;          // a write reads its buffer's C/S word (can_mb_guard)
  assign wish       = (eng_req_i && !eng_lazy_i) || eng_pass_i;
  assign ins_gnt_o  = ins_req_i && ready_q && !engine_first_q;
  assign eng_slot_o = ready_q && (!ins_req_i || engine_first_q);
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      engine_first_q <= 1'b0;
      turns_q        <= '0;
    end else begin
      engine_first_q <= wish && (ins_gnt_o || turns_q != '0);
      turns_q        <= ins_gnt_o ? Turns : turns_q - 3'(eng_slot_o && turns_q != '0);
    end
  end

  // Write port.
  logic cpu_wr_q, of_cs, of_msg;
  assign of_cs  = mem_sel_q == can_mb_pkg::MemCs;
  assign of_msg = mem_sel_q == can_mb_pkg::MemMsg;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) cpu_wr_q <= 1'b0;
    else         cpu_wr_q <= first_q && wr_q && mem_sel_q != can_mb_pkg::MemTimer && !ring_i;
  end
  // No mark while the CPU reads; the C/S look-up of a write may collide (can_mb_guard, mark_i).
  assign serviced_gnt_o = serviced_req_i && !copy_i && !cpu_wr_q && !(first_q && rd_q);
  assign rx_wr_gnt_o    = rx_wr_req_i && !copy_i && !cpu_wr_q && !serviced_gnt_o;

  logic [IdxW:0]   cs_row, cs_raddr, mask_raddr;
  logic [IdxW+1:0] msg_row, msg_raddr;
  assign cs_row     = ins_gnt_o ? {1'b0, ins_idx_i} : eng_cs_row_i;
  assign msg_row    = ins_gnt_o ? {2'b00, ins_idx_i} : eng_msg_row_i;
  assign cs_raddr   = cpu_rd ? {1'b0, row_idx_i} : cs_row;
  assign msg_raddr  = cpu_rd ? {word_q, row_idx_i} : msg_row;
  assign mask_raddr = cpu_rd ? {word_q[0], row_idx_i} : eng_mask_row_i;

  // Without OwnMasks the global masks are in the MSG memory.
  function automatic logic in_msg(input logic [1:0] mem_sel);
    in_msg = OwnMasks == 0 && mem_sel == can_mb_pkg::MemMask;
  endfunction

  function automatic logic of_stamp(input logic [1:0] mem_sel, input logic high_word);
    of_stamp = TimeUnit != 0 && mem_sel == can_mb_pkg::MemTimer && high_word;
  endfunction

  // Write: memory, row, byte lanes, data. Who writes is known early; whether the write is
  // suppressed (off) depends on the RAM outputs and is late, so it gates the write enables last.
  logic            w_cs, w_msg, w_mask, off;
  logic [IdxW+1:0] w_row;
  logic [3:0]      w_be, we_cs, we_msg, we_mask;
  logic [31:0]     w_data;
  always_comb begin
    // Default: the frame being received.
    {w_cs, w_msg, w_mask} = {rx_wr_cs_i, !rx_wr_cs_i, 1'b0};
    w_row  = rx_wr_row_i;
    w_data = rx_wr_data_i;
    w_be   = rx_wr_be_i & {4{rx_wr_req_i}};
    if (scrub_o) begin
      // The last quarter writes ones: the reset value of the global masks, in either memory. The
      // C/S memory has half as many rows as MSG and is cleared in the first half only.
      {w_cs, w_msg, w_mask} = {!scrub_row_q[IdxW+1], 2'b11};
      w_row  = scrub_row_q;
      w_data = {32{&scrub_row_q[IdxW+1:IdxW]}};
      w_be   = '1;
    end else if (cpu_wr_q) begin
      {w_cs, w_msg, w_mask} = {of_cs, of_msg || in_msg(mem_sel_q),
                               mem_sel_q == can_mb_pkg::MemMask};
      w_row  = {word_q & {2{!of_cs}}, idx_q};
      w_data = wdata_i;
      w_be   = be_q;
    end else if (copy_i) begin
      {w_cs, w_msg, w_mask} = {copy_cs_i, !copy_cs_i, 1'b0};
      w_row  = copy_row_i;
      w_data = copy_data_i;
      w_be   = copy_be_i;
    end else if (serviced_gnt_o) begin
      {w_cs, w_msg, w_mask} = 3'b100;
      w_row  = {2'b00, serviced_idx_i};
      w_data[31:24] = {4'd1 << (can_mb_pkg::CsServiced - 28),
                       serviced_ovr_i ? can_regs_pkg::MbCsCodeRxOverrun
                                      : can_regs_pkg::MbCsCodeRxFull};
      w_be   = 4'b1000;
    end
  end
  assign off = (if_ended_i && cs_o[can_mb_pkg::CsEnded])
               || (!scrub_o && (cpu_wr_q ? block_i : copy_i && copy_off_i));
  assign we_cs   = w_be & {4{w_cs}} & {4{!off}};
  assign we_msg  = w_be & {4{w_msg}} & {4{!off}};
  assign we_mask = w_be & {4{w_mask}} & {4{!off}};

  // shown: a copy writes the word that the CPU reads; the RAM outputs already hold it.
  logic shown;
  assign shown = cpu_rd && ((copy_i && !copy_off_i && copy_row_i[IdxW-1:0] == row_idx_i
              && (copy_cs_i ? (wr_q || of_cs) && !copy_row_i[IdxW]
                            : !wr_q && of_msg && copy_row_i[IdxW+1:IdxW] == word_q))
              || (stamp_shown_i && of_stamp(mem_sel_q, word_q[1])));

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {rd_end_o, stale_o, id_stale_o} <= '0;
    end else begin
      rd_end_o   <= shown && copy_end_i;
      stale_o    <= we_cs[3] && w_row[IdxW:0] == cs_row;
      id_stale_o <= we_msg != '0 && w_row == msg_row;
    end
  end

  // Reads that nobody asked for are harmless: the RAMs are read in all other clocks.
  logic re;
  assign re = !shown;
  assign stamp_re_o  = re;
  assign stamp_cpu_o = cpu_rd;
  assign stamp_row_o = {word_q[0], row_idx_i};
  assign scrub_row_o = scrub_row_q;
  can_mb_ram #(.Depth(2 * NumMb)) u_cs (
    .clk_i, .re_i(re), .raddr_i(cs_raddr), .rdata_o(cs_o),
    .we_i(we_cs), .waddr_i(w_row[IdxW:0]), .wdata_i(w_data));
  can_mb_ram #(.Depth(4 * NumMb)) u_msg (
    .clk_i, .re_i(re), .raddr_i(msg_raddr), .rdata_o(msg_o),
    .we_i(we_msg), .waddr_i(w_row), .wdata_i(w_data));
  if (OwnMasks != 0) begin : gen_mask
    can_mb_ram #(.Depth(2 * NumMb)) u_mask (
      .clk_i, .re_i(re), .raddr_i(mask_raddr), .rdata_o(mask_o),
      .we_i(we_mask), .waddr_i(w_row[IdxW:0]), .wdata_i(w_data));
  end else begin : gen_no_mask
    logic unused;
    assign unused = &{1'b0, mask_raddr, we_mask};
    assign mask_o = msg_o;
  end

  // Selects the word for the reader of the clock before.
  logic word_cs_q;
  assign word_o = word_cs_q ? cs_o : msg_o;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) word_cs_q <= 1'b0;
    else if (re) word_cs_q <= cpu_rd ? of_cs : eng_cs_i;
  end

  logic shows;
  assign shows     = rd_done_o && !scrub_o;
  assign rd_word_o = shows && (of_cs || of_msg);
  assign rdata_o   = (stamp_rdata_i & {32{shows && of_stamp(mem_sel_q, word_q[1])}})
                   | (mask_o & {32{shows && mem_sel_q == can_mb_pkg::MemMask}});
endmodule
