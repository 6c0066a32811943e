// What is to be seen is in the picture: the whole map from outside, a louse that is followed at every frame.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { Camera } from '../page/picture/camera.js';
import { Relief } from '../page/picture/relief.js';
import { groundOf, hill, pot } from './picture_ground.mjs';
import { sequence } from './sequence.mjs';

const SIZES = [[1280, 800], [390, 844], [844, 390], [320, 480], [2560, 600]];
function cameraOn(f, { calm = false, domain = [-20, -20, 20, 20] } = {}) {
  const relief = new Relief(groundOf(domain, 41, 31, f)), camera = new Camera(calm);
  camera.setStage(relief.stage(relief.lowest - 3));
  return { relief, camera };
}

test('the whole map is in the free part of the picture, from every side, and fills it one way', () => {
  for (const f of [pot, hill, () => 0])
    for (const domain of [[-20, -20, 20, 20], [-43, -30, 43, 30], [-72, -21, 72, 21]])
      for (const [width, height] of SIZES)
        for (const yaw of [-2.2, 0, 1, 3])
          for (const view of ['orbit', 'map']) {
            const { camera } = cameraOn(f, { calm: true, domain }), insets = { left: 10, top: 50, right: width > 600 ? 240 : 10, bottom: 70 };
            Object.assign(camera, { yaw, view, insets });
            camera.update(width, height, 0, null);
            let x0 = Infinity, x1 = -Infinity, y0 = Infinity, y1 = -Infinity;
            for (const c of camera.stage.corners) {
              const p = camera.project(...c);
              assert.ok(p, 'nothing is behind the eye');
              x0 = Math.min(x0, p.x), x1 = Math.max(x1, p.x), y0 = Math.min(y0, p.y), y1 = Math.max(y1, p.y);
            }
            const w = width - insets.left - insets.right, h = height - insets.top - insets.bottom;
            assert.ok(x0 >= insets.left - 1 && x1 <= insets.left + w + 1 && y0 >= insets.top - 1 && y1 <= insets.top + h + 1,
              `${[width, height, view, yaw, domain]}: ${[x0, x1, y0, y1]}`);
            assert.ok(Math.max((x1 - x0) / w, (y1 - y0) / h) > .9);
            // its middle is the middle's
            assert.ok(Math.abs((x0 + x1) / 2 - insets.left - w / 2) < 2 && Math.abs((y0 + y1) / 2 - insets.top - h / 2) < 2);
          }
});

test('a louse that is followed is in the picture at every frame, however it goes', () => {
  const next = sequence(11);
  for (const [width, height] of SIZES)
    for (const calm of [false, true]) {
      const { relief, camera } = cameraOn(pot, { calm });
      Object.assign(camera, { view: 'follow', insets: { left: 0, top: 60, right: 0, bottom: 80 } });
      let x = 0, y = 0, vx = 30, vy = 20, now = 0;
      for (let k = 0; k < 600; k++) {
        const dt = k % 50 === 7 ? 900 : 16 + 60 * next();  // a stalled page, too
        now += dt;
        x += vx * dt / 1000, y += vy * dt / 1000;
        if (Math.abs(x) > 20) x = 20 * Math.sign(x), vx = -vx;
        if (Math.abs(y) > 20) y = 20 * Math.sign(y), vy = -vy;
        if (k % 97 === 0) x = 40 * next() - 20, y = 40 * next() - 20;  // begins again elsewhere
        if (k % 10 === 0) camera.turn(60 * next() - 30, 60 * next() - 30), camera.zoom(.8 + .4 * next());
        const z = relief.heightAt(x, y) + (k % 3 === 0 ? 5 : 0);
        camera.update(width, height, now, { x, y, z }, k % 200 < 100 ? { x: 18 * Math.sin(k / 40), y: -15 } : null);
        const p = camera.project(x, y, z);
        assert.ok(p && p.x >= 0 && p.x <= width && p.y >= 60 && p.y <= height - 80, `frame ${k} of ${width}x${height}: ${p?.x} ${p?.y}`);
      }
    }
});

test('no hill stands between the eye and who is followed', () => {
  const { relief, camera } = cameraOn(hill, { calm: true });
  camera.view = 'follow';
  for (const yaw of [0, .7, 2, 4, 5.5])
    for (const r of [6, 9, 14]) {
      camera.yaw = yaw;
      // behind the hill as the eye sees it
      const x = -Math.cos(yaw) * r, y = -Math.sin(yaw) * r, z = relief.heightAt(x, y) * relief.exaggeration;
      camera.update(1280, 800, 0, { x, y, z });
      for (let s = .02; s < 1; s += .02) {
        const at = [0, 1, 2].map(c => [x, y, z + .5][c] + (camera.eye[c] - [x, y, z + .5][c]) * s);
        if (Math.abs(at[0]) < 20 && Math.abs(at[1]) < 20) assert.ok(at[2] > relief.heightAt(at[0], at[1]) * relief.exaggeration, `yaw ${yaw} r ${r} s ${s}`);
      }
    }
});

test('azimuth is the direction of "up in the picture", in each view', () => {
  const { camera } = cameraOn(pot, { calm: true });
  for (const view of ['orbit', 'follow', 'map'])
    for (const yaw of [-2.2, .3, 2.9]) {
      Object.assign(camera, { view, yaw });
      camera.update(1000, 700, 0, view === 'follow' ? { x: 1, y: 2, z: .1 } : null);
      const a = camera.azimuth, p = camera.project(1, 2, .1), q = camera.project(1 + Math.cos(a), 2 + Math.sin(a), .1);
      assert.ok(q.y < p.y && Math.abs(q.x - p.x) < .25 * (p.y - q.y), `${view} ${yaw}`);
    }
});

test('the map view has no perspective; calm jumps, else it glides and comes to stand', () => {
  const { camera } = cameraOn(hill, { calm: true });
  camera.view = 'map';
  camera.update(1000, 700, 0, null);
  const a = camera.project(0, 0, 0), b = camera.project(0, 0, 9);
  assert.ok(Math.abs(a.x - b.x) < 1e-6 && Math.abs(a.y - b.y) < 1e-6 && a.w === b.w);
  const glides = cameraOn(hill).camera;
  glides.update(1000, 700, 0, null);
  glides.yaw = 1;
  glides.update(1000, 700, 16, null);
  const moving = glides.matrix.join();
  assert.ok(Math.abs(glides.now.yaw - 1) > .1);
  for (let now = 32; now < 3000; now += 16) glides.update(1000, 700, now, null);
  assert.ok(glides.now.yaw === 1 && glides.matrix.join() !== moving);
  const stands = glides.matrix.join();
  glides.update(1000, 700, 4000, null);
  assert.equal(glides.matrix.join(), stands);
});

test('zoom and tilt have bounds', () => {
  const { camera } = cameraOn(pot, { calm: true });
  for (let k = 0; k < 200; k++) camera.zoom(1.5), camera.turn(1, 100);
  assert.ok(camera.zooms.orbit <= 12 && camera.pitch.orbit <= 1.5);
  for (let k = 0; k < 200; k++) camera.zoom(.5), camera.turn(1, -100);
  assert.ok(camera.zooms.orbit >= .5 && camera.pitch.orbit > 0);
  camera.zoom(NaN), camera.zoom(-1), camera.zoom(0);
  assert.ok(camera.zooms.orbit > 0);
});

test('behind a louse it looks ahead to the goal, which is nearer to the middle then', () => {
  const off = goal => {
    const { camera } = cameraOn(() => 0, { calm: true });
    camera.view = 'follow';
    camera.update(1280, 800, 0, { x: -8, y: 0, z: 0 }, goal);
    return camera.offMiddle(camera.project(4, 6, 0)).reduce((a, b) => Math.max(a, b));
  };
  assert.ok(off({ x: 4, y: 6 }) < .8 * off(null));
});
