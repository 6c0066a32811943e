// @ts-check
// The woodlouse: seven plates, a head, two feelers, fourteen legs, its half length 1, x forward, z up.
import { cross, minus, unit } from './vectors.js';

/** Parts, as the shader tells them. */
const PLATE = 0, LEG = 1, FEELER = 2, HEAD = 3, EYE = 4;
const WIDE = .58, HIGH = .5, PLATES = 7;

/** Four numbers of a place (the last its part), three of a normal; triangles. @typedef {{places: Float32Array, normals: Float32Array, triangles: Uint16Array}} Mesh */

class Maker {
  constructor() {
    this.places = [];
    this.normals = [];
    this.triangles = [];
  }
  get count() {
    return this.normals.length / 3;
  }
  vertex(place, normal, part) {
    this.places.push(...place, part);
    this.normals.push(...unit(normal));
  }
  /** A grid of vertices, rows x columns. */
  sheet(rows, columns, at) {
    const first = this.count;
    for (let i = 0; i < rows; i++) for (let j = 0; j < columns; j++) at(i, j);
    for (let i = 0; i + 1 < rows; i++)
      for (let j = 0; j + 1 < columns; j++) {
        const k = first + i * columns + j;
        this.triangles.push(k, k + columns, k + 1, k + 1, k + columns, k + columns + 1);
      }
  }
  /** A thin triangular pipe along points, each [x, y, z, thickness]. */
  pipe(points, part) {
    this.sheet(points.length, 4, (i, j) => {
      const p = points[i], way = unit(minus(points[Math.min(i + 1, points.length - 1)], points[Math.max(i - 1, 0)]));
      const side = unit(cross(way, [0, 0, 1])), up = cross(side, way), a = j / 3 * 2 * Math.PI;
      const n = [0, 1, 2].map(c => side[c] * Math.cos(a) + up[c] * Math.sin(a));
      this.vertex([0, 1, 2].map(c => p[c] + n[c] * p[3]), n, part);
    });
  }
  /** A ball, or a part of one. */
  ball(x, y, z, sx, sy, sz, rows, columns, part) {
    this.sheet(rows + 1, columns + 1, (i, j) => {
      const a = Math.PI * i / rows, b = 2 * Math.PI * j / columns;
      const n = [Math.cos(a), Math.sin(a) * Math.cos(b), Math.sin(a) * Math.sin(b)];
      this.vertex([x + n[0] * sx, y + n[1] * sy, z + n[2] * sz], [n[0] / sx, n[1] / sy, n[2] / sz], part);
    });
  }
  /** @returns {Mesh} */
  done() {
    return { places: new Float32Array(this.places), normals: new Float32Array(this.normals), triangles: new Uint16Array(this.triangles) };
  }
}

/** How wide and high it is at x, of the most. */
const girth = x => (1 - Math.min(1, Math.abs(x)) ** 2.7) ** .48;

/** The back as one sheet; at[i]: [x, how far it stands off]. */
function back(maker, rows, across) {
  maker.sheet(rows.length, across + 1, (i, j) => {
    const [x, off] = rows[i], r = Math.max(.02, girth(x)) * off, b = Math.PI * (j / across * 1.16 - .08);
    const y = Math.cos(b) * r * WIDE, z = Math.max(Math.sin(b), -.16) * r * HIGH + .12;
    maker.vertex([x, y, z], [x * .5 * (1 - .5 * girth(x)), Math.cos(b) / WIDE, Math.sin(b) / HIGH + .15], PLATE);
  });
}

/**
 * @param {0 | 1 | 2} detail 0: a dome for a few pixels; 1: with head and legs; 2: all of it
 * @returns {Mesh}
 */
export function louseMesh(detail) {
  const maker = new Maker();
  if (detail < 2) {
    const rows = detail ? 14 : 7;
    back(maker, Array.from({ length: rows + 1 }, (_, i) => [-1 + (detail ? 1.86 : 2) * i / rows, 1]), detail ? 7 : 4);
    if (!detail) return maker.done();
  } else {
    // each plate lies over the next one behind it: its hind edge stands off
    const rows = [];
    for (let k = 0; k < PLATES; k++)
      for (const [t, off] of [[0, 1.07], [.1, 1.075], [.5, 1.02], [.995, .95]]) rows.push([-1 + (k + t) * 2 / PLATES * .93, off]);
    back(maker, rows, 12);
  }
  const fine = detail === 2;
  maker.ball(.8, 0, .2, .22, .3, .2, fine ? 8 : 4, fine ? 10 : 6, HEAD);
  for (const side of [-1, 1]) {
    if (fine) maker.ball(.9, side * .2, .3, .05, .055, .055, 4, 6, EYE);
    maker.pipe([[.9, .14 * side, .26, .035], [1.12, .3 * side, .4, .03], [1.3, .4 * side, .3, .022], [1.56, .46 * side, .16, .01]], FEELER);
    for (let k = 0; k < 7; k++) {
      const x = -.66 + k * .205;
      const knee = [x + .03, .66 * side, .2, .03], foot = [x - .02, .84 * side, .0, .012];
      if (fine) maker.pipe([[x, .36 * side, .14, .04], knee, foot], LEG);
      else {
        const first = maker.count;
        for (const p of [[x - .05, .36 * side, .14], [x + .05, .36 * side, .14], [x - .02, .86 * side, .02]]) maker.vertex(p, [0, .4 * side, .9], LEG);
        maker.triangles.push(first, first + 1, first + 2);
      }
    }
  }
  return maker.done();
}
