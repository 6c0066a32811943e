// @ts-check
// Coloured triangles in the world, gathered for one call: marks, shadows, rings, walls.

/** Numbers a vertex: x, y, z, 1 and red, green, blue, alpha, the colour already times alpha. */
const STRIDE = 8;
/** Numbers a louse that is drawn: x, y, z, half length; forward, phase of the walk; up, 1 a ghost; colour, unused. */
export const INSTANCE = 16;

/** Three numbers from 0 to 1. @typedef {[number, number, number]} Light */
/** @typedef {(x: number, y: number) => number} HeightAt of the drawn ground [m] */

export class Batch {
  constructor() {
    this.data = new Float32Array(STRIDE * 3072);
    this.count = 0;
  }

  /** @param {number} x @param {number} y @param {number} z @param {Light} c @param {number} alpha */
  vertex(x, y, z, c, alpha) {
    let at = this.count++ * STRIDE;
    if (at + STRIDE > this.data.length) {
      const grown = new Float32Array(2 * this.data.length);
      grown.set(this.data);
      this.data = grown;
    }
    const d = this.data;
    d[at++] = x, d[at++] = y, d[at++] = z, d[at++] = 1;
    d[at++] = c[0] * alpha, d[at++] = c[1] * alpha, d[at++] = c[2] * alpha, d[at] = alpha;
  }

  /** Corners around; the first two of one alpha, the others of another. @param {number[]} a @param {number[]} b @param {number[]} c @param {number[]} d
   * @param {Light} colour @param {number} first @param {number} second */
  quad(a, b, c, d, colour, first, second = first) {
    this.vertex(a[0], a[1], a[2], colour, first);
    this.vertex(b[0], b[1], b[2], colour, first);
    this.vertex(c[0], c[1], c[2], colour, second);
    this.vertex(a[0], a[1], a[2], colour, first);
    this.vertex(c[0], c[1], c[2], colour, second);
    this.vertex(d[0], d[1], d[2], colour, second);
  }

  /** A disc about the origin o, along two axes, from one alpha in the middle to another at the rim.
   * @param {number[]} o @param {number[]} u @param {number[]} v @param {number} corners @param {Light} colour @param {number} middle @param {number} rim */
  disc(o, u, v, corners, colour, middle, rim) {
    let ca = 1, sa = 0;
    const turnC = Math.cos(2 * Math.PI / corners), turnS = Math.sin(2 * Math.PI / corners);
    for (let k = 0; k < corners; k++) {
      const cb = ca * turnC - sa * turnS, sb = sa * turnC + ca * turnS;
      this.vertex(o[0], o[1], o[2], colour, middle);
      this.vertex(o[0] + u[0] * ca + v[0] * sa, o[1] + u[1] * ca + v[1] * sa, o[2] + u[2] * ca + v[2] * sa, colour, rim);
      this.vertex(o[0] + u[0] * cb + v[0] * sb, o[1] + u[1] * cb + v[1] * sb, o[2] + u[2] * cb + v[2] * sb, colour, rim);
      ca = cb, sa = sb;
    }
  }

  /** A circle on the ground, as a band; dash: every second so many of its pieces is left out, 0: none is.
   * @param {HeightAt} heightAt @param {number} x @param {number} y @param {number} radius @param {number} width @param {number} lift above the ground
   * @param {Light} colour @param {number} alpha @param {number} dash */
  circle(heightAt, x, y, radius, width, lift, colour, alpha, dash) {
    const pieces = 60;
    const at = (k, r) => {
      const a = k / pieces * 2 * Math.PI, px = x + Math.cos(a) * r, py = y + Math.sin(a) * r;
      return [px, py, heightAt(px, py) + lift];
    };
    for (let k = 0; k < pieces; k++)
      if (!dash || Math.floor(k / dash) % 2 === 0)
        this.quad(at(k, radius - width), at(k + 1, radius - width), at(k + 1, radius + width), at(k, radius + width), colour, alpha);
  }

  /** A straight band on the ground, cut in pieces as the ground bends; dash as for circle().
   * @param {HeightAt} heightAt @param {number[]} a @param {number[]} b @param {number} width @param {number} lift @param {Light} colour @param {number} alpha @param {number} dash */
  band(heightAt, a, b, width, lift, colour, alpha, dash) {
    const way = Math.hypot(b[0] - a[0], b[1] - a[1]), pieces = Math.max(1, Math.min(64, Math.ceil(way / Math.max(width * 4, .4))));
    const nx = -(b[1] - a[1]) / (way || 1) * width, ny = (b[0] - a[0]) / (way || 1) * width;
    const at = (k, side) => {
      const t = k / pieces, x = a[0] + (b[0] - a[0]) * t + side * nx, y = a[1] + (b[1] - a[1]) * t + side * ny;
      return [x, y, heightAt(x, y) + lift];
    };
    for (let k = 0; k < pieces; k++)
      if (!dash || Math.floor(k / dash) % 2 === 0) this.quad(at(k, -1), at(k + 1, -1), at(k + 1, 1), at(k, 1), colour, alpha);
  }

  /** An upright post with four sides and a top. @param {number} x @param {number} y @param {number} z @param {number} half @param {number} height @param {Light} colour */
  post(x, y, z, half, height, colour) {
    const corner = (k, up) => [x + ((k + 1) % 4 < 2 ? -half : half), y + (k % 4 < 2 ? -half : half), z + up];
    for (let k = 0; k < 4; k++) {
      const light = [.62, .8, 1, .74][k], c = /** @type {Light} */ (colour.map(v => v * light));
      this.quad(corner(k, -half * 2), corner(k + 1, -half * 2), corner(k + 1, height), corner(k, height), c, 1);
    }
    this.quad(corner(0, height), corner(1, height), corner(2, height), corner(3, height), colour, 1);
  }

  /** A stone of eight faces. @param {number} x @param {number} y @param {number} z @param {number} half @param {number} turn radians @param {Light} colour */
  stone(x, y, z, half, turn, colour) {
    const c = Math.cos(turn) * half, s = Math.sin(turn) * half;
    const rim = [[c, s], [-s, c], [-c, -s], [s, -c]];
    for (const up of [1, -1])
      for (let k = 0; k < 4; k++) {
        const a = rim[k], b = rim[(k + 1) % 4], mx = (a[0] + b[0]) / half, my = (a[1] + b[1]) / half;
        const light = .62 + (up > 0 ? .28 : -.1) + .16 * (my - mx) / 1.5, shaded = /** @type {Light} */ (colour.map(v => Math.min(1, v * light)));
        this.vertex(x + a[0], y + a[1], z, shaded, 1);
        this.vertex(x + b[0], y + b[1], z, shaded, 1);
        this.vertex(x, y, z + up * half * 1.15, shaded, 1);
      }
  }
}
