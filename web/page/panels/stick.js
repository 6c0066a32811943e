// @ts-check
// A stick and a brake, for hands on glass (and for who asks for them).
import { byId } from './elements.js';

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
