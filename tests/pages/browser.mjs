// Chromium without a window, by its DevTools protocol over pipes: opens a page, and keeps what it complains of and what
// it asks the network for.
import {spawn} from 'node:child_process';
import {mkdtempSync, rmSync} from 'node:fs';
import {tmpdir} from 'node:os';
import {join, resolve} from 'node:path';
import {pathToFileURL} from 'node:url';

export class Browser {
  /** `flags`: of Chromium; as it is, it draws without WebGL. */
  constructor({program = process.env.JAROL_CHROMIUM ?? 'chromium', flags = ['--disable-gpu']} = {}) {
    this.folder = mkdtempSync(join(tmpdir(), 'jarol_page_'));
    this.process = spawn(program, ['--headless', '--no-sandbox', ...flags, '--disable-dev-shm-usage', '--hide-scrollbars',
      '--force-color-profile=srgb', '--no-first-run', '--remote-debugging-pipe', '--user-data-dir=' + this.folder, 'about:blank'],
      {stdio: ['ignore', 'ignore', 'ignore', 'pipe', 'pipe']});
    this.asked = new Map();
    this.last = 0;
    this.watchers = [];
    let text = '';
    this.process.stdio[4].setEncoding('utf8').on('data', (piece) => {
      text += piece;
      for (let end; (end = text.indexOf('\0')) >= 0; text = text.slice(end + 1)) this.take(JSON.parse(text.slice(0, end)));
    });
    this.process.on('exit', (code) => {
      for (const {reject} of this.asked.values()) reject(new Error(`${program} ended with ${code}`));
    });
    this.process.on('error', (error) => {
      for (const {reject} of this.asked.values()) reject(error);
    });
  }

  take(message) {
    const asked = this.asked.get(message.id);
    if (asked) {
      this.asked.delete(message.id);
      if (message.error) asked.reject(new Error(message.error.message)); else asked.resolve(message.result);
    }
    for (const watch of this.watchers) watch(message);
  }

  send(method, params = {}, sessionId = undefined) {
    const id = ++this.last;
    return new Promise((resolve, reject) => {
      this.asked.set(id, {resolve, reject});
      this.process.stdio[3].write(JSON.stringify({id, method, params, sessionId}) + '\0');
    });
  }

  /** A page of that width, in that of 'light' and 'dark': a file, or an address. */
  async open(place, {width = 1280, height = 900, scheme = 'light', touch = false} = {}) {
    const {targetId} = await this.send('Target.createTarget', {url: 'about:blank'});
    const {sessionId} = await this.send('Target.attachToTarget', {targetId, flatten: true});
    const page = new Page(this, sessionId, targetId);
    for (const domain of ['Page', 'Runtime', 'Log', 'Network']) await page.send(domain + '.enable');
    await page.send('Emulation.setDeviceMetricsOverride', {width, height, deviceScaleFactor: 1, mobile: touch});
    await page.send('Emulation.setTouchEmulationEnabled', {enabled: touch});
    await page.send('Emulation.setEmulatedMedia', {features: [{name: 'prefers-color-scheme', value: scheme}, {name: 'prefers-reduced-motion', value: 'reduce'}]});
    const loaded = page.event('Page.loadEventFired');
    await page.send('Page.navigate', {url: place.startsWith('http:') ? place : pathToFileURL(resolve(place)).href});
    await loaded;
    await page.settle();
    return page;
  }

  async close() {
    await this.send('Browser.close').catch(() => {});
    await new Promise((ended) => this.process.exitCode === null ? this.process.on('exit', ended) : ended());
    rmSync(this.folder, {recursive: true, force: true});
  }
}

class Page {
  constructor(browser, session, target) {
    Object.assign(this, {browser, session, target, complaints: [], requests: []});
    browser.watchers.push(({method, params, sessionId}) => {
      if (sessionId !== session) return;
      if (method === 'Runtime.exceptionThrown') this.complaints.push(params.exceptionDetails.exception?.description ?? params.exceptionDetails.text);
      if (method === 'Runtime.consoleAPICalled') this.complaints.push('console: ' + params.args.map((a) => a.value ?? a.description).join(' '));
      if (method === 'Log.entryAdded') this.complaints.push('log: ' + params.entry.text);
      if (method === 'Network.requestWillBeSent') this.requests.push(params.request.url);
    });
  }

  send(method, params) { return this.browser.send(method, params, this.session); }

  event(name) {
    return new Promise((resolve) => {
      const watch = ({method, sessionId}) => {
        if (method !== name || sessionId !== this.session) return;
        this.browser.watchers.splice(this.browser.watchers.indexOf(watch), 1);
        resolve();
      };
      this.browser.watchers.push(watch);
    });
  }

  /** What an expression comes to in the page. */
  async evaluate(expression) {
    const {result, exceptionDetails} = await this.send('Runtime.evaluate', {expression, awaitPromise: true, returnByValue: true});
    if (exceptionDetails) throw new Error(exceptionDetails.exception?.description ?? exceptionDetails.text);
    return result.value;
  }

  /** Until what was asked for is drawn. */
  settle() { return this.evaluate('new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => requestAnimationFrame(() => done(true)))))'); }

  /**
   * Until an expression comes to anything true in the page, which is what it comes to. What does not within two minutes never
   * will, unless `progress`, another expression, has changed meanwhile: then the machine is slow.
   */
  async until(expression, progress = null) {
    let last = null;
    for (let end = Date.now() + 120_000; ; ) {
      const value = await this.evaluate(expression);
      if (value) return value;
      const now = progress && await this.evaluate(progress);
      if (now !== last) end = Date.now() + 120_000;
      last = now;
      if (Date.now() > end) throw new Error(`it did not come to be: ${expression}; the page shows: ${await this.evaluate('document.body.innerText.slice(0, 2000)')}`);
      await this.settle();
    }
  }

  /** By the mouse, at the middle of what is found. */
  async click(selector) {
    const [x, y] = await this.evaluate(`(() => { const e = document.querySelector(${JSON.stringify(selector)}); e.scrollIntoView({block: 'nearest'}); const b = e.getBoundingClientRect(); return [b.x + b.width / 2, b.y + b.height / 2]; })()`);
    await this.mouse('mouseMoved', x, y);
    await this.mouse('mousePressed', x, y);
    await this.mouse('mouseReleased', x, y);
    await this.settle();
  }

  async mouse(type, x, y, more = {}) {
    await this.send('Input.dispatchMouseEvent', {type, x, y, button: type === 'mouseMoved' && !more.buttons ? 'none' : 'left', clickCount: type === 'mouseMoved' ? 0 : 1, ...more});
  }

  async drag(from, to) {
    await this.mouse('mouseMoved', ...from);
    await this.mouse('mousePressed', ...from);
    for (let i = 1; i <= 4; ++i) await this.mouse('mouseMoved', from[0] + (to[0] - from[0]) * i / 4, from[1] + (to[1] - from[1]) * i / 4, {buttons: 1, button: 'left'});
    await this.mouse('mouseReleased', ...to);
    await this.settle();
  }

  async key(key) {
    // by their codes Tab goes on, Enter presses
    const code = {Tab: {windowsVirtualKeyCode: 9}, Enter: {windowsVirtualKeyCode: 13, text: '\r'}}[key];
    await this.send('Input.dispatchKeyEvent', {type: 'keyDown', key, ...code});
    await this.send('Input.dispatchKeyEvent', {type: 'keyUp', key, ...code, text: undefined});
    await this.settle();
  }

  /** PNG; the whole page, or an element's box. */
  async picture(selector = null) {
    const clip = await this.evaluate(selector === null
      ? '({x: 0, y: 0, width: document.documentElement.scrollWidth, height: document.documentElement.scrollHeight, scale: 1})'
      : `(() => { const b = document.querySelector(${JSON.stringify(selector)}).getBoundingClientRect(); return {x: b.x + scrollX, y: b.y + scrollY, width: b.width, height: b.height, scale: 1}; })()`);
    const {data} = await this.send('Page.captureScreenshot', {format: 'png', captureBeyondViewport: true, clip});
    return Buffer.from(data, 'base64');
  }

  close() { return this.browser.send('Target.closeTarget', {targetId: this.target}); }
}
