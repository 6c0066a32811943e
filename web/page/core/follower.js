// @ts-check
// A room watched by inputs: re-run line by line as they come, and proven.
import { Ground } from './ground.js';

/** @typedef {{tick: number, what: string, detail: string}} Difference */

export class Follower {
  /**
   * @param {import('./core.js').Core} core
   * @param {number} handle
   */
  constructor(core, handle) {
    this.core = core;
    this.handle = handle;
    core.instance.keep(this, 'follower_close', handle);
  }

  /** The next line that has no `type`. False: it differs, and nothing further is taken. @param {string} line */
  take(line) {
    return this.core.instance.withBytes(line, (at, size) => this.core.instance.call('follower_take', this.handle, at, size)) === 1;
  }

  /** Another session begins. */
  beginAnew() {
    this.core.instance.call('follower_begin_anew', this.handle);
  }

  /** Of what is shown; -1: nothing yet, or it differs. */
  get tick() {
    return this.core.instance.call('follower_tick', this.handle);
  }

  /** Ticks that were re-run here with the server's hash. */
  get proven() {
    return this.core.instance.call('follower_proven', this.handle);
  }

  /** @returns {{hash?: string, hz?: number, mode?: string, gaps: number, proven: number, difference: Difference | null}} */
  facts() {
    return this.core.instance.json('follower_facts', this.handle);
  }

  get hash() {
    return this.facts().hash;
  }

  get difference() {
    return this.facts().difference;
  }

  lice() {
    return this.core.liceOf('follower', this.handle);
  }

  /** As a frame's `game`, whole; null: no rules. */
  game() {
    return this.core.instance.json('follower_game', this.handle);
  }

  /** @returns {{id: number, name: string, role: string}[]} */
  players() {
    return this.core.instance.json('follower_players', this.handle);
  }

  /** Of each who plays by rules: what the columns of the same names say. @returns {{id: number, score: number, gate: number, lap: number, lap_start: number, best_lap: number}[]} */
  standings() {
    return this.core.instance.json('follower_standings', this.handle);
  }

  /** Its map; null before there is one. The caller's, to be closed. */
  ground() {
    const handle = this.core.instance.call('follower_ground', this.handle);
    return handle === 0 ? null : new Ground(this.core, handle, /** @type {number} */ (this.facts().hz));
  }

  close() {
    this.core.instance.close(this, 'follower_close', this.handle);
  }
}
