// @ts-check
// What the modes of play put on the ground: a race's gates, crumbs, the place to hold, and what the map has at its
// edges and in its middle.
import { THEMES, rgb } from './colours.js';

/** @typedef {[number, number, number]} Light */
/** @typedef {{a: number[], b: number[], air?: boolean, state: 'next' | 'passed' | 'later', number: number}} Gate */
/** @typedef {{x: number, y: number, radius: number, state: 'free' | 'yours' | 'held' | 'contested', colour?: number | 'you', next?: {x: number, y: number, radius: number} | null}} Ring */
/** @typedef {{gates?: Gate[], crumbs?: {x: number, y: number, value: number}[], ring?: Ring | null, ghosts?: any[], arrow?: {x: number, y: number} | null}} Marks */

/**
 * Where marks are drawn: solid ones, those that lie on the ground, and what one looks through.
 * size(x, y): half the length that a louse is drawn with there [m]; seconds: a clock, standing where the reader
 * wants calm; nearest(a, b): where b is nearest to a, beyond an edge perhaps.
 * @typedef {{solid: import('./batch.js').Batch, decals: import('./batch.js').Batch, air: import('./batch.js').Batch,
 *   heightAt: import('./batch.js').HeightAt, size: (x: number, y: number) => number, seconds: number, louse: (index: any) => Light, goal: Light,
 *   isDark: boolean, nearest: (a: number[], b: number[]) => number[]}} Board
 */

/** @type {Light} */
const WHITE = [1, 1, 1];
const GOLD = rgb(0xffc83d), PASSED = rgb(0x8d95a8), LATER = rgb(0xcfe0ff), AIR = rgb(0x7fe3ff);
const CRUMB = rgb(0xffe6b0), ALARM = rgb(0xff5a3c), DUSK = rgb(0x141828);

/** How high a gate's posts are, in half lengths of a louse there. */
export const POSTS = 3.2;

/** The middle of a gate. @param {Gate} gate */
export const middleOf = gate => [(gate.a[0] + gate.b[0]) / 2, (gate.a[1] + gate.b[1]) / 2];

/** Gates, and the way from one to the next. @param {Board} board @param {Gate[]} gates */
export function drawGates(board, gates) {
  const { solid, decals, air, heightAt, seconds, goal } = board;
  for (let k = 0; k < gates.length; k++) {
    const gate = gates[k], to = gates[(k + 1) % gates.length], from = middleOf(gate), [mx, my] = from;
    const size = board.size(mx, my), isNext = gate.state === 'next', isDone = gate.state === 'passed';
    if (gates.length > 2 || k === 0) {
      // the shorter way, over the edges of a map that wraps: then once from either end
      const end = middleOf(to), near = board.nearest(from, end);
      const line = (a, b) => {
        decals.band(heightAt, a, b, size * .13, size * .04, DUSK, .22, 0);
        decals.band(heightAt, a, b, size * .08, size * .05, WHITE, .6, 1);
      };
      line(from, near);
      if (near[0] !== end[0] || near[1] !== end[1]) line([from[0] + end[0] - near[0], from[1] + end[1] - near[1]], end);
    }
    const colour = isNext ? goal : isDone ? PASSED : gate.air ? AIR : LATER;
    const height = size * POSTS * (isNext ? 1.25 : 1), half = size * (isNext ? .17 : .12);
    for (const [x, y] of [gate.a, gate.b]) {
      solid.post(x, y, heightAt(x, y), half, height, colour);
      if (isNext) solid.stone(x, y, heightAt(x, y) + height + half * 2.4, half * 2, seconds, colour);
    }
    const a = [...gate.a, heightAt(gate.a[0], gate.a[1])], b = [...gate.b, heightAt(gate.b[0], gate.b[1])];
    // no colour is seen on every ground: it lies on a dark one
    decals.band(heightAt, gate.a, gate.b, size * (isNext ? .3 : .16), size * .05, DUSK, isDone ? .3 : .7, 0);
    decals.band(heightAt, gate.a, gate.b, size * (isNext ? .16 : .09), size * .06, colour, isDone ? .5 : .95, isNext ? 0 : 1);
    const low = gate.air ? .55 : 0, pieces = 8, shine = isDone ? .07 : isNext ? .34 : .15;
    const at = (t, up) => {
      const x = a[0] + (b[0] - a[0]) * t, y = a[1] + (b[1] - a[1]) * t;
      return [x, y, Math.max(heightAt(x, y), up > .5 ? Math.min(a[2], b[2]) : -Infinity) + up * height];
    };
    for (let i = 0; i < pieces; i++) {
      const glow = isNext ? shine * (1 + .35 * Math.sin(seconds * 4 - i * .8)) : shine;
      air.quad(at(i / pieces, low), at((i + 1) / pieces, low), at((i + 1) / pieces, 1), at(i / pieces, 1), colour, low ? glow * .4 : glow, low ? glow : glow * .15);
      air.quad(at(i / pieces, .93), at((i + 1) / pieces, .93), at((i + 1) / pieces, 1), at(i / pieces, 1), colour, isDone ? .25 : .8);
    }
    if (isNext) drawChevrons(board, gate, size);
  }
}

/** Which way a gate is driven through: from the right-hand side of a to b to the left. @param {Board} board @param {Gate} gate @param {number} size */
function drawChevrons({ decals, heightAt, seconds, goal }, gate, size) {
  const dx = gate.b[0] - gate.a[0], dy = gate.b[1] - gate.a[1], n = Math.hypot(dx, dy) || 1, [mx, my] = middleOf(gate);
  const ahead = [-dy / n, dx / n], side = [dx / n, dy / n], w = Math.min(n * .16, size * 2), lift = size * .07;
  for (let k = 0; k < 3; k++) {
    const s = (k - 3.1) * w * .85, alpha = .5 + .45 * Math.sin(seconds * 5 - k * 1.4);
    const at = (along, across) => {
      const x = mx + ahead[0] * (s + along) + side[0] * across, y = my + ahead[1] * (s + along) + side[1] * across;
      return [x, y, heightAt(x, y) + lift];
    };
    for (const hand of [-1, 1]) decals.quad(at(0, hand * w), at(w * .4, hand * w), at(w * 1.1, 0), at(w * .7, 0), goal, alpha);
  }
}

/** @param {Board} board @param {{x: number, y: number, value: number}[]} crumbs */
export function drawCrumbs({ solid, decals, heightAt, size, seconds, isDark }, crumbs) {
  for (const { x, y, value } of crumbs) {
    const half = size(x, y) * (value > 1 ? .62 : .36), ground = heightAt(x, y), rich = value > 1;
    const up = half * (rich ? 1.9 + .25 * Math.sin(seconds * 2.2 + x) : 1);
    decals.disc([x, y, ground + half * .12], [half * 1.9, 0, 0], [0, half * 1.9, 0], 10, rich ? GOLD : DUSK, rich ? .75 : isDark ? .5 : .4, 0);
    solid.stone(x, y, ground + up, half, rich ? seconds * 1.6 + y : x * 7, rich ? GOLD : CRUMB);
    if (rich) decals.circle(heightAt, x, y, half * 2.2, half * .14, half * .1, GOLD, .9, 0);
  }
}

/** The place to hold. @param {Board} board @param {Ring} ring */
export function drawRing(board, ring) {
  const { decals, air, heightAt, seconds, isDark } = board, { x, y, radius, state, next } = ring;
  const size = board.size(x, y), width = Math.max(radius * .035, size * .1), lift = size * .06;
  const colour = state === 'yours' ? board.louse('you') : state === 'held' ? board.louse(ring.colour ?? 0) : state === 'contested' ? ALARM : isDark ? WHITE : DUSK;
  for (let r = .98, k = 0; k < 4; k++, r -= .22) // a faint field, brighter towards the rim
    decals.circle(heightAt, x, y, radius * (r - .11), radius * .11, lift, colour, (state === 'free' ? .05 : .13) * r * r, 0);
  if (state === 'contested') {
    decals.circle(heightAt, x, y, radius, width * 1.5, lift, DUSK, .6, 0);
    decals.circle(heightAt, x, y, radius, width * 1.5, lift * 1.2, ALARM, .7 + .3 * Math.sin(seconds * 9), 4);
  } else {
    decals.circle(heightAt, x, y, radius, width * 1.8, lift, isDark ? DUSK : WHITE, .35, 0);
    decals.circle(heightAt, x, y, radius, width, lift * 1.2, colour, .95, 0);
  }
  const pieces = 48, high = size * (state === 'free' ? 1 : 2);
  const at = (k, up) => {
    const a = k / pieces * 2 * Math.PI, px = x + Math.cos(a) * radius, py = y + Math.sin(a) * radius;
    return [px, py, heightAt(px, py) + up];
  };
  for (let k = 0; k < pieces; k++) air.quad(at(k, 0), at(k + 1, 0), at(k + 1, high), at(k, high), colour, state === 'free' ? .15 : .32, 0);
  if (next) {
    decals.circle(heightAt, next.x, next.y, next.radius, width * 1.3, lift, DUSK, .6, 0);
    decals.circle(heightAt, next.x, next.y, next.radius, width * .8, lift * 1.2, board.goal, .55 + .35 * Math.sin(seconds * 5), 3);
  }
}

/** Walls at the map's edge, to look through. @param {import('./batch.js').Batch} air @param {number[]} domain @param {import('./batch.js').HeightAt} heightAt @param {number} high @param {boolean} isDark */
export function drawWalls(air, domain, heightAt, high, isDark) {
  const [x0, y0, x1, y1] = domain, corners = [[x0, y0], [x1, y0], [x1, y1], [x0, y1]], pieces = 40;
  const colour = isDark ? rgb(0x9fc4ff) : rgb(0x40588c);
  for (let k = 0; k < 4; k++) {
    const a = corners[k], b = corners[(k + 1) % 4];
    const at = (i, up) => {
      const x = a[0] + (b[0] - a[0]) * i / pieces, y = a[1] + (b[1] - a[1]) * i / pieces;
      return [x, y, heightAt(x, y) + up];
    };
    for (let i = 0; i < pieces; i++) {
      air.quad(at(i, 0), at(i + 1, 0), at(i + 1, high), at(i, high), colour, .34, .04);
      air.quad(at(i, high * .92), at(i + 1, high * .92), at(i + 1, high), at(i, high), colour, .5);
    }
  }
}

/** What pulls in the middle of the map: circles on the ground. @param {import('./batch.js').Batch} decals @param {number} x @param {number} y @param {number} radius of the map
 * @param {import('./batch.js').HeightAt} heightAt */
export function drawWell(decals, x, y, radius, heightAt) {
  for (let k = 1; k <= 5; k++) decals.circle(heightAt, x, y, radius * .035 * k * k * .55, radius * .0022 * (1 + k * .2), radius * 4e-4, rgb(0xffd9a0), .5 / k, 0);
  decals.disc([x, y, heightAt(x, y) + radius * 6e-4], [radius * .22, 0, 0], [0, radius * .22, 0], 40, rgb(0xff9a3c), .75, 0);
}

/** The sun over it, facing the eye. @param {import('./batch.js').Batch} air @param {number[]} o @param {number[]} right @param {number[]} up @param {number} radius */
export function drawSun(air, o, right, up, radius) {
  const scaled = (v, s) => v.map(c => c * s * radius);
  air.disc(o, scaled(right, .085), scaled(up, .085), 32, rgb(0xff8a2c), .7, 0);
  air.disc(o, scaled(right, .03), scaled(up, .03), 28, rgb(0xffcf70), 1, .85);
  air.disc(o, scaled(right, .022), scaled(up, .022), 24, rgb(0xfff6d8), 1, .2);
}

/** What never moves on a ground: the block's shadow, walls, what pulls in the middle. @param {{floor: import('./batch.js').Batch, border: import('./batch.js').Batch, walls: import('./batch.js').Batch}} scenery
 * @param {import('./relief.js').Relief} relief @param {number} bottom of the block, as drawn [m] @param {import('./colours.js').ThemeName} theme */
export function buildScenery({ floor, border, walls }, relief, bottom, theme) {
  const { ground, radius: r } = relief, [x0, y0, x1, y1] = ground.domain, heightAt = (x, y) => relief.heightAt(x, y) * relief.exaggeration;
  floor.count = border.count = walls.count = 0;
  for (let k = 0; k < 6; k++) { // a shadow on what the block stands on, softer outwards
    const at = (i, grow) => [[x0 - grow, y0 - grow], [x1 + grow, y0 - grow], [x1 + grow, y1 + grow], [x0 - grow, y1 + grow]][i % 4];
    const near = r * .05 * k, far = near + r * .05, dark = v => THEMES[theme].shade * (1 - v / 6) ** 2;
    for (let i = 0; i < 4; i++)
      floor.quad([...at(i, near), bottom], [...at(i + 1, near), bottom], [...at(i + 1, far), bottom], [...at(i, far), bottom], [0, 0, 0], dark(k), dark(k + 1));
  }
  if (relief.isFlat && (ground.edges ?? 'walls') === 'walls' && !ground.wraps?.[0]) {
    drawWalls(walls, ground.domain, heightAt, r * .035, theme === 'dark');
    const corners = [[x0, y0], [x1, y0], [x1, y1], [x0, y1]];  // from above a wall is a line
    corners.forEach((corner, k) => border.band(heightAt, corner, corners[(k + 1) % 4], r * .006, r * 1e-4, theme === 'dark' ? WHITE : DUSK, .55, 0));
  }
  if (ground.centre) drawWell(border, ...centreOf(ground.centre), r, heightAt);
}

/** Where it is that pulls: a pair, or an object with x and y. @param {any} centre @returns {[number, number]} */
export const centreOf = centre => Array.isArray(centre) ? [centre[0], centre[1]] : [centre.x ?? 0, centre.y ?? 0];
