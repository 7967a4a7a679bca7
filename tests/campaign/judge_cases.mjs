// judge_cases.mjs FOLDER: judges every NUMBER.stl in the folder by what NUMBER.json claims of it. Shares no code with what
// made them: the file's own triangles, manifold-3d, and formulae written down here. Prints a line for each claim that does not hold.
import {readdirSync, readFileSync} from 'node:fs';
import {createRequire} from 'node:module';
import {join} from 'node:path';
import {pathToFileURL} from 'node:url';

const packages = createRequire(new URL('../judges/package.json', import.meta.url));
const wasm = await (await import(pathToFileURL(packages.resolve('manifold-3d')))).default();
wasm.setup();

const minus = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
const along = (a, s, d) => [a[0] + s * d[0], a[1] + s * d[1], a[2] + s * d[2]];
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const unit = (a) => a.map((x) => x / Math.hypot(...a));
const degrees = (rad) => (rad * 180) / Math.PI;

// Corners are the same vertex where their coordinates are the same bits.
function readStl(path) {
  const data = readFileSync(path);
  const count = data.readUInt32LE(80);
  const index = new Map(), vertices = [], triangles = [];
  for (let t = 0; t < count; ++t) {
    const triangle = [];
    for (let at = 84 + 50 * t + 12, corner = 0; corner < 3; ++corner, at += 12) {
      const key = data.toString('latin1', at, at + 12);
      if (!index.has(key)) {
        index.set(key, vertices.length);
        vertices.push([data.readFloatLE(at), data.readFloatLE(at + 4), data.readFloatLE(at + 8)]);
      }
      triangle.push(index.get(key));
    }
    triangles.push(triangle);
  }
  return {vertices, triangles};
}

function manifoldOf({vertices, triangles}) {
  const mesh = new wasm.Mesh(
    {numProp: 3, vertProperties: Float32Array.from(vertices.flat()), triVerts: Uint32Array.from(triangles.flat())});
  let made;
  try {
    made = new wasm.Manifold(mesh);
    return {status: made.status(), volume: made.volume()};
  } catch (error) {
    return {status: error.code ?? String(error), volume: 0};
  } finally {
    made?.delete();
  }
}

// Volume and centroid by signed tetrahedra from the first vertex.
function bodyOf({vertices, triangles}) {
  const origin = vertices[triangles[0][0]];
  let volume = 0, first = [0, 0, 0];
  for (const triangle of triangles) {
    const [a, b, c] = triangle.map((v) => minus(vertices[v], origin));
    const six = dot(a, cross(b, c));
    volume += six / 6;
    first = first.map((m, i) => m + (six * (a[i] + b[i] + c[i])) / 24);
  }
  return {volume, centroid: along(origin, 1 / volume, first)};
}

// The closed surfaces that triangles belong to, each as a mesh with the same vertices.
function componentsOf({vertices, triangles}) {
  const parent = vertices.map((_, i) => i);
  const root = (v) => {
    while (parent[v] !== v) v = parent[v] = parent[parent[v]];
    return v;
  };
  for (const [a, b, c] of triangles) {
    parent[root(a)] = root(b);
    parent[root(b)] = root(c);
  }
  const groups = new Map();
  for (const t of triangles) {
    if (!groups.has(root(t[0]))) groups.set(root(t[0]), []);
    groups.get(root(t[0])).push(t);
  }
  return [...groups.values()].map((group) => ({vertices, triangles: group}));
}

function convexHull(points) {
  const turn = (a, b, c) => (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
  const chain = (ordered) => {
    const hull = [];
    for (const p of ordered) {
      while (hull.length > 1 && turn(hull.at(-2), hull.at(-1), p) <= 0) hull.pop();
      hull.push(p);
    }
    return hull.slice(0, -1);
  };
  const sorted = [...points].sort((a, b) => a[0] - b[0] || a[1] - b[1]);
  return [...chain(sorted), ...chain([...sorted].reverse())];
}

// What lies within contactMm of the lowest point, seen along up, and the centre of mass over it.
function tipOf(mesh, centroid, up, contactMm, shrunkMm) {
  const side = unit(cross(up, Math.abs(up[0]) < 0.7 ? [1, 0, 0] : [0, 1, 0])), other = cross(up, side);
  // On a grid: which way one turns between two points that differ by rounding is not known.
  const flat = (p) => [dot(p, side), dot(p, other)].map((x) => Math.round(x / GRID_MM) * GRID_MM);
  const heights = mesh.vertices.map((v) => dot(v, up));
  const plate = mesh.triangles.reduce((low, t) => Math.min(low, heights[t[0]], heights[t[1]], heights[t[2]]), Infinity);
  const level = plate + contactMm, touching = [];
  for (const t of mesh.triangles)
    for (let i = 0; i < 3; ++i) {
      const a = t[i], b = t[(i + 1) % 3];
      if (heights[a] <= level) touching.push(flat(mesh.vertices[a]));
      if (heights[a] <= level !== heights[b] <= level) {
        const s = (level - heights[a]) / (heights[b] - heights[a]);
        touching.push(flat(along(mesh.vertices[a], s, minus(mesh.vertices[b], mesh.vertices[a]))));
      }
    }
  const hull = convexHull(touching), at = flat(centroid), h = dot(centroid, up) - plate;
  let least = Infinity;
  hull.forEach((p, i) => {
    const q = hull[(i + 1) % hull.length], length = Math.hypot(q[0] - p[0], q[1] - p[1]);
    if (length < SAME_MM) return; // an edge of rounding, in any direction
    const inside = ((q[0] - p[0]) * (at[1] - p[1]) - (q[1] - p[1]) * (at[0] - p[0])) / length;
    least = Math.min(least, Math.atan2(inside - shrunkMm, h));    least = Math.min(least, Math.atan2(inside - shrunkMm, h));
  });
  return {tip: degrees(least), corners: hull.length};
}

// Of one thread the angle between up and the line to it; of two the same across the axis through both.
function tiltOf(centroid, up, [p, q]) {
  if (!q) return degrees(Math.atan2(Math.hypot(...cross(up, minus(p, centroid))), dot(up, minus(p, centroid))));
  const axis = minus(q, p), across = unit(cross(up, axis)), level = cross(across, up);
  const above = minus(along(p, dot(minus(centroid, p), level) / dot(axis, level), axis), centroid);
  return degrees(Math.atan2(Math.abs(dot(above, across)), dot(above, up)));
}

// What bounds are of: bodies that hang below their threads and, of two, pull at both.
function hangsAtAll(centroid, {up, attachments_mm: [p, q], least_drop_mm}) {
  if (!q) return dot(minus(p, centroid), up) >= least_drop_mm;
  const axis = minus(q, p), level = unit(cross(cross(up, axis), up));
  const share = dot(minus(centroid, p), level) / dot(axis, level);
  return share >= 0 && share <= 1 && dot(minus(along(p, share, axis), centroid), up) >= least_drop_mm;
}

function distanceToSegment(p, from, edge) {
  const x = p[0] - from[0], y = p[1] - from[1], z = p[2] - from[2];
  const s = Math.min(1, Math.max(0, (x * edge[0] + y * edge[1] + z * edge[2]) / dot(edge, edge)));
  return Math.hypot(x - s * edge[0], y - s * edge[1], z - s * edge[2]);
}

function distanceToTriangle(p, {a, b, c, ab, bc, ca, normal, n2}) {
  const ap = minus(p, a);
  const v = -dot(cross(ap, ca), normal) / n2, w = dot(cross(ab, ap), normal) / n2;
  if (v >= 0 && w >= 0 && v + w <= 1) return Math.abs(dot(ap, normal)) / Math.sqrt(n2);
  return Math.min(distanceToSegment(p, a, ab), distanceToSegment(p, b, bc), distanceToSegment(p, c, ca));
}

// A triangle and a ball round it.
function facetOf([a, b, c]) {
  const ab = minus(b, a), bc = minus(c, b), ca = minus(a, c), normal = cross(ab, minus(c, a));
  const x = (a[0] + b[0] + c[0]) / 3, y = (a[1] + b[1] + c[1]) / 3, z = (a[2] + b[2] + c[2]) / 3;
  const radius = Math.max(...[a, b, c].map((v) => Math.hypot(v[0] - x, v[1] - y, v[2] - z)));
  return {a, b, c, ab, bc, ca, normal, n2: dot(normal, normal), x, y, z, radius};
}

// The least distance from corners, middles of edges and of triangles to another surface, where that is below `reach`.
function wallBetween(mesh, inner, outer, reach) {
  const cell = reach, grid = new Map();
  const key = (i, j, k) => (i * 4099 + j) * 4099 + k;
  const corners = (t) => t.map((v) => mesh.vertices[v]);
  for (const facet of outer.map((t) => facetOf(corners(t)))) {
    const {a, b, c} = facet;
    const low = [0, 1, 2].map((x) => Math.floor((Math.min(a[x], b[x], c[x]) - reach) / cell));
    const high = [0, 1, 2].map((x) => Math.floor((Math.max(a[x], b[x], c[x]) + reach) / cell));
    for (let i = low[0]; i <= high[0]; ++i)
      for (let j = low[1]; j <= high[1]; ++j)
        for (let k = low[2]; k <= high[2]; ++k) {
          if (!grid.has(key(i, j, k))) grid.set(key(i, j, k), []);
          grid.get(key(i, j, k)).push(facet);
        }
  }
  let least = reach;
  const look = (x, y, z) => {
    for (const facet of grid.get(key(Math.floor(x / cell), Math.floor(y / cell), Math.floor(z / cell))) ?? []) {
      const near = least + facet.radius, dx = x - facet.x, dy = y - facet.y, dz = z - facet.z;
      if (dx * dx + dy * dy + dz * dz < near * near) least = Math.min(least, distanceToTriangle([x, y, z], facet));
    }
  };
  const middle = (p, q) => look((p[0] + q[0]) / 2, (p[1] + q[1]) / 2, (p[2] + q[2]) / 2);
  new Set(inner.flat()).forEach((v) => look(...mesh.vertices[v]));
  for (const [a, b, c] of inner.map(corners)) {
    look((a[0] + b[0] + c[0]) / 3, (a[1] + b[1] + c[1]) / 3, (a[2] + b[2] + c[2]) / 3);
    middle(a, b);
    middle(b, c);
    middle(c, a);
  }
  return least;
}

// What is wrong with how a pose is said to hold; and by how much tan(angle) exceeds what was asked for.
function judgePose(mesh, body, pose, robust, expect) {
  expect('volume', Math.abs(pose.volume_mm3 / body.volume - 1) < 1e-6, pose.volume_mm3, body.volume);
  expect('centre of mass', Math.hypot(...minus(pose.com_mm, body.centroid)) < 1e-4, pose.com_mm, body.centroid);
  if (pose.kind === 'hanging') {
    const tilt = tiltOf(body.centroid, pose.up, pose.attachments_mm);
    expect('tilt', Math.abs(tilt - pose.tilt_deg) < 1e-3, pose.tilt_deg, tilt);
    return {angle: tilt, surplus: tan(pose.required_deg) - tan(tilt), meets: tilt <= pose.required_deg + 1e-6,
      counts: hangsAtAll(body.centroid, pose)};
  }
  const {tip, corners} = tipOf(mesh, body.centroid, pose.up, pose.contact_height_mm, 0);
  // A sliver of a polygon may have three corners by one rounding and two by another.
  if (!pose.can_stand || corners < 3) return null;
  expect('tip angle', Math.abs(tip - pose.tip_deg) < 1e-3, pose.tip_deg, tip);
  const worst = tipOf(mesh, body.centroid, pose.up, pose.contact_height_mm, pose.xy_error_mm).tip;
  expect('robust tip angle', Math.abs(worst - pose.robust_tip_deg) < 1e-3, pose.robust_tip_deg, worst);
  const angle = robust ? worst : tip;
  return {angle, surplus: tan(angle) - tan(pose.required_deg), meets: angle >= pose.required_deg - 1e-6, counts: true};
}

const tan = (deg) => Math.tan((deg * Math.PI) / 180);

function judge(mesh, claims, expect) {
  const told = manifoldOf(mesh), body = bodyOf(mesh);
  expect('manifold-3d', told.status === 'NoError', told.status, 'NoError');
  expect('volume by manifold-3d', Math.abs(told.volume / body.volume - 1) < 1e-6, told.volume, body.volume);
  const inward = componentsOf(mesh).filter((part) => bodyOf(part).volume < 0).length;
  expect('voids', claims.voids === inward, claims.voids, inward);
  const inner = mesh.triangles.slice(claims.own_triangles), own = mesh.triangles.slice(0, claims.own_triangles);
  if (claims.wall && !claims.drilled && inner.length > 0) {
    const wall = wallBetween(mesh, inner, own, 1.01 * Math.max(claims.wall.required_mm, claims.wall.measured_mm));
    expect('wall', wall >= claims.wall.required_mm * (1 - 1e-6), claims.wall.required_mm, wall);
    expect('measured wall', wall >= claims.wall.measured_mm * (1 - 1e-6), claims.wall.measured_mm, wall);
    ++judged.walls;
  }
  const poses = claims.poses.map((pose) => judgePose(mesh, body, pose, claims.robust, expect));
  if (poses.includes(null)) return;
  judged.angles += poses.length;
  const stands = claims.outcome === 'stands' || claims.outcome === 'already_stands';
  if (stands) expect('outcome', poses.every((pose) => pose.meets), claims.outcome, 'not all poses hold');
  if (!claims.bound || !poses.every((pose) => pose.counts)) return;
  const {of, deg} = claims.bound;
  const value = of === 'surplus' ? degrees(Math.atan(Math.min(...poses.map((pose) => pose.surplus)))) : poses[0].angle;
  const within = of === 'tilt' ? value >= deg - BOUND_DEG : value <= deg + BOUND_DEG;
  expect('bound', within, deg, value);
  ++judged.bounds;
}

const SAME_MM = 1e-8, GRID_MM = 1e-9;
const BOUND_DEG = 0.01; // what the void's surface may be off the sum that the bound is certified for
const judged = {cases: 0, walls: 0, angles: 0, bounds: 0, wrong: 0};
const folder = process.argv[2];
for (const name of readdirSync(folder).filter((name) => name.endsWith('.stl'))) {
  const number = name.slice(0, -4), wrong = [];
  const claims = JSON.parse(readFileSync(join(folder, number + '.json'), 'utf8'));
  judge(readStl(join(folder, name)), claims, (what, holds, claimed, found) => {
    if (!holds) wrong.push(`${what}: claimed ${claimed}, found ${found}`);
  });
  ++judged.cases;
  if (wrong.length === 0) continue;
  ++judged.wrong;
  console.log(`WRONG case ${number}: ${wrong.join('; ')}`);
}
console.log('judged ' + Object.entries(judged).map(([what, count]) => `${what}=${count}`).join(' '));
process.exit(judged.wrong > 0 ? 1 : 0);
