import {Box3, DirectionalLight, HemisphereLight, PerspectiveCamera, Scene, Sphere, Vector3, WebGLRenderer} from 'three';
import {OrbitControls} from 'three/addons/controls/OrbitControls.js';

import type {Inks} from './inks';
import {orbited} from './orbit';

export type Side = 'corner' | 'front' | 'right' | 'top';

const looks: Record<Side, Vector3> = {
  corner: new Vector3(0.42, -1, 0.34), front: new Vector3(0, -1, 0.001), right: new Vector3(1, 0, 0.001),
  top: new Vector3(0, -0.001, 1),
};

/** Canvas, camera and light. Draws when asked to and not otherwise: a page at rest costs nothing. */
export class Stage {
  readonly scene = new Scene();
  readonly camera = new PerspectiveCamera(28, 1, 1, 10_000);
  readonly renderer: WebGLRenderer;
  readonly controls: OrbitControls;
  /** Called before each picture, such as for what keeps its size on the screen. */
  readonly beforeDraw = new Set<() => void>();
  readonly afterDraw = new Set<() => void>();
  readonly #sun = new DirectionalLight(0xffffff, 1.9);
  /** Without a model nothing is drawn: the page invites to open one. */
  hasModel = false;
  #asked = false;
  #held = '';

  constructor(readonly canvas: HTMLCanvasElement) {
    this.renderer = new WebGLRenderer({canvas, antialias: !drawsInSoftware(), stencil: true});
    this.renderer.setPixelRatio(Math.min(window.devicePixelRatio, 2));
    this.renderer.localClippingEnabled = true;
    this.renderer.debug.checkShaderErrors = import.meta.env.DEV; // to ask for them is to wait for the compiler
    this.camera.up.set(0, 0, 1);
    this.camera.add(this.#sun);
    this.#sun.position.set(-0.6, 0.8, 0.7);
    this.scene.add(this.camera, new HemisphereLight(0xffffff, 0x9a968e, 2.0));
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.zoomToCursor = true;
    this.controls.addEventListener('change', () => this.invalidate());
    canvas.addEventListener('webglcontextrestored', () => this.invalidate());
    new ResizeObserver(() => this.#fit()).observe(canvas.parentElement as HTMLElement);
    this.#fit();
  }

  invalidate(): void {
    if (this.#asked || !this.hasModel) return;
    this.#asked = true;
    requestAnimationFrame(() => {
      this.#asked = false;
      for (const before of this.beforeDraw) before();
      this.renderer.render(this.scene, this.camera);
      this.#tellMemory();
      for (const after of this.afterDraw) after();
    });
  }

  /** Says what WebGL holds, where that has changed, for who measures (User Timing). */
  #tellMemory(): void {
    const {geometries, textures} = this.renderer.info.memory, held = `${geometries} geometries, ${textures} textures`;
    if (held === this.#held) return;
    this.#held = held;
    performance.clearMarks('aplomb-held');
    performance.mark('aplomb-held', {detail: {geometries, textures}});
  }

  paint(inks: Inks): void {
    this.renderer.setClearColor(inks.room);
    this.invalidate();
  }

  /** Looks at a box such that all of it is in view: from one side, or from where one looks already. */
  look(box: Box3, side: Side | null): void {
    if (box.isEmpty()) return;
    const ball = box.getBoundingSphere(new Sphere());
    const half = Math.min(this.camera.fov, this.camera.fov * this.camera.aspect) * (Math.PI / 360);
    const distance = (ball.radius * 1.03) / Math.sin(half);
    const way = side ? looks[side].clone() : this.camera.position.clone().sub(this.controls.target);
    this.controls.target.copy(ball.center);
    this.camera.position.copy(way).normalize().multiplyScalar(distance).add(ball.center);
    this.camera.near = distance / 100;
    this.camera.far = distance * 20;
    this.camera.updateProjectionMatrix();
    this.controls.minDistance = distance / 40;
    this.controls.maxDistance = distance * 6;
    this.controls.update();
    this.invalidate();
  }

  /** Goes round what is looked at, by degrees to the right and up. */
  orbit(right_deg: number, up_deg: number): void {
    const way = this.camera.position.clone().sub(this.controls.target);
    this.camera.position.copy(orbited(way, right_deg, up_deg)).add(this.controls.target);
    this.controls.update();
  }

  /** Millimetres that a pixel of the page covers at a point. */
  mmPerPixel(at: Vector3): number {
    const depth = at.clone().applyMatrix4(this.camera.matrixWorldInverse).z;
    return (2 * -depth * Math.tan((this.camera.fov * Math.PI) / 360)) / Math.max(1, this.canvas.clientHeight);
  }

  /** Where a point is in the canvas, in pixels of the page; null behind the camera. */
  onScreen(at: Vector3): {x: number; y: number} | null {
    const seen = at.clone().project(this.camera);
    if (seen.z > 1) return null;
    return {x: ((seen.x + 1) / 2) * this.canvas.clientWidth, y: ((1 - seen.y) / 2) * this.canvas.clientHeight};
  }

  #fit(): void {
    const room = this.canvas.parentElement as HTMLElement;
    const width = Math.max(1, room.clientWidth), height = Math.max(1, room.clientHeight);
    this.renderer.setSize(width, height);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    this.invalidate();
  }
}

/** Without a graphics card smooth edges cost as much as all the rest: 100 ms a picture of 50k triangles on two busy cores. */
function drawsInSoftware(): boolean {
  const gl = document.createElement('canvas').getContext('webgl2');
  const name = gl?.getExtension('WEBGL_debug_renderer_info') ? String(gl.getParameter(0x9246)) : '';
  gl?.getExtension('WEBGL_lose_context')?.loseContext();
  return /swiftshader|llvmpipe|software/i.test(name);
}
