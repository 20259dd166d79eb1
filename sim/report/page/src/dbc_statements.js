// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The statements of a DBC file, each on one line and in the one form that the parser of candied
// reads: it takes a file line by line, wants single blanks and decimals, and passes over what it
// does not know. Here nothing is lost in silence.

/** Something in the file cannot be used; `line` counts from 1, 0: no line can be named. */
export class DbcError extends Error {
  constructor(line, message) {
    super(line > 0 ? `line ${line}: ${message}` : message);
    this.line = line;
  }
}

/** What messages and signals are made of, in the form that a refusal shows. */
export const kForms = {
  BO_: 'BO_ <id> <name>: <bytes> <sender>',
  SG_:
    'SG_ <name> [M, m<n> or m<n>M] : <start>|<length>@<0 or 1><+ or -> (<factor>,<offset>) ' +
    '[<minimum>|<maximum>] "<unit>" <receivers>',
  VAL_: 'VAL_ <id> <signal> <value> "<text>" ... ;',
  SIG_VALTYPE_: 'SIG_VALTYPE_ <id> <signal> : <0, 1 or 2> ;',
  SG_MUL_VAL_: 'SG_MUL_VAL_ <id> <signal> <multiplexer> <first>-<last>, ... ;',
  BA_DEF_: 'BA_DEF_ [BO_ or SG_] "<name>" <type> ... ;',
  BA_DEF_DEF_: 'BA_DEF_DEF_ "<name>" <value> ;',
  BA_: 'BA_ "<name>" [BO_ <id> or SG_ <id> <signal>] <value> ;',
};
const kIgnored = new Set(
  (
    'VERSION NS_ NS_DESC_ BS_ BU_ BO_TX_BU_ CM_ VAL_TABLE_ EV_ EV_DATA_ ENVVAR_DATA_ SGTYPE_ ' +
    'SGTYPE_VAL_ SIGTYPE_VALTYPE_ SIG_TYPE_REF_ SIG_GROUP_ CAT_DEF_ CAT_ FILTER BA_DEF_REL_ ' +
    'BA_REL_ BA_DEF_DEF_REL_ BU_SG_REL_ BU_EV_REL_ BU_BO_REL_ BA_DEF_SGTYPE_ BA_SGTYPE_'
  ).split(' '),
);
const kByLine = new Set(['VERSION', 'NS_', 'BS_', 'BO_', 'SG_']); // end with their line
const kAttributes = new Set([
  'VFrameFormat',
  'ProtocolType',
  'SystemMessageLongSymbol',
  'SystemSignalLongSymbol',
]);
const kString = /"(?:\\.|[^"\\])*"/gs;

function keywordOf(line) {
  const word = /^[A-Z][A-Z_]*(?=[\s:"]|$)/.exec(line)?.[0];
  return word in kForms || kIgnored.has(word) ? word : null;
}

/** Cuts a text into statements {line, keyword, text}. */
class Splitter {
  constructor() {
    this.statements = [];
    this.now = null;
    this.open = false; // a string has begun and not ended
  }

  /** Whether a statement begins here; the list of NS_ names keywords of its own. */
  #begins(line) {
    const names = this.now?.keyword === 'NS_' || this.names;
    return keywordOf(line) && !(names && /^[A-Z_]+$/.test(line));
  }

  take(line, number) {
    if (this.now && !this.open && this.#begins(line)) this.end();
    if (!this.now) {
      if (!this.#begins(line)) {
        if (line && !line.startsWith('//') && !this.names)
          throw new DbcError(number, `unknown statement: ${line.slice(0, 60)}`);
        return;
      }
      this.now = {line: number, keyword: keywordOf(line), text: ''};
      this.names = this.now.keyword === 'NS_';
    }
    const {now} = this;
    now.text += now.text ? ` ${line}` : line;
    const rest = now.text.replace(kString, '""');
    this.open = rest.replaceAll('""', '').includes('"');
    if (!this.open && this.#complete(rest)) this.end();
  }

  #complete(rest) {
    if (this.now.keyword === 'SG_') return rest.includes('"'); // its unit
    return kByLine.has(this.now.keyword) || rest.trimEnd().endsWith(';');
  }

  end() {
    if (!this.now) return;
    if (this.open) throw new DbcError(this.now.line, 'a string that begins here has no end');
    this.statements.push(this.now);
    this.now = null;
  }
}

/** "1.5E-05" without exponent and sign of plus: "0.000015", digit by digit. */
export function plainNumber(text) {
  const [, sign, whole, part = '', power = '0'] =
    /^([+-]?)(\d*)\.?(\d*)(?:[eE]([+-]?\d+))?$/.exec(text) ?? [];
  if (whole === undefined || (whole === '' && part === '')) return text;
  const shift = Number(power);
  if (Math.abs(shift) > 2000) return text;
  const digits = '0'.repeat(Math.max(0, -shift)) + whole;
  const more = part + '0'.repeat(Math.max(0, shift));
  const all = digits + more;
  const point = digits.length + shift;
  const [a, b] = [all.slice(0, point).replace(/^0+(?=\d)/, '') || '0', all.slice(point)];
  const kept = shift > 0 ? b.slice(0, Math.max(0, part.length - shift)) : b;
  return `${sign === '-' ? '-' : ''}${a}${kept ? `.${kept}` : ''}`;
}

const kNumber = '([+-]?[\\d.]+(?:[eE][+-]?\\d+)?)';
const kSignal = new RegExp(
  `^SG_ (\\w+) ?(M|m\\d+M?|) ?: ?(\\d+) ?\\| ?(\\d+) ?@ ?([01]) ?([+-])` +
  ` ?\\( ?${kNumber} ?, ?${kNumber} ?\\)` +
    ` ?\\[ ?${kNumber} ?\\| ?${kNumber} ?\\] ?("\\d+") ?(.*)$`,
);

/** SG_ with the blanks and decimals that candied wants; as it is if it is something else. */
function signalLine(text) {
  const match = kSignal.exec(text);
  if (!match) return text;
  const [, name, mux, start, length, order, sign, ...rest] = match;
  const [factor, offset, least, most] = rest.slice(0, 4).map(plainNumber);
  const nodes = rest[5] || 'Vector__XXX';
  return (
    `SG_ ${name} ${mux && `${mux} `}: ${start}|${length}@${order}${sign} ` +
    `(${factor},${offset}) [${least}|${most}] ${rest[4]} ${nodes}`
  );
}

/** One blank between words; strings by their number in `strings`, so that they hold anything. */
function canonical({line, keyword, text}) {
  const strings = [];
  const keep = keyword.startsWith('BA_'); // names and values that are of use here are plain words
  const numbered = text.replace(kString, (string) => {
    if (keep) return string;
    strings.push(string.slice(1, -1).replace(/\\(["\\])/g, '$1'));
    return `"${strings.length - 1}"`;
  });
  const single = numbered.replace(/\s+/g, ' ').trim();
  if (keyword === 'SG_') return {line, keyword, text: signalLine(single), strings};
  const tight = single.replace(/ ?; ?$/, '').replace(/^BO_ (\d+) (\w+) ?: ?/, 'BO_ $1 $2: ');
  return {line, keyword, text: keyword === 'BO_' ? tight : `${tight} ;`, strings};
}

/** The keyword of a statement that matters and stands in the line of another one, or undefined. */
function followerOf({keyword, text}) {
  if (keyword === 'NS_') return undefined;
  const rest = text.replace(kString, '');
  const words = kByLine.has(keyword)
    ? rest.split(/[\s:;]+/).slice(1)
    : rest.split(';').slice(1).map((part) => keywordOf(part.trim()));
  return words.find((word) => Object.hasOwn(kForms, word));
}

function refuseFollowers(statement) {
  const follower = followerOf(statement);
  if (follower)
    throw new DbcError(
      statement.line,
      `${follower} follows ${statement.keyword} in one line; allowed: one statement in a line`,
    );
}

/** A signal belongs to the message that it stands behind, and to nothing else. */
function refusePlace({line, keyword, text}, before) {
  if (keyword !== 'SG_' || before === 'BO_' || before === 'SG_') return;
  const name = /^SG_\s*([^\s:;"]*)/.exec(text)[1];
  const place = before ? `behind ${before}` : 'before any message';
  throw new DbcError(
    line,
    `signal ${name} stands ${place}; allowed: behind its message and the signals of that`,
  );
}

/** In their order: each may stand where it does. */
function checkPlaces(statements) {
  let before = null;
  for (const statement of statements) {
    refuseFollowers(statement);
    if (!Object.hasOwn(kForms, statement.keyword)) continue;
    refusePlace(statement, before);
    before = statement.keyword;
  }
}

const kZero = /:\s*0\s*;?\s*$/; // SIG_VALTYPE_ of an integer

function relevant({keyword, text}) {
  if (!(keyword in kForms)) return false;
  if (keyword.startsWith('BA_')) return kAttributes.has(/"([^"]*)"/.exec(text)?.[1]);
  return keyword !== 'SIG_VALTYPE_' || !kZero.test(text);
}

/**
 * The statements about frames: [{line, keyword, text, strings}].
 * @throws DbcError for what is no statement, or has no end
 */
export function statementsOf(text) {
  const splitter = new Splitter();
  text
    .replace(/^\uFEFF/, '')
    .split(/\r\n|\r|\n/)
    .forEach((line, i) => splitter.take(line.trim(), i + 1));
  splitter.end();
  checkPlaces(splitter.statements);
  return splitter.statements.filter(relevant).map(canonical);
}
