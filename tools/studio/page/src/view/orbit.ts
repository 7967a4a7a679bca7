import {MathUtils, Spherical, Vector3} from 'three';

/** The way from what is looked at to the eye, after the eye went round it: degrees to the right and up, z being up; never over the top. */
export function orbited(way: Vector3, right_deg: number, up_deg: number): Vector3 {
  const at = new Spherical().setFromVector3(new Vector3(way.x, way.z, -way.y)); // whose pole is y
  at.theta += MathUtils.degToRad(right_deg);
  at.phi -= MathUtils.degToRad(up_deg);
  const {x, y, z} = new Vector3().setFromSpherical(at.makeSafe());
  return new Vector3(x, -z, y);
}
