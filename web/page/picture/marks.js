// @ts-check
// What the modes of play put on the ground: a race's gates, crumbs, the place to hold.
import { rgb } from './colours.js';

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
const POSTS = 3.2;

/** The middle of a gate. @param {Gate} gate */
const middleOf = gate => [(gate.a[0] + gate.b[0]) / 2, (gate.a[1] + gate.b[1]) / 2];

/** Gates, and the way from one to the next. @param {Board} board @param {Gate[]} gates */
function drawGates(board, gates) {
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
function drawCrumbs({ solid, decals, heightAt, size, seconds, isDark }, crumbs) {
  for (const { x, y, value } of crumbs) {
    const half = size(x, y) * (value > 1 ? .62 : .36), ground = heightAt(x, y), rich = value > 1;
    const up = half * (rich ? 1.9 + .25 * Math.sin(seconds * 2.2 + x) : 1);
    decals.disc([x, y, ground + half * .12], [half * 1.9, 0, 0], [0, half * 1.9, 0], 10, rich ? GOLD : DUSK, rich ? .75 : isDark ? .5 : .4, 0);
    solid.stone(x, y, ground + up, half, rich ? seconds * 1.6 + y : x * 7, rich ? GOLD : CRUMB);
    if (rich) decals.circle(heightAt, x, y, half * 2.2, half * .14, half * .1, GOLD, .9, 0);
  }
}

/** The place to hold. @param {Board} board @param {Ring} ring */
function drawRing(board, ring) {
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

/** All of them, where a map wraps on this side of its edges. @param {import('./staging.js').Staging} staging @param {Board} board @param {Marks} marks */
export function drawMarks(staging, board, marks) {
  if (marks.ring) drawRing(board, { ...staging.near(marks.ring), next: marks.ring.next && staging.near(marks.ring.next) });
  if (marks.gates) {
    const gates = !staging.wraps ? marks.gates : marks.gates.map(gate => {
      const [x, y] = middleOf(gate), at = staging.near({ x, y }), move = p => [p[0] + at.x - x, p[1] + at.y - y];
      return { ...gate, a: move(gate.a), b: move(gate.b) };
    });
    drawGates(board, gates);
    nameGates(staging, gates, board);
  }
  if (marks.crumbs) drawCrumbs(board, marks.crumbs.map(crumb => staging.near(crumb)));
}

/** @param {import('./staging.js').Staging} staging @param {Gate[]} gates @param {Board} board */
function nameGates({ names, goal, look, heightAt }, gates, board) {
  for (const gate of gates) {
    const [x, y] = middleOf(gate), isNext = gate.state === 'next', z = heightAt(x, y) + board.size(x, y) * POSTS * (isNext ? 1.3 : .8);
    const p = look?.camera.project(x, y, z);
    if (p) names.push({ key: `gate ${gate.number}`, text: String(gate.number) + (gate.air ? ' air' : ''), colour: isNext ? goal : null, badge: isNext, x: p.x, y: p.y, reach: 2, rank: isNext ? 1e7 : 10 });
  }
}
