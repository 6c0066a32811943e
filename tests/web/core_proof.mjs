// Proves core.wasm: that it comes to every golden hash of the scenarios, and says of recordings - good, altered, cut off,
// plain and packed - what the native `verify` says.
//
//     node core_proof.mjs CORE SCENARIOS RECORDINGS [VERIFIER...]
//
// RECORDINGS: a folder of NAME.ndjson and NAME.ndjson.zst (woodlouse_scenario_recordings). VERIFIER: the command that
// verifies files natively. Prints the table of scenario, tick and hash; what is wrong goes to standard error.
import { spawnSync } from 'node:child_process';
import { mkdtempSync, readFileSync, readdirSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';

import { Core } from '../../web/page/core/core.js';
import { RecordingDesk } from '../../web/page/core/recording_desk.js';

const [wasm, scenarios, recordings, ...verifier] = process.argv.slice(2);
const module = await WebAssembly.compile(readFileSync(wasm));
let wrong = 0;
const tell = words => { ++wrong; process.stderr.write(`${words}\n`); };

/** What core.wasm says of a file's bytes; each in an instance of its own. */
const verdict = async bytes => (await new RecordingDesk(module).verify(bytes)).text;

/** The hash at each tick, as one looks at a recording: by going there. */
async function hashesAt(bytes, ticks) {
  const { instance } = await Core.load(module);
  const handle = instance.withBytes(bytes, (at, size) => instance.call('recording_open', at, size));
  if (handle === 0) throw new Error(instance.answer());
  return ticks.map(tick => {
    if (!instance.call('recording_seek', handle, tick)) throw new Error(instance.answer());
    const proof = instance.json('recording_proof', handle);
    return proof.difference ? JSON.stringify(proof.difference) : proof.hash;
  });
}

/** One thrust of a step in the middle, altered by the least there is; null: none is asked for. */
function altered(text) {
  const lines = text.split('\n');
  for (let k = lines.length >> 1; k < lines.length; ++k) {
    const line = lines[k].replace(/("inputs":\[\[\d+,\d+,)(-?\d+)/, (_, before, thrust) => before + (thrust > 0 ? thrust - 1 : +thrust + 1));
    if (line !== lines[k]) return [...lines.slice(0, k), line, ...lines.slice(k + 1)].join('\n');
  }
  return null;
}

const names = readdirSync(scenarios).filter(name => name.endsWith('.json')).map(name => name.slice(0, -5)).sort();
const files = new Map();
for (const name of names) {
  const plain = readFileSync(join(recordings, `${name}.ndjson`));
  const packed = readFileSync(join(recordings, `${name}.ndjson.zst`));
  const golden = Object.keys(JSON.parse(readFileSync(join(scenarios, `${name}.json`))).hashes);
  const [one, other] = [await hashesAt(plain, golden.map(Number)), await hashesAt(packed, golden.map(Number))];
  golden.forEach((tick, k) => process.stdout.write(`${name} ${tick} ${one[k]}\n`));
  if (one.join() !== other.join()) tell(`${name}: packed it comes to other hashes than plain`);
  files.set(`${name}.ndjson`, plain).set(`${name}.ndjson.zst`, packed);
  const other_thrust = altered(plain.toString());
  if (other_thrust) files.set(`${name}.altered.ndjson`, Buffer.from(other_thrust));
  files.set(`${name}.cut.ndjson`, plain.subarray(0, Math.floor(plain.length * 0.7))).set(`${name}.cut.ndjson.zst`, packed.subarray(0, Math.floor(packed.length * 0.7)));
}

if (verifier.length) {
  const folder = mkdtempSync(join(tmpdir(), 'woodlouse-core-'));
  try {
    for (const [name, bytes] of files) writeFileSync(join(folder, name), bytes);
    const said = spawnSync(verifier[0], [...verifier.slice(1), ...files.keys()], { cwd: folder, encoding: 'utf8', maxBuffer: 1 << 26 });
    if (said.error) throw said.error;
    const native = said.stdout;
    let core = '';
    // Of several files each verdict stands behind its file's name; a fault's words begin with it.
    for (const [name, bytes] of files) {
      const words = (await verdict(bytes)).replaceAll('the recording:', `${name}:`);
      core += words.startsWith(`${name}:`) ? words : `${name}: ${words}`;
    }
    if (core !== native) {
      const ours = core.split('\n');
      native.split('\n').forEach((line, k) => { if (line !== ours[k]) tell(`native: ${line}\nwasm:   ${ours[k]}`); });
      if (core.split('\n').length !== native.split('\n').length) tell('there are more or fewer lines');
    }
    process.stderr.write(`${files.size} verdicts compared\n`);
  } finally {
    rmSync(folder, { recursive: true });
  }
}
process.exitCode = wrong ? 1 : 0;
