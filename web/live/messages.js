// Reads what the program tells the page: src/ofm/view/live_messages.h writes it.

/** The type of a binary message: its first letter. */
export const kindOf = (buffer) => String.fromCharCode(new Uint8Array(buffer, 0, 1)[0]);

/** The JPEG of an image message. */
export const jpegOf = (buffer) => new Blob([new Uint8Array(buffer, 4)], { type: 'image/jpeg' });

/** A key frame's cloud: {frame, places [m] (xyz in turn, in the camera's frame), colors (rgb in turn), labels}. */
export function cloudOf(buffer) {
  const view = new DataView(buffer);
  const frame = view.getUint32(4, true), count = view.getUint32(8, true);
  const places = new Float32Array(3 * count), colors = new Uint8Array(3 * count), labels = new Uint8Array(count);
  for (let i = 0; i < 3 * count; ++i) places[i] = view.getInt16(12 + 2 * i, true) / 1000;
  const start = 12 + 6 * count;
  for (let i = 0; i < count; ++i) {
    for (let channel = 0; channel < 3; ++channel) colors[3 * i + channel] = view.getUint8(start + 4 * i + channel);
    labels[i] = view.getUint8(start + 4 * i + 3);
  }
  return { frame, places, colors, labels };
}

/** Red, green, blue (0 to 255) by which a label is known: far apart in hue for neighbours; grey for none. */
export function colorOfLabel(label) {
  if (label === 255) return [150, 150, 150];
  const hue = (label * 137.508) % 360;
  const channel = (n) => {
    const k = (n + hue / 30) % 12;
    return Math.round(255 * (0.55 - 0.4 * Math.max(-1, Math.min(k - 3, 9 - k, 1))));
  };
  return [channel(0), channel(8), channel(4)];
}

/** The numbers of a state as [name, text] for people. */
export function describe(state) {
  const whole = state.frames ? ` of ${state.frames}` : '';
  return [
    ['frame', `${state.frames_done}${whole}`],
    ['pace', `${state.frames_per_s.toFixed(1)} frames/s`],
    ['landmarks in the pose', `${state.inliers}`],
    ['key frames', `${state.keyframes}`],
    ['landmarks', `${state.landmarks}`],
    ['masked', `${(100 * state.masked_share).toFixed(1)} %`],
  ];
}
