// @ts-check
// What people do before there is who hears them: keys are kept, and pressed again then; a file that falls on the page is opened then.

const KINDS = /** @type {const} */ (['keydown', 'keyup', 'dragover', 'drop']);

export class Early {
  /** @type {KeyboardEvent[]} */ #kept = [];

  /** @param {() => void} onFirst somebody has pressed a key @param {(file: File) => void} onFile */
  constructor(onFirst, onFile) {
    this.hear = (event) => {
      if (event instanceof DragEvent) {
        event.preventDefault();  // else the browser leaves the page for the file
        if (event.dataTransfer?.files[0]) onFile(event.dataTransfer.files[0]);
      } else if (this.#kept.push(event) === 1) onFirst();
    };
    for (const kind of KINDS) addEventListener(kind, this.hear);
  }

  /** There is who hears them. */
  pass() {
    for (const kind of KINDS) removeEventListener(kind, this.hear);
    for (const event of this.#kept.splice(0)) event.target?.dispatchEvent(new KeyboardEvent(event.type, event));  // it is what names its own parts
  }
}
