// @ts-check
// Where lice were in the last seconds: a point each so often, from what was shown, not from each frame; and the ribbons
// that show it, widened here into one strip of triangles for all of them: as instances they cost a software renderer
// four times as much.

const EVERY = 120, LONGEST = 4000;  // ms
/** Points of a trail. */
export const POINTS = 24;

/** Of one louse: a ring of points x, y, z, and whether the trail is broken before it. */
class Trail {
  constructor() {
    this.points = new Float32Array(4 * POINTS);
    this.end = 0;
    this.count = 0;
    this.seen = 0;
  }
}

/** A way, or a shorter one round the map. @param {number} way @param {number} around 0: there is none */
const shortest = (way, around) => around ? way - Math.round(way / around) * around : way;

export class Trails {
  constructor() {
    /** @type {Map<any, Trail>} */
    this.trails = new Map();
    this.last = -Infinity;
    this.round = 0;
    /** The map's sizes where it wraps, else 0 [m]. */
    this.around = [0, 0];
    /** What nobody jumps by without beginning anew, however slow he is [m]. */
    this.slack = 1;
    /** Time since the last point but one [s]. */
    this.gap = 0;
  }

  clear() {
    this.trails.clear();
    this.last = -Infinity;
  }

  /**
   * Whether a point is due. A jump back, or over four seconds, begins anew.
   * @param {number} now ms
   */
  isDue(now) {
    if (now < this.last || now - this.last > LONGEST) this.clear();
    if (now - this.last < EVERY) return false;
    this.gap = Math.min(LONGEST, now - this.last) / 1000;
    this.last = now;
    this.round++;
    return true;
  }

  /** @param {any} id @param {number} x @param {number} y @param {number} z drawn height @param {number} speed [m/s] */
  add(id, x, y, z, speed) {
    const leap = this.leap(speed, this.gap);
    let trail = this.trails.get(id);
    if (!trail) this.trails.set(id, trail = new Trail());
    trail.seen = this.round;
    const p = trail.points, last = 4 * ((trail.end + POINTS - 1) % POINTS), at = 4 * trail.end;
    const dx = shortest(x - p[last], this.around[0]), dy = shortest(y - p[last + 1], this.around[1]), dz = z - p[last + 2];
    p[at] = x;
    p[at + 1] = y;
    p[at + 2] = z;
    p[at + 3] = trail.count && dx * dx + dy * dy + dz * dz > leap * leap ? 1 : 0;
    trail.end = (trail.end + 1) % POINTS;
    trail.count = Math.min(POINTS, trail.count + 1);
  }

  /** Who has come farther than this in so many seconds, or so fast, has not come by rolling [m]. @param {number} speed @param {number} seconds */
  leap(speed, seconds) {
    return this.slack + 2 * speed * seconds;
  }

  /** Whether a trail ends here: who stands has no further points, and where all stand (a recording that is held) trails stay. @param {any} id @param {number} x @param {number} y */
  endsAt(id, x, y) {
    const trail = this.trails.get(id), last = trail ? 4 * ((trail.end + POINTS - 1) % POINTS) : 0;
    return !!trail && Math.abs(trail.points[last] - x) + Math.abs(trail.points[last + 1] - y) < 1e-3;
  }

  /** Forgets who was not added in this round. */
  sweep() {
    for (const [id, trail] of this.trails) if (trail.seen !== this.round) this.trails.delete(id);
  }
}

/** Numbers a vertex: x, y, z, w and red, green, blue, alpha, the colour already times alpha. */
export const STRIDE = 8;

/** Lines with a width, in clip space. */
export class Ribbons {
  /** @param {number} most vertices */
  constructor(most) {
    this.data = new Float32Array(most * STRIDE);
    /** @type {number[]} */
    this.matrix = [];
    this.halfWidth = this.halfHeight = 1;
    this.count = this.length = 0;
    // the line's last point: in the picture, in clip space, the side there, width and colour
    this.px = this.py = this.cx = this.cy = this.cz = this.w = this.nx = this.ny = 0;
    this.half = this.red = this.green = this.blue = this.alpha = 0;
  }

  /** Empties it. @param {number[]} matrix world to clip space @param {number} width of the picture, pixels @param {number} height */
  begin(matrix, width, height) {
    this.matrix = matrix;
    this.halfWidth = width / 2;
    this.halfHeight = height / 2;
    this.count = 0;
    this.length = 0;
  }

  /** Begins a line. */
  cut() {
    this.length = 0;
  }

  /**
   * The line's next point, in the world; half: half its width there, pixels.
   * @param {number} x @param {number} y @param {number} z @param {number} half
   * @param {number} red @param {number} green @param {number} blue @param {number} alpha
   */
  add(x, y, z, half, red, green, blue, alpha) {
    const m = this.matrix, w = m[3] * x + m[7] * y + m[11] * z + m[15];
    if (w <= 1e-6) return this.cut();
    const cx = m[0] * x + m[4] * y + m[8] * z + m[12], cy = m[1] * x + m[5] * y + m[9] * z + m[13];
    const cz = m[2] * x + m[6] * y + m[10] * z + m[14];
    const px = cx / w * this.halfWidth, py = cy / w * this.halfHeight;
    if (this.length) {
      const dx = px - this.px, dy = py - this.py, n = Math.sqrt(dx * dx + dy * dy);
      if (n < 2) return;
      const nx = -dy / n, ny = dx / n;
      if (this.length === 1) {
        // the first point was kept back until the way was known; two more vertices of no area join it to the strip
        const first = this.count;
        if (first) this.repeat();
        this.both(this.cx, this.cy, this.cz, this.w, nx, ny, this.half, this.red, this.green, this.blue, this.alpha, first > 0);
        this.nx = nx;
        this.ny = ny;
      }
      // between the last way's side and this one's
      let sx = nx + this.nx, sy = ny + this.ny;
      const s = Math.sqrt(sx * sx + sy * sy);
      if (s > .6) sx /= s, sy /= s; else sx = nx, sy = ny;
      this.both(cx, cy, cz, w, sx, sy, half, red, green, blue, alpha, false);
      this.nx = nx;
      this.ny = ny;
    }
    this.length++;
    this.px = px, this.py = py, this.cx = cx, this.cy = cy, this.cz = cz, this.w = w;
    this.half = half, this.red = red, this.green = green, this.blue = blue, this.alpha = alpha;
  }

  /** @private The last vertex again. */
  repeat() {
    const at = this.count * STRIDE;
    if (at + STRIDE > this.data.length) return;
    this.data.copyWithin(at, at - STRIDE, at);
    this.count++;
  }

  /** @private A vertex on either side. */
  both(x, y, z, w, nx, ny, half, red, green, blue, alpha, joins) {
    if ((this.count + 3) * STRIDE > this.data.length) return;
    const d = this.data, sx = nx * half / this.halfWidth * w, sy = ny * half / this.halfHeight * w;
    for (let side = joins ? -2 : -1; side <= 1; side += side === -2 ? 1 : 2) {
      const sign = side < 0 ? -1 : 1, at = this.count++ * STRIDE;
      d[at] = x + sign * sx, d[at + 1] = y + sign * sy, d[at + 2] = z, d[at + 3] = w;
      d[at + 4] = red * alpha, d[at + 5] = green * alpha, d[at + 6] = blue * alpha, d[at + 7] = alpha;
    }
  }
}
