// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_rn_pkg: names that the blocks of can_remote share: jobs of the step machine, node states,
// result codes.

package can_rn_pkg;

  // Jobs of can_rn_step. A job has phases, one clock each.
  typedef logic [4:0] job_t;
  // 000xx: the RAM belongs to user logic. These take as long as it takes.
  localparam logic [4:0] JobIdle    = 5'b00000;
  localparam logic [4:0] JobBegin   = 5'b00001;   // a request begins, unless user holds (RN-52)
  localparam logic [4:0] JobInt2    = 5'b00010;   // wait for the sample point of INT2 (RN-45)
  localparam logic [4:0] JobStart   = 5'b00011;   // wait for start_i (RN-60)
  // 001xx: more than one phase.
  localparam logic [4:0] JobByte    = 5'b00100;   // a byte of the frame into its row
  localparam logic [4:0] JobMove    = 5'b00101;   // memory to row, or row to memory
  localparam logic [4:0] JobClear   = 5'b00110;   // all of the RAM (RN-60)
  localparam logic [4:0] JobLoad    = 5'b00111;   // next word for the engine
  // 01xxx: one phase.
  localparam logic [4:0] JobHead    = 5'b01000;   // A of the header is where the access starts
  localparam logic [4:0] JobFresh   = 5'b01001;   // state, TEC, REC into the row of STATUS
  localparam logic [4:0] JobPush    = 5'b01010;   // the answer is complete: its A and length
  // As long as it takes: bytes of a producer beside those sent last.
  localparam logic [4:0] JobSame    = 5'b01011;
  // Two clocks, or as long as it takes: map entries.
  localparam logic [4:0] JobFind    = 5'b01100;   // one that takes the frame
  localparam logic [4:0] JobAim     = 5'b01101;   // where it puts it
  localparam logic [4:0] JobLook    = 5'b01110;   // whether it is on
  localparam logic [4:0] JobLate    = 5'b01111;   // four clocks: its time-out
  // 10xxx: three phases: a byte is read in the first and written in the third.
  localparam logic [4:0] JobTrigger = 5'b10000;   // TRIGGER count
  localparam logic [4:0] JobTurn    = 5'b10001;   // bus-off begins or ends (RN-72)
  localparam logic [4:0] JobLow     = 5'b10010;   // low byte of a timer
  localparam logic [4:0] JobHigh    = 5'b10011;   // high byte of a timer
  localparam logic [4:0] JobTry     = 5'b10100;   // an attempt has failed (RN-15)
  localparam logic [4:0] JobGap     = 5'b10101;   // what is left of the gap of a producer
  localparam logic [4:0] JobKeep    = 5'b10110;   // its gap begins, or the time of a map entry
  // Four phases: two bytes are read.
  localparam logic [4:0] JobGuard   = 5'b10111;   // protection of first and last byte
  // 11xxx: four phases: two bytes are read and two written.
  localparam logic [4:0] JobAge     = 5'b11000;   // the answer has aged by 10 ms (RN-54)
  localparam logic [4:0] JobCount   = 5'b11001;   // code, A and count of a request (RN-24)
  localparam logic [4:0] JobRow     = 5'b11010;   // life of the next answer, attempts
  localparam logic [4:0] JobConfig  = 5'b11011;   // number and flags
  localparam logic [4:0] JobFeed    = 5'b11100;   // watchdog from its configuration
  localparam logic [4:0] JobEntry   = 5'b11101;   // A and mode of a producer
  localparam logic [4:0] JobDown    = 5'b11110;   // its period goes on
  localparam logic [4:0] JobRenew   = 5'b11111;   // its period begins

  // What is offered to the engine (can_rn_tx).
  localparam logic [1:0] SrcNone    = 2'd0;
  localparam logic [1:0] SrcQueue   = 2'd1;
  localparam logic [1:0] SrcStatus  = 2'd2;
  localparam logic [1:0] SrcHere    = 2'd3;

  // State of the node, as in STATUS (RN-24).
  localparam logic [1:0] NodeInit    = 2'd0;
  localparam logic [1:0] NodeSafe    = 2'd2;
  localparam logic [1:0] NodeOperate = 2'd3;

  // Result codes (RN-30); bit 3 here is bit 4 of the byte.
  localparam logic [3:0] CodeOk        = 4'h0;
  localparam logic [3:0] CodeFunction  = 4'h1;
  localparam logic [3:0] CodeAddress   = 4'h2;
  localparam logic [3:0] CodeValue     = 4'h3;
  localparam logic [3:0] CodeBusy      = 4'h6;
  localparam logic [3:0] CodeProtected = 4'h8;
  localparam logic [3:0] CodeLocked    = 4'h9;

endpackage
