// PNGs of 8 bits a channel, as the browser makes them: enough to count colours, and to make them small.
import {deflateSync, inflateSync} from 'node:zlib';

/** \return width, height and a function that gives red, green and blue at x, y. */
export function decodePng(bytes) {
  const width = bytes.readUInt32BE(16), height = bytes.readUInt32BE(20), channels = bytes[25] === 6 ? 4 : 3;
  if (bytes[24] !== 8 || (bytes[25] !== 2 && bytes[25] !== 6)) throw new Error('a PNG of another kind');
  const parts = [];
  for (let at = 8; at < bytes.length; at += 12 + bytes.readUInt32BE(at))
    if (bytes.toString('latin1', at + 4, at + 8) === 'IDAT') parts.push(bytes.subarray(at + 8, at + 8 + bytes.readUInt32BE(at)));
  const raw = inflateSync(Buffer.concat(parts)), row = width * channels, pixels = Buffer.alloc(height * row);
  for (let y = 0; y < height; ++y)
    for (let i = 0; i < row; ++i) {
      const left = i < channels ? 0 : pixels[y * row + i - channels], up = y ? pixels[(y - 1) * row + i] : 0;
      const corner = y && i >= channels ? pixels[(y - 1) * row + i - channels] : 0;
      pixels[y * row + i] = raw[y * (row + 1) + 1 + i] + predicted(raw[y * (row + 1)], left, up, corner);
    }
  return {width, height, at: (x, y) => pixels.subarray((y * width + x) * channels, (y * width + x) * channels + 3)};
}

function predicted(filter, left, up, corner) {
  if (filter < 3) return [0, left, up][filter];
  if (filter === 3) return (left + up) >> 1;
  const away = [left, up, corner].map((value) => Math.abs(left + up - corner - value));
  return away[0] <= away[1] && away[0] <= away[2] ? left : away[1] <= away[2] ? up : corner;
}

/** How many pixels a test holds for, in a part of the picture. */
export function countPixels(image, test, {left = 0, top = 0, right = image.width, bottom = image.height} = {}) {
  let count = 0;
  for (let y = top; y < bottom; ++y) for (let x = left; x < right; ++x) if (test(...image.at(x, y))) ++count;
  return count;
}

/** Half as wide and high: each pixel the mean of four. */
export function halved({width, height, at}) {
  const mean = (x, y) => [0, 1, 2].map((channel) =>
    (at(x, y)[channel] + at(x + 1, y)[channel] + at(x, y + 1)[channel] + at(x + 1, y + 1)[channel] + 2) >> 2);
  return {width: width >> 1, height: height >> 1, at: (x, y) => mean(2 * x, 2 * y)};
}

/** A PNG of at most 256 colours: the most frequent, alike ones taken together. */
export function encodePalettePng({width, height, at}) {
  const alike = new Map(), keys = new Uint32Array(width * height);
  for (let y = 0; y < height; ++y)
    for (let x = 0; x < width; ++x) {
      const color = at(x, y), key = ((color[0] & 0xf8) << 16) | ((color[1] & 0xf8) << 8) | (color[2] & 0xf8);
      const sum = alike.get(key) ?? [0, 0, 0, 0];
      [color[0], color[1], color[2], 1].forEach((value, i) => (sum[i] += value));
      alike.set(key, sum);
      keys[y * width + x] = key;
    }
  const kept = [...alike].sort((a, b) => b[1][3] - a[1][3]).slice(0, 256);
  const palette = kept.map(([, sum]) => sum.slice(0, 3).map((value) => Math.round(value / sum[3]))), indices = new Map();
  for (const [key, sum] of alike) indices.set(key, nearestIndex(palette, sum.slice(0, 3).map((value) => value / sum[3])));
  const rows = Buffer.alloc(height * (width + 1));
  keys.forEach((key, i) => (rows[i + Math.floor(i / width) + 1] = indices.get(key)));
  const head = Buffer.alloc(13);
  head.writeUInt32BE(width, 0);
  head.writeUInt32BE(height, 4);
  head.set([8, 3, 0, 0, 0], 8);
  return Buffer.concat([Buffer.from([137, 80, 78, 71, 13, 10, 26, 10]), part('IHDR', head), part('PLTE', Buffer.from(palette.flat())),
                        part('IDAT', deflateSync(rows, {level: 9})), part('IEND', Buffer.alloc(0))]);
}

function nearestIndex(palette, color) {
  let best = 0, least = Infinity;
  palette.forEach((one, index) => {
    const away = one.reduce((sum, value, i) => sum + (value - color[i]) ** 2, 0);
    if (away < least) [best, least] = [index, away];
  });
  return best;
}

function part(name, data) {
  const body = Buffer.concat([Buffer.from(name, 'latin1'), data]), framed = Buffer.alloc(body.length + 8);
  framed.writeUInt32BE(data.length, 0);
  body.copy(framed, 4);
  framed.writeInt32BE(checksum(body), body.length + 4);
  return framed;
}

function checksum(bytes) {
  let sum = ~0;
  for (const byte of bytes) {
    sum ^= byte;
    for (let bit = 0; bit < 8; ++bit) sum = sum & 1 ? (sum >>> 1) ^ 0xedb88320 : sum >>> 1;
  }
  return ~sum;
}
