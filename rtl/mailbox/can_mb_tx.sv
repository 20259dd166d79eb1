// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_mb_tx: transmit arbitration; keeps the winner among the active buffers (flexcan.md 3.3).
//
// A C/S write is compared at once with the winner so far. When the winner itself is changed, taken
// away or goes on the bus, one pass over all buffers finds the next. A pass that was spoiled by another
// change is followed by a new one; until a pass ends unspoiled the best of what was seen may be sent, so
// that a CPU that writes C/S words for ever cannot hold up the others.

module can_mb_tx #(
  parameter int NumMb = 64,
  /// Derived, do not override.
  localparam int IdxW = $clog2(NumMb)
) (
  input  logic            clk_i,
  input  logic            rst_ni,
  input  logic            running_i,    // 0: forget everything; a pass starts when it rises
  input  logic            lbuf_i,       // lowest index wins, not smallest arbitration value
  input  logic [6:0]      maxmb_i,
  // C/S write by the CPU in the clock before; csw_act_i: the code may be active.
  input  logic            csw_i,
  input  logic [IdxW-1:0] csw_idx_i,
  input  logic            csw_act_i,
  // Frame on the bus.
  input  logic            on_bus_i,
  input  logic [IdxW-1:0] cur_idx_i,
  input  logic            start_i,      // buffer cur_idx_i goes on the bus
  input  logic            retry_i,      // ... has left it, and may be active still
  // Read slots.
  output logic            ins_req_o,
  output logic [IdxW-1:0] ins_idx_o,
  input  logic            ins_gnt_i,
  output logic            scan_req_o,
  output logic [IdxW-1:0] scan_idx_o,
  input  logic            scan_gnt_i,
  input  logic            stale_i,
  input  logic [31:0]     cs_i,
  input  logic [31:0]     id_i,
  // Winner.
  output logic            settled_o,    // it may be sent
  output logic [IdxW-1:0] best_idx_o,
  output logic            retry_o       // a retry has not been looked at yet
);
  logic            ins_q, retry_q, scan_q, again_q, spoiled_q, eval_q, last_q, scanned_q, best_q;
  logic [IdxW-1:0] eval_idx_q;
  logic [31:0]     best_val_q;

  assign ins_req_o  = running_i && (ins_q || (csw_i && csw_act_i) || retry_q);
  assign ins_idx_o  = (ins_q || (csw_i && csw_act_i)) ? csw_idx_i : cur_idx_i;
  assign scan_req_o = running_i && scan_q && !last_q;
  assign settled_o  = best_q && (!scan_q || spoiled_q);
  assign retry_o    = retry_q || retry_i;

  // The buffer on the RAM outputs: bits in the order of the bus (AR-08).
  logic        active, skip, gone;
  logic [31:0] value;
  assign active = cs_i[27:24] == 4'b1100 && 7'(eval_idx_q) <= maxmb_i
               && !(on_bus_i && eval_idx_q == cur_idx_i);
  assign value  = cs_i[21] ? {id_i[28:18], 2'b11, id_i[17:0], cs_i[20]}
                           : {id_i[28:18], cs_i[20], 20'b0};
  assign skip   = stale_i || (csw_i && csw_idx_i == eval_idx_q);
  // The winner is no longer what it was.
  assign gone   = best_q && ((csw_i && csw_idx_i == best_idx_o)
                          || (start_i && cur_idx_i == best_idx_o));

  logic better;
  assign better = !best_q || gone || (lbuf_i ? eval_idx_q < best_idx_o
                                             : {value, eval_idx_q} < {best_val_q, best_idx_o});

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {ins_q, retry_q, again_q, spoiled_q, eval_q, last_q, scanned_q, best_q} <= '0;
      scan_q <= 1'b1;
      {scan_idx_o, eval_idx_q, best_idx_o} <= '0;
      best_val_q <= '0;
    end else if (!running_i) begin
      {ins_q, retry_q, again_q, spoiled_q, eval_q, last_q, scanned_q, best_q} <= '0;
      scan_q <= 1'b1;
      scan_idx_o <= '0;
    end else begin
      // Insertions: the C/S write first, it cannot wait for the next one.
      ins_q <= (ins_q || (csw_i && csw_act_i)) && !ins_gnt_i;
      if (retry_i) retry_q <= 1'b1;
      else if (ins_gnt_i && !ins_q && !(csw_i && csw_act_i)) retry_q <= 1'b0;

      // Pass over all buffers.
      if (scan_gnt_i) begin
        scan_idx_o <= scan_idx_o + 1'b1;
        last_q     <= scan_idx_o == IdxW'(NumMb - 1) || 7'(scan_idx_o) == maxmb_i;
      end
      eval_q    <= ins_gnt_i || scan_gnt_i;
      scanned_q <= scan_gnt_i;
      if (ins_gnt_i)       eval_idx_q <= ins_idx_o;
      else if (scan_gnt_i) eval_idx_q <= scan_idx_o;

      if (gone) best_q <= 1'b0;
      if (eval_q && !skip) begin
        if (active && better) begin
          best_q     <= 1'b1;
          best_idx_o <= eval_idx_q;
          best_val_q <= value;
        end
      end
      if (scan_q && last_q && scanned_q) begin   // the last one has been looked at
        last_q     <= 1'b0;
        scan_q     <= again_q || gone;
        again_q    <= 1'b0;
        spoiled_q  <= again_q || gone;
        scan_idx_o <= '0;
      end else if (gone) begin
        if (scan_q) {again_q, spoiled_q} <= '1;
        scan_q <= 1'b1;
      end
    end
  end
endmodule
