// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_mb_smb: writes the frame on the bus into hidden row smb_i while it passes, own frames too:
// the 16-bit stamp (TIMER) at the beginning of the identifier field, the identifier after the
// header, each data byte as it comes, and SRR, IDE, RTR and DLC when the frame is valid (VA-01).
// can_mb_move takes it from there. The stamp of an own frame also goes to its hidden row, for the
// end in can_mb_load.

module can_mb_smb #(
  parameter int NumMb = 64,
  /// Derived, do not override.
  localparam int IdxW = $clog2(NumMb)
) (
  input  logic            clk_i,
  input  logic            rst_ni,
  input  logic            smb_i,         // hidden row of the frame being received
  input  logic            tx_row_i,      // hidden row of the frame being sent
  input  logic [15:0]     timer_i,       // TIMER
  // Engine, see can_core.
  input  logic            start_i,       // pulse: a frame begins
  input  logic            stamp_i,       // pulse: the next bit is the first of the identifier field
  input  logic            transmitter_i, // 1: this node is the transmitter of the frame
  input  logic            rx_hdr_i,      // pulse: the header is complete, the identifier is valid
  input  logic [28:0]     rx_id_i,
  input  logic            rx_ide_i,
  input  logic            rx_srr_i,
  input  logic            rx_rtr_i,
  input  logic [3:0]      rx_dlc_i,
  input  logic            rx_byte_we_i,  // pulse: rx_byte_i is the next data byte
  input  logic [7:0]      rx_byte_i,
  input  logic            rx_valid_i,    // pulse: the frame is valid (VA-01)
  // Write port of the RAMs (can_mb_port).
  output logic            req_o,
  output logic            cs_o,          // 1: the write goes to the C/S memory; 0: to MSG
  output logic [3:0]      be_o,
  output logic [IdxW+1:0] row_o,
  output logic [31:0]     data_o,
  input  logic            gnt_i,
  output logic            flags_busy_o   // 1: SRR, IDE, RTR and DLC are not written yet
);
  logic       stamp_q, tx_stamp_q, flags_q, id_q, zero0_q, zero1_q, byte_q;
  logic [2:0] count_q;                   // data bytes written

  assign req_o = stamp_q || tx_stamp_q || flags_q || id_q || zero0_q || zero1_q || byte_q;
  assign flags_busy_o = flags_q;

  logic [3:0] hidden;
  assign hidden = can_mb_pkg::hidden_msg(1'b1, smb_i, 2'd0);
  assign cs_o = stamp_q || tx_stamp_q || flags_q;
  always_comb begin
    be_o   = '1;
    row_o  = (IdxW+2)'(3 * NumMb) | (IdxW+2)'(hidden);
    data_o = {3'b0, rx_id_i};
    if (cs_o) begin
      be_o   = stamp_q || tx_stamp_q ? 4'b0011 : 4'b1100;
      row_o  = stamp_q || !tx_stamp_q
               ? (IdxW+2)'(NumMb + can_mb_pkg::RowReceived) | (IdxW+2)'(smb_i)
               : (IdxW+2)'(NumMb + can_mb_pkg::RowSent) | (IdxW+2)'(tx_row_i);
      // A base frame has no SRR; its bit is stored as 1 (flexcan.md 3.1). The top byte is 0, not
      // what the RAM held: the CPU may read it in the clock of the move (can_mb_port).
      data_o = {9'b0, rx_srr_i || !rx_ide_i, rx_ide_i, rx_rtr_i, rx_dlc_i, timer_i};
    end else if (!id_q && (zero0_q || zero1_q)) begin   // bytes beyond the DLC read as zero
      data_o = '0;
      row_o[1:0] = zero0_q ? 2'd1 : 2'd2;
    end else if (!id_q) begin
      be_o   = 4'b1000 >> count_q[1:0];
      data_o = {4{rx_byte_i}};
      row_o[1:0] = count_q[2] ? 2'd2 : 2'd1;
    end
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {stamp_q, tx_stamp_q, flags_q, id_q, zero0_q, zero1_q, byte_q} <= '0;
      count_q <= '0;
    end else begin
      if (gnt_i) begin
        if (stamp_q)         stamp_q    <= 1'b0;
        else if (tx_stamp_q) tx_stamp_q <= 1'b0;
        else if (flags_q)    flags_q    <= 1'b0;
        else if (id_q)       id_q       <= 1'b0;
        else if (zero0_q)    zero0_q    <= 1'b0;
        else if (zero1_q)    zero1_q    <= 1'b0;
        else begin
          byte_q  <= 1'b0;
          count_q <= count_q + 1'b1;
        end
      end
      if (start_i) begin
        {flags_q, id_q, zero0_q, zero1_q, byte_q} <= '0;
        count_q <= '0;
      end
      if (stamp_i)      {stamp_q, tx_stamp_q} <= {1'b1, transmitter_i};
      if (rx_hdr_i)     {id_q, zero0_q, zero1_q} <= '1;
      if (rx_byte_we_i) byte_q <= 1'b1;
      if (rx_valid_i)   flags_q <= 1'b1;
    end
  end
endmodule
