// @ts-check
// How far the steps of one louse err, for who asks: of ticks that come one by one, of which the newest may still turn out to have been others.

/** of_play [m/s of play], worst [m], apart [m]: of a twin at half the step. @typedef {{of_play: number, worst: number, worst_tick: number, apart: number, apart_seconds: number}} ErrorReading */

export class LouseError {
  /**
   * @param {import('./ground.js').Ground} ground an exact one
   * @param {string} mode
   * @param {number} settling how many ticks old one is before it counts
   */
  constructor(ground, mode, settling) {
    this.core = ground.core;
    this.handle = this.core.instance.call('error_open', ground.handle, ground.hz, ground.numberOf(mode), settling);
    this.core.instance.keep(this, 'error_close', this.handle);
  }

  /** As the step of number `tick` finds it in its world, thrust told; again, where it is run again. @param {import('./world.js').World} world @param {number} id @param {number} tick */
  find(world, id, tick) {
    this.core.instance.call('error_find', this.handle, world.handle, id, tick);
  }

  /** What was found and has not counted was no play. */
  forget() {
    this.core.instance.call('error_forget', this.handle);
  }

  /** Counts at most so many ticks. @param {number} most @returns {ErrorReading | null} null before the first */
  count(most) {
    return this.core.instance.json('error_count', this.handle, most);
  }

  close() {
    this.core.instance.close(this, 'error_close', this.handle);
  }
}
