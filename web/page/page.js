// @ts-check
// The page begins: with what its address asks for.
import { Core } from './core/core.js';
import { CoreEnded } from './core/instance.js';
import { kept, leaveBehind, leftBehind } from './panels/settings.js';
import { byId, setHidden, setText, toast } from './panels/elements.js';
import { Stage } from './stage.js';

setHidden(byId('lost'), true);  // this much has come; what else goes wrong is told below
byId('lost').classList.remove('early');

const PATIENCE = 200;  // ms

const params = new URLSearchParams(location.search);
const loaded = () => Core.load(new URL('core.wasm', import.meta.url));
/** @type {WorkerOptions} */ const modular = { type: 'module' };
const workers = {
  baker: () => new Worker(new URL('./picture/bake.js', import.meta.url), modular),
  reader: () => new Worker(new URL('./core/recording_worker.js', import.meta.url), modular),
};

/** A recording of this server's, by its address. @param {Stage} stage @param {string} address */
async function openAddress(stage, address) {
  const url = new URL(address, location.href);
  if (url.origin !== location.origin) throw new Error('?replay= takes recordings of this server alone');
  const answer = await fetch(url);
  if (!answer.ok) throw new Error(`${url.pathname}: ${answer.status} ${answer.statusText}`);
  await stage.open(await answer.blob(), url.pathname.split('/').at(-1) ?? '');
}

/** Into a room: the first word to a server, which needs no core. @param {Stage} stage */
function enter(stage) {
  const name = params.get('name') ?? kept('name'), back = leftBehind();
  if (!back && !(params.has('play') && name)) return stage.enter();
  stage.enter({ role: 'player', ...back ?? { name } });
}

/** The page has loaded, or it takes its time. A browser moves something of its own until then, as long as a page is loaded: where a
 * processor draws, what it draws of itself would come before every word to the picture's own context. */
const settled = () => new Promise((resolve) => {
  if (document.readyState === 'complete') return void resolve(undefined);
  addEventListener('load', () => setTimeout(resolve), { once: true });
  setTimeout(resolve, PATIENCE);
});

/** What an address asks for instead of a room. @param {Stage} stage @param {string | null} replay */
async function show(stage, replay) {
  if (!replay) return stage.compare();
  await openAddress(stage, replay);
  if (!stage.source) stage.enter();  // one that is damaged was told of
}

/** @param {unknown} error */
const wordsOf = (error) => (error instanceof Error ? error.message : String(error));

const loading = loaded(), stage = new Stage(workers);
try {
  const replay = params.get('replay'), isRoom = !replay && !params.has('lab');
  if (isRoom) enter(stage);  // joins once there is a core
  loading.then((core) => { stage.core = core; }, () => {});  // why there is none is told below
  await settled();
  stage.begin();  // what draws gets ready while the core compiles and the server answers
  if (stage.room?.door.wish.role === 'player') stage.view('follow');
  await loading;
  Object.assign(globalThis, { woodlouse: stage });  // for who looks in from the console, and for tests
  requestAnimationFrame((now) => stage.frame(now));
  addEventListener('pagehide', () => leaveBehind(stage.back));
  if (!isRoom) await show(stage, replay).catch((error) => { toast(wordsOf(error), 'bad'); stage.enter(); });
  let isMending = false;
  addEventListener('error', async ({ error }) => {
    if (error instanceof Error && !(error instanceof CoreEnded)) toast(error.message, 'bad');  // a shader that this machine can't have, above all
    if (!(error instanceof CoreEnded) || isMending) return;
    isMending = true;  // an instance that has ended is of no use any more
    stage.replaceCore(await loaded());
    isMending = false;
  });
} catch (error) {  // without WebGL or WebAssembly there is nothing to show
  stage.room?.stop();
  setText(byId('lost').firstElementChild, wordsOf(error));
  setHidden(byId('lost').lastElementChild, true);
  setHidden(byId('lost'), false);
}
