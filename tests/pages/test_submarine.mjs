// The submarine's desk as a pilot uses it. In real time, or some times as fast; this wants a machine that has little else to do. Exit code 77: jarol was
// built without the page.
import assert from 'node:assert/strict';
import {execFileSync} from 'node:child_process';
import {mkdtempSync, rmSync} from 'node:fs';
import {tmpdir} from 'node:os';
import {join} from 'node:path';
import {after, test} from 'node:test';
import {Browser} from './browser.mjs';
import {Console, digestIn, endAll, leaveOutWithoutPage, start} from './watched_run.mjs';

const jarol = process.env.JAROL_COMMAND;
const vehicles = process.env.JAROL_VEHICLES === '1' ? {} : {skip: 'built without vehicles'};

await leaveOutWithoutPage();

const folder = mkdtempSync(join(tmpdir(), 'jarol_console_'));
const flags = ['--disable-gpu', '--enable-unsafe-swiftshader'];
// a page behind another one of its browser is not drawn, and who is hidden does not command: each pilot has one of their own
const [browser, second] = [new Browser({flags}), new Browser({flags})];
after(async () => {
  endAll();
  await browser.close();
  await second.close();
  rmSync(folder, {recursive: true, force: true});
});

const command = (text) => `document.querySelector('[aria-label=command]').textContent.startsWith(${JSON.stringify(text)})`;
const state = (text) => `document.querySelector('[aria-label=state]')?.textContent.startsWith(${JSON.stringify(text)})`;
const row = (name) => `Number([...document.querySelectorAll('#panel-instruments tr')].find((r) => r.cells[0].textContent === '${name}').cells[1].textContent)`;

// A run that is recorded, so many times as fast as the sea.
async function atDesk(name, pace) {
  const file = join(folder, name + '.mcap');
  const run = start('run', 'specs/exolauv.yaml', '--profile', 'desk', '--console', '--pace', String(pace), '--record', file);
  return {run, shown: await open(browser, await run.url), file};
}
// With the map in place of the three dimensions, which a processor draws slowly.
async function open(by, url) {
  const shown = await Console.open(by, url);
  await shown.press('Map');
  await shown.page.until(state('at rest'));
  return shown;
}
async function take(shown) {
  await shown.press('Take command');
  await shown.page.until(command('You command'));
}
// The toolbar has a speed, too.
async function dial(shown, name, value) {
  await shown.page.evaluate(`(() => {
    const dial = [...document.querySelectorAll('.desk label')].find((l) => l.textContent.trim().startsWith('${name}')).querySelector('input');
    dial.value = '${value}';
    dial.dispatchEvent(new Event('input', {bubbles: true}));
  })()`);
  await shown.page.settle();
}
async function steer(shown, {depth, heading, speed}) {
  await dial(shown, 'depth', depth);
  await dial(shown, 'heading', heading);
  await dial(shown, 'speed', speed);
  await shown.press('Autopilot …');
  assert.ok(await shown.page.evaluate(state('at rest')), 'one press does not start it');
  await shown.press('Autopilot: confirm');
  await shown.page.until(state('on autopilot'));
}

test('a pilot dives it by the autopilot, turns it by a key, steers by hand, and stops it; the recording replays', vehicles, async () => {
  const {run, shown, file} = await atDesk('steered', 4);
  await take(shown);
  await steer(shown, {depth: 2, heading: 90, speed: 1.2});
  await shown.page.until(`Math.abs(${row('depth')} - 2) < 0.1 && Math.abs(${row('heading')} - 90) < 3`);
  await shown.page.send('Input.dispatchKeyEvent', {type: 'keyDown', code: 'KeyD', key: 'd'});
  await shown.page.until(`${row('heading')} > 110`);
  await shown.page.send('Input.dispatchKeyEvent', {type: 'keyUp', code: 'KeyD', key: 'd'});
  await shown.press('By hand …');
  await shown.press('By hand: confirm');
  await shown.page.until(state('by hand'));
  // its propeller is let go
  await shown.page.until(`${row('speed')} < 0.8`);
  await shown.page.send('Input.dispatchKeyEvent', {type: 'keyDown', code: 'KeyW', key: 'w'});
  await shown.page.until(`${row('speed')} > 1`);
  await shown.page.send('Input.dispatchKeyEvent', {type: 'keyUp', code: 'KeyW', key: 'w'});
  await shown.page.until(`${row('speed')} < 0.8`);
  await shown.press('Stop');
  await shown.page.until(state('at rest'));
  await shown.press('Release');
  await shown.page.until(command('Nobody commands: it was released'));
  await shown.page.until(`${row('depth')} < 0.3`);
  await shown.close();
  const {code, output} = await run.stop();
  assert.equal(code, 130);
  assert.equal(digestIn(execFileSync(jarol, ['replay', file], {encoding: 'utf8'})), digestIn(output));
});

test('an abort is one act, of the pilot or of who finds nobody at the desk, and it comes up', vehicles, async () => {
  const {run, shown} = await atDesk('aborted', 4);
  await take(shown);
  await steer(shown, {depth: 1.5, heading: 0, speed: 1});
  await shown.page.until(`${row('depth')} > 1`);
  await shown.press('Abort');
  await shown.page.until(state('aborted'));
  await shown.page.until(state('at rest'));
  await shown.page.until(`${row('depth')} < 0.3 && ${row('speed')} < 0.1`);
  await steer(shown, {depth: 1.5, heading: 0, speed: 1});
  await shown.press('Release');
  await shown.page.until(command('Nobody commands: it was released'));
  await shown.press('Abort');
  await shown.page.until(state('aborted'));
  await shown.page.until(command('You command'));
  await shown.page.until(state('at rest'));
  await shown.close();
  await run.stop();
});
