// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// A bus by socketcand's protocol over TCP (docs/bridge.md), for canopen's Device: no native module.
import {EventEmitter} from 'node:events';
import {connect} from 'node:net';

const MESSAGE = /<([^>]*)>/g;

/// Events: 'message' {id, data, len, ext, time}, 'close'.
export class Socketcand extends EventEmitter {
  #socket;
  #rest = '';
  #answers = [];  // of the set-up: who waits for < hi > and < ok >

  /// Opens `bus` of the server; rejects with what went wrong.
  static async open(port, bus = 'can0', host = '127.0.0.1') {
    const channel = new Socketcand();
    await channel.#connect(port, host);
    for (const command of [`< open ${bus} >`, '< rawmode >']) {
      channel.#socket.write(command);
      await channel.#answer();
    }
    return channel;
  }

  /// Sends a data frame, as Device hands it over; 11 bits unless `ext`.
  send({id, data = Buffer.alloc(0), ext = false}) {
    const digits = id.toString(16).padStart(ext ? 8 : 3, '0');
    const bytes = [...data].map((byte) => byte.toString(16).padStart(2, '0'));
    this.#socket.write(`< send ${[digits, data.length, ...bytes].join(' ')} >`);
  }

  /// Joins a Device to the bus, both ways.
  attach(device) {
    device.addListener('message', (message) => this.send(message));
    this.addListener('message', (message) => device.receive(message));
  }

  /// Leaves; what was sent still goes to the bus.
  close() {
    this.#socket.end();
  }

  async #connect(port, host) {
    this.#socket = connect({port, host, noDelay: true});
    this.#socket.setEncoding('latin1');
    this.#socket.on('data', (text) => this.#take(text));
    this.#socket.on('error', (error) => this.#fail(error));
    this.#socket.on('close', () => {
      this.#fail(new Error('the server has closed the connection'));
      this.emit('close');
    });
    await this.#answer();
  }

  #answer() {
    return new Promise((resolve, reject) => this.#answers.push({resolve, reject}));
  }

  #fail(error) {
    for (const {reject} of this.#answers.splice(0)) reject(error);
  }

  #take(text) {
    const all = this.#rest + text;
    const end = all.lastIndexOf('>') + 1;
    this.#rest = all.slice(end);
    for (const [, words] of all.slice(0, end).matchAll(MESSAGE)) this.#message(words.trim());
  }

  #message(text) {
    const [kind, id, time, hex = ''] = text.split(/\s+/);
    if (kind === 'hi' || kind === 'ok') {
      this.#answers.shift()?.resolve();
    } else if (kind === 'frame') {
      const data = Buffer.from(hex, 'hex');
      const ext = id.length > 3;
      this.emit('message', {id: parseInt(id, 16), data, len: data.length, ext, time: Number(time)});
    } else if (kind === 'error' && !/^\d/.test(id)) {
      this.#fail(new Error(text));
    }
  }
}
