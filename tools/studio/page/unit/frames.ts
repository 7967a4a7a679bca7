/** Frames of a stream, as the server makes them. */

export function frame(kind: number, payload: Uint8Array): Uint8Array {
  const bytes = new Uint8Array(8 + payload.length), view = new DataView(bytes.buffer);
  view.setUint32(0, payload.length, true);
  view.setUint32(4, kind, true);
  bytes.set(payload, 8);
  return bytes;
}

export const json = (message: object) => frame(1, new TextEncoder().encode(JSON.stringify(message)));
export const end = frame(0, new Uint8Array());

/** A triangle. */
export function mesh(name: string): Uint8Array {
  const padded = new Uint8Array(4 * Math.ceil(name.length / 4));
  padded.set(new TextEncoder().encode(name));
  const words = new Uint8Array([...new Uint8Array(new Uint32Array([name.length]).buffer), ...padded,
    ...new Uint8Array(new Uint32Array([3, 1]).buffer), ...new Uint8Array(new Float32Array([0, 0, 0, 1, 0, 0, 0, 1, 0.5]).buffer),
    ...new Uint8Array(new Uint32Array([0, 1, 2]).buffer)]);
  return frame(2, words);
}

export function positions(numbers: readonly number[]): Uint8Array {
  return frame(3, stream(new Uint8Array(new Uint32Array([numbers.length / 3]).buffer), new Uint8Array(new Float32Array(numbers).buffer)));
}

export function stream(...parts: Uint8Array[]): Uint8Array {
  return new Uint8Array(parts.flatMap((part) => [...part]));
}
