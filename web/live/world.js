// The map as it grows, in 3-D.
import {
  AmbientLight, BufferAttribute, BufferGeometry, Group, Line, LineBasicMaterial, LineSegments, Matrix4,
  PerspectiveCamera, Points, PointsMaterial, Scene, Vector3, WebGLRenderer,
} from 'three';
import { OrbitControls } from 'three/examples/jsm/controls/OrbitControls.js';

import { linear } from '../shared/colors.js';
import { colorOfLabel } from './messages.js';

/** The edges of what a camera sees, `depth` metres deep. */
function frustum(depth, color) {
  const x = 0.6 * depth, y = 0.45 * depth, corners = [[-x, -y], [x, -y], [x, y], [-x, y]], places = [];
  corners.forEach(([a, b], i) => {
    const [c, d] = corners[(i + 1) % 4];
    places.push(0, 0, 0, a, b, depth, a, b, depth, c, d, depth);
  });
  const geometry = new BufferGeometry().setAttribute('position', new BufferAttribute(new Float32Array(places), 3));
  const lines = new LineSegments(geometry, new LineBasicMaterial({ color }));
  lines.matrixAutoUpdate = false;
  return lines;
}

/** Shows clouds of key frames where the map has them, the way through them, and the camera. */
export class World {
  constructor(canvas) {
    this.renderer = new WebGLRenderer({ canvas, antialias: true, alpha: true });
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    this.scene = new Scene();
    this.scene.add(new AmbientLight());
    this.world = new Group();
    this.world.rotation.x = Math.PI;  // the first camera's y points down
    this.scene.add(this.world);
    this.eye = new PerspectiveCamera(55, 1, 0.02, 500);
    this.eye.position.set(-1.6, 1.4, 2.2);
    this.controls = new OrbitControls(this.eye, canvas);
    this.controls.target.set(0, 0, -1.5);
    this.controls.addEventListener('change', () => this.draw());
    this.clouds = new Map();  // by frame: {points, colors: {appearance, label}}
    this.poses = new Map();   // by frame: matrix
    this.byLabel = false;
    this.follows = true;
    this.camera = frustum(0.3, 0xe8590c);
    this.camera.visible = false;
    this.way = new Line(new BufferGeometry(), new LineBasicMaterial({ color: 0x1c7ed6 }));
    this.way.frustumCulled = false;
    this.world.add(this.camera, this.way);
  }

  resize(width, height) {
    if (width <= 0 || height <= 0) return;
    this.renderer.setSize(width, height, false);
    this.eye.aspect = width / height;
    this.eye.updateProjectionMatrix();
    this.draw();
  }

  addCloud({ frame, places, colors, labels }) {
    const geometry = new BufferGeometry().setAttribute('position', new BufferAttribute(places, 3));
    const looks = {
      appearance: new BufferAttribute(linear(colors), 3),
      label: new BufferAttribute(linear(Uint8Array.from([...labels].flatMap(colorOfLabel))), 3),
    };
    const points = new Points(geometry, new PointsMaterial({ size: 0.03, vertexColors: true }));
    points.matrixAutoUpdate = false;
    this.clouds.get(frame)?.points.removeFromParent();
    this.clouds.set(frame, { points, looks });
    this.world.add(points);
    this.paint(frame);
    this.place(frame);
    this.draw();
  }

  /** `poses`: [frame, 16 numbers of world_from_camera] of each key frame, by age. */
  setKeyframes(poses) {
    this.poses = new Map(poses.map(([frame, numbers]) => [frame, new Matrix4().fromArray(numbers)]));
    for (const frame of this.clouds.keys()) this.place(frame);
    const way = [...this.poses.values()].flatMap((pose) => new Vector3().setFromMatrixPosition(pose).toArray());
    this.way.geometry.dispose();
    this.way.geometry = new BufferGeometry().setAttribute('position', new BufferAttribute(new Float32Array(way), 3));
    this.draw();
  }

  /** `numbers`: of world_from_camera; undefined where it is not known. */
  setCamera(numbers) {
    this.camera.visible = numbers !== undefined;
    if (numbers === undefined) return this.draw();
    this.camera.matrix.fromArray(numbers);
    if (this.follows) this.follow();
    this.draw();
  }

  showLabels(byLabel) {
    this.byLabel = byLabel;
    for (const frame of this.clouds.keys()) this.paint(frame);
    this.draw();
  }

  /** Keeps looking at a place two metres before the camera. */
  follow() {
    const ahead = new Vector3(0, 0, 1.5).applyMatrix4(this.camera.matrix).applyEuler(this.world.rotation);
    const shift = ahead.sub(this.controls.target).multiplyScalar(0.2);
    this.controls.target.add(shift);
    this.eye.position.add(shift);
    this.controls.update();
  }

  paint(frame) {
    const { points, looks } = this.clouds.get(frame);
    points.geometry.setAttribute('color', this.byLabel ? looks.label : looks.appearance);
  }

  /** A cloud whose key frame is gone, or not yet known, is not shown. */
  place(frame) {
    const { points } = this.clouds.get(frame), pose = this.poses.get(frame);
    points.visible = pose !== undefined;
    if (pose) points.matrix.copy(pose);
  }

  /** Draws once in the next frame of the screen, however often it is asked. */
  draw() {
    if (this.waiting) return;
    this.waiting = true;
    requestAnimationFrame(() => {
      this.waiting = false;
      this.renderer.render(this.scene, this.eye);
    });
  }
}
