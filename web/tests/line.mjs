// A server's room, a line to it that is late and uneven, and a page's pilot at the other end; for tests, without a socket.
import { ServerClock } from '../page/live/timeline.js';
import { Pilot } from '../page/live/own/pilot.js';
import { Steering } from '../page/live/own/steering.js';
import { Ways } from '../page/live/ways.js';

export const HZ = 60;

/** A server's room and a line to it: messages arrive in order, late by `delay` and up to `jitter` more, each way [s].
 * openWorld: an empty world, by the core's interface; begin: the louse; pause: from when to when the room stands [s], as it says. */
export function play({ openWorld, begin, delay, jitter, seconds, seed = 1, hands, frameHz = 20, ways = new Ways(), pause = [Infinity, Infinity] }) {
  let state = seed;
  const chance = () => (state = (state * 1103515245 + 12345) % 2147483648) / 2147483648;
  const world = openWorld(), steering = new Steering(HZ);
  let clock = new ServerClock(HZ), stood = 0, stands = false;
  world.put(begin);
  const pilot = new Pilot({ hz: HZ, id: begin.id, steering, ways, world: openWorld() });
  const up = [], down = [], waiting = [], acks = [];
  const send = (line, message, now) => line.push({ at: Math.max(line.at(-1)?.at ?? 0, now + delay + jitter * chance()), message });
  let tick = 1000, late = 0;
  for (let ms = 0; ms < seconds * 1000; ms++) {
    const now = ms / 1000;
    while (up[0]?.at <= now) {
      const { message } = up.shift();
      if (message.type === 'ping') send(down, { ...message, type: 'pong' }, now);
      else waiting.push({ ...message, came: now });
    }
    if (now >= pause[0] && now < pause[1]) {
      if (stood === 0) send(down, { type: 'paused' }, now);
      stood += 0.001;
    }
    while ((tick - 1000 + 1) / HZ <= now - stood) {
      const begins = (tick - 1000 + 1) / HZ + stood;
      for (const input of waiting.filter(({ tick: asked }) => asked <= tick)) {
        const [x, y] = Array.isArray(input.thrust) ? input.thrust : [input.thrust, 0];
        world.thrust(begin.id, Array.isArray(input.thrust) ? 2 : 1, x, y, input.ticks ?? 4294967295);
        acks.push({ type: 'ack', seq: input.seq, tick, margin_us: (begins - input.came) * 1e6, late: input.tick < tick, dropped: false });
      }
      waiting.splice(0, waiting.length, ...waiting.filter(({ tick: asked }) => asked > tick));
      world.step(1);
      tick++;
      const [louse] = world.lice();
      for (const ack of acks.splice(0)) {
        late += ack.late;
        send(down, { ...ack, you: { ...louse, tick, heading: [louse.heading_x, louse.heading_y], thrust: [louse.tx, louse.ty], thrust_ticks: louse.ticks_left } }, now);
      }
      if (tick % (HZ / frameHz) === 0) send(down, { type: 'frame', tick }, now);
    }
    while (down[0]?.at <= now) {
      const { message } = down.shift();
      if (message.type === 'pong') pilot.lead.trip(now - message.t);
      if (message.type === 'paused') stands = true;
      if (message.type === 'frame' && stands) {
        stands = false;
        clock = new ServerClock(HZ);
        pilot.beginAnew();
      }
      if (message.type === 'frame') clock.observe(message.tick, now);
      if (message.type === 'ack') pilot.acknowledge(message);
    }
    if (ms % 16) continue;
    if (ms < 100 || ms % 1008 === 0) send(up, { type: 'ping', t: now }, now);
    hands(steering, now);
    const input = stands ? null : pilot.update(now, clock);
    if (input) send(up, input, now);
  }
  return { pilot, late, exact: pilot.prediction.exact, corrected: pilot.prediction.corrected };
}

/** A hand that presses and lets go all the time. */
export function busy(steering, now) {
  const controls = ['up', 'left', 'down', 'right', 'brake'], k = Math.floor(now * 5);
  if (k % 2) steering.releaseAll(); else steering.hold(controls[(k / 2) % 5], now);
}
