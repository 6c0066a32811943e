// @ts-check
// Curves over time, of two runs side by side: told by colour, by dashes, and by the names above them.
import { roundStep } from './relief.js';

/** A curve; values that are no numbers leave a gap. @typedef {{name: string, x: ArrayLike<number>, y: ArrayLike<number>, tone?: 'usual' | 'document' | 'exact'}} Series */

/** Okabe and Ito's vermilion and sky blue, for dark and light ground; the dashes. */
const TONES = {
  usual: { dark: '#f2f4fa', light: '#14161d', dash: [] },
  document: { dark: '#ff9d5c', light: '#b34700', dash: [7, 4] },
  exact: { dark: '#6ec6ff', light: '#005f9e', dash: [] },
};
const SAMPLE = 22;  // px of a curve beside its name
const FONT = '11px system-ui, "Segoe UI", "DejaVu Sans", sans-serif';

export class Curves {
  /** @param {HTMLCanvasElement} canvas with a size in the style sheet, and its text's colour */
  constructor(canvas) {
    this.canvas = canvas;
    this.context = /** @type {CanvasRenderingContext2D} */ (canvas.getContext('2d'));
  }

  /** @param {Series[]} series over one axis of time, in seconds */
  draw(series) {
    const { canvas, context } = this, ratio = Math.min(2, devicePixelRatio || 1), width = canvas.clientWidth, height = canvas.clientHeight;
    if (canvas.width !== Math.round(width * ratio) || canvas.height !== Math.round(height * ratio)) canvas.width = Math.round(width * ratio), canvas.height = Math.round(height * ratio);
    const { x0, x1, y0, y1 } = extentOf(series), ink = getComputedStyle(canvas).color, theme = isDark(ink) ? 'light' : 'dark';
    const left = 40, right = width - 8, top = 22, bottom = height - 18;
    const X = x => left + (right - left) * (x - x0) / (x1 - x0), Y = y => bottom - (bottom - top) * (y - y0) / (y1 - y0);
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    context.clearRect(0, 0, width, height);
    context.font = FONT;
    context.fillStyle = context.strokeStyle = ink;
    context.lineWidth = 1;
    context.setLineDash([]);
    context.textBaseline = 'middle';
    context.textAlign = 'right';
    const line = (ax, ay, bx, by) => context.stroke(new Path2D(`M${ax} ${ay}L${bx} ${by}`));
    for (const y of ticks(y0, y1, height / 34)) {
      context.globalAlpha = .18;
      line(left, Y(y), right, Y(y));
      context.globalAlpha = 1;
      context.fillText(wordOf(y), left - 5, Y(y));
    }
    context.textAlign = 'center';
    for (const x of ticks(x0, x1, width / 70)) context.fillText(`${wordOf(x)} s`, Math.min(X(x), right - 10), bottom + 10);
    context.textAlign = 'left';
    let place = left;
    for (const { name, x, y, tone = 'usual' } of series) {
      const look = TONES[tone] ?? TONES.usual, count = Math.min(x.length, y.length);
      context.strokeStyle = context.fillStyle = look[theme];
      context.lineWidth = 2;
      context.setLineDash(look.dash);
      context.beginPath();
      let isGap = true;
      for (let k = 0; k < count; k++) {
        if (!Number.isFinite(y[k])) isGap = true;
        else if (isGap) context.moveTo(X(x[k]), Y(y[k])), isGap = false;
        else context.lineTo(X(x[k]), Y(y[k]));
      }
      context.stroke();
      // its name above all curves, behind a piece of it
      line(place, 8, place + SAMPLE, 8);
      context.fillText(name, place + SAMPLE + 5, 8);
      place += SAMPLE + 5 + context.measureText(name).width + 14;
    }
  }
}

/** What all curves lie in; never of no size. @param {Series[]} series */
export function extentOf(series) {
  let x0 = 0, x1 = 1, y0 = Infinity, y1 = -Infinity;
  for (const { x, y } of series)
    for (let k = 0; k < Math.min(x.length, y.length); k++)
      if (Number.isFinite(y[k])) x0 = Math.min(x0, x[k]), x1 = Math.max(x1, x[k]), y0 = Math.min(y0, y[k]), y1 = Math.max(y1, y[k]);
  if (y0 > y1) y0 = 0, y1 = 1;
  const room = Math.max((y1 - y0) * .06, Math.abs(y1) * 1e-6, 1e-9);
  return { x0, x1, y0: y0 - room, y1: y1 + room };
}

/** Round numbers from a to b, at most so many. @param {number} a @param {number} b @param {number} most */
export function ticks(a, b, most) {
  const step = roundStep((b - a) / Math.max(1, most)), found = [];
  for (let k = Math.ceil(a / step - 1e-9); k * step <= b + 1e-9 * step; k++) found.push(k * step);
  return found;
}

/** @param {number} v */
const wordOf = v => Math.abs(v) < 1e-12 ? '0' : String(+v.toPrecision(4));

/** Whether a colour of a style sheet is dark. @param {string} colour */
const isDark = colour => {
  const [r, g, b] = (colour.match(/[\d.]+/g) ?? ['0', '0', '0']).map(Number);
  return .3 * r + .59 * g + .11 * b < 128;
};
