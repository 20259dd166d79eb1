// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Takes the data out of the page: meta.json and the arrays behind base64 and zlib.

/** Bad or missing data; the message is for the person who opened the file. */
export class LoadError extends Error {}

const kSlice = 4 << 20; // base64 characters between two looks at the clock

function metaOf(documentNode) {
  const element = documentNode.getElementById('verican-meta');
  if (!element)
    throw new LoadError('this file has no report in it: element verican-meta is missing');
  let meta;
  try {
    meta = JSON.parse(element.textContent);
  } catch (error) {
    throw new LoadError(`the description of the report is damaged: ${error.message}`);
  }
  if (meta.format !== 1) {
    throw new LoadError(`this report has format ${meta.format}; this page reads format 1`);
  }
  return meta;
}

function sizeOf(meta) {
  const bytes = {u8: 1, i8: 1, u16: 2, i16: 2, u32: 4, f64: 8};
  return meta.arrays.reduce((size, {name, type, offset, length}) => {
    if (!(type in bytes)) throw new LoadError(`array ${name} has type ${type}, which is unknown`);
    return Math.max(size, offset + bytes[type] * length);
  }, 0);
}

/** Base64 in slices to bytes; whole groups of four characters each. */
async function* bytesOf(text, progress) {
  for (let at = 0; at < text.length; at += kSlice) {
    let binary;
    try {
      binary = atob(text.slice(at, at + kSlice));
    } catch {
      throw new LoadError('the data of the report is damaged: not base64');
    }
    const bytes = new Uint8Array(binary.length);
    for (let i = 0; i < bytes.length; ++i) bytes[i] = binary.charCodeAt(i);
    yield bytes;
    progress(Math.min(1, (at + kSlice) / text.length));
    await new Promise((resolve) => setTimeout(resolve));
  }
}

async function inflate(text, size, progress) {
  const stream = new DecompressionStream('deflate');
  const feed = async () => {
    const writer = stream.writable.getWriter();
    try {
      for await (const bytes of bytesOf(text, progress)) await writer.write(bytes);
      await writer.close();
    } catch (error) {
      await writer.abort(error).catch(() => {});
      throw error;
    }
  };
  const out = new Uint8Array(Math.ceil(size / 8) * 8);
  const drain = async () => {
    const reader = stream.readable.getReader();
    let at = 0;
    for (;;) {
      const {done, value} = await reader.read();
      if (done) break;
      if (at + value.length > out.length) throw new LoadError('the data of the report is too long');
      out.set(value, at);
      at += value.length;
    }
    if (at < size) throw new LoadError(`the data of the report ends early: ${at} of ${size} bytes`);
  };
  const [fed, drained] = await Promise.allSettled([feed(), drain()]);
  for (const {status, reason} of [fed, drained]) {
    if (status === 'rejected' && reason instanceof LoadError) throw reason;
  }
  if (drained.status === 'rejected' || fed.status === 'rejected') {
    throw new LoadError('the data of the report is damaged: its compression does not fit');
  }
  return out.buffer;
}

/**
 * The report in this document.
 * @param progress gets a number from 0 to 1 now and then.
 * @throws LoadError in words for people.
 */
export async function load(documentNode, progress = () => {}) {
  const meta = metaOf(documentNode);
  const element = documentNode.getElementById('verican-data');
  if (!element) throw new LoadError('the data of the report is missing');
  if (typeof DecompressionStream === 'undefined') {
    throw new LoadError(
      'this browser cannot decompress data (DecompressionStream); ' +
        'Chromium 111, Firefox 113, Safari 16.4 and later show it',
    );
  }
  const size = sizeOf(meta);
  const buffer = await inflate(element.textContent.replace(/\s+/g, ''), size, progress);
  element.remove();
  return {meta, buffer};
}
