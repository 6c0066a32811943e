// @ts-check
// What opens over the page: the help, and a question that wants one line.
import { byId, made } from './elements.js';
import { KEYS } from './keys.js';
import { kept } from './settings.js';

/** @param {string} rules what is played */
export function showHelp(rules) {
  byId('rules').textContent = rules;
  const list = byId('keys');
  if (!list.children.length) for (const [keys, what] of KEYS) {
    const term = made('dt');
    term.append(made('kbd', keys));
    list.append(term, made('dd', what));
  }
  byId('name').value = kept('name');
  byId('help').showModal();
}

/** Asks for one line. @param {{title: string, label: string, value?: string, isSecret?: boolean, most?: number}} question
 * @returns {Promise<string|null>} null: nothing was answered */
export function ask({ title, label, value = '', isSecret = false, most = 24 }) {
  const dialog = byId('ask'), input = byId('ask-what');
  byId('ask-title').textContent = title;
  byId('ask-label').textContent = label;
  input.type = isSecret ? 'password' : 'text';
  input.maxLength = most;
  input.value = value;
  return new Promise((resolve) => {
    let answer = /** @type {string|null} */ (null);
    dialog.querySelector('form').onsubmit = () => { answer = input.value.trim(); };
    byId('ask-not').onclick = () => dialog.close();
    dialog.onclose = () => resolve(answer || null);
    if (dialog.open) dialog.close();
    dialog.showModal();
    input.select();
  });
}
