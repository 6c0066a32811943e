// @ts-check
// The few things that all panels do with the document. What comes from outside becomes text, never markup.

/** @param {string} id @returns {any} */
export const byId = (id) => document.getElementById(id);

/** Touches the document only where it changes. */
export function setText(element, text) { if (element.textContent !== text) element.textContent = text; }
export function setClass(element, name) { if (element.className !== name) element.className = name; }
export function setHidden(element, isHidden) { if (element.hidden !== isHidden) element.hidden = isHidden; }
export function setPressed(action, isPressed) {
  for (const button of document.querySelectorAll(`[data-do=${action}]`))
    if (button.getAttribute('aria-pressed') !== String(isPressed)) button.setAttribute('aria-pressed', String(isPressed));
}

/** A new element with a text and a class. @returns {any} */
export function made(tag, text = '', className = '') {
  const element = document.createElement(tag);
  if (text) element.textContent = text;
  if (className) element.className = className;
  return element;
}

/** As many children as there are values: missing ones are made, each is filled, those too many go.
 * @param {Element} parent @param {any[]} values @param {() => Element} make @param {(child: any, value: any, k: number) => void} fill */
export function fillChildren(parent, values, make, fill) {
  while (parent.children.length > values.length) parent.lastElementChild?.remove();
  while (parent.children.length < values.length) parent.append(make());
  values.forEach((value, k) => fill(parent.children[k], value, k));
}

/** A line of spans with tones. @param {Element} line @param {{text: string, tone?: string}[]} spans */
export function fillSpans(line, spans) {
  fillChildren(line, spans, () => made('span'), (span, { text, tone = '' }) => { setText(span, text); setClass(span, tone); });
}

const MOST = 3, LONGEST = 240, LEAST = 3500, A_LETTER = 55;  // letters, ms, ms

/** @param {string} said @param {string} [tone] */
export function toast(said, tone = '') {
  const text = said.length > LONGEST ? `${said.slice(0, LONGEST - 1)}\u2026` : said;
  const list = byId('toasts');
  if ([...list.children].some((item) => item.textContent === text)) return;
  const item = made('p', text, tone);
  list.append(item);
  while (list.children.length > MOST) list.firstElementChild.remove();
  setTimeout(() => item.remove(), LEAST + A_LETTER * text.length);
}
