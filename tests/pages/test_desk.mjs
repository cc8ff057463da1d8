// The operator's desk as a pilot uses it. In real time: a page that is not drawn within a second is a pilot who is silent, so
// this wants a machine that has little else to do. Exit code 77: jarol was built without the page.
import assert from 'node:assert/strict';
import {execFileSync} from 'node:child_process';
import {mkdtempSync, rmSync} from 'node:fs';
import {tmpdir} from 'node:os';
import {join} from 'node:path';
import {after, test} from 'node:test';
import {Browser} from './browser.mjs';
import {ForwardedPort} from './forwarded_port.mjs';
import {command, Console, digestIn, endAll, leaveOutWithoutPage, pilotFlags, row, start, state} from './watched_run.mjs';
import {Watcher} from './watcher.mjs';

const jarol = process.env.JAROL_COMMAND;
const vehicles = process.env.JAROL_VEHICLES === '1' ? {} : {skip: 'built without vehicles'};

await leaveOutWithoutPage();

const folder = mkdtempSync(join(tmpdir(), 'jarol_console_'));
// a page behind another one of its browser is not drawn, and who is hidden does not command: each pilot has one of their own
const [browser, second] = [new Browser({flags: pilotFlags}), new Browser({flags: pilotFlags})];
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
const near = (value, goal, within) => `Math.abs(${value} - ${goal}) < ${within}`;

async function takeOff(shown) {
  // the first key that is pressed on the page finds the way
  await shown.page.evaluate(`document.activeElement.blur()`);
  await shown.page.key('Tab');
  await shown.page.until(`document.activeElement.textContent === 'To the desk'`);
  await shown.page.key('Enter');
  await shown.page.until(`document.activeElement.textContent === 'Take command'`);
  await shown.page.key('Enter');
  await shown.page.until(command('You command'));
  await shown.press('Arm …');
  assert.equal(await shown.text('[aria-label=state]'), 'halt', 'one press does not arm');
  await shown.press('Arm: confirm');
  await shown.page.until(state('ground'));
  await shown.press('Take off');
  await shown.page.until(state('flying'));
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
  await shown.page.until(`Math.abs(${row('yaw')} - 90) < 3`);
  await shown.page.until(near(row('north'), goal, 0.15));
  await shown.page.key('Escape');
  await shown.page.until(state('landing'));
  await shown.page.until(state('ground'));
  assert.equal(await shown.text('[aria-label=state]'), 'ground', 'nothing went wrong');
  await shown.press('Shut down …');
  await shown.press('Shut down: confirm');
  await shown.page.until(state('halt'));
  await shown.press('Release');
  await shown.page.until(command('Nobody commands: it was released'));
  await shown.close();
  const {code, output} = await run.stop();
  assert.equal(code, 130);
  assert.equal(digestIn(execFileSync(jarol, ['replay', file], {encoding: 'utf8'})), digestIn(output));
});

test('a press that is doubled or held does what one does, Escape lands from a list of the header too, and who looks back is told so', vehicles, async () => {
  const {run, shown} = await atDesk(join(folder, 'doubled.mcap'));
  const button = (begin) => `[...document.querySelectorAll('.desk button')].find((b) => b.textContent.startsWith('${begin}'))`;
  await shown.press('Take command');
  await shown.page.until(command('You command'));
  await shown.page.until(`${button('Arm')}.disabled === false`);
  await shown.page.evaluate(`${button('Arm')}.click(), ${button('Arm')}.click()`);
  await shown.page.settle();
  assert.equal(await shown.page.evaluate(`${button('Arm')}.textContent`), 'Arm: confirm', 'a double click is one act');
  await shown.press('Arm: confirm');
  await shown.page.until(state('ground'));
  await shown.page.evaluate(`${button('Shut down')}.focus()`);
  const enter = {type: 'keyDown', key: 'Enter', windowsVirtualKeyCode: 13, text: '\r'};
  await shown.page.send('Input.dispatchKeyEvent', enter);
  for (let i = 0; i < 10; ++i) {
    await new Promise((done) => setTimeout(done, 60));
    await shown.page.send('Input.dispatchKeyEvent', {...enter, autoRepeat: true});
  }
  await shown.page.send('Input.dispatchKeyEvent', {...enter, type: 'keyUp', text: undefined});
  await shown.page.settle();
  assert.equal(await shown.page.evaluate(`${button('Shut down')}.textContent`), 'Shut down: confirm', 'a key that is held is one act');
  assert.equal(await shown.text('[aria-label=state]'), 'ground');
  await shown.press('Take off');
  await shown.page.until(state('starting'));
  await shown.page.key('Escape');
  await shown.page.key('Escape');
  await shown.page.until(state('ground'));
  const stopped = await shown.seconds();
  await shown.reach(stopped + 4);
  assert.equal(await shown.text('[aria-label=state]'), 'ground', 'the second press has started nothing');
  await shown.press('Take off');
  await shown.page.until(state('flying'));
  await shown.choose('instant', '1');
  await shown.state('looking back');
  await shown.press('Live');
  await shown.state('live');
  await shown.page.evaluate(`document.querySelector('header select').focus()`);
  await shown.page.key('Escape');
  await shown.page.until(state('landing'));
  await shown.close();
  await run.stop();
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
  await other.page.until(state('landing: operator lost'));
  await other.page.until(state('ground: operator lost'));
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
    await other.page.until(state('ground: operator lost'));
    await other.close();
    await run.stop();
  }
});

test('a pilot flies on while a hundred watch, one reads nothing, and others try what they may not; each is told, and the run goes on in time', vehicles, async (t) => {
  const file = join(folder, 'crowded.mcap');
  const {run, shown} = await atDesk(file);
  const url = await run.url;
  await takeOff(shown);
  const [begun, at] = [performance.now(), await shown.seconds()];
  const all = await Promise.all(Array.from({length: 100}, () => Watcher.open(url)));
  const slow = await Watcher.open(url, {reads: false});
  assert.ok(all.every(({status}) => status === 101));
  // what no page does
  const wrongToken = await Watcher.open(url.replace(/token=..../, 'token=0000'));
  const foreign = await Watcher.open(url, {origin: 'http://evil.example'});
  assert.deepEqual([wrongToken.status, foreign.status], [403, 403]);
  const stranger = await Watcher.open(url);
  const refused = async (text, why) => {
    delete stranger.newest.error;
    stranger.send(text);
    await stranger.until(({error}) => error !== undefined);
    assert.equal(stranger.newest.error, why);
  };
  const steer = (what, more = {}) => JSON.stringify({do: what, desk: 'terminal', as: 'a stranger', sticks: {roll: 0}, ...more});
  await refused('garbage \u0000 {', 'expected an object as in {"do": "pause"}');
  await refused(steer('take', {sticks: {roll: 0.4}}), "another page commands 'terminal'; it has to release it, or to fall silent");
  await refused(steer('take'), "another page commands 'terminal'; it has to release it, or to fall silent");
  await refused(steer('release'), "this page does not command 'terminal'; take it first");
  await refused(steer('send', {message: 'SHUT_DOWN', sequence: 1}), "this page does not command 'terminal'; take it first");
  const bytes = await Watcher.open(url);
  bytes.sendBytes([255, 0, 1]);
  await bytes.closed;
  assert.deepEqual([bytes.closeCode, bytes.closeReason], [1008, 'expected text, got bytes']);
  const long = await Watcher.open(url);
  long.send('x'.repeat(10 << 20));
  await long.closed;
  const loud = await Watcher.open(url);
  for (let i = 0; i < 1000; ++i) loud.ask({do: 'alive', desk: 'terminal'});
  await loud.closed;
  const cut = await Watcher.open(url);
  cut.cut();
  // all see the same run, and who commands it
  await new Promise((done) => setTimeout(done, Math.max(0, 8000 - (performance.now() - begun))));
  const [passed, went] = [(performance.now() - begun) / 1000, (await shown.seconds()) - at];
  t.diagnostic(`${went.toFixed(2)} s of the run in ${passed.toFixed(2)} s`);
  assert.ok(Math.abs(went / 0.5 / passed - 1) < 0.1, `${went} s of the run in ${passed} s`);
  for (const watcher of all) await watcher.until(({now, desk}) => now > at + 2 && desk?.terminal.commander);
  assert.equal(new Set(all.map(({newest}) => newest.desk.terminal.commander)).size, 1);
  // it flies as before
  assert.ok(await shown.page.evaluate(command('You command')));
  assert.equal(await shown.text('[aria-label=state]'), 'flying');
  const [altitude] = await shown.row('altitude');
  assert.ok(Math.abs(altitude - 1) < 0.15, `${altitude} m`);
  // who has read nothing sees the newest
  slow.goOn();
  await slow.until(({now}) => now > at + 2);
  for (const watcher of [...all, slow, stranger]) watcher.cut();
  await shown.press('Land');
  await shown.page.until(state('ground'));
  assert.equal(await shown.text('[aria-label=state]'), 'ground', 'nothing went wrong');
  await shown.close();
  const {output} = await run.stop();
  assert.equal(digestIn(execFileSync(jarol, ['replay', file], {encoding: 'utf8'})), digestIn(output));
});

test('a page that commanded before the break does so no more: it sends nothing until command is taken anew', vehicles, async () => {
  const run = start('run', 'specs/javiator.yaml', '--profile', 'desk', '--console', '--for', '1h');
  const port = await ForwardedPort.to(await run.url);
  const shown = await Console.open(browser, port.url);
  let sent = [];
  browser.watchers.push(({method, params, sessionId}) => {
    if (sessionId === shown.page.session && method === 'Network.webSocketFrameSent') sent.push(JSON.parse(params.response.payloadData).do);
  });
  await shown.press('Take command');
  await shown.page.until(command('You command terminal'));
  await shown.reach(1);
  assert.ok(sent.includes('take') && sent.includes('send'), `${sent}`);
  await port.cut();
  await shown.page.until(command('Nothing comes from jarol any more'));
  const lost = await shown.seconds();
  sent = [];
  await port.mend();
  await shown.page.until(command('Nobody commands'));
  await shown.reach(lost + 2);
  assert.deepEqual(sent.filter((what) => what !== 'seen'), []);
  // what was before the break is there
  await shown.choose('instant', '0');
  assert.ok((await shown.seconds()) < 0.1);
  await shown.press('Live');
  await shown.press('Take command');
  await shown.page.until(command('You command terminal'));
  await run.stop();
  shown.forgiveBreaks();
  await shown.close();
  await port.cut();
});
