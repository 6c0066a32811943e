import assert from 'node:assert/strict';
import test from 'node:test';
import { PULSE, Steering, wireVector } from '../page/live/own/steering.js';

const HZ = 60;
/** All that goes out while `hands` act, at 60 polls a second. */
function driven(hands, seconds, steering = new Steering(HZ)) {
  const orders = [];
  for (let k = 0; k <= seconds * 60; k++) {
    const now = k / 60;
    hands(steering, now, k);
    const order = steering.poll(now);
    if (order) orders.push({ at: now, ...order });
  }
  return orders;
}

test('what goes out is on the wire\'s grid, never longer than 1, and without a minus zero', () => {
  for (let k = 0; k < 1000; k++) {
    const [x, y] = wireVector(Math.cos(k), Math.sin(k));
    assert.ok(Number.isInteger(x * 128) && Number.isInteger(y * 128) && x * x + y * y <= 1);
    assert.ok(!Object.is(x, -0) && !Object.is(y, -0));
  }
  assert.deepEqual(wireVector(-0.001, 0), [0, 0]);
});

test('a held key pushes in pulses, renewed before they end, and its release ends the push', () => {
  const orders = driven((steering, now, k) => {
    if (k === 0) steering.hold('up', now);
    if (k === 60) steering.release('up');
  }, 2);
  const end = orders.findIndex(({ x, y }) => x === 0 && y === 0);
  assert.equal(orders.length - 1, end);
  assert.ok(orders[end].at <= 1.02);
  for (let k = 1; k < end; k++) assert.ok(orders[k].at - orders[k - 1].at < PULSE && orders[k].at - orders[k - 1].at > 0.15);
  assert.ok(orders.length <= 8, `${orders.length} messages in 2 s`);
});

test('a held key pushes without a pause on a page that comes to it twice a second', () => {
  const steering = new Steering(HZ);
  steering.hold('up', 0);
  let until = Infinity;
  for (let k = 0; k < 20; k++) {
    const now = 1 + k * 0.45, order = steering.poll(now);
    assert.ok(k < 2 || until > now, `a pause before ${now}`);
    if (order) until = now + order.ticks / HZ;
  }
});

test('a tap that is over before the next poll still pushes', () => {
  const orders = driven((steering, now, k) => {
    if (k !== 30) return;
    steering.hold('left', now - 0.012);
    steering.release('left');
  }, 1);
  assert.equal(orders[0].kind, 2);
  assert.ok(Math.abs(orders[0].x + 1) < 0.02 && orders.length === 2);
});

test('keys push as the camera looks, two of them between', () => {
  const steering = new Steering(HZ);
  steering.lookAlong(0);  // up in the picture is east
  steering.hold('up', 0);
  assert.deepEqual([steering.poll(0).x, steering.heading.map(Math.round)], [1, [1, 0]]);
  steering.hold('right', 0.02);
  const { x, y } = steering.poll(0.02);
  assert.ok(Math.abs(x - Math.SQRT1_2) < 0.01 && Math.abs(y + Math.SQRT1_2) < 0.01);
  steering.hold('down', 0.04);
  steering.release('right');
  assert.deepEqual(steering.poll(0.2), { kind: 2, x: 0, y: 0, ticks: 1 });  // up and down: nowhere
});

test('a camera that turns while a key is held asks for no more than ten turns a second', () => {
  const orders = driven((steering, now, k) => {
    steering.lookAlong(now);
    if (k === 0) steering.hold('up', now);
  }, 2);
  assert.ok(orders.length <= 21 && orders.length >= 10, `${orders.length}`);
});

test('the brake goes before all, and losing the keyboard lets everything go', () => {
  const steering = new Steering(HZ);
  steering.hold('up', 0);
  steering.hold('brake', 0);
  assert.deepEqual(steering.poll(0), { kind: 1, x: -1, y: 0, ticks: 24 });
  steering.releaseAll();
  assert.deepEqual(steering.poll(0.1), { kind: 2, x: 0, y: 0, ticks: 1 });
  assert.equal(steering.poll(0.2), null);
});

test('a stick pushes as far as it is pushed', () => {
  const steering = new Steering(HZ);
  steering.stick([0.5, 0]);
  assert.deepEqual(steering.poll(0), { kind: 2, x: 0.5, y: 0, ticks: 24 });
});
