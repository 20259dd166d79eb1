// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_mb_filter: compares the frame being received with the filter table of the Rx FIFO (flexcan.md
// section 4), one word a clock: one element (format A), two halves (B) or four bytes (C). The
// lowest element that fits is the result.
//
// The table begins at buffer 6; word 0 of a buffer is in the C/S memory, words 1 to 3 are in the
// MSG memory. It ends at the last buffer if RFFN asks for more than there is.

module can_mb_filter #(
  parameter int NumMb = 64,
  /// Derived, do not override.
  localparam int IdxW = $clog2(NumMb)
) (
  input  logic            clk_i,
  input  logic            rst_ni,
  input  logic            clear_i,      // pulse: soft reset or change of FEN; ends the pass, no hit
  // Configuration, constant while the engine runs.
  input  logic            bcc_i,        // MCR.BCC: the first words have masks of their own
  input  logic [1:0]      idam_i,       // MCR.IDAM: format of the words
  input  logic [3:0]      rffn_i,       // CTRL2.RFFN: the table has 8 * (rffn_i + 1) words
  input  logic [6:0]      first_i,      // first buffer after the table; number of words with RXIMR
  // Frame; its header is valid from the clock after start_i on. A base identifier is in 28:18.
  input  logic            start_i,      // pulse: the header is complete, a pass begins
  input  logic [28:0]     id_i,
  input  logic            ide_i,
  input  logic            rtr_i,
  // CPU access, see can_mb_port.
  input  logic            wr_i,         // 1 in the first clock of a write to row wr_idx_i
  input  logic [IdxW-1:0] wr_idx_i,
  // Read slots (can_mb_step).
  output logic            req_o,        // 1: a read slot is wanted
  output logic [IdxW-1:0] idx_o,        // buffer in whose row the word lies
  output logic [1:0]      word_o,       // word in that buffer: 0 C/S memory, 1 to 3 MSG
  output logic [IdxW:0]   mask_row_o,   // row of the mask memory
  input  logic            gnt_i,        // 1: slot granted; data in the next clock
  input  logic [31:0]     data_i,
  input  logic [31:0]     mask_i,
  // Result.
  output logic            busy_o,       // 1: the pass is under way
  output logic            hit_o,        // 1: element idhit_o fits
  output logic [8:0]      idhit_o
);
  // k_q: number of the word; own_q: its mask is RXIMR of the same number, otherwise RXFGMASK.
  logic [6:0] k_q, k_next, s1_k_q, s2_k_q;
  logic       own_q, scan_q, wait_q, last;
  // Stage 1: the word is on the RAM outputs. Stage 2: its bytes have been compared.
  logic       s1_q, s2_q;
  logic [3:0] s2_equal_q;

  assign word_o     = k_q[1:0];
  assign mask_row_o = own_q ? (IdxW+1)'(k_q[4:0])
                            : (IdxW+1)'(NumMb) | (IdxW+1)'(can_mb_pkg::RowRxfgmask);
  assign k_next     = k_q + 1'b1;
  assign last       = k_q[2:0] == '1 && (k_q[6:3] == rffn_i || idx_o == IdxW'(NumMb - 1));
  assign req_o      = scan_q && !wait_q;
  assign busy_o     = scan_q || s1_q || s2_q;

  // A row that the CPU writes is not read in that clock. In the one before, the CPU reads: no slot
  // is granted, and idx_o changes with start_i only.
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) wait_q <= 1'b0;
    else         wait_q <= wr_i && (start_i || wr_idx_i == idx_o);
  end

  // key: what the word is compared with; care: the bits that count. Of a base identifier only 11
  // bits count; format C has the upper eight of either kind, without REM and EXT.
  logic [31:0] whole, key, care, differ;
  assign whole = {rtr_i, ide_i, id_i, 1'b0};
  always_comb begin
    case (idam_i)
      can_regs_pkg::McrIdamFormatB: begin
        key  = {2{whole[31:16]}};
        care = {2{13'h1FFF, {3{ide_i}}}};
      end
      can_regs_pkg::McrIdamFormatC: begin
        key  = {4{id_i[28:21]}};
        care = '1;
      end
      default: begin
        key  = whole;
        care = {13'h1FFF, {18{ide_i}}, 1'b0};
      end
    endcase
    differ = (data_i ^ key) & mask_i & care;
  end

  logic       fits;
  logic [1:0] sub;
  always_comb begin
    sub = 2'd0;
    case (idam_i)
      can_regs_pkg::McrIdamFormatA: fits = &s2_equal_q;
      can_regs_pkg::McrIdamFormatB: begin
        fits   = (&s2_equal_q[3:2]) || (&s2_equal_q[1:0]);
        sub[0] = !(&s2_equal_q[3:2]);
      end
      can_regs_pkg::McrIdamFormatC: begin
        fits = |s2_equal_q;
        sub  = s2_equal_q[3] ? 2'd0 : s2_equal_q[2] ? 2'd1 : s2_equal_q[1] ? 2'd2 : 2'd3;
      end
      default: fits = 1'b0;
    endcase
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      s2_equal_q <= '0;
      {s1_k_q, s2_k_q} <= '0;
      hit_o   <= 1'b0;
      idhit_o <= '0;
    end else begin
      s1_k_q  <= k_q;
      s2_k_q  <= s1_k_q;
      for (int b = 0; b < 4; b++) s2_equal_q[b] <= differ[8*b +: 8] == '0;
      if (start_i || clear_i) begin
        hit_o <= 1'b0;
      end else if (s2_q && fits) begin
        hit_o <= 1'b1;
        case (idam_i)
          can_regs_pkg::McrIdamFormatA: idhit_o <= {2'b0, s2_k_q};
          can_regs_pkg::McrIdamFormatB: idhit_o <= {1'b0, s2_k_q, sub[0]};
          default: idhit_o <= {s2_k_q, sub};
        endcase
      end
    end
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {scan_q, s1_q, s2_q, own_q} <= '0;
      k_q   <= '0;
      idx_o <= '0;
    end else if (start_i || clear_i) begin
      {scan_q, s1_q, s2_q} <= {start_i && !clear_i, 2'b00};
      own_q <= bcc_i;
      k_q   <= '0;
      idx_o <= IdxW'(6);
    end else if (s2_q && fits) begin
      {scan_q, s1_q, s2_q} <= '0;
    end else begin
      {s1_q, s2_q} <= {gnt_i, s1_q};
      if (gnt_i) begin
        k_q   <= k_next;
        own_q <= own_q && k_next < first_i && !k_next[5] && k_next != 7'(NumMb);
        if (word_o == 2'd3) idx_o <= idx_o + 1'b1;
        if (last) scan_q <= 1'b0;
      end
    end
  end
endmodule
