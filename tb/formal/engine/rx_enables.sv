  // SPDX-FileCopyrightText: 2026 The VeriCAN authors
  // SPDX-License-Identifier: Apache-2.0
  //
  // Properties of can_rx_frame in can_bsp (bsp_inputs.sv), spliced into it: what is decided in a
  // bit's first clock is what the sample point would decide.

  logic f_load, f_in_ex_id;
  assign f_in_ex_id = field_i == can_pkg::FldExId;
  assign f_load     = !stuff_i && (field_i == can_pkg::FldDlc ? last_i : in_data && word_end_i);

  // The first bit after a stop has no first clock of its own and is decided by what was stopped: it
  // is one of integration, in which nobody sends and nobody looks at the shift register.
  logic f_joins;
  assign f_joins = field_i == can_pkg::FldInteg || field_i == can_pkg::FldBusOff;

  // What the sample point makes of the shift register.
  logic [31:0] f_next;
  always_comb begin
    f_next = gen_words.shift_q;
    if (take_i || f_load) f_next = tx_word_i;
    else if (!stuff_i) begin
      if (in_id || in_data)      f_next[31:18] = {f_next[30:18], in_id ? bit_i : f_next[17]};
      if (f_in_ex_id || in_data) f_next[17:0]  = {gen_words.shift_q[16:0], bit_i};
    end
  end

  always @(posedge clk_i) if (rst_ni && !$initstate && $past(rst_ni)) begin
    // TH-06, FF-13: in a frame, and where an own one begins, it does just that; elsewhere, where
    // it is not looked at, it may take the next word.
    p_shift: assert (gen_words.shift_q == $past(sample_i ? f_next : gen_words.shift_q)
        || $past(sample_i && !take_i && !(|field_i[4:3])));
  end

  always @(posedge clk_i) if (rst_ni && sample_i) begin
    // TH-06, FF-07: the next data word is taken with the last bit of the DLC and of the fourth
    // byte, if something follows.
    p_load: assert (f_joins ? !(load_o && transmitter_i) : load_o == f_load);
    // FF-13: the upper part moves with each bit of the identifier or of the data, ...
    p_high: assert (f_joins || gen_words.high_q == (f_load || (!stuff_i && (in_id || in_data))));
    // FF-13: ... the lower one with each of its extension or of the data.
    p_low: assert (f_joins || gen_words.low_q == (f_load || (!stuff_i && (f_in_ex_id || in_data))));
    // TH-06: where an own frame begins its head is taken, and no word is overwritten in a frame.
    p_free: assert ((!take_i || free_i)
                    && (!free_i || !(in_id || f_in_ex_id || in_data || f_load)));
  end
