// @ts-check
// Rows of lice in the core's memory, read and written by the field list that the core itself tells.

/**
 * A louse, by the wire's names (docs/protocol.md): metres, m/s, a heading of length 1, `ticks_left` of its thrust.
 * @typedef {{id: number, phase: number, x: number, y: number, vx: number, vy: number, heading_x: number, heading_y: number, tx: number,
 *   ty: number, flight_z: number, flight_vz: number, distance: number, thrust_kind: number, ticks_left: number}} Louse
 * @typedef {{name: keyof Louse, unit: string, offset: number, size: 4 | 8, quantum: number}} Field
 */

export class LouseRows {
  /** @param {Field[]} fields */
  constructor(fields) {
    this.fields = fields;
    const last = fields[fields.length - 1];
    /** Bytes of a louse. */
    this.size = last.offset + last.size;
  }

  /**
   * @param {DataView} view
   * @param {number} count from its beginning
   * @returns {Louse[]}
   */
  read(view, count) {
    const lice = new Array(count);
    for (let k = 0, at = 0; k < count; ++k, at += this.size) {
      const louse = /** @type {Louse} */ ({});
      for (const { name, offset, size } of this.fields)
        louse[name] = size === 8 ? view.getFloat64(at + offset, true) : view.getUint32(at + offset, true);
      lice[k] = louse;
    }
    return lice;
  }

  /**
   * @param {DataView} view
   * @param {Louse[]} lice
   */
  write(view, lice) {
    let at = 0;
    for (const louse of lice) {
      for (const { name, offset, size } of this.fields) {
        if (size === 8) view.setFloat64(at + offset, louse[name], true);
        else view.setUint32(at + offset, louse[name], true);
      }
      at += this.size;
    }
  }
}
