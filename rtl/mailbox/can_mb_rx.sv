// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_mb_rx: finds the buffer for the frame being received, one buffer a clock (flexcan.md 3.5), or
// the one that answers it: a remote frame that is not stored looks for code 1010 (3.7).

module can_mb_rx #(
  parameter int NumMb = 64,
  /// Derived, do not override.
  localparam int IdxW = $clog2(NumMb)
) (
  input  logic            clk_i,
  input  logic            rst_ni,
  input  logic            clear_i,      // soft reset
  // Configuration, constant while the engine runs.
  input  logic            bcc_i,        // individual masks and reception queue
  input  logic            eacen_i,      // IDE and RTR compared under the mask
  input  logic            rrs_i,        // remote frames are stored
  input  logic [6:0]      maxmb_i,
  input  logic [6:0]      first_i,      // first buffer that is a mailbox
  input  logic            wait_i,       // not now
  // Frame.
  input  logic            rx_hdr_i,
  input  logic [28:0]     rx_id_i,
  input  logic            rx_ide_i,
  input  logic            rx_rtr_i,
  // Locks, and C/S writes by the CPU in the clock before.
  input  logic            lock_i,
  input  logic [IdxW-1:0] lock_idx_i,
  input  logic            waits_i,      // buffer waits_idx_i gets the frame before this one
  input  logic [IdxW-1:0] waits_idx_i,
  input  logic            cs_written_i,
  input  logic [IdxW-1:0] cs_written_idx_i,
  input  logic            cs_written_empty_i,  // code EMPTY was written, with IDE cs_written_ide_i
  input  logic            cs_written_ide_i,
  // Read slots: C/S, ID and mask of buffer idx_o.
  output logic            req_o,
  output logic [IdxW-1:0] idx_o,
  input  logic            gnt_i,
  input  logic            stale_i,      // a word of it was being written
  input  logic [31:0]     cs_i,
  input  logic [31:0]     id_i,
  input  logic [31:0]     mask_i,
  // Frame, kept.
  output logic [28:0]     id_o,
  output logic            ide_o,
  output logic            rtr_o,
  output logic            ans_o,        // an answer is looked for
  // Result.
  output logic            done_o,
  output logic            hit_o,
  output logic            hit_free_o,   // ... and was free to receive
  output logic [IdxW-1:0] hit_idx_o
);
  logic            scan_q, last;
  // Stage 1: the buffer is on the RAM outputs. Stage 2: it has been compared.
  logic            s1_q, s2_q, s2_skip_q, s2_match_q, s2_free_q, skip;
  logic [IdxW-1:0] s1_idx_q, s2_idx_q;

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
  // Read it again: it was being written then, or it fitted and has been written since. One that did
  // not fit was looked at before that write.
  assign skip    = s2_skip_q || (s2_match_q && cs_written_i && cs_written_idx_i == s2_idx_q);
  assign last    = idx_o == IdxW'(NumMb - 1) || 7'(idx_o) == maxmb_i;

  // The CPU took the chosen buffer away: look again. Writing EMPTY leaves one that stores a
  // candidate.
  logic withdrawn;
  assign withdrawn = hit_o && cs_written_i && cs_written_idx_i == hit_idx_o
             && !(cs_written_empty_i && cs_written_ide_i == ide_o && !ans_o);

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
      {scan_q, s1_q, s2_q, hit_o, hit_free_o} <= '0;
      {idx_o, s1_idx_q, hit_idx_o} <= '0;
    end else if (rx_hdr_i) begin
      id_o   <= rx_id_i;
      ide_o  <= rx_ide_i;
      rtr_o  <= rx_rtr_i;
      ans_o  <= rx_rtr_i && !rrs_i;
      scan_q <= first_i < 7'(NumMb);
      idx_o  <= first_i[IdxW-1:0];
      {s1_q, s2_q, hit_o} <= '0;
    end else if (withdrawn || clear_i) begin
      scan_q <= !clear_i;
      idx_o  <= first_i[IdxW-1:0];
      {s1_q, s2_q, hit_o} <= '0;
    end else begin
      s1_q <= gnt_i;
      s2_q <= s1_q;
      s1_idx_q <= idx_o;
      if (gnt_i) begin
        idx_o <= idx_o + 1'b1;
        if (last) scan_q <= 1'b0;
      end
      if (s2_q && skip) begin
        idx_o  <= s2_idx_q;
        scan_q <= 1'b1;
        {s1_q, s2_q} <= '0;
      end else if (s2_q && s2_match_q) begin
        hit_o      <= 1'b1;
        hit_free_o <= s2_free_q;
        hit_idx_o  <= s2_idx_q;
        // BCC=1: the lowest free one, or else the last; BCC=0: the first.
        if (s2_free_q || !bcc_i) {scan_q, s1_q, s2_q} <= '0;
      end
    end
  end
endmodule
