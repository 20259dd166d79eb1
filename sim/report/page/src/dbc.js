// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// A DBC file as messages with signals. candied parses the statements; what it does not understand,
// and what no frame can hold, is refused with its line.
import {ASTKinds, Parser} from 'candied/lib/parser/parser';
import {
  choicesProblem,
  frameFormatProblem,
  messageProblem,
  rangesProblem,
  selectionProblem,
  signalProblem,
  valueTypeProblem,
} from './dbc_checks.js';
import {DbcError, kForms, statementsOf} from './dbc_statements.js';
import {exact} from './signal_codec.js';

const kExtended = 0x80000000;
const kIndependent = new Set([0x40000000, 0xc0000000]); // holds the signals of no message
const kKinds = {
  [ASTKinds.CanMessage]: 'BO_',
  [ASTKinds.CanSignal]: 'SG_',
  [ASTKinds.Val]: 'VAL_',
  [ASTKinds.SigValType]: 'SIG_VALTYPE_',
  [ASTKinds.SignalMultiplexVal]: 'SG_MUL_VAL_',
  [ASTKinds.GlobalAttribute]: 'BA_DEF_',
  [ASTKinds.MessageAttribute]: 'BA_DEF_',
  [ASTKinds.SignalAttribute]: 'BA_DEF_',
  [ASTKinds.AttributeDefault]: 'BA_DEF_DEF_',
  [ASTKinds.AttributeValue]: 'BA_',
};

/** Whole statements of which candied passes over parts. */
const kWhole = {
  SG_: /^SG_ \w+ (?:M |m\d+M? )?: \d+\|\d+@[01][+-] \([^()]*\) \[[^\]]*\] "\d+" .*$/,
  VAL_: /^VAL_ (?:\D.*|\d+ \w+(?: ?-?(?:\d+|0x[0-9a-f]+) ?"\d+")*(?: -?\d+)? ?;)$/i,
  SG_MUL_VAL_: /^SG_MUL_VAL_ \d+ \w+ \w+ \d+ ?- ?\d+(?: ?, ?\d+ ?- ?\d+)* ?;$/,
};

/** What candied makes of a statement. */
function parsed({line, keyword, text, strings}) {
  const {ast, errs} = new Parser(text).parse();
  const whole = kWhole[keyword]?.test(text) ?? true;
  if (!ast || errs?.length || !whole || kKinds[ast.kind] !== keyword) {
    const shown = text.replace(/"(\d+)"/g, (whole, n) => `"${strings[n] ?? n}"`);
    throw new DbcError(line, `not understood: ${shown.slice(0, 120)}; allowed: ${kForms[keyword]}`);
  }
  return ast;
}

/** An identifier with bit 31 where it is extended; many files leave the bit out above 7FF. */
const keyOf = (id) =>
  id <= 0x7ff || id >= kExtended || kIndependent.has(id) ? id : id + kExtended;

function refuse(line, problem) {
  if (problem) throw new DbcError(line, problem);
}

const decimalsOf = (text) => text.split('.')[1]?.length ?? 0;

/** Bits from the most significant one on: 8 * byte + weight in it. */
function placesOf(start, length, littleEndian) {
  if (littleEndian) return Array.from({length}, (_, i) => start + length - 1 - i);
  const places = [start];
  while (places.length < length) {
    const place = places.at(-1);
    places.push(place % 8 === 0 ? place + 15 : place - 1);
  }
  return places;
}

function signalOf(ast, line, strings) {
  const littleEndian = ast.endian === 'Intel';
  const places = ast.length <= 64 ? placesOf(ast.start_bit, ast.length, littleEndian) : [];
  return {
    name: ast.name,
    line,
    start: ast.start_bit,
    length: ast.length,
    littleEndian,
    signed: ast.signed,
    float: false,
    factor: ast.factor,
    offset: ast.offset,
    decimals: Math.max(decimalsOf(ast.raw_factor), decimalsOf(ast.raw_offset)),
    minimum: ast.min < ast.max ? ast.min : -Infinity, // [0|0] stands for no limits
    maximum: ast.min < ast.max ? ast.max : Infinity,
    unit: strings[Number(ast.unit)] ?? '',
    choices: new Map(),
    multiplexer: ast.multiplex.endsWith('M'),
    value: /^m(\d+)/.exec(ast.multiplex)?.[1] ?? null,
    nested: /^m\d+M$/.test(ast.multiplex),
    selection: null, // {multiplexer: signal, ranges: [[first, last]]}: when it is there
    places,
    bytes: Math.max(-1, ...places) / 8 + 1, // that a frame needs to hold it, when rounded down
  };
}

/** Collects messages from statements. */
class Reader {
  constructor() {
    this.messages = new Map(); // by key
    this.message = null;
    this.formats = []; // names of VFrameFormat's values
    this.attributes = {};
  }

  take(statement) {
    const ast = parsed(statement);
    const {line, strings, keyword, text} = statement;
    if (keyword === 'BO_') this.#addMessage(ast, line, text);
    else if (keyword === 'SG_') this.#addSignal(ast, line, strings);
    else if (keyword === 'VAL_') this.#addChoices(ast, statement);
    else if (keyword === 'SIG_VALTYPE_') this.#setFloat(ast, statement);
    else if (keyword === 'SG_MUL_VAL_') this.#setSelection(ast, line);
    else this.#attribute(ast, statement);
  }

  #addMessage({id, name}, line, text) {
    const length = Number(/: (\d+)/.exec(text)[1]);
    if (!kIndependent.has(id)) refuse(line, messageProblem(name, id, length));
    const key = keyOf(id);
    const known = this.messages.get(key);
    if (known && !kIndependent.has(key))
      throw new DbcError(line, `message ${id} is there twice; first in line ${known.line}`);
    this.message = {
      name,
      key,
      id: key % kExtended,
      extended: key >= kExtended,
      length,
      j1939: false,
      signals: [],
      line,
    };
    this.messages.set(key, this.message);
  }

  #addSignal(ast, line, strings) {
    const known = this.message.signals.find(({name}) => name === ast.name);
    if (known && !kIndependent.has(this.message.key))
      throw new DbcError(line, `signal ${ast.name} is there twice; first in line ${known.line}`);
    const signal = signalOf(ast, line, strings);
    refuse(line, selectionProblem(signal.name, signal.value));
    this.message.signals.push(signal);
  }

  #find(id, name) {
    return this.messages.get(keyOf(id))?.signals.find((signal) => signal.name === name);
  }

  // The values as they stand: candied's are floating-point numbers.
  #addChoices({id, name}, {line, text, strings}) {
    const pairs = [...text.matchAll(/[\s"](-?\d+|0x[0-9a-f]+) ?"(\d+)"/gi)];
    const values = pairs.map(([, value]) => value);
    refuse(line, choicesProblem(name, values));
    const choices = this.#find(id, name)?.choices ?? new Map();
    for (const [, value, number] of pairs) {
      const [raw, choice] = [exact(value), strings[Number(number)]];
      if ((choices.get(raw) ?? choice) !== choice)
        throw new DbcError(line, `value ${value} of signal ${name} has another text already`);
      choices.set(raw, choice);
    }
  }

  #setFloat({id, name}, {line, text}) {
    const signal = this.#find(id, name);
    if (!signal) return;
    refuse(line, valueTypeProblem(signal, /: ?(\d)/.exec(text)[1]));
    signal.float = true;
  }

  #setSelection({id, name, switch_name: by, value_ranges: ranges}, line) {
    const signal = this.#find(id, name);
    if (!signal) return;
    const multiplexer = this.#find(id, by);
    if (!multiplexer?.multiplexer)
      throw new DbcError(
        line,
        `signal ${name} is multiplexed by ${by}, which is no multiplexer (M) of the message`,
      );
    const before = signal.selection?.multiplexer ?? multiplexer;
    if (before !== multiplexer)
      throw new DbcError(
        line,
        `signal ${name} is multiplexed by ${before.name} already; allowed: one multiplexer for a ` +
          'signal',
      );
    refuse(line, rangesProblem(name, ranges));
    const more = ranges.map((range) => range.map(exact));
    signal.selection = {multiplexer, ranges: [...(signal.selection?.ranges ?? []), ...more]};
  }

  #attribute(ast, {line, keyword, text}) {
    const {name} = ast;
    if (keyword === 'BA_DEF_') {
      if (name === 'VFrameFormat' && ast.enum?.length) this.formats = ast.enum;
    } else if (keyword === 'BA_DEF_DEF_') {
      this.attributes[name] ??= ast.value;
    } else if (name === 'ProtocolType') {
      this.attributes[name] = ast.value;
    } else {
      const message = this.messages.get(keyOf(ast.id));
      if (name === 'VFrameFormat' && message) {
        refuse(line, frameFormatProblem(/(\S+) ;$/.exec(text)[1], this.formats));
        message.format = ast.value;
      }
      if (name === 'SystemMessageLongSymbol' && message) message.long = ast.value;
      const signal = name === 'SystemSignalLongSymbol' && this.#find(ast.id, ast.signal);
      if (signal) signal.long = ast.value;
    }
  }

  /** A message that stands for its parameter group, whatever priority and addresses. */
  #isJ1939({extended, format = this.attributes.VFrameFormat}) {
    if (!extended) return false;
    if (format === undefined) return (this.attributes.ProtocolType ?? '').includes('J1939');
    const names = this.formats.length > 0 ? this.formats : ['', '', '', 'J1939PG'];
    return (names[Number(format)] ?? format) === 'J1939PG' || format === 'J1939PG';
  }

  finish() {
    const list = [...this.messages.values()].filter(({key}) => !kIndependent.has(key));
    if (list.length === 0)
      throw new DbcError(0, 'no message in it; allowed: a DBC file with BO_ and SG_');
    for (const message of list) {
      message.j1939 = this.#isJ1939(message);
      for (const signal of message.signals) select(signal, message);
      for (const signal of message.signals) check(signal, message);
      message.name = message.long || message.name;
      for (const signal of message.signals) signal.name = signal.long || signal.name;
    }
    return list;
  }
}

/** What must be in which signal for a multiplexed one to be there. */
function select(signal, message) {
  if (signal.value === null || signal.selection) return;
  if (signal.nested)
    throw new DbcError(
      signal.line,
      `signal ${signal.name} is multiplexed and a multiplexer, which needs a statement SG_MUL_VAL_`,
    );
  const [multiplexer, another] = message.signals.filter((other) => other.multiplexer);
  if (!multiplexer || another)
    throw new DbcError(
      signal.line,
      `signal ${signal.name} is multiplexed, but the message has no or more than one multiplexer ` +
        '(M); allowed: one, or SG_MUL_VAL_ for each signal',
    );
  const value = exact(signal.value);
  signal.selection = {multiplexer, ranges: [[value, value]]};
}

/** What is wrong with a signal; null: nothing. */
function problemOf(signal, message) {
  const problem = signalProblem(signal, message);
  if (problem) return problem;
  const seen = new Set();
  for (let at = signal; at; at = at.selection?.multiplexer) {
    if (seen.has(at)) return 'is multiplexed by itself';
    seen.add(at);
  }
  return null;
}

function check(signal, message) {
  signal.bytes = Math.floor(signal.bytes);
  const problem = problemOf(signal, message);
  if (problem) throw new DbcError(signal.line, `signal ${signal.name} ${problem}`);
}

/**
 * The messages of a DBC file.
 * @throws DbcError in words for people
 */
export function parseDbc(text) {
  const reader = new Reader();
  for (const statement of statementsOf(text)) reader.take(statement);
  return reader.finish();
}
