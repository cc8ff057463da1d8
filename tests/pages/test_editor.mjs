// The editor's page as people use it: jarol serves a copy of a shipped graph, Chromium shows it. Exit code 77: jarol was built
// without the page.
import assert from 'node:assert/strict';
import {execFileSync} from 'node:child_process';
import {appendFileSync, chmodSync, mkdirSync, writeFileSync} from 'node:fs';
import {after, test} from 'node:test';
import {Browser} from './browser.mjs';
import {EditorPage} from './edited_graph.mjs';
import {endAll, leaveOutWithoutPage} from './watched_run.mjs';

const jarol = process.env.JAROL_COMMAND;
const vehicles = process.env.JAROL_VEHICLES === '1' ? {} : {skip: 'built without vehicles'};
const pictures = process.env.JAROL_PICTURES;

await leaveOutWithoutPage();

const browser = new Browser({flags: ['--disable-gpu']});
after(async () => {
  endAll();
  await browser.close();
});

async function picture(shown, name) {
  if (!pictures) return;
  mkdirSync(pictures, {recursive: true});
  writeFileSync(`${pictures}/${name}.png`, await shown.page.picture());
}
const drawn = (shown, label) => shown.page.until(`!!document.querySelector('[aria-label^="${label}"]')`);

test('each shipped graph is drawn, and has the verdict of check', vehicles, async () => {
  for (const name of ['exolauv', 'exolauv_bare', 'javiator', 'counting', 'window', 'passthrough']) {
    const shown = await EditorPage.edit(browser, `${name}.yaml`);
    const check = JSON.parse(execFileSync(jarol, ['check', '--json', `specs/${name}.yaml`], {encoding: 'utf8'}));
    await shown.says(check.verdict.replaceAll('_', ' '));
    const svg = execFileSync(jarol, ['graph', '--svg', `specs/${name}.yaml`], {encoding: 'utf8'});
    assert.equal(await shown.page.evaluate(`document.querySelectorAll('.node').length`), svg.split('<g class="node').length - 1);
    assert.equal(await shown.source(), shown.onDisk());
    await shown.end();
  }
});

test('a period is changed by the form: one word of the text changes, the verdict is there soon, undo gives the bytes back', vehicles, async () => {
  const shown = await EditorPage.edit(browser, 'exolauv.yaml');
  const before = shown.onDisk();
  await picture(shown, 'opened_light');
  await shown.choose_part('task depth');
  await picture(shown, 'task_light');
  await shown.fill('period', '25ms');
  assert.equal(await shown.source(), before.replace('depth:   {type: DepthControl, period: 50ms', 'depth:   {type: DepthControl, period: 25ms'));
  // what a busy machine does meanwhile is not measured
  const took = async () => (await shown.judged(), Number(/, (\d+) ms/.exec(await shown.text('section[aria-label=Verdict]'))[1]));
  const times = [await took()];
  await drawn(shown, 'task depth, DepthControl, every 25ms');
  // a parameter that the text does not state yet, and out of it again
  await shown.fill('kp', '0.5');
  assert.match(await shown.source(), /depth: +\{type: DepthControl, period: 25ms, wcet: 100us, on_fault: hold, parameters: \{kp: 0\.5\}\}/);
  times.push(await took());
  await shown.fill('kp', '');
  times.push(await took());
  assert.ok(Math.min(...times) < 300, `${times} ms`);
  assert.ok(!(await shown.source()).includes('kp'));
  await shown.control('z');
  await shown.control('z');
  await shown.control('z');
  assert.equal(await shown.source(), before);
  assert.equal(await shown.text('[aria-label="state of the file"]'), 'saved');
  await shown.control('y');
  assert.match(await shown.source(), /period: 25ms/);
  await shown.end();
});

test('a task is added, connected by the mouse and by the form, renamed and removed; its errors are at its node', vehicles, async () => {
  const shown = await EditorPage.edit(browser, 'javiator.yaml');
  const before = await shown.source();
  await shown.press('+ Task');
  await picture(shown, 'add_light');
  await shown.fill('type', 'JaviatorFilter', 'dialog');
  await shown.press('Add');
  await drawn(shown, 'task javiator_filter, JaviatorFilter, every 15ms, 4 problems');
  assert.equal(await shown.source(), before.replace(/( +report: +\{type: HelicopterReporter.*\n)/, '$1  javiator_filter: {type: JaviatorFilter}\n'));
  await shown.says('4 problems');
  await picture(shown, 'problems_light');
  // two nodes that fit in one way only
  await shown.page.drag(await shown.place('in from_robostix', '.handle'), await shown.place('task javiator_filter'));
  await shown.says('3 problems');
  assert.match(await shown.source(), /  - from_robostix -> javiator_filter\.sensors\n/);
  await shown.choose_part('task javiator_filter');
  await shown.fill('source of javiator_filter.sonars', 'from_sonars');
  await shown.says('2 problems');
  await shown.fill('source of javiator_filter.directive', 'logic.directive');
  await shown.says('1 problem');
  await shown.fill('source of javiator_filter.blind', 'blind.motion');
  await shown.says('not decided');
  await shown.fill('wcet', '20us');
  await shown.says('schedulable');
  await drawn(shown, 'connection logic.directive -> javiator_filter.directive');
  await shown.choose_part('task logic');
  await shown.fill('name', 'brain');
  await drawn(shown, 'task brain,');
  const renamed = await shown.source();
  assert.match(renamed, /  - brain\.directive -> javiator_filter\.directive\n/);
  assert.match(renamed, /  - never brain\.directive\.cause is not none\n/);
  assert.match(renamed, /until: brain\.directive\.state is ground or halt/);
  assert.match(renamed, /tasks\.brain\.type: OriginalLogic/);
  assert.ok(!/\blogic\b/.test(renamed));
  await shown.says('schedulable');
  await shown.choose_part('task javiator_filter');
  await shown.press('Remove');
  await shown.choose_part('task brain');
  await shown.fill('name', 'logic');
  await shown.says('schedulable');
  assert.equal(await shown.source(), before);
  await shown.end();
});

test('a connection is led elsewhere, and one to nowhere is reported at its arrow and its line', async () => {
  const shown = await EditorPage.edit(browser, 'counting.yaml');
  const before = await shown.source();
  await shown.page.evaluate(`document.querySelector('[aria-label^="connection count.out -> slow.in"]').focus()`);
  await shown.page.key('Enter');
  // by the mouse, to an input that another one has: that one gives way
  await shown.page.drag(await shown.page.evaluate(`(() => { const b = document.querySelector('.handle.end').getBoundingClientRect(); return [b.x + b.width / 2, b.y + b.height / 2]; })()`), await shown.place('task loop'));
  await picture(shown, 'lead_light');
  await shown.press('count.out → loop.in double, in the place of add.out');
  await drawn(shown, 'connection count.out -> loop.in');
  assert.equal(await shown.source(), before.replace('count.out -> slow.in', 'count.out -> loop.in').replace('  - add.out -> loop.in\n', ''));
  await shown.control('z');
  await shown.page.evaluate(`document.querySelector('[aria-label^="connection count.out -> slow.in"]').focus()`);
  await shown.page.key('Enter');
  await shown.fill('from', 'add.out');
  await drawn(shown, 'connection add.out -> slow.in');
  await shown.control('z');
  await shown.says('schedulable');
  await shown.rewrite(before.replace('- sum.out -> total', '- sum.out -> totl'));
  await shown.page.until(`/connects to 'totl'|'totl'/.test(document.querySelector('section[aria-label=Verdict]').textContent)`);
  const marked = await shown.page.evaluate(`[...document.querySelectorAll('.gutter .wrong')].map((e) => Number(e.textContent))`);
  assert.deepEqual(marked, ['total:', 'sum.out -> total'].map((word) => before.split('\n').findIndex((l) => l.includes(word)) + 1));
  await shown.rewrite(before.replace('- count.out -> slow.in', '- count.out -> slow.ni'));
  await drawn(shown, `connection count.out -> slow.ni (double), 1 problems`);
  // what the loader means is written by a click
  await shown.rewrite(before.replace('- count.out -> slow.in', '- count.oit -> slow.in'));
  await picture(shown, 'meant_light');
  await shown.press("Write 'out'");
  assert.equal(await shown.source(), before);
  // what is no YAML keeps the drawing, and undo works
  await shown.rewrite(before + '  - [\n');
  assert.match(await shown.verdict(), /problem/);
  assert.ok(await shown.page.evaluate(`document.querySelectorAll('.node').length > 5`));
  await shown.choose_part('task sum');
  await shown.press('Remove');
  assert.match(await shown.text('[role=alert]'), /the text is no YAML as it stands/);
  while (await shown.page.evaluate(`![...document.querySelectorAll('button')].find((b) => b.textContent === 'Undo').disabled`)) await shown.press('Undo');
  assert.equal(await shown.source(), before);
  await shown.end();
});

test('it is saved, and a file that has changed on the disk is never overwritten in silence', async () => {
  const shown = await EditorPage.edit(browser, 'counting.yaml');
  const before = shown.onDisk();
  await shown.choose_part('task slow');
  await shown.fill('wcet', '1ms');
  assert.equal(shown.onDisk(), before);
  await shown.control('s');
  await shown.page.until(`document.querySelector('[aria-label="state of the file"]').textContent.trim() === 'saved'`);
  const saved = shown.onDisk();
  assert.equal(saved, before.replace('wcet: 2ms', 'wcet: 1ms'));
  // what others write comes by itself where nothing is lost
  appendFileSync(shown.file, '# theirs\n');
  await shown.page.until(`document.querySelector('textarea').value.endsWith('# theirs\\n')`);
  // and waits where there is something
  await shown.choose_part('task slow');
  await shown.fill('wcet', '3ms');
  appendFileSync(shown.file, '# theirs, too\n');
  await shown.page.until(`document.querySelector('[aria-label="state of the file"]').textContent.includes('changed on disk')`);
  await shown.press('Save');
  await shown.page.until(`!!document.querySelector('dialog[open]')`);
  await picture(shown, 'conflict_light');
  assert.match(await shown.text('dialog'), /# theirs, too/);
  assert.equal(shown.onDisk(), saved + '# theirs\n# theirs, too\n');
  await shown.press('Load what is on the disk');
  await shown.page.until(`document.querySelector('textarea').value.endsWith('# theirs, too\\n')`);
  // what was edited is one step back
  await shown.press('Undo');
  assert.match(await shown.source(), /wcet: 3ms/);
  await shown.press('Save');
  await shown.page.until(`document.querySelector('[aria-label="state of the file"]').textContent.trim() === 'saved'`);
  assert.match(shown.onDisk(), /wcet: 3ms/);
  await shown.end();
});

test('it is saved again before the first answer: what was edited meanwhile is saved behind it, and nobody else is blamed', async () => {
  const shown = await EditorPage.edit(browser, 'counting.yaml');
  const before = shown.onDisk();
  const save = `window.dispatchEvent(new KeyboardEvent('keydown', {key: 's', ctrlKey: true}))`;
  const type = (text) => `(() => { const a = document.querySelector('textarea'); a.value += ${JSON.stringify(text)}; a.dispatchEvent(new Event('input', {bubbles: true})); })()`;
  const isSaved = `document.querySelector('[aria-label="state of the file"]').textContent.trim() === 'saved'`;
  await shown.page.evaluate(`window.dialogs = 0; new MutationObserver(() => (window.dialogs += document.querySelectorAll('dialog').length)).observe(document.body, {childList: true, subtree: true})`);
  await shown.page.evaluate([type('# one\n'), save, save, type('# two\n'), save, save].join(';'));
  await shown.page.until(isSaved);
  assert.equal(shown.onDisk(), before + '# one\n# two\n');
  // an edit that comes later than the request is not saved with it
  await shown.page.evaluate([type('# three\n'), save, type('# four\n')].join(';'));
  await shown.judged();
  assert.equal(await shown.text('[aria-label="state of the file"]'), 'not saved');
  assert.equal(shown.onDisk(), before + '# one\n# two\n# three\n');
  assert.equal(await shown.page.evaluate(`!window.dispatchEvent(new Event('beforeunload', {cancelable: true}))`), true, 'who leaves is asked');
  await shown.press('Save');
  await shown.page.until(isSaved);
  assert.equal(shown.onDisk(), before + '# one\n# two\n# three\n# four\n');
  assert.equal(await shown.page.evaluate('window.dialogs'), 0);
  await shown.end();
});

test('a carriage return alone is shown, and stays where the text is edited around it', async () => {
  const shown = await EditorPage.edit(browser, 'counting.yaml');
  const theirs = '# old\rfile\r\n' + shown.onDisk();
  writeFileSync(shown.file, theirs);
  await shown.page.until(`document.querySelector('textarea').value.startsWith('# old\u240dfile\\n')`);
  await shown.rewrite((await shown.source()).replace('wcet: 2ms', 'wcet: 1ms'));
  await shown.control('s');
  await shown.page.until(`document.querySelector('[aria-label="state of the file"]').textContent.trim() === 'saved'`);
  assert.equal(shown.onDisk(), theirs.replace('wcet: 2ms', 'wcet: 1ms'));
  await shown.end();
});

test('a suggestion of check is taken with a click', async () => {
  const shown = await EditorPage.edit(browser, 'counting.yaml');
  await shown.choose_part('task slow');
  await shown.fill('wcet', '16ms');
  await shown.says('not schedulable');
  await drawn(shown, 'task slow, Relay, every 20ms, LET 15ms, 1 problems');
  await shown.page.until(`!!document.querySelector('.suggestion button')`);
  await picture(shown, 'suggestions_light');
  await shown.page.click('.suggestion button');
  await shown.says('schedulable');
  await shown.press('Undo');
  await shown.says('not schedulable');
  await shown.end();
});

test('it is run in simulation as it stands, and its report is shown', vehicles, async () => {
  const shown = await EditorPage.edit(browser, 'exolauv.yaml', {options: {scheme: 'dark'}});
  await shown.choose_part('task depth');
  await shown.fill('kp', '0.5');
  await shown.judged();
  await shown.fill('length of the run', '2s', 'section[aria-label=Verdict]');
  await shown.press('Run');
  await shown.page.until(`/digest/.test(document.querySelector('[aria-label=run]')?.textContent ?? '')`);
  const expected = execFileSync(jarol, ['run', 'specs/exolauv.yaml', '--for', '2s', '--set', 'tasks.depth.parameters.kp=0.5'], {encoding: 'utf8'});
  assert.equal(/digest +(\w+)/.exec(await shown.text('[aria-label=run]'))[1], /digest +(\w+)/.exec(expected)[1]);
  await picture(shown, 'run_dark');
  await shown.fill('length of the run', '1h', 'section[aria-label=Verdict]');
  await shown.press('Watch');
  const url = await shown.page.until(`document.querySelector('[aria-label=run] a')?.href`);
  assert.match(await (await fetch(url)).text(), /Jarol console/);
  await shown.press('Stop');
  await shown.page.until(`/stopped/.test(document.querySelector('[aria-label=run]').textContent)`);
  // a page that comes later does not show it; one with edits would ask before it goes
  await shown.control('s');
  await shown.page.until(`document.querySelector('[aria-label="state of the file"]').textContent === 'saved'`);
  await shown.page.evaluate(`window.isOld = true; location.reload()`);
  await shown.page.until(`window.isOld === undefined && document.querySelector('[aria-label=verdict]:not(.old)')?.textContent === 'schedulable'`);
  assert.equal(await shown.page.evaluate(`document.querySelector('[aria-label=run]')?.textContent ?? ''`), '');
  await shown.end();
});

test('a graph without a mission is watched for the length that is filled in; with one that is none it is not run, and can be again', async () => {
  const shown = await EditorPage.edit(browser, 'counting.yaml');
  const length = (text) => shown.fill('length of the run', text, 'section[aria-label=Verdict]');
  for (const wrong of ['abc', '1e30s']) {
    await length(wrong);
    await shown.press('Run');
    await shown.page.until(`document.querySelector('[role=alert]')?.innerText.includes("the length '${wrong}'")`);
  }
  assert.equal(await shown.text('[aria-label=run]'), '');
  await length('1h');
  await shown.press('Watch');
  const url = await shown.page.until(`document.querySelector('[aria-label=run] a')?.href`);
  assert.match(await (await fetch(url)).text(), /Jarol console/);
  await shown.press('Stop');
  await shown.page.until(`/stopped/.test(document.querySelector('[aria-label=run]').textContent)`);
  await shown.end();
});

test('a read-only file is not overwritten, and the page says so', async () => {
  const shown = await EditorPage.edit(browser, 'counting.yaml');
  const before = shown.onDisk();
  chmodSync(shown.file, 0o444);
  await shown.choose_part('task slow');
  await shown.fill('wcet', '1ms');
  await shown.press('Save');
  await shown.page.until(`/the file is read-only; allow that it is written/.test(document.querySelector('[role=alert]')?.innerText)`);
  assert.equal(shown.onDisk(), before);
  chmodSync(shown.file, 0o644);
  await shown.press('Save');
  await shown.page.until(`document.querySelector('[aria-label="state of the file"]').textContent.trim() === 'saved'`);
  assert.equal(shown.onDisk(), before.replace('wcet: 2ms', 'wcet: 1ms'));
  assert.equal(await shown.text('[role=alert]'), '');
  await shown.end();
});

test('dark and narrow it can be read, too', vehicles, async () => {
  const shown = await EditorPage.edit(browser, 'javiator.yaml', {options: {scheme: 'dark'}});
  assert.ok(await shown.page.evaluate(`document.documentElement.scrollWidth <= innerWidth && document.documentElement.scrollHeight <= innerHeight`));
  await shown.choose_part('task attitude');
  await picture(shown, 'task_dark');
  await shown.end();
});
