// A graph that is edited on its page: jarol serves it, Chromium shows it.
import assert from 'node:assert/strict';
import {cpSync, mkdtempSync, readFileSync, rmSync} from 'node:fs';
import {tmpdir} from 'node:os';
import {join} from 'node:path';
import {ForwardedPort} from './forwarded_port.mjs';
import {Console, start} from './watched_run.mjs';

/** The editor as people see it, of a copy of what stands in specs/. */
export class EditorPage extends Console {
  /** `name` as in 'exolauv.yaml'; `forwarded`: through a port that can be cut. */
  static async edit(browser, name, {options = {}, words = [], forwarded = false} = {}) {
    const folder = join(mkdtempSync(join(tmpdir(), 'jarol_edit_')), 'specs');
    cpSync('specs', folder, {recursive: true, filter: (from) => !/specs\/(broken|pictures)/.test(from)});
    const file = join(folder, name);
    const run = start('edit', file, ...words);
    const port = forwarded ? await ForwardedPort.to(await run.url) : undefined;
    const url = port?.url ?? await run.url;
    const shown = new EditorPage(await browser.open(url, {width: 1280, height: 720, ...options}), url);
    Object.assign(shown, {folder, file, run, forwarded: port});
    await shown.page.until(`document.querySelector('textarea')?.value.length > 0`);
    await shown.judged();
    return shown;
  }

  async end() {
    await this.close();
    await this.forwarded?.cut();
    assert.equal((await this.run.stop()).code, 130);
    rmSync(join(this.folder, '..'), {recursive: true, force: true});
  }

  onDisk() { return readFileSync(this.file, 'utf8'); }
  /** Until that is on the disk. */
  async disk(text) {
    for (const end = Date.now() + 120_000; this.onDisk() !== text; await new Promise((done) => setTimeout(done, 20)))
      assert.ok(Date.now() < end, `on the disk stands ${this.onDisk()}`);
  }
  source() { return this.page.evaluate(`document.querySelector('textarea').value`); }
  verdict() { return this.text('[aria-label=verdict]'); }

  /** Until what loader and check say is of the text as it is. */
  judged() { return this.page.until(`!!document.querySelector('[aria-label=verdict]:not(.old)') && !!document.querySelector('svg:not(.old)')`); }

  async says(verdict) {
    await this.page.until(`document.querySelector('[aria-label=verdict]:not(.old)')?.textContent === ${JSON.stringify(verdict)}`);
  }

  /** Chooses a node of the drawing, as in 'task depth', as the keyboard does. */
  async choose_part(label) {
    await this.page.until(`!!document.querySelector('[aria-label^="${label},"]')`);
    await this.page.evaluate(`document.querySelector('[aria-label^="${label},"]').focus()`);
    await this.page.key('Enter');
  }

  /** Writes into a field of the form, or of a dialog. */
  async fill(label, value, within = 'section[aria-label=Form]') {
    await this.page.evaluate(`(() => {
      const field = document.querySelector(${JSON.stringify(`${within} input[aria-label="${label}"], ${within} select[aria-label="${label}"]`)});
      field.focus();
      field.value = ${JSON.stringify(value)};
      field.dispatchEvent(new Event('input', {bubbles: true}));
      field.dispatchEvent(new Event('change', {bubbles: true}));
    })()`);
    await this.page.settle();
  }

  /** By hand, in the text. */
  async rewrite(text) {
    await this.page.evaluate(`(() => {
      const area = document.querySelector('textarea');
      area.value = ${JSON.stringify(text)};
      area.dispatchEvent(new Event('input', {bubbles: true}));
    })()`);
    await this.page.settle();
    await this.judged();
  }

  async control(key) {
    for (const type of ['keyDown', 'keyUp']) await this.page.send('Input.dispatchKeyEvent', {type, key, code: `Key${key.toUpperCase()}`, modifiers: 2});
    await this.page.settle();
  }

  /** The middle of a node, or of what its handle is, on the screen. */
  place(label, part = 'rect') {
    return this.page.evaluate(`(() => { const b = document.querySelector('[aria-label^="${label},"] ${part}').getBoundingClientRect(); return [b.x + b.width / 2, b.y + b.height / 2]; })()`);
  }
}
