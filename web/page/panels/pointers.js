// @ts-check
// Pointers: on the picture drag turns the camera, wheel and two fingers zoom, a click takes the louse that lies there; and a stick
// and a brake, for hands on glass (and for who asks for them).
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

const REACH = 52;  // px

export class Touch {
  /** @param {{stick: (vector: number[]|null) => void, brake: (isHeld: boolean) => void}} hands */
  constructor(hands) {
    const stick = byId('stick'), knob = stick.firstElementChild, brake = byId('brake');
    const move = (event) => {
      if (!stick.hasPointerCapture(event.pointerId)) return;
      const box = stick.getBoundingClientRect();
      let x = (event.clientX - box.left - box.width / 2) / REACH, y = (box.top + box.height / 2 - event.clientY) / REACH;
      const length = Math.hypot(x, y);
      if (length > 1) { x /= length; y /= length; }
      knob.style.transform = `translate(${x * 39}px, ${-y * 39}px)`;
      hands.stick([x, y]);
    };
    const letGo = () => {
      knob.style.transform = '';
      hands.stick(null);
    };
    stick.onpointerdown = (event) => { stick.setPointerCapture(event.pointerId); move(event); };
    stick.onpointermove = move;
    stick.onpointerup = stick.onpointercancel = letGo;
    brake.onpointerdown = () => hands.brake(true);
    brake.onpointerup = brake.onpointercancel = brake.onpointerleave = () => hands.brake(false);
    brake.onkeydown = (event) => { if (event.key === ' ' || event.key === 'Enter') hands.brake(true); };
    brake.onkeyup = brake.onblur = () => hands.brake(false);
    for (const element of [stick, brake]) element.oncontextmenu = (event) => event.preventDefault();
  }
}
