// The operator's desk as a pilot uses it. In real time: a page that is not drawn within a second is a pilot who is silent, so
// this wants a machine that has little else to do. Exit code 77: jarol was built without the page.
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

// A pilot's page of the helicopter; its run is recorded, and goes at half its time so that a busy machine keeps up.
async function atDesk(record, options = {}) {
  const run = start('run', 'specs/javiator.yaml', '--profile', 'desk', '--console', '--pace', '0.5', '--record', record);
  const shown = await Console.open(browser, await run.url, options);
  await shown.page.until(`document.querySelector('[aria-label=state]')?.textContent === 'halt'`);
  return {run, shown};
}
const command = (text) => `document.querySelector('[aria-label=command]').textContent.replace(/\\s+/g, ' ').startsWith(${JSON.stringify(text)})`;
const flight = (text) => `document.querySelector('[aria-label=state]').textContent.startsWith(${JSON.stringify(text)})`;
const near = (value, goal, within) => `Math.abs(${value} - ${goal}) < ${within}`;
const row = (name) => `Number([...document.querySelectorAll('#panel-instruments tr')].find((r) => r.cells[0].textContent === '${name}').cells[1].textContent)`;

async function takeOff(shown) {
  await shown.press('Take command');
  await shown.page.until(command('You command'));
  await shown.press('Arm …');
  assert.equal(await shown.text('[aria-label=state]'), 'halt', 'one press does not arm');
  await shown.press('Arm: confirm');
  await shown.page.until(flight('ground'));
  await shown.press('Take off');
  await shown.page.until(flight('flying'));
  await shown.page.until(near(row('altitude'), 1, 0.1));
}

test('a pilot takes off, leans it by the keyboard, holds a position, flies one metre north, turns by 90 degrees and lands; the recording replays', vehicles, async () => {
  const file = join(folder, 'flown.mcap');
  const {run, shown} = await atDesk(file);
  await takeOff(shown);
  // by hand, to the right: as long as the key is held
  await shown.page.send('Input.dispatchKeyEvent', {type: 'keyDown', code: 'ArrowRight', key: 'ArrowRight'});
  await shown.page.until(`${row('roll')} > 3`);
  await shown.page.send('Input.dispatchKeyEvent', {type: 'keyUp', code: 'ArrowRight', key: 'ArrowRight'});
  await shown.page.until(`Math.abs(${row('roll')}) < 3`);
  await shown.press('Hold position');
  await shown.page.until(`document.querySelector('.desk [aria-pressed=true]') !== null`);
  const from = (await shown.row('north'))[0];
  await shown.page.send('Input.dispatchKeyEvent', {type: 'keyDown', code: 'ArrowUp', key: 'ArrowUp'});
  await shown.page.until(`Number(/to (-?[0-9.]+) m N/.exec(document.querySelector('.desk').textContent)[1]) >= ${from + 1}`);
  await shown.page.send('Input.dispatchKeyEvent', {type: 'keyUp', code: 'ArrowUp', key: 'ArrowUp'});
  const goal = Number(/to (-?[0-9.]+) m N/.exec(await shown.text('.desk'))[1]);
  assert.ok(goal < from + 2, `${goal} after ${from} m`);
  await shown.page.until(near(row('north'), goal, 0.1));
  await shown.choose('yaw', '90');
  await shown.page.until(`Math.abs(${row('heading')} - 90) < 3`);
  await shown.page.until(near(row('north'), goal, 0.15));
  await shown.press('Land');
  await shown.page.until(flight('ground'));
  assert.equal(await shown.text('[aria-label=state]'), 'ground', 'nothing went wrong');
  await shown.press('Shut down …');
  await shown.press('Shut down: confirm');
  await shown.page.until(flight('halt'));
  await shown.press('Release');
  await shown.page.until(command('Nobody commands: it was released'));
  await shown.close();
  const {code, output} = await run.stop();
  assert.equal(code, 130);
  assert.equal(digestIn(execFileSync(jarol, ['replay', file], {encoding: 'utf8'})), digestIn(output));
});

test('who looks elsewhere with a key held commands no more, and it lands by itself; the next pilot takes over', vehicles, async () => {
  const {run, shown} = await atDesk(join(folder, 'blurred.mcap'));
  const other = await Console.open(second, await run.url);
  await takeOff(shown);
  await other.page.until(command('Another page commands'));
  assert.ok(await other.page.evaluate(`[...document.querySelectorAll('.desk button')].every((b) => b.disabled)`), 'who watches steers nothing');
  await shown.page.send('Input.dispatchKeyEvent', {type: 'keyDown', code: 'ArrowRight', key: 'ArrowRight'});
  await shown.page.evaluate(`window.dispatchEvent(new Event('blur'))`);
  await shown.page.until(command('Nobody commands: it was released'));
  await other.page.until(flight('landing: operator lost'));
  await other.page.until(flight('ground: operator lost'));
  // what stands on the ground for a reason is acknowledged first
  await other.press('Take command');
  await other.page.until(command('You command'));
  await other.press('Acknowledge');
  await other.page.until(`document.querySelector('[aria-label=state]').textContent === 'ground'`);
  await other.close();
  await shown.close();
  await run.stop();
});

test('a page that is closed in flight, or freezes, does not keep the command, and it is said why', vehicles, async () => {
  // one that is closed may have time to say so itself
  for (const [how, why] of [['closed', ''], ['frozen', 'the page that commanded was silent']]) {
    const {run, shown} = await atDesk(join(folder, how + '.mcap'));
    const other = await Console.open(second, await run.url);
    await takeOff(shown);
    if (how === 'closed') await shown.page.close();
    else void shown.page.evaluate(`(() => { for (const end = performance.now() + 5000; performance.now() < end;); })()`);
    await other.page.until(command('Nobody commands: ' + why));
    await other.page.until(flight('ground: operator lost'));
    await other.close();
    await run.stop();
  }
});
