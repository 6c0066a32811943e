// @ts-check
// Two runs from the same start in one scene: the paper's simulation of 2002 as it was printed, and the exact one. Nobody
// pushes; what differs are the equations alone.

const HZ = 60, GRAVITY = 9.81, SAMPLES = 600, LONGEST = 90;  // ticks a second, m/s^2, of a curve, s
/** The lice's numbers, by which they have their colours: the paper's orange, the exact one blue. */
const PAPER = 5, EXACT = 1;
/** Places and velocities [m, m/s] to begin from; the first is that of the paper's figures (docs/document.md), 20 times as large. */
const STARTS = [[16, 0, 0, 6.708203932499369], [9, 9, -4, 3], [-6, 13, 5, 0], [3, -15, 2, 2]];

const terrain = { function: 'wavy_pot', grid: 10, scale: 20 };
const physics = (rubs) => ({ gravity: GRAVITY, drag: rubs ? 0.2 : 0, friction: rubs ? 0.05 : 0, thrust_max: 4, edge_restitution: rubs ? 0.5 : 1 });
/** The map hoffmann_2002, and the same by the exact equations. */
const definitions = (rubs) => [
  { name: 'hoffmann_2002', terrain, surface: 'document_spline', physics: { ...physics(rubs), equations: 'as_printed', method: 'false_euler' } },
  { name: 'hoffmann_exact', terrain, surface: 'spline', physics: { ...physics(rubs), method: 'precise' } },
];

export class SideBySide {
  #core; #start = 0; #tick = 0; #debt = 0;
  /** @type {number|null} */ #before = null;
  /** @type {{ground: any, world: any}[]} */ #runs = [];
  /** The runs are shown on. @type {any} */ ground = null;
  bottom = NaN;
  /** @type {any[]} */ lice = [];
  isPlaying = true;
  /** Drag and friction act. */ rubs = false;
  /** Times real time. */ speed = 1;
  /** What the curves show, against seconds. @type {{t: number[], distance: number[], paper: number[], exact: number[]}} */
  series = { t: [], distance: [], paper: [], exact: [] };

  /** @param {any} core */
  constructor(core) {
    this.#core = core;
    this.begin();
  }

  /** From the same start again, or from the next one. */
  begin(isNext = false) {
    if (isNext) this.#start = (this.#start + 1) % STARTS.length;
    const [x, y, vx, vy] = STARTS[this.#start], speed = Math.hypot(vx, vy);
    const louse = { phase: 0, x, y, vx, vy, heading_x: vx / speed, heading_y: vy / speed, tx: 0, ty: 0, flight_z: 0, flight_vz: 0, distance: 0, thrust_kind: 0, ticks_left: 0 };
    for (const { world } of this.#runs) world.close?.();
    this.#runs = definitions(this.rubs).map((definition, k) => {
      const ground = this.#core.openMap(JSON.stringify(definition), HZ), world = ground.world();
      world.put({ ...louse, id: k ? EXACT : PAPER });
      return { ground, world };
    });
    this.ground ??= this.#runs[1].ground;
    this.#tick = this.#debt = 0;
    this.series = { t: [], distance: [], paper: [], exact: [] };
    this.#look();
  }

  get seconds() { return this.#tick / HZ; }
  /** How far both are apart now [m]. */
  get apart() { return this.series.distance.at(-1) ?? 0; }
  /** What became of each energy since the start, as a part of it: 0.02 is 2 % too much. */
  change(which) {
    const energies = this.series[which];
    return energies.length ? energies[energies.length - 1] / energies[0] - 1 : 0;
  }
  nameOf(id) { return id === PAPER ? '2002' : 'exact'; }

  /** Runs on to now [s]. */
  update(now) {
    const passed = this.#before === null ? 0 : Math.min(0.1, now - this.#before);
    this.#before = now;
    if (!this.isPlaying) return;
    this.#debt += passed * HZ * this.speed;
    const steps = Math.floor(this.#debt);
    this.#debt -= steps;
    for (let k = 0; k < steps; k++) {
      for (const { world } of this.#runs) world.step(1);
      this.#tick++;
      if (this.#tick % 6 === 0) this.#look();
    }
    this.lice = this.#runs.map(({ world }) => world.lice()[0]);
    if (this.seconds >= LONGEST) this.begin(true);
  }

  #look() {
    this.lice = this.#runs.map(({ world }) => world.lice()[0]);
    const [paper, exact] = this.lice, { t, distance } = this.series;
    t.push(this.seconds);
    distance.push(Math.hypot(paper.x - exact.x, paper.y - exact.y));
    this.series.paper.push(this.#energy(paper, 0));
    this.series.exact.push(this.#energy(exact, 1));
    if (t.length > SAMPLES) for (const values of Object.values(this.series)) values.splice(1, 1);  // the first stays: all is held against it
  }

  /** Kinetic and potential, above the bottom of the pot, of a kilogram [J]. */
  #energy({ x, y, vx, vy }, run) {
    const { z, zx, zy } = this.#runs[run].ground.sample(x, y), climbing = zx * vx + zy * vy;
    if (Number.isNaN(this.bottom)) this.bottom = this.#runs[1].ground.sample(0, 0).z;
    return 0.5 * (vx * vx + vy * vy + climbing * climbing) + GRAVITY * (z - this.bottom);
  }
}
