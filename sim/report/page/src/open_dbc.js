// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// DBC files for the page: those of the report, a button, and files that are dropped onto it.
import {DbcError} from './dbc_statements.js';
import {el} from './dom.js';

const kMost = 32 << 20; // bytes

/** UTF-8, or the code page of Western Windows, which CANdb++ writes. */
function textOf(buffer) {
  try {
    return new TextDecoder('utf-8', {fatal: true}).decode(buffer);
  } catch {
    return new TextDecoder('windows-1252').decode(buffer);
  }
}

/** Opens files and says what could not be used. */
export class DbcOpener {
  constructor(databases) {
    this.databases = databases;
    this.text = el('span', {});
    const closing = {type: 'button', title: 'Close', onclick: () => this.quiet()};
    const close = el('button', closing, '✕');
    this.alert = el('div', {class: 'alert', role: 'alert', hidden: true}, this.text, close);
    this.input = el('input', {
      type: 'file',
      accept: '.dbc',
      multiple: true,
      hidden: true,
      'aria-label': 'DBC files',
      onchange: async () => {
        await this.open([...this.input.files]);
        this.input.value = ''; // so that the same file can be opened again
      },
    });
  }

  quiet() {
    this.alert.hidden = true;
  }

  #say(problems) {
    this.alert.hidden = problems.length === 0;
    this.text.textContent = problems.join(' · ');
  }

  /** Adds a text; the problem in words, or null. */
  #add(name, text) {
    try {
      this.databases.add(name, text);
      return null;
    } catch (error) {
      const reason =
        error instanceof DbcError ? error.message : `a mistake in the page: ${error.message}`;
      return `${name} cannot be used: ${reason}`;
    }
  }

  /** The databases of the report: [{name, text}]. */
  embedded(list) {
    this.#say(list.map(({name, text}) => this.#add(name, text)).filter(Boolean));
  }

  /** @param files of an input or of a drop */
  async open(files) {
    const problems = [];
    for (const file of files) {
      if (file.size > kMost) {
        problems.push(`${file.name} cannot be used: ${file.size} bytes; allowed: ${kMost}`);
        continue;
      }
      try {
        problems.push(this.#add(file.name, textOf(await file.arrayBuffer())));
      } catch (error) {
        problems.push(`${file.name} cannot be read: ${error.message}`);
      }
    }
    this.#say(problems.filter(Boolean));
  }

  /** Takes files that are dropped anywhere. */
  attach(host) {
    const mark = (on) => host.classList.toggle('dropping', on);
    const files = (event) => [...(event.dataTransfer?.types ?? [])].includes('Files');
    host.addEventListener('dragover', (event) => {
      if (!files(event)) return;
      event.preventDefault();
      mark(true);
    });
    host.addEventListener('dragleave', (event) => {
      if (!event.relatedTarget) mark(false);
    });
    host.addEventListener('drop', (event) => {
      if (!files(event)) return;
      event.preventDefault();
      mark(false);
      this.open([...event.dataTransfer.files]);
    });
  }
}
