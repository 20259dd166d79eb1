  // SPDX-FileCopyrightText: 2026 The VeriCAN authors
  // SPDX-License-Identifier: Apache-2.0
  //
  // A pending frame starts (TH-07), spliced into can_bsp. The first state is any state between
  // frames, in a flag or a delimiter, as p_places and p_level of bsp_always.sv prove; bus quiet.

  logic [6:0] f_bits;   // bits since the start
  logic [1:0] f_phase;  // 0 first clock, 1 sample, 2 last clock of a bit
  logic       f_integrating, f_started;
  initial begin
    f_bits    = '0;
    f_phase   = '0;
    f_started = 1'b0;
  end
  always_ff @(posedge clk_i) begin
    f_phase <= (f_phase == 2'd2) ? 2'd0 : f_phase + 2'd1;
    if (f_phase == 2'd2 && !(&f_bits)) f_bits <= f_bits + 7'd1;
    if (f_bits == '0 && f_phase == 2'd0) f_integrating <= field_o == can_pkg::FldInteg;
    if (sample_i && take_tx) f_started <= 1'b1;
  end

  always @(posedge clk_i) begin
    m_no_reset: assume (rst_ni && run_i && stay_i && !lom_i && !lpb_i);
    m_strobes: assume (judge_i == (f_phase == 2'd0) && sample_i == (f_phase == 2'd1)
                       && boundary_i == (f_phase == 2'd2));
    // The others are silent; a frame is pending.
    m_quiet: assume (bit_i == tx_o && !edge_i && tx_req_i);
    m_modes: assume ($initstate || fd_tolerant_i == $past(fd_tolerant_i));
    // Where the search begins: not in a frame, not in bus-off, the level sent as the place wants
    // it.
    m_start: assume (!$initstate || (f_place_ok && field_o != can_pkg::FldBusOff && !boff_o
                     && !boff_enter && (field_o[4:3] == 2'b00 || field_o[4:2] == 3'b111)
                     && tx_o == !((field_o == can_pkg::FldErrFlag && !passive_flag)
                                  || field_o == can_pkg::FldOvlFlag)));
  end

  logic f_place_ok;
  always_comb begin
    case (field_o)
      can_pkg::FldErrFlag, can_pkg::FldOvlFlag: f_place_ok = left_o <= 6'd5;
      can_pkg::FldDel:                          f_place_ok = left_o <= 6'd6;
      can_pkg::FldInt:                          f_place_ok = left_o <= 6'd2;
      can_pkg::FldSuspend:                      f_place_ok = left_o <= 6'd7;
      can_pkg::FldInteg:                        f_place_ok = left_o <= 6'd10;
      default:                                  f_place_ok = 1'b1;
    endcase
  end

  always @(posedge clk_i) if (f_phase == 2'd0) begin
    // TH-07: SOF at the latest in the 27th bit, after 26: flag 6, delimiter 8, intermission 3,
    // suspend 8, 1.
    p_starts: assert (f_bits < 7'd26 || f_started || boff_o);
    // TH-07, IN-04: and after 12 when integrating.
    p_integrated: assert (f_bits < 7'd12 || !f_integrating || f_started || boff_o);
  end
