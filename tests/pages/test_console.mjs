// The console's page as people see it: jarol serves a run, Chromium without a window shows it. Exit code 77: jarol was built
// without the page.
import assert from 'node:assert/strict';
import {execFileSync} from 'node:child_process';
import {mkdtempSync, rmSync} from 'node:fs';
import {tmpdir} from 'node:os';
import {join} from 'node:path';
import {after, test} from 'node:test';
import {Browser} from './browser.mjs';
import {command, Console, digestIn, endAll, leaveOutWithoutPage, start} from './watched_run.mjs';
import {Watcher} from './watcher.mjs';

const jarol = process.env.JAROL_COMMAND;
const vehicles = process.env.JAROL_VEHICLES === '1' ? {} : {skip: 'built without vehicles'};
const panels = ['3-D', 'Graph', 'Plots', 'Instruments', 'Events'];

await leaveOutWithoutPage();

const folder = mkdtempSync(join(tmpdir(), 'jarol_console_'));
const browser = new Browser({flags: ['--disable-gpu', '--enable-unsafe-swiftshader']});
after(async () => {
  endAll();
  await browser.close();
  rmSync(folder, {recursive: true, force: true});
});

// Something, and nothing above it.
const isPaintedBelow = (task) => `(() => {
  const node = document.querySelector('[aria-label^="task ${task},"] rect').getBoundingClientRect();
  const canvas = document.querySelector('#panel-graph canvas'), at = canvas.getBoundingClientRect();
  const fine = canvas.width / at.width, tall = node.height / 5;
  const read = new OffscreenCanvas(canvas.width, canvas.height).getContext('2d', {willReadFrequently: true});
  read.drawImage(canvas, 0, 0);
  const painted = (y) => read.getImageData((node.left - at.left) * fine, (y - at.top) * fine, node.width * fine, tall * fine).data.some((v) => v > 0);
  return painted(node.bottom + 1) && !painted(node.top - tall - 1);
})()`;

test('a run of a graph without a vehicle is watched to its end, and the page has its digest', async () => {
  const run = start('run', 'specs/counting.yaml', '--console', '--for', '2s', '--pace', '0.001');
  const shown = await Console.open(browser, await run.url);
  await shown.state('live');
  await shown.choose('speed', 'max');
  await shown.state('ended');
  const {code, output} = await run.ended;
  assert.equal(code, 0);
  assert.equal(digestIn(await shown.text('[role=log]')), digestIn(output));
  assert.equal(await shown.page.evaluate(`document.querySelector('#panel-instruments, #panel-3d')`), null);
  // below a node stands its value, also where the drawing is enlarged and scrolled
  await shown.page.until(isPaintedBelow('count'));
  for (let i = 0; i < 4; ++i) await shown.press('larger');
  await shown.page.evaluate(`document.querySelector('[aria-label^="task count,"]').scrollIntoView({block: 'center', inline: 'center'})`);
  await shown.page.until(isPaintedBelow('count'));
  await shown.close();
});

test('a dive is paused, stepped by one instant, looked back at and gone on with to its end', vehicles, async () => {
  const dive = ['run', 'specs/exolauv.yaml', '--for', '400s'];  // for a slow machine there is time until it ends
  const run = start(...dive, '--console', '--pace', '2');
  const shown = await Console.open(browser, await run.url);
  for (const panel of panels) await shown.page.until(`document.querySelector('section[aria-label="${panel}"]') !== null`);
  await shown.reach(30);
  await shown.press('Pause');
  await shown.state('paused');
  const asleep = await shown.page.evaluate(`new Promise((done) => setTimeout(() => done(document.querySelector('header output').textContent), 300))`);
  assert.equal(await shown.text('header output'), asleep);
  const halted = await shown.seconds();
  await shown.press('Step');
  await shown.page.until(`document.querySelector('header output').textContent !== ${JSON.stringify(asleep)}`);
  assert.ok((await shown.seconds()) - halted < 0.06, 'a step is one instant');
  const [estimate, truth] = await shown.row('depth');
  assert.ok(Math.abs(estimate - 3) < 0.1 && Math.abs(truth - estimate) < 0.1, `${estimate} and ${truth} m`);
  // a task shows its values
  await shown.page.evaluate(`document.querySelector('[aria-label^="task depth"]').focus()`);
  await shown.page.key('Enter');
  assert.match(await shown.text('aside[aria-label="values of depth"]'), /moment\.angle/);
  // the slider looks back
  await shown.page.evaluate(`document.querySelector('[aria-label="instant"]').focus()`);
  await shown.choose('instant', '0');
  assert.ok((await shown.seconds()) < 0.1);
  assert.ok(Math.abs((await shown.row('depth'))[0]) < 0.1);
  await shown.press('Live');
  await shown.choose('signal to add', 'navigation.motion.u');
  await shown.page.until(`document.querySelector('[aria-label="plot of navigation.motion.u"] canvas') !== null`);
  await shown.choose('speed', 'max');
  await shown.press('Go on');
  await shown.state('ended');
  const {code, output} = await run.ended;
  assert.equal(code, 0);
  assert.equal(digestIn(await shown.text('[role=log]')), digestIn(output));
  assert.equal(digestIn(output), digestIn(execFileSync(jarol, dive, {encoding: 'utf8'})));
  await shown.close();
});

test('a flight is watched, also on a tablet, and its interruption is said', vehicles, async () => {
  const run = start('run', 'specs/javiator.yaml', '--console', '--for', '1h');
  const shown = await Console.open(browser, await run.url, {width: 820, height: 1180});
  await shown.reach(12);
  await shown.press('Pause');
  await shown.state('paused');
  await shown.choose('instant', '12');
  const [altitude] = await shown.row('altitude');
  assert.ok(altitude > 0.8 && altitude < 1.2, `${altitude} m`);
  assert.ok(await shown.page.evaluate(`document.documentElement.scrollWidth <= innerWidth`), 'nothing stands out at the side');
  assert.equal((await run.stop()).code, 130);
  await shown.page.until(`/ended|connection lost/.test(document.querySelector('[role=status]').textContent)`);
  await shown.close();
});

test('on a small screen and on a tablet a desk is seen whole, with sliders that a hand can set, the vehicle above it', vehicles, async () => {
  for (const spec of ['specs/javiator.yaml', 'specs/exolauv.yaml'])
    for (const options of [{width: 1280, height: 720}, {width: 940, height: 700}, {width: 820, height: 1180, touch: true}]) {
      const run = start('run', spec, '--profile', 'desk', '--console', '--for', '1h');
      const shown = await Console.open(browser, await run.url, options);
      const where = `${spec} at ${options.width} by ${options.height}`;
      await shown.page.until(`document.querySelector('#panel-desk input[type=range]') !== null`);
      const seen = JSON.parse(await shown.page.evaluate(`JSON.stringify({
        hidden: (({scrollHeight, clientHeight}) => scrollHeight - clientHeight)(document.querySelector('#panel-desk .body')),
        sliders: [...document.querySelectorAll('#panel-desk input[type=range]')].map((slider) => slider.clientWidth),
        bottoms: ['#panel-3d', '#panel-desk'].map((panel) => document.querySelector(panel).getBoundingClientRect().bottom)})`));
      assert.equal(seen.hidden, 0, where);
      assert.ok(seen.sliders.length >= 2 && Math.min(...seen.sliders) > 250, `${where}: ${seen.sliders}`);
      assert.ok(Math.max(...seen.bottoms) <= options.height, `${where}: ${seen.bottoms}`);
      await shown.page.until(`document.querySelector('section[aria-label=Plots] canvas') !== null`);
      assert.deepEqual(await shown.nameless(), [], where);
      await run.stop();
      await shown.close();
    }
});

test('while another page commands this one changes no pace, pauses and steps nothing, and shows why', vehicles, async () => {
  const run = start('run', 'specs/javiator.yaml', '--profile', 'desk', '--console', '--for', '1h');
  const shown = await Console.open(browser, await run.url);
  await shown.state('live');
  const pilot = await Watcher.open(await run.url);
  pilot.ask({do: 'take', desk: 'terminal', as: 'a pilot', sticks: {roll: 0}});
  const alive = setInterval(() => pilot.ask({do: 'alive', desk: 'terminal'}), 100);
  await shown.page.until(command('Another page commands'));
  const why = `document.querySelector('header [role=alert]')?.textContent === "another page commands 'terminal'; only a page that commands alone changes the pace, pauses and steps"`;
  await shown.choose('speed', 'max');
  await shown.page.until(why);
  assert.equal(await shown.page.evaluate(`document.querySelector('header .group select').value`), '1');
  await shown.press('Pause');
  await shown.page.until(why);
  await pilot.until(({error, paused, speed}) => error === undefined && !paused && speed === 1);
  clearInterval(alive);
  pilot.ask({do: 'release', desk: 'terminal'});
  await shown.page.until(command('Nobody commands'));
  await shown.press('Pause');
  await shown.state('paused');
  assert.equal(await shown.text('header [role=alert]'), '');
  pilot.cut();
  await run.stop();
  await shown.close();
});

test('a recording is looked at from its begin, at any instant, and played', vehicles, async () => {
  const file = join(folder, 'dive.mcap');
  execFileSync(jarol, ['run', 'specs/exolauv.yaml', '--record', file]);
  const run = start('console', file);
  const shown = await Console.open(browser, await run.url);
  await shown.state('recording');
  await shown.all();
  assert.ok(await shown.page.evaluate(`Number(document.querySelector('[aria-label="instant"]').max) > 99`));
  assert.equal(await shown.seconds(), 0);
  await shown.choose('instant', '60');
  assert.ok(Math.abs((await shown.row('depth'))[0] - 3) < 0.05);
  await shown.choose('speed of playing', '10');
  await shown.press('play from here');
  await shown.reach(62);
  await shown.press('halt');
  assert.equal((await run.stop()).code, 130);
  await shown.close();
});

test('a page with a wrong token says what to do', async () => {
  const run = start('run', 'specs/counting.yaml', '--console', '--for', '1h');
  const url = (await run.url).replace(/token=..../, 'token=0000');
  const shown = await Console.open(browser, url);
  assert.match(await shown.page.until(`document.querySelector('[role=alert]')?.innerText ?? ''`), /Open the address that jarol has printed/);
  await run.stop();
  await shown.page.close();
});
