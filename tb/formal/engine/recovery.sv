  // SPDX-FileCopyrightText: 2026 The VeriCAN authors
  // SPDX-License-Identifier: Apache-2.0
  //
  // can_bsp leaves every state, spliced into it. No reset: every flip-flop starts with any value,
  // as
  // a flood of upsets would leave it. The bus is quiet: the node hears itself. Nothing is to be
  // sent.
  //
  // A rank, defined for every state, falls within two bits unless the node is idle. Two bits of
  // any past are left to settle first; as the first state is arbitrary, so is each later one, and
  // the rank falls until it is 0: the node is idle after 2 + 2 * 18000 bits at the most.

  logic [3:0] f_bits;   // bits since the start
  logic [1:0] f_phase;  // 0 first clock, 1 sample, 2 last clock of a bit
  initial begin
    f_bits  = '0;
    f_phase = '0;
  end
  always_ff @(posedge clk_i) begin
    f_phase <= (f_phase == 2'd2) ? 2'd0 : f_phase + 2'd1;
    if (f_phase == 2'd2 && !(&f_bits)) f_bits <= f_bits + 4'd1;
  end

  always @(posedge clk_i) begin
    m_no_reset: assume (rst_ni && run_i && stay_i);
    m_strobes: assume (judge_i == (f_phase == 2'd0) && sample_i == (f_phase == 2'd1)
                       && boundary_i == (f_phase == 2'd2));
    m_quiet: assume (bit_i == tx_o && !edge_i && !tx_req_i);
    // Automatic recovery; the other kind waits for software by rule (BO-03).
    m_automatic: assume (!boff_rec_i);
    m_modes: assume ($initstate
        || {lom_i, lpb_i, fd_tolerant_i} == $past({lom_i, lpb_i, fd_tolerant_i}));
  end

  logic [15:0] f_rank, f_base;
  always_comb begin
    case (field_o)
      can_pkg::FldIdle:    f_base = 16'd0;
      can_pkg::FldBusOff:  f_base = !boff_o ? 16'd17000
                                    : tec_o[7] ? 16'd1 : 16'd1 + {2'b0, 8'd128 - tec_o[7:0], 6'd0};
      can_pkg::FldInteg:   f_base = 16'd9000;
      can_pkg::FldSuspend: f_base = 16'd9100;
      can_pkg::FldInt:     f_base = 16'd9200;
      can_pkg::FldDel:     f_base = 16'd9300;
      can_pkg::FldWait:    f_base = 16'd9400;
      can_pkg::FldOvlFlag: f_base = 16'd9500;
      can_pkg::FldErrFlag: f_base = 16'd9600;
      can_pkg::FldEof:     f_base = 16'd9700;
      can_pkg::FldAckDel:  f_base = 16'd9800;
      can_pkg::FldAck:     f_base = 16'd9900;
      can_pkg::FldCrcDel:  f_base = 16'd10000;
      can_pkg::FldCrc:     f_base = 16'd10100;
      can_pkg::FldData:    f_base = 16'd10200;
      can_pkg::FldDlc:     f_base = 16'd10300;
      can_pkg::FldR0:      f_base = 16'd10400;
      can_pkg::FldR1:      f_base = 16'd10500;
      can_pkg::FldExRtr:   f_base = 16'd10600;
      can_pkg::FldExId:    f_base = 16'd10700;
      can_pkg::FldIde:     f_base = 16'd10800;
      can_pkg::FldRtr:     f_base = 16'd10900;
      can_pkg::FldId:      f_base = 16'd11000;
      can_pkg::FldSof:     f_base = 16'd11100;
      default:             f_base = 16'd17000;
    endcase
    f_rank = f_base + ((field_o == can_pkg::FldIdle) ? 16'd0 : {10'd0, left_o});
  end

  // The rank after two bits, and after four, at the same place of the bit.
  logic [15:0] f_rank2;
  always_ff @(posedge clk_i) if (f_phase == 2'd0 && f_bits == 4'd2) f_rank2 <= f_rank;

  always @(posedge clk_i) if (f_phase == 2'd0 && f_bits == 4'd4) begin
    // IN-01, IF-12: from any value of all flip-flops the node comes nearer to idle in two bits, and
    // once idle it stays so.
    p_nearer: assert (f_rank < f_rank2 || f_rank == '0);
    // IN-01, BO-02: codes of no field, and recovery without bus-off, are left within two bits.
    p_legal: assert (f_base != 16'd17000);
    // IF-17: in idle and in bus-off the pin is recessive.
    p_silent: assert (can_tx_o || !(f_rank == '0 || field_o == can_pkg::FldBusOff));
  end
