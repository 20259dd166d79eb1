// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The scenes of the tests, with all that is known of them.
import {Scene} from './scene.mjs';

/** A bit of everything: formats, arbitration, errors, overload; three nodes, 500 kbit/s. */
export function smallScene(more = {}) {
  const scene = new Scene(['left', 'middle', 'right'], {title: 'A bit of everything'});
  scene.frame(
    0,
    {id: 0x123, dlc: 2, data: [0xca, 0xfe]},
    {message: 0, response: 110000, resync: {12: 1, 14: -1}},
  );
  scene.frame(
    1,
    {id: 0x00a, dlc: 8, data: [0, 0, 0, 0, 255, 255, 255, 255]},
    {gap: 20, message: 1, response: 250000},
  );
  scene.frame(
    2,
    {id: 0x12345678, extended: true, dlc: 3, data: [1, 2, 3]},
    {gap: 5, losers: [{node: 1, frame: {id: 0x18da00f1, extended: true, dlc: 0}}]},
  );
  scene.frame(0, {id: 0x7ff, remote: true, dlc: 4}, {gap: 2});
  scene.crcError(0, {id: 0x2aa, dlc: 4, data: [0xde, 0xad, 0xbe, 0xef]}, 2);
  scene.frame(
    0,
    {id: 0x2aa, dlc: 4, data: [0xde, 0xad, 0xbe, 0xef]},
    {message: 0, response: 480000},
  );
  scene.overload(1, {id: 0x0f0, dlc: 1, data: [0x55]});
  scene.noAck(2, {id: 0x333, dlc: 1, data: [0x99]});
  scene.frame(
    2,
    {id: 0x333, dlc: 9, data: [1, 2, 3, 4, 5, 6, 7, 8]},
    {
      gap: 30,
      losers: [
        {node: 0, frame: {id: 0x334, dlc: 0}},
        {node: 1, frame: {id: 0x3ff, dlc: 0}},
      ],
    },
  );
  const messages = [
    {
      name: 'speed',
      node: 0,
      id: 0x123,
      extended: false,
      remote: false,
      period_ns: 0,
      queued: 2,
      sent: 2,
      shortest_ns: 110000,
      mean_ns: 295000,
      longest_ns: 480000,
      bound_ns: 400000,
    },
    {
      name: 'door <b>',
      node: 1,
      id: 0x00a,
      extended: false,
      remote: false,
      period_ns: 0,
      queued: 1,
      sent: 1,
      shortest_ns: 250000,
      mean_ns: 250000,
      longest_ns: 250000,
      bound_ns: null,
    },
  ];
  return {scene, ...scene.finish({messages, ...more})};
}

/** A repeatable sequence of numbers. */
export function randomFrom(seed) {
  let state = seed;
  return (limit) => {
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    return Math.floor((state / 2 ** 32) * limit);
  };
}

/** `count` frames of four nodes, one attempt in a hundred spoiled. */
export function bigScene(count) {
  const random = randomFrom(7);
  const scene = new Scene(['n0', 'n1', 'n2', 'n3'], {title: `${count} frames`});
  const messages = Array.from({length: 16}, (_, i) => ({
    name: `message ${i}`,
    node: i % 4,
    id: 0x100 + 16 * i,
    extended: false,
    remote: false,
    period_ns: 0,
    queued: 0,
    sent: 1,
    shortest_ns: 1e5,
    mean_ns: 2e5,
    longest_ns: 9e5,
    bound_ns: 1e6,
  }));
  const frames = Array.from({length: 500}, (_, i) => ({
    id: 0x100 + 16 * (i % 16),
    dlc: 8,
    data: Array.from({length: 8}, () => random(256)),
  }));
  for (let i = 0; i < count; ++i) {
    const which = random(frames.length);
    const frame = frames[which];
    const message = which % 16;
    const sender = message % 4;
    if (random(100) === 0) scene.crcError(sender, frame, (sender + 1) % 4);
    scene.frame(sender, frame, {gap: random(60), message, response: 2e5 + random(700000)});
  }
  return {scene, ...scene.finish({messages})};
}

/** A node alone: active flags until TEC is 128, passive ones from then on. */
export function lonelyScene() {
  const scene = new Scene(['alone'], {title: 'Alone'});
  for (let i = 0; i < 20; ++i) scene.noAck(0, {id: 0x00a, dlc: 1, data: [0xaa]});
  return {
    scene,
    ...scene.finish({
      statements: [
        {
          figure: '15',
          reported: 'an active error frame follows the missing acknowledge',
          seen: 'six dominant bits',
          ok: true,
          time_ns: 120000,
        },
        {
          figure: '16',
          reported: 'from 128 on the flag is recessive',
          seen: 'six recessive bits',
          ok: true,
          time_ns: scene.now - 60000,
        },
        {
          figure: '17',
          reported: 'something that cannot be',
          seen: 'not so',
          ok: false,
          time_ns: null,
        },
      ],
      checks: [{what: 'frames', wanted: '1', seen: '0', ok: false}],
    }),
  };
}
