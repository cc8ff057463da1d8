// Takes pictures of the console and the editor, of both vehicles: take_console_pictures.mjs FOLDER [NAME ...], with JAROL_COMMAND
// and JAROL_CHROMIUM in the environment. Without names all views, light and dark, to be looked at; with names only pictures
// that begin so, smaller, for pages of text.
import {execFileSync} from 'node:child_process';
import {mkdirSync, mkdtempSync, rmSync, writeFileSync} from 'node:fs';
import {tmpdir} from 'node:os';
import {join} from 'node:path';
import {Browser} from './browser.mjs';
import {EditorPage} from './edited_graph.mjs';
import {Console, endAll, start} from './watched_run.mjs';

const [to, ...names] = process.argv.slice(2);
const wanted = (...all) => names.length === 0 || all.some((one) => names.some((name) => one.startsWith(name) || name.startsWith(one)));
mkdirSync(to, {recursive: true});
const folder = mkdtempSync(join(tmpdir(), 'jarol_pictures_'));
const browser = new Browser({flags: ['--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--font-render-hinting=none']});

async function picture(shown, name) {
  if (!wanted(name)) return;
  await shown.page.mouse('mouseMoved', 1, 1);
  // the three dimensions are drawn some time after the rest
  await shown.page.until(`[...document.querySelectorAll('.scene canvas')].every((canvas) => Math.abs(Number(canvas.dataset.instant) - document.querySelector('[aria-label="instant"]').valueAsNumber) < 0.2 && canvas.dataset.theme === document.documentElement.dataset.theme)`);
  await shown.page.settle();
  const [width, height] = await shown.page.evaluate('[innerWidth, innerHeight]');
  const clip = {x: 0, y: 0, width, height, scale: names.length > 0 ? 0.72 : 1};
  const {data} = await shown.page.send('Page.captureScreenshot', {format: 'png', clip});
  writeFileSync(join(to, name + '.png'), Buffer.from(data, 'base64'));
  console.log(name);
}
async function paint(shown, theme) {
  if ((await shown.page.evaluate('document.documentElement.dataset.theme')) === theme) return;
  await shown.press(`${theme} colours`);
}
const shows = (shown, view) => shown.page.evaluate(`document.querySelector('section[aria-label="${view}"]') !== null`);

// Where nothing moves any more: a run that has ended, looked at in the middle.
const recordings = {
  dive: {graph: 'specs/exolauv.yaml', words: [], at: 57},
  flight: {graph: 'specs/javiator.yaml', words: [], at: 21},
  sea: {graph: 'specs/exolauv.yaml', words: ['--profile', 'at_sea', '--seed', '1'], at: 40},
};
const views = ['3-D', 'Map', 'Graph', 'Time line', 'Parameters', 'Plots', 'Instruments', 'Events'];

for (const [name, {graph, words, at}] of Object.entries(recordings)) {
  if (!wanted(name)) continue;
  const file = join(folder, name + '.mcap');
  try {
    execFileSync(process.env.JAROL_COMMAND, ['run', graph, ...words, '--record', file], {stdio: 'ignore'});
  } catch {
    // its expectations may not hold in this sea
  }
  const run = start('console', file);
  const shown = await Console.open(browser, await run.url, {width: 1440, height: 860});
  await shown.state('recording');
  await shown.all();
  await shown.choose('instant', String(at));
  for (const theme of ['light', 'dark']) {
    await paint(shown, theme);
    await picture(shown, `${name}_${theme}`);
    for (const view of views) {
      const id = `${name}_${view.toLowerCase().replace(/[^a-z0-9]/g, '')}_${theme}`;
      if (!wanted(id)) continue;
      if (!(await shows(shown, view))) await shown.press(view);
      await shown.press(`${view}: all the room`);
      await picture(shown, id);
      await shown.press(`${view}: back to its place`);
      for (const first of ['3-D', 'Graph']) if (!(await shows(shown, first))) await shown.press(first);
    }
  }
  if (wanted(`${name}_tablet`, `${name}_small`)) {
    await paint(shown, 'light');
    for (const [size, width, height] of [['tablet', 820, 1180], ['small', 1280, 720]]) {
      await shown.page.send('Emulation.setDeviceMetricsOverride', {width, height, deviceScaleFactor: 1, mobile: false});
      await picture(shown, `${name}_${size}`);
    }
  }
  await shown.page.close();
  await run.stop();
}

// The desks: of the submarine with a plan on the map that is flown, of the helicopter in flight.
const desks = {
  desk_dive: {graph: 'specs/exolauv.yaml', pace: 5, drive: driveSubmarine},
  desk_flight: {graph: 'specs/javiator.yaml', pace: 0.5, drive: driveHelicopter},
};
const text = (selector, begin) => `document.querySelector('${selector}')?.textContent.trim().startsWith(${JSON.stringify(begin)})`;

async function driveSubmarine(shown) {
  await shown.press('Map');
  await shown.press('Take command');
  await shown.page.until(text('[aria-label=command]', 'You command'));
  await shown.press('Plan');
  await shown.press('Goto');
  const [left, top, width, height] = await shown.page.evaluate(`(() => { const b = document.querySelector('.map').getBoundingClientRect(); return [b.x, b.y, b.width, b.height]; })()`);
  for (const [x, y] of [[0.5, 0.2], [0.82, 0.28], [0.78, 0.7], [0.24, 0.62]]) {
    await shown.page.mouse('mouseMoved', left + width * x, top + height * y);
    await shown.page.mouse('mousePressed', left + width * x, top + height * y);
    await shown.page.mouse('mouseReleased', left + width * x, top + height * y);
    await shown.page.settle();
  }
  await shown.press('Send');
  await shown.page.until(`document.querySelector('[role=status][aria-label=plan]').textContent.includes('is loaded')`);
  await shown.press('Start …');
  await shown.press('Start: confirm');
  await shown.page.until(text('[aria-label=state]', 'plan '));
  await shown.reach((await shown.seconds()) + 100);
}
async function driveHelicopter(shown) {
  await shown.press('Take command');
  await shown.page.until(text('[aria-label=command]', 'You command'));
  await shown.press('Arm …');
  await shown.press('Arm: confirm');
  await shown.page.until(text('[aria-label=state]', 'ground'));
  await shown.press('Take off');
  await shown.page.until(text('[aria-label=state]', 'flying'));
  await shown.press('Hold position');
  await shown.reach((await shown.seconds()) + 6);
  await shown.page.send('Input.dispatchKeyEvent', {type: 'keyDown', code: 'ArrowUp', key: 'ArrowUp'});
  await shown.reach((await shown.seconds()) + 3);
}

for (const [name, {graph, pace, drive}] of Object.entries(desks)) {
  if (!wanted(name)) continue;
  const run = start('run', graph, '--profile', 'desk', '--console', '--pace', String(pace));
  const shown = await Console.open(browser, await run.url, {width: 1440, height: 860});
  await drive(shown);
  await shown.press('Pause');
  await shown.state('paused');
  for (const theme of ['light', 'dark']) {
    await paint(shown, theme);
    await picture(shown, `${name}_${theme}`);
  }
  await shown.page.close();
  await run.stop();
}

// The editor: as it opens, a task, and a graph that has no schedule.
for (const scheme of ['light', 'dark']) {
  if (!wanted(`edit_${scheme}`, `edit_task_${scheme}`, `edit_late_${scheme}`)) continue;
  const shown = await EditorPage.edit(browser, 'exolauv.yaml', {options: {scheme, width: 1440, height: 860}});
  await picture(shown, `edit_${scheme}`);
  await shown.choose_part('task depth');
  await picture(shown, `edit_task_${scheme}`);
  await shown.choose_part('task speed');
  await shown.fill('wcet', '60ms');
  await shown.says('not schedulable');
  await shown.page.until(`!!document.querySelector('.suggestion button')`);
  await picture(shown, `edit_late_${scheme}`);
  await shown.page.close();
  await shown.run.stop();
}

endAll();
await browser.close();
rmSync(folder, {recursive: true, force: true});
