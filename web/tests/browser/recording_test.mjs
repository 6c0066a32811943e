// Recordings, the laboratory, and what a hand on the keyboard and a reader without a screen find.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import path from 'node:path';
import { after, before, test } from 'node:test';
import { browsed, faults, known, Served, shown, until } from './served.mjs';

const TICKS = 1500;
const axe = readFileSync(createRequire(import.meta.url).resolve('axe-core/axe.min.js'), 'utf8');
let served, context, page, recorded, altered;

before(async () => {
  const recording = await Served.start('--map', 'hills', '--bots', '5', '--bots-alone', 'play', '--seed', '5', '--ticks', String(TICKS), '--record', 'game.ndjson');
  await recording.ended;
  recorded = readFileSync(path.join(recording.folder, 'game.ndjson'), 'utf8');
  altered = withAnotherThrust(recorded, 700);
  await recording.stop();
  served = await Served.start('--map', 'hills', 'maunga_whau', '--bots', '3', '--bots-alone', 'play');
  context = await browsed();
  page = context.pages()[0];
});
after(async () => {
  await context?.close();
  await served?.stop();
});

/** The same recording, one thrust of a step behind `tick` 1/128 larger. */
function withAnotherThrust(text, tick) {
  const lines = text.split('\n');
  const k = lines.findIndex((line) => {
    if (!line.startsWith('{"step":')) return false;
    const { step, inputs } = JSON.parse(line);
    return step > tick && Array.isArray(inputs?.[0]?.[2]) && Math.abs(inputs[0][2][0]) < 0.5;
  });
  assert.ok(k > 0, 'a push to alter');
  const line = JSON.parse(lines[k]);
  line.inputs[0][2][0] += 1 / 128;
  lines[k] = JSON.stringify(line);
  return lines.join('\n');
}

/** Lets a file fall on the page. */
const drop = (text, name, on = page) => on.evaluate(([content, called]) => {
  const data = new DataTransfer();
  data.items.add(new File([content], called));
  for (const type of ['dragenter', 'drop']) window.dispatchEvent(new DragEvent(type, { bubbles: true, cancelable: true, dataTransfer: data }));
}, [text, name]);

const verdict = () => page.textContent('#verdict');

/** What axe finds that is serious. */
async function findings(what) {
  await context.newCDPSession(page).then((session) => session.send('Runtime.evaluate', { expression: axe }));
  const { violations } = await page.evaluate(() => window.axe.run(document, { resultTypes: ['violations'] }));
  return violations.filter(({ impact }) => ['serious', 'critical'].includes(impact)).map(({ id, nodes }) => `${what}: ${id} ${nodes.map(({ target }) => target).join(' ')}`);
}

test('a recording that is dropped plays, each tick proven, and is verified whole', async () => {
  await shown(page, `${served.web}?room=hills`);
  await drop(recorded, 'game.ndjson');
  await until(page, () => window.woodlouse.player?.lice.length === 5 && window.woodlouse.player.tick > 60);
  assert.match(await verdict(), /^state ok \d+\/1500$/);
  await page.locator('#seek').fill('1200');
  await until(page, () => window.woodlouse.player.tick >= 1200 && window.woodlouse.player.lice.length === 5);
  await page.keyboard.press('k');
  const at = await known(page, () => window.woodlouse.player.tick);
  await page.keyboard.press(',');
  await until(page, () => /tick \d+$/.test(document.querySelector('#time').textContent));
  assert.ok(Math.abs(await known(page, () => window.woodlouse.player.tick) - at) <= 2);
  await page.click('[data-do=verify]');
  await until(page, () => document.querySelector('#verdict').textContent.startsWith('ok ticks 0 to 1500'));
});

test('a recording that is held is drawn no more, until something of it changes; trails stay', async () => {
  await page.keyboard.press('k');
  await until(page, () => [...window.woodlouse.picture.staging.trails.trails.values()].some(({ count }) => count > 3));
  await page.keyboard.press('k');
  const held = await page.evaluate(async () => {
    const { picture } = window.woodlouse;
    for (let drawn = -1; drawn !== picture.peopled;) {
      drawn = picture.peopled;
      await new Promise((resolve) => setTimeout(resolve, 5000));  // longer than trails last without a picture
    }
    return [...picture.staging.trails.trails.values()].map(({ count }) => count);
  });
  assert.ok(held.length === 5 && held.some((count) => count > 3), `trails of ${held} points`);
  await page.evaluate(() => { window.drawn = window.woodlouse.picture.peopled; window.woodlouse.picture.camera.turn(40, 0); });
  await until(page, () => window.woodlouse.picture.peopled > window.drawn);
  assert.deepEqual(await known(page, () => [...window.woodlouse.picture.staging.trails.trails.values()].map(({ count }) => count)), held);
  await page.evaluate(() => { window.drawn = window.woodlouse.picture.peopled; });
  await page.keyboard.press('k');
  await until(page, () => window.woodlouse.player.isPlaying && window.woodlouse.picture.peopled > window.drawn + 5);
});

test('a recording that falls on the page before it is whole is opened', async () => {
  const other = await context.newPage();
  let pass = () => {};
  const dropped = new Promise((resolve) => { pass = resolve; });
  await other.route(/\/whole-[^/]*\.js$/, async (route) => { await dropped; await route.continue(); });
  await other.goto(`${served.web}?room=hills`);
  await until(other, () => window.woodlouse?.picture?.peopled > 0);
  await drop(recorded, 'early.ndjson', other);
  assert.equal(await known(other, () => window.woodlouse.hands), null);
  pass();
  await until(other, () => window.woodlouse.file === 'early.ndjson' && window.woodlouse.player?.lice.length === 5);
  await other.close();
});

test('one altered thrust is found, while it plays and as a whole, and its tick is named in red', async () => {
  await drop(altered, 'altered.ndjson');
  await until(page, () => window.woodlouse.player?.info && window.woodlouse.file === 'altered.ndjson');
  await known(page, () => window.woodlouse.player.seek(690));
  await until(page, () => /^differs at tick 7\d\d$/.test(document.querySelector('#verdict').textContent));
  assert.match(await page.getAttribute('#verdict', 'class'), /bad/);
  await page.click('[data-do=verify]');
  await until(page, () => /^differs at tick 7\d\d: hash/.test(document.querySelector('#verdict').textContent));
});

test('what is no recording is told, and what plays goes on', async () => {
  await drop('{"format":"something"}\n', 'wrong.ndjson');
  await until(page, () => document.querySelector('#toasts').textContent.includes('wrong.ndjson:'));
  assert.ok(await known(page, () => window.woodlouse.player.lice.length === 5));
});

test('five hundred seeks leave no memory behind', async () => {
  await drop(recorded, 'game.ndjson');
  await until(page, () => window.woodlouse.file === 'game.ndjson' && window.woodlouse.player.lice.length === 5);
  const session = await context.newCDPSession(page);
  const used = async () => {
    await session.send('HeapProfiler.collectGarbage');
    return (await session.send('Runtime.getHeapUsage')).usedSize / 1e6;
  };
  const seek = (count) => page.evaluate(async (n) => {
    const { player } = window.woodlouse;
    player.isPlaying = false;
    for (let k = 0; k < n; k++) await player.recording.seek((k * 997) % 1500);
  }, count);
  await seek(50);
  const first = await used();
  await seek(500);
  const last = await used();
  assert.ok(last < first + 3 && last < 45, `${first.toFixed(1)} MB, then ${last.toFixed(1)} MB`);
});

test('every control is reached by Tab, has a name, and Tab is never taken', async () => {
  await shown(page, `${served.web}?room=hills&play`);
  const wanted = await page.evaluate(() => [...document.querySelectorAll('button, select, input, canvas[tabindex], [tabindex="0"]')]
    .filter((element) => element.tabIndex >= 0 && element.checkVisibility({ visibilityProperty: true })).map((element) => element.id || element.dataset.do || element.textContent.trim()));
  const reached = new Set(), nameless = [];
  await page.locator('body').focus();
  for (let k = 0; k < wanted.length * 2 + 10; k++) {
    await page.keyboard.press('Tab');
    const here = await page.evaluate(() => {
      const element = document.activeElement;
      return { what: element.id || element.dataset.do || element.textContent.trim(), name: (element.getAttribute('aria-label') || element.labels?.[0]?.textContent || element.textContent).trim() };
    });
    reached.add(here.what);
    if (!here.name) nameless.push(here.what);
  }
  assert.deepEqual(wanted.filter((what) => !reached.has(what)), []);
  assert.deepEqual(nameless, []);
});

test('a chosen room is entered, and the hands are free to push at once', async () => {
  await shown(page, `${served.web}?room=hills&play`);
  await page.selectOption('#room', 'maunga_whau');
  await until(page, () => window.woodlouse.room.welcome?.room === 'maunga_whau' && window.woodlouse.room.own?.pilot?.louse);
  await page.keyboard.down('w');
  await until(page, () => window.woodlouse.room.own.steering.isPushing(performance.now() / 1000));
  await page.keyboard.up('w');
  await page.click('#bar [data-do=follow]');
  await page.keyboard.down(' ');
  await until(page, () => window.woodlouse.room.own.steering.isBraking(performance.now() / 1000));
  await page.keyboard.up(' ');
});

test('keys do what their buttons do', async () => {
  await page.locator('#picture').focus();
  const view = () => known(page, () => window.woodlouse.picture.camera.view);
  for (const [key, name] of [['1', 'orbit'], ['2', 'follow'], ['3', 'map'], ['v', 'orbit']]) {
    await page.keyboard.press(key);
    assert.equal(await view(), name);
  }
  for (const name of ['follow', 'map', 'orbit']) {
    await page.click(`#bar [data-do=${name}]`);
    assert.equal(await view(), name);
    await until(page, `document.querySelector('#bar [data-do=${name}]').getAttribute('aria-pressed') === 'true'`);
  }
  await page.keyboard.press('x');
  await until(page, () => document.querySelector('#bar [data-do=slope]').getAttribute('aria-pressed') === 'true');
  await page.keyboard.press('n');
  assert.ok(await known(page, () => window.woodlouse.followed > 0));
  await page.keyboard.press('?');
  await page.waitForSelector('#help[open]');
  await page.keyboard.press('Escape');
  await page.keyboard.press('t');
  assert.equal(await known(page, () => document.activeElement.id), 'say');
  await page.keyboard.type('w a s d 1 2 3');  // words, no pushes
  assert.equal(await page.inputValue('#say'), 'w a s d 1 2 3');
  await page.keyboard.press('Escape');
  await page.keyboard.down('w');
  await until(page, () => window.woodlouse.room.own.steering.isPushing(performance.now() / 1000));
  await known(page, () => window.dispatchEvent(new Event('blur')));
  await until(page, () => !window.woodlouse.room.own.steering.isPushing(performance.now() / 1000));
  await page.keyboard.up('w');
});

test('axe finds nothing serious, in the dark and in the light', async () => {
  const found = [];
  for (const theme of ['dark', 'light']) {
    await shown(page, `${served.web}?room=hills&theme=${theme}`);
    found.push(...await findings(`watching, ${theme}`));
    await page.keyboard.press('?');
    await page.waitForSelector('#help[open]');
    found.push(...await findings(`help, ${theme}`));
    await page.keyboard.press('Escape');
    await drop(altered, 'altered.ndjson');
    await until(page, () => window.woodlouse.player?.lice.length > 0);
    found.push(...await findings(`recording, ${theme}`));
  }
  assert.deepEqual(found, []);
});

test('the laboratory shows the paper\'s run drift from the exact one, whose energy stays', async () => {
  await page.goto(`${served.web}?lab=hoffmann_2002`);
  await until(page, () => window.woodlouse?.lab?.seconds > 4, 60000);
  const { apart, paper, exact } = await known(page, () => ({ apart: window.woodlouse.lab.apart, paper: window.woodlouse.lab.change('paper'), exact: window.woodlouse.lab.change('exact') }));
  assert.ok(apart > 1, `${apart} m apart`);
  assert.ok(Math.abs(exact) < 1e-4 && Math.abs(paper) > 0.01, `${exact} ${paper}`);
  await page.click('[data-do=join]');  // back to where others are
  await until(page, () => window.woodlouse.room?.lice.length > 0 && window.woodlouse.lab === null);
  assert.equal(await page.locator('#lab').isVisible(), false);
});

test('nothing went wrong, and the policy refused nothing', () => assert.deepEqual(faults, []));
