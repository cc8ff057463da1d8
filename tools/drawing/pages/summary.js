// What run it was, in words and figures.
import {command, count, duration, el, number, plain} from './base.js';

const words = {holds: 'holds', fails: 'fails', not_judged: 'not judged'};

export function badge(kind, text) {
  return el('span', {class: 'badge ' + kind}, el('span', {'aria-hidden': 'true'}, {good: '✓', bad: '✕', open: '○'}[kind]), ' ', text);
}

/** good, bad or open, with a sentence. */
export function verdictOf(data) {
  const {summary, replay} = data;
  const expected = replay?.verdict.expectations ?? [];
  const failed = expected.filter((e) => e.verdict === 'fails').length;
  if (!summary.end) return ['open', 'The recording breaks off'];
  if (replay?.evidence === 'diverged') return ['bad', 'The replay diverges'];
  if (failed > 0) return ['bad', `${count(failed, 'expectation')} not met`];
  if (replay?.verdict.left_out.length > 0) return ['bad', 'Faults left out too much'];
  if (summary.end.faults > 0) return ['open', `${count(summary.end.faults, 'fault')}, within what is allowed`];
  return replay?.evidence === 'same' ? ['good', 'Replays to the bit'] : ['open', 'Not replayed'];
}

export function headOf(data) {
  const {summary} = data;
  const figure = (value, text) => el('div', {class: 'figure'}, el('dd', {}, value), el('dt', {}, text));
  const values = data.topics.reduce((all, topic) => all + topic.messages, 0);
  return el('header', {class: 'head'},
    el('p', {class: 'kicker'}, 'Jarol · run report'),
    el('div', {class: 'title'}, el('h1', {}, summary.graph), badge(...verdictOf(data))),
    el('dl', {class: 'figures'},
      figure(duration(summary.covered_ns, 6), `on the ${summary.clock} clock`),
      summary.end ? figure(plain(summary.end.activations), 'activations') : null,
      summary.end ? figure(plain(summary.end.faults), 'faults') : null,
      figure(plain(data.happenings.misses.length + data.happenings.more_misses), 'late or left out'),
      figure(plain(values), 'values recorded')));
}

export function summaryOf(data) {
  const {summary, replay} = data;
  const row = (name, value) => value ? [el('dt', {}, name), el('dd', {}, value)] : [];
  const facts = el('dl', {class: 'facts'},
    row('Graph', el('code', {}, summary.file)),
    row('Profile', summary.profile && el('code', {}, summary.profile)),
    row('Changed', summary.set.length > 0 && el('ul', {}, summary.set.map((set) => el('li', {}, el('code', {}, set))))),
    row('Seed', String(summary.seed)),
    row('Files read', summary.files.length > 1 && el('ul', {}, summary.files.filter((f) => f !== summary.file).map((f) => el('li', {}, el('code', {}, f))))),
    row('Digest', summary.end ? el('code', {class: 'digest'}, summary.end.digest) : `not known: the recording breaks off at byte ${summary.good_until}`),
    row('Recording', [el('code', {}, summary.recording), `, ${summary.bytes < 1e6 ? `${number(summary.bytes / 1e3, 3)} kB` : `${number(summary.bytes / 1e6, 3)} MB`}, recorded: ${summary.what}`]),
    row('Made by', summary.version), row('On', summary.platform));
  return [facts,
    el('h3', {}, 'Repeat it'),
    el('p', {}, 'From the recording, without the vehicle, to the bit:'), command(summary.replay_command),
    summary.run_command ? [el('p', {}, 'With its simulated vehicle, to the same digest while the files are what they were:'), command(summary.run_command)] : [],
    replay ? verdictText(replay) : []];
}

function verdictText({standing, compared, verdict}) {
  const text = {same: `A replay when this page was made came out the same${compared > 0 ? `: ${count(compared, 'value')} compared, each to the bit` : ''}.`,
                diverged: 'A replay when this page was made did not come out the same: another build of the program, or a task that is not isolated. jarol replay shows where.',
                unknown: 'A replay when this page was made went as far as the recording does.'}[standing];
  const expected = verdict.expectations;
  return [el('p', {}, text),
    expected.length > 0 ? el('h3', {}, 'What the graph expects') : null,
    el('ul', {class: 'expected'}, expected.map((e) => el('li', {},
      badge({holds: 'good', fails: 'bad', not_judged: 'open'}[e.verdict], words[e.verdict]), el('code', {}, e.condition),
      e.reached !== undefined && !/ is /.test(e.condition) ? el('span', {}, `${number(e.reached)} ${e.unit}`) : null, e.why && !e.why.includes('is not simulated in this process') ? el('span', {class: 'range'}, e.why) : null))),
    expected.some((e) => e.why?.includes('is not simulated in this process')) ? el('p', {class: 'hint'}, 'A replay has no vehicle: what is expected of the true values of one is judged in the run itself.') : null,
    ...verdict.left_out.map((line) => el('p', {class: 'bad'}, line))];
}
