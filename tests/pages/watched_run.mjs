// A run that is watched on its page: jarol serves it, Chromium shows it.
import assert from 'node:assert/strict';
import {spawn} from 'node:child_process';

const running = new Set();

/** Ends what a test that failed has left. */
export function endAll() {
  for (const child of running) child.kill('SIGKILL');
}

/** Starts jarol with these words; `url` is there once it has said where the page is. */
export function start(...words) {
  const child = spawn(process.env.JAROL_COMMAND, words, {stdio: ['ignore', 'pipe', 'pipe']});
  running.add(child);
  child.on('exit', () => running.delete(child));
  let output = '', errors = '';
  child.stdout.on('data', (data) => (output += data));
  const url = new Promise((resolve, reject) => {
    child.stderr.on('data', (data) => {
      errors += data;
      const found = /console: (\S+)\n/.exec(errors);
      if (found) resolve(found[1]);
    });
    child.on('exit', () => reject(new Error(`jarol has ended: ${errors}`)));
  });
  url.catch(() => {});
  const ended = new Promise((resolve) => child.on('close', (code) => resolve({code, output, errors})));
  return {child, url, ended, stop: () => { child.kill('SIGINT'); return ended; }};
}

/** Ends the test where jarol was built without the page of the console. */
export async function leaveOutWithoutPage() {
  const run = start('run', 'specs/counting.yaml', '--console', '--for', '1h');
  const page = await (await fetch(await run.url)).text();
  await run.stop();
  if (!page.includes('was not built')) return;
  console.log('left out: jarol was built without the page of the console');
  process.exit(77);
}

/** Of pages that pilots have: of those who command, and whoever does not see a page does not, each needs a browser. */
export const pilotFlags = ['--disable-gpu', '--enable-unsafe-swiftshader'];

// What comes to be true at a desk, for `until`: who commands, what the vehicle does, a number of the instruments.
const begins = (selector, text) => `document.querySelector('${selector}')?.textContent.replace(/\\s+/g, ' ').trim().startsWith(${JSON.stringify(text)})`;
export const command = (text) => begins('[aria-label=command]', text);
export const state = (text) => begins('[aria-label=state]', text);
export const row = (name) => `Number([...document.querySelectorAll('#panel-instruments tr')].find((r) => r.cells[0].textContent === '${name}').cells[1].textContent)`;

/** In the report of a run. */
export const digestIn = (text) => /digest\s+(0x\w+)/.exec(text)[1];

/** What the tests look for in a page, by what people see. */
export class Console {
  constructor(page, url) {
    Object.assign(this, {page, url});
  }

  static async open(browser, url, options = {}) {
    return new Console(await browser.open(url, {width: 1280, height: 720, ...options}), url);
  }

  /** The instant that is looked at, in seconds. */
  seconds() {
    return this.page.evaluate(`(() => { const [m, s] = document.querySelector('header output').textContent.split(':'); return 60 * m + Number(s); })()`);
  }

  /** Until that instant is looked at. */
  reach(t) {
    const shown = `document.querySelector('header output')?.textContent`;
    return this.page.until(`(() => { const [m, s] = ${shown}?.split(':') ?? [0, 0]; return 60 * m + Number(s) >= ${t}; })()`, `${shown} ?? null`);
  }

  /** Until what the run does is called that. */
  state(text) {
    return this.page.until(`document.querySelector('[role=status]')?.textContent === ${JSON.stringify(text)}`);
  }

  /** Presses the button of that label or text, once it can be pressed. */
  async press(label) {
    const found = `[...document.querySelectorAll('button')].find((b) => (b.getAttribute('aria-label') ?? b.textContent.trim()) === ${JSON.stringify(label)})`;
    await this.page.until(`${found}?.disabled === false`);
    // two deliberate acts take their time
    if (label.endsWith(': confirm')) await new Promise((done) => setTimeout(done, 600));
    await this.page.evaluate(`${found}.id = 'pressed'`);
    await this.page.click('#pressed');
    await this.page.evaluate(`document.querySelector('#pressed')?.removeAttribute('id')`);
  }

  async choose(label, value) {
    await this.page.evaluate(`(() => {
      const e = document.querySelector('[aria-label="${label}"]') ?? [...document.querySelectorAll('label')].find((l) => l.textContent.trim().startsWith('${label}')).querySelector('select, input');
      e.value = ${JSON.stringify(value)};
      e.dispatchEvent(new Event(e.tagName === 'SELECT' ? 'change' : 'input', {bubbles: true}));
    })()`);
    await this.page.settle();
  }

  /** Until all of a recording is there, which its report follows. */
  all() {
    return this.page.until(`document.querySelector('[role=log]')?.textContent.includes('digest')`);
  }

  text(selector) {
    return this.page.evaluate(`document.querySelector(${JSON.stringify(selector)})?.innerText ?? ''`);
  }

  /** The numbers in the instruments' row of that name. */
  row(name) {
    return this.page.evaluate(`[...document.querySelectorAll('#panel-instruments tr')].find((r) => r.cells[0].textContent === '${name}') ?.innerText.split(/\\s+/).slice(1).map(Number) ?? []`);
  }

  /** Controls and pictures that a screen reader has no name for, or that no key leads to. */
  nameless() {
    return this.page.evaluate(`[...document.querySelectorAll('button, select, input, textarea, a, [role=button], [role=tab], [role=separator], [role=img], canvas')]
      .filter((e) => e.getClientRects().length > 0 && !e.closest('[aria-hidden=true]'))
      .flatMap((e) => {
        const name = e.getAttribute('aria-label') || e.innerText?.trim() || e.labels?.[0]?.innerText.trim() || e.title || e.getAttribute('placeholder');
        const isControl = !/^(img|canvas)$/i.test(e.getAttribute('role') ?? e.tagName);
        const isReached = !isControl || e.disabled || e.tabIndex >= 0 || e.getAttribute('role') === 'tab' || e.matches('.channel');
        return name && isReached ? [] : [e.outerHTML.slice(0, 120)];
      })`);
  }

  /** The browser complains of each connection that it can't have. */
  forgiveBreaks() {
    this.page.complaints = this.page.complaints.filter((text) => !/WebSocket connection to .* failed/.test(text));
  }

  /** Nothing is complained of, and nobody asked but jarol. */
  async close() {
    // that pictures are drawn by the processor is no fault of the page
    assert.deepEqual(this.page.complaints.filter((text) => !/GPU stall|KHR_parallel_shader_compile/.test(text)), []);
    const origin = new URL(this.url).origin;
    assert.deepEqual(this.page.requests.filter((to) => !to.startsWith(origin) && !/^(blob|data):/.test(to)), []);
    await this.page.close();
  }
}
