// @ts-check
// Pointers on the picture: drag turns the camera, wheel and two fingers zoom, a click takes the louse that lies there.
import { byId } from './elements.js';

const CLICK_MOVES = 6, CLICK_LASTS = 400;  // px, ms

export class CanvasInput {
  /** @param {{turn: (dx: number, dy: number) => void, zoom: (factor: number) => void, click: (x: number, y: number) => void}} hands in CSS pixels; zoom above 1: nearer */
  constructor(hands) {
    const canvas = byId('picture'), pointers = new Map();
    let pressed = { x: 0, y: 0, at: 0, isClick: false };
    canvas.onpointerdown = (event) => {
      canvas.setPointerCapture(event.pointerId);
      pointers.set(event.pointerId, [event.clientX, event.clientY]);
      pressed = { x: event.clientX, y: event.clientY, at: event.timeStamp, isClick: pointers.size === 1 };
    };
    canvas.onpointermove = (event) => {
      const before = pointers.get(event.pointerId);
      if (!before) return;
      const now = [event.clientX, event.clientY];
      pointers.set(event.pointerId, now);
      if (Math.hypot(now[0] - pressed.x, now[1] - pressed.y) > CLICK_MOVES) pressed.isClick = false;
      const other = [...pointers].find(([id]) => id !== event.pointerId)?.[1];
      if (!other) { if (!pressed.isClick) hands.turn(now[0] - before[0], now[1] - before[1]); return; }
      const apart = Math.hypot(before[0] - other[0], before[1] - other[1]);
      if (apart > 1) hands.zoom(Math.hypot(now[0] - other[0], now[1] - other[1]) / apart);
    };
    const letGo = (event) => {
      if (!pointers.delete(event.pointerId)) return;
      if (event.type === 'pointerup' && pressed.isClick && event.timeStamp - pressed.at < CLICK_LASTS) hands.click(event.clientX, event.clientY);
    };
    canvas.onpointerup = canvas.onpointercancel = letGo;
    canvas.addEventListener('wheel', (event) => {
      event.preventDefault();
      hands.zoom(Math.exp(-event.deltaY * (event.deltaMode ? 0.03 : 0.0012)));
    }, { passive: false });
  }
}
