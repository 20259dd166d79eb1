// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// What a picture of a frame must show, from the encoder alone.
import assert from 'node:assert/strict';
import {F, encode} from './can.mjs';
import {inspect, itemsOf, setView} from './browser.mjs';

const kNames = Object.fromEntries(Object.entries(F).map(([name, number]) => [number, name]));
const hex = (value, digits) => value.toString(16).toUpperCase().padStart(digits, '0');
const kDigits = {[F.ID]: 3, [F.EXID]: 5, [F.DATA]: 2, [F.CRC]: 4};

/** [name, value] of the fields of a frame that was acknowledged, in order. */
export function expectedFields(frame) {
  const fields = [];
  let last = null;
  for (const {field, level, stuff} of encode(frame)) {
    const next = !last || last.field !== field || (field === F.DATA && last.count === 8);
    if (next) {
      last = {field, value: 0, count: 0};
      fields.push(last);
    }
    if (stuff) continue;
    last.value = 2 * last.value + level;
    ++last.count;
  }
  return fields.map(({field, value}) => {
    if (field in kDigits) return [kNames[field], hex(value, kDigits[field])];
    if (field === F.DLC) return [kNames[field], String(value)];
    return [kNames[field], field === F.ACK ? '✓' : ''];
  });
}

/** Expected levels and stuff marks of the bits of a frame, up to the end of EOF. */
export function expectedBits(frame) {
  return encode(frame).map(({field, level, stuff}) => ({
    field: kNames[field],
    level: field === F.ACK ? 0 : level,
    stuff,
  }));
}

const centre = (item) => (item.x0 + item.x1) / 2;

/** Looks at a frame between two times: fields, values and every single bit are the encoder's. */
export async function judgeFrame(page, frame, start, end) {
  const room = 0.01 * (end - start);
  await setView(page, start - room, end + room);
  const picture = await inspect(page);
  assert.ok(
    ['fields', 'bits', 'quanta'].includes(picture.mode),
    `fields are shown: ${picture.mode}`,
  );
  const scale = (picture.width - picture.left) / (picture.to - picture.from);
  const x = (ns) => picture.left + (ns - picture.from) * scale;
  const fields = itemsOf(picture, 'field').filter(
    (f) => !f.own && centre(f) > x(start) && centre(f) < x(end),
  );
  assert.deepEqual(
    fields.map(({field, value}) => [field, value]),
    expectedFields(frame),
  );
  await judgeBits(page, frame, start, end);
}

/** Goes along the frame in windows of thirty bits, as a person would, and reads each bit. */
async function judgeBits(page, frame, start, end) {
  const bits = expectedBits(frame);
  const bit = (end - start) / bits.length;
  const seen = new Map();
  for (let first = 0; first < bits.length; first += 25) {
    await setView(page, start + (first - 2) * bit, start + (first + 28) * bit);
    const picture = await inspect(page);
    for (const item of itemsOf(picture, 'bit')) {
      const time =
        picture.from +
        ((centre(item) - picture.left) * (picture.to - picture.from)) /
          (picture.width - picture.left);
      const whole = item.x1 - item.x0 > 0.7 * ((picture.width - picture.left) / 30);
      const index = Math.floor((time - start) / bit);
      if (whole && index >= 0 && index < bits.length) seen.set(index, item);
    }
  }
  const list = bits
    .map((_, i) => seen.get(i))
    .map((item) => item && {field: item.field, level: item.level, stuff: item.stuff});
  assert.deepEqual(list, bits);
}
