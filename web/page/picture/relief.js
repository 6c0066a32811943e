// @ts-check
// What painting a ground needs to know of it as a whole; as client/ground/relief does it.
import { clamp, mix } from './vectors.js';

/**
 * The ground as Picture.setGround takes it: `grid` holds z, zx and zy of columns x rows points over the domain
 * [x0, y0, x1, y1], rows from y0 up; heights in metres.
 * @typedef {{domain: number[], columns: number, rows: number, grid: Float32Array, wraps?: boolean[],
 *   centre?: any, edges?: 'walls' | 'wrap' | 'open'}} GroundData
 */

/** The end of the slopes' colours: so many times what 5 % of the map exceed. */
export const STEEPEST = 1.25;

/** The least of 1, 2, 5, 10, ... times a power of ten that is `least` or more. @param {number} least above 0 */
export function roundStep(least) {
  const power = 10 ** Math.floor(Math.log10(least));
  return [1, 2, 5].map(digit => digit * power).find(step => step >= least) ?? 10 * power;
}

/** v from 0 to n, as going round brings it there. @param {number} v @param {number} n */
const loop = (v, n) => v - Math.floor(v / n) * n;

export class Relief {
  /** @param {GroundData} ground */
  constructor(ground) {
    const { domain, columns, rows, grid } = ground, count = columns * rows;
    if (grid.length < 3 * count || columns < 2 || rows < 2) throw new Error('a grid is too small');
    this.ground = ground;
    this.width = domain[2] - domain[0];
    this.depth = domain[3] - domain[1];
    /** Half of the diagonal over the map [m]. */
    this.radius = Math.hypot(this.width, this.depth) / 2;
    const heights = new Float32Array(count), slopes = new Float32Array(count);
    let rim = 0, rims = 0, middle = 0, middles = 0;
    for (let j = 0, k = 0; j < rows; j++)
      for (let i = 0; i < columns; i++, k++) {
        const z = heights[k] = grid[3 * k];
        slopes[k] = Math.hypot(grid[3 * k + 1], grid[3 * k + 2]);
        if (i === 0 || j === 0 || i === columns - 1 || j === rows - 1) rim += z, rims++;
        if (3 * i > columns && 3 * i < 2 * columns && 3 * j > rows && 3 * j < 2 * rows) middle += z, middles++;
      }
    heights.sort();
    slopes.sort();
    this.heights = heights;
    this.lowest = heights[0];
    this.highest = heights[count - 1];
    const extent = Math.min(this.width, this.depth);
    /** A map without heights: what of them differs is rounding. */
    this.isFlat = this.highest - this.lowest < 1e-6 * (extent + Math.abs(this.highest));
    if (this.isFlat) this.highest = this.lowest + extent * 1e-3;
    const range = this.highest - this.lowest;
    /** The gradient's length that 5 % of the map exceed. */
    this.steep = Math.max(slopes[Math.floor(count * .95)], 1e-9);
    /** How many times too high the ground is drawn, 1 to 2: a low map still shows its form. */
    this.exaggeration = this.isFlat ? 1 : clamp(.3 * extent / range, 1, 2);
    /** -1 to 1: how much higher the rim lies than the middle; above 0.2 a pot. */
    this.potness = this.isFlat ? 0 : clamp((rim / rims - middle / middles) / range, -1, 1);
    /** Metres of height between two contours; some 14 of them, one of five strong. 0: none. */
    this.interval = this.isFlat ? 0 : roundStep(range / 16);
    /** The width of a flat map's tiles [m]. */
    this.tile = roundStep(extent / 12);
  }

  /** Where a height stands on the colour ramp, 0 to 1: by height, and by how much of the map lies below. @param {number} z */
  tone(z) {
    if (this.isFlat) return this.ground.centre ? .07 : .4;  // a meadow; where something pulls, the dark of space
    const { heights, lowest, highest } = this;
    /** How many lie below, or are not above. */
    const count = isAbove => {
      let low = 0, high = heights.length;
      while (low < high) {
        const at = low + high >> 1;
        if (isAbove(heights[at])) high = at; else low = at + 1;
      }
      return low;
    };
    // a plain is as high as the middle of it
    const below = (count(h => h >= z) + count(h => h > z)) / 2;
    return .45 * clamp((z - lowest) / (highest - lowest), 0, 1) + .55 * below / heights.length;
  }

  /** The drawn ground's height at a place, without exaggeration; beyond the edge the edge's, or of a map that wraps the other one's. @param {number} x @param {number} y */
  heightAt(x, y) {
    const { domain, columns, rows, grid, wraps = [] } = this.ground;
    if (wraps[0]) x = domain[0] + loop(x - domain[0], this.width);
    if (wraps[1]) y = domain[1] + loop(y - domain[1], this.depth);
    const u = clamp((x - domain[0]) / this.width, 0, 1) * (columns - 1), i = Math.min(columns - 2, Math.floor(u));
    const v = clamp((y - domain[1]) / this.depth, 0, 1) * (rows - 1), j = Math.min(rows - 2, Math.floor(v));
    const k = 3 * (j * columns + i), up = 3 * columns;
    return mix(mix(grid[k], grid[k + 3], u - i), mix(grid[k + up], grid[k + up + 3], u - i), v - j);
  }

  /** Where a place is nearest to another, beyond an edge where the map wraps. @param {number[]} a @param {number[]} b */
  nearest(a, b) {
    const { wraps = [] } = this.ground;
    return [this.width, this.depth].map((n, k) => wraps[k] ? b[k] - Math.round((b[k] - a[k]) / n) * n : b[k]);
  }

  /** What the camera must know: the middle, and places that have to be in the picture. @param {number} bottom of the block, as drawn [m] */
  stage(bottom) {
    const { domain, columns, rows, grid } = this.ground, E = this.exaggeration;
    const heightAt = (x, y) => this.heightAt(x, y) * E;
    /** @type {import('./vectors.js').Vector[]} */
    const corners = [];
    for (let k = 0; k <= 8; k++) {
      const x = domain[0] + this.width * k / 8, y = domain[1] + this.depth * k / 8;
      for (const [px, py] of [[x, domain[1]], [x, domain[3]], [domain[0], y], [domain[2], y]]) corners.push([px, py, heightAt(px, py)]);
    }
    for (const x of [domain[0], domain[2]]) for (const y of [domain[1], domain[3]]) corners.push([x, y, bottom]);
    let top = 0;
    for (let k = 0; k < columns * rows; k++) if (grid[3 * k] > grid[3 * top]) top = k;
    corners.push([domain[0] + top % columns / (columns - 1) * this.width, domain[1] + Math.floor(top / columns) / (rows - 1) * this.depth, grid[3 * top] * E + this.radius * .05]);
    return {
      centre: /** @type {import('./vectors.js').Vector} */ ([(domain[0] + domain[2]) / 2, (domain[1] + domain[3]) / 2, (this.lowest + (this.highest - this.lowest) * .35) * E]),
      radius: this.radius, corners, isPot: this.potness > .2, heightAt, size: this.radius * .02, nearest: (a, b) => this.nearest(a, b),
    };
  }
}

/** How low the underside of the block is [m]. @param {import('./relief.js').Relief} relief */
export const bottomOf = relief => relief.lowest - .07 * (relief.highest - relief.lowest) - .045 * relief.radius / relief.exaggeration;
