// The report's view of the map in 3-D. Reads #scene-data, fills #viewer.
import { AmbientLight, DirectionalLight, PerspectiveCamera, Scene, Vector3, WebGLRenderer } from 'three';
import { OrbitControls } from 'three/examples/jsm/controls/OrbitControls.js';

import { makeControls } from './controls.js';
import { boundsOf } from './decode.js';
import { makeCloud, makePath, makeVoxels } from './layers.js';

/** The drawable layers of one run. */
function makeRun(run, scene) {
  const layers = {};
  if (run.cloud) layers.cloud = makeCloud(run.cloud, scene);
  if (run.voxels) layers.voxels = makeVoxels(run.voxels, scene);
  if (run.trajectory) layers.trajectory = makePath(run.trajectory, run.color, 3);
  if (scene.truth) layers.truth = makePath(scene.truth, scene.truth_color, 2);
  return layers;
}

/** Looks at the middle of the bounds from above, and from where the camera was that saw them. */
function frameView(camera, controls, bounds, viewpoint) {
  const min = new Vector3(...bounds.min), max = new Vector3(...bounds.max);
  const middle = min.clone().add(max).multiplyScalar(0.5);
  const radius = Math.max(0.5, 0.5 * max.distanceTo(min));
  const up = camera.up.clone().normalize();
  const aside = viewpoint ? new Vector3(...viewpoint).sub(middle) : new Vector3(1, 0.35, 0.2);
  aside.addScaledVector(up, -aside.dot(up)).normalize();
  camera.position.copy(middle).addScaledVector(aside, 1.45 * radius).addScaledVector(up, 1.2 * radius);
  camera.near = 0.005 * radius;
  camera.far = 20 * radius;
  camera.updateProjectionMatrix();
  controls.target.copy(middle);
  controls.update();
}

/** The places that matter for the view: without the few that lie far out. */
function trimmed(places) {
  const sorted = [0, 1, 2].map((axis) => {
    const values = [];
    for (let i = axis; i < places.length; i += 3) values.push(places[i]);
    return values.sort((a, b) => a - b);
  });
  const at = (share) => sorted.map((values) => values[Math.floor(share * (values.length - 1))]);
  return places.length === 0 ? [] : [...at(0.02), ...at(0.98)];
}

class Viewer {
  constructor(element, data) {
    this.element = element;
    this.scene = new Scene();
    this.camera = new PerspectiveCamera(50, 1, 0.01, 100);
    this.camera.up.set(...data.up);
    this.renderer = new WebGLRenderer({ antialias: true, alpha: true });
    this.renderer.setPixelRatio(Math.min(window.devicePixelRatio, 2));
    this.canvas = this.renderer.domElement;
    this.canvas.setAttribute('role', 'img');
    this.canvas.setAttribute('aria-label', element.dataset.label);
    this.canvas.tabIndex = 0;
    element.querySelector('.stage').replaceChildren(this.canvas);
    this.controls = new OrbitControls(this.camera, this.canvas);
    this.controls.listenToKeyEvents(this.canvas);
    this.controls.addEventListener('change', () => this.draw());
    this.addLight(data.up);
    this.runs = data.runs.map((run) => makeRun(run, data));
    for (const layers of this.runs) {
      for (const layer of Object.values(layers)) this.scene.add(layer.object);
    }
    this.addControls(data);
    new ResizeObserver(() => this.resize()).observe(element.querySelector('.stage'));
    this.apply();
    this.resize();
    this.reset();
  }

  addLight(up) {
    const sun = new DirectionalLight(0xffffff, 2);
    sun.position.set(up[0] + 0.4, up[1] + 0.3, up[2] + 0.5);
    this.scene.add(new AmbientLight(0xffffff, 1.6), sun);
  }

  addControls(data) {
    const available = ['cloud', 'voxels', 'trajectory', 'truth'].filter((name) =>
      this.runs.some((layers) => layers[name]));
    const show = { cloud: true, voxels: !available.includes('cloud'), trajectory: true, truth: true };
    this.state = { run: 0, show, color: 'appearance' };
    makeControls(this.element.querySelector('.switches'), this.state, available,
      data.runs.map((run) => run.name), () => this.apply(), () => this.reset());
  }

  apply() {
    this.runs.forEach((layers, i) => {
      for (const [name, layer] of Object.entries(layers)) {
        layer.object.visible = i === this.state.run && this.state.show[name] && layer.places.length > 0;
        if (layer.recolor && layer.object.visible) layer.recolor(this.state.color);
      }
    });
    this.draw();
  }

  reset() {
    const layers = this.runs[this.state.run];
    const bounds = boundsOf(Object.values(layers).map((layer) => trimmed(layer.places)));
    const path = layers.cloud && layers.trajectory ? layers.trajectory.places : [];
    frameView(this.camera, this.controls, bounds ?? { min: [-1, -1, -1], max: [1, 1, 1] },
      path.length > 0 ? path.slice(0, 3) : null);
    this.draw();
  }

  resize() {
    const { clientWidth, clientHeight } = this.element.querySelector('.stage');
    if (clientWidth === 0 || clientHeight === 0) return;
    this.renderer.setSize(clientWidth, clientHeight);
    this.camera.aspect = clientWidth / clientHeight;
    this.camera.updateProjectionMatrix();
    this.draw();
  }

  /** Draws once, with the browser's next picture. */
  draw() {
    if (this.waiting) return;
    this.waiting = requestAnimationFrame(() => {
      this.waiting = 0;
      this.renderer.render(this.scene, this.camera);
      const { points, triangles } = this.renderer.info.render;
      this.element.dataset.drawn = `${points} points, ${triangles} triangles`;
    });
  }
}

const element = document.getElementById('viewer');
const data = document.getElementById('scene-data');
if (element && data) {
  try {
    new Viewer(element, JSON.parse(data.textContent));
  } catch (error) {
    element.querySelector('.stage').textContent =
      `The view needs a browser with WebGL 2, which this one does not offer (${error.message}).`;
  }
}
