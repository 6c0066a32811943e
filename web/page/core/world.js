// @ts-check
// A world of one's own: lice stepped as the server steps them.

export class World {
  /**
   * @param {import('./core.js').Core} core
   * @param {number} handle
   */
  constructor(core, handle) {
    this.core = core;
    this.handle = handle;
    core.instance.keep(this, 'world_close', handle);
  }

  /** In place of the one of its id. @param {import('./lice.js').Louse} louse */
  put(louse) {
    const { instance, rows } = this.core;
    const isTaken = instance.withMemory(rows.size, at => {
      rows.write(instance.view(at), [louse]);
      return instance.call('world_put', this.handle, at);
    });
    if (!isTaken) throw new Error('no louse can be like that');
  }

  /** @param {number} id */
  erase(id) {
    return this.core.instance.call('world_erase', this.handle, id) === 1;
  }

  clear() {
    this.core.instance.call('world_clear', this.handle);
  }

  /**
   * From the next step on. False: there is no such louse.
   * @param {number} id
   * @param {number} kind 0 none, 1 along the heading by tx, 2 a vector over the map, of length 1 at most
   * @param {number} tx
   * @param {number} ty
   * @param {number} ticks 4294967295: until another
   */
  thrust(id, kind, tx, ty, ticks) {
    return this.core.instance.call('world_thrust', this.handle, id, kind, tx, ty, ticks) === 1;
  }

  step(ticks = 1) {
    this.core.instance.call('world_step', this.handle, ticks);
  }

  /** All, by ascending id. */
  lice() {
    return this.core.liceOf('world', this.handle);
  }

  /**
   * @param {number} id
   * @returns {import('./lice.js').Louse | null}
   */
  find(id) {
    const { instance, rows } = this.core;
    const at = instance.call('world_find', this.handle, id) >>> 0;
    return at === 0 ? null : rows.read(instance.view(at, rows.size), 1)[0];
  }

  close() {
    this.core.instance.close(this, 'world_close', this.handle);
  }
}
