// @ts-check
// What a map has at its edges and in its middle, whatever is played on it.
import { THEMES, rgb } from './colours.js';

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
    corners.forEach((corner, k) => border.band(heightAt, corner, corners[(k + 1) % 4], r * .006, r * 1e-4, theme === 'dark' ? [1, 1, 1] : rgb(0x141828), .55, 0));
  }
  if (ground.centre) drawWell(border, ...centreOf(ground.centre), r, heightAt);
}

/** Where it is that pulls: a pair, or an object with x and y. @param {any} centre @returns {[number, number]} */
export const centreOf = centre => Array.isArray(centre) ? [centre[0], centre[1]] : [centre.x ?? 0, centre.y ?? 0];
