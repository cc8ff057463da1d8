// Random edits through the editor's page, by its buttons, forms and drawing, on the shipped graphs: after each the text loads
// to the graph that the page shows, all comments are there, and undo to the beginning gives the original bytes. JAROL_EDITS
// says how many of each graph, JAROL_SEED which ones. Exit code 77: jarol was built without the page.
import assert from 'node:assert/strict';
import {spawnSync} from 'node:child_process';
import {after, test} from 'node:test';
import {Browser} from './browser.mjs';
import {EditorPage} from './edited_graph.mjs';
import {endAll, leaveOutWithoutPage} from './watched_run.mjs';

const jarol = process.env.JAROL_COMMAND;
const vehicles = process.env.JAROL_VEHICLES === '1' ? {} : {skip: 'built without vehicles'};
const each = Number(process.env.JAROL_EDITS ?? 170);
const seed = Number(process.env.JAROL_SEED ?? 1);

await leaveOutWithoutPage();

const browser = new Browser({flags: ['--disable-gpu']});
after(async () => {
  endAll();
  await browser.close();
});

// What is done in the page: one edit, as a person would do it; its name, or nothing where it can't be done.
function driver(seed) {
  let state = seed >>> 0;
  const random = (below) => {
    state = (state + 0x6d2b79f5) >>> 0;
    let t = Math.imul(state ^ (state >>> 15), 1 | state);
    t = (t + Math.imul(t ^ (t >>> 7), 61 | t)) ^ t;
    return Math.floor((((t ^ (t >>> 14)) >>> 0) / 4294967296) * below);
  };
  let wrong = 0;  // so many edits ago it was right
  const pick = (list) => list[random(list.length)];
  const all = (selector) => [...document.querySelectorAll(selector)];
  const next = () => new Promise((done) => setTimeout(done));
  const button = (text, within = '') => all(`${within} button`).find((b) => (b.getAttribute('aria-label') ?? b.textContent.trim()) === text && !b.disabled);
  const fill = (field, value) => {
    field.value = value;
    field.dispatchEvent(new Event('input', {bubbles: true}));
    field.dispatchEvent(new Event('change', {bubbles: true}));
    return `${field.getAttribute('aria-label')} ${value}`;
  };
  const form = 'section[aria-label=Form]';
  const field = (label) => document.querySelector(`${form} [aria-label="${label}"]`);
  const choose = async (selector) => {
    const found = pick(all(selector));
    found?.dispatchEvent(new MouseEvent('click', {bubbles: true}));
    await next();
    return found?.getAttribute('aria-label');
  };
  const optionOf = (select) => pick([...select.options].map((option) => option.value).filter((value) => value !== '' && value !== select.value));
  const ready = () => !!document.querySelector('[aria-label=verdict]:not(.old)') && !!document.querySelector('svg:not(.old)');
  window.settled = async () => { while (!ready()) await new Promise((done) => setTimeout(done, 2)); };
  window.shown = () => ({
    text: document.querySelector('textarea').value,
    nodes: all('.node').map((n) => n.getAttribute('aria-label')),
    arrows: all('.arrow:not(.channel)').map((n) => n.getAttribute('aria-label')),
    elsewhere: all('.node title').filter((t) => t.textContent.startsWith('stands elsewhere')).length,
    verdict: document.querySelector('[aria-label=verdict]').textContent,
  });
  window.edit = async () => {
    const parts = all('.node').length;
    const problems = all('.problem');
    wrong = problems.length > 0 ? wrong + 1 : 0;
    // what is wrong is mostly mended: an input is connected, or all is undone
    if (problems.length > 0 && random(8) > 0) {
      problems[0].click();
      await next();
      const open = all(`${form} select.open`).filter((select) => select.options.length > 1);
      if (open.length > 0 && wrong < 8) return fill(open[0], optionOf(open[0]));
      for (let i = 0; i < wrong; ++i, await next()) button('Undo')?.click();
      return `undo ${wrong} of what is wrong`;
    }
    const kind = parts > 36 ? 3 : random(13);
    if (kind < 2) {
      button('+ Task').click();
      await next();
      const types = [...new Set(all('.task').map((n) => n.getAttribute('aria-label').split(', ')[1]))];
      fill(document.querySelector('dialog [aria-label=type]'), pick(types.filter((type) => type !== 'no type')) ?? 'Relay');
      await next();
      document.querySelector('dialog form').requestSubmit();
      return 'add a task';
    }
    if (kind === 2) {
      button('+ Communicator').click();
      await next();
      const channel = document.querySelector('dialog [aria-label=channel]');
      if (channel.options.length > 1) fill(channel, optionOf(channel));
      else fill(document.querySelector('dialog [aria-label=type]'), 'double');
      await next();
      document.querySelector('dialog form').requestSubmit();
      return 'add a communicator';
    }
    if (kind === 3) {
      const name = await choose('.node:not(.distributer)');
      button('Remove', form)?.click();
      return `remove ${name}`;
    }
    if (kind === 4 || kind === 5) {
      const name = await choose('.node');
      return `${name}: ${fill(field('name'), `${pick(['a', 'part', 'x_y'])}${random(10000)}`)}`;
    }
    if (kind === 6 || kind === 7) {
      const name = await choose('.node:not(.distributer)');
      const label = pick(['wcet', 'period', 'offset', 'let', 'on_fault', 'timeout'].filter((each) => field(each)));
      const values = {wcet: `${1 + random(80)}us`, period: pick(['100ms', '50ms', '10ms', '15ms', '5ms', '']), offset: pick(['1ms', '5ms', '']), let: pick(['5ms', '10ms', '']), on_fault: pick(['hold', 'skip', '']), timeout: pick(['3s', ''])};
      return `${name}: ${fill(field(label), values[label])}`;
    }
    if (kind === 8) {
      const name = await choose('.task');
      const numbers = all(`${form} .fields input`).filter((input) => /^-?[0-9.]+$/.test(input.placeholder));
      if (numbers.length === 0) return undefined;
      const input = pick(numbers);
      return `${name}: ${fill(input, input.value === '' ? input.placeholder : '')}`;
    }
    if (kind === 9 || kind === 10) {
      const name = await choose('.arrow:not(.channel)');
      if (!name) return undefined;
      if (random(4) === 0) {
        button('Remove', form)?.click();
        return `remove ${name}`;
      }
      const select = field(pick(['from', 'to']));
      const option = select && optionOf(select);
      return option && `${name}: ${fill(select, option)}`;
    }
    if (kind === 11) {
      const name = await choose('.node, .arrow:not(.channel)');
      button(pick(['move up', 'move down']), form)?.click();
      return `move ${name}`;
    }
    const back = 1 + random(4), word = pick(['Undo', 'Undo', 'Redo']);
    for (let i = 0; i < back; ++i, await next()) button(word)?.click();
    return `${word} ${back}`;
  };
  window.undoAll = async () => { while (button('Undo')) { button('Undo').click(); await next(); } };
}

// The words after which comments begin are those of the shipped graphs: none has a # in quotes.
const comments = (text) => text.split('\n').flatMap((line) => /(?:^|\s)(#.*)$/.exec(line)?.[1].trimEnd() ?? []).sort();
const milliseconds = (ns) => (ns % 1e6 === 0 ? `${ns / 1e6}ms` : `${ns / 1e3}us`);

// What jarol graph says of the text; undefined: it does not load.
function loaded(text, folder) {
  const {status, stdout} = spawnSync(jarol, ['graph', '-', '--json'], {input: text, cwd: folder, encoding: 'utf8'});
  return status === 0 ? JSON.parse(stdout) : undefined;
}
const without = (label) => label.replace(/, \d+ problems$/, '');

for (const name of ['exolauv', 'exolauv_bare', 'javiator', 'counting', 'window', 'passthrough'])
  test(`${each} random edits of ${name}: each text loads to the graph that is shown, and undo gives the bytes back`, vehicles, async () => {
    const shown = await EditorPage.edit(browser, `${name}.yaml`);
    const original = shown.onDisk();
    await shown.page.evaluate(`(${driver})(${seed})`);
    let loads = 0;
    const done = [];
    for (let made = 0, tries = 0; made < each; ++tries) {
      assert.ok(tries < 20 * each, 'most edits can be made');
      const {what, now} = await shown.page.evaluate(`(async () => {
        const before = document.querySelector('textarea').value;
        const what = await edit();
        await new Promise((done) => setTimeout(done));
        document.querySelectorAll('dialog[open]').forEach((dialog) => dialog.close());
        if (what === undefined || document.querySelector('textarea').value === before) return {};
        await settled();
        return {what, now: shown()};
      })()`);
      if (!now) continue;
      ++made;
      done.push(what);
      const last = `after ${done.slice(-5).join('; ')}:\n${now.text}`;
      assert.deepEqual(comments(now.text), comments(original), last);
      assert.equal(now.elsewhere, 0, last);
      const graph = loaded(now.text, shown.folder);
      assert.equal(graph === undefined, /problem/.test(now.verdict), `${now.verdict} ${last}`);
      if (!graph) continue;
      ++loads;
      const timing = (part) => `every ${milliseconds(part.period_ns)}${part.offset_ns > 0 ? ` from ${milliseconds(part.offset_ns)}` : ''}`;
      const expected = [
        ...graph.tasks.map((t) => `task ${t.name}, ${t.type}, ${timing(t)}${t.let_ns ? `, LET ${milliseconds(t.let_ns)}` : ''}`),
        ...graph.communicators.map((c) => `${c.direction} ${c.name}, ${timing(c)}`),
      ];
      assert.deepEqual(now.nodes.map(without).filter((label) => !label.startsWith('distributer ')).sort(), expected.sort(), last);
      const arrows = now.arrows.flatMap((label) => without(label).replace(/^connection /, '').split(', '));
      assert.deepEqual(arrows.map((arrow) => arrow.replace(/ \(.*\)$/, '')).sort(), graph.connections.map((c) => `${c.from} -> ${c.to}`).sort(), last);
    }
    console.log(`# ${name}: ${loads} of ${each} texts load`);
    assert.ok(loads > each / 4, `${loads} of ${each} texts load`);
    await shown.page.evaluate('undoAll()');
    assert.equal(await shown.source(), original);
    assert.equal(await shown.text('[aria-label="state of the file"]'), 'saved');
    await shown.end();
  });
