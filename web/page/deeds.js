// @ts-check
// What buttons and keys do: each by the name that stands in a button's data-do.
import { save } from './panels/dialogs.js';
import { theme } from './panels/settings.js';
import { toast } from './panels/elements.js';

const VIEWS = ['orbit', 'follow', 'map'];

/** What a button or a key does. @param {import('./hands.js').Hands} hands @param {string|undefined} action */
export function act(hands, action) {
  const { stage, panels } = hands, { player, room, picture: { camera } } = stage;
  switch (action) {
    case 'orbit': case 'follow': case 'map': return stage.view(action);
    case 'view': return stage.view(VIEWS[(VIEWS.indexOf(camera.view) + 1) % VIEWS.length]);
    case 'slope': stage.picture.setShading(stage.picture.shading === 'slope' ? 'height' : 'slope'); return;
    case 'theme': return hands.setTheme(theme() === 'dark' ? 'light' : 'dark');
    case 'turn-left': return camera.turn(60, 0);
    case 'turn-right': return camera.turn(-60, 0);
    case 'nearer': return camera.zoom(1.25);
    case 'farther': return camera.zoom(0.8);
    case 'next': return hands.step(1);
    case 'previous': return hands.step(-1);
    case 'talk': return panels.chat.open();
    case 'error': panels.toggleError(player); return;
    case 'help': return panels.help(stage.source);
    case 'pad': document.body.toggleAttribute('data-pad'); return;
    case 'pick': return hands.drop.pick();
    case 'join': hands.join(); return;
    case 'again': return stage.room ? stage.room.start() : stage.enter();
    case 'respawn': return room?.send({ type: 'respawn' });
    case 'cruise': return room?.own.steering.toggleCruise();
    case 'ghosts': if (room) toast(room.own.ghosts.cycle()); return;
    case 'skip': return room?.send({ type: 'skip' });
  }
  if (player) actOn(player, action, stage.file);
}

/** @param {import('./live/player.js').Player} player @param {string|undefined} action @param {string} file */
function actOn(player, action, file) {
  const { first, last, hz } = player.info;
  switch (action) {
    case 'pause': return player.toggle();
    case 'begin': return player.seek(first);
    case 'end': return player.seek(last);
    case 'back': return player.skip(-5);
    case 'on': return player.skip(5);
    case 'tick-back': return player.tickBy(-1);
    case 'tick-on': return player.tickBy(1);
    case 'slower': return player.faster(-1);
    case 'faster': return player.faster(1);
    case 'verify': player.verify().catch((error) => toast(error.message, 'bad')); return;
    case 'save': return save(player.recording.blob, file);
    case 'link':
      location.replace(`#t=${Math.floor(player.tick)}`);
      navigator.clipboard?.writeText(location.href).then(() => toast(`copied: this moment, ${((player.tick - first) / hz).toFixed(1)} s`), () => toast('the address now names this moment'));
  }
}
