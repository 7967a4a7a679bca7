import {Color, FrontSide, MeshLambertMaterial, type Plane, type Side} from 'three';

/** The matter of the model: round where the surface is, sharp at edges, with painted regions as patterns. */
export function clay(color: Color, options: {opacity?: number; side?: Side; clip?: Plane[]} = {}): MeshLambertMaterial {
  const {opacity = 1, side = FrontSide, clip = []} = options;
  const material = new MeshLambertMaterial({
    color, side, clippingPlanes: clip, transparent: opacity < 1, opacity, depthWrite: opacity === 1,
  });
  const ink = {value: new Color(0x000000)};
  material.userData.patternInk = ink;
  material.onBeforeCompile = (shader) => {
    shader.uniforms.patternInk = ink;
    shader.vertexShader = shader.vertexShader
      .replace('#include <common>', `#include <common>
        attribute float crease; attribute float paint; varying float vCrease; varying float vPaint; varying vec3 vPlaced;`)
      .replace('#include <begin_vertex>', `#include <begin_vertex>
        vCrease = crease; vPaint = paint; vPlaced = position;`);
    shader.fragmentShader = shader.fragmentShader
      .replace('#include <common>', `#include <common>
        varying float vCrease; varying float vPaint; varying vec3 vPlaced; uniform vec3 patternInk;${patterns}`)
      .replace('#include <normal_fragment_begin>', `#include <normal_fragment_begin>
        vec3 facet = normalize(cross(dFdx(vViewPosition), dFdy(vViewPosition)));
        normal = normalize(mix(normal, facet, smoothstep(0.0, 0.6, vCrease)));`)
      .replace('#include <color_fragment>', `#include <color_fragment>
        diffuseColor.rgb = mix(diffuseColor.rgb, patternInk, patternAt(vPaint));`);
  };
  return material;
}

/** Locked: stripes. May touch the plate: dots. Grasped by a handle: a tint with a rim. They differ without colour, too. */
const patterns = `
  float patternAt(float paint) {
    if (paint < 0.5) return 0.0;
    vec2 at = gl_FragCoord.xy;
    if (paint < 1.5) return 0.22 + 0.5 * step(mod(at.x + at.y, 8.0), 2.5);
    if (paint < 2.5) return 0.15 + 0.6 * step(length(mod(at, 7.0) - 3.5), 1.7);
    return 0.3;
  }`;
