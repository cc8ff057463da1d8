// What the console costs and how long it takes, in a browser; not a test, for a machine that has nothing else to do:
//   measure_console.mjs frames [SECONDS]    a run of 200 tasks at 1 kHz, drawn: frames a second, and how late the run is
//   measure_console.mjs memory [MINUTES]    a dive at ten times real time: memory of page and server
//   measure_console.mjs opening [FILE]      24 hours recorded (in FILE, made where it is not there): until they are on the page
// with JAROL_COMMAND and JAROL_CHROMIUM in the environment. Exit code 1: a goal is not met.
import {execFileSync} from 'node:child_process';
import {existsSync, mkdtempSync, readFileSync, rmSync, statSync, writeFileSync} from 'node:fs';
import {tmpdir} from 'node:os';
import {join} from 'node:path';
import {Browser} from './browser.mjs';
import {Console, endAll, start} from './watched_run.mjs';

const [what, argument] = process.argv.slice(2);
const folder = mkdtempSync(join(tmpdir(), 'jarol_measure_'));
// a graph without a vehicle has nothing in three dimensions: painted by the browser itself, as where there is no graphics card
const browser = new Browser({flags: what === 'frames' ? ['--disable-gpu'] : ['--use-angle=swiftshader', '--enable-unsafe-swiftshader']});
let met = true;
function goal(text, is) {
  met &&= is;
  console.log(`${text}${is ? '' : '  NOT MET'}`);
}
const sleep = (ms) => new Promise((done) => setTimeout(done, ms));

// Layers of tasks with two inputs each, from any of the two layers above.
function meshed(layers, width) {
  let state = 1;
  const random = (below) => (state = (Math.imul(state, 1664525) + 1013904223) >>> 0, (state >>> 8) % below);
  const name = (layer, i) => `l${100 + layer}_${i}`;
  const [tasks, connections] = [[], []];
  for (let layer = 0; layer < layers; ++layer)
    for (let i = 0; i < width; ++i) {
      tasks.push(`  ${name(layer, i)}: {type: ${layer === 0 ? 'Counter' : 'Sum'}, period: 1ms, on_fault: hold}`);
      if (layer === 0) continue;
      connections.push(`  - ${name(layer - 1, i)}.out -> ${name(layer, i)}.a`);
      connections.push(`  - ${name(Math.max(0, layer - 1 - random(2)), random(width))}.out -> ${name(layer, i)}.b`);
    }
  return `graph: meshed\ntasks:\n${tasks.join('\n')}\nconnections:\n${connections.join('\n')}\n`;
}

async function frames(seconds) {
  const file = join(folder, 'meshed.yaml');
  writeFileSync(file, meshed(20, 10));
  const begun = performance.now();
  execFileSync(process.env.JAROL_COMMAND, ['graph', file, '--svg'], {stdio: 'ignore'});
  const took = (performance.now() - begun) / 1000;
  goal(`a graph of 200 tasks is laid out and written in ${took.toFixed(2)} s; at most 3`, took <= 3);
  const run = start('run', file, '--clock', 'real', '--console', '--for', '1h');
  const shown = await Console.open(browser, await run.url, {width: 1440, height: 860});
  await shown.press('Graph: all the room');
  await shown.reach(2);
  const at = await shown.seconds();
  const {drawn, passed} = await shown.page.evaluate(`new Promise((done) => {
    let drawn = 0;
    const begun = performance.now();
    const next = () => {
      const passed = performance.now() - begun;
      if (passed > ${seconds * 1000}) done({drawn, passed: passed / 1000});
      ++drawn;
      requestAnimationFrame(next);
    };
    requestAnimationFrame(next);
  })`);
  const went = (await shown.seconds()) - at;
  goal(`${(drawn / passed).toFixed(1)} frames a second of ${await shown.page.evaluate(`document.querySelectorAll('.node').length`)} tasks; at least 30`, drawn / passed >= 30);
  console.log(`the page went ${went.toFixed(2)} s of the run in ${passed.toFixed(2)} s; ${(await shown.text('header')).match(/[0-9,]+ (thinned|messages missed)/g)?.join(', ') ?? 'nothing was left out'}`);
  const {output} = await run.stop();
  console.log(output.match(/lateness.*/)?.[0] ?? output);
}

async function memory(minutes) {
  const run = start('run', 'specs/exolauv.yaml', '--console', '--pace', '10', '--for', '1000h');
  const shown = await Console.open(browser, await run.url);
  const samples = [];
  const begun = performance.now();
  for (let i = 1; performance.now() - begun < minutes * 60_000; ++i) {
    await sleep(Math.max(0, begun + i * 10_000 - performance.now()));
    await shown.page.send('HeapProfiler.collectGarbage');
    const {usedSize} = await shown.page.send('Runtime.getHeapUsage');
    const server = Number(/VmRSS:\s+(\d+)/.exec(readFileSync(`/proc/${run.child.pid}/status`, 'utf8'))[1]) / 1024;
    samples.push([(await shown.seconds()) / 60, usedSize / 2 ** 20, server]);
    console.log(`${samples.at(-1)[0].toFixed(1)} min of the run: page ${samples.at(-1)[1].toFixed(1)} MB, server ${samples.at(-1)[2].toFixed(1)} MB`);
  }
  await run.stop();
  // in the last third both have what they may hold; what the page is about to let go is in some samples and not in others
  const third = Math.floor(samples.length / 3);
  const mean = (of, i) => of.reduce((sum, sample) => sum + sample[i], 0) / of.length;
  for (const [i, name] of [[1, 'page'], [2, 'server']]) {
    const [before, last] = [mean(samples.slice(-2 * third, -third), i), mean(samples.slice(-third), i)];
    const growth = last / before - 1;
    goal(`${name}: ${(100 * growth).toFixed(1)} % more in the last third than in the one before it, ${last.toFixed(1)} MB; at most 5 %`, growth <= 0.05);
  }
}

async function opening(file) {
  if (!existsSync(file)) {
    const begun = performance.now();
    try {
      execFileSync(process.env.JAROL_COMMAND, ['run', 'specs/exolauv.yaml', '--for', '24h', '--set', 'expect=nothing', '--record', file], {stdio: 'ignore'});
    } catch {
      // it comes up when nobody has been heard for long
    }
    console.log(`recorded 24 hours in ${((performance.now() - begun) / 1000).toFixed(1)} s, ${(statSync(file).size / 2 ** 20).toFixed(0)} MB`);
  }
  const begun = performance.now();
  const since = () => (performance.now() - begun) / 1000;
  const run = start('console', file);
  const url = await run.url;
  console.log(`its address is there after ${since().toFixed(2)} s`);
  const shown = await Console.open(browser, url, {width: 1440, height: 860});
  await shown.page.until(`Number(document.querySelector('[aria-label="instant"]')?.max) > 60`);
  goal(`it is open, with its first values, after ${since().toFixed(2)} s; at most 5`, since() <= 5);
  await shown.all();
  console.log(`all of it is there after ${since().toFixed(2)} s`);
  await shown.choose('instant', '43200');
  console.log(`at noon: depth ${(await shown.row('depth')).join(', true ')} m`);
  await run.stop();
}

if (what === 'frames') await frames(Number(argument ?? 10));
else if (what === 'memory') await memory(Number(argument ?? 60));
else if (what === 'opening') await opening(argument ?? join(folder, 'day.mcap'));
else {
  console.error('expected frames, memory or opening');
  met = false;
}
endAll();
await browser.close();
rmSync(folder, {recursive: true, force: true});
process.exit(met ? 0 : 1);
