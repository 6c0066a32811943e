// @ts-check
// How finely the picture is drawn: as fine as the machine keeps up with.

/** Of the screen's own pixels, each way. */
export const SCALES = [1, .8, .6];
const TOO_LONG = 70, ROOM = 55;  // ms a frame
const PATIENCE = 900, AGAIN = 4000;  // ms that a frame must be too long, or short enough

export class Resolution {
  /** @param {number} at where to begin: 0 the finest */
  constructor(at = 0) {
    this.at = at;
    this.mean = 0;
    this.since = 0;
    this.wait = AGAIN;
  }

  get scale() {
    return SCALES[this.at];
  }

  /** Tells when a frame was drawn. @param {number} now ms @param {number} took ms since the last one; more than a second: the page was away */
  frame(now, took) {
    if (took > 1000 || took <= 0) return;
    this.mean = this.mean ? this.mean + (took - this.mean) * .08 : took;
    const up = SCALES[this.at - 1];
    // what a frame would take one step finer, were all of it pixels
    const slow = this.mean > TOO_LONG, quick = up && this.mean * (up / this.scale) ** 2 < ROOM;
    if (!slow && !quick) this.since = now;
    if (slow && this.at < SCALES.length - 1 && now - this.since > PATIENCE) {
      this.at++;
      this.wait *= 2;  // tried and failed: the next time later
      this.restart(now);
    } else if (quick && !slow && now - this.since > this.wait) {
      this.at--;
      this.restart(now);
    }
  }

  /** @param {number} now */
  restart(now) {
    this.since = now;
    this.mean = 0;
  }
}
