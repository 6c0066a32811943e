// What is in the picture's own pixels: the ground, your louse, both themes, every view; and all of it again once the graphics
// card has lost it.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { browsed, faults, Served, shown, until } from './served.mjs';

let served, context, page;
before(async () => {
  served = await Served.start('--map', 'maunga_climb', 'volcano', '--bots', '4', '--bots-alone', 'play', '--seed', '5');
  context = await browsed({ viewport: { width: 800, height: 600 }, colorScheme: 'dark', reducedMotion: 'reduce' });
  page = context.pages()[0];
  await shown(page, `${served.web}?room=volcano&play`);
  // the next picture's pixels, read while they are still there
  await page.evaluate(() => {
    const { picture } = window.woodlouse, draw = picture.draw.bind(picture);
    picture.draw = (scene, now) => {
      draw(scene, now);
      const { gl } = picture.drawing, { width, height } = gl.canvas;
      if (!window.asked || picture.drawing.isLost) return;
      const pixels = new Uint8Array(4 * width * height);
      gl.bindFramebuffer(gl.FRAMEBUFFER, null);
      gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
      const seen = new Map();
      let sum = 0;
      for (let k = 0; k < pixels.length; k += 4) sum += pixels[k] + pixels[k + 1] + pixels[k + 2], seen.set(pixels[k] >> 4 << 8 | pixels[k + 1] >> 4 << 4 | pixels[k + 2] >> 4, 1);
      const at = (x, y) => { const k = 4 * ((height - 1 - Math.round(y * height / picture.camera.height)) * width + Math.round(x * width / picture.camera.width)); return [...pixels.slice(k, k + 3)]; };
      const you = picture.staging.names.find(({ text }) => text === 'you');
      window.answer = { brightness: sum / (3 * width * height), colours: seen.size, corner: at(3, 3), error: gl.getError(), you: you && at(you.x, you.y), place: you && [you.x, you.y],
        scale: picture.resolution.scale, light: !!picture.drawing.light };
      window.asked = false;
    };
  });
});
after(async () => {
  await context?.close();
  await served?.stop();
});

async function looked() {
  await page.evaluate(() => { window.answer = null; window.asked = true; });
  await until(page, () => window.answer !== null, 30000);
  return page.evaluate(() => window.answer);
}
const press = (what) => page.evaluate((name) => document.querySelector(`[data-do=${name}]`).click(), what);

test('ground, sky and your louse are in the picture, in every view, without an error of WebGL', async () => {
  for (const view of ['orbit', 'follow', 'map', 'slope', 'orbit', 'slope']) {
    await press(view);
    const seen = await looked();
    assert.equal(seen.error, 0, view);
    assert.ok(seen.colours > 60, `${view}: ${seen.colours} colours`);
    assert.ok(seen.brightness > 20 && seen.brightness < 160, `${view}: ${seen.brightness}`);
    assert.ok(seen.scale >= .6);
    assert.ok(seen.you, `${view}: you are named`);
    const [red, green, blue] = seen.you;
    if (view === 'follow') assert.ok(red > 1.5 * green && red > blue, `your louse is ${seen.you} at ${seen.place}`);
  }
});

test('as a graphics card draws it, with several samples a pixel, it is the same picture', async () => {
  await press('orbit');
  const usual = await looked();
  await page.evaluate(() => { window.woodlouse.picture.drawing.isSoftware = false; });
  const seen = await looked();
  await page.evaluate(() => { window.woodlouse.picture.drawing.isSoftware = true; });
  assert.equal(seen.error, 0);
  assert.ok(seen.colours > 60, `${seen.colours} colours`);
  assert.ok(Math.abs(seen.brightness - usual.brightness) < 10, `${seen.brightness}, ${usual.brightness}`);
});

test('shadows come from their worker', async () => {
  await until(page, () => window.woodlouse.picture.drawing.light !== null, 30000);
});

test('a light theme has a bright sky, a dark one a dark one', async () => {
  const sky = async (name) => {
    await page.evaluate((theme) => window.woodlouse.picture.setTheme(theme), name);
    return (await looked()).corner;
  };
  assert.ok((await sky('light')).every((c) => c > 180));
  assert.ok((await sky('dark')).every((c) => c < 80));
});

test('what was lost with the context is there again, more than once, and a ground that came meanwhile', async () => {
  const before = await looked();
  for (let k = 0; k < 3; k++) {
    await page.evaluate(() => { const { gl } = window.woodlouse.picture.drawing; window.ending = gl.getExtension('WEBGL_lose_context'); window.ending.loseContext(); });
    await until(page, () => window.woodlouse.picture.drawing.isLost);
    if (k === 2) await page.evaluate(() => { const { picture } = window.woodlouse; picture.setGround(picture.relief.ground); });
    await page.waitForTimeout(100);
    await page.evaluate(() => window.ending.restoreContext());
    await until(page, () => !window.woodlouse.picture.drawing.isLost);
    const again = await looked();
    assert.equal(again.error, 0);
    assert.ok(Math.abs(again.brightness - before.brightness) < 12 && again.colours > 60, `${again.brightness} after ${before.brightness}, ${again.colours} colours`);
  }
});

test('nothing went wrong meanwhile', () => assert.deepEqual(faults, []));
