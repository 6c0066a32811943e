// @ts-check
// The grounds of maps that the server has sent, each opened once.

/** @typedef {import('../core/ground.js').Ground} Ground */

export class Grounds {
  /** @type {Map<string, Ground>} */ #known = new Map();

  /** @param {import('../core/core.js').Core} core */
  constructor(core) { this.core = core; }

  /** That of a welcome's map, if it was opened before. */
  of(welcome) { return this.#known.get(`${welcome.map.hash} ${welcome.tick_hz}`); }

  /** Of a `map` message, by its line as it came. Throws an Error that says what can't be read. */
  open(line, welcome) {
    const ground = this.core.openMapLine(line, welcome.tick_hz);
    this.#known.set(`${welcome.map.hash} ${welcome.tick_hz}`, ground);
    return ground;
  }
}
