// @ts-check
// Keys that are pressed before there is who hears them: they are kept, and pressed again then.

const KINDS = /** @type {const} */ (['keydown', 'keyup']);

export class EarlyKeys {
  /** @type {KeyboardEvent[]} */ #kept = [];

  /** @param {() => void} onFirst somebody has pressed one */
  constructor(onFirst) {
    this.hear = (event) => {
      this.#kept.push(event);
      if (this.#kept.length === 1) onFirst();
    };
    for (const kind of KINDS) addEventListener(kind, this.hear);
  }

  /** There is who hears them. */
  pass() {
    for (const kind of KINDS) removeEventListener(kind, this.hear);
    for (const event of this.#kept.splice(0)) event.target?.dispatchEvent(new KeyboardEvent(event.type, event));  // it is what names its own parts
  }
}
