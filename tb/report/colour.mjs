// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Colours as people with and without colour blindness see them: Machado, Oliveira, Fernandes (2009)
// at full severity, and the distance of two colours by CIEDE2000.

const kVisions = {
  normal: [1, 0, 0, 0, 1, 0, 0, 0, 1],
  protanopia: [
    0.152286, 1.052583, -0.204868, 0.114503, 0.786281, 0.099216, -0.003882, -0.048116, 1.051998,
  ],
  deuteranopia: [
    0.367322, 0.860646, -0.227968, 0.280085, 0.672501, 0.047413, -0.01182, 0.04294, 0.968881,
  ],
  tritanopia: [
    1.255528, -0.076749, -0.178779, -0.078411, 0.930809, 0.147602, 0.004733, 0.691367, 0.3039,
  ],
};
export const visions = Object.keys(kVisions);

/** sRGB 0..255 to linear light 0..1. */
const linear = (rgb) =>
  rgb.map((c) => (c / 255 <= 0.04045 ? c / 255 / 12.92 : ((c / 255 + 0.055) / 1.055) ** 2.4));

const times = (m, v) => [0, 3, 6].map((i) => m[i] * v[0] + m[i + 1] * v[1] + m[i + 2] * v[2]);

/** CIE L*a*b* (D65) of a colour, [r, g, b] from 0 to 255, as somebody sees it. */
export function lab(rgb, vision = 'normal') {
  const seen = times(kVisions[vision], linear(rgb)).map((c) => Math.min(Math.max(c, 0), 1));
  const xyz = times(
    [
      0.4124564, 0.3575761, 0.1804375, 0.2126729, 0.7151522, 0.072175, 0.0193339, 0.119192,
      0.9503041,
    ],
    seen,
  );
  const [x, y, z] = xyz
    .map((c, i) => c / [0.95047, 1, 1.08883][i])
    .map((c) => (c > 216 / 24389 ? Math.cbrt(c) : (24389 / 27 / 116) * c + 16 / 116));
  return [116 * y - 16, 500 * (x - y), 200 * (y - z)];
}

const degrees = (radians) => ((((radians * 180) / Math.PI) % 360) + 360) % 360;
const cosine = (angle) => Math.cos((angle * Math.PI) / 180);

/** Mean of two hues, degrees; c1 and c2 are their chromas. */
function meanHue(h1, h2, c1, c2) {
  if (c1 * c2 === 0) return h1 + h2;
  if (Math.abs(h1 - h2) <= 180) return (h1 + h2) / 2;
  return h1 + h2 < 360 ? (h1 + h2 + 360) / 2 : (h1 + h2 - 360) / 2;
}

/** Difference of two hues as CIEDE2000 wants it, degrees. */
function hueStep(h1, h2, c1, c2) {
  if (c1 * c2 === 0) return 0;
  const step = h2 - h1;
  return step > 180 ? step - 360 : step < -180 ? step + 360 : step;
}

/** CIEDE2000 (Sharma, Wu, Dalal 2005) of two colours in L*a*b*. */
export function distance([l1, a1, b1], [l2, a2, b2]) {
  const seven = (c) => Math.sqrt(c ** 7 / (c ** 7 + 25 ** 7));
  const g = 0.5 * (1 - seven((Math.hypot(a1, b1) + Math.hypot(a2, b2)) / 2));
  const [p1, p2] = [(1 + g) * a1, (1 + g) * a2];
  const [c1, c2] = [Math.hypot(p1, b1), Math.hypot(p2, b2)];
  const [h1, h2] = [degrees(Math.atan2(b1, p1)), degrees(Math.atan2(b2, p2))];
  const [l, c, h] = [(l1 + l2) / 2, (c1 + c2) / 2, meanHue(h1, h2, c1, c2)];
  const t =
    1 -
    0.17 * cosine(h - 30) +
    0.24 * cosine(2 * h) +
    0.32 * cosine(3 * h + 6) -
    0.2 * cosine(4 * h - 63);
  const sl = 1 + (0.015 * (l - 50) ** 2) / Math.sqrt(20 + (l - 50) ** 2);
  const dh = 2 * Math.sqrt(c1 * c2) * Math.sin((hueStep(h1, h2, c1, c2) * Math.PI) / 360);
  const [x, y, z] = [(l2 - l1) / sl, (c2 - c1) / (1 + 0.045 * c), dh / (1 + 0.015 * c * t)];
  const turn = -Math.sin((60 * Math.exp(-(((h - 275) / 25) ** 2)) * Math.PI) / 180);
  return Math.sqrt(x * x + y * y + z * z + turn * 2 * seven(c) * y * z);
}
