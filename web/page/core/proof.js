// @ts-check
// Counts the keys of which the rows have the hash that they say: proof of a watched room where it is not followed by inputs.

const NOTHING = "0000000000000000";

export class Proof {
  /** @param {import("./core.js").Core} core */
  constructor(core) {
    this.core = core;
    /** Keys that were as they said. */
    this.proven = 0;
    /** The last one's. */
    this.hash = "";
    /** @type {{tick: number, what: string} | null} the first that was not */
    this.difference = null;
  }

  /**
   * An exact key with all fields; others are passed over.
   * @param {import("./core.js").Link & {tick: number, hash: string}} key
   * @param {import("./lice.js").Louse[]} lice its rows
   */
  take(key, lice) {
    if (key.previous === undefined || key.hash === undefined) return;
    // Before the first step that did something nobody is there, and of the link the generator alone is not 0.
    const { previous, inputs, roster, rules, link } = key;
    const isBeginning = lice.length === 0 && link === 0 && [previous, inputs, roster, rules].every(hash => hash === NOTHING);
    const recomputed = isBeginning ? NOTHING : this.core.keyHash(key, lice);
    if (recomputed === key.hash) {
      ++this.proven;
      this.hash = recomputed;
    } else {
      this.difference ??= { tick: key.tick, what: `the key says ${key.hash}, its rows give ${recomputed}` };
    }
  }
}
