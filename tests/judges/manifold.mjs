// manifold.mjs MESH.json: what manifold-3d says of an indexed mesh, as JSON: its status and the volume it computes.
import {readFileSync} from 'node:fs';

import Module from 'manifold-3d';

const wasm = await Module();
wasm.setup();
const {vertices, triangles} = JSON.parse(readFileSync(process.argv[2], 'utf8'));
const mesh = new wasm.Mesh({
  numProp: 3,
  vertProperties: Float32Array.from(vertices.flat()),
  triVerts: Uint32Array.from(triangles.flat()),
});

let verdict;
try {
  const manifold = new wasm.Manifold(mesh);
  verdict = {status: manifold.status(), volume: manifold.volume()};
} catch (error) {
  verdict = {status: error.code ?? String(error), volume: 0};
}
console.log(JSON.stringify(verdict));
