// The page of a run.
import {count, duration, el, number, plain, section, shown, table} from './base.js';
import {readData, Signal, TimeWindow} from './data.js';
import {drawGraph} from './drawing.js';
import {runLine, scheduleLine, taskTable} from './lines.js';
import {pathOf} from './path.js';
import {plotsOf} from './plots.js';
import {headOf, summaryOf} from './summary.js';

const data = readData();
const {happenings, summary} = data;
const signals = data.signals.map((stated, i) => new Signal(stated, data.topics, i));
const byName = new Map(signals.map((signal) => [signal.name, signal]));
const time = new TimeWindow(0, summary.covered_ns / 1e9);

// First of all what was commanded and reached; else what comes first and changes.
function chosenSignals() {
  const pairs = (data.pairs ?? []).map((names) => names.map((name) => byName.get(name)).filter(Boolean)).filter((some) => some.length > 0);
  const moving = pairs.filter((some) => some.some((signal) => signal.stated.min !== signal.stated.max));
  if (moving.length > 0) return moving.slice(0, 4);
  return signals.filter((signal) => signal.stated.min !== signal.stated.max).slice(0, 3).map((signal) => [signal]);
}

function eventsSection() {
  const listed = happenings.events;
  const gaps = happenings.gaps.map((gap) =>
    el('p', {class: 'bad'}, `From ${duration(gap.from_ns, 7)} to ${duration(gap.to_ns, 7)} the disk was too slow: ${count(gap.values, 'published value')} are not in the recording; a replay computes them again.`));
  if (listed.length === 0)
    return section('events', 'Faults and events', null, ...gaps,
      el('p', {class: 'nothing'}, summary.what === 'inputs' ? 'This recording holds inputs only; events are not in it.' : 'No fault, and nothing else that happens beside what is published.'));
  const more = happenings.more_events > 0 ? el('p', {class: 'hint'}, `${count(happenings.more_events, 'more event')} are in the recording: jarol log cat ${summary.recording} --topic jarol/events`) : null;
  const go = (event) => el('button', {type: 'button', class: 'link', onclick: () => {
    const at = event.instant_ns / 1e9, half = Math.min(2, time.end / 10);
    time.show(at - half, at + half);
    time.point(at);
    document.getElementById('line').scrollIntoView();
  }}, `${number(event.instant_ns / 1e9, 10)} s`);
  return section('events', 'Faults and events', null, ...gaps,
    table('faults and events', [['instant', false], ['task', false], ['activation', true], ['what', false]],
      listed.slice(0, 500).map((event) => [go(event), event.task ?? '', event.activation === undefined ? '' : String(event.activation), event.cause])),
    listed.length > 500 ? el('p', {class: 'hint'}, `The first 500 of ${listed.length + happenings.more_events}.`) : null, more);
}

function signalTable() {
  const rows = signals.map((signal) => {
    const {unit, scale} = shown(signal.unit);
    const cell = (value) => value === null ? '–' : number(value * scale);
    return [signal.name, unit, String(signal.topic.messages), cell(signal.stated.min), cell(signal.stated.max), cell(signal.stated.first), cell(signal.stated.last)];
  });
  return el('details', {class: 'all'}, el('summary', {}, `All ${count(signals.length, 'signal')} in numbers`),
    table('signals', [['signal', false], ['unit', false], ['values', true], ['min', true], ['max', true], ['first', true], ['last', true]], rows));
}

// What of a large recording is in the page.
function thinned() {
  const topics = data.topics.filter((topic) => topic.piece_ns !== undefined);
  if (topics.length === 0) return 'Every recorded number is in this page, to the bit.';
  return `Of ${count(topics.length, 'output')} with more than ${plain(data.max_values)} values the page has the least and the greatest of each ${duration(topics[0].piece_ns)}, and draws the range between both; the recording has all.`;
}

function plotsSection() {
  if (signals.length === 0)
    return section('plots', 'Plots', null, el('p', {class: 'nothing'}, 'No published values are in this recording. Record them by jarol run --record without --record-what inputs, or replay this one with --trace.'));
  const marks = happenings.events.slice(0, 1000).map((event) => ({instant: event.instant_ns / 1e9, fault: event.task !== undefined}));
  return section('plots', 'Plots', thinned() + (data.sequences.length > 0 ? ` Texts and sequences are not drawn: ${data.sequences.join(', ')}.` : ''),
    plotsOf(signals, chosenSignals(), time, marks), signalTable());
}

function pathSection() {
  const paths = data.paths.map((path) => ({...path, x: signals[path.x], y: signals[path.y], z: signals[path.z]}));
  // one that moves first
  paths.sort((a, b) => (b.x.stated.min !== b.x.stated.max) - (a.x.stated.min !== a.x.stated.max));
  if (paths.length === 0)
    return section('path', 'Path', null, el('p', {class: 'nothing'}, 'Nothing that is recorded is a place: fields x and y with z, depth, altitude or height, in metres.'));
  return section('path', 'Path', null, pathOf(paths, time));
}

const sections = [section('summary', 'Summary', null, summaryOf(data))];
if (data.drawing)
  sections.push(section('graph', 'Graph', 'Tasks are rounded, with their period; those with a LET are filled. Squares take values in or hand them out.',
    el('div', {class: 'scroll', tabindex: 0, role: 'region', 'aria-label': 'the graph drawn'}, drawGraph(data.drawing, summary.graph))));
else
  sections.push(section('graph', 'Graph', null, el('p', {class: 'nothing'}, 'The graph of the recording could not be loaded, so it is neither drawn nor replayed:'), el('pre', {}, data.no_graph)));
if (data.tasks?.length > 0) {
  sections.push(section('tasks', 'Tasks', data.tasks.some((task) => task.measured)
    ? 'Measured: the processor time of each activation in a replay, on the machine and at the time at which this page was made.' : null, taskTable(data.tasks, happenings)));
  if (data.schedule)
    sections.push(section('schedule', 'A hyperperiod', `As planned on ${count(data.schedule.cores, 'core')} when each activation takes its declared WCET: ${data.schedule.verdict}, ${number(data.schedule.utilisation * 100, 3)} % of the time in use.`,
      scheduleLine(data.schedule, data.tasks)));
  sections.push(section('line', 'The run', summary.clock === 'real'
    ? 'Releases in logical time. Of activations that missed their deadline the recording has how long they took; of others it has no physical time.'
    : 'Releases in logical time, the only time of a run on the virtual clock.', runLine(data.tasks, happenings, time)));
}
sections.push(eventsSection(), plotsSection(), pathSection());

document.body.append(
  el('a', {class: 'skip', href: '#summary'}, 'To the summary'),
  headOf(data),
  el('nav', {'aria-label': 'contents'}, el('ul', {}, sections.map((each) => el('li', {}, el('a', {href: '#' + each.id}, each.querySelector('h2').textContent))))),
  el('main', {}, sections),
  el('footer', {}, `Made by ${summary.version}. This page asks the network for nothing.`));
