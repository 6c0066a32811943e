// A real server with its page, a browser, and a long line between both where a test wants one.
import { spawn } from 'node:child_process';
import { existsSync, mkdtempSync, rmSync } from 'node:fs';
import net from 'node:net';
import { tmpdir } from 'node:os';
import path from 'node:path';
import readline from 'node:readline';
import { chromium } from 'playwright-core';

const here = path.dirname(new URL(import.meta.url).pathname);
const binaries = process.env.WOODLOUSE_BIN ?? path.join(here, '../../../build/release/bin');
const browser = process.env.CHROMIUM ?? '/usr/bin/chromium';

/** A server; `web` is the address of its page. */
export class Served {
  /** @param {string[]} options */
  static async start(...options) {
    const served = new Served();
    served.folder = mkdtempSync(path.join(tmpdir(), 'woodlouse-'));
    served.options = options;
    await served.begin('127.0.0.1:0');
    return served;
  }

  async begin(web) {
    this.process = spawn(path.join(binaries, 'woodlouse-server'), ['--listen', '127.0.0.1:0', '--web', web, ...this.options], { cwd: this.folder, stdio: ['ignore', 'pipe', 'pipe'] });
    this.log = '';
    this.process.stderr.on('data', (bytes) => { this.log += bytes; });
    this.ended = new Promise((resolve) => this.process.once('exit', resolve));
    for await (const line of readline.createInterface({ input: this.process.stdout })) {
      const found = /^web (http:\/\/[\d.]+:(\d+)\/)/.exec(line);
      if (!found) continue;
      [, this.web, this.port] = found;
      return;
    }
    throw new Error(`no server: ${this.log}`);
  }

  /** Ends it, and begins another on the same port. */
  async restart(pause) {
    this.process.kill('SIGTERM');
    await this.ended;
    await new Promise((resolve) => setTimeout(resolve, pause));
    await this.begin(`127.0.0.1:${this.port}`);
  }

  /** A command of the operator's; of a server that was started with `--admin admin.sock`. @param {string[]} command */
  admin(...command) {
    const said = spawn(path.join(binaries, 'woodlouse-server'), ['admin', '--socket', path.join(this.folder, 'admin.sock'), ...command], { stdio: 'inherit' });
    return new Promise((resolve, reject) => said.once('exit', (status) => (status === 0 ? resolve(undefined) : reject(new Error(`admin ${command.join(' ')}: ${status}`)))));
  }

  async stop() {
    this.process.kill('SIGTERM');
    await this.ended;
    rmSync(this.folder, { recursive: true, force: true });
  }
}

/** A TCP line to a port that is long: each way `delay` [ms], and up to `jitter` more, anew for each piece; in order, as TCP's is. */
export class SlowLine {
  static async to(port, delay, jitter) {
    const line = new SlowLine(), sockets = new Set();
    const carry = (from, to) => {
      const waiting = [];
      let last = 0, timer = null;
      const pass = () => {
        timer = null;
        while (waiting[0]?.at <= performance.now()) {
          const { then } = waiting.shift();
          if (!to.destroyed) then();
        }
        if (waiting.length) timer = setTimeout(pass, waiting[0].at - performance.now());
      };
      const later = (then) => {
        last = Math.max(last, performance.now() + delay + jitter * Math.random());
        waiting.push({ at: last, then });
        timer ??= setTimeout(pass, delay);
      };
      from.on('data', (bytes) => later(() => to.write(bytes)));
      from.on('end', () => later(() => to.end()));
      from.on('error', () => to.destroy());
    };
    line.listening = net.createServer((near) => {
      const far = net.connect(port, '127.0.0.1');
      for (const socket of [near, far]) { socket.setNoDelay(); sockets.add(socket); }
      carry(near, far);
      carry(far, near);
    });
    await new Promise((resolve) => line.listening.listen(0, '127.0.0.1', resolve));
    line.web = `http://127.0.0.1:${line.listening.address().port}/`;
    line.sockets = sockets;
    return line;
  }

  stop() {
    this.listening.close();
    for (const socket of this.sockets) socket.destroy();
  }
}

/** What the page's policy refused, and what went wrong in pages of `browsed()`. */
export const faults = [];

/** A browser with a profile of its own. */
export async function browsed(options = {}) {
  if (!existsSync(browser)) throw new Error(`no ${browser}: apt-get install chromium, or say CHROMIUM=...`);
  const profile = mkdtempSync(path.join(tmpdir(), 'woodlouse-profile-'));
  const context = await chromium.launchPersistentContext(profile, {
    executablePath: browser, viewport: { width: 1280, height: 800 },
    args: ['--no-sandbox', '--disable-quic', '--no-first-run', '--disable-background-networking', '--disable-component-update', '--disable-sync', '--use-angle=swiftshader',
           '--enable-unsafe-swiftshader', '--ignore-gpu-blocklist'],
    ...options,
  });
  context.setDefaultTimeout(20000);
  await context.exposeFunction('reportFault', (fault) => faults.push(fault));
  await context.addInitScript(() => {
    addEventListener('securitypolicyviolation', (event) => window.reportFault(`policy: ${event.violatedDirective} ${event.blockedURI}`));
    addEventListener('error', (event) => window.reportFault(`error: ${event.message}`));
    addEventListener('unhandledrejection', (event) => window.reportFault(`rejection: ${event.reason}`));
  });
  const close = context.close.bind(context);
  context.close = async () => {
    await close();
    rmSync(profile, { recursive: true, force: true });
  };
  return context;
}

/** Opens an address and waits until lice are seen. */
export async function shown(page, address, name = 'ann', patience = 30000) {
  await page.addInitScript((kept) => { try { localStorage.setItem('woodlouse-name', kept); localStorage.setItem('woodlouse-lesson', 'had'); } catch { /* no page yet */ } }, name);
  await page.goto(address);
  await until(page, () => window.woodlouse?.source?.lice?.length > 0, patience);
}

/** Asks within the page until it is so. (Playwright's own way evaluates text there, which the page's policy forbids.) */
export async function until(page, ask, patience = 20000) {
  const begun = Date.now();
  for (;;) {
    try { if (await page.evaluate(ask)) return; } catch (error) { if (!/context was destroyed|navigation/i.test(String(error))) throw error; }
    if (Date.now() - begun > patience) throw new Error(`not within ${patience} ms: ${ask}`);
    await page.waitForTimeout(50);
  }
}

/** What the page knows, asked within it. */
export const known = (page, ask) => page.evaluate(ask);
