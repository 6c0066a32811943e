// @ts-check
// The shorter way between two places of a map: where the edges wrap, it may lead over a seam.

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
