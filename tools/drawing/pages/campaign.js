// The page of a campaign.
import {command, count, el, number, plain, section, shown, table} from './base.js';
import {doubles, readData} from './data.js';
import {histogramOf, scatterOf} from './distribution.js';
import {badge} from './summary.js';

const data = readData();
const {report} = data;
const outcomeWords = Object.keys(report.outcomes);
const index = doubles(data.index), outcomes = doubles(data.outcomes);
const good = [...outcomes].map((outcome) => outcome === 0);
const metrics = report.metrics.map((metric, i) => ({...metric, ...data.metrics[i], values: doubles(data.metrics[i].values)}));
const varied = data.vary.map((axis) => ({...axis, name: axis.path, values: doubles(axis.values)}));
const reached = (value, unit) => { const s = shown(unit); return `${number(value * s.scale)}${s.unit ? ' ' + s.unit : ''}`; };

function runsText() {
  const all = plain(report.runs);
  if (report.shard) return `runs of shard ${report.shard.part}/${report.shard.of} of ${all}`;
  return report.done === report.runs ? 'runs' : `runs of ${all}`;
}

function head() {
  const bad = report.done - report.outcomes.good;
  const figure = (value, text) => el('div', {class: 'figure'}, el('dd', {}, value), el('dt', {}, text));
  const kinds = outcomeWords.filter((word) => word !== 'good' && report.outcomes[word] > 0);
  return el('header', {class: 'head'}, el('p', {class: 'kicker'}, 'Jarol · campaign'),
    el('div', {class: 'title'}, el('h1', {}, report.graph), report.done === 0 ? badge('open', 'No runs') : bad === 0 ? report.not_judged ? badge('open', 'Good as far as judged') : badge('good', 'All runs are good') : badge('bad', `${count(bad, 'run')} not good`)),
    el('dl', {class: 'figures'}, figure(plain(report.done), runsText()),
      figure(`${number(report.outcomes.good / Math.max(1, report.done) * 100, 4)} %`, 'good'),
      ...kinds.map((word) => figure(plain(report.outcomes[word]), word))));
}

function summary() {
  const facts = el('dl', {class: 'facts'},
    ...data.vary.flatMap((axis) => [el('dt', {}, 'Varied'), el('dd', {}, el('code', {}, `${axis.path} = ${axis.text}`))]),
    ...metrics.flatMap((metric) => [el('dt', {}, metric.limit ? 'Limit' : 'Measured'), el('dd', {}, el('code', {}, `${metric.name}: ${metric.text}`))]),
    el('dt', {}, 'Results'), el('dd', {}, el('code', {}, report.results)));
  const columns = [['metric', false], ['runs', true], ['min', true], ['5 %', true], ['25 %', true], ['median', true], ['75 %', true], ['95 %', true], ['max', true], ['mean', true], ['deviation', true]];
  const rows = metrics.map((m) => m.min === undefined
    ? [m.name, String(m.runs), ...Array(9).fill('–')]
    : [m.name, String(m.runs), reached(m.min.value, m.unit), ...['5', '25', '50', '75', '95'].map((p) => reached(m.percentiles[p], m.unit)), reached(m.max.value, m.unit), reached(m.mean, m.unit), reached(m.deviation, m.unit)]);
  const words = metrics.flatMap((m) => Object.entries(m.words ?? {}).map(([word, runs]) => el('p', {}, el('code', {}, m.name), ` is ${word} in ${count(runs, 'run')}.`)));
  const valued = metrics.filter((m) => m.missing > 0).map((m) => el('p', {}, el('code', {}, m.name),
    ` has a value in ${report.done - m.missing} of ${count(report.done, 'run')}${m.runs > 0 ? '; its numbers are of those' : ''}.`));
  const notes = [];
  if (report.all_same) notes.push(el('p', {}, `All ${count(report.done, 'run')} have one digest: what varies has no effect.`));
  if (report.not_judged) notes.push(el('p', {}, `${count(report.not_judged.runs, 'run')} good as far as judged; run ${report.not_judged.run}: ${report.not_judged.why}.`));
  return section('summary', 'Summary', 'Percentiles are by nearest rank: each is the number of a run.', facts, notes, el('h3', {}, 'Metrics'),
    rows.length > 0 ? table('percentiles of each metric', columns, rows) : el('p', {class: 'nothing'}, 'Nothing was measured. Name a metric: jarol campaign ... --metric \'deepest=max(depth of dune) < 3.2\''), words, valued);
}

function histograms() {
  const drawn = metrics.filter((m) => m.min !== undefined);
  if (drawn.length === 0) return null;
  return section('histograms', 'How the metrics lie', 'All runs are counted: blue are good, orange are not. A dashed line is a limit.',
    el('div', {class: 'grid'}, drawn.map((m) => el('figure', {class: 'card'}, el('figcaption', {}, el('strong', {}, m.name), ' ', el('code', {}, m.text)), histogramOf(m)))));
}

function scatters() {
  const axes = [...varied, ...metrics.filter((m) => m.min !== undefined)];
  const ups = metrics.filter((m) => m.min !== undefined);
  if (varied.length === 0 || ups.length === 0) return null;
  const shown = el('div', {class: 'shown', role: 'status'});
  const show = (point) => {
    if (point < 0) return;
    const values = [...varied.map((v) => `${v.path} = ${v.words ? v.words[v.values[point]] : number(v.values[point]) + (v.unit ? ' ' + v.unit : '')}`),
      ...ups.map((m) => `${m.name} ${reached(m.values[point], m.unit)}`)];
    shown.textContent = `Run ${index[point]}, ${outcomeWords[outcomes[point]]}: ${values.join(', ')}`;
  };
  const thinned = data.every > 1 ? ` One run of each ${data.every}, and those that this page names; all are in the results.` : '';
  const area = el('div', {class: 'grid'});
  const add = (across, up) => area.append(el('div', {class: 'card'}, scatterOf(across, up, good, show)));
  for (const up of ups) for (const across of varied) if (area.children.length < 12) add(across, up);
  const choose = (label, some) => el('select', {'aria-label': label}, some.map((axis, i) => el('option', {value: i}, axis.name)));
  const x = choose('across', axes), y = choose('up', ups);
  return section('scatter', 'Metrics against what varied', 'Each dot is a run, each cross one that is not good.' + thinned, area, shown,
    el('div', {class: 'buttons'}, el('span', {class: 'hint'}, 'One more:'), y, ' against ', x, el('button', {type: 'button', onclick: () => add(axes[x.value], ups[y.value])}, 'Draw')));
}

function cases() {
  const worst = metrics.flatMap((m) => m.worst ? [[m.bad_without ? 'worst value of' : 'worst', m, m.worst]] : m.min ? [['min', m, m.min], ['max', m, m.max]] : []);
  const without = metrics.filter((m) => m.bad_without);
  const item = (title, text, line) => el('li', {}, el('p', {}, el('strong', {}, title), ' ', text), command(line));
  return section('cases', 'Cases to repeat', 'Each command runs that case again, to the bit, and records it; jarol log report makes a page of the recording.',
    report.shrunk ? [el('h3', {}, 'The mildest that fails'), el('ul', {class: 'cases'}, item(`Run ${report.shrunk.run}`, report.shrunk.why, report.shrunk.command))] : [],
    worst.length + without.length > 0 ? [el('h3', {}, 'Those that stand out'), el('ul', {class: 'cases'},
      worst.map(([word, m, one]) => item(`${word} ${m.name}`, `${reached(one.value, m.unit)}, run ${one.run}`, one.command)),
      without.map(({name, bad_without: bad}) => item(`bad without a value of ${name}`, `run ${bad.run}${bad.runs > 1 ? `, the first of ${bad.runs} such runs` : ''}`, bad.command)))] : [],
    el('h3', {}, 'Those that are not good'),
    report.not_good.length > 0 ? el('ul', {class: 'cases'}, report.not_good.map((one) => item(`Run ${one.run}, ${one.outcome}`, one.why, one.command)))
      : el('p', {class: 'nothing'}, 'None.'),
    report.done - report.outcomes.good > report.not_good.length ? el('p', {class: 'hint'}, `The first ${report.not_good.length} of ${report.done - report.outcomes.good}.`) : null);
}

const sections = [summary(), histograms(), scatters(), cases()].filter(Boolean);
document.body.append(
  el('a', {class: 'skip', href: '#summary'}, 'To the summary'), head(),
  el('nav', {'aria-label': 'contents'}, el('ul', {}, sections.map((each) => el('li', {}, el('a', {href: '#' + each.id}, each.querySelector('h2').textContent))))),
  el('main', {}, sections),
  el('footer', {}, 'Made by jarol campaign. This page asks the network for nothing.'));
