// @ts-check
// The louse that is followed, in figures.
import { byId, fillChildren, made, setHidden, setText } from './elements.js';

const degrees = (radians) => `${Math.round(radians * 180 / Math.PI) || 0}\u00b0`;  // no -0

/** Where a louse heads and how it stands, as the paper turns it: yaw, pitch (uphill is negative), roll. [rad] */
function attitude({ heading_x: hx, heading_y: hy, zx, zy }) {
  const along = hx * zx + hy * zy, across = hx * zy - hy * zx;
  return [Math.atan2(hy, hx), -Math.atan(along), Math.atan2(across, Math.sqrt(1 + along * along))];
}

export class LousePanel {
  #figures = byId('louse').querySelector('dl');

  /** @param {any} louse as it is drawn, with z, zx, zy; null: nobody is followed @param {string} name */
  update(louse, name) {
    setHidden(byId('louse'), !louse);
    if (!louse) return;
    setText(byId('who'), name);
    const { vx, vy, zx, zy } = louse, flies = louse.phase === 2, flat = Math.hypot(vx, vy);
    const climbing = flies ? louse.flight_vz ?? 0 : zx * vx + zy * vy, speed = Math.hypot(vx, vy, climbing);
    const state = flies ? 'flying' : louse.phase === 1 || speed < 0.005 ? 'resting' : 'rolling';
    const figures = [
      ['speed', `${speed.toFixed(1)} m/s`], ['slope', flat > 0.05 && !flies ? degrees(Math.atan(climbing / flat)) : '\u2013'],
      ['yaw pitch roll', attitude(louse).map(degrees).join(' ')], ['height', `${(flies ? louse.flight_z : louse.z).toFixed(1)} m`], ['way', `${louse.distance.toFixed(0)} m`], ['state', state],
    ];
    fillChildren(this.#figures, figures.flat(), () => made(this.#figures.children.length % 2 ? 'dd' : 'dt'), (child, text) => setText(child, text));
  }
}
