// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_mb_port: who reads and who writes the buffer RAMs in each clock; CPU and engine share one
// read and one write port, and the CPU never waits more than one clock.
//
// Reads, by priority: a CPU read that has waited; an insertion (can_mb_tx); the engine if it was
// refused before; the CPU; the engine. Writes: a CPU write that has waited; the second half of a
// copy (its data is on the RAM outputs only now); a serviced mark; the engine if it was refused
// before; the CPU; the engine. C/S writes in a row make room for engine reads, because each brings
// an insertion. One word of one RAM is written in a clock.
//
// A block RAM returns nothing certain for a word that is being written. The engine is told (stale);
// a read of the CPU is made again in the next clock, in which nobody writes that word but a copy:
// then the RAM is not read at all, because its outputs show what is being copied (can_mb_step).

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
  input  logic            cmd_slot_i,   // cmd_rd_i may be set: early, for who gets the read port
  input  logic            cmd_rd_i,
  input  logic            cmd_wr_i,
  input  logic            cmd_look_i,   // a write that first reads its buffer's C/S word ...
  input  logic [1:0]      cmd_mem_sel_i,
  input  logic [1:0]      cmd_word_i,
  input  logic [IdxW-1:0] cmd_idx_i,
  input  logic [3:0]      cmd_be_i,
  // CPU, data: from the next clock until ready_o.
  input  logic            look_i,       // ... if this is set
  input  logic [31:0]     wdata_i,
  input  logic            block_i,      // not to be written
  output logic            ready_o,
  output logic [31:0]     rdata_o,      // of kinds 0..2
  output logic            rd_done_o,    // a read ends in this clock
  output logic            wr_o,         // a write ends in this clock, or the next one
  output logic            wr_done_o,    // ... in this clock
  output logic            waited_o,     // ... and has waited for it; cs_o is what it has read
  output logic [1:0]      mem_sel_o,
  output logic            rxfir_o,      // mem_sel 0: RXFIR, not C/S; 3: TIMER, not a stamp
  output logic [IdxW-1:0] idx_o,
  output logic [3:0]      be_o,
  // Engine reads; data in the clock after the grant.
  input  logic            ins_req_i,
  input  logic [IdxW-1:0] ins_idx_i,
  output logic            ins_gnt_o,
  input  logic            eng_req_i,
  input  logic            eng_lazy_i,   // gives way to the CPU every time
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
  // Second half of a copy; hold_o: not in this clock, a CPU write has waited for long enough. The
  // RAM outputs stay as they are then: nobody reads.
  input  logic            copy_i,
  output logic            hold_o,
  input  logic            copy_cs_i,    // C/S memory, not MSG
  input  logic [3:0]      copy_be_i,
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
  output logic            rx_wr_owed_o,   // one was refused: no copy is to begin
  // Memory of the stamps, see can_mb_stamp.
  output logic            stamp_re_o,
  output logic            stamp_cpu_o,
  output logic [IdxW:0]   stamp_row_o,
  output logic [IdxW:0]   stamp_held_row_o,
  output logic            stamp_again_o,
  output logic [IdxW:0]   stamp_cmd_row_o,
  input  logic            stamp_meets_i,
  input  logic            stamp_shown_i,
  input  logic [31:0]     stamp_rdata_i,
  // After a hard reset: every row is written once, whatever else goes on.
  output logic            scrub_o,
  output logic [IdxW+1:0] scrub_row_o,
  input  logic            cs_written_i         // a C/S write ended in the clock before
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
  logic            rd_q, wr_q;
  logic [1:0]      mem_sel_q, word_q;
  logic [IdxW-1:0] idx_q;
  logic [3:0]      be_q;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {rd_q, wr_q} <= '0;
      {mem_sel_q, word_q} <= '0;
      idx_q <= '0;
      be_q <= '0;
    end else if (ready_o) begin
      rd_q   <= cmd_rd_i;
      wr_q   <= cmd_wr_i;
      mem_sel_q <= cmd_mem_sel_i;
      word_q <= cmd_word_i;
      idx_q  <= cmd_idx_i;
      be_q   <= cmd_be_i;
    end
  end

  // Read port. An engine write that was refused claims a slot too: reads of C/S words in a row,
  // each with its serviced mark, would keep it out otherwise.
  logic pend_q, pend, owed_q, want, cpu_gnt, rx_wr_owed_q;
  assign pend      = pend_q && !(wr_q && !look_i);
  assign want      = (eng_req_i && !eng_lazy_i) || rx_wr_owed_q;
  assign cpu_gnt   = pend || (cmd_slot_i && !ins_req_i && !owed_q && !hold_o);
  assign ins_gnt_o = ins_req_i && !pend;
  assign eng_slot_o = !pend && !ins_req_i && !hold_o && (!cmd_slot_i || owed_q);

  // Write port.
  logic wait_q, w_gnt, ram_wr, wr_waits, of_cs, of_msg;
  assign of_cs     = mem_sel_q == can_mb_pkg::MemCs;
  assign of_msg    = mem_sel_q == can_mb_pkg::MemMsg;
  assign ram_wr    = wr_q && mem_sel_q != can_mb_pkg::MemTimer;
  assign w_gnt     = ram_wr && (wait_q || !(pend || copy_i || serviced_req_i || rx_wr_owed_q
                                            || (of_cs && cs_written_i && owed_q)));
  assign wr_waits  = ram_wr && !w_gnt;
  assign hold_o    = copy_i && wait_q;
  // These do not look at w_gnt, which is late: a write that waits for another reason only puts the
  // engine off once. No mark while its word is read for the second time.
  assign serviced_gnt_o = serviced_req_i && !copy_i && !(ram_wr && wait_q) && !(pend
      && serviced_idx_i == idx_q);
  assign rx_wr_gnt_o = rx_wr_req_i && !copy_i && !serviced_req_i && (!ram_wr || (rx_wr_owed_q
      && !wait_q));

  assign rx_wr_owed_o = rx_wr_owed_q;

  assign ready_o   = !pend && !wr_waits;
  assign rd_done_o = rd_q && !pend;
  assign wr_o      = wr_q;
  assign wr_done_o = wr_q && !wr_waits;
  assign waited_o  = wait_q;
  assign mem_sel_o    = mem_sel_q;
  assign rxfir_o   = !word_q[1];
  assign idx_o     = idx_q;
  assign be_o      = be_q;

  // Addresses of the CPU: from the command, or held if it waits.
  logic [1:0]      c_word;
  logic [IdxW-1:0] c_idx;
  assign c_word = pend ? word_q : cmd_word_i;
  assign c_idx  = pend ? idx_q : cmd_idx_i;

  // The engine's own, apart: those of the CPU come late.
  logic [IdxW:0]   cs_row, cs_raddr, mask_raddr;
  logic [IdxW+1:0] msg_row, msg_raddr;
  assign cs_row     = ins_req_i ? {1'b0, ins_idx_i} : eng_cs_row_i;
  assign msg_row    = ins_req_i ? {2'b00, ins_idx_i} : eng_msg_row_i;
  assign cs_raddr   = cpu_gnt ? {1'b0, c_idx} : cs_row;
  assign msg_raddr  = cpu_gnt ? {c_word, c_idx} : msg_row;
  assign mask_raddr = cpu_gnt ? {c_word[0], c_idx} : eng_mask_row_i;

  // Masks without a memory of their own.
  function automatic logic in_msg(input logic [1:0] mem_sel);
    in_msg = OwnMasks == 0 && mem_sel == can_mb_pkg::MemMask;
  endfunction

  function automatic logic of_stamp(input logic [1:0] mem_sel, input logic high_word);
    of_stamp = TimeUnit != 0 && mem_sel == can_mb_pkg::MemTimer && high_word;
  endfunction

  // The word that is written: memory, row, byte lanes, data. Who would write is known early;
  // whether it is written at all, late.
  logic            by_copy, by_cpu, w_cs, w_msg, w_mask;
  logic [IdxW+1:0] w_row;
  logic [3:0]      w_be;
  logic [31:0]     w_data;
  assign by_copy = copy_i && !wait_q;
  assign by_cpu  = ram_wr && (wait_q || !(serviced_req_i || rx_wr_owed_q));

  always_comb begin
    // The engine, unless it is somebody else.
    {w_cs, w_msg, w_mask} = {rx_wr_cs_i, !rx_wr_cs_i, 1'b0};
    w_row  = rx_wr_row_i;
    w_data = rx_wr_data_i;
    if (scrub_o) begin
      // The rows of masks that no buffer has are ones; the C/S rows were zeroed in the first half.
      {w_cs, w_msg, w_mask} = {!scrub_row_q[IdxW+1], 2'b11};
      w_row  = scrub_row_q;
      w_data = {32{&scrub_row_q[IdxW+1:IdxW]}};
    end else if (by_copy) begin
      {w_cs, w_msg, w_mask} = {copy_cs_i, !copy_cs_i, 1'b0};
      w_row  = copy_row_i;
      w_data = copy_data_i;
    end else if (by_cpu) begin
      {w_cs, w_msg, w_mask} = {of_cs, of_msg || in_msg(mem_sel_q),
                               mem_sel_q == can_mb_pkg::MemMask};
      w_row  = {word_q & {2{!of_cs}}, idx_q};
      w_data = wdata_i;
    end else if (serviced_req_i) begin
      {w_cs, w_msg, w_mask} = 3'b100;
      w_row  = {2'b00, serviced_idx_i};
      w_data[31:24] = {4'b1000, 1'b0, serviced_ovr_i, 2'b10};
    end
  end

  assign w_be = {4{scrub_o}} | (copy_be_i & {4{by_copy}}) | (be_q & {4{w_gnt && !block_i}})
              | {serviced_gnt_o, 3'b000} | (rx_wr_be_i & {4{rx_wr_gnt_o}});

  // Does it meet the CPU's read? Its lanes do not count: they come late. A read that has waited
  // meets a copy alone; a write that waits reads its C/S word.
  logic meets, shown;
  assign meets = (stamp_meets_i && of_stamp(cmd_mem_sel_i, cmd_word_i[1]))
              || ((copy_i || ram_wr || serviced_req_i)
              && ((w_cs && cmd_mem_sel_i == can_mb_pkg::MemCs && w_row[IdxW:0] == {1'b0, cmd_idx_i})
                  || (w_msg && (cmd_mem_sel_i == can_mb_pkg::MemMsg || in_msg(cmd_mem_sel_i))
                      && w_row == {cmd_word_i, cmd_idx_i})
                  || (OwnMasks != 0 && w_mask && cmd_mem_sel_i == can_mb_pkg::MemMask
                      && w_row[IdxW:0] == {cmd_word_i[0], cmd_idx_i})));
  assign shown = (pend && copy_i && copy_row_i[IdxW-1:0] == idx_q
              && (copy_cs_i ? (wr_q || of_cs) && !copy_row_i[IdxW]
                            : !wr_q && of_msg && copy_row_i[IdxW+1:IdxW] == word_q))
              || (pend && stamp_shown_i && of_stamp(mem_sel_q, word_q[1]));

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {pend_q, owed_q, wait_q, rx_wr_owed_q} <= '0;
      {stale_o, id_stale_o} <= '0;
    end else begin
      pend_q     <= (cmd_rd_i && (!cpu_gnt || meets)) || (cmd_wr_i && cmd_look_i);
      owed_q     <= want && (pend || ins_req_i || (cmd_slot_i && !owed_q));
      wait_q     <= wr_waits;
      rx_wr_owed_q <= rx_wr_req_i && !rx_wr_gnt_o;
      stale_o    <= w_cs && w_be[3] && w_row[IdxW:0] == cs_row;
      id_stale_o <= w_msg && w_be != '0 && w_row == msg_row;
    end
  end

  // Who reads nothing does not mind; that the outputs stay is asked for by those who say so.
  logic re;
  assign re = !hold_o && !shown;
  assign stamp_re_o      = re;
  assign stamp_cpu_o     = cpu_gnt;
  assign stamp_row_o     = {c_word[0], c_idx};
  assign stamp_held_row_o = {word_q[0], idx_q};
  assign stamp_again_o   = pend;
  assign stamp_cmd_row_o = {cmd_word_i[0], cmd_idx_i};
  assign scrub_row_o     = scrub_row_q;
  can_mb_ram #(.Depth(2 * NumMb)) u_cs (
    .clk_i, .re_i(re), .raddr_i(cs_raddr), .rdata_o(cs_o),
    .we_i(w_be & {4{w_cs}}), .waddr_i(w_row[IdxW:0]), .wdata_i(w_data));
  can_mb_ram #(.Depth(4 * NumMb)) u_msg (
    .clk_i, .re_i(re), .raddr_i(msg_raddr), .rdata_o(msg_o),
    .we_i(w_be & {4{w_msg}}), .waddr_i(w_row), .wdata_i(w_data));
  if (OwnMasks != 0) begin : gen_mask
    can_mb_ram #(.Depth(2 * NumMb)) u_mask (
      .clk_i, .re_i(re), .raddr_i(mask_raddr), .rdata_o(mask_o),
      .we_i(w_be & {4{w_mask}}), .waddr_i(w_row[IdxW:0]), .wdata_i(w_data));
  end else begin : gen_no_mask
    logic unused;
    assign unused = &{1'b0, mask_raddr, w_mask};
    assign mask_o = msg_o;
  end

  // The word that the reader has asked for.
  logic word_cs_q;
  assign word_o = word_cs_q ? cs_o : msg_o;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) word_cs_q <= 1'b0;
    else if (re) word_cs_q <= !cpu_gnt ? eng_cs_i
                            : pend ? of_cs : cmd_mem_sel_i == can_mb_pkg::MemCs;
  end

  always_comb begin
    rdata_o = '0;
    if (rd_q && !scrub_o) begin
      case (mem_sel_q)
        can_mb_pkg::MemCs, can_mb_pkg::MemMsg: rdata_o = word_o;
        can_mb_pkg::MemMask: rdata_o = mask_o;
        default: if (of_stamp(mem_sel_q, word_q[1])) rdata_o = stamp_rdata_i;
      endcase
    end
  end
endmodule
