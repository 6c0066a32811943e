// @ts-check
// Files that are dropped on the page or picked.
import { byId, setHidden } from './elements.js';

const MOST = 1 << 30;  // bytes

export class Drop {
  /** @param {(file: File) => void} open @param {(text: string) => void} refuse */
  constructor(open, refuse) {
    const take = (file) => { if (file) file.size > MOST ? refuse('that file is larger than 1 GiB') : open(file); };
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
