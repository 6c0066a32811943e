// @ts-check
// The picture's colours. Lice have those of the terminal client (client/drawing/palette.cpp): no two, seen by the
// eyes of their palette, are nearer than 8 in Oklab times 100. Ramps go from dark to light, so that they read in
// grey. A colour is 0xRRGGBB; in shaders three numbers from 0 to 1.

/** @typedef {'default' | 'deutan' | 'tritan'} Palette */
/** @typedef {'dark' | 'light'} ThemeName */
/** @typedef {[number, number][]} Ramp  places from 0 to 1, ascending, and their colours */

/** By palette: your own louse's, then the others'. @type {Record<Palette, number[]>} */
export const LICE = {
  default: [0xff3870, 0xffcd54, 0x6ed6ff, 0x8cfa8c, 0xba8aff, 0xff9cdc, 0xffa55e, 0xacf0de],
  deutan: [0x875fff, 0xd7ff00, 0x5fafff, 0x878700, 0x87ffff, 0xafd787, 0xd7afd7, 0x5f87af],
  tritan: [0x00ffaf, 0xff87ff, 0x5f87ff, 0x87d75f, 0xd7ffd7, 0xff0000, 0xaf5fff, 0xd700d7],
};

/** What is wanted of you, a goal, is in this and nothing else is. @type {Record<Palette, number>} */
export const GOALS = { default: 0xffff5f, deutan: 0xffffaf, tritan: 0xffd75f };

/**
 * height: the ground by tone; sky: above, below, the glow behind the map; soil: three layers; ink: how much of the
 * ground's light a contour leaves; halo: behind names; text: names that have no colour of their own.
 * @type {Record<ThemeName, {height: Ramp, slope: Ramp, sky: number[], soil: number[], ink: number, sun: number,
 *   halo: string, text: string, shade: number}>}
 */
export const THEMES = {
  dark: {
    height: [[0, 0x122350], [.15, 0x184f7c], [.3, 0x217f86], [.45, 0x559a6c], [.6, 0xa3ac63], [.76, 0xdcb671],
      [.9, 0xf3d0a4], [1, 0xfffaf0]],
    slope: [[0, 0x14123c], [.25, 0x5c1e74], [.5, 0xba3860], [.75, 0xf68c3c], [1, 0xfcf4aa]],
    sky: [0x1d2338, 0x090b12, 0x34405e], soil: [0x6b543f, 0x55443a, 0x3a312e], ink: .42, sun: 1,
    halo: 'rgba(8,10,18,.82)', text: '#f2f4fa', shade: .55,
  },
  light: {
    height: [[0, 0x35618f], [.15, 0x4c8bb0], [.3, 0x6db3ab], [.45, 0x9ac58c], [.6, 0xcdce8e], [.76, 0xecd29c],
      [.9, 0xf7e3c6], [1, 0xffffff]],
    slope: [[0, 0x3a3a7c], [.25, 0x8c56a4], [.5, 0xd86a86], [.75, 0xf8b070], [1, 0xfdf8c8]],
    sky: [0xcfdcea, 0xf6f4ef, 0xffffff], soil: [0xa98d72, 0x8f7761, 0x6f5e50], ink: .55, sun: 1.16,
    halo: 'rgba(255,255,255,.86)', text: '#14161d', shade: .3,
  },
};

/** Three numbers from 0 to 1. @param {number} colour @returns {[number, number, number]} */
export const rgb = colour => [(colour >> 16 & 255) / 255, (colour >> 8 & 255) / 255, (colour & 255) / 255];

/** For style sheets and canvases. @param {number} colour */
export const css = colour => '#' + colour.toString(16).padStart(6, '0');

/** A ramp's colour at t, 0 to 1, as three numbers from 0 to 1. @param {Ramp} ramp @param {number} t @returns {[number, number, number]} */
export function along(ramp, t) {
  let i = 1;
  while (i < ramp.length - 1 && t > ramp[i][0]) i++;
  const u = Math.max(0, Math.min(1, (t - ramp[i - 1][0]) / (ramp[i][0] - ramp[i - 1][0])));
  const a = rgb(ramp[i - 1][1]), b = rgb(ramp[i][1]);
  return [a[0] + (b[0] - a[0]) * u, a[1] + (b[1] - a[1]) * u, a[2] + (b[2] - a[2]) * u];
}

/** How many colours the others have; then they repeat, with another coat. */
export const OTHERS = 7;

/** A louse's: yours, or by number. @param {Palette} palette @param {number | 'you'} index */
export const louseColour = (palette, index) =>
  LICE[palette][index === 'you' ? 0 : 1 + ((index % OTHERS + OTHERS) % OTHERS | 0)];
