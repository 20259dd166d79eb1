// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_mb_port: who reads and who writes the buffer RAMs in each clock; CPU and engine share one
// read and one write port.
//
// An access of the CPU takes two clocks. In the first the CPU has the read port, in the second the
// write port. So it always waits one clock, its address comes from registers, and of two clocks one
// at least is free for others at either port: insertions (can_mb_tx) and the engine; copies, of
// which only the second half writes (its data is on the RAM outputs only then), serviced marks and
// the frame being received. Because nobody else reads in the first clock nobody copies in the
// second.
//
// A block RAM returns nothing certain for a word that is being written. The engine is told (stale).
// Of what is written while the CPU reads, only a copy can be the word that it reads: then the RAM
// is not read at all, because its outputs show what is being copied (can_mb_step). A serviced
// mark may be written to the word that a write looks at: can_mb_guard is told.

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
  // CPU, command: only while ready_o. mem_sel: 0 C/S (word 3; 1: RXFIR, the same row), 1 ID or data
  // (word 0..2), 2 mask (word[0]: hidden row; without OwnMasks word 3 of the MSG memory), 3 no RAM,
  // but ordered like one (TIMER); with word[1] a stamp (word[0]: upper half).
  input  logic            cmd_rd_i,
  input  logic            cmd_wr_i,
  input  logic [1:0]      cmd_mem_sel_i,
  input  logic [1:0]      cmd_word_i,
  input  logic [IdxW-1:0] cmd_idx_i,
  input  logic [3:0]      cmd_be_i,
  // CPU, data: two clocks.
  input  logic [IdxW-1:0] row_idx_i,    // row of idx_o: not the same at the output of the Rx FIFO
  input  logic [31:0]     wdata_i,
  input  logic            ring_i,       // not to be written: memory of the Rx FIFO;
  input  logic            block_i,      // ... in the second clock: MCR.AEN,
  input  logic            if_ended_i,   // ... if its buffer's transmission has ended
  output logic            ready_o,      // the second one, or none
  output logic            rd_word_o,    // it reads word_o
  output logic [31:0]     rdata_o,      // ... something else: a mask, a stamp
  output logic            rd_end_o,     // ... but for the code: that of a frame that has been sent
  output logic            rd_done_o,    // a read ends in this clock
  output logic            wr_o,         // a write ends in this clock, or the next one
  output logic            wr_done_o,    // ... in this clock; cs_o is what it has read
  output logic [1:0]      mem_sel_o,
  output logic            rxfir_o,      // mem_sel 0: RXFIR, not C/S; 3: TIMER, not a stamp
  output logic [IdxW-1:0] idx_o,
  output logic [3:0]      be_o,
  // Engine reads; data in the clock after the grant.
  input  logic            ins_req_i,
  input  logic [IdxW-1:0] ins_idx_i,
  output logic            ins_gnt_o,
  input  logic            eng_req_i,
  input  logic            eng_lazy_i,   // for ESR2 alone
  input  logic            eng_pass_i,   // a pass for the winner is under way: it asks again soon
  input  logic            eng_cs_i,     // what it wants is in the C/S memory, not in MSG
  input  logic [IdxW:0]   eng_cs_row_i,
  input  logic [IdxW+1:0] eng_msg_row_i,
  input  logic [IdxW:0]   eng_mask_row_i,
  output logic            eng_slot_o,   // the slot is the engine's, whether it asks or not
  output logic            stale_o,      // with the data: this C/S row was being written when read
  output logic            id_stale_o,   // the same of the MSG row
  output logic [31:0]     cs_o,
  output logic [31:0]     msg_o,
  output logic [31:0]     mask_o,
  output logic [31:0]     word_o,       // cs_o or msg_o, as was asked for
  // Second half of a copy.
  input  logic            copy_i,
  input  logic            copy_cs_i,    // C/S memory, not MSG
  input  logic [3:0]      copy_be_i,
  input  logic            copy_off_i,   // nothing is written, to a row that the CPU can read
  input  logic            copy_end_i,   // the end of a frame sent
  input  logic [IdxW+1:0] copy_row_i,
  input  logic [31:0]     copy_data_i,
  // Serviced mark: top byte of a C/S word.
  input  logic            serviced_req_i,
  input  logic [IdxW-1:0] serviced_idx_i,
  input  logic            serviced_ovr_i,
  output logic            serviced_gnt_o,
  // Engine writes, to hidden rows.
  input  logic            rx_wr_req_i,
  input  logic            rx_wr_cs_i,
  input  logic [3:0]      rx_wr_be_i,
  input  logic [IdxW+1:0] rx_wr_row_i,
  input  logic [31:0]     rx_wr_data_i,
  output logic            rx_wr_gnt_o,
  // Memory of the stamps, see can_mb_stamp.
  output logic            stamp_re_o,
  output logic            stamp_cpu_o,
  output logic [IdxW:0]   stamp_row_o,
  input  logic            stamp_shown_i,
  input  logic [31:0]     stamp_rdata_i,
  // After a hard reset: every row is written once, whatever else goes on.
  output logic            scrub_o,
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

  // CPU transfer in its data phase.
  // The same twice, for both have many loads: first_q for addresses, ready_q for the rest.
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

  // Read port. Behind an insertion the engine has its turn, as long as it wants slots: a CPU that
  // writes C/S words for ever asks for an insertion in every second clock, and the other clocks are
  // its own.
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
  // None while the CPU reads, but for the look of a write.
  assign serviced_gnt_o = serviced_req_i && !copy_i && !cpu_wr_q && !(first_q && rd_q);
  assign rx_wr_gnt_o    = rx_wr_req_i && !copy_i && !cpu_wr_q && !serviced_gnt_o;

  logic [IdxW:0]   cs_row, cs_raddr, mask_raddr;
  logic [IdxW+1:0] msg_row, msg_raddr;
  assign cs_row     = ins_gnt_o ? {1'b0, ins_idx_i} : eng_cs_row_i;
  assign msg_row    = ins_gnt_o ? {2'b00, ins_idx_i} : eng_msg_row_i;
  assign cs_raddr   = cpu_rd ? {1'b0, row_idx_i} : cs_row;
  assign msg_raddr  = cpu_rd ? {word_q, row_idx_i} : msg_row;
  assign mask_raddr = cpu_rd ? {word_q[0], row_idx_i} : eng_mask_row_i;

  // Masks without a memory of their own.
  function automatic logic in_msg(input logic [1:0] mem_sel);
    in_msg = OwnMasks == 0 && mem_sel == can_mb_pkg::MemMask;
  endfunction

  function automatic logic of_stamp(input logic [1:0] mem_sel, input logic high_word);
    of_stamp = TimeUnit != 0 && mem_sel == can_mb_pkg::MemTimer && high_word;
  endfunction

  // The word that is written: memory, row, byte lanes, data. Who would write is known early; that
  // it may not (off), late: so this comes last.
  logic            w_cs, w_msg, w_mask, off;
  logic [IdxW+1:0] w_row;
  logic [3:0]      w_be, we_cs, we_msg, we_mask;
  logic [31:0]     w_data;
  always_comb begin
    // The engine, unless it is somebody else.
    {w_cs, w_msg, w_mask} = {rx_wr_cs_i, !rx_wr_cs_i, 1'b0};
    w_row  = rx_wr_row_i;
    w_data = rx_wr_data_i;
    w_be   = rx_wr_be_i & {4{rx_wr_req_i}};
    if (scrub_o) begin
      // The rows of masks that no buffer has are ones; the C/S rows were zeroed in the first half.
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
      w_data[31:24] = {4'b1000, 1'b0, serviced_ovr_i, 2'b10};
      w_be   = 4'b1000;
    end
  end
  assign off = (if_ended_i && cs_o[can_mb_pkg::CsEnded])
               || (!scrub_o && (cpu_wr_q ? block_i : copy_i && copy_off_i));
  assign we_cs   = w_be & {4{w_cs}} & {4{!off}};
  assign we_msg  = w_be & {4{w_msg}} & {4{!off}};
  assign we_mask = w_be & {4{w_mask}} & {4{!off}};

  // The CPU reads the word that a copy writes.
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

  // To read where nothing was asked for is harmless.
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

  // The word that the reader has asked for.
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
