// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_mb_pkg: names that the blocks of the message buffers share: the memories that a CPU access
// can select, the hidden rows behind the rows of the buffers, the bits of a C/S word that software
// does not see, and the steps in which a frame to be sent is copied.

package can_mb_pkg;

  // Memory that a CPU access selects (can_mb_port), and its words. TIMER and the stamps are not in
  // these RAMs; their accesses pass the same port, so that they keep their order.
  localparam logic [1:0] MemCs    = 2'd0;   // 3: C/S word; 1: RXFIR, hidden bits of the same row
  localparam logic [1:0] MemMsg   = 2'd1;   // 0: identifier; 1, 2: data bytes 0-3, 4-7
  localparam logic [1:0] MemMask  = 2'd2;   // 0: RXIMR; 1: global mask (3 without OwnMasks)
  localparam logic [1:0] MemTimer = 2'd3;   // 1: TIMER; 2, 3: lower, upper half of a stamp

  // C/S memory: offsets from row NumMb of the C/S words of two frames to be sent and two received.
  localparam int RowSent     = 0;
  localparam int RowReceived = 2;
  // Mask memory: offsets from row NumMb. Nobody writes RowOnes after the RAM has been cleared: it
  // stays all ones. Without OwnMasks the four global masks are in the MSG memory (GroupMask).
  localparam logic [1:0] RowRxgmask  = 2'd0;
  localparam logic [1:0] RowRx14mask = 2'd1;
  localparam logic [1:0] RowRx15mask = 2'd2;
  localparam logic [1:0] RowRxfgmask = 2'd3;
  localparam int         RowOnes     = 4;

  // MSG memory: hidden rows from row 3 * NumMb on, in groups of four: two groups for frames to be
  // sent, two for frames received. Rows of a group: identifier, data bytes 0-3, data bytes 4-7, and
  // a global mask (GroupMask) in a core without OwnMasks.
  localparam logic [1:0] GroupMask = 2'd3;
  function automatic logic [3:0] hidden_msg(input logic received, input logic which,
                                            input logic [1:0] word);
    hidden_msg = {received, which, word};
  endfunction

  // Bits of a stored C/S word that software does not see.
  localparam int CsServiced = 31;   // 1: the CPU has read the frame and unlocked the buffer
  localparam int CsEnded    = 30;   // 1: a transmission has ended since the CPU wrote the word
  localparam int CsElement  = 23;   // 31:23 in the Rx FIFO: number of the filter element (IDHIT)

  // Steps that can_mb_load requests and can_mb_step carries out.
  localparam logic [2:0] StepWord = 3'd0;   // read the next data word for the engine
  localparam logic [2:0] StepEnd  = 3'd1;   // write the C/S word of an ended frame to its buffer
  localparam logic [2:0] StepLow  = 3'd2;   // copy data bytes 0-3 to a hidden row
  localparam logic [2:0] StepHigh = 3'd3;   // copy data bytes 4-7 to a hidden row
  localparam logic [2:0] StepHead = 3'd4;   // copy C/S, read identifier: the frame is presented

endpackage
