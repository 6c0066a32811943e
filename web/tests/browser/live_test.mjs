// The page in a browser: watched, played, left alone, attacked.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { browsed, faults, known, Served, shown, SlowLine, until } from './served.mjs';

let served, context, page, hidden, hiddenSince;

before(async () => {
  served = await Served.start('--map', 'hills', 'crater_loop', '--mode', 'all', '--bots', '4', '--bots-alone', 'play', '--seed', '5');
  context = await browsed();
  page = context.pages()[0];
  hidden = await context.newPage();  // nobody looks at it for the minute that the other tests take
  await shown(hidden, `${served.web}?room=hills`);
  await hide(hidden, true);
  hiddenSince = Date.now();
  await page.bringToFront();
});
after(async () => {
  await context?.close();
  await served?.stop();
});

/** As when another tab is looked at (a browser without a screen hides none): nothing is drawn, and the page is told. */
const hide = (which, isHidden) => which.evaluate((value) => {
  window.animate ??= window.requestAnimationFrame;
  window.requestAnimationFrame = value ? (then) => { window.waiting = then; return 0; } : window.animate;
  if (!value && window.waiting) window.animate(window.waiting);
  Object.defineProperty(document, 'hidden', { configurable: true, get: () => value });
  document.dispatchEvent(new Event('visibilitychange'));
}, isHidden);

const counts = (which) => known(which, () => {
  const { exact, corrected } = window.woodlouse.room.own.pilot.prediction;
  return { exact, corrected };
});

/** Presses keys as a hand does, until so many inputs were answered, and for `seconds` at least. */
async function drive(which, seconds, answers) {
  const keys = ['w', 'a', 'ArrowUp', 'd', ' ', 's', 'ArrowLeft', 'w'], begun = Date.now();
  for (let k = 0; ; k++) {
    const key = keys[k % keys.length];
    await which.keyboard.down(key);
    await which.waitForTimeout(150 + (k * 137) % 500);
    await which.keyboard.up(key);
    await until(which, () => window.woodlouse.room.own.pilot?.louse);  // a page that is starved asks for fewer frames, on a new line
    const { exact, corrected } = await counts(which), passed = (Date.now() - begun) / 1000;
    if (passed > seconds && exact + corrected >= answers) return { exact, corrected };
    assert.ok(passed < 60, `${exact + corrected} answers in a minute`);
  }
}

test('a room moves, and each of its ticks is proven', async () => {
  await shown(page, `${served.web}?room=hills`);
  // The panels come behind the first picture.
  await until(page, () => window.woodlouse.room.stream?.proven > 60 && document.querySelectorAll('#scores-table tbody tr').length > 0);
  assert.match(await page.textContent('#proof'), /^state ok \d+$/);
  assert.equal(await page.locator('#scores-table tbody tr').count(), 4);
  await known(page, () => { window.first = window.woodlouse.room.lice.map(({ x, y }) => [x, y]).join(); });
  await until(page, () => window.woodlouse.room.lice.map(({ x, y }) => [x, y]).join() !== window.first);
});

test('twenty navigations in a row over one profile all arrive', async () => {
  for (let k = 0; k < 20; k++) {
    const answer = await page.goto(`${served.web}?room=hills&k=${k}`, { waitUntil: 'commit' });
    assert.equal(answer.status(), 200, `navigation ${k}`);
    if (k % 5 === 0) await page.waitForTimeout(2500);  // a spare connection that says nothing lies about by now
  }
  await until(page, () => window.woodlouse?.room?.lice.length > 0);
});

test('ten seconds of play need no correction', async () => {
  await shown(page, `${served.web}?room=hills&play`);
  await until(page, () => window.woodlouse.room.own?.pilot?.louse);
  await page.click('#picture', { position: { x: 500, y: 300 } });
  const { exact, corrected } = await drive(page, 10, 15);
  assert.equal(corrected, 0);
  await until(page, () => /predicted (\d+)\/\1$/.test(document.querySelector('#proof').textContent));
  assert.ok(exact >= 15);
});

test('at 150 ms with 40 ms of jitter every ack is what the page already had', async () => {
  const line = await SlowLine.to(Number(served.port), 75, 40);
  try {
    await shown(page, `${line.web}?room=hills&play`, 'ann', 60000);
    await until(page, () => window.woodlouse.room.own?.pilot?.louse);
    const { corrected } = await drive(page, 12, 20);
    assert.equal(corrected, 0);
    assert.ok(await known(page, () => window.woodlouse.room.trip) > 0.15);
  } finally {
    line.stop();
  }
});

test('after a pause, too, every ack is what the page already had', async () => {
  const watched = await Served.start('--map', 'hills', '--admin', 'admin.sock');
  try {
    await shown(page, `${watched.web}?play`);
    await until(page, () => window.woodlouse.room.own?.pilot?.louse);
    for (let k = 0; k < 3; k++) {
      await page.keyboard.down('w');
      await drive(page, 1, 3);
      await watched.admin('pause', 'hills');
      await until(page, () => window.woodlouse.room.stands && document.querySelector('#lost').textContent.includes('paused'));
      await watched.admin('resume', 'hills');
      await until(page, () => !window.woodlouse.room.stands);
      await drive(page, 2, 5);
      await page.keyboard.up('w');
    }
    assert.equal((await counts(page)).corrected, 0);
    assert.equal(await known(page, () => window.woodlouse.room.welcome.state_hz), 20);  // what stood was no slow page
  } finally {
    await watched.stop();
  }
});

test('a player who looks away for a while keeps the louse', async () => {
  await shown(page, `${served.web}?room=hills&play`);
  const you = await known(page, () => window.woodlouse.room.you);
  await known(page, () => window.woodlouse.room.hide(true));
  await until(page, () => window.woodlouse.room.welcome?.state_hz === 1);
  await known(page, () => window.woodlouse.room.hide(false));
  await until(page, () => window.woodlouse.room.welcome?.state_hz === 20);
  assert.equal(await known(page, () => window.woodlouse.room.you), you);
});

test('thirty sessions one after the other leave nothing in the core\'s memory', async () => {
  await shown(page, `${served.web}?room=hills`);
  const session = await context.newCDPSession(page);
  const memory = () => known(page, () => window.woodlouse.core.instance.functions.memory.buffer.byteLength / 1e6);
  const begin = async (count) => {
    for (let k = 0; k < count; k++) {
      await known(page, () => { window.before = window.woodlouse.room.ground; window.woodlouse.room.hide(!window.woodlouse.room.door.isHidden); });
      await until(page, () => window.woodlouse.room.ground !== window.before && window.woodlouse.room.welcome);
      if (k % 5 === 4) await session.send('HeapProfiler.collectGarbage');
    }
  };
  await begin(5);
  const first = await memory();
  await begin(30);
  assert.ok(await memory() < first + 2, `${first} MB, then ${await memory()} MB`);
});

test('a page of which a part does not come says so', async () => {
  for (const [part, words] of [[/\/chunk-[^/]*\.js$/, /did not load whole/], [/\/page\.js$/, /did not load whole/], [/\/core\.wasm$/, /physics/]]) {
    const other = await context.newPage();
    await other.route(part, (route) => route.abort());
    await other.goto(`${served.web}?room=hills`);
    await other.waitForSelector('#lost p', { state: 'visible' });
    assert.match(await other.textContent('#lost'), words);
    await other.close();
  }
});

test('a key that is pressed before the page is whole is not lost', async () => {
  const other = await context.newPage();
  let pass = () => {};
  const pressed = new Promise((resolve) => { pass = resolve; });
  await other.route(/\/whole-[^/]*\.js$/, async (route) => { await pressed; await route.continue(); });
  await other.goto(`${served.web}?room=hills`);
  await until(other, () => window.woodlouse?.picture?.peopled > 0);
  await other.keyboard.press('x');
  assert.deepEqual(await known(other, () => [window.woodlouse.hands, window.woodlouse.picture.shading]), [null, 'height']);
  pass();
  await until(other, () => window.woodlouse.picture.shading === 'slope');
  await other.close();
});

test('a page that is loaded anew is put back into its louse, and a watcher into none', async () => {
  await shown(page, `${served.web}?room=hills`);
  await known(page, () => { window.woodlouse.join(); });
  await until(page, () => window.woodlouse.room.own?.pilot?.louse);
  const you = await known(page, () => window.woodlouse.room.you);
  await page.reload();
  await until(page, () => window.woodlouse?.room?.you > 0);
  assert.equal(await known(page, () => window.woodlouse.room.you), you);
  await known(page, () => window.woodlouse.join());
  await until(page, () => window.woodlouse.room.door.wish.role === 'spectator' && window.woodlouse.room.lice.length > 0);
  await page.reload();
  await until(page, () => window.woodlouse?.room?.lice.length > 0);
  assert.equal(await known(page, () => window.woodlouse.room.you), 0);
});

test('a server that restarts is waited for', async () => {
  await shown(page, `${served.web}?room=hills`);
  const back = served.restart(2500);
  await until(page, () => /Trying again/.test(document.querySelector('#lost:not([hidden]) p')?.textContent ?? ''));
  await back;
  await until(page, () => window.woodlouse.room.welcome && window.woodlouse.room.lice.length === 4);
  await page.waitForSelector('#lost', { state: 'hidden' });
  await page.reload();
  await until(page, () => window.woodlouse?.room?.lice.length > 0);
});

test('a context that is lost is drawn again once it is restored', async () => {
  await shown(page, `${served.web}?room=hills`);
  await page.waitForTimeout(500);
  const pixels = () => page.screenshot({ clip: { x: 300, y: 250, width: 400, height: 300 } }).then((image) => image.length);
  const whole = await pixels();
  await known(page, () => {
    window.lost = document.querySelector('#picture').getContext('webgl2').getExtension('WEBGL_lose_context');
    window.lost.loseContext();
  });
  await page.waitForTimeout(500);
  await known(page, () => window.lost.restoreContext());
  await page.waitForTimeout(1500);
  assert.ok(await pixels() > whole / 2, 'the ground is there again');
});

test('a core that came to its end is replaced, and the room goes on', async () => {
  await shown(page, `${served.web}?room=hills&play`);
  await known(page, () => { try { window.woodlouse.core.instance.call('world_step', 99, 1); } catch { /* no such world: a fault of the caller's, which ends it */ } });
  await until(page, () => !window.woodlouse.core.instance.isEnded && window.woodlouse.room.lice.length > 0 && window.woodlouse.room.own?.pilot?.louse);
  assert.ok(faults.length > 0 && faults.every((fault) => fault.includes('the core has ended')), faults.join('; '));
  faults.length = 0;
});

test('a race is told in words, with a ghost to race where there is a record', async () => {
  await shown(page, `${served.web}?room=crater_loop/race&play`);
  await until(page, () => /lap 1\/3/.test(document.querySelector('#goal').textContent));
  assert.match(await page.textContent('#goal'), /gate S/);
  await page.keyboard.press('t');
  await page.keyboard.type('<b>hello</b>');
  await page.keyboard.press('Enter');
  await until(page, () => document.querySelector('#said').textContent.includes('<b>hello</b>'));
  await page.keyboard.press('r');
  await until(page, () => document.querySelector('#said').textContent.includes('starts again'));
});

/** A page of its own, to which each message of the server's comes as `change` makes it. */
async function misled(change) {
  const other = await context.newPage();
  await other.addInitScript(() => {
    window.changed = 0;
    const Plain = window.WebSocket;
    window.WebSocket = class extends Plain {
      set onmessage(take) { super.onmessage = (event) => take({ data: window.change(event.data) }); }
    };
  });
  await other.addInitScript(change);
  return other;
}

test('a stream that differs from what is re-run is told in red with its tick, and watched by frames from then on', async () => {
  const other = await misled(() => {
    window.change = (data) => (/^\{"step"/m.test(data) && ++window.changed === 40 ? data.replace(/"hash":"(.)/, (_, digit) => `"hash":"${digit === '0' ? '1' : '0'}`) : data);
  });
  await shown(other, `${served.web}?room=hills`);
  await until(other, () => /^differs at tick \d+: hash/.test(document.querySelector('#proof').textContent) && !window.woodlouse.room.welcome?.stream && window.woodlouse.room.lice.length >= 4);
  assert.match(await other.getAttribute('#proof', 'class'), /bad/);
  await other.close();
});

test('a server of another behavior is shown, but nothing is predicted or proven, and the page says so', async () => {
  const other = await misled(() => { window.change = (data) => data.replace(/"behavior":\d+/, '"behavior":99'); });
  await shown(other, `${served.web}?room=hills&play`);
  await until(other, () => window.woodlouse.room.own.pilot && /no proof: the server computes by behavior 99/.test(document.querySelector('#proof').textContent));
  assert.equal(await known(other, () => window.woodlouse.room.own.pilot.prediction), null);
  await other.keyboard.down('w');
  await until(other, () => Math.hypot(window.woodlouse.room.louse(window.woodlouse.room.you)?.vx, window.woodlouse.room.louse(window.woodlouse.room.you)?.vy) > 0.1);
  await other.keyboard.up('w');
  await other.close();
});

test('a room that plays one game after the other begins the next one on the same line', async () => {
  const turns = await Served.start('--map', 'crater_loop', 'picnic', '--rotate', '1', '--bots', '2');
  try {
    await shown(page, `${turns.web}?play`);
    await until(page, () => window.woodlouse.room.own?.pilot?.louse);
    const seen = new Set();
    for (let k = 0; k < 3; k++) {
      const { mode, hash } = await known(page, () => ({ mode: window.woodlouse.room.mode, hash: window.woodlouse.room.ground.hash }));
      seen.add(mode + hash);
      await known(page, () => { window.before = window.woodlouse.room.welcome; });
      await page.click('[data-do=skip]');
      await until(page, () => window.woodlouse.room.welcome !== window.before && window.woodlouse.room.own?.pilot?.louse && window.woodlouse.room.phase === 'joined');
      await drive(page, 1, 1);
    }
    assert.ok(seen.size === 3, [...seen].join());
  } finally {
    await turns.stop();
  }
});

test('fingers push and brake on a phone', async () => {
  const phone = await browsed({ viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true, deviceScaleFactor: 2 });
  try {
    const touched = phone.pages()[0];
    await shown(touched, `${served.web}?room=hills&play`);
    await until(touched, () => window.woodlouse.room.own?.pilot?.louse);
    const stick = await touched.locator('#stick').boundingBox();
    const finger = await phone.newCDPSession(touched);
    const at = { x: stick.x + stick.width / 2, y: stick.y + 10 };
    await finger.send('Input.dispatchTouchEvent', { type: 'touchStart', touchPoints: [at] });
    await until(touched, () => window.woodlouse.room.own.steering.isPushing(performance.now() / 1000));
    await finger.send('Input.dispatchTouchEvent', { type: 'touchEnd', touchPoints: [] });
    await until(touched, () => !window.woodlouse.room.own.steering.isPushing(performance.now() / 1000));
    const brake = await touched.locator('#brake').boundingBox();
    await finger.send('Input.dispatchTouchEvent', { type: 'touchStart', touchPoints: [{ x: brake.x + 20, y: brake.y + 20 }] });
    await until(touched, () => window.woodlouse.room.own.steering.isBraking(performance.now() / 1000));
    await finger.send('Input.dispatchTouchEvent', { type: 'touchEnd', touchPoints: [] });
    assert.ok((await counts(touched)).exact > 0);
  } finally {
    await phone.close();
  }
});

test('a tab that was hidden for a minute goes on as if it had not been', async () => {
  await hidden.waitForTimeout(Math.max(0, hiddenSince + 60000 - Date.now()));
  assert.equal(await known(hidden, () => window.woodlouse.room.welcome.state_hz), 1);
  await hide(hidden, false);
  await hidden.bringToFront();
  await until(hidden, () => window.woodlouse.room.welcome?.state_hz === 20 && window.woodlouse.room.lice.length >= 4);
  await until(hidden, () => /^state ok \d+$/.test(document.querySelector('#proof').textContent));
});

test('nothing went wrong, and the policy refused nothing', () => assert.deepEqual(faults, []));
