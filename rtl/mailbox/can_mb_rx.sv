// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_mb_rx: searches the mailboxes, one a clock, for the one that takes the frame being received
// (flexcan.md 3.5), or for a remote frame that is not stored (RRS = 0) for the one that answers it,
// code 1010 (flexcan.md 3.7). Part of can_mb_match.

module can_mb_rx #(
  parameter int NumMb = 64,
  /// Derived, do not override.
  localparam int IdxW = $clog2(NumMb)
) (
  input  logic            clk_i,
  input  logic            rst_ni,
  input  logic            clear_i,      // pulse: soft reset or change of FEN
  // Configuration, constant while the engine runs.
  input  logic            bcc_i,        // MCR.BCC: individual masks and reception queue
  input  logic            eacen_i,      // CTRL2.EACEN: IDE and RTR are compared under the mask
  input  logic            rrs_i,        // CTRL2.RRS: remote frames are stored
  input  logic [6:0]      maxmb_i,      // MCR.MAXMB
  input  logic [6:0]      first_i,      // first buffer that is a mailbox
  input  logic            wait_i,       // 1: no read slots now
  // Frame being received, see can_core.
  input  logic            rx_hdr_i,     // pulse: header complete, rx_id_i to rx_rtr_i are valid
  input  logic [28:0]     rx_id_i,
  input  logic            rx_ide_i,
  input  logic            rx_rtr_i,
  // Buffers that are not free, and C/S writes by the CPU (can_mb_cpu).
  input  logic            lock_i,       // 1: buffer lock_idx_i is locked
  input  logic [IdxW-1:0] lock_idx_i,
  input  logic            waits_i,      // 1: a frame received earlier waits for buffer waits_idx_i
  input  logic [IdxW-1:0] waits_idx_i,
  input  logic            cs_written_i, // pulse: the CPU wrote a C/S word in the clock before
  input  logic [IdxW-1:0] cs_written_idx_i,
  // Read slots (can_mb_step): C/S, ID and mask of buffer idx_o.
  output logic            req_o,        // 1: a read slot is wanted
  output logic [IdxW-1:0] idx_o,        // buffer that is to be read
  input  logic            gnt_i,        // 1: slot granted; data in the next clock
  input  logic            stale_i,      // 1: C/S or ID was written while it was read
  input  logic [31:0]     cs_i,
  input  logic [31:0]     id_i,
  input  logic [31:0]     mask_i,
  // Header of the frame, kept from the clock after rx_hdr_i on.
  output logic [28:0]     id_o,
  output logic            ide_o,
  output logic            rtr_o,
  output logic            ans_o,        // 1: not stored: a buffer that answers is searched
  // Result.
  output logic            done_o,       // 1: the search is over
  output logic            hit_o,        // 1: buffer hit_idx_o takes (ans_o: answers) the frame
  output logic            hit_free_o,   // 1: buffer hit_idx_o is free to receive
  output logic [IdxW-1:0] hit_idx_o
);
  logic            scan_q, last;
  // Stage 1: the buffer is on the RAM outputs. Stage 2: it has been compared.
  logic            s1_q, s2_q, s2_skip_q, s2_match_q, s2_free_q, skip, look_again;
  logic [IdxW-1:0] s1_idx_q, s2_idx_q;
  logic [2:0]      again_q;     // looks at the buffer of stage 2 that were in vain, a bit each

  logic code_ok, ide_ok, rtr_ok, id_ok, free;
  logic [3:0] code;
  assign code    = cs_i[can_regs_pkg::MbCsCode +: can_regs_pkg::MbCsCodeW];
  assign code_ok = ans_o ? code == can_regs_pkg::MbCsCodeTxAnswer
                         : code == can_regs_pkg::MbCsCodeRxEmpty
                           || code == can_regs_pkg::MbCsCodeRxFull
                           || code == can_regs_pkg::MbCsCodeRxOverrun;
  assign ide_ok  = cs_i[can_regs_pkg::MbCsIde] == ide_o || (eacen_i && !mask_i[30]);
  assign rtr_ok  = !eacen_i || ans_o || cs_i[can_regs_pkg::MbCsRtr] == rtr_o || !mask_i[31];
  assign id_ok   = ((id_i[28:18] ^ id_o[28:18]) & mask_i[28:18]) == '0
                && (!ide_o || ((id_i[17:0] ^ id_o[17:0]) & mask_i[17:0]) == '0);
  assign free    = (code == can_regs_pkg::MbCsCodeRxEmpty || cs_i[can_mb_pkg::CsServiced] || ans_o)
                && !(lock_i && lock_idx_i == s1_idx_q)
                && !(waits_i && waits_idx_i == s1_idx_q);
  // Read the buffer again if it was written while it was read, or if it fitted and has been written
  // since. One that did not fit needs no second look: it counts as searched before the write. After
  // three more looks, as many as the activation of a buffer has writes and a move has, it counts as
  // one that does not fit: a CPU that writes it without end would hold up the search.
  assign skip    = s2_skip_q || (s2_match_q && cs_written_i && cs_written_idx_i == s2_idx_q);
  assign look_again = skip && !again_q[2];
  assign last    = idx_o == IdxW'(NumMb - 1) || 7'(idx_o) == maxmb_i;

  // The CPU has rewritten the buffer that was found: search again. Its identifier may be another
  // one, too.
  logic withdrawn;
  assign withdrawn = hit_o && cs_written_i && cs_written_idx_i == hit_idx_o;

  assign req_o  = scan_q && !wait_i;
  assign done_o = !scan_q && !s1_q && !s2_q && !withdrawn;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {s2_skip_q, s2_match_q, s2_free_q} <= '0;
      s2_idx_q <= '0;
    end else if (s1_q) begin
      s2_skip_q  <= stale_i || (cs_written_i && cs_written_idx_i == s1_idx_q);
      s2_match_q <= code_ok && ide_ok && rtr_ok && id_ok && 7'(s1_idx_q) <= maxmb_i;
      s2_free_q  <= free;
      s2_idx_q   <= s1_idx_q;
    end
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      id_o <= '0;
      {ide_o, rtr_o, ans_o} <= '0;
      {scan_q, s1_q, s2_q, hit_o, hit_free_o, again_q} <= '0;
      {idx_o, s1_idx_q, hit_idx_o} <= '0;
    end else if (rx_hdr_i) begin
      id_o   <= rx_id_i;
      ide_o  <= rx_ide_i;
      rtr_o  <= rx_rtr_i;
      ans_o  <= rx_rtr_i && !rrs_i;
      scan_q <= first_i < 7'(NumMb);
      idx_o  <= first_i[IdxW-1:0];
      {s1_q, s2_q, hit_o, again_q} <= '0;
    end else if (withdrawn || clear_i) begin
      scan_q <= !clear_i;
      idx_o  <= first_i[IdxW-1:0];
      {s1_q, s2_q, hit_o, again_q} <= '0;
    end else begin
      s1_q <= gnt_i;
      s2_q <= s1_q;
      s1_idx_q <= idx_o;
      if (gnt_i) begin
        idx_o <= idx_o + 1'b1;
        if (last) scan_q <= 1'b0;
      end
      if (s2_q) again_q <= look_again ? {again_q[1:0], 1'b1} : '0;
      if (s2_q && look_again) begin
        idx_o  <= s2_idx_q;
        scan_q <= 1'b1;
        {s1_q, s2_q} <= '0;
      end else if (s2_q && s2_match_q && !skip) begin
        hit_o      <= 1'b1;
        hit_free_o <= s2_free_q;
        hit_idx_o  <= s2_idx_q;
        // BCC = 1: the lowest free buffer or, if none is free, the last; BCC = 0: the first.
        if (s2_free_q || !bcc_i) {scan_q, s1_q, s2_q} <= '0;
      end
    end
  end
endmodule
