// @ts-check
// The page begins: with what its address asks for.
import { Core } from './core/core.js';
import { CoreEnded } from './core/instance.js';
import { kept, leaveBehind, leftBehind } from './panels/settings.js';
import { byId, setHidden, setText, toast } from './panels/elements.js';

setHidden(byId('lost'), true);  // this much has come; what else goes wrong is told below
byId('lost').classList.remove('early');

const params = new URLSearchParams(location.search);
const loaded = () => Core.load(new URL('core.wasm', import.meta.url));
/** @type {WorkerOptions} */ const modular = { type: 'module' };
const workers = {
  baker: () => new Worker(new URL('./picture/bake.js', import.meta.url), modular),
  reader: () => new Worker(new URL('./core/recording_worker.js', import.meta.url), modular),
};

/** A recording of this server's, by its address. @param {import('./stage.js').Stage} stage @param {string} address */
async function openAddress(stage, address) {
  const url = new URL(address, location.href);
  if (url.origin !== location.origin) throw new Error('?replay= takes recordings of this server alone');
  const answer = await fetch(url);
  if (!answer.ok) throw new Error(`${url.pathname}: ${answer.status} ${answer.statusText}`);
  await stage.open(await answer.blob(), url.pathname.split('/').at(-1) ?? '');
}

/** @param {import('./stage.js').Stage} stage */
async function begin(stage) {
  const name = params.get('name') ?? kept('name'), replay = params.get('replay');
  if (params.has('lab')) return stage.compare();
  if (replay) {
    await openAddress(stage, replay);
    return void (stage.source ?? stage.enter());  // one that is damaged was told of
  }
  const back = leftBehind();
  if (!back && !(params.has('play') && name)) return void stage.enter();
  stage.enter({ role: 'player', ...back ?? { name } });
  stage.view('follow');
}

/** @param {unknown} error */
const wordsOf = (error) => (error instanceof Error ? error.message : String(error));

try {
  const loading = loaded();
  loading.catch(() => {});  // told below
  const { Stage } = await import('./stage.js'), stage = new Stage(workers);  // what draws gets ready while the core compiles
  stage.core = await loading;
  Object.assign(globalThis, { woodlouse: stage });  // for who looks in from the console, and for tests
  requestAnimationFrame((now) => stage.frame(now));
  addEventListener('pagehide', () => leaveBehind(stage.back));
  await begin(stage).catch((error) => { toast(wordsOf(error), 'bad'); stage.enter(); });
  let isMending = false;
  addEventListener('error', async ({ error }) => {
    if (error instanceof Error && !(error instanceof CoreEnded)) toast(error.message, 'bad');  // a shader that this machine can't have, above all
    if (!(error instanceof CoreEnded) || isMending) return;
    isMending = true;  // an instance that has ended is of no use any more
    stage.replaceCore(await loaded());
    isMending = false;
  });
} catch (error) {  // without WebGL or WebAssembly there is nothing to show
  setText(byId('lost').firstElementChild, wordsOf(error));
  setHidden(byId('lost').lastElementChild, true);
  setHidden(byId('lost'), false);
}
