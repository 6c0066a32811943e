// @ts-check
// Where lice were in the last seconds: a point each so often, from what was shown, not from each frame.

const EVERY = 120;  // ms
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

export class Trails {
  constructor() {
    /** @type {Map<any, Trail>} */
    this.trails = new Map();
    this.last = -Infinity;
    this.round = 0;
  }

  clear() {
    this.trails.clear();
    this.last = -Infinity;
  }

  /**
   * Whether a point is due. A jump back, or over a second, begins anew.
   * @param {number} now ms
   */
  isDue(now) {
    if (now < this.last || now - this.last > 2000) this.clear();
    if (now - this.last < EVERY) return false;
    this.last = now;
    this.round++;
    return true;
  }

  /** @param {any} id @param {number} x @param {number} y @param {number} z drawn height @param {number} leap what farther jumps than this begins anew [m] */
  add(id, x, y, z, leap) {
    let trail = this.trails.get(id);
    if (!trail) this.trails.set(id, trail = new Trail());
    trail.seen = this.round;
    const p = trail.points, last = 4 * ((trail.end + POINTS - 1) % POINTS), at = 4 * trail.end;
    const dx = x - p[last], dy = y - p[last + 1], dz = z - p[last + 2];
    p[at] = x;
    p[at + 1] = y;
    p[at + 2] = z;
    p[at + 3] = trail.count && dx * dx + dy * dy + dz * dz > leap * leap ? 1 : 0;
    trail.end = (trail.end + 1) % POINTS;
    trail.count = Math.min(POINTS, trail.count + 1);
  }

  /** Forgets who was not added in this round. */
  sweep() {
    for (const [id, trail] of this.trails) if (trail.seen !== this.round) this.trails.delete(id);
  }
}
