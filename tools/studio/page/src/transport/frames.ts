/** Frames of a stream as tools/studio/README.md has them: u32 length, u32 kind, payload, little-endian. */

export interface MeshData {
  readonly name: string;
  readonly positions: Float32Array; // x, y, z of each vertex, mm
  readonly triangles: Uint32Array; // three vertices each
}

export type Frame =
  | {readonly kind: 'end'}
  | {readonly kind: 'json'; readonly message: {readonly type: string; readonly [key: string]: unknown}}
  | {readonly kind: 'mesh'; readonly mesh: MeshData}
  | {readonly kind: 'positions'; readonly positions: Float32Array};

const headerBytes = 8;

/** Takes bytes as they come and gives out frames as they are whole. */
export class FrameReader {
  #chunks: Uint8Array[] = [];
  #bytes = 0;
  #header: {length: number; kind: number} | null = null;
  #ended = false;

  /** Whether the stream said that it is over, and nothing was left of it. */
  get ended(): boolean {
    return this.#ended && this.#bytes === 0;
  }

  push(chunk: Uint8Array): Frame[] {
    this.#chunks.push(chunk);
    this.#bytes += chunk.byteLength;
    const frames: Frame[] = [];
    for (let frame = this.#next(); frame; frame = this.#next()) frames.push(frame);
    return frames;
  }

  #next(): Frame | null {
    if (!this.#header) {
      if (this.#bytes < headerBytes) return null;
      const view = new DataView(this.#take(headerBytes).buffer);
      this.#header = {length: view.getUint32(0, true), kind: view.getUint32(4, true)};
    }
    if (this.#bytes < this.#header.length) return null;
    const {length, kind} = this.#header;
    this.#header = null;
    const frame = decoded(kind, this.#take(length));
    if (frame.kind === 'end') this.#ended = true;
    return frame;
  }

  /** The first `count` bytes in a buffer of their own, so that numbers in it are aligned. */
  #take(count: number): Uint8Array<ArrayBuffer> {
    const taken = new Uint8Array(count);
    for (let filled = 0; filled < count; ) {
      const first = this.#chunks[0] as Uint8Array;
      const used = Math.min(first.byteLength, count - filled);
      taken.set(first.subarray(0, used), filled);
      filled += used;
      if (used === first.byteLength) this.#chunks.shift();
      else this.#chunks[0] = first.subarray(used);
    }
    this.#bytes -= count;
    return taken;
  }
}

function decoded(kind: number, payload: Uint8Array<ArrayBuffer>): Frame {
  switch (kind) {
    case 0:
      return {kind: 'end'};
    case 1:
      return {kind: 'json', message: JSON.parse(new TextDecoder().decode(payload))};
    case 2:
      return {kind: 'mesh', mesh: decodedMesh(payload.buffer)};
    case 3:
      return {kind: 'positions', positions: numbers(payload.buffer, 4, new DataView(payload.buffer).getUint32(0, true))};
    default:
      throw new Error(`The server sent a frame of kind ${kind}, which this page does not know.`);
  }
}

function numbers(buffer: ArrayBuffer, offset: number, points: number): Float32Array {
  return new Float32Array(buffer, offset, 3 * points);
}

function decodedMesh(buffer: ArrayBuffer): MeshData {
  const view = new DataView(buffer);
  const nameBytes = view.getUint32(0, true);
  const name = new TextDecoder().decode(new Uint8Array(buffer, 4, nameBytes)).replace(/\0+$/, '');
  const counts = 4 + 4 * Math.ceil(nameBytes / 4);
  const vertices = view.getUint32(counts, true), triangles = view.getUint32(counts + 4, true);
  const points = counts + 8;
  return {
    name,
    positions: numbers(buffer, points, vertices),
    triangles: new Uint32Array(buffer, points + 12 * vertices, 3 * triangles),
  };
}
