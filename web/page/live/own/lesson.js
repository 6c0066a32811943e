// @ts-check
// The first minute: three things to do, each told until it was really done; and who gives that lesson to whoever had none.
// Pure; time is an argument, in seconds.

const PUSH = 0.6, SPEED = 1, QUARTER = 1.5, DOWNHILL = -0.035;       // s, m/s, rad, slope
const SWING = 0.6, HIGHEST_RISE = 1, RISE_OF_RELIEF = 0.1, LEAST_RELIEF = 1, PRAISE = 4;

export class Lesson {
  /** @type {any} */ #before = null; #begun = 0; #pushed = 0; #turned = 0; #lowest = 0;

  /** @param {number} relief between the map's highest and lowest place [m]; where that is little nobody can swing @param {boolean} [byThumb] by the stick: there are no keys */
  constructor(relief, byThumb = false) { this.relief = relief; this.byThumb = byThumb; /** @type {'push'|'turn'|'swing'|'praise'|'over'} */ this.step = 'push'; }

  get isOver() { return this.step === 'over'; }
  /** Everything was done; praise may still stand there. */
  get isLearnt() { return this.step === 'praise' || this.step === 'over'; }
  skip() { this.step = 'over'; }

  /** Goes on once the step was done. True: another one begins, or it is over now.
   * @param {{now: number, isPushing: boolean, heading: number[], slope: number, height: number, speed: number}} facts slope: along the way, uphill positive */
  observe(facts) {
    if (this.isOver) return false;
    const before = this.#before;
    this.#before = facts;
    if (!before) { this.#begin(this.step, facts); return true; }
    if (!this.#isDone(facts, before, Math.min(0.2, Math.max(0, facts.now - before.now)))) return false;
    const next = { push: 'turn', turn: this.relief >= LEAST_RELIEF ? 'swing' : 'praise', swing: 'praise', praise: 'over' };
    this.#begin(next[this.step], facts);
    return true;
  }

  /** What is to be done, in two lines; empty: it is over. */
  get lines() {
    const of = this.relief >= LEAST_RELIEF ? 3 : 2;
    return {
      push: this.byThumb ? [`1/${of} PUSH: move the stick`, 'it pushes that way in the picture'] : [`1/${of} PUSH: hold W or an arrow`, 'each key pushes that way in the picture'],
      turn: [`2/${of} TURN: push another way`, this.byThumb ? 'a curve: all ways between' : 'a curve: two keys at once'],
      swing: ['3/3 SWING: push while rolling DOWN', 'speed climbs what no push can'],
      praise: ['WELL DONE: that is how hills are won', this.byThumb ? 'two fingers zoom, one turns the picture' : '? shows all keys, V another view'],
      over: [],
    }[this.step];
  }

  #begin(step, facts) {
    this.step = step;
    this.#begun = facts.now;
    this.#pushed = this.#turned = 0;
  }

  #isDone(facts, before, seconds) {
    switch (this.step) {
      case 'push':
        if (facts.isPushing) this.#pushed += seconds;
        return this.#pushed >= PUSH && facts.speed >= SPEED;
      case 'turn': {
        const [ax, ay] = before.heading, [bx, by] = facts.heading;
        this.#turned += Math.abs(Math.atan2(ax * by - ay * bx, ax * bx + ay * by));
        return this.#turned >= QUARTER;
      }
      case 'swing':
        if (facts.isPushing && facts.slope < DOWNHILL && facts.speed > SPEED) this.#pushed += seconds;
        if (this.#pushed < SWING || facts.height < this.#lowest) this.#lowest = facts.height;
        return this.#pushed >= SWING && facts.height > this.#lowest + Math.min(HIGHEST_RISE, RISE_OF_RELIEF * this.relief);
      case 'praise': return facts.now - this.#begun >= PRAISE;
      default: return false;
    }
  }
}

const PLACES = 24;

/** Between the highest and the lowest of a grid of places [m]. */
function reliefOf(ground) {
  const grid = ground.grid(PLACES, PLACES);
  let low = Infinity, high = -Infinity;
  for (let k = 0; k < grid.length; k += 3) {
    low = Math.min(low, grid[k]);
    high = Math.max(high, grid[k]);
  }
  return high - low;
}

export class Teacher {
  /** @type {Lesson|null} */ #lesson = null;

  /** @param {boolean} isNew the pupil has had no lesson @param {() => void} onLearnt @param {boolean} [byThumb] */
  constructor(isNew, onLearnt, byThumb = false) {
    this.isNew = isNew;
    this.byThumb = byThumb;
    this.onLearnt = onLearnt;
  }

  /** @param {import('../room.js').Room} room @param {number} now [s] @returns {string[]} what is to be done; empty: nothing */
  observe(room, now) {
    const { ground, own } = room, you = room.louse(room.you);
    if (!this.isNew || !own.pilot || !ground || !you) return [];
    this.#lesson ??= new Lesson(reliefOf(ground), this.byThumb);
    const { z, zx, zy } = ground.sample(you.x, you.y), climbing = zx * you.vx + zy * you.vy, flat = Math.hypot(you.vx, you.vy);
    const hasChanged = this.#lesson.observe({
      now, isPushing: own.steering.isPushing(now), heading: own.steering.heading, slope: flat > 0.05 ? climbing / flat : 0, height: z, speed: Math.hypot(flat, climbing),
    });
    if (hasChanged && this.#lesson.isLearnt) this.onLearnt();  // whoever leaves now has had it
    if (this.#lesson.isOver) this.isNew = false;
    return this.#lesson.lines;
  }

  /** No lesson, please. True: there was one. */
  dismiss() {
    if (!this.isNew || !this.#lesson) return false;
    this.isNew = false;
    this.onLearnt();
    return true;
  }
}
