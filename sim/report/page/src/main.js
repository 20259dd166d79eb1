// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The page: starts everything once the data is there.
import uPlot from 'uplot';

const meta = JSON.parse(document.getElementById('verican-meta').textContent);
document.title = meta.title;
document.getElementById('app').textContent = `${meta.title}: ${meta.summary.frames} frames`;
window.verican = {meta, uPlot};
