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
// an insertion.

module can_mb_port #(
  parameter int NumMb = 64,
  /// Derived, do not override.
  localparam int IdxW = $clog2(NumMb)
) (
  input  logic            clk_i,
  input  logic            rst_ni,
  // CPU, command: only while ready_o. kind: 0 C/S (word 3; 1: RXFIR, the same row), 1 ID or data
  // (word 0..2), 2 mask (word[0]: hidden row), 3 no RAM, but ordered like one (TIMER).
  input  logic            cmd_slot_i,   // cmd_rd_i may be set: early, for who gets the read port
  input  logic            cmd_rd_i,
  input  logic            cmd_wr_i,
  input  logic [1:0]      cmd_kind_i,
  input  logic [1:0]      cmd_word_i,
  input  logic [IdxW-1:0] cmd_idx_i,
  input  logic [3:0]      cmd_be_i,
  // CPU, data: from the next clock until ready_o.
  input  logic [31:0]     wdata_i,
  input  logic            raw_i,        // a C/S word with all 32 bits (filter table)
  input  logic            shot_i,       // bit 28 of a C/S word is kept with code 1100
  input  logic            block_i,      // not to be written
  input  logic            stall_i,      // it has to wait for a clock
  output logic            ready_o,
  output logic [31:0]     rdata_o,      // of kinds 0..2
  output logic            rd_done_o,    // a read ends in this clock
  output logic            wr_o,         // a write ends in this clock, or the next one
  output logic            wr_done_o,    // ... in this clock
  output logic            waited_o,     // ... and has waited for one
  output logic [1:0]      kind_o,
  output logic            rxfir_o,      // kind 0: RXFIR, not C/S
  output logic [IdxW-1:0] idx_o,
  output logic [3:0]      be_o,
  // Engine reads; data in the clock after the grant.
  input  logic            ins_req_i,
  input  logic [IdxW-1:0] ins_idx_i,
  output logic            ins_gnt_o,
  input  logic            eng_req_i,
  input  logic            eng_lazy_i,   // gives way to the CPU every time
  input  logic [IdxW:0]   eng_cs_row_i,
  input  logic [IdxW+1:0] eng_msg_row_i,
  input  logic [IdxW:0]   eng_mask_row_i,
  output logic            eng_gnt_o,
  output logic            stale_o,      // with the data: this C/S row was being written when read
  output logic            id_stale_o,   // the same of the MSG row
  output logic [31:0]     cs_o,
  output logic [31:0]     msg_o,
  output logic [31:0]     mask_o,
  // Second half of a copy; hold_o: not in this clock, a CPU write has waited for long enough. The
  // RAM outputs stay as they are then: nobody reads.
  input  logic            copy_i,
  output logic            hold_o,
  input  logic [3:0]      copy_cs_we_i,
  input  logic [IdxW:0]   copy_cs_row_i,
  input  logic [31:0]     copy_cs_i,
  input  logic            copy_msg_we_i,
  input  logic [IdxW+1:0] copy_msg_row_i,
  // Serviced mark: top byte of a C/S word.
  input  logic            svc_req_i,
  input  logic [IdxW-1:0] svc_idx_i,
  input  logic            svc_ovr_i,
  output logic            svc_gnt_o,
  // Engine writes.
  input  logic            ewr_req_i,
  input  logic [3:0]      ewr_cs_we_i,
  input  logic [IdxW:0]   ewr_cs_row_i,
  input  logic [23:0]     ewr_cs_i,
  input  logic [3:0]      ewr_msg_we_i,
  input  logic [IdxW+1:0] ewr_msg_row_i,
  input  logic [31:0]     ewr_msg_i,
  output logic            ewr_gnt_o,
  // After a hard reset: every row is written once, whatever else goes on.
  output logic            scrub_o,
  input  logic            csw_i         // a C/S write ended in the clock before
);
  localparam logic [1:0] KindCs    = 2'd0;
  localparam logic [1:0] KindMsg   = 2'd1;
  localparam logic [1:0] KindMask  = 2'd2;
  localparam logic [1:0] KindTimer = 2'd3;

  logic [IdxW+1:0] scrub_row_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      scrub_o     <= 1'b1;
      scrub_row_q <= '0;
    end else if (scrub_o) begin
      scrub_o     <= scrub_row_q != '1;
      scrub_row_q <= scrub_row_q + 1'b1;
    end
  end

  // CPU transfer in its data phase.
  logic            rd_q, wr_q;
  logic [1:0]      kind_q, word_q;
  logic [IdxW-1:0] idx_q;
  logic [3:0]      be_q;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {rd_q, wr_q} <= '0;
      {kind_q, word_q} <= '0;
      idx_q <= '0;
      be_q <= '0;
    end else if (ready_o) begin
      rd_q <= cmd_rd_i;
      wr_q <= cmd_wr_i;
      if (cmd_rd_i || cmd_wr_i) begin
        kind_q <= cmd_kind_i;
        word_q <= cmd_word_i;
        idx_q  <= cmd_idx_i;
        be_q   <= cmd_be_i;
      end
    end
  end

  // Read port. An engine write that was refused claims a slot too: reads of C/S words in a row,
  // each with its serviced mark, would keep it out otherwise.
  logic pend_q, owed_q, want, cpu_gnt, ewr_owed_q;
  assign want      = (eng_req_i && !eng_lazy_i) || ewr_owed_q;
  assign cpu_gnt   = pend_q || (cmd_slot_i && !ins_req_i && !(want && owed_q) && !hold_o);
  assign ins_gnt_o = ins_req_i && !pend_q;
  assign eng_gnt_o = eng_req_i && !pend_q && !ins_req_i && (!cmd_slot_i || (want && owed_q));

  // Write port.
  logic wait_q, w_gnt, ram_wr, wr_waits;
  assign ram_wr    = wr_q && kind_q != KindTimer;
  assign w_gnt     = ram_wr && (wait_q || !(copy_i || svc_req_i || ewr_owed_q
                                            || stall_i
                                            || (kind_q == KindCs && csw_i && owed_q)));
  assign wr_waits  = ram_wr && !w_gnt;
  assign hold_o    = copy_i && wait_q;
  // These do not look at w_gnt, which is late: a write that waits for another reason only puts the
  // engine off once.
  assign svc_gnt_o = svc_req_i && !copy_i && !(ram_wr && wait_q);
  assign ewr_gnt_o = ewr_req_i && !copy_i && !svc_req_i && (!ram_wr || (ewr_owed_q && !wait_q));

  assign ready_o   = !pend_q && !wr_waits;
  assign rd_done_o = rd_q && !pend_q;
  assign wr_o      = wr_q;
  assign wr_done_o = wr_q && !wr_waits;
  assign waited_o  = wait_q;
  assign kind_o    = kind_q;
  assign rxfir_o   = !word_q[1];
  assign idx_o     = idx_q;
  assign be_o      = be_q;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {pend_q, owed_q, wait_q, ewr_owed_q} <= '0;
    end else begin
      pend_q     <= cmd_rd_i && !cpu_gnt;
      owed_q     <= want && (pend_q || ins_req_i || (cmd_slot_i && !owed_q));
      wait_q     <= wr_waits;
      ewr_owed_q <= ewr_req_i && !ewr_gnt_o;
    end
  end

  // Addresses of the CPU: from the command, or held if it waits.
  logic [1:0]      c_kind, c_word;
  logic [IdxW-1:0] c_idx;
  assign c_kind = pend_q ? kind_q : cmd_kind_i;
  assign c_word = pend_q ? word_q : cmd_word_i;
  assign c_idx  = pend_q ? idx_q : cmd_idx_i;

  logic [IdxW:0]   cs_raddr, mask_raddr;
  logic [IdxW+1:0] msg_raddr;
  assign cs_raddr   = cpu_gnt ? {1'b0, c_idx} : ins_gnt_o ? {1'b0, ins_idx_i} : eng_cs_row_i;
  assign msg_raddr  = cpu_gnt ? {c_word, c_idx} : ins_gnt_o ? {2'b00, ins_idx_i} : eng_msg_row_i;
  assign mask_raddr = cpu_gnt ? {c_word[0], c_idx} : eng_mask_row_i;

  // Write data and addresses.
  logic [3:0]      cs_we, msg_we, mask_we;
  logic [IdxW:0]   cs_waddr, mask_waddr;
  logic [IdxW+1:0] msg_waddr;
  logic [31:0]     cs_wdata, msg_wdata, mask_wdata;

  always_comb begin
    cs_we     = '0;
    msg_we    = '0;
    mask_we   = '0;
    cs_waddr  = {1'b0, idx_q};
    msg_waddr = {word_q, idx_q};
    mask_waddr = {word_q[0], idx_q};
    cs_wdata  = wdata_i;
    if (!raw_i) begin                                          // these read as zero
      {cs_wdata[31:28], cs_wdata[23]} = '0;
      cs_wdata[28] = shot_i && wdata_i[28] && wdata_i[27:24] == 4'b1100;  // not for an answer
    end
    msg_wdata = wdata_i;
    mask_wdata = wdata_i;
    if (scrub_o) begin
      {cs_we, msg_we, mask_we} = '1;
      cs_waddr   = scrub_row_q[IdxW:0];
      msg_waddr  = scrub_row_q;
      mask_waddr = scrub_row_q[IdxW:0];
      cs_wdata   = '0;
      msg_wdata  = '0;
      mask_wdata = {32{scrub_row_q[IdxW]}};   // RXGMASK, RX14MASK, RX15MASK: ones
    end else if (copy_i && !hold_o) begin
      cs_we     = copy_cs_we_i;
      cs_waddr  = copy_cs_row_i;
      cs_wdata  = copy_cs_i;
      msg_we    = {4{copy_msg_we_i}};
      msg_waddr = copy_msg_row_i;
      msg_wdata = msg_o;
    end else if (w_gnt) begin
      if (kind_q == KindCs)   cs_we = be_q & {4{!block_i}};
      if (kind_q == KindMsg)  msg_we = be_q & {4{!block_i}};
      if (kind_q == KindMask) mask_we = be_q;
    end else if (svc_req_i) begin
      cs_we    = 4'b1000;
      cs_waddr = {1'b0, svc_idx_i};
      cs_wdata = {4'b1000, 1'b0, svc_ovr_i, 2'b10, 24'b0};
    end else if (ewr_gnt_o) begin
      cs_we     = ewr_cs_we_i;
      cs_waddr  = ewr_cs_row_i;
      cs_wdata  = {8'b0, ewr_cs_i};
      msg_we    = ewr_msg_we_i;
      msg_waddr = ewr_msg_row_i;
      msg_wdata = ewr_msg_i;
    end
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {stale_o, id_stale_o} <= '0;
    end else begin
      stale_o    <= cs_we[3] && cs_waddr == cs_raddr;
      id_stale_o <= msg_we != '0 && msg_waddr == msg_raddr;
    end
  end

  logic re;
  assign re = cpu_gnt || ins_gnt_o || eng_gnt_o;
  can_mb_ram #(.Depth(2 * NumMb)) u_cs (
    .clk_i, .re_i(re), .raddr_i(cs_raddr), .rdata_o(cs_o),
    .we_i(cs_we), .waddr_i(cs_waddr), .wdata_i(cs_wdata));
  can_mb_ram #(.Depth(4 * NumMb)) u_msg (
    .clk_i, .re_i(re), .raddr_i(msg_raddr), .rdata_o(msg_o),
    .we_i(msg_we), .waddr_i(msg_waddr), .wdata_i(msg_wdata));
  can_mb_ram #(.Depth(2 * NumMb)) u_mask (
    .clk_i, .re_i(re), .raddr_i(mask_raddr), .rdata_o(mask_o),
    .we_i(mask_we), .waddr_i(mask_waddr), .wdata_i(mask_wdata));

  // A CPU read in the very clock of a write to the same word, whoever writes, takes the written
  // bytes from here.
  logic [3:0]  fwd_we, fwd_q;
  logic [31:0] fwd_data_q;
  always_comb begin
    fwd_we = '0;
    case (c_kind)
      KindCs:   if (cs_waddr == {1'b0, c_idx})        fwd_we = cs_we;
      KindMsg:  if (msg_waddr == {c_word, c_idx})     fwd_we = msg_we;
      KindMask: if (mask_waddr == {c_word[0], c_idx}) fwd_we = mask_we;
      default:  ;
    endcase
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      fwd_q      <= '0;
      fwd_data_q <= '0;
    end else if (cpu_gnt) begin
      fwd_q      <= fwd_we;
      // Masks are written by the CPU alone, and its data is in msg_wdata as well.
      fwd_data_q <= c_kind == KindCs ? cs_wdata : msg_wdata;
    end
  end

  always_comb begin
    rdata_o = '0;
    if (rd_q && !scrub_o) begin
      case (kind_q)
        KindCs:   rdata_o = cs_o;
        KindMsg:  rdata_o = msg_o;
        KindMask: rdata_o = mask_o;
        default:  ;
      endcase
      for (int b = 0; b < 4; b++) if (fwd_q[b]) rdata_o[8*b +: 8] = fwd_data_q[8*b +: 8];
    end
  end
endmodule
