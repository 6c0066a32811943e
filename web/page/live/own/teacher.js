// @ts-check
// Gives the first lesson to who has had none, and sees how it goes.
import { Lesson } from './lesson.js';

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

  /** @param {boolean} isNew the pupil has had no lesson @param {() => void} onLearnt */
  constructor(isNew, onLearnt) {
    this.isNew = isNew;
    this.onLearnt = onLearnt;
  }

  /** @param {import('../room.js').Room} room @param {number} now [s] @returns {string[]} what is to be done; empty: nothing */
  observe(room, now) {
    const { ground, own } = room, you = room.louse(room.you);
    if (!this.isNew || !own.pilot || !ground || !you) return [];
    this.#lesson ??= new Lesson(reliefOf(ground));
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
