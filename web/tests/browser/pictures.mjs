// Makes the page's pictures in docs/pictures anew, each from a real server's page: node pictures.mjs [NAME...]
// Look at them before they are committed: bots go where they like. They get 256 colours where pngquant (Debian's) is there;
// else they are three times as big.
import { spawnSync } from 'node:child_process';
import { mkdirSync, readFileSync, statSync } from 'node:fs';
import path from 'node:path';
import { browsed, Served, shown, until } from './served.mjs';

const out = path.join(path.dirname(new URL(import.meta.url).pathname), '../../../docs/pictures');
const DESK = { width: 1280, height: 800 }, PHONE = { width: 390, height: 780 };
const MOST_BYTES = 400 * 1024;
const wanted = process.argv.slice(2);

/** The page of a server, drawn as a graphics card draws it: in full resolution, with smooth edges. */
async function opened(web, query, { viewport = DESK, phone = false, light = false } = {}) {
  const context = await browsed({ viewport, colorScheme: light ? 'light' : 'dark', ...(phone ? { hasTouch: true, isMobile: true, deviceScaleFactor: 1.5 } : {}) });
  const page = context.pages()[0];
  await shown(page, `${web}?${query}`, 'mara', 120000);
  await page.evaluate(() => {
    const { picture } = window.woodlouse;
    picture.drawing.isSoftware = false;
    picture.resolution.at = 0;
    picture.resolution.frame = () => {};
  });
  return { page, context };
}

/** @param {string} name @param {() => Promise<{page: any, context: any, served?: any}>} make */
async function picture(name, make) {
  if (wanted.length && !wanted.includes(name)) return;
  const { page, context, served } = await make();
  const file = path.join(out, `page-${name}.png`);
  // Where a processor draws, what is shown lags by seconds: the last frame is waited for.
  await page.evaluate(() => {
    window.woodlouse.frame = () => {};
    window.woodlouse.picture.drawing.gl.readPixels(0, 0, 1, 1, WebGL2RenderingContext.RGBA, WebGL2RenderingContext.UNSIGNED_BYTE, new Uint8Array(4));
  });
  await page.waitForTimeout(2000);
  await page.screenshot({ path: file });
  await context.close();
  await served?.stop();
  spawnSync('pngquant', ['--force', '--speed', '1', '--output', file, '256', file]);
  const { size } = statSync(file);
  console.log(`${file} ${size} bytes${size > MOST_BYTES ? `: more than ${MOST_BYTES}` : ''}`);
}

/** A map with bots that play, and the page that looks on. */
async function watched(map, query, { bots = 6, seconds = 6, ...look } = {}, ...options) {
  const served = await Served.start('--map', map, '--bots', String(bots), '--bots-alone', 'play', '--seed', '5', ...options);
  const { page, context } = await opened(served.web, query, look);
  await page.waitForTimeout(1000 * seconds);
  return { page, context, served };
}

/** A recording, and the same one with a thrust that is 1/128 larger. */
async function recorded(map, seconds) {
  const served = await Served.start('--map', map, '--bots', '8', '--bots-alone', 'play', '--seed', '5', '--ticks', String(60 * seconds), '--record', 'game.ndjson');
  await served.ended;
  const text = readFileSync(path.join(served.folder, 'game.ndjson'), 'utf8'), lines = text.split('\n');
  await served.stop();
  const k = lines.findIndex((line) => line.startsWith('{"step":') && Math.abs(JSON.parse(line).inputs?.[0]?.[2]?.[0] ?? 1) < .5 && JSON.parse(line).step > 30 * seconds);
  if (k < 0) throw new Error('no push to alter');
  const line = JSON.parse(lines[k]);
  line.inputs[0][2][0] += 1 / 128;
  lines[k] = JSON.stringify(line);
  return { text, altered: lines.join('\n'), tick: line.step };
}

/** Lets a recording fall on the page, and plays on from a tick. */
async function played(text, name, tick, seconds) {
  const served = await Served.start('--map', 'hills', '--bots', '1', '--bots-alone', 'play');
  const { page, context } = await opened(served.web, 'room=hills');
  await page.evaluate(([content, called]) => {
    const data = new DataTransfer();
    data.items.add(new File([content], called));
    for (const type of ['dragenter', 'drop']) window.dispatchEvent(new DragEvent(type, { bubbles: true, cancelable: true, dataTransfer: data }));
  }, [text, name]);
  await until(page, () => (window.woodlouse.player?.lice.length ?? 0) > 1, 60000);
  await page.evaluate((at) => window.woodlouse.player.seek(at), tick);
  await page.waitForTimeout(1000 * seconds);
  return { page, context, served };
}

mkdirSync(out, { recursive: true });

await picture('race', async () => {
  const served = await Served.start('--map', 'maunga_climb', '--mode', 'race', '--bots', '5', '--bots-alone', 'play', '--seed', '7');
  const { page, context } = await opened(served.web, 'play');
  await page.click('[data-do=follow]').catch(() => {});
  await page.evaluate(() => { const { camera } = window.woodlouse.picture; camera.yaw = -.35; camera.zoom(.82); });
  await page.focus('#picture');
  await page.keyboard.down('ArrowUp');  // out of the crater, as far as a run-up goes
  await page.waitForTimeout(2600);
  await page.keyboard.up('ArrowUp');
  return { page, context, served };
});
await picture('pot', () => watched('wavy_pot', 'room=wavy_pot', { bots: 12 }));
await picture('maunga-whau-dark', () => watched('maunga_crumbs', 'room=maunga_crumbs/forage', { bots: 10, seconds: 10 }, '--mode', 'forage'));
await picture('maunga-whau-light', () => watched('maunga_whau', 'room=maunga_whau', { bots: 10, light: true }));
await picture('phone', async () => {
  const served = await Served.start('--map', 'crater_king', '--mode', 'hill', '--bots', '5', '--bots-alone', 'play', '--seed', '5');
  const { page, context } = await opened(served.web, 'play', { viewport: PHONE, phone: true });
  await page.waitForTimeout(6000);
  return { page, context, served };
});
await picture('deuteranopia', async () => {
  const found = await watched('hills', 'room=hills', { bots: 14, seconds: 1 });
  await found.page.evaluate(() => window.woodlouse.picture.setPalette('deutan'));
  const session = await found.context.newCDPSession(found.page);
  await session.send('Emulation.setEmulatedVisionDeficiency', { type: 'deuteranopia' });
  await found.page.waitForTimeout(6000);
  return found;
});
const game = wanted.length && !wanted.some((name) => ['recording', 'altered'].includes(name)) ? null : await recorded('volcano', 30);
if (game) {
  await picture('recording', async () => {
    const found = await played(game.text, 'game.ndjson', 900, 6);
    await found.page.click('[data-do=verify]');
    await until(found.page, () => document.querySelector('#verdict').textContent.startsWith('ok '), 60000);
    return found;
  });
  await picture('altered', () => played(game.altered, 'altered.ndjson', game.tick - 60, 8));
}
await picture('side-by-side', async () => {
  const served = await Served.start('--map', 'hoffmann_2002');
  const { page, context } = await opened(served.web, 'lab=hoffmann_2002');
  await until(page, () => {
    const { lab } = window.woodlouse, isFar = lab.seconds > 7 && lab.apart > 14;
    if (isFar) lab.isPlaying = false;
    return isFar;
  }, 90000);
  await page.waitForTimeout(1500);
  return { page, context, served };
});
