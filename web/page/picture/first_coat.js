// @ts-check
// How a ground looks before it is painted well: the colours of its grid's points and the light on them, without shadows and grain,
// as the shader `paint` mixes them (shaders.js). Some 5 ms here; where a processor draws the shader is not even compiled after 100.
import { along } from './colours.js';
import { STEEPEST } from './relief.js';
import { SUN } from './vectors.js';

const SKY_LIGHT = [.30, .38, .52], SUN_LIGHT = [1.18, 1.06, .88];
const BRIGHT = .66;  // from here on light is pressed together, lest it burns out

/** 256 colours by height, then by slope, four bytes each. @param {import('./relief.js').Relief} relief @param {typeof import('./colours.js').THEMES['dark']} look */
export function rampsOf(relief, look) {
  const ramps = new Uint8Array(2 * 256 * 4), range = relief.highest - relief.lowest;
  const tones = Float64Array.from({ length: 256 }, (_, k) => relief.tone(relief.lowest + range * k / 255));
  for (let k = 0; k < 256; k++) {
    // of what lies about as high, lest plains have hard edges
    let tone = 0;
    for (let d = -6; d <= 6; d++) tone += tones[Math.max(0, Math.min(255, k + d))] / 13;
    ramps.set(along(look.height, tone).map(v => 255 * v), 4 * k);
    ramps.set(along(look.slope, k / 255).map(v => 255 * v), 4 * (256 + k));
  }
  return ramps;
}

/**
 * Four bytes a point of the grid.
 * @param {import('./relief.js').Relief} relief
 * @param {Uint8Array} ramps rampsOf(), as the shader has them
 * @param {boolean} slope whether it is coloured by how steep it is
 * @param {number} sun how strong the light is
 */
export function firstCoat(relief, ramps, slope, sun) {
  const { grid, columns, rows } = relief.ground, count = columns * rows, painted = new Uint8Array(4 * count);
  const E = relief.exaggeration, range = relief.highest - relief.lowest, place = v => 4 * Math.round(255 * Math.max(0, Math.min(1, v)));
  for (let k = 0; k < count; k++) {
    const zx = grid[3 * k + 1], zy = grid[3 * k + 2], up = 1 / Math.hypot(zx * E, zy * E, 1);
    const facing = Math.max(0, (SUN[2] - zx * E * SUN[0] - zy * E * SUN[1]) * up);
    const at = slope ? 1024 + place(Math.hypot(zx, zy) / (relief.steep * STEEPEST)) : place(relief.isFlat ? .4 : (grid[3 * k] - relief.lowest) / range);
    for (let c = 0; c < 3; c++) {
      let lit = (ramps[at + c] / 255) ** 2 * (SKY_LIGHT[c] * (.72 + .28 * up) + SUN_LIGHT[c] * facing) * sun;
      if (lit > BRIGHT) lit = BRIGHT + (1 - BRIGHT) * (1 - Math.exp((BRIGHT - lit) / (1 - BRIGHT)));
      painted[4 * k + c] = 255 * Math.sqrt(lit);
    }
    painted[4 * k + 3] = 255;
  }
  return painted;
}
