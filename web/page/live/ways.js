// @ts-check
// The shorter way between two places of a map: where the edges wrap, it may lead over a seam. And a louse between two
// snapshots: on the cubic Hermite curve through both places with both velocities, so that no kink is seen where a snapshot
// comes. One that jumped (a respawn) is not drawn in flight.

export class Ways {
  /**
   * @param {number[]} domain [x0, y0, x1, y1] in m
   * @param {boolean[]} wraps whether the map goes on over its edges, along x and y
   */
  constructor(domain = [0, 0, 0, 0], wraps = [false, false]) {
    this.domain = domain;
    this.wraps = wraps;
  }

  /** From one place to another. @returns {[number, number]} */
  way(fromX, fromY, toX, toY) {
    return [this.#shorter(toX - fromX, 0), this.#shorter(toY - fromY, 1)];
  }

  /** The place on the map that (x, y), which may lie beyond an edge that wraps, is. @returns {[number, number]} */
  place(x, y) {
    return [this.#inside(x, 0), this.#inside(y, 1)];
  }

  #period(axis) {
    return this.domain[2 + axis] - this.domain[axis];
  }

  #shorter(way, axis) {
    if (!this.wraps[axis]) return way;
    const period = this.#period(axis);
    if (way > period / 2) return way - period;
    return way < -period / 2 ? way + period : way;
  }

  #inside(value, axis) {
    if (!this.wraps[axis]) return value;
    const low = this.domain[axis], period = this.#period(axis);
    return low + ((((value - low) % period) + period) % period);
  }
}

/** A step this much longer than the speeds allow is no motion, but for a metre. */
const JUMP_FACTOR = 4, JUMP_SLACK = 1;

function jumped(from, to, wayX, wayY, seconds) {
  const speed = Math.hypot(from.vx, from.vy) + Math.hypot(to.vx, to.vy);
  return Math.hypot(wayX, wayY) > JUMP_FACTOR * speed * seconds + JUMP_SLACK;
}

/**
 * @param {any} from the louse at the earlier snapshot
 * @param {any} to the same louse at the later one
 * @param {number} seconds between both, above 0
 * @param {number} t 0 to 1, how much of the way is done
 * @param {import('./ways.js').Ways} ways
 */
export function between(from, to, seconds, t, ways) {
  console.assert(seconds > 0 && t >= 0 && t <= 1);
  const [wayX, wayY] = ways.way(from.x, from.y, to.x, to.y);
  if (jumped(from, to, wayX, wayY, seconds)) return t < 1 ? from : to;
  const ofEnd = t * t * (3 - 2 * t);
  const leaving = t * (1 - t) * (1 - t) * seconds, arriving = t * t * (t - 1) * seconds;
  const [x, y] = ways.place(from.x + ofEnd * wayX + leaving * from.vx + arriving * to.vx,
                            from.y + ofEnd * wayY + leaving * from.vy + arriving * to.vy);
  const mix = (a, b) => a + t * (b - a);
  let headingX = mix(from.heading_x, to.heading_x), headingY = mix(from.heading_y, to.heading_y);
  const length = Math.hypot(headingX, headingY);
  if (length > 1e-6) { headingX /= length; headingY /= length; } else { headingX = to.heading_x; headingY = to.heading_y; }
  // Where it leaves or touches the ground between both, the nearer one says whether it flies.
  const flies = from.flight_z !== 0 && to.flight_z !== 0;
  const louse = {
    ...from, x, y, heading_x: headingX, heading_y: headingY, vx: mix(from.vx, to.vx), vy: mix(from.vy, to.vy),
    distance: mix(from.distance, to.distance),
    flight_z: flies ? mix(from.flight_z, to.flight_z) : (t < 0.5 ? from : to).flight_z,
  };
  if (from.z !== undefined) louse.z = mix(from.z, to.z);
  return louse;
}
