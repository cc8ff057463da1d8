// The path of a vehicle in space, turned by mouse, touch or keys. Heights are drawn larger where the path is flat.
import {canvas, colour, el, number, ticks} from './base.js';

// from dark to light, told apart with any kind of colour vision and in grey (viridis)
const ramp = [[68, 1, 84], [59, 82, 139], [33, 145, 140], [94, 201, 98], [253, 231, 37]];
function rampColour(part) {
  const at = Math.min(0.9999, Math.max(0, part)) * (ramp.length - 1), i = Math.floor(at);
  const mix = ramp[i].map((c, k) => Math.round(c + (ramp[i + 1][k] - c) * (at - i)));
  return `rgb(${mix.join(',')})`;
}

function points({x, y, z, down}) {
  for (const signal of [x, y, z]) signal.load();
  const found = [];
  const step = Math.max(1, Math.floor(x.times.length / 3000));
  for (let i = 0; i < x.times.length; i += step) {
    const [north, east, height] = [x, y, z].map((signal) => (signal.low[i] + signal.high[i]) / 2);
    if ([north, east, height].every(Number.isFinite)) found.push({t: x.times[i], e: east, n: north, u: down ? -height : height});
  }
  return found;
}

export function pathOf(paths, time) {
  let turn = -0.9, tilt = 0.5, closeness = 1, path, all, box, stretch;
  const note = el('p', {class: 'hint'});
  const load = (index) => {
    path = paths[index];
    all = points(path);
    box = {};
    for (const axis of ['e', 'n', 'u']) {
      const values = all.map((p) => p[axis]);
      box[axis] = {from: values.reduce((a, b) => Math.min(a, b), Infinity), to: values.reduce((a, b) => Math.max(a, b), -Infinity)};
    }
    const wide = Math.max(box.e.to - box.e.from, box.n.to - box.n.from), high = box.u.to - box.u.from;
    const wanted = high > 1e-6 ? wide * 0.5 / high : 1;
    stretch = [1, 2, 5, 10, 20, 50, 100].filter((s) => s <= wanted).pop() ?? 1;
    note.textContent = (stretch > 1 ? `Heights are drawn ${stretch} times as large. ` : '') +
      'The colour goes from dark at the start to bright at the end. Drag to turn, keys ← → ↑ ↓ + −.' +
      (path.x.thinned ? ' Of each piece of time it is the middle of the least and the greatest.' : '');
  };
  load(0);

  const picture = canvas('', 420, (context, width, height) => {
    const middle = Object.fromEntries(['e', 'n', 'u'].map((axis) => [axis, (box[axis].from + box[axis].to) / 2]));
    const flat = (p) => {
      const e = p.e - middle.e, n = p.n - middle.n, u = (p.u - middle.u) * stretch;
      const across = e * Math.cos(turn) - n * Math.sin(turn), deep = e * Math.sin(turn) + n * Math.cos(turn);
      return {x: across, y: -(u * Math.cos(tilt) + deep * Math.sin(tilt))};
    };
    // as large as there is room, with some for words
    const wide = Math.max(box.e.to - box.e.from, box.n.to - box.n.from, (box.u.to - box.u.from) * stretch, 1e-3) * 0.08;
    const seen = [0, 1, 2, 3, 4, 5, 6, 7].map((i) => flat({e: i & 1 ? box.e.to + wide : box.e.from - wide,
      n: i & 2 ? box.n.to + wide : box.n.from - wide, u: i & 4 ? box.u.to : box.u.from}));
    const [x0, x1, y0, y1] = [Math.min(...seen.map((p) => p.x)), Math.max(...seen.map((p) => p.x)), Math.min(...seen.map((p) => p.y)), Math.max(...seen.map((p) => p.y))];
    const scale = Math.min((width - Math.min(180, width / 3)) / (x1 - x0), (height - 70) / (y1 - y0)) * closeness;
    const project = (p) => {
      const at = flat(p);
      return {x: width / 2 + (at.x - (x0 + x1) / 2) * scale, y: height / 2 + (at.y - (y0 + y1) / 2) * scale};
    };
    const line = (a, b) => {
      const from = project(a), to = project(b);
      context.moveTo(from.x, from.y);
      context.lineTo(to.x, to.y);
    };
    drawFloor(context, project, line);
    drawPath(context, project, line);
  });

  function drawFloor(context, project, line) {
    const floor = box.u.from;
    const wide = Math.max(box.e.to - box.e.from, box.n.to - box.n.from, 1e-3);
    const room = wide * 0.08;
    const [e0, e1, n0, n1] = [box.e.from - room, box.e.to + room, box.n.from - room, box.n.to + room];
    const step = (from, to) => Math.max(2, Math.round(8 * (to - from) / (wide + 2 * room)));
    const es = ticks(e0, e1, step(e0, e1)), ns = ticks(n0, n1, step(n0, n1));
    context.strokeStyle = colour('line');
    context.lineWidth = 1;
    context.beginPath();
    for (const e of es) line({e, n: n0, u: floor}, {e, n: n1, u: floor});
    for (const n of ns) line({e: e0, n, u: floor}, {e: e1, n, u: floor});
    for (const e of [e0, e1]) line({e, n: n0, u: floor}, {e, n: n1, u: floor});
    for (const n of [n0, n1]) line({e: e0, n, u: floor}, {e: e1, n, u: floor});
    context.stroke();
    context.fillStyle = colour('ink-soft');
    context.textAlign = 'center';
    context.textBaseline = 'middle';
    const text = (words, p) => { const at = project(p); context.fillText(words, at.x, at.y); };
    const off = wide * 0.045;
    es.forEach((e, i) => { if (i % 2 === 0) text(number(e, 4), {e, n: n0 - off, u: floor}); });
    ns.forEach((n, i) => { if (i % 2 === 0) text(number(n, 4), {e: e0 - off, n, u: floor}); });
    text('east, m', {e: (e0 + e1) / 2, n: n0 - 2.6 * off, u: floor});
    text('north, m', {e: e0 - 2.6 * off, n: (n0 + n1) / 2, u: floor});
    // heights stand at the corner that is seen leftmost
    const corners = [[e0, n0], [e0, n1], [e1, n0], [e1, n1]].map(([e, n]) => ({e, n, u: floor}));
    const corner = corners.reduce((a, b) => project(b).x < project(a).x ? b : a);
    context.beginPath();
    line(corner, {...corner, u: Math.max(box.u.to, floor + 1e-3)});
    context.stroke();
    context.textAlign = 'right';
    for (const u of ticks(floor, box.u.to, 4)) {
      const at = project({...corner, u});
      context.fillText(path.down ? `${number(-u, 4)} m deep` : `${number(u, 4)} m up`, at.x - 8, at.y);
    }
  }

  function drawPath(context, project, line) {
    const floor = box.u.from;
    context.strokeStyle = colour('shadow');
    context.lineWidth = 2;
    context.beginPath();
    for (let i = 1; i < all.length; ++i) line({...all[i - 1], u: floor}, {...all[i], u: floor});
    context.stroke();
    context.lineWidth = 1;
    context.beginPath();
    const every = Math.max(1, Math.floor(all.length / 24));
    for (let i = 0; i < all.length; i += every) line(all[i], {...all[i], u: floor});
    context.stroke();
    context.lineWidth = 3.5;
    context.lineCap = 'round';
    const piece = Math.max(1, Math.floor(all.length / 200));
    for (let i = 0; i < all.length - 1; i += piece) {
      context.strokeStyle = rampColour(i / all.length);
      context.beginPath();
      for (let k = i; k < Math.min(i + piece, all.length - 1); ++k) line(all[k], all[k + 1]);
      context.stroke();
    }
    const dot = (p, words, size) => {
      const at = project(p);
      context.fillStyle = colour('ink');
      context.beginPath();
      context.arc(at.x, at.y, size, 0, 7);
      context.fill();
      context.textAlign = 'left';
      context.fillText(words, at.x + 9, at.y - 9);
    };
    if (all.length === 0) return;
    dot(all[0], 'start', 4.5);
    dot(all[all.length - 1], 'end', 4.5);
    if (time.cursor === null) return;
    const now = all.find((p) => p.t >= time.cursor);
    if (now) dot(now, `${number(now.t, 5)} s`, 6);
  }

  const describe = () => {
    picture.element.setAttribute('aria-label', `path of ${path.name}: from ${number(all[0]?.n, 3)} m north, ${number(all[0]?.e, 3)} m east ` +
      `to ${number(all[all.length - 1]?.n, 3)} m north, ${number(all[all.length - 1]?.e, 3)} m east, heights from ${number(box.u.from, 3)} to ${number(box.u.to, 3)} m`);
    picture.redraw();
  };
  const view = (to) => { [turn, tilt, closeness] = to; picture.redraw(); };
  steerView(picture.element, {
    turn: (x, y) => view([turn + x, Math.min(1.57, Math.max(0.02, tilt + y)), closeness]),
    closer: (factor) => view([turn, tilt, Math.min(20, Math.max(0.3, closeness * factor))]),
    reset: () => view([-0.9, 0.5, 1])});
  time.watch(picture.redraw);
  describe();
  const button = (text, to) => el('button', {type: 'button', onclick: () => view(to)}, text);
  const choice = paths.length < 2 ? null : el('label', {class: 'choice'}, 'Place as published by ',
    el('select', {onchange: (event) => { load(Number(event.target.value)); describe(); }},
      paths.map((each, i) => el('option', {value: i}, each.name))));
  return el('div', {class: 'card'}, el('div', {class: 'buttons'}, choice, button('Aslant', [-0.9, 0.5, 1]), button('From above', [0, 1.57, 1]), button('From the side', [0, 0.02, 1])),
    picture.box, note);
}

function steerView(element, {turn, closer, reset}) {
  const touches = new Map();
  const gap = () => {
    const [a, b] = [...touches.values()];
    return Math.hypot(a.x - b.x, a.y - b.y);
  };
  element.classList.add('turns');
  element.addEventListener('pointerdown', (event) => {
    touches.set(event.pointerId, {x: event.offsetX, y: event.offsetY});
    element.setPointerCapture(event.pointerId);
  });
  element.addEventListener('pointermove', (event) => {
    const before = touches.get(event.pointerId);
    if (!before) return;
    const now = {x: event.offsetX, y: event.offsetY};
    const was = touches.size === 2 ? gap() : 0;
    touches.set(event.pointerId, now);
    if (touches.size === 2) closer(gap() / (was || 1));
    else turn((now.x - before.x) * 0.01, (now.y - before.y) * 0.01);
  });
  for (const name of ['pointerup', 'pointercancel']) element.addEventListener(name, (event) => touches.delete(event.pointerId));
  element.addEventListener('dblclick', reset);
  element.addEventListener('wheel', (event) => {
    if (!event.ctrlKey && !event.metaKey) return;
    event.preventDefault();
    closer(Math.exp(-event.deltaY / 300));
  }, {passive: false});
  element.addEventListener('keydown', (event) => {
    const act = {ArrowLeft: () => turn(-0.15, 0), ArrowRight: () => turn(0.15, 0), ArrowUp: () => turn(0, 0.1), ArrowDown: () => turn(0, -0.1),
                 '+': () => closer(1.2), '=': () => closer(1.2), '-': () => closer(1 / 1.2), 0: reset}[event.key];
    if (!act || event.ctrlKey || event.metaKey) return;
    event.preventDefault();
    act();
  });
}
