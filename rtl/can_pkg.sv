// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_pkg: types and constants shared by all blocks: levels, fields of the bit stream, errors,
// trace layout, commands of the time unit.

package can_pkg;

  // Bus levels. The bus is the AND of all drivers.
  localparam logic Dominant  = 1'b0;
  localparam logic Recessive = 1'b1;

  // Fields of the bit stream: where the current bit is. The two upper bits form groups, so that
  // decodes like "is stuffed" and "is arbitration" take one gate.
  typedef logic [4:0] field_t;
  // 00xxx: between frames; the node never sends dominant here.
  localparam logic [4:0] FldInteg   = 5'b00000;  // WAIT_FOR_BUS_IDLE: eleven recessive bits (IN-01)
  localparam logic [4:0] FldBusOff  = 5'b00001;  // BUS_OFF_RECOVERY: counts 128 x 11 (BO-02)
  localparam logic [4:0] FldIdle    = 5'b00010;  // bus idle (IF-12)
  localparam logic [4:0] FldInt     = 5'b00011;  // intermission INT1..INT3 (IF-01)
  localparam logic [4:0] FldSuspend = 5'b00100;  // suspend transmission (IF-08)
  // 01xxx: stuffed: arbitration field and the SOF before it.
  localparam logic [4:0] FldSof     = 5'b01000;  // own start of frame
  localparam logic [4:0] FldId      = 5'b01001;  // ID28..ID18
  localparam logic [4:0] FldRtr     = 5'b01010;  // RTR (base) or SRR (extended)
  localparam logic [4:0] FldIde     = 5'b01011;  // IDE
  localparam logic [4:0] FldExId    = 5'b01100;  // ID17..ID0
  localparam logic [4:0] FldExRtr   = 5'b01101;  // RTR (extended)
  // 10xxx: stuffed: control field to CRC.
  localparam logic [4:0] FldR1      = 5'b10000;  // r1 (extended; FDF position)
  localparam logic [4:0] FldR0      = 5'b10001;  // r0 (base: FDF position)
  localparam logic [4:0] FldDlc     = 5'b10010;  // DLC3..DLC0
  localparam logic [4:0] FldData    = 5'b10011;  // 8 bits a byte
  localparam logic [4:0] FldCrc     = 5'b10100;  // CRC14..CRC0
  // 11xxx: fixed form, flags and delimiters.
  localparam logic [4:0] FldCrcDel  = 5'b11000;  // CRC delimiter, after a last stuff bit (ST-03)
  localparam logic [4:0] FldAck     = 5'b11001;  // ACK slot
  localparam logic [4:0] FldAckDel  = 5'b11010;  // ACK delimiter
  localparam logic [4:0] FldEof     = 5'b11011;  // EOF1..EOF7
  localparam logic [4:0] FldErrFlag = 5'b11100;  // active or passive error flag (EF-01, EF-02)
  localparam logic [4:0] FldWait    = 5'b11101;  // after a flag, until a recessive bit (EF-08)
  localparam logic [4:0] FldDel     = 5'b11110;  // DEL2..DEL8 of error or overload delimiter
  localparam logic [4:0] FldOvlFlag = 5'b11111;  // overload flag (OV-01)

  // Error kinds: bits of a pulse of one clock, in the order of ESR1[15:10] (flexcan.md 1.4).
  localparam int ErrBit1  = 5;  // sent recessive, saw dominant
  localparam int ErrBit0  = 4;  // sent dominant, saw recessive
  localparam int ErrAck   = 3;  // no dominant level in the ACK slot
  localparam int ErrCrc   = 2;  // CRC mismatch (receiver)
  localparam int ErrForm  = 1;  // fixed-form bit wrong
  localparam int ErrStuff = 0;  // sixth equal bit

  // Layout of can_core.trace_o for observers, decoded by sim/bus/trace.hpp; unconnected in
  // synthesis.
  // While `sample` is 1 all other level and position fields describe the bit that is being sampled;
  // `err`, `rx_valid`, `tx_ok`, `tx_fail`, `start` are pulses in the clock after their sample;
  // `tec`, `rec` and `passive` follow one clock later.
  //   [48]    sample     sample point in this clock
  //   [47]    boundary   last clock of the bit: the next TX level is taken over
  //   [46]    rx         level as sampled (majority if triple sampling)
  //   [45]    tx         level this node sends in the current bit (before LOM/LPB gate the pin)
  //   [44]    role       1: transmitter (RO-01)
  //   [43]    stuff      the current bit is a stuff bit
  //   [42:38] field      Fld*
  //   [37:32] left       bits of the field that follow the current one
  //   [31:26] err        Err* pulse
  //   [25]    rx_valid   frame valid for receivers, SP of EOF6 (VA-01); also pulses for own frames
  //   [24]    tx_ok      frame sent, SP of EOF7 (VA-02)
  //   [23]    tx_fail    transmission ended by error or lost arbitration
  //   [22]    start      a frame begins: the next bit is ID28
  //   [21]    passive    error passive (FC-11)
  //   [20]    running    the node takes part (not frozen)
  //   [19:17] reserved   0
  //   [16:8]  tec        bit 16 = bus-off; then tec[7:0] counts recovery sequences (FC-13)
  //   [7:0]   rec
  localparam int TraceWidth = 49;

  // Commands of the time unit (can_time), pulses. TimeSet, TimeShift and TimeRate use both words of
  // the data, TimeSlew and TimeArm the upper one.
  localparam int TimeSet     = 0;  // set the clock (TIMEHI)
  localparam int TimeShift   = 1;  // add an offset to the clock (TSHHI)
  localparam int TimeRate    = 2;  // set the increment (TINCF)
  localparam int TimeSlew    = 3;  // work off an offset in small steps (TSLEW)
  localparam int TimeArm     = 4;  // arm the compare unit (TCMP)
  localparam int TimeHold    = 5;  // TTXMB.HOLD := 1
  localparam int TimeRelease = 6;  // TTXMB.HOLD := 0
  localparam int TimeExt     = 7;  // capture TIME for the external event
  localparam int TimeRead    = 8;  // capture TIME for a read
  localparam int TimeCmdWidth = 9;
  // Status of the time unit: levels, and pulses that set flags of TSTAT.
  localparam int TimeStatSlewing = 0;
  localparam int TimeStatHeld    = 1;
  localparam int TimeStatOut     = 2;
  localparam int TimeStatArmed   = 3;
  localparam int TimeStatMatch   = 4;  // pulse
  localparam int TimeStatSlewed  = 5;  // pulse
  localparam int TimeStatLaunch  = 6;  // pulse
  localparam int TimeStatSync    = 7;  // pulse
  localparam int TimeStatWidth   = 8;
endpackage
