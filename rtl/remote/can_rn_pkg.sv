// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_rn_pkg: types and constants shared by the blocks of can_remote: jobs of the sequencer
// can_rn_step, sources of the next frame to send, node states, result codes.

package can_rn_pkg;

  // Jobs of can_rn_step. A job consists of phases of one clock each. A byte that a job addresses in
  // one phase is registered two phases later (can_rn_data). Some blocks decode single bits of a
  // code, so codes cannot be changed freely: can_rn_step (JobBegin, JobHead, JobFind, JobGuard),
  // can_rn_cell (JobLow, JobHigh), can_rn_port (JobFresh, JobLoad, JobPush).
  typedef logic [5:0] job_t;
  // 0_000xx: user logic has the RAM; these jobs wait for an event.
  localparam logic [5:0] JobIdle    = 6'b0_00000;
  localparam logic [5:0] JobBegin   = 6'b0_00001;   // start a request unless the user holds (RN-52)
  localparam logic [5:0] JobInt2    = 6'b0_00010;   // wait for the sample point of INT2 (RN-45)
  localparam logic [5:0] JobStart   = 6'b0_00011;   // off the bus: wait for start_i (RN-60)
  // 0_001xx: several phases.
  localparam logic [5:0] JobByte    = 6'b0_00100;   // store a received byte in the row of the frame
  localparam logic [5:0] JobMove    = 6'b0_00101;   // copy memory to row, or row to memory
  localparam logic [5:0] JobClear   = 6'b0_00110;   // clear the whole RAM (RN-60)
  localparam logic [5:0] JobLoad    = 6'b0_00111;   // fetch the next word for the engine
  // 0_01xxx: one phase.
  localparam logic [5:0] JobHead    = 6'b0_01000;   // the access starts at A of the header
  localparam logic [5:0] JobFresh   = 6'b0_01001;   // write state, TEC, REC to the row of STATUS
  localparam logic [5:0] JobPush    = 6'b0_01010;   // the answer is complete: its A and length
  // Two phases per byte: compare the bytes of a producer with those last sent.
  localparam logic [5:0] JobSame    = 6'b0_01011;
  // Map entries: two phases per entry searched, two phases, four phases.
  localparam logic [5:0] JobFind    = 6'b0_01100;   // search the entry that takes the frame
  localparam logic [5:0] JobAim     = 6'b0_01101;   // fetch the address of the entry that was found
  localparam logic [5:0] JobLate    = 6'b0_01110;   // update and check the time-out of an entry
  // 0_10xxx: three phases; one byte is read in the first and written in the third.
  localparam logic [5:0] JobTrigger = 6'b0_10000;   // store the TRIGGER count
  localparam logic [5:0] JobKeep    = 6'b0_10001;   // start the gap of a producer
  localparam logic [5:0] JobTry     = 6'b0_10010;   // count a failed attempt (RN-15)
  localparam logic [5:0] JobHigh    = 6'b0_10011;   // count the high byte of a timer
  localparam logic [5:0] JobTurn    = 6'b0_10100;   // enter or leave bus-off, load timer (RN-72)
  localparam logic [5:0] JobGap     = 6'b0_10101;   // count the gap of a producer
  localparam logic [5:0] JobLow     = 6'b0_10110;   // count the low byte of a timer
  // Four phases; two bytes are read.
  localparam logic [5:0] JobGuard   = 6'b0_10111;   // check the protection of first and last byte
  // 0_11xxx: four phases; two bytes are read and two are written.
  localparam logic [5:0] JobCount   = 6'b0_11000;   // store code and A of a request, count (RN-24)
  localparam logic [5:0] JobRenew   = 6'b0_11001;   // restart the period of a producer
  localparam logic [5:0] JobDown    = 6'b0_11010;   // count the period of a producer
  localparam logic [5:0] JobConfig  = 6'b0_11011;   // read node number and FLAGS
  localparam logic [5:0] JobRow     = 6'b0_11100;   // load LIFE of the next answer, RETRY
  localparam logic [5:0] JobEntry   = 6'b0_11101;   // read A and mode of a producer
  localparam logic [5:0] JobAge     = 6'b0_11110;   // age an answer by 10 ms (RN-54)
  localparam logic [5:0] JobFeed    = 6'b0_11111;   // reload the watchdog from WDT

  // 1_10xxx: three phases as in 0_10xxx, only with counters or block transfers.
  localparam logic [5:0] JobTally   = 6'b1_10000;   // increment a counter, or clear all of them
  localparam logic [5:0] JobSeq     = 6'b1_10001;   // write the sequence number into a DATA frame
  localparam logic [5:0] JobClock   = 6'b1_10010;   // count the time of a block transfer
  // 1_11xxx: four phases as in 0_11xxx, repeated for each pair of bytes.
  localparam logic [5:0] JobAdd     = 6'b1_11000;   // advance a block transfer by the bytes moved
  localparam logic [5:0] JobOpen    = 6'b1_11001;   // set up a block transfer from BLOCK
  // 1_01xxx: four phases, one phase.
  localparam logic [5:0] JobFetch   = 6'b1_01000;   // fetch the address at which a transfer goes on
  localparam logic [5:0] JobClose   = 6'b1_01001;   // store the code with which a transfer ends

  // Source of the frame that is offered to the engine (can_rn_tx).
  localparam logic [1:0] SrcNone    = 2'd0;
  localparam logic [1:0] SrcQueue   = 2'd1;
  localparam logic [1:0] SrcStatus  = 2'd2;
  localparam logic [1:0] SrcHere    = 2'd3;

  // State of the node, encoded as in STATUS (RN-24). LISTEN (1) is not kept here, see can_remote.
  localparam logic [1:0] NodeInit    = 2'd0;
  localparam logic [1:0] NodeSafe    = 2'd2;
  localparam logic [1:0] NodeOperate = 2'd3;

  // Result codes (RN-30). Bit 3 of these constants is bit 4 of the code in STATUS.
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
