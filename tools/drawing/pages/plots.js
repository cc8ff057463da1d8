// The plots of a run, and the list of all signals: ticked, dragged or chosen by keys they come to a plot.
import {count, el, number, shown} from './base.js';
import {Plot} from './plot.js';
import {timeButtons} from './steer.js';

const kind = 'text/x-signal';

export function plotsOf(signals, chosen, time, happenings) {
  const plots = [];
  let current = null;
  const area = el('div', {class: 'plots'});
  const list = el('div', {class: 'signals'});
  const boxes = new Map();

  const tick = () => {
    for (const [signal, box] of boxes) box.checked = current?.has(signal) ?? false;
    for (const plot of plots) plot.element.classList.toggle('current', plot === current && plots.length > 1);
  };
  const choose = (plot) => { current = plot; tick(); };
  const put = (signal, plot) => {
    plot.add(signal);
    choose(plot);
  };
  const takeSignal = (target, to) => {
    target.addEventListener('dragover', (event) => {
      if (!event.dataTransfer.types.includes(kind)) return;
      event.preventDefault();
      target.classList.add('over');
    });
    target.addEventListener('dragleave', () => target.classList.remove('over'));
    target.addEventListener('drop', (event) => {
      event.preventDefault();
      target.classList.remove('over');
      const signal = signals[Number(event.dataTransfer.getData(kind))];
      if (signal) put(signal, to());
    });
  };
  const addPlot = () => {
    const plot = new Plot(time, happenings, tick);
    plot.element.addEventListener('pointerdown', () => choose(plot), true);
    plot.element.addEventListener('focusin', () => choose(plot));
    const close = el('button', {type: 'button', class: 'close', 'aria-label': 'remove this plot', title: 'remove this plot',
      onclick: () => {
        plots.splice(plots.indexOf(plot), 1);
        plot.element.remove();
        choose(plots[plots.length - 1] ?? addPlot());
      }}, '×');
    plot.element.append(close);
    takeSignal(plot.element, () => plot);
    plots.push(plot);
    area.append(plot.element);
    choose(plot);
    return plot;
  };

  const item = (signal) => {
    const {unit, scale} = shown(signal.unit);
    const box = el('input', {type: 'checkbox', onchange: () => {
      if (box.checked) current.add(signal); else current.remove(signal);
    }});
    boxes.set(signal, box);
    const stated = signal.stated;
    const range = stated.min === null ? 'never a number'
      : `${number(stated.min * scale, 4)} to ${number(stated.max * scale, 4)}${unit ? ' ' + unit : ''}`;
    return el('li', {draggable: 'true', ondragstart: (event) => {
      event.dataTransfer.setData(kind, String(signal.index));
      event.dataTransfer.effectAllowed = 'copy';
    }}, el('label', {}, box, el('span', {class: 'name'}, signal.name.slice(signal.topic.name.length + 1) || signal.name),
      el('span', {class: 'range'}, range)));
  };
  const groups = [];
  for (const signal of signals) {
    const last = groups[groups.length - 1];
    if (last?.topic === signal.topic) last.signals.push(signal);
    else groups.push({topic: signal.topic, signals: [signal]});
  }
  const shownGroups = groups.map(({topic, signals: of}) => {
    const open = of.some((signal) => chosen.flat().includes(signal));
    const items = of.map((signal) => ({signal, element: item(signal)}));
    const element = el('details', {open}, el('summary', {}, topic.name, el('span', {class: 'range'}, count(topic.messages, 'value'))),
      el('ul', {}, items.map((each) => each.element)));
    return {element, items, open};
  });
  const search = el('input', {type: 'search', placeholder: 'Find a signal', 'aria-label': 'find a signal', oninput: () => {
    const word = search.value.trim().toLowerCase();
    for (const group of shownGroups) {
      let any = false;
      for (const {signal, element} of group.items) {
        element.hidden = !signal.name.toLowerCase().includes(word);
        any ||= !element.hidden;
      }
      group.element.hidden = !any;
      group.element.open = word ? any : group.open;
    }
  }});
  list.append(search, ...shownGroups.map((group) => group.element));

  const drop = el('button', {type: 'button', class: 'add', onclick: () => addPlot()}, 'Add a plot');
  takeSignal(drop, addPlot);
  for (const some of chosen) {
    const plot = addPlot();
    for (const signal of some) plot.add(signal);
  }
  if (plots.length === 0) addPlot();
  choose(plots[0]);
  return el('div', {},
    el('div', {class: 'bar'}, timeButtons(time),
      el('span', {class: 'hint'}, 'Drag across a plot to look closer, with Shift to move; double click shows all. Keys: ← → + − 0. By touch: one finger moves, two zoom.')),
    el('div', {class: 'bench'}, el('div', {}, area, drop), list));
}
