// The submarine's desk as a pilot uses it: steered, along a plan that is drawn on the map, and when something goes wrong
// there. In real time, or some times as fast; this wants a machine that has little else to do. Exit code 77: jarol was
// built without the page.
import assert from 'node:assert/strict';
import {execFileSync} from 'node:child_process';
import {mkdtempSync, rmSync} from 'node:fs';
import {connect, createServer} from 'node:net';
import {tmpdir} from 'node:os';
import {join} from 'node:path';
import {after, test} from 'node:test';
import {Browser} from './browser.mjs';
import {command, Console, digestIn, endAll, leaveOutWithoutPage, pilotFlags, row, start, state} from './watched_run.mjs';

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

const plan = (text) => `document.querySelector('[role=status][aria-label=plan]').textContent.includes(${JSON.stringify(text)})`;
const said = (text) => `document.querySelector('[role=log]').textContent.includes(${JSON.stringify(text)})`;

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

// Presses on the map at places, in metres north and east, as the map says where the pointer is.
async function pressOnMap(shown, spots) {
  const [left, top, width, height] = await shown.page.evaluate(`(() => { const b = document.querySelector('.map').getBoundingClientRect(); return [b.x, b.y, b.width, b.height]; })()`);
  const under = async (x, y) => {
    await shown.page.mouse('mouseMoved', x, y);
    await shown.page.settle();
    return (await shown.text('.legend')).match(/(-?[0-9.]+) m N, (-?[0-9.]+) m E/).slice(1).map(Number);
  };
  const [x0, y0, x1, y1] = [left + 60, top + 60, left + width - 60, top + height - 60];
  const [[n0, e0], [n1, e1]] = [await under(x0, y0), await under(x1, y1)];
  for (const [north, east] of spots) {
    const [x, y] = [x0 + (x1 - x0) * (east - e0) / (e1 - e0), y0 + (y1 - y0) * (north - n0) / (n1 - n0)];
    await shown.page.mouse('mouseMoved', x, y);
    await shown.page.mouse('mousePressed', x, y);
    await shown.page.mouse('mouseReleased', x, y);
    await shown.page.settle();
  }
}
const square = [[60, 0], [60, 60], [0, 60], [0, 0]];
async function draw(shown, spots) {
  await shown.press('Plan');
  await shown.press('Goto');
  await pressOnMap(shown, spots);
  const drawn = await shown.page.evaluate(`[...document.querySelectorAll('.plan li button')].map((b) => b.innerText.replace(/\\s+/g, ' '))`);
  assert.deepEqual(drawn, spots.map(([n, e], i) => `Goto ${i + 1} ${n} N ${e} E, 3.0 m, 1.2 m/s`));
}
async function startPlan(shown) {
  await shown.press('Send');
  await shown.page.until(plan('is loaded'));
  await shown.press('Start …');
  assert.ok(await shown.page.evaluate(state('at rest')), 'one press does not start it');
  await shown.press('Start: confirm');
  await shown.page.until(state('plan '));
}

// The true way in a recording: rows of seconds, north, east, depth.
function trueWay(file) {
  const [head, ...rows] = execFileSync(jarol, ['log', 'csv', file, '--topic', 'jarol/truth/dune'], {encoding: 'utf8', maxBuffer: 1e9}).trim().split('\n').map((line) => line.split(','));
  const columns = ['time', 'x', 'y', 'depth'].map((name) => head.findIndex((one) => one === name || one.endsWith('.' + name)));
  assert.ok(columns.every((at) => at >= 0), head.join());
  return rows.map((cells) => columns.map((at) => Number(cells[at])));
}

test('a pilot draws a square of 60 m on the map, and it is flown with a cross-track error below 1 m after each turn, at its depth, and up again; the recording replays', vehicles, async (t) => {
  const {run, shown, file} = await atDesk('planned', 10);
  await take(shown);
  await draw(shown, square);
  await shown.press('Surface');
  await shown.choose('name of the plan', 'square');
  await startPlan(shown);
  await shown.page.until(state('plan square: Goto 2'));
  await shown.page.until(`Math.abs(parseFloat(document.querySelector('[aria-label="cross-track error"]')?.textContent)) < 1`);
  await shown.page.until(state('at rest'));
  assert.ok(await shown.page.evaluate(`${said("plan 'square' begins")} && ${said("plan 'square' is done")}`));
  await shown.page.until(`${row('depth')} < 0.3`);
  await shown.close();
  const {output} = await run.stop();
  assert.equal(digestIn(execFileSync(jarol, ['replay', file], {encoding: 'utf8'})), digestIn(output));
  // it turns on a circle of 9.6 m: from 15 m after a corner to 12 m before the next one it is on the line
  const way = trueWay(file);
  const corners = [[0, 0], ...square];
  let from = 0;
  for (let leg = 1; leg < corners.length; ++leg) {
    const [[n0, e0], [n1, e1]] = [corners[leg - 1], corners[leg]];
    const [north, east] = [(n1 - n0) / 60, (e1 - e0) / 60];
    const places = way.slice(from).map(([, n, e, depth], i) => ({i, along: (n - n0) * north + (e - e0) * east, across: (e - e0) * north - (n - n0) * east, depth}));
    const first = places.findIndex(({along, across}) => along >= 15 && along < 16 && Math.abs(across) < 5);
    assert.ok(first >= 0, `it comes to line ${leg}`);
    const last = places.findIndex(({i, along}) => i > first && along >= 48);
    assert.ok(last > first, `it goes along line ${leg}`);
    const on = places.slice(first, last);
    const worst = Math.max(...on.map(({across}) => Math.abs(across)));
    t.diagnostic(`line ${leg}: at most ${worst.toFixed(3)} m beside it`);
    assert.ok(worst < 1, `${worst} m beside line ${leg}`);
    const deepest = Math.max(...on.map(({depth}) => Math.abs(depth - 3)));
    if (leg > 1) assert.ok(deepest < 0.2, `${deepest} m from its depth on line ${leg}`);
    from += last;
  }
});

test('a plan goes on without a pilot; another page sees it, hears from the vehicle where it goes, and aborts it in one act', vehicles, async () => {
  const {run, shown} = await atDesk('left', 5);
  const other = await open(second, await run.url);
  await take(shown);
  await draw(shown, square);
  await startPlan(shown);
  await shown.page.close();
  await other.page.until(command('Nobody commands: '));
  assert.equal(await other.page.evaluate(`document.querySelectorAll('.map .loaded .place').length`), 4, 'what the vehicle has is on the map');
  // longer than any patience with an operator
  const at = await other.seconds();
  await other.reach(at + 15);
  assert.ok(await other.page.evaluate(state('plan plan: Goto 1')));
  await other.page.until(`${row('depth')} > 2`);
  await other.press('Abort');
  await other.page.until(state('aborted'));
  await other.page.until(said("plan 'plan' ends: stopped"));
  await other.page.until(`${row('depth')} < 0.3`);
  await other.close();
  await run.stop();
});

test('a plan that can\'t be flown is not sent, and it is said why; one that is flown can be stopped', vehicles, async () => {
  const {run, shown} = await atDesk('refused', 5);
  await take(shown);
  await draw(shown, square.slice(0, 2));
  const dialled = async (name, value) => {
    await shown.choose(name, value);
    await shown.page.settle();
  };
  const canSend = `!([...document.querySelectorAll('button')].find((b) => b.textContent === 'Send').disabled)`;
  assert.ok(await shown.page.evaluate(canSend));
  await dialled('depth', '20');
  assert.ok(!(await shown.page.evaluate(canSend)));
  assert.match(await shown.text('.plan .form'), /depth from 0 to 11 m/);
  await dialled('depth', '3');
  await shown.press('Send');
  await shown.page.until(plan('is loaded'));
  await shown.press('Start …');
  await shown.press('Start: confirm');
  await shown.page.until(state('plan plan: Goto 1'));
  await shown.press('Stop');
  await shown.page.until(state('at rest'));
  await shown.close();
  await run.stop();
});

// A way to the page that can be cut without a word.
async function cuttable(url) {
  const to = new URL(url), port = Number(to.port);
  let cut = false;
  const server = createServer((from) => {
    const onward = connect(port, to.hostname);
    for (const [one, other] of [[from, onward], [onward, from]]) {
      one.on('data', (data) => cut || other.write(data));
      one.on('end', () => cut || other.end());
      one.on('error', () => {});
    }
  });
  await new Promise((listens) => server.listen(0, '127.0.0.1', listens));
  to.port = String(server.address().port);
  return {url: to.href, cut: () => (cut = true), close: () => server.close()};
}

// How the pilot is lost; what that does; what is said of it then.
const losses = {
  'looks elsewhere with a key held': {does: ({shown}) => shown.page.evaluate(`window.dispatchEvent(new Event('blur'))`), why: 'it was released'},
  // one that is closed may have time to say so itself
  'closes the page': {does: ({shown}) => shown.page.close(), why: ''},
  'has a page that is frozen for 5 s': {does: ({shown}) => void shown.page.evaluate(`(() => { for (const end = performance.now() + 5000; performance.now() < end;); })()`), why: 'the page that commanded was silent'},
  'is cut off': {does: ({way}) => way.cut(), why: 'the page that commanded was silent'},
};
for (const [how, {does, why}] of Object.entries(losses))
  test(`a pilot who ${how} commands no more: it comes up, the run goes on in time, and the next pilot takes over`, vehicles, async () => {
    const pace = 2;
    const file = join(folder, how.replaceAll(' ', '_') + '.mcap');
    const run = start('run', 'specs/exolauv.yaml', '--profile', 'desk', '--console', '--pace', String(pace), '--record', file);
    const way = await cuttable(await run.url);
    const shown = await open(browser, way.url);
    const other = await open(second, await run.url);
    await take(shown);
    await other.page.until(command('Another page commands neptus'));
    assert.ok(await other.page.evaluate(`[...document.querySelectorAll('.desk .who button, .desk .acts button, .desk input')].every((b) => b.disabled)`), 'who watches steers nothing');
    await steer(shown, {depth: 1.5, heading: 0, speed: 1});
    await other.page.until(`${row('depth')} > 1`);
    await shown.page.send('Input.dispatchKeyEvent', {type: 'keyDown', code: 'KeyD', key: 'd'});
    const [begun, at] = [performance.now(), await other.seconds()];
    await does({shown, way});
    await other.page.until(command('Nobody commands: ' + why));
    await other.page.until(state('comes up: operator lost'));
    await new Promise((done) => setTimeout(done, Math.max(0, 5000 - (performance.now() - begun))));
    const [passed, went] = [(performance.now() - begun) / 1000, (await other.seconds()) - at];
    assert.ok(Math.abs(went / pace / passed - 1) < 0.1, `${went} s of the run in ${passed} s`);
    if (how.startsWith('has a page')) await shown.page.until(command('Nobody commands: ' + why));
    if (how === 'is cut off') await shown.page.until(command('Nothing comes from jarol any more'));
    await other.page.until(`${row('depth')} < 0.3`);
    await take(other);
    await other.press('Acknowledge');
    await other.page.until(state('at rest'));
    await other.press('Release');
    await other.close();
    if (how !== 'closes the page') await shown.page.close();
    way.close();
    const {output} = await run.stop();
    assert.equal(digestIn(execFileSync(jarol, ['replay', file], {encoding: 'utf8'})), digestIn(output));
  });

test('an abort is one act, of the pilot or of who finds nobody at the desk, and it comes up', vehicles, async () => {
  const {run, shown} = await atDesk('aborted', 4);
  await take(shown);
  await steer(shown, {depth: 1.5, heading: 0, speed: 1});
  await shown.page.until(`${row('depth')} > 1`);
  // wherever the focus is
  await shown.page.evaluate(`document.querySelector('.desk [aria-label=depth], .desk input').focus()`);
  await shown.page.key('Escape');
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
