// @ts-check
// Words that pass: what the server or the page has to say, at most three at a time.
import { byId, made } from './elements.js';

const MOST = 3, LEAST = 3500, A_LETTER = 55;  // ms

/** @param {string} text @param {string} [tone] */
export function toast(text, tone = '') {
  const list = byId('toasts');
  if ([...list.children].some((item) => item.textContent === text)) return;
  const item = made('p', text, tone);
  list.append(item);
  while (list.children.length > MOST) list.firstElementChild.remove();
  setTimeout(() => item.remove(), LEAST + A_LETTER * text.length);
}
