// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// device.mjs PORT NODE [BUS]: npm's canopen as a device with the object dictionary of the servo
// drive (sw/canopennode/drive/drive.eds): SDO server, heartbeat, SYNC and TPDO, EMCY. At each SYNC
// it goes a step towards its set point. A value written to object 2008 is an error, which it tells.
import {existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync} from 'node:fs';
import {tmpdir} from 'node:os';
import {dirname, join} from 'node:path';
import {fileURLToPath} from 'node:url';

import {canopen, openBus} from './program.mjs';

const here = dirname(fileURLToPath(import.meta.url));
const {Device, Eds} = canopen;
const STEP = 100;

// The library knows no $NODEID.
function dataSheet(node) {
  // In the project, or beside the examples that were installed.
  const places = ['../../sw', '../..'].map((up) => join(here, up, 'canopennode/drive/drive.eds'));
  const text = readFileSync(places.find(existsSync) ?? places[0], 'latin1').replaceAll(
      /\$NODEID\+(0x[0-9A-F]+)/gi, (_, base) => `0x${(Number(base) + node).toString(16)}`);
  const folder = mkdtempSync(join(tmpdir(), 'verican-'));
  try {
    writeFileSync(join(folder, 'drive.eds'), text);
    return Eds.fromFile(join(folder, 'drive.eds'));
  } finally {
    rmSync(folder, {recursive: true});
  }
}

const {bus, node} = await openBus();
const eds = dataSheet(node);
// Its SDO parameters are those of the default server: client to server first.
eds.removeEntry(0x1200);
eds.addSdoServerParameter(0, 0x580 + node, 0x600 + node);
const device = new Device({id: node, eds, enableLss: false});

device.sync.on('sync', () => {
  const way = device.getValue(0x607a) - device.getValue(0x6064);
  device.setValue(0x6064, device.getValue(0x6064) + Math.max(-STEP, Math.min(STEP, way)));
});
eds.getEntry(0x2008).addListener('update', ({value: code}) => {
  device.setValue(0x1001, code === 0 ? 0 : 0x80);
  device.emcy.write(code);
});
bus.attach(device);
device.start();
console.log(`device ${node} is there`);
bus.on('close', () => process.exit(0));
