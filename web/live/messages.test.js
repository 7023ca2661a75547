import assert from 'node:assert/strict';
import test from 'node:test';

import { cloudOf, colorOfLabel, describe, kindOf } from './messages.js';

test('a cloud is read as it is written', () => {
  const bytes = new Uint8Array([67, 0, 0, 0, 7, 1, 0, 0, 1, 0, 0, 0, 232, 3, 24, 252, 208, 7, 10, 20, 30, 255]);
  assert.equal(kindOf(bytes.buffer), 'C');
  const cloud = cloudOf(bytes.buffer);
  assert.equal(cloud.frame, 263);
  assert.deepEqual([...cloud.places], [1, -1, 2]);
  assert.deepEqual([...cloud.colors], [10, 20, 30]);
  assert.deepEqual([...cloud.labels], [255]);
});

test('labels have colours of their own', () => {
  const colors = new Set(Array.from({ length: 80 }, (_, i) => colorOfLabel(i).join()));
  assert.equal(colors.size, 80);
  assert.deepEqual(colorOfLabel(255), [150, 150, 150]);
});

test('a state says how many frames there are only where that is known', () => {
  const state = { frames_done: 3, frames_per_s: 9.96, inliers: 1, keyframes: 2, landmarks: 4, masked_share: 0.125 };
  assert.deepEqual(describe(state).map(([, text]) => text), ['3', '10.0 frames/s', '1', '2', '4', '12.5 %']);
  assert.equal(describe({ ...state, frames: 9 })[0][1], '3 of 9');
});
