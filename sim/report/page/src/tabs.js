// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The tabs below the scope.
import {el} from './dom.js';

export class Tabs {
  /** @param entries [{id, name, title, root, shown()}]; shown: called when it comes into sight */
  constructor(entries) {
    this.entries = entries;
    this.buttons = entries.map(({id, name, title}, i) =>
      el(
        'button',
        {
          type: 'button',
          role: 'tab',
          id: `tab-${id}`,
          title,
          'aria-controls': `panel-${id}`,
          onclick: () => this.show(id),
          onkeydown: (event) => this.#key(event, i),
        },
        name,
      ),
    );
    entries.forEach(({id, root}) => {
      root.id = `panel-${id}`;
      root.setAttribute('role', 'tabpanel');
      root.setAttribute('aria-labelledby', `tab-${id}`);
    });
    this.bar = el('div', {class: 'tabs', role: 'tablist'}, this.buttons);
    this.root = el(
      'div',
      {class: 'tab-area'},
      this.bar,
      entries.map(({root}) => root),
    );
    this.show(entries[0].id);
  }

  #key(event, index) {
    const step = {ArrowRight: 1, ArrowLeft: -1}[event.key];
    if (!step) return;
    event.preventDefault();
    event.stopPropagation();
    const next = (index + step + this.entries.length) % this.entries.length;
    this.show(this.entries[next].id);
    this.buttons[next].focus();
  }

  show(id) {
    this.current = id;
    this.entries.forEach((entry, i) => {
      const on = entry.id === id;
      entry.root.hidden = !on;
      if (on) entry.shown?.();
      this.buttons[i].setAttribute('aria-selected', String(on));
      this.buttons[i].tabIndex = on ? 0 : -1;
    });
  }
}
