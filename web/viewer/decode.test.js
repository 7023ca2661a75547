import assert from 'node:assert/strict';
import test from 'node:test';

import { boundsOf, floatsOf, labelColors, placesOf, rgbOf } from './decode.js';

const base64 = (bytes) => Buffer.from(bytes).toString('base64');

test('floats are little-endian', () => {
  assert.deepEqual([...floatsOf(base64([0, 0, 128, 63, 0, 0, 0, 192]))], [1, -2]);
});

test('places are steps from the corner', () => {
  const part = { min: [1, 2, 3], step: [0.5, 1, 2], positions: base64([2, 0, 0, 1, 1, 0]) };
  assert.deepEqual([...placesOf(part)], [2, 258, 5]);
});

test('labels without a class have the colour of none', () => {
  const colors = labelColors(new Uint8Array([7, 255]), [{ id: 7, color: '#0a0b0c' }], '#ffffff');
  assert.deepEqual([...colors], [10, 11, 12, 255, 255, 255]);
  assert.deepEqual(rgbOf('#102030'), [16, 32, 48]);
});

test('bounds are those of all lists', () => {
  assert.deepEqual(boundsOf([[0, 1, 2], [-1, 5, 0]]), { min: [-1, 1, 0], max: [0, 5, 2] });
  assert.equal(boundsOf([[]]), null);
});
