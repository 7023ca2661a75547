// The scene's binary parts: little-endian numbers as base64 text.

/** The bytes of base64 text. */
export function bytesOf(base64) {
  const text = atob(base64);
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
  return bytes;
}

/** Places [m], xyz in turn, of a trajectory's 32-bit floats. */
export function floatsOf(base64) {
  const bytes = bytesOf(base64);
  const view = new DataView(bytes.buffer);
  return Float32Array.from({ length: bytes.length / 4 }, (_, i) => view.getFloat32(4 * i, true));
}

/** Places [m], xyz in turn, of 16-bit numbers that count steps from the least corner. */
export function placesOf(part) {
  const bytes = bytesOf(part.positions);
  const view = new DataView(bytes.buffer);
  return Float32Array.from({ length: bytes.length / 2 }, (_, i) =>
    part.min[i % 3] + part.step[i % 3] * view.getUint16(2 * i, true));
}

/** Red, green and blue, 0 to 255, of "#rrggbb". */
export function rgbOf(hex) {
  return [1, 3, 5].map((i) => parseInt(hex.slice(i, i + 2), 16));
}

/** Colours by label, rgb in turn: each label's own, or `none`. */
export function labelColors(labels, classes, none) {
  const table = new Map(classes.map((entry) => [entry.id, rgbOf(entry.color)]));
  const fallback = rgbOf(none);
  const colors = new Uint8Array(3 * labels.length);
  labels.forEach((label, i) => colors.set(table.get(label) ?? fallback, 3 * i));
  return colors;
}

/** The box around all places: {min, max}; null where there are none. */
export function boundsOf(lists) {
  const min = [Infinity, Infinity, Infinity], max = [-Infinity, -Infinity, -Infinity];
  for (const places of lists) {
    for (let i = 0; i < places.length; ++i) {
      min[i % 3] = Math.min(min[i % 3], places[i]);
      max[i % 3] = Math.max(max[i % 3], places[i]);
    }
  }
  return min[0] <= max[0] ? { min, max } : null;
}
