// @ts-check
// Your own louse: what you ask of it (steering), where it is before the server says so (prediction), and how far ahead
// of the server it lives. Pure: time is an argument, in seconds.
import { Prediction } from './prediction.js';
import { DriveLog } from './ghosts.js';

const SAFETY = 0.025, FIRST_SAFETY = 0.08, MOST = 1;      // s; and half of what needs have differed by
const ACKS = 40, RISE = 0.25, SINK = 0.02;                // s a second
/** What is too much by more than SPARE [s] goes faster, so much of it a second. */
const SPARE = 0.05, SINK_SPARE = 0.4;

/** How far ahead of arriving frames inputs are stamped: they must reach the server before the step they ask for. Each
 * ack's margin says how much was needed then; the largest need of the last ACKS, and more the more they differ, is the lead. Before
 * there are any, a usual round trip and what may come on top of it: the longest may have waited for this page. */
export class Lead {
  /** @type {number[]} */ #needs = [];
  /** @type {number|null} */ #now = null; #at = 0;
  /** @type {number[]} */ #trips = [];

  /** @param {number} hz ticks a second */
  constructor(hz) { this.hz = hz; }

  /** A round trip of so many seconds. */
  trip(seconds) {
    this.#trips.push(seconds);
    if (this.#trips.length > 8) this.#trips.shift();
  }
  /** The server's ticks are counted anew: what was needed before the pause says nothing. */
  beginAnew() {
    this.#needs = [];
    this.#now = null;
  }
  /** Whether enough is known to begin. */
  get isKnown() { return this.#trips.length >= 4; }

  /** An input that was sent `lead` ticks ahead and asked for step `asked` was taken. */
  observe(ack, asked, lead) {
    const margin = ack.margin_us * 1e-6 * this.hz + (asked - ack.tick);
    this.#needs.push(lead - margin);
    if (this.#needs.length > ACKS) this.#needs.shift();
  }

  /** Ticks. */
  ticks(now) {
    const needs = this.#needs, largest = Math.max(...needs);
    const seconds = needs.length ? (largest + 0.5 * (largest - Math.min(...needs))) / this.hz + SAFETY
                                 : ([...this.#trips].sort((a, b) => a - b)[this.#trips.length >> 1] ?? 0) + FIRST_SAFETY;
    const wanted = Math.min(MOST, seconds) * this.hz + 1;
    const passed = Math.max(0, now - this.#at);
    this.#at = now;
    const before = this.#now ?? wanted, sink = SINK + SINK_SPARE * Math.max(0, (before - wanted) / this.hz - SPARE);
    const most = (wanted > before ? RISE : sink) * passed * this.hz;
    return this.#now = before + Math.min(most, Math.max(-most, wanted - before));
  }
}

const ASK_AGAIN = 0.2, STRAY = 0.05, FADE = 0.08, LONGEST_FADE = 2;  // s, m, s, m

/** The order that the louse's own state describes: repeating it asks for an ack and changes nothing. */
function orderInForce(louse) {
  if (!louse || louse.ticks_left === 0) return { kind: 2, x: 0, y: 0, ticks: 1 };
  return { kind: louse.thrust_kind, x: louse.tx, y: louse.ty, ticks: louse.ticks_left };
}

export class Pilot {
  #seq; #lastTick = 0; #ahead = 0; #leads = new Map(); #wantsState = true; #askedAt = -Infinity; #correction = [0, 0]; #updated = 0;
  #pointed = false;
  /** @type {number[]|null} */ #lookAt = null;

  /**
   * @param {{hz: number, id: number, steering: import('./steering.js').Steering, ways: import('../ways.js').Ways,
   *   world?: any, lastSeq?: number}} options world: none on a big map, whose ground is not known here in full: there
   *   nothing is predicted. lastSeq: of the connection's inputs so far.
   */
  constructor({ hz, id, steering, ways, world, lastSeq = 0 }) {
    this.hz = hz;
    this.id = id;
    this.steering = steering;
    this.ways = ways;
    this.prediction = world ? new Prediction(world, ways) : null;
    this.lead = new Lead(hz);
    this.log = new DriveLog(hz);
    this.#seq = lastSeq;
  }

  get lastSeq() { return this.#seq; }
  /** What a louse at a spawn looks at first. */
  lookAt(x, y) { this.#lookAt = [x, y]; }

  /** Runs the prediction on to now. @returns {any} the input to send, at most one a tick, or null */
  update(now, clock) {
    if (!clock.isRunning || !this.lead.isKnown) return null;
    const lead = this.lead.ticks(now), tick = clock.tick(now);
    this.#ahead = Math.max(this.#ahead, tick + lead);
    let next = Math.max(0, Math.floor(this.#ahead));
    let louse = null;
    if (this.prediction) {
      this.prediction.advance(next);
      next = Math.max(next, this.prediction.tick);
      louse = this.prediction.louse;
      this.#wantsState ||= !louse;
    }
    this.#fade(now);
    if (next <= this.#lastTick) return null;  // this tick has its input
    const order = this.steering.poll(now);
    if (order) return this.#order(next, order, next - tick);
    if (!this.#wantsState || now - this.#askedAt < ASK_AGAIN) return null;
    this.#askedAt = now;
    return this.#order(next, orderInForce(louse), next - tick);
  }

  acknowledge(ack) {
    const sent = this.#leads.get(ack.seq);
    if (sent) this.lead.observe(ack, sent.tick, sent.lead);
    for (const seq of this.#leads.keys()) if (seq <= ack.seq) this.#leads.delete(seq);
    this.log.acknowledged(ack);
    this.prediction?.acknowledge(ack);
    if (!ack.you) return;
    this.#wantsState = false;
    this.#askedAt = -Infinity;
    if (!this.#pointed) this.#point(ack.you);
    if (!this.prediction) return;
    const [x, y] = this.prediction.takeCorrection();
    this.#correction = [this.#correction[0] + x, this.#correction[1] + y];
    if (Math.hypot(...this.#correction) > LONGEST_FADE) this.#correction = [0, 0];
  }

  /** The server's row of this louse: where it strays from what was predicted, an exact state is asked for. */
  compare(tick, row) {
    const { prediction } = this, believed = prediction?.at(tick);
    if (!prediction || !believed || prediction.pending > 0) return;
    if (Math.hypot(...this.ways.way(row.x, row.y, believed.x, believed.y)) > STRAY) this.#wantsState = true;
  }

  /** What was predicted is worth nothing, the server having stood still. The inputs that wait there have their ticks: others come behind them. */
  beginAnew() {
    this.prediction?.forget();
    this.lead.beginAnew();
    this.#leads.clear();  // what waited there says nothing of the line
    this.#ahead = 0;
    this.#wantsState = true;
    this.#askedAt = -Infinity;
    this.#correction = [0, 0];
  }

  /** Back at a spawn. @returns {any} the drive that ended, or null */
  respawned() {
    const drive = this.prediction ? this.log.finish(this.prediction.tick) : null;
    this.prediction?.forget();
    this.steering.reset();
    this.#pointed = false;
    this.#wantsState = true;
    this.#askedAt = -Infinity;
    this.#correction = [0, 0];
    return drive;
  }

  /** Ticks since the present drive began, as the louse is drawn; null before. */
  get sinceSpawn() { return this.log.begun === null ? null : Math.max(0, this.#ahead - this.log.begun); }

  /** The louse as it is to be drawn now; null before the first exact state, and where nothing is predicted. */
  get louse() {
    const { prediction } = this, louse = prediction?.louse;
    if (!prediction || !louse) return null;
    const part = Math.min(1, Math.max(0, this.#ahead - prediction.tick)) / this.hz;
    const [x, y] = this.ways.place(louse.x + part * louse.vx + this.#correction[0], louse.y + part * louse.vy + this.#correction[1]);
    return { ...louse, x, y, flight_z: louse.phase === 2 ? louse.flight_z + part * louse.flight_vz : 0 };
  }

  #order(tick, order, lead) {
    const seq = ++this.#seq;
    this.prediction?.sent(seq, tick, order);
    this.log.sent(seq, order);
    this.#leads.set(seq, { tick, lead });
    this.#lastTick = tick;
    const input = { type: 'input', seq, thrust: order.kind === 1 ? order.x : [order.x, order.y], tick };
    return order.ticks < 4294967295 ? { ...input, ticks: order.ticks } : input;
  }

  #point(you) {
    this.#pointed = true;
    const [x, y] = this.#lookAt ? this.ways.way(you.x, you.y, ...this.#lookAt) : you.heading;
    const length = Math.hypot(x, y);
    if (length > 0) this.steering.point(x / length, y / length);
  }

  #fade(now) {
    const rest = Math.exp(-Math.min(1, Math.max(0, now - this.#updated)) / FADE);
    this.#updated = now;
    this.#correction = this.#correction.map((c) => rest * c);
  }
}
