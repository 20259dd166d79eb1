// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_mb_pkg: names that the blocks of the message buffers share: memories, rows behind the
// buffers, bits that software does not see, steps of a frame that is sent.

package can_mb_pkg;

  // Memory that a command of the CPU means (can_mb_port).
  localparam logic [1:0] MemCs    = 2'd0;   // C/S words, word 3; word 1: RXFIR, of the same row
  localparam logic [1:0] MemMsg   = 2'd1;   // identifiers and data, word 0 to 2
  localparam logic [1:0] MemMask  = 2'd2;   // masks; word 1: one of the global ones
  localparam logic [1:0] MemTimer = 2'd3;   // none, but ordered like one: TIMER, or a stamp

  // Rows behind the buffers, from NumMb on. C/S words: of two frames to send, of two received.
  localparam int RowSent     = 0;
  localparam int RowReceived = 2;
  // Masks; RowOnes holds ones. Without OwnMasks the first four are in MSG, see GroupMask.
  localparam logic [1:0] RowRxgmask  = 2'd0;
  localparam logic [1:0] RowRx14mask = 2'd1;
  localparam logic [1:0] RowRx15mask = 2'd2;
  localparam logic [1:0] RowRxfgmask = 2'd3;
  localparam int         RowOnes     = 4;

  // MSG, from 3 * NumMb on: groups of four rows, two for frames to send and two for frames
  // received: identifier, bytes 0 to 3, bytes 4 to 7; the fourth row is for masks.
  localparam logic [1:0] GroupMask = 2'd3;
  function automatic logic [3:0] hidden_msg(input logic received, input logic which,
                                            input logic [1:0] word);
    hidden_msg = {received, which, word};
  endfunction

  // Bits of a C/S word that software does not see.
  localparam int CsServiced = 31;   // the frame received has been read and let go
  localparam int CsEnded    = 30;   // a transmission has ended since software wrote the word
  localparam int CsElement  = 23;   // 31:23 in the Rx FIFO: element of the filter table

  // Steps of can_mb_load, which can_mb_step carries out.
  localparam logic [2:0] StepWord = 3'd0;   // next word to the engine
  localparam logic [2:0] StepEnd  = 3'd1;   // C/S word of a frame that has been sent
  localparam logic [2:0] StepLow  = 3'd2;   // bytes 0 to 3 into a hidden row
  localparam logic [2:0] StepHigh = 3'd3;   // bytes 4 to 7
  localparam logic [2:0] StepHead = 3'd4;   // C/S word and identifier: the frame is presented

endpackage
