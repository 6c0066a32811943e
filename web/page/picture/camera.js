// @ts-check
// Where the picture is seen from: around the whole map, behind one louse, or as a map from straight above.
//
// It glides to where it is wanted, or jumps where the reader wants calm. Heights here are those of the drawn
// world: the ground's times the exaggeration.
import { clamp, lookAt, mix, orthographic, perspective, times } from './vectors.js';

/** @typedef {'orbit' | 'follow' | 'map'} View */
/** What the camera must know of the ground. @typedef {{centre: import('./vectors.js').Vector, radius: number, corners: import('./vectors.js').Vector[],
 *   isPot: boolean, heightAt: (x: number, y: number) => number, size: number, nearest: (a: number[], b: number[]) => number[]}} Stage */
/** @typedef {{x: number, y: number, z: number}} Place */
/** What is seen: the middle, angles, how far off [m], how far moved aside in the picture, of half of it.
 * @typedef {Place & {yaw: number, pitch: number, distance: number, sx: number, sy: number}} Shot */

const ANGLE = .66;  // of the whole height, radians
const POT = .98, HILL = .63, FOLLOW = .7;  // pitches, radians: 56 degrees into pots, 36 at hills, 40 behind a louse
const FLATTEST = .14, STEEPEST = 1.5;
const FULL = .93;  // how much of the free picture the map fills
const STANDS = .5;  // no louse that is followed comes farther from the middle, of half the free picture

/** By view: how far one may zoom in, how far out. */
const ZOOMS = { orbit: [.6, 12], follow: [.3, 5], map: [.6, 16] };

export class Camera {
  /** @param {boolean} calm no gliding */
  constructor(calm) {
    this.calm = calm;
    /** @type {View} */
    this.view = 'orbit';
    /** The louse to follow, 0: none. */
    this.follow = 0;
    /** CSS pixels at each side that panels cover. */
    this.insets = { left: 0, top: 0, right: 0, bottom: 0 };
    this.yaw = -2.2;
    /** How steeply it looks down by view, radians. */
    this.pitch = { orbit: HILL, follow: FOLLOW, map: Math.PI / 2 };
    this.zooms = { orbit: 1, follow: 1, map: 1 };
    /** @type {Stage | null} */
    this.stage = null;
    this.width = this.height = 1;
    this.last = 0;
    /** What is drawn now, on its way to what is wanted. @type {Shot | null} */
    this.now = null;
    /** World to clip space. */
    /** What fit() found last. @type {{key: string, far: number, sx: number, sy: number} | undefined} */
    this.fitted = undefined;
    this.matrix = lookAt([0, 0, 1], [0, 0, 0], [0, 1, 0]);
    /** About which a map that wraps is shown. */
    this.middle = [0, 0];
    /** @type {import('./vectors.js').Vector} */
    this.eye = [0, 0, 1];
  }

  /** Looks at another ground, or at the same one by other points, which leaves the view as it is. @param {Stage} stage @param {boolean} isSame */
  setStage(stage, isSame = false) {
    this.stage = stage;
    this.fitted = undefined;
    if (isSame) return;
    this.now = null;
    this.pitch.orbit = stage.isPot ? POT : HILL;
    this.pitch.follow = stage.isPot ? POT : FOLLOW;
    this.zooms = { orbit: 1, follow: 1, map: 1 };
  }

  /** The direction over the map of "up in the picture", radians counter-clockwise from +x. */
  get azimuth() {
    return this.view === 'map' ? Math.PI / 2 : Math.PI + this.yaw;
  }

  /** By so many CSS pixels of a drag. @param {number} dx @param {number} dy */
  turn(dx, dy) {
    if (this.view === 'map') return;
    this.yaw -= dx * .006;
    this.pitch[this.view] = clamp(this.pitch[this.view] + dy * .005, FLATTEST, STEEPEST);
  }

  /** @param {number} factor above 1: nearer */
  zoom(factor) {
    if (!(factor > 0)) return;
    const [least, most] = ZOOMS[this.view];
    this.zooms[this.view] = clamp(this.zooms[this.view] * factor, least, most);
  }

  /**
   * Moves on and makes the matrix. followed: where the louse to follow is drawn, if there is one.
   * @param {number} width CSS pixels @param {number} height @param {number} now ms @param {Place | null} followed
   * @param {{x: number, y: number} | null} goal towards which it looks ahead of him
   */
  update(width, height, now, followed, goal = null) {
    const stage = this.stage;
    if (!stage) return;
    this.width = Math.max(1, width);
    this.height = Math.max(1, height);
    const target = this.view === 'follow' ? followed : null;
    const view = this.view === 'follow' && !target ? 'orbit' : this.view;
    const wanted = {
      x: target ? target.x : stage.centre[0], y: target ? target.y : stage.centre[1],
      z: target ? target.z : stage.centre[2],
      yaw: view === 'map' ? -Math.PI / 2 : this.yaw, pitch: this.pitch[view], distance: 0, sx: 0, sy: 0,
    };
    wanted.distance = (target ? clamp(stage.radius * .85, 20, 46) * Math.max(1, Math.min(2, 1.2 * height / width)) : this.fit(wanted)) / this.zooms[view];
    if (target && goal) {
      const [gx, gy] = stage.nearest([target.x, target.y], [goal.x, goal.y]), dx = gx - target.x, dy = gy - target.y;
      const ahead = Math.min(.45, wanted.distance * .2 / Math.max(1e-3, Math.hypot(dx, dy)));
      wanted.x += dx * ahead, wanted.y += dy * ahead;
    }
    if (target) wanted.pitch = this.clearPitch(wanted);
    // zoomed in on the map, what is followed comes to the middle
    if (!target && followed && this.zooms[view] > 1.15) {
      const t = Math.min(1, (this.zooms[view] - 1.15) * 2);
      wanted.x = mix(wanted.x, followed.x, t), wanted.y = mix(wanted.y, followed.y, t), wanted.z = mix(wanted.z, followed.z, t);
    }
    this.middle = target ? [target.x, target.y] : stage.centre.slice(0, 2);
    if (this.now) [this.now.x, this.now.y] = stage.nearest(this.middle, [this.now.x, this.now.y]);
    const dt = Math.min(.1, Math.max(0, (now - this.last) / 1000));
    this.last = now;
    const far = this.now && Math.hypot(wanted.x - this.now.x, wanted.y - this.now.y) > stage.radius * .4 && target;
    if (!this.now || this.calm || far) this.now = wanted;
    else {
      const glide = 1 - Math.exp(-dt * 6), at = this.now;
      for (const key of /** @type {const} */ (['x', 'y', 'z'])) at[key] = mix(at[key], wanted[key], target ? 1 - Math.exp(-dt * 9) : glide);
      at.sx = mix(at.sx, wanted.sx, glide), at.sy = mix(at.sy, wanted.sy, glide);
      at.yaw += Math.atan2(Math.sin(wanted.yaw - at.yaw), Math.cos(wanted.yaw - at.yaw)) * (1 - Math.exp(-dt * 14));
      at.pitch = mix(at.pitch, wanted.pitch, glide);
      at.distance *= (wanted.distance / at.distance) ** glide;
      // what has all but come to rest stands: a picture that stands is drawn once
      if (Math.abs(at.distance / wanted.distance - 1) + Math.abs(at.pitch - wanted.pitch) + Math.abs(Math.sin(at.yaw - wanted.yaw)) + Math.abs(at.sx - wanted.sx) + Math.abs(at.sy - wanted.sy) +
        Math.hypot(at.x - wanted.x, at.y - wanted.y, at.z - wanted.z) / wanted.distance < 2e-3) this.now = wanted;
    }
    this.place(this.now, view === 'map');
    if (target) this.hold(target);
  }

  /** Moves the camera so far that a louse comes no nearer to the picture's edge than it may. @param {Place} target */
  hold(target) {
    const at = this.now;
    for (let i = 0; at && i < 4; i++) {
      const p = this.project(target.x, target.y, target.z);
      const off = p ? Math.max(...this.offMiddle(p)) : Infinity;
      if (off <= STANDS) return;
      const t = off < Infinity ? 1 - STANDS / off : 1;
      at.x = mix(at.x, target.x, t), at.y = mix(at.y, target.y, t), at.z = mix(at.z, target.z, t);
      this.place(at, false);
    }
  }

  /** How far from the middle of the free picture, each way, of half of it. @param {{x: number, y: number}} p CSS pixels */
  offMiddle(p) {
    const { left, top, right, bottom } = this.insets;
    const w = Math.max(40, this.width - left - right), h = Math.max(40, this.height - top - bottom);
    return [Math.abs(p.x - left - w / 2) / (w / 2), Math.abs(p.y - top - h / 2) / (h / 2)];
  }

  /** How steeply it must look down at a louse that no hill between hides it. @param {Shot} at */
  clearPitch(at) {
    const stage = /** @type {Stage} */ (this.stage);
    let steepest = Math.tan(at.pitch);
    for (let s = .06; s <= 1; s += .06) {
      const way = at.distance * Math.cos(at.pitch) * s;
      const x = at.x + Math.cos(at.yaw) * way, y = at.y + Math.sin(at.yaw) * way;
      steepest = Math.max(steepest, (stage.heightAt(x, y) + stage.size - at.z) / way);
    }
    return clamp(Math.atan(steepest), FLATTEST, 1.35);
  }

  /** How far off the whole map fills the free picture, and how it is moved into its middle. @param {Shot} at */
  fit(at) {
    const stage = /** @type {Stage} */ (this.stage), flat = at.pitch > STEEPEST, { left, top, right, bottom } = this.insets;
    const w = Math.max(40, this.width - left - right), h = Math.max(40, this.height - top - bottom);
    const key = [at.yaw, at.pitch, flat, w, h, left, top].join();
    if (this.fitted?.key === key) {
      at.sx = this.fitted.sx, at.sy = this.fitted.sy;
      return this.fitted.far;
    }
    let near = stage.radius * .2, far = stage.radius * 20;
    for (let i = 0; i < 18; i++) {
      at.distance = i < 17 ? Math.sqrt(near * far) : far;
      at.sx = at.sy = 0;
      this.place(at, flat);
      let x0 = Infinity, y0 = Infinity, x1 = -Infinity, y1 = -Infinity;
      for (const c of stage.corners) {
        const p = this.project(c[0], c[1], c[2]);
        if (!p) x1 = Infinity;
        else x0 = Math.min(x0, p.x), x1 = Math.max(x1, p.x), y0 = Math.min(y0, p.y), y1 = Math.max(y1, p.y);
      }
      if (x1 - x0 < FULL * w && y1 - y0 < FULL * h) far = at.distance; else near = at.distance;
      at.sx = (left + w / 2 - (x0 + x1) / 2) / this.width * 2;
      at.sy = ((y0 + y1) / 2 - top - h / 2) / this.height * 2;
    }
    this.fitted = { key, far, sx: at.sx, sy: at.sy };
    return far;
  }

  /** Makes eye and matrix. @param {Shot} at @param {boolean} flat without perspective */
  place(at, flat) {
    const stage = /** @type {Stage} */ (this.stage), { left, top, right, bottom } = this.insets;
    const c = Math.cos(at.pitch) * at.distance, aspect = this.width / this.height;
    this.eye = [at.x + Math.cos(at.yaw) * c, at.y + Math.sin(at.yaw) * c, at.z + Math.sin(at.pitch) * at.distance];
    const floor = stage.heightAt(this.eye[0], this.eye[1]) + stage.size;
    if (!flat && this.eye[2] < floor) this.eye[2] = floor;
    const target = /** @type {import('./vectors.js').Vector} */ ([at.x, at.y, at.z]);
    const up = /** @type {import('./vectors.js').Vector} */ (flat ? [0, 1, 0] : [0, 0, 1]);
    const far = at.distance + stage.radius * 8;
    const lens = flat ? orthographic(at.distance * Math.tan(ANGLE / 2), aspect, -stage.radius * 2, far)
      : perspective(ANGLE, aspect, Math.max(.05, Math.min(1, at.distance * .03)), far);
    // what panels cover moves the middle: by so much of the picture
    const sx = (left - right) / this.width + at.sx, sy = (bottom - top) / this.height + at.sy;
    for (let k = 0; k < 16; k += 4) lens[k] += sx * (flat ? +(k === 12) : lens[k + 3]), lens[k + 1] += sy * (flat ? +(k === 12) : lens[k + 3]);
    this.matrix = times(lens, lookAt(this.eye, target, up));
    this.scale = 2 * Math.tan(ANGLE / 2) / this.height * (flat ? at.distance : 1);
  }

  /** Where a point is in the picture, CSS pixels from the upper left, and its w; null behind the eye. @param {number} x @param {number} y @param {number} z */
  project(x, y, z) {
    const m = this.matrix, w = m[3] * x + m[7] * y + m[11] * z + m[15];
    if (w <= 1e-6) return null;
    return {
      x: (1 + (m[0] * x + m[4] * y + m[8] * z + m[12]) / w) / 2 * this.width,
      y: (1 - (m[1] * x + m[5] * y + m[9] * z + m[13]) / w) / 2 * this.height, w,
    };
  }

  /** Metres that a CSS pixel covers where a point's w is this. @param {number} w */
  metresPerPixel(w) {
    return (this.scale ?? 1) * w;
  }
}
