// Time lines of tasks: what is to run when, and what the run has been.
import {colour, duration, el, table} from './base.js';
import {TimeWindow} from './data.js';
import {rowsOf} from './rows.js';
import {timeButtons} from './steer.js';

// The releases of a task that are seen; in ns.
function releases(task, from, to) {
  const first = Math.max(0, Math.ceil((from - (task.let_ns ?? 0) - task.offset_ns) / task.period_ns));
  return {first, last: Math.floor((to - task.offset_ns) / task.period_ns), at: (k) => task.offset_ns + k * task.period_ns};
}

function drawLet(pen, from, to) {
  pen.context.fillStyle = colour('let');
  pen.context.strokeStyle = colour('let-line');
  pen.context.lineWidth = 1;
  const width = Math.max(1.5, pen.x(to) - pen.x(from));
  pen.context.fillRect(pen.x(from), pen.y, width, pen.height);
  pen.context.strokeRect(pen.x(from) + 0.5, pen.y + 0.5, Math.max(0.5, width - 1), pen.height - 1);
}

/** A hyperperiod in which each activation takes its WCET. */
export function scheduleLine(schedule, tasks) {
  const time = new TimeWindow(0, schedule.until_ns / 1e9);
  const slices = new Map(tasks.map((task) => [task.index, []]));
  for (const [task, activation, begin, end] of schedule.slices) slices.get(task)?.push({activation, begin, end});
  const rows = tasks.map((task) => ({name: task.name, draw: (pen, from, to) => {
    const seen = releases(task, from * 1e9, to * 1e9);
    for (let k = seen.first; k <= seen.last; ++k) {
      const at = seen.at(k);
      if (task.let_ns !== null) drawLet(pen, at / 1e9, (at + task.let_ns) / 1e9);
      pen.context.fillStyle = colour('ink-soft');
      pen.context.fillRect(pen.x(at / 1e9) - 0.5, pen.y - 3, 1, pen.height + 6);
    }
    pen.context.fillStyle = colour('series-0');
    for (const {begin, end} of slices.get(task.index)) {
      if (end / 1e9 < from || begin / 1e9 > to) continue;
      pen.context.fillRect(pen.x(begin / 1e9), pen.y + 2, Math.max(1.5, pen.x(end / 1e9) - pen.x(begin / 1e9)), pen.height - 4);
    }
  }}));
  const use = tasks.map((task) => `${task.name} every ${duration(task.period_ns)} for ${duration(task.wcet_ns)}`).join(', ');
  return el('div', {class: 'card'}, timeButtons(time),
    rowsOf(`time line of a hyperperiod: ${use}`, rows, time, time.end < 1 ? {name: 'ms', length: 1e-3} : {name: 's', length: 1}),
    key([['releases', 'tick'], ['runs, for its WCET', 'box series-0'], ['LET', 'box let']]));
}

/** What the run has been; shares its time with the plots. */
export function runLine(tasks, happenings, time) {
  const faults = new Map(), late = new Map();
  const add = (map, index, what) => map.set(index, [...(map.get(index) ?? []), what]);
  for (const event of happenings.events) if (event.index !== undefined) add(faults, event.index, event);
  for (const [task, activation, endedAfter, leftOut] of happenings.misses) add(late, task, {activation, endedAfter, leftOut});
  const rows = tasks.map((task) => ({name: task.name, draw: (pen, from, to) => {
    const seen = releases(task, from * 1e9, Math.min(to, time.end) * 1e9 - 1);
    const dense = pen.perPx * 1e9 * 3 > task.period_ns;
    if (dense) {
      // one beside the other they are a strip
      pen.context.fillStyle = colour(task.let_ns === null ? 'release' : 'let');
      pen.context.fillRect(pen.x(from), pen.y + (task.let_ns === null ? 5 : 0), pen.x(Math.min(to, time.end)) - pen.x(from), pen.height - (task.let_ns === null ? 10 : 0));
    } else {
      for (let k = seen.first; k <= seen.last; ++k) {
        const at = seen.at(k) / 1e9;
        if (task.let_ns !== null) drawLet(pen, at, at + task.let_ns / 1e9);
        pen.context.fillStyle = colour(task.let_ns === null ? 'series-0' : 'ink-soft');
        pen.context.fillRect(pen.x(at) - 1, pen.y, 2, pen.height);
      }
    }
    for (const {activation, endedAfter, leftOut} of late.get(task.index) ?? []) {
      const begin = (task.offset_ns + activation * task.period_ns) / 1e9;
      const end = begin + (endedAfter ?? (leftOut ? 0 : task.deadline_ns)) / 1e9;
      if (end < from || begin > to) continue;
      pen.context.fillStyle = colour('series-1');
      pen.context.fillRect(pen.x(begin), pen.y + pen.height / 2, Math.max(3, pen.x(end) - pen.x(begin)), pen.height / 2);
    }
    pen.context.fillStyle = colour('fault');
    for (const {instant_ns: instant} of faults.get(task.index) ?? []) {
      const x = pen.x(instant / 1e9);
      pen.context.beginPath();
      pen.context.moveTo(x - 5, pen.y);
      pen.context.lineTo(x + 5, pen.y);
      pen.context.lineTo(x, pen.y + 9);
      pen.context.fill();
    }
  }}));
  return el('div', {class: 'card'}, timeButtons(time),
    rowsOf(`time line of the run: ${happenings.misses.length} activations late or left out, ${happenings.events.length} events`, rows, time, {name: 's', length: 1}),
    key([['release', 'box series-0'], ['LET', 'box let'], ['late, as long as it took', 'box series-1'], ['fault', 'triangle']]));
}

function key(entries) {
  return el('ul', {class: 'key'}, entries.map(([text, mark]) => el('li', {}, el('span', {class: 'mark ' + mark, 'aria-hidden': 'true'}), text)));
}

export function taskTable(tasks, happenings) {
  const measured = tasks.some((task) => task.measured);
  const columns = [['task', false], ['period', true], ['LET', true], ['deadline', true], ['declared WCET', true],
    ...(measured ? [['measured, 99.9 %', true], ['measured, longest', true]] : []), ['faults', true], ['late or left out', true]];
  const rows = tasks.map((task) => {
    const over = task.measured && task.wcet_ns !== null && task.measured.max_of_999_ns > task.wcet_ns;
    return [el('span', {title: task.type}, task.name), duration(task.period_ns), duration(task.let_ns), duration(task.deadline_ns), duration(task.wcet_ns),
      ...(measured ? [el('span', {class: over ? 'bad' : null}, duration(task.measured?.max_of_999_ns, 3), over ? ', beyond its WCET' : ''),
        duration(task.measured?.max_ns, 3)] : []),
      String(happenings.faults_of[task.name] ?? 0), String(happenings.misses_of[task.name] ?? 0)];
  });
  return table('tasks, declared and measured', columns, rows);
}
