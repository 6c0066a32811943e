// @ts-check
// What a person chose, kept in the browser: light or dark, palette, the stick on the screen, the name, and whether the lesson was had.

import { byId } from './elements.js';

const KEY = 'woodlouse-';

/** The storage, or null where the browser forbids it. @type {Storage|null} */
export const storage = (() => { try { return localStorage; } catch { return null; } })();

export function kept(name) { try { return storage?.getItem(KEY + name) ?? ''; } catch { return ''; } }
export function keep(name, value) { try { storage?.setItem(KEY + name, value); } catch { /* then it is asked again */ } }

/** What is wanted of the next page in this tab, once: a page that is loaded anew. @param {object|null} wish */
export function leaveBehind(wish) { try { if (wish) sessionStorage.setItem(KEY + 'back', JSON.stringify(wish)); } catch { /* then it begins as ever */ } }
/** What the page before left, where this one is that page loaded anew. @returns {{name: string, room: string, resume: string}|null} */
export function leftBehind() {
  try {
    const text = sessionStorage.getItem(KEY + 'back');
    sessionStorage.removeItem(KEY + 'back');
    const navigation = /** @type {PerformanceNavigationTiming|undefined} */ (performance.getEntriesByType('navigation')[0]);
    return text && navigation?.type === 'reload' ? JSON.parse(text) : null;
  } catch { return null; }
}

const prefersLight = matchMedia('(prefers-color-scheme: light)');

/** @returns {'light'|'dark'} as chosen, else as the system has it */
export function theme() { return /** @type {any} */ (['light', 'dark'].find((name) => name === (document.documentElement.dataset.theme || kept('theme'))) ?? (prefersLight.matches ? 'light' : 'dark')); }

/** @param {string} name */
export function setTheme(name) {
  document.documentElement.dataset.theme = name;
  keep('theme', name);
}
/** @param {() => void} then */
export function onSystemTheme(then) { prefersLight.addEventListener('change', then); }

/** As much of a name as the wire takes: 24 bytes. @param {string} name */
export function shortName(name) {
  const letters = [...name.trim()], bytes = new TextEncoder();
  while (bytes.encode(letters.join('')).length > 24) letters.pop();
  return letters.join('');
}

/** What one's louse is called can be said anew. */
export function onName() {
  const input = byId('name');
  input.value = kept('name');
  input.onchange = () => keep('name', input.value = shortName(input.value));
}

/** Tells which palette is chosen, now and whenever another one is. @param {string|null} wanted by the address @param {(palette: any) => void} then */
export function onPalette(wanted, then) {
  const select = byId('palette');
  for (const palette of ['default', kept('palette'), wanted])
    if ([...select.options].some(({ value }) => value === palette)) select.value = palette;
  select.onchange = () => {
    keep('palette', select.value);
    then(select.value);
  };
  then(select.value);
}
