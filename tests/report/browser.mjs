// SPDX-License-Identifier: BSD-3-Clause
// Headless Chromium over its debugging pipe, without packages: open a page, listen, evaluate, take pictures.
import { spawn } from 'node:child_process';
import { mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';

export async function launch(program) {
  const profile = mkdtempSync(join(tmpdir(), 'report-browser-'));
  const child = spawn(program, [
    '--headless=new', '--no-sandbox', '--disable-gpu', '--use-angle=swiftshader', '--enable-unsafe-swiftshader',
    '--disable-background-networking', '--disable-component-update', '--disable-sync', '--no-first-run',
    '--disable-dev-shm-usage', '--hide-scrollbars', '--remote-debugging-pipe', `--user-data-dir=${profile}`, 'about:blank',
  ], { stdio: ['ignore', 'ignore', 'ignore', 'pipe', 'pipe'] });
  const waiting = new Map(), listeners = [];
  let next = 0, rest = '', gone = false;
  child.on('exit', () => { gone = true; for (const { reject } of waiting.values()) reject(new Error('the browser has gone')); });
  child.stdio[3].on('error', () => {});
  child.stdio[4].setEncoding('utf8').on('data', (text) => {
    const messages = (rest + text).split('\0');
    rest = messages.pop();
    for (const message of messages.map((m) => JSON.parse(m))) {
      if (message.id === undefined) { for (const listen of listeners) listen(message.method, message.params); continue; }
      const { resolve, reject } = waiting.get(message.id);
      waiting.delete(message.id);
      if (message.error) reject(new Error(message.error.message)); else resolve(message.result);
    }
  });
  let sessionId;
  const send = (method, params = {}) => new Promise((resolve, reject) => {
    if (gone) { reject(new Error('the browser has gone')); return; }
    waiting.set(++next, { resolve, reject });
    child.stdio[3].write(JSON.stringify({ id: next, method, params, sessionId }) + '\0');
  });
  const { targetInfos } = await send('Target.getTargets');
  const page = targetInfos.find(({ type }) => type === 'page');
  ({ sessionId } = await send('Target.attachToTarget', { targetId: page.targetId, flatten: true }));
  for (const domain of ['Page', 'Runtime', 'Network', 'Log']) await send(`${domain}.enable`);

  const evaluate = async (expression) => {
    const { result, exceptionDetails } = await send('Runtime.evaluate', { expression, awaitPromise: true, returnByValue: true });
    if (exceptionDetails) throw new Error(exceptionDetails.exception?.description ?? exceptionDetails.text);
    return result.value;
  };
  const until = async (expression, seconds) => {
    for (const end = Date.now() + 1000 * seconds; Date.now() < end;) {
      if (await evaluate(expression)) return;
      await new Promise((resolve) => setTimeout(resolve, 200));
    }
    throw new Error(`still not so after ${seconds} s: ${expression}`);
  };
  return {
    send, evaluate, until, listen: (listener) => listeners.push(listener),
    async resize(width, height, dark) {
      await send('Emulation.setDeviceMetricsOverride', { width, height, deviceScaleFactor: 1, mobile: false });
      await send('Emulation.setEmulatedMedia', { features: [{ name: 'prefers-color-scheme', value: dark ? 'dark' : 'light' }] });
    },
    async close() {
      if (!gone) {
        const exit = new Promise((resolve) => child.on('exit', resolve));
        sessionId = undefined;
        await Promise.race([send('Browser.close').catch(() => {}), exit]);
        await Promise.race([exit, new Promise((resolve) => setTimeout(resolve, 5000))]);
        if (!gone) child.kill('SIGKILL');
      }
      rmSync(profile, { recursive: true, force: true, maxRetries: 5, retryDelay: 200 });
    },
  };
}
