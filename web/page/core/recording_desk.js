// @ts-check
// A recording in an instance of its own, which is made anew when it has come to its end: want of memory ends it, and no bytes of a file may end more.
import { Core } from './core.js';
import { CoreEnded } from './instance.js';

/**
 * What stands at a tick. `since`: the keyframe's tick from which on every tick up to here was re-run; `difference`: where that first parted from what is recorded;
 * `error`: how far the steps of louse `measured` err, since it is measured and of what was stepped since the last jump.
 * @typedef {{tick: number, hash: string, since: number, difference: import('./follower.js').Difference | null, lice: import('./lice.js').Louse[],
 *   game: object | null, standings: object[], players: {id: number, name: string, role: string}[], chats: {tick: number, id: number, name: string, text: string}[],
 *   measured: number, error: import('./louse_error.js').ErrorReading | null}} Moment
 * @typedef {{first: number, last: number, hz: number, mode: string, name: string, build: string, behavior: number, inputs: number, is_cut_off: boolean, end_reason: string,
 *   players: {id: number, name: string, role: string, joined: number, left?: number}[], marks: {tick: number, kind: 'join' | 'leave' | 'respawn' | 'chat', id: number}[],
 *   definition: string}} Info
 */

export class RecordingDesk {
  /** @param {WebAssembly.Module} module */
  constructor(module) {
    this.module = module;
    /** @type {Core | null} */
    this.core = null;
    /** @type {Uint8Array | null} */
    this.bytes = null;
    this.handle = 0;
    this.tick = 0;
    /** Whose steps' error is told; 0: nobody's. */
    this.measured = 0;
  }

  /**
   * Another one; in place of the one before, if it is one. Throws an Error with words for people.
   * @param {Uint8Array} bytes plain or packed
   * @returns {Promise<Info>}
   */
  async open(bytes) {
    this.core = null;
    this.bytes = bytes;
    this.measured = 0;
    const core = await this.#opened();
    const info = core.instance.json('recording_facts', this.handle);
    const ground = core.instance.call('recording_ground', this.handle);
    core.instance.call('ground_definition', ground);
    info.definition = core.instance.answer();
    core.instance.call('ground_close', ground);
    this.tick = info.first;
    return info;
  }

  /** @param {number} tick from first to last @returns {Promise<Moment>} */
  seek(tick) {
    return this.#recovering(core => {
      if (!core.instance.call('recording_seek', this.handle, tick)) throw new Error(core.instance.answer());
      return this.#moment(core, []);
    });
  }

  /** @param {number} steps fewer at its end @returns {Promise<Moment>} */
  advance(steps) {
    return this.#recovering(core => {
      if (!core.instance.call('recording_advance', this.handle, steps)) throw new Error(core.instance.answer());
      return this.#moment(core, JSON.parse(core.instance.answer()).chats);
    });
  }

  /** How far this louse's steps err from here on; 0: nobody's. @param {number} id */
  measure(id) {
    this.measured = id;
    return this.#recovering(core => void core.instance.call('recording_measure', this.handle, id));
  }

  /**
   * All of it, re-run from its first line. What `woodlouse-server verify` says; `ok`: 1 the same bits, 0 it differs, -1 damaged.
   * @param {Uint8Array} bytes
   * @param {(ticks: number) => void} [onTicks] told every few seconds of the game how many were re-run
   * @returns {Promise<{ok: number, text: string}>}
   */
  async verify(bytes, onTicks = () => {}) {
    const { instance } = await Core.load(this.module);
    const handle = instance.withBytes(bytes, (at, size) => instance.call('verification_open', at, size));
    let ok;
    while ((ok = instance.call('verification_advance', handle)) === 2) onTicks(instance.call('verification_ticks', handle));
    return { ok, text: instance.answer() };
  }

  async #opened() {
    if (this.core && !this.core.instance.isEnded) return this.core;
    if (!this.bytes) throw new Error('no recording is open');
    const core = await Core.load(this.module);
    const bytes = this.bytes;
    const handle = core.instance.withBytes(bytes, (at, size) => core.instance.call('recording_open', at, size));
    if (handle === 0) throw new Error(core.instance.answer());
    if (this.measured) core.instance.call('recording_measure', handle, this.measured);
    this.core = core;
    this.handle = handle;
    return core;
  }

  /**
   * Once more in a fresh instance, from where it stood, when the first one ends.
   * @template T
   * @param {(core: Core) => T} work
   */
  async #recovering(work) {
    const core = await this.#opened();
    try {
      return work(core);
    } catch (error) {
      if (!(error instanceof CoreEnded)) throw error;
      const fresh = await this.#opened();
      fresh.instance.call('recording_seek', this.handle, this.tick);
      return work(fresh);
    }
  }

  /**
   * @param {Core} core
   * @param {Moment['chats']} chats
   * @returns {Moment}
   */
  #moment(core, chats) {
    const { instance } = core;
    this.tick = instance.call('recording_tick', this.handle);
    const proof = instance.json('recording_proof', this.handle);
    return {
      tick: this.tick, ...proof, chats, lice: core.liceOf('recording', this.handle), game: instance.json('recording_game', this.handle),
      standings: instance.json('recording_standings', this.handle), players: instance.json('recording_players', this.handle),
      measured: this.measured, error: this.measured ? instance.json('recording_error', this.handle) : null,
    };
  }
}
