// @ts-check
// The shadow that a ground casts on itself, and how much of the sky each place sees: once a map, in a worker: it takes some 0.2 s, in which the picture is
// shown without shadows.

import { SUN } from './vectors.js';

const DIRECTIONS = 10;

/**
 * Two bytes a point of the grid: light of the sun (255 all, 0 full shadow) and of the sky.
 * @param {{domain: number[], columns: number, rows: number, grid: Float32Array, wraps?: boolean[]}} ground
 * @param {number} exaggeration of heights
 */
export function bake({ domain, columns, rows, grid, wraps = [] }, exaggeration) {
  const dx = (domain[2] - domain[0]) / (columns - 1), dy = (domain[3] - domain[1]) / (rows - 1);
  const heights = new Float32Array(columns * rows), light = new Uint8Array(2 * columns * rows);
  let highest = -Infinity;
  for (let k = 0; k < heights.length; k++) highest = Math.max(highest, heights[k] = grid[3 * k] * exaggeration);
  const loop = (v, n, on) => on ? v - Math.floor(v / n) * n : v;
  /** The height at a place of the grid; NaN outside. */
  const at = (x, y) => {
    x = loop(x, columns - 1, wraps[0]);
    y = loop(y, rows - 1, wraps[1]);
    if (!(x >= 0 && y >= 0 && x <= columns - 1 && y <= rows - 1)) return NaN;
    const i = Math.min(columns - 2, x | 0), j = Math.min(rows - 2, y | 0), k = j * columns + i, a = x - i;
    const low = heights[k] + (heights[k + 1] - heights[k]) * a;
    return low + (heights[k + columns] + (heights[k + columns + 1] - heights[k + columns]) * a - low) * (y - j);
  };
  const flat = Math.hypot(SUN[0], SUN[1]), rise = SUN[2] / flat, step = Math.min(dx, dy);
  const sunX = SUN[0] / flat * step / dx, sunY = SUN[1] / flat * step / dy;
  const longest = Math.max(columns, rows), reach = longest * .18;
  const ways = Array.from({ length: DIRECTIONS }, (_, d) => {
    const angle = d / DIRECTIONS * 2 * Math.PI + .3;
    return [Math.cos(angle) * step / dx, Math.sin(angle) * step / dy];
  });
  for (let j = 0, k = 0; j < rows; j++)
    for (let i = 0; i < columns; i++, k++) {
      const z = heights[k];
      let lit = .5;  // the sun is as wide as a slope of 1/5: what stands below the ray takes of it
      for (let s = 1.2; s < longest && lit > -.5; s *= 1.11) {
        const ray = z + s * step * rise;
        if (ray > highest) break;
        const ground = at(i + sunX * s, j + sunY * s);
        if (ground !== ground) break;
        lit = Math.min(lit, 5 * (ray - ground) / (s * step));
      }
      let open = 0;
      for (const [wx, wy] of ways) {
        let steepest = 0;
        for (let s = 1.5; s < reach; s *= 1.7) {
          const ground = at(i + wx * s, j + wy * s);
          if (ground !== ground) break;
          steepest = Math.max(steepest, (ground - z) / (s * step));
        }
        open += 1 - steepest / Math.sqrt(1 + steepest * steepest);
      }
      light[2 * k] = 255 * Math.max(0, Math.min(1, lit + .5));
      light[2 * k + 1] = 255 * Math.max(0, open / DIRECTIONS) ** 1.3;
    }
  return light;
}

// in a worker of its own this module answers with what it bakes
if (typeof document === 'undefined' && 'importScripts' in globalThis)
  self.onmessage = ({ data }) => {
    const light = bake(data.ground, data.exaggeration);
    self.postMessage({ number: data.number, light }, { transfer: [light.buffer] });
  };
