// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_mb_lock: the lock and the serviced mark of flexcan.md 3.6. A read of a C/S word with code
// FULL or OVERRUN (with BCC = 0 also EMPTY) locks that buffer against moves (can_mb_move). It is
// unlocked by a read of TIMER, a read of another C/S word, or a write of its own. An unlock by a
// read marks a frame in the buffer as serviced, so that it is free to receive again (flexcan.md
// 3.5).

module can_mb_lock #(
  parameter int NumMb = 64,
  /// Derived, do not override.
  localparam int IdxW = $clog2(NumMb)
) (
  input  logic            clk_i,
  input  logic            rst_ni,
  input  logic            clear_i,      // pulse: soft reset, or change of FEN or of the table
  input  logic            bcc_i,        // MCR.BCC
  input  logic            cs_rd_i,      // pulse: the CPU reads the C/S word of buffer idx_i
  input  logic            timer_rd_i,   // pulse: the CPU reads TIMER
  input  logic [IdxW-1:0] idx_i,        // buffer of the CPU access
  input  logic            be3_i,        // 1: the access has the byte with the code
  input  logic [3:0]      code_i,       // code of the C/S word that is read
  input  logic            serviced_i,   // 1: the C/S word that is read has the serviced mark
  input  logic            busy_i,       // 1: buffer idx_i shows BUSY: this read does not lock it
  input  logic            cs_written_i,      // pulse: a C/S word was written in the clock before
  input  logic [IdxW-1:0] cs_written_idx_i,
  output logic            lock_o,       // 1: buffer lock_idx_o is locked
  output logic [IdxW-1:0] lock_idx_o,
  output logic            serviced_req_o,    // 1: buffer serviced_idx_o is to be marked as serviced
  output logic [IdxW-1:0] serviced_idx_o,
  output logic            serviced_ovr_o,    // 1: code of serviced_idx_o is OVERRUN; 0: FULL
  input  logic            serviced_gnt_i     // 1: the mark is written in this clock
);
  logic       stored, same, lock_now, cs_written_hit, leave, ovr_q, mark_q, req_q, overwritten,
    at_serviced_q;

  assign stored     = code_i == can_regs_pkg::MbCsCodeRxFull
                   || code_i == can_regs_pkg::MbCsCodeRxOverrun;
  assign lock_now = cs_rd_i && !busy_i && (stored
      || (code_i == can_regs_pkg::MbCsCodeRxEmpty && !bcc_i));
  assign same       = lock_idx_o == idx_i;
  assign leave      = timer_rd_i || (cs_rd_i && !same);
  // A C/S write that replaces the code cancels a mark that has not been written yet.
  assign overwritten    = cs_written_i && at_serviced_q;
  assign serviced_req_o = req_q && !overwritten;
  assign cs_written_hit    = cs_written_i && cs_written_idx_i == lock_idx_o;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      lock_o <= 1'b0;
      {ovr_q, mark_q, at_serviced_q} <= '0;
      lock_idx_o <= '0;
      req_q <= 1'b0;
      serviced_idx_o <= '0;
      serviced_ovr_o <= 1'b0;
    end else begin
      // Compared a clock before cs_written_i: in the last clock of a write serviced_idx_o does not
      // change, because only a read changes it.
      at_serviced_q <= be3_i && idx_i == serviced_idx_o;
      if (serviced_gnt_i || overwritten) req_q <= 1'b0;
      if (lock_o && (leave || cs_written_hit)) begin
        lock_o <= 1'b0;
        if (mark_q && !cs_written_hit) begin
          req_q <= 1'b1;
          serviced_idx_o <= lock_idx_o;
          serviced_ovr_o <= ovr_q;
        end
      end
      if (lock_now) begin
        lock_o     <= 1'b1;
        lock_idx_o <= idx_i;
        ovr_q      <= code_i[2];
        mark_q     <= stored && !serviced_i;
      end
      if (clear_i) {lock_o, req_q} <= '0;
    end
  end
endmodule
