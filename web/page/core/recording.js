// @ts-check
// A recording for who shows it: opened, sought in and verified in workers, so that no file stops the page.

/**
 * @typedef {import('./recording_desk.js').Moment} Moment
 * @typedef {import('./recording_desk.js').Info} Info
 */

class Desk {
  /** @param {Worker} worker */
  constructor(worker) {
    this.worker = worker;
    /** @type {Map<number, {resolve: (result: any) => void, reject: (error: Error) => void}>} */
    this.waiting = new Map();
    this.calls = 0;
    /** How far a verification is. @type {(ticks: number) => void} */
    this.onTicks = () => {};
    this.worker.onmessage = ({ data }) => {
      if (data.ticks !== undefined) return this.onTicks(data.ticks);
      const call = this.waiting.get(data.number);
      this.waiting.delete(data.number);
      if (data.error === undefined) call?.resolve(data.result);
      else call?.reject(new Error(data.error));
    };
    this.worker.onerror = event => this.end(event.message || 'the recording\'s worker can\'t be loaded');
  }

  /**
   * @param {string} call
   * @param {object} of
   * @returns {Promise<any>}
   */
  ask(call, of) {
    return new Promise((resolve, reject) => {
      this.waiting.set(++this.calls, { resolve, reject });
      this.worker.postMessage({ number: this.calls, call, ...of });
    });
  }

  /** @param {string} why what still waits is told */
  end(why) {
    this.worker.terminate();
    for (const { reject } of this.waiting.values()) reject(new Error(why));
    this.waiting.clear();
  }
}

export class Recording {
  /**
   * @param {import('./core.js').Core} core whose code the workers run
   * @param {Blob | Uint8Array} file plain or packed
   * @param {() => Worker} worker begins one that runs recording_worker.js
   * @returns {Promise<Recording>} rejects with words for people
   */
  static async open(core, file, worker) {
    const blob = file instanceof Blob ? file : new Blob([/** @type {BlobPart} */ (file)]);
    const desk = new Desk(worker());
    try {
      await desk.ask('begin', { module: core.instance.module });
      return new Recording(core, blob, desk, await desk.ask('open', { blob }), worker);
    } catch (error) {
      desk.end('closed');
      throw error;
    }
  }

  /**
   * @param {import('./core.js').Core} core
   * @param {Blob} blob
   * @param {Desk} desk
   * @param {Info} info
   * @param {() => Worker} worker
   */
  constructor(core, blob, desk, info, worker) {
    this.core = core;
    /** The file, to be saved again. */
    this.blob = blob;
    this.desk = desk;
    this.info = info;
    this.worker = worker;
    /** @type {Desk | null} */
    this.verifier = null;
  }

  /** Its map, of the page's own core. The caller's, to be closed. */
  ground() {
    return this.core.openMap(this.info.definition, this.info.hz);
  }

  /** @param {number} tick from info.first to info.last @returns {Promise<Moment>} */
  seek(tick) {
    return this.desk.ask('seek', { tick: Math.min(Math.max(Math.round(tick), this.info.first), this.info.last) });
  }

  /** @param {number} steps fewer at its end @returns {Promise<Moment>} */
  advance(steps) {
    return this.desk.ask('advance', { steps });
  }

  /** Whose steps' error each moment tells from now on; 0: nobody's. @param {number} id */
  measure(id) {
    return this.desk.ask('measure', { id });
  }

  /** All of it, beside what is shown; as RecordingDesk.verify(). @param {(ticks: number) => void} onTicks @returns {Promise<{ok: number, text: string}>} */
  async verify(onTicks) {
    const desk = new Desk(this.worker());
    desk.onTicks = onTicks;
    this.verifier = desk;
    try {
      await desk.ask('begin', { module: this.core.instance.module });
      return await desk.ask('verify', { blob: this.blob });
    } finally {
      desk.end('closed');
    }
  }

  close() {
    this.desk.end('closed');
    this.verifier?.end('closed');
  }
}
