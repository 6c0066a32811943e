// A louse lies on the ground as the document turns it: yaw about z, then pitch about the turned y, then roll about x.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { bodyAxes } from '../page/picture/louse.js';
import { louseMesh } from '../page/picture/louse_mesh.js';
import { sequence } from './sequence.mjs';

/**
 * The document's Euler angles on ground with the gradient (zx, zy): uphill is negative pitch.
 * @param {number} hx @param {number} hy @param {number} zx @param {number} zy
 */
function attitudeOf(hx, hy, zx, zy) {
  const pitch = Math.atan(-zx * hx - zy * hy);
  return { yaw: Math.atan2(hy, hx), pitch, roll: Math.atan((zy * hx - zx * hy) * Math.cos(pitch)) };
}

/** The columns of Rz(yaw) Ry(pitch) Rx(roll) that are forward and up. */
function turned({ yaw, pitch, roll }) {
  const [cy, sy, cp, sp, cr, sr] = [Math.cos(yaw), Math.sin(yaw), Math.cos(pitch), Math.sin(pitch), Math.cos(roll), Math.sin(roll)];
  return [cy * cp, sy * cp, -sp, 0, cy * sp * cr + sy * sr, sy * sp * cr - cy * sr, cp * cr, 0];
}

test('axes are those of yaw, pitch and roll, and tangent and normal of the ground, on 1e5 slopes', () => {
  const next = sequence(7);
  let worst = 0;
  for (let k = 0; k < 1e5; k++) {
    const a = next() * 2 * Math.PI, hx = Math.cos(a), hy = Math.sin(a), zx = 6 * next() - 3, zy = 6 * next() - 3, out = new Array(8).fill(0);
    bodyAxes(hx, hy, zx, zy, out, 0);
    turned(attitudeOf(hx, hy, zx, zy)).forEach((v, i) => worst = Math.max(worst, Math.abs(v - out[i])));
    const n = Math.hypot(zx, zy, 1);
    worst = Math.max(worst, Math.abs(out[4] + zx / n), Math.abs(out[5] + zy / n), Math.abs(out[6] - 1 / n));
    worst = Math.max(worst, Math.abs(out[0] * out[4] + out[1] * out[5] + out[2] * out[6]));
  }
  assert.ok(worst < 2e-15, `${worst}`);
});

test('meshes are whole: unit normals, corners that exist, a half length of one, two sides alike', () => {
  for (const detail of [0, 1, 2]) {
    const { places, normals, triangles } = louseMesh(detail), count = normals.length / 3;
    assert.equal(places.length, 4 * count);
    assert.equal(triangles.length % 3, 0);
    assert.ok(count < 65536 && Math.max(...triangles) === count - 1);
    let longest = 0, left = 0, right = 0;
    for (let k = 0; k < count; k++) {
      assert.ok(Math.abs(Math.hypot(normals[3 * k], normals[3 * k + 1], normals[3 * k + 2]) - 1) < 1e-5);
      if (places[4 * k + 3] === 0) longest = Math.max(longest, Math.abs(places[4 * k]));
      left = Math.max(left, places[4 * k + 1]);
      right = Math.max(right, -places[4 * k + 1]);
    }
    assert.ok(longest <= 1 + 1e-6 && longest > .8, `${longest}`);
    assert.ok(Math.abs(left - right) < .02, `${left} ${right}`);
  }
  assert.ok(louseMesh(0).triangles.length / 3 <= 64, 'what is drawn by the hundred is plain');
});
