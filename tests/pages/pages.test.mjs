// Pages as people open them: in Chromium without a window, by mouse and keys, narrow and wide, light and dark.
import assert from 'node:assert/strict';
import {execFileSync, spawnSync} from 'node:child_process';
import {mkdtempSync, readFileSync, rmSync, writeFileSync} from 'node:fs';
import {tmpdir} from 'node:os';
import {join} from 'node:path';
import {after, test} from 'node:test';
import {Signal} from '../../tools/drawing/pages/data.js';
import {Browser} from './browser.mjs';

const jarol = process.env.JAROL_COMMAND;
const vehicles = process.env.JAROL_VEHICLES === '1' ? {} : {skip: 'built without vehicles'};
const folder = mkdtempSync(join(tmpdir(), 'jarol_pages_'));
const browser = new Browser();
after(async () => {
  await browser.close();
  rmSync(folder, {recursive: true, force: true});
});

const run = (...words) => execFileSync(jarol, words, {encoding: 'utf8', maxBuffer: 1 << 30});
// also where the outcome is negative
const runAnyway = (...words) => spawnSync(jarol, words, {encoding: 'utf8', maxBuffer: 1 << 30}).stdout;
const at = (name) => join(folder, name);

function report(name, ...words) {
  runAnyway('run', ...words, '--record', at(name + '.mcap'));
  run('log', 'report', at(name + '.mcap'), '-o', at(name + '.html'));
  return at(name + '.html');
}

const dataOf = (page) => JSON.parse(readFileSync(page, 'utf8').match(/<script type="application\/json" id="data">(.*)<\/script>\n<script/)[1]);

// How many pixels of each canvas are in the colour of that name; with none, how many colours it has.
const drawn = (page, name = '') => page.evaluate(`(() => {
  const style = getComputedStyle(document.documentElement).getPropertyValue('--${name}').trim();
  const wanted = style.match(/../g) && style.slice(1).match(/../g)?.map((h) => parseInt(h, 16));
  return [...document.querySelectorAll('canvas')].map((canvas) => {
    const copy = Object.assign(document.createElement('canvas'), {width: canvas.width, height: canvas.height}).getContext('2d', {willReadFrequently: true});
    copy.drawImage(canvas, 0, 0);
    const {data} = copy.getImageData(0, 0, canvas.width, canvas.height);
    let found = 0;
    const colours = new Set();
    for (let i = 0; i < data.length; i += 4) {
      if (data[i + 3] === 0) continue;
      if (wanted && Math.abs(data[i] - wanted[0]) + Math.abs(data[i + 1] - wanted[1]) + Math.abs(data[i + 2] - wanted[2]) < 24) ++found;
      colours.add((data[i] << 16) | (data[i + 1] << 8) | data[i + 2]);
    }
    return wanted ? found : colours.size;
  });
})()`);

function silent(page, file) {
  assert.deepEqual(page.complaints, []);
  const asked = page.requests.filter((url) => !url.startsWith('data:'));
  assert.equal(asked.length, 1, asked.join('\n'));
  assert.ok(asked[0].startsWith('file:') && asked[0].endsWith(file.split('/').pop()));
}

const box = (page, selector) => page.evaluate(`(() => { const e = document.querySelector('${selector}'); e.scrollIntoView({block: 'center', behavior: 'instant'}); const b = e.getBoundingClientRect(); return [b.x, b.y, b.width, b.height]; })()`);
const shows = (page) => page.evaluate(`document.querySelector('#plots .shows').textContent`);

test('every number that is recorded is in the page, to the bit', () => {
  const page = report('counting', 'specs/counting.yaml', '--for', '2s');
  const data = dataOf(page);
  const [title, ...rows] = run('log', 'csv', at('counting.mcap')).trim().split('\n').map((line) => line.split(','));
  let compared = 0;
  data.signals.forEach((stated, i) => {
    const signal = new Signal(stated, data.topics, i).load();
    assert.equal(signal.thinned, false);
    const column = title.indexOf(stated.name.replace(/\.value$/, ''));
    assert.ok(column > 0, stated.name);
    const wanted = rows.filter((row) => row[column] !== '').map((row) => [Number(row[0]), Number(row[column])]);
    assert.deepEqual([...signal.times].map((t, k) => [t, signal.low[k]]), wanted);
    compared += wanted.length;
  });
  assert.equal(compared, data.topics.reduce((all, topic) => all + topic.messages, 0));
  assert.ok(compared > 500);
});

test('of a large recording the page has the least and the greatest of each piece of time, and says so', async () => {
  writeFileSync(at('large.yaml'), 'graph: large\ntasks:\n  a: {type: Counter, period: 1ms}\n');
  const file = report('large', at('large.yaml'), '--for', '10s');
  const data = dataOf(file);
  const signal = new Signal(data.signals[0], data.topics, 0).load();
  assert.equal(signal.thinned, true);
  const piece = data.topics[0].piece_ns;
  const rows = run('log', 'csv', at('large.mcap')).trim().split('\n').slice(1).map((line) => line.split(',').map(Number));
  assert.equal(rows.length, 10_000);
  const low = new Map(), high = new Map();
  for (const [t, value] of rows) {
    const i = Math.floor(Math.round(t * 1e9) / piece);
    low.set(i, Math.min(low.get(i) ?? Infinity, value));
    high.set(i, Math.max(high.get(i) ?? -Infinity, value));
  }
  for (const [i, min] of low) assert.deepEqual([signal.low[i], signal.high[i]], [min, high.get(i)]);
  assert.equal(data.signals[0].max, 9999);
  const page = await browser.open(file);
  assert.match(await page.evaluate(`document.querySelector('#plots .lead').textContent`), /^Of 1 output with more than 4,096 values the page has the least and the greatest of each 4\.883 ms/);
  silent(page, file);
  await page.close();
});

test('a name of the recording is text in the page, and no markup', async () => {
  writeFileSync(at('name.yaml'), 'graph: "</script><script>alert(1)</script><b>"\ntasks:\n  a: {type: Counter, period: 100ms}\n');
  const file = report('name', at('name.yaml'), '--for', '1s');
  const page = await browser.open(file);
  assert.equal(await page.evaluate(`document.querySelector('h1').textContent`), '</script><script>alert(1)</script><b>');
  assert.equal(await page.evaluate(`document.querySelectorAll('script').length`), 2);
  silent(page, file);
  await page.close();
});

test('no script and no style that somebody adds to the page is obeyed', async () => {
  const file = report('policy', 'specs/counting.yaml', '--for', '1s');
  writeFileSync(at('changed.html'), readFileSync(file, 'utf8').replace('</body>', '<script>window.added = 1</script><img src="https://example.org/x.png"></body>'));
  const page = await browser.open(at('changed.html'));
  assert.equal(await page.evaluate('window.added'), undefined);
  assert.ok(page.complaints.some((line) => line.includes('script-src')));
  assert.ok(page.complaints.some((line) => line.includes('img-src')));
  await page.close();
});

test('faults are listed, counted and marked, and what a recording lacks is said', async () => {
  writeFileSync(at('faulty.yaml'), `graph: faulty
fault_limit: 100%
tasks:
  a: {type: Counter, period: 10ms}
  w: {type: Window, period: 10ms, let: 5ms, heap: 96B, on_fault: hold, parameters: {length: 100}}
connections: [a.out -> w.in]
`);
  const file = report('faulty', at('faulty.yaml'), '--for', '200ms');
  const data = dataOf(file);
  assert.ok(data.summary.end.faults > 3);
  assert.equal(data.happenings.events.length, data.summary.end.faults);
  assert.equal(data.happenings.faults_of.w, data.summary.end.faults);
  const page = await browser.open(file);
  assert.equal(await page.evaluate(`document.querySelectorAll('#events tbody tr').length`), data.summary.end.faults);
  assert.ok((await drawn(page, 'fault')).some((pixels) => pixels > 40), 'faults are marked');
  await page.evaluate(`document.querySelector('#events button.link').click()`);
  assert.notEqual(await shows(page), '0.00 to 0.20 s');
  silent(page, file);
  await page.close();
  runAnyway('run', 'specs/counting.yaml', '--for', '1s', '--log', at('inputs.mcap'));
  run('log', 'report', at('inputs.mcap'), '-o', at('inputs.html'));
  const lacking = await browser.open(at('inputs.html'));
  assert.match(await lacking.evaluate(`document.querySelector('#plots .nothing').textContent`), /^No published values are in this recording/);
  silent(lacking, at('inputs.html'));
  await lacking.close();
});

test('the report of a dive draws graph, time lines, plots and path, and answers mouse and keys', vehicles, async () => {
  const file = report('dive', 'specs/exolauv.yaml');
  const data = dataOf(file);
  assert.equal(data.replay.evidence, 'same');
  assert.equal(data.summary.end.digest, run('log', 'info', at('dive.mcap')).match(/digest +(\S+)/)[1]);
  assert.equal(data.summary.run_command, 'jarol run specs/exolauv.yaml --seed 0');
  const page = await browser.open(file);
  const canvases = await drawn(page);
  assert.equal(canvases.length, 2 + 3 + 1, 'two time lines, three plots, a path');
  for (const colours of canvases) assert.ok(colours > 10, canvases.join());
  for (const pixels of (await drawn(page, 'series-0')).slice(2, 5)) assert.ok(pixels > 300, 'a commanded signal is drawn');
  for (const pixels of (await drawn(page, 'series-1')).slice(2, 5)) assert.ok(pixels > 300, 'what it reached is drawn');
  assert.equal(await page.evaluate(`document.querySelectorAll('.graph .node.task').length`), 9);
  // one layout for all
  const svg = run('graph', 'specs/exolauv.yaml', '--svg');
  assert.equal(svg.split('<g class="node').length - 1, await page.evaluate(`document.querySelectorAll('.graph .node').length`));
  assert.equal(svg.match(/viewBox="0 0 ([0-9]+)/)[1], data.drawing.width.toFixed(0));
  assert.equal(await page.evaluate(`document.querySelectorAll('#tasks tbody tr').length`), 9);

  // dragging across a plot comes closer, and all plots with it; a key shows all again
  assert.equal(await shows(page), '0 to 100 s');
  const [x, y, width] = await box(page, '.plot canvas');
  await page.drag([x + width * 0.3, y + 80], [x + width * 0.5, y + 80]);
  const close = await shows(page);
  assert.match(close, /^2\d\.\d to 4\d\.\d s$|^2\d\.\d+ to [45]\d\.\d+ s$/);
  await page.evaluate(`document.querySelector('.plot canvas').focus()`);
  await page.key('ArrowRight');
  assert.notEqual(await shows(page), close);
  await page.key('0');
  assert.equal(await shows(page), '0 to 100 s');

  // a signal that is ticked comes to the plot, one that is taken out leaves it
  const legend = () => page.evaluate(`[...document.querySelectorAll('.plot .legend')].map((l) => l.querySelectorAll('.name').length)`);
  const before = await legend();
  await page.evaluate(`(() => { const i = document.querySelector('.signals input[type=search]'); i.value = 'speed.thrust'; i.dispatchEvent(new Event('input')); [...document.querySelectorAll('.signals li')].find((l) => !l.hidden).querySelector('input').click(); })()`);
  assert.deepEqual(await legend(), [before[0] + 1, ...before.slice(1)]);
  await page.evaluate(`document.querySelector('.plot .legend li:last-child button').click()`);
  assert.deepEqual(await legend(), before);
  // and one that is dragged to another plot
  await page.evaluate(`(() => { const t = new DataTransfer(); [...document.querySelectorAll('.signals li')].find((l) => !l.hidden).dispatchEvent(new DragEvent('dragstart', {dataTransfer: t})); document.querySelectorAll('.plot')[1].dispatchEvent(new DragEvent('drop', {dataTransfer: t, bubbles: true})); })()`);
  assert.deepEqual(await legend(), [before[0], before[1] + 1, ...before.slice(2)]);

  // the path is turned
  const path = async () => (await page.picture('#path canvas')).toString('base64');
  const aslant = await path();
  const [px, py, pw, ph] = await box(page, '#path canvas');
  await page.drag([px + pw / 2, py + ph / 2], [px + pw / 2 + 120, py + ph / 2 + 40]);
  await page.mouse('mouseMoved', 2, 2);
  await page.settle();
  assert.notEqual(await path(), aslant);
  silent(page, file);
  await page.close();
});

test('pages are as wide as the window, light or dark as the browser is', vehicles, async () => {
  const papers = new Set(), files = [report('flight', 'specs/javiator.yaml'), campaignPage()];
  for (const [width, scheme] of [[1280, 'light'], [1280, 'dark'], [400, 'light'], [400, 'dark']]) {
    for (const file of files) {
      const page = await browser.open(file, {width, scheme, touch: width < 600});
      assert.equal(await page.evaluate('document.documentElement.scrollWidth'), width);
      for (const colours of await drawn(page)) assert.ok(colours > 4);
      papers.add(await page.evaluate('getComputedStyle(document.body).backgroundColor'));
      silent(page, file);
      await page.close();
    }
  }
  assert.equal(papers.size, 2);
});

function campaignPage() {
  runAnyway('campaign', 'specs/exolauv.yaml', '--set', 'expect=nothing', '--vary', 'tasks.depth.parameters.kp=0.1..0.9', '--runs', '6',
    '--metric', 'deepest=max(depth of dune) < 3.22', '--metric', 'at_end=depth of dune', '--results', at('c.sqlite'), '--csv', at('c.csv'), '--report', at('c.html'));
  return at('c.html');
}

test('the page of a campaign has each run, its histograms count all, and its commands repeat', vehicles, async () => {
  const file = campaignPage(), data = dataOf(file);
  const [title, ...rows] = readFileSync(at('c.csv'), 'utf8').trim().split('\n').map((line) => line.split(','));
  const values = (base64) => { const bytes = Buffer.from(base64, 'base64'); return Array.from({length: bytes.length / 8}, (_, i) => bytes.readDoubleLE(8 * i)); };
  data.report.metrics.forEach((metric, i) => {
    const column = title.indexOf(metric.name);
    assert.deepEqual(values(data.metrics[i].values), rows.map((row) => Number(row[column])));
    const {good, others} = data.metrics[i].histogram;
    assert.equal(good.reduce((a, b) => a + b), data.report.outcomes.good);
    assert.equal(others.reduce((a, b) => a + b), 6 - data.report.outcomes.good);
  });
  assert.deepEqual(data.metrics.map((metric) => metric.limits), [[3.22], []]);
  assert.deepEqual(values(data.vary[0].values).map(String), rows.map((row) => String(Number(row[title.indexOf('tasks.depth.parameters.kp')]))));
  assert.ok(data.report.outcomes.good > 0 && data.report.outcomes.good < 6, 'some are good, some are not');
  const page = await browser.open(file);
  const canvases = await drawn(page, 'series-1');
  assert.equal(canvases.length, 4, 'two histograms, two scatter plots');
  assert.ok(canvases[0] > 100 && canvases[2] > 20, 'the limit and runs beyond it');
  assert.ok((await drawn(page, 'series-0')).every((pixels) => pixels > 20));
  assert.equal(await page.evaluate(`document.querySelector('#cases code').textContent`), data.report.metrics[0].worst.command);
  silent(page, file);
  await page.close();
});

test('the page of a shard says whose runs it has, in how many a metric has a value, and which run is bad without', async () => {
  runAnyway('campaign', 'specs/counting.yaml', '--for', '1s', '--vary', 'tasks.slow.let=[5ms, 15ms]', '--vary', 'seed=1..6', '--shard', '2/3',
    '--metric', 'high=time of sum.out > 10000 before 1s', '--results', at('shard.sqlite'), '--report', at('shard.html'));
  const file = at('shard.html'), page = await browser.open(file);
  const text = (selector) => page.evaluate(`[...document.querySelectorAll('${selector}')].map((e) => e.textContent)`);
  assert.equal((await text('.figure'))[0], '4runs of shard 2/3 of 12');
  assert.ok((await text('#summary p')).includes('high has a value in 2 of 4 runs; its numbers are of those.'));
  const cases = await text('#cases li p');
  assert.deepEqual(cases.slice(0, 3).map((line) => line.split(' ')[0]), ['min', 'max', 'bad']);
  assert.equal(cases[2], 'bad without a value of high run 6, the first of 2 such runs');
  assert.ok((await text('#cases code'))[2].startsWith('jarol run specs/counting.yaml --set tasks.slow.let=15ms --seed 1 --for 1s'));
  silent(page, file);
  await page.close();
});
