// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_field: position in the bit stream: field, bits left in it, and role of the node. Rules IF,
// RO, EF, OV, IN, BO. The states of the paper: WAIT_FOR_BUS_IDLE = FldInteg, IDLE = FldIdle,
// BUS_OFF_RECOVERY = FldBusOff; all other fields are RECEIVING or TRANSMITTING by transmitter_o.

module can_field (
  input  logic            clk_i,
  input  logic            rst_ni,
  input  logic            run_i,           // 0: not on the bus; then integrate (IN-01)
  input  logic            sample_i,        // pulse: sample point
  input  logic            bit_i,           // sampled bit
  input  logic            judge_i,         // first clock of a bit, see can_error
  input  logic            stuff_i,         // current bit is a stuff bit: the field does not advance
  input  logic            prev_i,          // level of the previous bit
  input  logic [2:0]      ones_i,          // recessive bits up to the previous one, see can_stuff
  input  logic            edge_i,          // pulse: synchronising edge
  // Result of can_error for this bit
  input  logic            error_i,         // error: an error flag follows
  input  logic            lost_i,          // arbitration is lost
  input  logic            overload_i,      // an overload flag follows
  input  logic            flag_r_i,        // either follows if the bit is recessive
  input  logic            flag_d_i,        // either follows if it is dominant
  // Fault confinement
  input  logic            passive_i,       // error passive before this bit is counted (EF-05)
  input  logic            boff_i,          // bus-off
  input  logic            boff_enter_i,    // pulse: bus-off begins
  input  logic            boff_end_i,      // a recessive bit here completes bus-off recovery
  // Frame and configuration
  input  logic            tx_req_i,        // a frame waits
  input  logic            ide_i,           // received frame is extended
  input  logic            rtr_i,           // received frame is a remote frame
  input  logic [2:0]      dlc_i,           // DLC3..DLC1; DLC0 is the bit being sampled
  input  logic            lom_i,           // listen-only (MO-01)
  input  logic            fd_tolerant_i,   // protocol exception on a recessive FDF bit (FF-06)
  output can_pkg::field_t field_o,         // field of the current bit
  output logic [5:0]      left_o,          // bits of the field after the current one
  output logic            ends_o,          // last bit of the field
  output logic            last_o,          // last bit of the field, from its second clock on
  output logic            transmitter_o,   // transmitter of the current frame (RO-01)
  output logic            passive_flag_o,  // the error flag that is sent is passive
  output logic            overload_frame_o, // flag or delimiter belongs to an overload frame
  output logic            free_o,          // a frame may begin after this bit
  output logic            own_free_o,      // an own frame may begin after this bit, known early
  output logic            begin_rx_o,      // at this sample point a foreign frame begins
  output logic            take_tx_o        // at this sample point an own frame begins
);

  // Keep the encoding: unused codes, reached by an upset, lead to integration (default below).
  (* fsm_encoding = "none", syn_encoding = "safe" *) can_pkg::field_t field_q;
  logic [5:0]      left_q;
  logic            tx_q, passive_flag_q, overload_q;

  logic last_q, free_r_q, free_d_q, join_q;
  logic ends, astray, suspend, may_begin, fd_frame, restart;

  assign field_o          = field_q;
  assign left_o           = left_q;
  assign ends_o           = ends;
  assign last_o           = last_q;
  assign transmitter_o    = tx_q;
  assign passive_flag_o   = passive_flag_q;
  assign overload_frame_o = overload_q;

  // Flags and delimiters have less than eight bits. Upper bits of the count, which only an upset
  // sets there (except in FldWait), must not lengthen a dominant flag.
  assign ends    = (left_q[2:0] == '0) && (left_q[5:3] == '0 || (&field_q[4:2]));
  // Codes that are no field are left at the end of the bit.
  assign astray  = field_q[2] && !(&field_q[4:3]) && (field_q[1] || (field_q[0] && !field_q[3]));
  assign suspend = tx_q && passive_i;                                        // IF-08, IF-11

  // Whether a frame may begin after this bit. After a recessive bit an own frame may begin; a
  // dominant bit is a start of frame (IF-03, IF-05, IF-12, IN-04), which an own frame joins unless
  // suspended (IF-06, IF-10).
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni)     {last_q, free_r_q, free_d_q, join_q} <= '0;
    else if (!run_i) {last_q, free_r_q, free_d_q, join_q} <= '0;
    else begin
      if (judge_i) begin
        last_q <= ends || astray;
        join_q <= !suspend && (field_q == can_pkg::FldIdle || field_q == can_pkg::FldInt);
        case (field_q)
          can_pkg::FldIdle:    {free_r_q, free_d_q} <= 2'b11;
          can_pkg::FldInt:     {free_r_q, free_d_q} <= {ends && !suspend, ends};
          can_pkg::FldSuspend: {free_r_q, free_d_q} <= {ends, 1'b1};
          can_pkg::FldInteg:   {free_r_q, free_d_q} <= {ends, 1'b0};
          can_pkg::FldBusOff:  {free_r_q, free_d_q} <= {boff_end_i, 1'b0};
          default:             {free_r_q, free_d_q} <= 2'b00;
        endcase
      end
      if (restart) {last_q, free_r_q} <= '0;
    end
  end

  assign free_o     = may_begin;
  assign own_free_o = free_r_q;   // where one is joined it could have begun, too
  assign may_begin  = bit_i ? free_r_q : free_d_q;
  assign take_tx_o  = may_begin && tx_req_i && (bit_i || join_q);
  assign begin_rx_o = may_begin && !bit_i && !take_tx_o;

  // Recessive FDF bit, for a receiver that tolerates FD frames (FF-06).
  assign fd_frame = fd_tolerant_i && bit_i && !tx_q && !stuff_i
                    && (field_q == can_pkg::FldR1 || (field_q == can_pkg::FldR0 && !ide_i));

  // IN-02: such a receiver also restarts its count of eleven bits at edges between sample points.
  assign restart = fd_tolerant_i && edge_i && field_q == can_pkg::FldInteg;

  // Next field and its length. The table does not depend on whether the field ends: apart from
  // bit_i all its inputs are known before the sample point.
  can_pkg::field_t next, field_d;
  logic [5:0]      length, left_d;
  always_comb begin
    next   = field_q;
    length = 6'd0;
    case (field_q)
      can_pkg::FldInteg, can_pkg::FldBusOff: length = 6'd10;
      can_pkg::FldInt: begin
        next   = can_pkg::FldSuspend;
        length = 6'd7;
      end
      can_pkg::FldSof: begin
        next   = can_pkg::FldId;
        length = 6'd10;
      end
      can_pkg::FldId:    next = can_pkg::FldRtr;
      can_pkg::FldRtr:   next = can_pkg::FldIde;
      can_pkg::FldIde: begin
        next   = bit_i ? can_pkg::FldExId : can_pkg::FldR0;
        length = {1'b0, bit_i, 3'b000, bit_i};
      end
      can_pkg::FldExId:  next = can_pkg::FldExRtr;
      can_pkg::FldExRtr: next = can_pkg::FldR1;
      can_pkg::FldR1:    next = can_pkg::FldR0;
      can_pkg::FldR0: begin
        next   = can_pkg::FldDlc;
        length = 6'd3;
      end
      can_pkg::FldDlc: begin
        // min(DLC, 8) data bytes, none in a remote frame (FF-03, FF-07).
        if (rtr_i || {dlc_i, bit_i} == 4'd0) begin
          next   = can_pkg::FldCrc;
          length = 6'd14;
        end else begin
          next   = can_pkg::FldData;
          length = {dlc_i[2] ? 3'd7 : {dlc_i[1:0], bit_i} - 3'd1, 3'd7};
        end
      end
      can_pkg::FldData: begin
        next   = can_pkg::FldCrc;
        length = 6'd14;
      end
      can_pkg::FldCrc:    next = can_pkg::FldCrcDel;
      can_pkg::FldCrcDel: next = can_pkg::FldAck;
      can_pkg::FldAck:    next = can_pkg::FldAckDel;
      can_pkg::FldAckDel: begin
        next   = can_pkg::FldEof;
        length = 6'd6;
      end
      can_pkg::FldEof, can_pkg::FldDel: begin
        next   = can_pkg::FldInt;
        length = 6'd2;
      end
      can_pkg::FldErrFlag, can_pkg::FldOvlFlag: begin
        next   = can_pkg::FldWait;
        length = 6'd39;  // see can_fault: first bit after the flag, then modulo 8
      end
      can_pkg::FldWait: begin
        next   = can_pkg::FldDel;  // that bit was DEL1 (EF-08)
        length = 6'd6;
      end
      can_pkg::FldIdle, can_pkg::FldSuspend: ;   // left by may_begin alone
      default: begin             // no such field: an upset flip-flop; join the bus anew
        next   = can_pkg::FldInteg;
        length = 6'd10;
      end
    endcase
  end
  // The last bit of a field leads to the next one. Integration and recovery restart their count at
  // a dominant bit; the wait after a flag ends with a recessive bit.
  logic stops, flags, integ, change, moves, go;
  assign stops  = !run_i || boff_enter_i;
  assign flags  = error_i || overload_i;
  assign integ  = field_q == can_pkg::FldInteg || field_q == can_pkg::FldBusOff;
  assign moves  = field_q == can_pkg::FldWait ? bit_i : last_q || (integ && !bit_i);
  // A passive flag is complete after six equal bits; a level change restarts the count (EF-03). In
  // the first bit of the flag both branches lead to 4.
  assign change = field_q == can_pkg::FldErrFlag && passive_flag_q && bit_i != prev_i;
  // As may_begin || flags || !stuff_i, but prepared for both levels: the bit comes late.
  assign go     = stops || (sample_i && (bit_i ? free_r_q || flag_r_i || !stuff_i
                                               : free_d_q || flag_d_i || !stuff_i));

  always_comb begin
    field_d = moves && !change ? next : field_q;
    left_d  = {(&field_q[4:2]) ? 3'd0 : left_q[5:3] - 3'(left_q[2:0] == '0), left_q[2:0] - 3'd1};
    if (moves)  left_d = length;
    if (change) left_d = 6'd4;
    // Recovery without bus-off, caused by an upset, would never end.
    if (integ && !boff_i) field_d = can_pkg::FldInteg;
    if (fd_frame) begin
      field_d = can_pkg::FldInteg;
      left_d  = 6'd10;
    end
    if (flags) begin
      field_d = error_i ? can_pkg::FldErrFlag : can_pkg::FldOvlFlag;
      left_d  = 6'd5;
      // A listen-only node sends no flag. It integrates, and the recessive bits that it has just
      // seen are the first of the eleven (MO-02).
      if (lom_i) begin
        field_d = can_pkg::FldInteg;
        left_d  = bit_i ? 6'd9 - {3'd0, ones_i} : 6'd10;
      end
    end
    if (may_begin) begin
      field_d = !bit_i ? can_pkg::FldId : take_tx_o ? can_pkg::FldSof : can_pkg::FldIdle;
      left_d  = bit_i ? 6'd0 : 6'd10;
    end
    if (stops) begin
      field_d = boff_i ? can_pkg::FldBusOff : can_pkg::FldInteg;
      left_d  = 6'd10;
    end
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      field_q <= can_pkg::FldInteg;
      left_q  <= 6'd10;
    end else if (go) begin
      field_q <= field_d;
      left_q  <= left_d;
    end else if (restart && !sample_i) begin
      left_q  <= 6'd10;
    end
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      tx_q           <= 1'b0;
      passive_flag_q <= 1'b0;
      overload_q     <= 1'b0;
    end else if (stops) begin
      tx_q <= 1'b0;
    end else if (sample_i) begin
      if (may_begin)                                     tx_q <= take_tx_o;
      else if ((lost_i || astray) && !flags && !stuff_i) tx_q <= 1'b0;
      if (flags && !may_begin) {passive_flag_q, overload_q} <= {passive_i, !error_i};
    end
  end

endmodule
