// @ts-check
// The server's own C++ in the page. web/core says what each of its functions does.
import { Follower } from './follower.js';
import { Ground } from './ground.js';
import { Instance } from './instance.js';
import { LouseRows } from './lice.js';

export class Core {
  /**
   * @param {string | URL | BufferSource | WebAssembly.Module} source where it is, or its bytes
   * @returns {Promise<Core>} rejects with words for people
   */
  static async load(source) {
    try {
      return new Core(await Instance.load(source));
    } catch (error) {
      throw new Error(`The physics (core.wasm) can't be loaded: ${/** @type {Error} */ (error).message}`);
    }
  }

  /** @param {Instance} instance */
  constructor(instance) {
    this.instance = instance;
    /** The server's number of the same name: only where they are equal the same inputs give the same bits. */
    this.behavior = instance.call('behavior');
    this.rows = new LouseRows(instance.json('louse_fields'));
  }

  get fields() {
    return this.rows.fields;
  }

  /**
   * A map, by its definition. Throws an Error with words for people.
   * @param {string} definition
   * @param {number} hz ticks a second of its worlds
   */
  openMap(definition, hz) {
    return this.#opened(this.instance.withBytes(definition, (at, size) => this.instance.call('ground_open', at, size)), hz);
  }

  /**
   * The same by a line of the wire, the message `map` as it came: so its bytes are hashed as they are; of a big map its overview.
   * @param {string} line
   * @param {number} hz
   */
  openMapLine(line, hz) {
    return this.#opened(this.instance.withBytes(line, (at, size) => this.instance.call('ground_open_line', at, size)), hz);
  }

  /**
   * @param {number} handle
   * @param {number} hz
   */
  #opened(handle, hz) {
    if (handle === 0) throw new Error(this.instance.answer());
    return new Ground(this, handle, hz);
  }

  /** Watches a room by inputs. */
  follower() {
    return new Follower(this, this.instance.call('follower_open'));
  }

  /**
   * Lice that lie in the core's memory.
   * @param {string} what 'world', 'follower' or 'recording'
   * @param {number} handle
   */
  liceOf(what, handle) {
    const count = this.instance.call(`${what}_count`, handle);
    if (count === 0) return [];
    return this.rows.read(this.instance.view(this.instance.call(`${what}_lice`, handle) >>> 0, count * this.rows.size), count);
  }
}
