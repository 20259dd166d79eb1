// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// DBC files that are refused: what is wrong with each, its text, and what the page says.

const signal = 'BO_ 1 A: 8 X\n SG_ S : 0|8@1+ (1,0) [0|0] "" X\n';
const selected =
  'BO_ 1 A: 8 X\n SG_ M M : 0|8@1+ (1,0) [0|0] "" X\n' +
  ' SG_ S m1 : 8|8@1+ (1,0) [0|0] "" X\n';

export const bad = {
  'no DBC': ['hello\n', /x\.dbc cannot be used: line 1: unknown statement: hello/],
  empty: ['', /x\.dbc cannot be used: no message in it; allowed: a DBC file with BO_ and SG_/],
  'bytes of a picture': ['\x89PNG\r\n\x1a\n\0\0', /line 1: unknown statement/],
  'a signal without its length': [
    'BO_ 1 A: 8 X\n SG_ S : 0@1+ (1,0) [0|0] "" X\n',
    /line 2: not understood: SG_ S : 0@1\+ .*allowed: SG_ <name>/,
  ],
  'a string without an end': [
    'BO_ 1 A: 8 X\n\nCM_ BO_ 1 "open\n\n',
    /line 3: a string that begins here has no end/,
  ],
  'a signal that does not fit': [
    'BO_ 1 A: 2 X\n SG_ S : 9|8@1+ (1,0) [0|0] "" X\n',
    /line 2: signal S does not fit the 2 bytes of message A: it needs 3/,
  ],
  'a big-endian signal that does not fit': [
    'BO_ 1 A: 1 X\n SG_ S : 3|8@0+ (1,0) [0|0] "" X\n',
    /line 2: signal S does not fit the 1 bytes of message A: it needs 2/,
  ],
  'a value with two texts': [
    'BO_ 1 A: 8 X\n SG_ S : 0|8@1+ (1,0) [0|0] "" X\nVAL_ 1 S 7 "x" 128 "y" 7 "z" ;\n',
    /line 3: value 7 of signal S is there twice/,
  ],
  'a message twice': [
    'BO_ 1 A: 8 X\nBO_ 1 B: 8 X\n',
    /line 2: message 1 is there twice; first in line 1/,
  ],
  'an identifier of 31 bits': [
    'BO_ 1073741823 A: 8 X\n',
    /line 1: message A has the identifier 1073741823; allowed: 0 to 2047/,
  ],
  'a multiplexed signal without a multiplexer': [
    'BO_ 1 A: 8 X\n SG_ S m1 : 0|8@1+ (1,0) [0|0] "" X\n',
    /line 2: signal S is multiplexed, but the message has no or more than one multiplexer/,
  ],
  'a short float': [
    'BO_ 1 A: 8 X\n SG_ S : 0|16@1- (1,0) [0|0] "" X\nSIG_VALTYPE_ 1 S : 1;\n',
    /line 3: signal S is a floating-point number of 16 bits; allowed with value type 1: 32/,
  ],
  'an identifier of 31 bits with the flag of 29': [
    'BO_ 3758096675 A: 8 X\n',
    /line 1: message A has the identifier 3758096675; allowed: 0 to 2047/,
  ],
  'an identifier of 33 bits': [
    'BO_ 4294967587 A: 8 X\n',
    /line 1: message A has the identifier 4294967587; allowed: 0 to 2047/,
  ],
  'a message of a gigabyte': [
    'BO_ 1 A: 1000000000 X\n',
    /line 1: message A has 1000000000 bytes; allowed: 0 to 117440505/,
  ],
  'a signal in the line of its message': [
    'BO_ 1 A: 8 X SG_ S : 0|8@1+ (1,0) [0|0] "" X\n',
    /line 1: SG_ follows BO_ in one line; allowed: one statement in a line/,
  ],
  'two signals in a line': [
    `${signal.trimEnd()} SG_ T : 8|8@1+ (1,0) [0|0] "" X\n`,
    /line 2: SG_ follows SG_ in one line/,
  ],
  'two statements in a line': [
    `${signal}VAL_ 1 S 1 "a;b" ; VAL_ 1 S 2 "c" ;\n`,
    /line 3: VAL_ follows VAL_ in one line/,
  ],
  'a message behind a comment': [
    'CM_ "x" ; BO_ 1 A: 8 X\n SG_ S : 0|8@1+ (1,0) [0|0] "" X\n',
    /line 1: BO_ follows CM_ in one line/,
  ],
  'a signal before any message': [
    ' SG_ S : 0|8@1+ (1,0) [0|0] "" X\nBO_ 1 A: 8 X\n',
    /line 1: signal S stands before any message; allowed: behind its message and the signals of/,
  ],
  'a signal behind choices, which are of another message': [
    `${signal}BO_ 2 B: 8 X\nVAL_ 1 S 1 "a" ;\n SG_ T : 8|8@1+ (1,0) [0|0] "" X\n`,
    /line 5: signal T stands behind VAL_; allowed: behind its message and the signals of that/,
  ],
  'a multiplexer that is neither M nor m': [
    selected.replace('m1', '0m1'),
    /line 3: not understood: SG_ S 0m1 :/,
  ],
  'choices of which one has no beginning': [
    `${signal}VAL_ 1 S 0 "a" 1 "b" 2 c" 3 "d" 4 "e;\n`,
    /line 3: not understood: VAL_ 1 S/,
  ],
  'choices without a blank behind the identifier': [
    `${signal}VAL_ 1S 0 "a" ;\n`,
    /line 3: not understood: VAL_ 1S/,
  ],
  'a value type of no signal': [
    `${signal}SIG_VALTYPE_ 1 : 1;\n`,
    /line 3: not understood: SIG_VALTYPE_ 1 : 1/,
  ],
  'a value type behind a semicolon': [
    'BO_ 1 A: 8 X\n SG_ S : 0|32@1- (1,0) [0|0] "" X\nSIG_VALTYPE_ 1 S : ;1;\n',
    /line 3: not understood: SIG_VALTYPE_ 1 S : ;1/,
  ],
  'a range without an end': [
    `${selected}SG_MUL_VAL_ 1 S M 46, 8-8;\n`,
    /line 4: not understood: SG_MUL_VAL_ 1 S M 46/,
  ],
  'a value of 80 bits': [
    `${signal}VAL_ 1 S 1208925819614629174706176 "x" ;\n`,
    /line 3: value 1208925819614629174706176 of signal S is none of 64 bits; allowed: -92233/,
  ],
  'a value with two texts in two statements': [
    `${signal}VAL_ 1 S 1 "a" ;\nVAL_ 1 S 1 "b" ;\n`,
    /line 4: value 1 of signal S has another text already/,
  ],
  'a float of 64 bits that is told as one of 32': [
    'BO_ 1 A: 8 X\n SG_ S : 0|64@1- (1,0) [0|0] "" X\nSIG_VALTYPE_ 1 S : 1;\n',
    /line 3: signal S is a floating-point number of 64 bits; allowed with value type 1: 32/,
  ],
  'a float of 32 bits that is told as one of 64': [
    'BO_ 1 A: 8 X\n SG_ S : 0|32@1- (1,0) [0|0] "" X\nSIG_VALTYPE_ 1 S : 2;\n',
    /line 3: signal S is a floating-point number of 32 bits; allowed with value type 2: 64/,
  ],
  'a range that goes down': [
    `${selected}SG_MUL_VAL_ 1 S M 3-1;\n`,
    /line 4: signal S has the range 3-1; allowed: from the smaller to the larger value/,
  ],
  'a signal with two multiplexers': [
    `${selected} SG_ N M : 16|8@1+ (1,0) [0|0] "" X\nSG_MUL_VAL_ 1 S M 1-1;\n` +
      'SG_MUL_VAL_ 1 S N 2-2;\n',
    /line 6: signal S is multiplexed by M already; allowed: one multiplexer for a signal/,
  ],
  'a selection of 67 bits': [
    selected.replace('m1', 'm99999999999999999999'),
    /line 3: signal S has the selection m99999999999999999999; allowed: m0 to m184467440737095516/,
  ],
  'a factor that is infinite': [
    signal.replace('(1,', '(1E999,'),
    /line 2: signal S has the factor Infinity; allowed: a number that is not infinite/,
  ],
  'an offset that is infinite': [
    signal.replace(',0)', ',1E400)'),
    /line 2: signal S has the offset Infinity; allowed: a number that is not infinite/,
  ],
  'a frame format that the file does not name': [
    `BA_DEF_ BO_ "VFrameFormat" ENUM "a","b";\n${signal}BA_ "VFrameFormat" BO_ 1 2;\n`,
    /line 4: VFrameFormat 2 is not allowed; allowed: the numbers 0 to 1/,
  ],
};
