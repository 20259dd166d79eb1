// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Says that there are more lanes than fit, above and below what is in sight; a click scrolls there.
import {el} from './dom.js';

const kPart = 0.25; // a lane that is in sight by less counts as hidden

export class LaneHint {
  /** @param scroll the element with the lanes */
  constructor(scroll) {
    this.scroll = scroll;
    const button = (side, title, sign) =>
      el('button', {
        type: 'button',
        class: `lane-hint ${side}`,
        hidden: true,
        title,
        onclick: () => scroll.scrollBy({top: sign * 0.8 * scroll.clientHeight}),
      });
    this.above = button('above', 'Scroll up (key ↑)', -1);
    this.below = button('below', 'Scroll down (key ↓)', 1);
    this.laneHeight = 1;
    scroll.addEventListener('scroll', () => this.update());
  }

  /** @param laneHeight px; call after the lanes were drawn */
  update(laneHeight = this.laneHeight) {
    this.laneHeight = laneHeight;
    const {scrollTop, clientHeight, scrollHeight} = this.scroll;
    const hidden = (px) => Math.ceil(px / laneHeight - kPart);
    const show = (button, count, arrow) => {
      button.hidden = count <= 0;
      const text = `${arrow} ${count} more ${count === 1 ? 'node' : 'nodes'}`;
      if (count > 0 && button.textContent !== text) button.textContent = text;
    };
    show(this.above, hidden(scrollTop), '▴');
    show(this.below, hidden(scrollHeight - scrollTop - clientHeight), '▾');
  }
}
