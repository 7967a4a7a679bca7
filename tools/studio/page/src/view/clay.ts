import {Color, FrontSide, MeshLambertMaterial, type Plane, type Side, Vector4, type WebGLProgramParametersWithUniforms} from 'three';

interface Clay {
  readonly opacity?: number;
  readonly side?: Side;
  readonly clip?: Plane[];
  /** Planes a, b, c, d in the coordinates of the surface: only what has a x + b y + c z + d >= 0 is drawn, hatched both ways. */
  readonly within?: readonly number[][];
}

/** The matter of the model: round where the surface is, sharp at edges, with painted regions as patterns. */
export function clay(color: Color, options: Clay = {}): MeshLambertMaterial {
  const {opacity = 1, side = FrontSide, clip = [], within = []} = options;
  const material = new MeshLambertMaterial({
    color, side, clippingPlanes: clip, transparent: opacity < 1, opacity, depthWrite: opacity === 1,
  });
  const ink = {value: new Color(0x000000)};
  material.userData.patternInk = ink;
  material.customProgramCacheKey = () => `clay ${within.length}`;
  material.onBeforeCompile = (shader) => {
    shader.uniforms.patternInk = ink;
    if (within.length) onlyWithin(shader, within);
    shader.vertexShader = shader.vertexShader
      .replace('#include <common>', `#include <common>
        attribute float crease; attribute float paint; varying float vCrease; varying vec3 vPaint;`)
      .replace('#include <begin_vertex>', `#include <begin_vertex>
        vCrease = crease; vPaint = vec3(equal(vec3(paint), vec3(1.0, 2.0, 3.0)));`);
    shader.fragmentShader = shader.fragmentShader
      .replace('#include <common>', `#include <common>
        varying float vCrease; varying vec3 vPaint; uniform vec3 patternInk;${patterns()}`)
      .replace('#include <normal_fragment_begin>', `#include <normal_fragment_begin>
        vec3 facet = normalize(cross(dFdx(vViewPosition), dFdy(vViewPosition)));
        normal = normalize(mix(normal, facet, smoothstep(0.0, 0.6, vCrease)));`)
      .replace('#include <color_fragment>', `#include <color_fragment>
        diffuseColor.rgb = mix(diffuseColor.rgb, patternInk, patternAt(vPaint));`);
  };
  return material;
}

/** Leaves out what is outside of the planes, hatches the rest both ways and draws its rim. */
function onlyWithin(shader: WebGLProgramParametersWithUniforms, within: readonly number[][]): void {
  shader.uniforms.within = {value: within.map((plane) => new Vector4(...plane))};
  shader.vertexShader = shader.vertexShader.replace('#include <common>', '#include <common>\nvarying vec3 vPlaced;')
    .replace('#include <begin_vertex>', '#include <begin_vertex>\nvPlaced = position;');
  shader.fragmentShader = shader.fragmentShader
    .replace('#include <common>', `#include <common>
      varying vec3 vPlaced; uniform vec4 within[${within.length}];`)
    .replace('#include <clipping_planes_fragment>', `#include <clipping_planes_fragment>
      float inner = 1e9;
      for (int i = 0; i < ${within.length}; ++i) inner = min(inner, dot(within[i], vec4(vPlaced, 1.0)));
      float rim = 1.0 - smoothstep(1.5, 2.5, abs(inner) / max(fwidth(inner), 1e-6) / ${scale()});
      if (inner < 0.0) discard;`)
    .replace('#include <color_fragment>', `#include <color_fragment>
      vec2 across = gl_FragCoord.xy / ${scale()};
      float hatch = max(step(mod(across.x + across.y, 9.0), 2.0), step(mod(across.x - across.y, 9.0), 2.0));
      diffuseColor.a *= max(0.35 + 0.65 * hatch, rim);`);
}

/**
 * Locked: stripes. May touch the plate: dots. Grasped by a handle: a tint. All with a rim; they differ without colour, too.
 * What is painted comes as a share of each kind, so that a triangle at the rim is of the one kind or of none.
 */
const patterns = () => `
  float patternAt(vec3 paint) {
    float most = max(paint.x, max(paint.y, paint.z));
    float rim = 1.0 - smoothstep(0.5, 1.5, abs(most - 0.5) / max(fwidth(most), 1e-6) / ${scale()});
    if (most < 0.01) return 0.0;
    if (most < 0.5) return rim;
    vec2 at = gl_FragCoord.xy / ${scale()};
    float inside = paint.x == most ? step(mod(at.x + at.y, 8.0), 3.0)
                 : paint.y == most ? step(length(mod(at, 7.0) - 3.5), 1.9) : 0.15;
    return max(inside, rim);
  }`;

/** Pixels of the canvas in one of the page. */
const scale = () => Math.min(window.devicePixelRatio, 2).toFixed(2);
