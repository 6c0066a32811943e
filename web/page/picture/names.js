// @ts-check
// Names and numbers over the picture, each written once and then copied.
import { THEMES, css } from './colours.js';
import { placeLabels } from './labels.js';

const FONT = '600 12px system-ui, "Segoe UI", "DejaVu Sans", sans-serif';
const HEIGHT = 18, PAD = 4;
/** More names than this are noise; of many lice even fewer. */
const MOST = 40, MOST_OF_MANY = 24, MANY = 60;
const KEPT = 500;  // written texts

/** One to show: where, how far from there at least, CSS pixels; higher ranks first, Infinity always; colour 0xRRGGBB or null: text's own; a badge has a plate of that colour.
 * @typedef {{key: any, text: string, colour: number | null, badge: boolean, x: number, y: number, reach: number, rank: number}} Name */

export class Names {
  /** @param {HTMLCanvasElement} canvas */
  constructor(canvas) {
    this.canvas = canvas;
    this.context = /** @type {CanvasRenderingContext2D} */ (canvas.getContext('2d'));
    /** @type {Map<string, HTMLCanvasElement>} */
    this.written = new Map();
    /** @type {Map<any, {x: number, y: number}>} */
    this.placed = new Map();
    this.ratio = 0;
    this.isClean = false;
  }

  /** @param {string} text @param {number | null} colour @param {boolean} badge @param {import('./colours.js').ThemeName} theme */
  write(text, colour, badge, theme) {
    const key = `${text}\n${colour}\n${badge}\n${theme}`;
    const known = this.written.get(key);
    if (known) return known;
    if (this.written.size > KEPT) this.written.clear();
    const look = THEMES[theme], canvas = document.createElement('canvas'), context = /** @type {CanvasRenderingContext2D} */ (canvas.getContext('2d'));
    context.font = FONT;
    const width = Math.ceil(context.measureText(text).width) + 2 * PAD + (badge ? 6 : 0);
    canvas.width = width * this.ratio;
    canvas.height = HEIGHT * this.ratio;
    context.scale(this.ratio, this.ratio);
    context.font = FONT;
    context.textAlign = 'center';
    context.textBaseline = 'middle';
    context.lineJoin = 'round';
    const dark = theme === 'dark';
    if (badge) {
      context.fillStyle = colour === null ? look.halo : css(colour);
      context.beginPath();
      context.roundRect(0, 0, width, HEIGHT, HEIGHT / 2);
      context.fill();
      context.fillStyle = colour === null ? look.text : readableOn(colour);
    } else {
      context.lineWidth = 4;
      context.strokeStyle = look.halo;
      context.strokeText(text, width / 2, HEIGHT / 2 + .5);
      context.fillStyle = dark && colour !== null ? css(colour) : look.text;
    }
    context.fillText(text, width / 2, HEIGHT / 2 + .5);
    this.written.set(key, canvas);
    return canvas;
  }

  /** @param {Name[]} names @param {import('./camera.js').Camera} camera @param {import('./colours.js').ThemeName} theme
   * @param {{x: number, y: number, angle: number, colour: number}[]} arrows towards what is outside the picture */
  draw(names, camera, theme, arrows) {
    const { canvas, context } = this, ratio = Math.min(2, globalThis.devicePixelRatio || 1);
    const width = Math.round(camera.width * ratio), height = Math.round(camera.height * ratio);
    if (canvas.width !== width || canvas.height !== height || ratio !== this.ratio) {
      canvas.width = width;
      canvas.height = height;
      this.ratio = ratio;
      this.written.clear();
    } else if (!this.isClean) context.clearRect(0, 0, width, height);
    this.isClean = !names.length && !arrows.length;
    const pictures = new Map();
    const wanted = names.map(name => {
      const picture = this.write(name.text, name.colour, name.badge, theme);
      pictures.set(name.key, picture);
      // who was named stays named: names do not flicker
      const rank = name.rank + (this.placed.has(name.key) ? .5 : 0);
      return { key: name.key, x: name.x, y: name.y, reach: name.reach, width: picture.width / ratio, height: HEIGHT - 2, rank };
    });
    const { left, top, right, bottom } = camera.insets;
    this.placed = placeLabels(wanted, { left: left + 2, top: top + 2, right: camera.width - right - 2, bottom: camera.height - bottom - 2 },
      names.length > MANY ? MOST_OF_MANY : MOST);
    for (const [key, at] of this.placed) context.drawImage(pictures.get(key), Math.round(at.x * ratio), Math.round(at.y * ratio));
    for (const arrow of arrows) {
      context.save();
      context.setTransform(ratio, 0, 0, ratio, arrow.x * ratio, arrow.y * ratio);
      context.rotate(arrow.angle);
      context.beginPath();
      context.moveTo(16, 0);
      context.lineTo(-8, 10);
      context.lineTo(-3, 0);
      context.lineTo(-8, -10);
      context.closePath();
      context.lineWidth = 4;
      context.lineJoin = 'round';
      context.strokeStyle = THEMES[theme].halo;
      context.stroke();
      context.fillStyle = css(arrow.colour);
      context.fill();
      context.restore();
    }
  }
}

/** Black or white, whichever is read better on a colour. @param {number} colour */
export function readableOn(colour) {
  const linear = [16, 8, 0].map(shift => ((colour >> shift & 255) / 255) ** 2.2);
  return .2126 * linear[0] + .7152 * linear[1] + .0722 * linear[2] > .18 ? '#0b0d14' : '#ffffff';
}
