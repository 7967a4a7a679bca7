// Pixels of a PNG of 8 bits a channel, as the browser makes it: enough to count colours.
import {inflateSync} from 'node:zlib';

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
