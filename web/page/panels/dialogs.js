// @ts-check
// What opens over the page: the help, a question that wants one line, and files that are dropped on it or picked.
import { byId, made, setHidden } from './elements.js';
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

export class Drop {
  /** @param {(file: File) => void} open */
  constructor(open) {
    const take = (file) => { if (file) open(file); };
    const carriesFiles = (event) => event.dataTransfer?.types.includes('Files');
    for (const type of ['dragenter', 'dragover']) addEventListener(type, (event) => {
      if (!carriesFiles(event)) return;
      event.preventDefault();
      setHidden(byId('drop'), false);
    });
    addEventListener('dragleave', (event) => { if (!event.relatedTarget) setHidden(byId('drop'), true); });
    addEventListener('drop', (event) => {
      event.preventDefault();
      setHidden(byId('drop'), true);
      take(event.dataTransfer?.files[0]);
    });
    byId('file').onchange = () => {
      take(byId('file').files[0]);
      byId('file').value = '';
    };
  }
  pick() {
    byId('help').close();
    byId('file').click();
  }
}

/** Offers bytes as a file. @param {Blob} blob @param {string} name */
export function save(blob, name) {
  const link = document.createElement('a');
  link.href = URL.createObjectURL(blob);
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}
