// Pages whose connection to jarol breaks and comes back. Exit code 77: jarol was built without the page.
import assert from 'node:assert/strict';
import {appendFileSync} from 'node:fs';
import {after, test} from 'node:test';
import {Browser} from './browser.mjs';
import {EditorPage} from './edited_graph.mjs';
import {ForwardedPort} from './forwarded_port.mjs';
import {Console, digestIn, endAll, leaveOutWithoutPage, start} from './watched_run.mjs';

await leaveOutWithoutPage();

const browser = new Browser({flags: ['--disable-gpu']});
after(async () => {
  endAll();
  await browser.close();
});

const isLost = `/connection to jarol edit is lost/.test(document.querySelector('[role=alert]')?.innerText)`;
const isBack = `!document.querySelector('[role=alert]')`;
const isState = (text) => `document.querySelector('[aria-label="state of the file"]').textContent.trim() === '${text}'`;
const type = (text) => `(() => { const a = document.querySelector('textarea'); a.value += ${JSON.stringify(text)}; a.dispatchEvent(new Event('input', {bubbles: true})); })()`;

test('an editor whose connection breaks keeps the edits, connects again, judges and saves them', async () => {
  const shown = await EditorPage.edit(browser, 'counting.yaml', {forwarded: true});
  const before = shown.onDisk();
  await shown.page.evaluate(type('# before\n'));
  await shown.forwarded.cut();
  await shown.page.until(isLost);
  // what is edited meanwhile stays, and what can't be done is said
  await shown.page.evaluate(type('# meanwhile\n'));
  await shown.control('s');
  assert.match(await shown.text('[role=alert]'), /not done: the connection to jarol edit is lost; do it again once it is back/);
  await shown.forwarded.mend();
  await shown.page.until(isBack);
  await shown.judged();
  assert.equal(await shown.source(), before + '# before\n# meanwhile\n');
  assert.equal(shown.onDisk(), before);
  await shown.page.until(isState('not saved'));
  await shown.press('Save');
  await shown.page.until(isState('saved'));
  assert.equal(shown.onDisk(), before + '# before\n# meanwhile\n');
  shown.forgiveBreaks();
  await shown.end();
});

test('a file that has changed while the connection was broken is shown where nothing was edited, else it is asked', async () => {
  const shown = await EditorPage.edit(browser, 'counting.yaml', {forwarded: true});
  const change = async (theirs, mine) => {
    await shown.forwarded.cut();
    await shown.page.until(isLost);
    appendFileSync(shown.file, theirs);
    if (mine) await shown.page.evaluate(type(mine));
    await shown.forwarded.mend();
    await shown.page.until(isBack);
  };
  await change('# theirs\n');
  await shown.page.until(`document.querySelector('textarea').value.endsWith('# theirs\\n')`);
  await shown.page.until(isState('saved'));
  await change('# theirs, too\n', '# mine\n');
  await shown.page.until(`!!document.querySelector('dialog[open]')`);
  assert.match(await shown.text('dialog'), /# theirs, too/);
  assert.ok((await shown.source()).endsWith('# theirs\n# mine\n'));
  await shown.press('Go on editing');
  await shown.page.until(isState('changed on disk'));
  assert.ok(shown.onDisk().endsWith('# theirs\n# theirs, too\n'));
  shown.forgiveBreaks();
  await shown.end();
});

test('a save whose answer is lost with the connection is known as saved once it is back', async () => {
  const shown = await EditorPage.edit(browser, 'counting.yaml', {forwarded: true});
  const before = shown.onDisk();
  await shown.forwarded.hold();
  await shown.page.evaluate(type('# mine\n'));
  await shown.control('s');
  await shown.disk(before + '# mine\n');
  await shown.page.until(isState('not saved'));
  await shown.forwarded.cut();
  await shown.page.until(isLost);
  await shown.forwarded.mend();
  await shown.page.until(isBack);
  await shown.page.until(isState('saved'));
  assert.equal(await shown.page.evaluate(`document.querySelector('dialog')`), null);
  shown.forgiveBreaks();
  await shown.end();
});

test('a run whose connection breaks is watched again, and to its end', async () => {
  const run = start('run', 'specs/counting.yaml', '--console', '--for', '2s', '--pace', '0.001');
  const port = await ForwardedPort.to(await run.url);
  const shown = await Console.open(browser, port.url);
  await shown.state('live');
  await shown.choose('signal to add', 'sum.out');
  const isPlotted = `document.querySelector('[aria-label="plot of sum.out"] canvas') !== null`;
  await shown.page.until(isPlotted);
  for (let i = 0; i < 2; ++i) {
    await port.cut();
    await shown.state('connection lost');
    await port.mend();
    await shown.state('live');
    await shown.page.until(isPlotted);
  }
  await shown.choose('speed', 'max');
  await shown.state('ended');
  const {code, output} = await run.ended;
  assert.equal(code, 0);
  assert.equal(digestIn(await shown.text('[role=log]')), digestIn(output));
  shown.forgiveBreaks();
  await shown.close();
  await port.cut();
});
