// @ts-check
// A map: its surface, and the worlds on it.
import { World } from './world.js';

/** Modes of play, by the core's numbers. */
export const MODES = ['roam', 'race', 'forage', 'hill'];

export class Ground {
  /**
   * @param {import('./core.js').Core} core
   * @param {number} handle
   * @param {number} hz
   */
  constructor(core, handle, hz) {
    this.core = core;
    this.handle = handle;
    core.instance.keep(this, 'ground_close', handle);
    this.hz = hz;
    const facts = core.instance.json('ground_facts', handle);
    /** @type {string} */
    this.name = facts.name;
    /** @type {string} 16 hex digits */
    this.hash = facts.hash;
    /** @type {[number, number, number, number]} x0, y0, x1, y1 [m] */
    this.domain = facts.domain;
    /** @type {'walls' | 'wrap' | 'open'} */
    this.edges = facts.edges;
    this.wraps = [facts.edges === 'wrap', facts.edges === 'wrap'];
    /** Where central gravity pulls to; null: there is none. */
    this.centre = facts.central_gravity > 0 ? { x: 0, y: 0, gravity: facts.central_gravity, radius: facts.core_radius } : null;
    /** @type {string} 'exact', or one of the document's */
    this.equations = facts.equations;
    /** @type {string} 'bilateral': nobody flies; 'unilateral' */
    this.contact = facts.contact;
    /** What full thrust climbs from rest. */
    this.climbs = /** @type {number} */ (facts.climbs);
    /** False: of a big map, for drawing alone. */
    this.isExact = /** @type {boolean} */ (facts.exact);
    core.instance.call('ground_definition', handle);
    /** The canonical definition (maps/README.md), whose bytes are hashed. */
    this.definitionText = core.instance.answer();
    /** The same, to be looked into. */
    this.definition = JSON.parse(this.definitionText);
  }

  /**
   * z, zx, zy of columns x rows points over the whole domain, rows from y0 up; both at least 2.
   * @param {number} columns
   * @param {number} rows
   */
  grid(columns, rows) {
    const { instance } = this.core;
    const size = columns * rows * 3;
    return instance.withMemory(4 * size, at => {
      instance.call('ground_grid', this.handle, columns, rows, at);
      return new Float32Array(instance.view().buffer, at, size).slice();
    });
  }

  /**
   * Height [m] and gradient; of a point outside at the edge.
   * @param {number} x
   * @param {number} y
   */
  sample(x, y) {
    const { instance } = this.core;
    const at = instance.call('ground_sample', this.handle, x, y) >>> 3, { doubles } = instance;
    return { z: doubles[at], zx: doubles[at + 1], zy: doubles[at + 2] };
  }

  /**
   * Who begins at each of a mode's spawns.
   * @param {string} mode
   * @returns {import('./lice.js').Louse[]} each with the id 1
   */
  spawns(mode = 'roam') {
    const { instance, rows } = this.core;
    return instance.withMemory(rows.size, at => {
      const lice = [];
      while (instance.call('ground_spawn', this.handle, this.numberOf(mode), lice.length, 1, at)) lice.push(rows.read(instance.view(at), 1)[0]);
      return lice;
    });
  }

  /** The core's number of a mode. @param {string} mode */
  numberOf(mode) {
    return MODES.indexOf(mode);
  }

  /** An empty world on it; of an exact map alone. @param {string} mode one that the map has */
  world(mode = 'roam') {
    if (!this.isExact) throw new Error('a big map is only drawn here');
    return new World(this.core, this.core.instance.call('world_open', this.handle, this.hz, this.numberOf(mode)));
  }

  close() {
    this.core.instance.close(this, 'ground_close', this.handle);
  }
}
