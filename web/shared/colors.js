import { Color, SRGBColorSpace } from 'three';

/** Colours as the renderer wants them: rgb in turn, 0 to 255, become linear ones, 0 to 1. */
export function linear(bytes) {
  const color = new Color(), values = new Float32Array(bytes.length);
  for (let i = 0; i < bytes.length; i += 3) {
    color.setRGB(bytes[i] / 255, bytes[i + 1] / 255, bytes[i + 2] / 255, SRGBColorSpace).toArray(values, i);
  }
  return values;
}
