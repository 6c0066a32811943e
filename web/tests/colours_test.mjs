// Whether lice are told apart, and yours and the goal from the ground, by eyes of each kind: simulated after Machado, Oliveira and
// Fernandes (2009), severity 1, measured in Oklab times 100, as tests/client/drawing/palette_test.cpp does.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { test } from 'node:test';
import { GOALS, LICE, OTHERS, THEMES, along, css, louseColour, rgb } from '../page/picture/colours.js';
import { readableOn } from '../page/picture/names.js';

const EYES = {
  default: [[1, 0, 0], [0, 1, 0], [0, 0, 1]],
  deutan: [[0.367322, 0.860646, -0.227968], [0.280085, 0.672501, 0.047413], [-0.011820, 0.042940, 0.968881]],
  tritan: [[1.255528, -0.076749, -0.178779], [-0.078411, 0.930809, 0.147602], [0.004733, 0.691367, 0.303900]],
};
const times = (m, v) => m.map(row => row[0] * v[0] + row[1] * v[1] + row[2] * v[2]);
const linear = c => c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4;
function seen(colour, eyes) {
  const light = times(EYES[eyes], colour.map(linear)).map(c => Math.min(1, Math.max(0, c)));
  const cones = times([[0.4122214708, 0.5363325363, 0.0514459929], [0.2119034982, 0.6806995451, 0.1073969566],
    [0.0883024619, 0.2817188376, 0.6299787005]], light).map(Math.cbrt);
  return times([[0.2104542553, 0.7936177850, -0.0040720468], [1.9779984951, -2.4285922050, 0.4505937099],
    [0.0259040371, 0.7827717662, -0.8086757660]], cones).map(c => 100 * c);
}
const between = (a, b) => Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);

test('no two lice, nor the goal, are nearer than 8 to the eyes of their palette', () => {
  for (const eyes of Object.keys(EYES)) {
    const all = [...LICE[eyes], GOALS[eyes]].map(c => seen(rgb(c), eyes));
    for (let i = 0; i < all.length; i++)
      for (let j = 0; j < i; j++) assert.ok(between(all[i], all[j]) >= 8, `${eyes}: ${i} and ${j} are ${between(all[i], all[j])} apart`);
  }
});

test('the palettes are those of the terminal client', () => {
  const source = readFileSync(new URL('../../client/drawing/palette.cpp', import.meta.url), 'utf8');
  const list = /kLice = ([\s\S]*?);/.exec(source)[1];
  const there = [...list.matchAll(/\{(\d+), (\d+), (\d+)\}/g)].map(m => (+m[1] << 16) + (+m[2] << 8) + +m[3]);
  assert.deepEqual(Object.keys(LICE).flatMap(name => [...LICE[name], GOALS[name]]), there);
});

test('yours is 8 or more from the lit ground of every theme, for every eye', () => {
  let least = Infinity;
  for (const theme of Object.values(THEMES))
    for (const eyes of Object.keys(EYES))
      for (const ramp of [theme.height, theme.slope])
        for (let t = 0; t <= 1; t += .01)
          for (const light of [.45, .6, .8, 1]) { // squares: light is reckoned there
            const ground = along(ramp, t).map(c => c * Math.sqrt(light));
            least = Math.min(least, between(seen(ground, eyes), seen(rgb(louseColour(eyes, 'you')), eyes)));
          }
  assert.ok(least >= 8, `${least}`);
});

test("the ramps' lightness ascends, for every eye", () => {
  for (const theme of Object.values(THEMES))
    for (const eyes of Object.keys(EYES))
      for (const ramp of [theme.height, theme.slope]) {
        let last = -Infinity;
        for (let t = 0; t <= 1.0001; t += .02) {
          const [lightness] = seen(along(ramp, Math.min(1, t)), eyes);
          assert.ok(lightness > last, `${eyes} at ${t}: ${lightness} after ${last}`);
          last = lightness;
        }
      }
});

test('ramps meet their stops', () => {
  for (const { height } of Object.values(THEMES))
    for (const [at, colour] of height)
      along(height, at).forEach((c, k) => assert.ok(Math.abs(c - rgb(colour)[k]) < 1e-9));
});

test('others repeat after seven; a colour for style sheets has six digits', () => {
  assert.equal(louseColour('default', 3), louseColour('default', 3 + OTHERS));
  assert.notEqual(louseColour('default', 0), louseColour('default', 'you'));
  assert.equal(new Set(Array.from({ length: OTHERS }, (_, k) => louseColour('tritan', k))).size, OTHERS);
  assert.equal(css(0x00ffaf), '#00ffaf');
});

test('text on a badge has a contrast of 4.5 to 1', () => {
  const luminance = c => { const [r, g, b] = rgb(c).map(linear); return .2126 * r + .7152 * g + .0722 * b; };
  for (const palette of Object.keys(LICE))
    for (const colour of [...LICE[palette], GOALS[palette]]) {
      const [a, b] = [luminance(colour), luminance(parseInt(readableOn(colour).slice(1), 16))].sort((x, y) => y - x);
      assert.ok((a + .05) / (b + .05) >= 4.5, `${palette} ${css(colour)}`);
    }
});
