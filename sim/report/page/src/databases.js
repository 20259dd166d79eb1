// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The DBC files of the page, those in the report and those that were opened, and the message that
// belongs to a frame.
import {parseDbc} from './dbc.js';
import {DbcError} from './dbc_statements.js';
import {hex} from './format.js';

const kExtended = 0x80000000;

/** Parameter group of an extended identifier of J1939: without priority and source address and,
 *  where bits 16 to 23 are below 240, without the destination address. */
export const parameterGroup = (id) => (id >>> 8) & (((id >>> 16) & 0xff) < 240 ? 0x3ff00 : 0x3ffff);

export class Databases extends EventTarget {
  constructor() {
    super();
    this.files = []; // {name, messages}
    this.#index();
  }

  get count() {
    return this.files.length;
  }

  #index() {
    this.byKey = new Map();
    this.byGroup = new Map();
    this.known = new Map();
    for (const {messages} of this.files) {
      for (const message of messages) {
        this.byKey.set(message.key, message);
        if (!message.j1939) continue;
        const group = parameterGroup(message.id);
        this.byGroup.set(group, [...(this.byGroup.get(group) ?? []), message]);
      }
    }
  }

  /**
   * Adds a file; one of the same name is replaced.
   * @throws DbcError: it cannot be used, or an identifier has a message in another file
   */
  add(name, text) {
    const messages = parseDbc(text);
    const others = this.files.filter((file) => file.name !== name);
    for (const message of messages) {
      message.file = name;
      for (const file of others) {
        const same = file.messages.find(({key}) => key === message.key);
        if (!same) continue;
        const id = hex(message.id, message.extended ? 8 : 3);
        throw new DbcError(
          message.line,
          `message ${message.name} has the identifier ${id} of ${same.name} in ${file.name}; ` +
            'allowed: one message for an identifier',
        );
      }
    }
    this.files = [...others, {name, messages}];
    this.#changed();
  }

  remove(name) {
    this.files = this.files.filter((file) => file.name !== name);
    this.#changed();
  }

  #changed() {
    this.#index();
    this.dispatchEvent(new Event('change'));
  }

  get messages() {
    return this.files.flatMap(({messages}) => messages);
  }

  /** The message with this very identifier, else of its J1939 group, of its source if possible. */
  find(id, extended) {
    const key = id + (extended ? kExtended : 0);
    let message = this.known.get(key);
    if (message === undefined) {
      const group = extended ? (this.byGroup.get(parameterGroup(id)) ?? []) : [];
      const source = group.find((other) => other.id % 256 === id % 256);
      message = this.byKey.get(key) ?? source ?? group[0] ?? null;
      this.known.set(key, message);
    }
    return message;
  }
}
