// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_rn_pkg: names that the blocks of can_remote share: jobs of the step machine, node states,
// result codes.

package can_rn_pkg;

  // Jobs of can_rn_step. A job has phases, one clock each. Some blocks look at single bits of a
  // code: can_rn_step (JobBegin, JobHead, JobFind, JobGuard), can_rn_cell (JobLow, JobHigh),
  // can_rn_port (JobFresh, JobLoad, JobPush).
  typedef logic [5:0] job_t;
  // 0_000xx: the RAM belongs to user logic. These take as long as it takes.
  localparam logic [5:0] JobIdle    = 6'b0_00000;
  localparam logic [5:0] JobBegin   = 6'b0_00001;   // a request begins, unless user holds (RN-52)
  localparam logic [5:0] JobInt2    = 6'b0_00010;   // wait for the sample point of INT2 (RN-45)
  localparam logic [5:0] JobStart   = 6'b0_00011;   // wait for start_i (RN-60)
  // 0_001xx: more than one phase.
  localparam logic [5:0] JobByte    = 6'b0_00100;   // a byte of the frame into its row
  localparam logic [5:0] JobMove    = 6'b0_00101;   // memory to row, or row to memory
  localparam logic [5:0] JobClear   = 6'b0_00110;   // all of the RAM (RN-60)
  localparam logic [5:0] JobLoad    = 6'b0_00111;   // next word for the engine
  // 0_01xxx: one phase.
  localparam logic [5:0] JobHead    = 6'b0_01000;   // A of the header is where the access starts
  localparam logic [5:0] JobFresh   = 6'b0_01001;   // state, TEC, REC into the row of STATUS
  localparam logic [5:0] JobPush    = 6'b0_01010;   // the answer is complete: its A and length
  // As long as it takes: bytes of a producer beside those sent last.
  localparam logic [5:0] JobSame    = 6'b0_01011;
  // As long as it takes, two clocks, four: map entries.
  localparam logic [5:0] JobFind    = 6'b0_01100;   // one that takes the frame
  localparam logic [5:0] JobAim     = 6'b0_01101;   // where it puts it
  localparam logic [5:0] JobLate    = 6'b0_01110;   // its time-out
  // 0_10xxx: three phases: a byte is read in the first and written in the third.
  localparam logic [5:0] JobTrigger = 6'b0_10000;   // TRIGGER count
  localparam logic [5:0] JobKeep    = 6'b0_10001;   // its gap begins
  localparam logic [5:0] JobTry     = 6'b0_10010;   // an attempt has failed (RN-15)
  localparam logic [5:0] JobHigh    = 6'b0_10011;   // high byte of a timer
  localparam logic [5:0] JobTurn    = 6'b0_10100;   // bus-off begins or ends (RN-72)
  localparam logic [5:0] JobGap     = 6'b0_10101;   // what is left of the gap of a producer
  localparam logic [5:0] JobLow     = 6'b0_10110;   // low byte of a timer
  // Four phases: two bytes are read.
  localparam logic [5:0] JobGuard   = 6'b0_10111;   // protection of first and last byte
  // 0_11xxx: four phases: two bytes are read and two written.
  localparam logic [5:0] JobCount   = 6'b0_11000;   // code, A and count of a request (RN-24)
  localparam logic [5:0] JobRenew   = 6'b0_11001;   // its period begins
  localparam logic [5:0] JobDown    = 6'b0_11010;   // its period goes on
  localparam logic [5:0] JobConfig  = 6'b0_11011;   // number and flags
  localparam logic [5:0] JobRow     = 6'b0_11100;   // life of the next answer, attempts
  localparam logic [5:0] JobEntry   = 6'b0_11101;   // A and mode of a producer
  localparam logic [5:0] JobAge     = 6'b0_11110;   // the answer has aged by 10 ms (RN-54)
  localparam logic [5:0] JobFeed    = 6'b0_11111;   // watchdog from its configuration

  // 1_10xxx: as 0_10xxx, in nodes with counters or block transfers.
  localparam logic [5:0] JobTally   = 6'b1_10000;   // one more of what is counted, or all to 0
  localparam logic [5:0] JobSeq     = 6'b1_10001;   // seq into the frame of data
  localparam logic [5:0] JobClock   = 6'b1_10010;   // clock of a block transfer
  // 1_11xxx: as 0_11xxx, round by round.
  localparam logic [5:0] JobAdd     = 6'b1_11000;   // what a frame has moved
  localparam logic [5:0] JobOpen    = 6'b1_11001;   // a block transfer is opened
  // 1_01xxx: four phases, one phase.
  localparam logic [5:0] JobFetch   = 6'b1_01000;   // where it goes on
  localparam logic [5:0] JobClose   = 6'b1_01001;   // its code

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
  localparam logic [3:0] CodeOpen      = 4'h5;
  localparam logic [3:0] CodeBusy      = 4'h6;
  localparam logic [3:0] CodeProtected = 4'h8;
  localparam logic [3:0] CodeLocked    = 4'h9;
  localparam logic [3:0] CodeSequence  = 4'hA;
  localparam logic [3:0] CodeTimeout   = 4'hB;
  localparam logic [3:0] CodeAborted   = 4'hC;

endpackage
