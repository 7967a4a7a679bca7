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

/** A PNG of at most 256 colours, the most frequent ones: screenshots have few. */
export function encodePalettePng({width, height, at}) {
  const counts = new Map(), keyAt = (x, y) => at(x, y).reduce((key, value) => (key << 8) | (value & 0xfc), 0);
  for (let y = 0; y < height; ++y) for (let x = 0; x < width; ++x) counts.set(keyAt(x, y), (counts.get(keyAt(x, y)) ?? 0) + 1);
  const palette = [...counts].sort((a, b) => b[1] - a[1]).slice(0, 256).map(([key]) => key), nearest = new Map();
  const indexOf = (key) => {
    if (!nearest.has(key)) nearest.set(key, nearestIndex(palette, key));
    return nearest.get(key);
  };
  const rows = Buffer.alloc(height * (width + 1));
  for (let y = 0; y < height; ++y) for (let x = 0; x < width; ++x) rows[y * (width + 1) + 1 + x] = indexOf(keyAt(x, y));
  const head = Buffer.alloc(13);
  head.writeUInt32BE(width, 0);
  head.writeUInt32BE(height, 4);
  head.set([8, 3, 0, 0, 0], 8);
  const colors = Buffer.from(palette.flatMap((key) => [key >> 16, (key >> 8) & 255, key & 255].map((value) => value | (value >> 6))));
  return Buffer.concat([Buffer.from([137, 80, 78, 71, 13, 10, 26, 10]), part('IHDR', head), part('PLTE', colors),
                        part('IDAT', deflateSync(rows, {level: 9})), part('IEND', Buffer.alloc(0))]);
}

function nearestIndex(palette, key) {
  let best = 0, least = Infinity;
  palette.forEach((color, index) => {
    const away = [16, 8, 0].reduce((sum, shift) => sum + (((color >> shift) & 255) - ((key >> shift) & 255)) ** 2, 0);
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
