// @ts-check
// Turns a scene into what is drawn of it: instances of lice, triangles, ribbons, names.
import { arrowTo } from './arrows.js';
import { Batch } from './batch.js';
import { GOALS, OTHERS, louseColour, rgb } from './colours.js';
import { bodyAxes } from './louse.js';
import { centreOf, drawSun } from './scenery.js';
import { POINTS, Ribbons, Trails } from './trails.js';
import { clamp } from './vectors.js';

/**
 * A louse with the wire's names (id, phase, x, y, vx, vy, heading_x, heading_y, flight_z, flight_vz, distance), the
 * ground under it (z, zx, zy), its name and the number of its colour.
 * @typedef {{id: any, phase: number, x: number, y: number, vx: number, vy: number, heading_x: number, heading_y: number,
 *   flight_z: number, flight_vz: number, distance: number, z: number, zx: number, zy: number, name?: string, colour?: number | 'you',
 *   isYou?: boolean, isGhost?: boolean, outline?: boolean, kind?: string}} Louse
 */
/** @typedef {{lice: Louse[], you?: any, follow?: any, marks?: import('./marks.js').Marks | null, trails?: boolean}} Scene */

/** Half of a louse's length on the ground [m], and in the picture at least [CSS pixels]: many are drawn smaller. */
const HALF = .62, LEAST = 10.5, LEAST_OF_MANY = 6.5, MANY = 60;
const FLYING = 2;
/** @type {[number, number, number]} */
const WHITE = [1, 1, 1], BLACK = /** @type {[number, number, number]} */ ([0, 0, 0]);
/** Ghosts' names and colours, where they have none of their own. @type {Record<string, [string, number | 'you']>} */
const GHOSTS = { record: ['record', 0], author: ['author', 3], own: ['your last', 'you'] };

/** Whether a place is one that can be drawn; it came from afar. @param {{x: number, y: number, z: number}} place */
const isSomewhere = ({ x, y, z }) => Math.abs(x) + Math.abs(y) + Math.abs(z) < 1e7;

export class Staging {
  constructor() {
    this.solid = new Batch();
    this.decals = new Batch();
    this.air = new Batch();
    /** What is seen through hills, too. */
    this.through = new Batch();
    this.ribbons = new Ribbons(32768);
    this.trails = new Trails();
    this.data = new Float32Array(16 * 256);
    this.pixels = new Float32Array(256);
    this.instances = 0;
    /** @type {import('./names.js').Name[]} */
    this.names = [];
    /** @type {{x: number, y: number, angle: number, colour: number}[]} */
    this.arrows = [];
    /** @type {{id: any, x: number, y: number}[]} */
    this.shown = [];
    /** The height of the drawn ground. @type {(x: number, y: number) => number} */
    this.heightAt = () => 0;
    /** What stage() was given last. @type {{camera: import('./camera.js').Camera, theme: import('./colours.js').ThemeName} | undefined} */
    this.look = undefined;
    this.seconds = 0;
    /** marks.js, which comes behind the first picture; null before. @type {typeof import('./marks.js').drawMarks | null} */
    this.drawMarks = null;
    this.goal = GOALS.default;
    this.wraps = false;
    /** @type {any} */
    this.lastFollowed = null;
  }

  /** @param {import('./relief.js').Relief} relief */
  setRelief(relief) {
    this.relief = relief;
    this.heightAt = (x, y) => relief.heightAt(x, y) * relief.exaggeration;
    this.trails.clear();
    this.trails.slack = relief.radius * .06;
    const { wraps = [] } = relief.ground;
    this.wraps = !!(wraps[0] || wraps[1]);
    this.trails.around = [wraps[0] ? relief.width : 0, wraps[1] ? relief.depth : 0];
    this.lastFollowed = null;
  }

  /** Where a louse is drawn. @param {Louse} louse */
  placeOf(louse) {
    const E = this.relief ? this.relief.exaggeration : 1;
    const z = louse.phase === FLYING ? louse.flight_z : louse.z ?? this.relief?.heightAt(louse.x, louse.y) ?? 0;
    return { x: louse.x, y: louse.y, z: z * E };
  }

  /** A place, on a map that wraps the nearest of those that it is. @template {{x: number, y: number}} T @param {T} place @returns {T} */
  near(place) {
    if (!this.wraps || !this.relief || !this.look) return place;
    const [x, y] = this.relief.nearest(this.look.camera.middle, [place.x, place.y]);
    return { ...place, x, y };
  }

  /** Where the louse to follow is, or was last. @param {Scene} scene @param {any} id */
  find(scene, id) {
    if (!id) return null;
    const louse = scene.lice.find(l => l.id === id && !l.isGhost), at = louse && this.placeOf(louse);
    if (at && isSomewhere(at)) this.lastFollowed = { id, ...at };
    return this.lastFollowed?.id === id ? this.lastFollowed : null;
  }

  /** @param {Scene} scene @param {{camera: import('./camera.js').Camera, palette: import('./colours.js').Palette, theme: import('./colours.js').ThemeName, calm: boolean}} look
   * @param {number} now ms @param {number} width pixels of the picture @param {number} height */
  stage(scene, look, now, width, height) {
    const { camera, palette } = look, marks = scene.marks ?? {}, relief = this.relief;
    if (!relief) return;
    for (const batch of [this.solid, this.decals, this.air, this.through]) batch.count = 0;
    this.ribbons.begin(camera.matrix, width, height);
    this.instances = 0;
    this.names = [];
    this.arrows = [];
    this.shown = [];
    this.look = look;
    this.seconds = look.calm ? 0 : now / 1000;
    const least = scene.lice.length > MANY ? LEAST_OF_MANY : LEAST, ratio = width / camera.width;
    const isDue = scene.trails !== false && this.trails.isDue(now) && !scene.lice.every(l => this.trails.endsAt(l.id, l.x, l.y)), followed = scene.follow || camera.follow;
    const size = (x, y, z) => {
      const p = camera.project(x, y, z);
      return Math.max(HALF, p ? least * camera.metresPerPixel(p.w) : 0);
    };
    const board = {
      solid: this.solid, decals: this.decals, air: this.air, heightAt: this.heightAt, seconds: this.seconds, isDark: look.theme === 'dark',
      size: (x, y) => size(x, y, this.heightAt(x, y)), louse: index => rgb(louseColour(palette, index)), goal: rgb(GOALS[palette]), nearest: (a, b) => relief.nearest(a, b),
    };
    this.goal = GOALS[palette];
    if (scene.marks) this.drawMarks?.(this, board, scene.marks);
    const lice = marks.ghosts?.length ? scene.lice.concat(marks.ghosts.map((g, k) => {
      const [name, colour] = GHOSTS[g.kind] ?? ['ghost', 0];
      return { ...g, id: `ghost ${k}`, isGhost: true, name: g.name ?? name, colour: g.colour ?? colour };
    })) : scene.lice;
    for (const louse of lice) {
      const at = this.near(this.placeOf(louse));
      if (!isSomewhere(at)) continue;
      const isYou = louse.isYou ?? (louse.id === scene.you && !louse.isGhost), isGhost = !!(louse.isGhost || louse.outline), own = isYou || louse.id === followed;
      const colour = louseColour(palette, isYou ? 'you' : louse.colour ?? louse.id), c = rgb(colour);
      const half = size(at.x, at.y, at.z) * (isYou ? 1.12 : 1);
      if (isDue && !isGhost) this.trails.add(louse.id, at.x, at.y, at.z, Math.hypot(louse.vx, louse.vy));
      const p = camera.project(at.x, at.y, at.z + half * .4), pixels = p ? half / camera.metresPerPixel(p.w) : 1;
      this.put(louse, at, half, c, isGhost, isYou, own, pixels);
      if (!p) continue;
      this.shown.push({ id: isGhost && !(louse.id > 0) ? 0 : louse.id, x: p.x, y: p.y });
      this.pixels[this.instances - 1] = pixels;
      const rank = isYou ? Infinity : own ? 1e6 : isGhost ? 1e3 : 1 / p.w;
      this.names.push({ key: louse.id, text: isYou ? 'you' : String(louse.name ?? '#' + louse.id), colour, badge: isYou, x: p.x, y: p.y, reach: pixels * (own ? 1.35 : .8) + 3, rank });
      if (scene.trails !== false && !isGhost) this.trail(louse, at, c, own, ratio, lice.length > MANY, now);
      if (isYou) this.arrows.push(...arrowTo(at, colour, camera, 0));
    }
    if (isDue) this.trails.sweep();
    if (marks.arrow) this.arrows.push(...arrowTo({ ...this.near(marks.arrow), z: this.heightAt(marks.arrow.x, marks.arrow.y) }, GOALS[palette], camera, 34 + 3 * Math.sin(this.seconds * 5)));
    const centre = relief.ground.centre;
    if (centre) {
      const m = camera.matrix, [x, y] = centreOf(centre), n = Math.hypot(m[0], m[4], m[8]), u = Math.hypot(m[1], m[5], m[9]);
      drawSun(this.air, [x, y, this.heightAt(x, y) + relief.radius * .02], [m[0] / n, m[4] / n, m[8] / n], [m[1] / u, m[5] / u, m[9] / u], relief.radius);
    }
  }

  /** A louse, its shadow, its ring. @private @param {Louse} louse @param {{x: number, y: number, z: number}} at @param {number} half @param {[number, number, number]} c
   * @param {boolean} isGhost @param {boolean} isYou @param {boolean} own @param {number} pixels half its length in the picture */
  put(louse, at, half, c, isGhost, isYou, own, pixels) {
    const relief = /** @type {import('./relief.js').Relief} */ (this.relief), E = relief.exaggeration, isFlying = louse.phase === FLYING;
    if (16 * (this.instances + 1) > this.data.length) {
      const data = new Float32Array(2 * this.data.length), pixels = new Float32Array(2 * this.pixels.length);
      data.set(this.data);
      pixels.set(this.pixels);
      this.data = data;
      this.pixels = pixels;
    }
    const d = this.data, k = 16 * this.instances++, zx = (louse.zx ?? 0) * E, zy = (louse.zy ?? 0) * E;
    let hx = louse.heading_x, hy = louse.heading_y;
    const n = Math.sqrt(hx * hx + hy * hy);
    if (n > 0) hx /= n, hy /= n; else hx = 1, hy = 0;
    if (isFlying) { // along its way, not along the ground
      const climb = clamp(louse.flight_vz * E / Math.max(.5, Math.hypot(louse.vx, louse.vy)), -1.5, 1.5);
      bodyAxes(hx, hy, hx * climb, hy * climb, d, k + 4);
    } else bodyAxes(hx, hy, zx, zy, d, k + 4);
    d[k] = at.x, d[k + 1] = at.y, d[k + 2] = at.z + (isFlying ? half * .2 : 0), d[k + 3] = half;
    d[k + 7] = louse.distance / half * 4;
    d[k + 11] = isGhost ? 1 : 0;
    const ink = isGhost && this.look?.theme === 'light' ? .4 : 1;  // outlines are dark on what is bright
    d[k + 12] = c[0] * ink, d[k + 13] = c[1] * ink, d[k + 14] = c[2] * ink, d[k + 15] = isYou ? 0 : Math.floor(Number(louse.colour ?? louse.id) / OTHERS) % 4 || 0;
    // on the ground below it
    const ground = isFlying ? this.heightAt(at.x, at.y) : at.z, high = Math.max(0, at.z - ground), lift = half * .07;
    const fx = hx * half, fy = hy * half, rise = s => [s * fx, s * fy, s * (zx * fx + zy * fy)], side = s => [-s * fy, s * fx, s * (zy * fx - zx * fy)];
    const spread = 1 + Math.min(1.2, high / (8 * half)), o = [at.x + .16 * half, at.y - .13 * half, ground + lift + .16 * half * zx - .13 * half * zy];
    if (!isGhost && this.drawMarks) this.decals.disc(o, rise(1.22 * spread), side(.9 * spread), this.instances > MANY ? 6 : 8, BLACK, isFlying ? .42 / spread : .6, 0);
    if (isFlying && high > half) {
      this.ribbons.cut();
      this.ribbons.add(at.x, at.y, ground, 1, c[0], c[1], c[2], .25);
      this.ribbons.add(at.x, at.y, at.z, 1, c[0], c[1], c[2], .8);
    }
    if (!own) return;
    const r = (isYou ? 1.85 + .08 * Math.sin(this.seconds * 4) : 1.8) * half, wide = clamp(1.6 / pixels, .03, .2) * half;
    const ring = (radius, width, colour, alpha) => this.decals.circle(this.heightAt, at.x, at.y, radius, width, lift, colour, alpha, 0);
    ring(r, wide * 2.6, BLACK, .4);
    ring(r, wide, isYou ? c : WHITE, 1);
    if (!isYou) return;
    ring(r - wide * 1.8, wide * .8, WHITE, 1);
    this.through.circle(this.heightAt, at.x, at.y, r, wide, lift, c, .4, 0);
  }

  /** @private @param {Louse} louse @param {{x: number, y: number, z: number}} at @param {[number, number, number]} c @param {boolean} own @param {number} ratio pixels a CSS pixel
   * @param {boolean} isOneOfMany every second point will do @param {number} now ms */
  trail(louse, at, c, own, ratio, isOneOfMany, now) {
    const trail = this.trails.trails.get(louse.id), { ribbons } = this;
    if (!trail || trail.count < 2) return;
    // pale colours are lost on a bright ground
    const isLight = this.look?.theme === 'light', [red, green, blue] = isLight ? c.map(v => v * .62) : c;
    const p = trail.points, strength = own || isLight ? .95 : .62, wide = (own ? 2 : 1.35) * ratio, lift = .05;
    const half = (this.relief?.radius ?? 0) * .6;  // farther: another one of the places that it is
    let x = 0, y = 0;
    ribbons.cut();
    for (let k = 0; k < trail.count; k++) {
      const point = (trail.end - trail.count + k + POINTS) % POINTS, i = 4 * point, age = k / trail.count, lastX = x, lastY = y;
      if (isOneOfMany && !own && point % 2 && !p[i + 3]) continue;
      x = p[i], y = p[i + 1];
      if (this.wraps) ({ x, y } = this.near({ x, y }));
      if (p[i + 3] || this.wraps && Math.abs(x - lastX) + Math.abs(y - lastY) > half) ribbons.cut();
      ribbons.add(x, y, p[i + 2] + lift, wide * (.3 + .7 * age), red, green, blue, strength * age);
    }
    if (Math.hypot(at.x - x, at.y - y) > this.trails.leap(Math.hypot(louse.vx, louse.vy), (now - this.trails.last) / 1000)) return;
    ribbons.add(at.x, at.y, at.z + lift, wide, red, green, blue, strength);
  }
}
