// What is drawn of a run: its cloud, its octree and its trajectory.
import {
  BoxGeometry, BufferAttribute, BufferGeometry, InstancedBufferAttribute, InstancedMesh, Matrix4,
  MeshLambertMaterial, Points, PointsMaterial,
} from 'three';
import { Line2 } from 'three/examples/jsm/lines/Line2.js';
import { LineGeometry } from 'three/examples/jsm/lines/LineGeometry.js';
import { LineMaterial } from 'three/examples/jsm/lines/LineMaterial.js';

import { linear } from '../shared/colors.js';
import { bytesOf, floatsOf, labelColors, placesOf } from './decode.js';

/** Both colourings of points or voxels. */
function coloursOf(part, scene) {
  return {
    appearance: linear(bytesOf(part.colors)),
    label: linear(labelColors(bytesOf(part.labels), scene.classes, scene.none_color)),
  };
}

/** A cloud: {object, places, recolor(kind)}. */
export function makeCloud(part, scene) {
  const places = placesOf(part), colours = coloursOf(part, scene);
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(places, 3));
  const attribute = new BufferAttribute(colours.appearance.slice(), 3);
  geometry.setAttribute('color', attribute);
  const material = new PointsMaterial({ size: 1.25 * part.spacing_m, vertexColors: true });
  const recolor = (kind) => { attribute.array.set(colours[kind]); attribute.needsUpdate = true; };
  return { object: new Points(geometry, material), places, recolor };
}

/** An octree's occupied leaves as boxes. */
export function makeVoxels(part, scene) {
  const places = placesOf(part), colours = coloursOf(part, scene), sizes = bytesOf(part.sizes);
  const mesh = new InstancedMesh(new BoxGeometry(), new MeshLambertMaterial(), sizes.length);
  const matrix = new Matrix4();
  sizes.forEach((exponent, i) => {
    const side = 0.96 * part.resolution_m * 2 ** exponent;
    matrix.makeScale(side, side, side).setPosition(places[3 * i], places[3 * i + 1], places[3 * i + 2]);
    mesh.setMatrixAt(i, matrix);
  });
  // They stand along the axes of the run's own world.
  const world = new Matrix4().set(...part.report_from_run, 0, 0, 0, 1);
  mesh.applyMatrix4(world);
  mesh.instanceColor = new InstancedBufferAttribute(colours.appearance.slice(), 3);
  new BufferAttribute(places, 3).applyMatrix4(world);  // for the view's bounds
  const recolor = (kind) => {
    mesh.instanceColor.array.set(colours[kind]);
    mesh.instanceColor.needsUpdate = true;
  };
  return { object: mesh, places, recolor };
}

/** A path of the camera, `width` pixels wide. */
export function makePath(base64, color, width) {
  const places = floatsOf(base64);
  const geometry = new LineGeometry();
  if (places.length >= 6) geometry.setPositions(places);
  const object = new Line2(geometry, new LineMaterial({ color, linewidth: width }));
  object.visible = places.length >= 6;
  return { object, places };
}
