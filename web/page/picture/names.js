// @ts-check
// Names and numbers over the picture. Each is written once, into a canvas of its own that is then only moved: one
// canvas over the whole picture costs a software renderer as much as the lice do.
import { THEMES, css } from './colours.js';

const FONT = '600 12px system-ui, "Segoe UI", "DejaVu Sans", sans-serif';
const HEIGHT = 18, PAD = 4;
/** More names than this are noise; of many lice even fewer. */
const MOST = 40, MOST_OF_MANY = 24, MANY = 60;
/** Small, and written once: nothing for a graphics card, whose context takes a tenth of a second to make where a processor draws. */
const WRITTEN = { willReadFrequently: true };
const KEPT = 400;  // written texts

/** One to show: where, how far from there at least, CSS pixels; higher ranks first, Infinity always; colour 0xRRGGBB or null: text's own; a badge has a plate of that colour.
 * @typedef {{key: any, text: string, colour: number | null, badge: boolean, x: number, y: number, reach: number, rank: number}} Name */
/** Towards what is outside the picture. @typedef {{x: number, y: number, angle: number, colour: number}} Arrow */

export class Names {
  /** @param {HTMLElement} parent over the picture, of its size */
  constructor(parent) {
    this.parent = parent;
    /** Written texts, by what makes them look as they do. @type {Map<string, HTMLCanvasElement>} */
    this.written = new Map();
    /** Of texts [CSS pixels]. @type {Map<string, number>} */
    this.widths = new Map();
    /** @type {Map<any, {x: number, y: number}>} */
    this.placed = new Map();
    /** @type {Set<HTMLCanvasElement>} */
    this.shown = new Set();
    this.ratio = 0;
    /** @type {CanvasRenderingContext2D | undefined} */
    this.measure = undefined;
  }

  /** A canvas that is kept by this key, drawn the first time it is asked for. @param {string} key @param {number} width CSS pixels @param {number} height
   * @param {(context: CanvasRenderingContext2D) => void} draw */
  keep(key, width, height, draw) {
    const canvas = document.createElement('canvas'), context = /** @type {CanvasRenderingContext2D} */ (canvas.getContext('2d', WRITTEN));
    canvas.width = Math.ceil(width * this.ratio);
    canvas.height = Math.ceil(height * this.ratio);
    canvas.style.cssText = `position:absolute;left:0;top:0;width:${width}px;height:${height}px;will-change:transform;pointer-events:none`;
    context.scale(this.ratio, this.ratio);
    context.lineJoin = 'round';
    context.lineWidth = 4;
    draw(context);
    this.written.set(key, canvas);
    return canvas;
  }

  /** How wide a name is [CSS pixels]. @param {Name} name */
  widthOf({ text, badge }) {
    let width = this.widths.get(text);
    if (width === undefined) {
      const measure = this.measure ??= /** @type {CanvasRenderingContext2D} */ (document.createElement('canvas').getContext('2d', WRITTEN));
      measure.font = FONT;
      this.widths.set(text, width = Math.ceil(measure.measureText(text).width) + 2 * PAD);
    }
    return badge ? width + 6 : width;
  }

  /** @param {Name} name @param {import('./colours.js').ThemeName} theme @param {number} twin how many of the same text and colour are shown already */
  write(name, theme, twin) {
    const { text, colour, badge } = name, key = `${text}\n${colour}\n${badge}\n${theme}\n${twin}`, known = this.written.get(key);
    if (known) return known;
    const look = THEMES[theme], width = this.widthOf(name);
    return this.keep(key, width, HEIGHT, context => {
      context.font = FONT;
      context.textAlign = 'center';
      context.textBaseline = 'middle';
      if (badge) {
        context.fillStyle = colour === null ? look.halo : css(colour);
        context.beginPath();
        context.roundRect(0, 0, width, HEIGHT, HEIGHT / 2);
        context.fill();
        context.fillStyle = colour === null ? look.text : readableOn(colour);
      } else {
        context.strokeStyle = look.halo;
        context.strokeText(text, width / 2, HEIGHT / 2 + .5);
        context.fillStyle = theme === 'dark' && colour !== null && readableOn(colour) !== '#ffffff' ? css(colour) : look.text;  // a dark one is not read on the halo
      }
      context.fillText(text, width / 2, HEIGHT / 2 + .5);
    });
  }

  /** @param {Arrow} arrow @param {import('./colours.js').ThemeName} theme @param {number} number */
  arrow({ colour }, theme, number) {
    const key = `\n${colour}\n${theme}\n${number}`;
    return this.written.get(key) ?? this.keep(key, 36, 36, context => {
      context.beginPath();
      for (const [x, y] of [[32, 18], [10, 28], [15, 18], [10, 8]]) context.lineTo(x, y);
      context.closePath();
      context.strokeStyle = THEMES[theme].halo;
      context.stroke();
      context.fillStyle = css(colour);
      context.fill();
    });
  }

  /** @param {Name[]} names @param {import('./camera.js').Camera} camera @param {import('./colours.js').ThemeName} theme @param {Arrow[]} arrows */
  draw(names, camera, theme, arrows) {
    const ratio = Math.min(2, globalThis.devicePixelRatio || 1);
    if (ratio !== this.ratio || this.written.size > KEPT || this.widths.size > 4 * KEPT) {
      this.ratio = ratio;
      this.written.clear();
      this.widths.clear();
    }
    /** @type {Map<string, number>} */
    const twins = new Map();
    // who was named stays named: names do not flicker
    const most = names.length > MANY ? MOST_OF_MANY : MOST, ranks = new Map(names.map(name => [name, name.rank * (this.placed.has(name.key) ? 1.5 : 1)]));
    const rankOf = name => /** @type {number} */ (ranks.get(name)), best = names.sort((a, b) => rankOf(b) - rankOf(a)).slice(0, 3 * most);
    const wanted = best.map(name => ({ key: name.key, x: name.x, y: name.y, reach: name.reach, width: this.widthOf(name), height: HEIGHT - 2, rank: rankOf(name) }));
    const { left, top, right, bottom } = camera.insets;
    this.placed = placeLabels(wanted, { left: left + 2, top: top + 2, right: camera.width - right - 2, bottom: camera.height - bottom - 2 }, most);
    const now = new Set();
    const show = (picture, transform) => {
      picture.style.transform = transform;
      if (!this.shown.has(picture)) this.parent.append(picture);
      now.add(picture);
    };
    for (const name of best) {  // of the others nothing is written
      const at = this.placed.get(name.key), like = name.text + name.colour, twin = twins.get(like) ?? 0;
      if (!at) continue;
      twins.set(like, twin + 1);
      show(this.write(name, theme, twin), `translate(${Math.round(at.x * ratio) / ratio}px,${Math.round(at.y * ratio) / ratio}px)`);
    }
    arrows.forEach((arrow, k) => show(this.arrow(arrow, theme, k), `translate(${arrow.x - 18}px,${arrow.y - 18}px) rotate(${arrow.angle}rad)`));
    for (const picture of this.shown) if (!now.has(picture)) picture.remove();
    this.shown = now;
  }
}

/** Black or white, whichever is read better on a colour. @param {number} colour */
export function readableOn(colour) {
  const linear = [16, 8, 0].map(shift => ((colour >> shift & 255) / 255) ** 2.2);
  return .2126 * linear[0] + .7152 * linear[1] + .0722 * linear[2] > .18 ? '#0b0d14' : '#ffffff';
}

/**
 * A label to place: its anchor in CSS pixels, how far it may keep from it, its size; higher ranks first.
 * @typedef {{key: any, x: number, y: number, reach: number, width: number, height: number, rank: number}} Wanted
 */

/**
 * Places as many as fit, at most `most`: above, below, right, left of their anchors, no two over one another, all
 * inside; one that is forced (its rank is Infinity) always. Gives the upper left corners, by key.
 * @param {Wanted[]} wanted @param {{left: number, top: number, right: number, bottom: number}} free @param {number} most
 * @returns {Map<any, {x: number, y: number}>}
 */
export function placeLabels(wanted, free, most) {
  /** @type {Map<any, {x: number, y: number}>} */
  const placed = new Map();
  /** @type {number[][]} by rows of 32 pixels, so that few are compared */
  const rows = [];
  const isTaken = (x, y, w, h) => {
    for (let r = Math.floor(y / 32); r <= Math.floor((y + h) / 32); r++) {
      const row = rows[r] ?? [];
      for (let k = 0; k < row.length; k += 4)
        if (x < row[k + 2] && row[k] < x + w && y < row[k + 3] && row[k + 1] < y + h) return true;
    }
    return false;
  };
  const take = (x, y, w, h) => {
    for (let r = Math.floor(y / 32); r <= Math.floor((y + h) / 32); r++) (rows[r] ??= []).push(x, y, x + w, y + h);
  };
  wanted.sort((a, b) => b.rank - a.rank);
  for (const label of wanted) {
    if (placed.size >= most) break;
    const { width: w, height: h, reach } = label;
    const choices = [[label.x - w / 2, label.y - reach - h], [label.x - w / 2, label.y + reach],
      [label.x + reach, label.y - h / 2], [label.x - reach - w, label.y - h / 2]];
    const inside = choices.filter(([x, y]) => x >= free.left && y >= free.top && x + w <= free.right && y + h <= free.bottom);
    const place = inside.find(([x, y]) => !isTaken(x, y, w, h)) ?? (label.rank === Infinity ? inside[0] : undefined);
    if (!place) continue;
    const [x, y] = place;
    placed.set(label.key, { x, y });
    take(x, y, w, h);
    // nothing is written over who must be seen
    if (label.rank === Infinity) take(label.x - reach * .7, label.y - reach * .7, reach * 1.4, reach * 1.4);
  }
  return placed;
}
